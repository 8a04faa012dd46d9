// SPDX-License-Identifier: BSL-1.0
// A rope over a cylinder (Euler 1769, Eytelwein 1832): it slips where the ratio of its tensions is e^(mu
// phi).
#include "lagrangian/contact_scenes.hpp"

#include <algorithm>

namespace test_rope_on_cylinder {

using namespace sinew;
using Eigen::Vector3d;

namespace {

// Half a turn of `links` straight links around a circle of 0.1 m, and three more that hang on each side. In
// the plane of the circle a cylinder and a ball are the same. Where a link turns to the next by an angle d,
//   T2 / T1 = (1 + mu tan(d/2)) / (1 - mu tan(d/2)) = e^(mu d (1 + (1 + 4 mu^2) d^2/12 + ...))
// at slip, so that a rope of 40 links has the ratio of Euler and Eytelwein to (1 + 4 mu^2) d^2/12 mu phi <
// 1e-3.
constexpr double radius = 0.1;
constexpr int links = 40, hanging = 3;

struct Rope {
  std::vector<Vector3d> points{};
  std::vector<Edge> edges{};

  Rope() {
    const double turn = M_PI / links, link = 2 * radius * std::sin(turn / 2);
    for (int i = hanging; i > 0; --i) points.push_back({-radius, 0, -link * i});
    for (int i = 0; i <= links; ++i)
      points.push_back({-radius * std::cos(i * turn), 0, radius * std::sin(i * turn)});
    for (int i = 1; i <= hanging; ++i) points.push_back({radius, 0, -link * i});
    for (int i = 0; i + 1 < int(points.size()); ++i) edges.push_back({i, i + 1});
  }
  int last() const { return int(points.size()) - 1; }
};

// 1 N pulls at the first point, `pull` at the last; the rope is so light that its inertia does not count
template <class Solver>
auto rope_on_cylinder(Solver solver, double mu, double pull) {
  const Rope rope;
  MeshTopology topology;
  topology.edges = rope.edges;
  auto sim = constrained_scene_by(
      solver,
      MinProximityIntersection{.alarmDistance = 0.002, .contactDistance = 0},
      mu,
      node<"cylinder">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}}},
                       SphereCollisionModel<Vec3d>{.moving = false, .simulated = false, .radius = radius}),
      node<"rope">(
          EulerImplicitSolver{.rayleighMass = 20},
          SparseLDLSolver<>{},
          topology,
          MechanicalObject<Vec3d>{.position = rope.points},
          UniformMass<Vec3d>{.vertexMass = 1e-4},
          MeshSpringForceField<Vec3d>{.stiffness = 2e4},
          ConstantForceField<Vec3d>{.indices = {0, rope.last()}, .forces = {{0, 0, -1}, {0, 0, -pull}}},
          PartialFixedConstraint<Vec3d>{.fixAll = true, .fixedDirections = {0, 1, 0}},
          PointCollisionModel<Vec3d>{}));
  sim.root().template get<Gravity>().gravity.setZero();
  sim.init();
  return sim;
}

}  // namespace

TEST_CASE("a rope over a cylinder holds below the ratio e^(mu phi) of its tensions, and slips above",
          "[long]") {
  // how far its end goes from 0.06 to 0.12 s, after what is elastic has come to rest
  auto moved = [](auto solver, double mu, double part) {
    auto sim = rope_on_cylinder(solver, mu, part * std::exp(mu * M_PI));
    for (int i = 0; i < 60; ++i) sim.animate(1e-3);
    auto const& x = sim.template at<"rope">().state();
    const Vector3d before = x.position.back();
    for (int i = 0; i < 60; ++i) sim.animate(1e-3);
    return (x.position.back() - before).norm();
  };
  auto slipsAt = [&](auto solver) {
    for (const double mu : {0.2, 0.5}) {
      INFO(mu);
      CHECK(moved(solver, mu, 0.995) < 1e-6);
      CHECK(moved(solver, mu, 1.005) > 1e-3);
    }
  };
  slipsAt(BlockGaussSeidelConstraintSolver{.maxIterations = 3000, .tolerance = 1e-11});
  slipsAt(ConvexConstraintSolver{.tolerance = 1e-9, .momentumTolerance = 1e-9, .maxUpdates = 500});
}

}  // namespace test_rope_on_cylinder
