// SPDX-License-Identifier: BSL-1.0
#include "contact_scene.hpp"

using namespace sinew;

namespace {

// a block of four points, with as stiff springs as masses need none: it slides as a whole
auto block_on_slope(double friction, double angle) {
  const double c = std::cos(angle), s = std::sin(angle), up = 0.099;
  std::vector<Eigen::Vector3d> p;
  for (auto [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}})
    p.push_back({c * x - s * up, y, s * x + c * up});
  return contact_scene(
      MinProximityIntersection{.alarmDistance = 0.2, .contactDistance = 0.1},
      10,
      floor_node(1000, friction, angle),
      node<"block">(EulerImplicitSolver{},
                    CGLinearSolver<>{.iterations = 50, .tolerance = 1e-12},
                    MechanicalObject<Vec3d>{.position = p},
                    UniformMass<Vec3d>{.vertexMass = 0.5},
                    PointCollisionModel<Vec3d>{.contactStiffness = 1, .contactDamping = 10}));
}

}  // namespace

TEST_CASE("on a slope friction holds up to the angle of Coulomb, and not beyond") {
  const double friction = 0.5, critical = std::atan(friction);
  SECTION("below") {
    auto sim = block_on_slope(friction, critical - 0.01);
    sim.init();
    for (int i = 0; i < 200; ++i) sim.animate(0.01);
    const auto settled = sim.at<"block">().state().position;
    for (int i = 0; i < 2000; ++i) sim.animate(0.01);
    for (std::size_t i = 0; i < 4; ++i)
      CHECK((sim.at<"block">().state().position[i] - settled[i]).norm() < 1e-6);
  }
  SECTION("above") {
    const double angle = critical + 0.02;
    auto sim = block_on_slope(friction, angle);
    sim.init();
    // a = g (sin - mu cos), from rest
    const double a = 10 * (std::sin(angle) - friction * std::cos(angle));
    for (int i = 0; i < 200; ++i) sim.animate(0.01);
    const double v0 = sim.at<"block">().state().velocity[0].norm();
    for (int i = 0; i < 200; ++i) sim.animate(0.01);
    const double v1 = sim.at<"block">().state().velocity[0].norm();
    CHECK((v1 - v0) / 2 == Approx(a).epsilon(0.01));
  }
}
