// SPDX-License-Identifier: BSL-1.0
// Bodies that are cut while they move: what follows, and what stays.
#include "../topology/cut_bodies.hpp"

#include <sinew/contact.hpp>
#include <sinew/mechanics.hpp>

namespace test_cutting {

using namespace cutting;

namespace {

constexpr double length = 0.1;  // of a cube [m]

Body bar(double jitter = 0) {
  Body b = block(6, 2, 2, jitter);
  for (auto& p : b.points) p *= length;
  return b;
}

template <class Mass>
auto scene(Body const& b, Mass const& mass, std::vector<Point> const& position,
           std::vector<Point> const& velocity, std::vector<double> const& young,
           std::vector<int> const& fixed, Eigen::Vector3d const& gravity = {0, 0, 0}) {
  const Mesh look{.positions = position, .triangles = b.skin};
  return Simulation{node<"root">(
      DefaultPipeline{},
      BruteForceBroadPhase{},
      BVHNarrowPhase{},
      MinProximityIntersection{.alarmDistance = 0.002, .contactDistance = 0.001},
      DefaultContactManager{},
      Gravity{gravity},
      EulerImplicitSolver{},
      CGLinearSolver<>{.iterations = 500, .tolerance = 1e-14, .threshold = 1e-30},
      node<"body">(
          MeshTopology{.tetrahedra = b.tetrahedra},
          MechanicalObject<Vec3d>{.position = position, .velocity = velocity, .restPosition = b.points},
          mass,
          TetrahedronFEMForceField<Vec3d>{.youngModulus = young, .poissonRatio = 0.3},
          FixedConstraint<Vec3d>{.indices = fixed},
          node<"skin">(MeshTopology{.triangles = b.skin},
                       node<"look">(VisualModel{look}, IdentityMapping<Vec3d, Vec3f>{})),
          node<"surface">(MechanicalObject<Vec3d>{},
                          MeshTopology{.triangles = b.skin},
                          IdentityMapping<Vec3d, Vec3d>{},
                          TriangleCollisionModel<Vec3d>{.selfCollision = false}),
          node<"inside">(MechanicalObject<Vec3d>{.position = {{0.05, 0.1, 0.1}, {0.55, 0.1, 0.1}}},
                         BarycentricMapping<Vec3d, Vec3d>{})))};
}

/// Stretched along x and sheared, and moving.
std::vector<Point> strained(Body const& b, double stretch) {
  std::vector<Point> x;
  for (auto const& p : b.points)
    x.emplace_back(p[0] * (1 + stretch), p[1] + 0.1 * p[0], p[2] + 0.03 * p[0] * p[0]);
  return x;
}
std::vector<Point> moving(Body const& b) {
  std::vector<Point> v;
  for (auto const& p : b.points) v.emplace_back(1 - p[2], 2 * p[0], 0.5 + p[1] * p[0]);
  return v;
}
std::vector<int> ends(Body const& b) {
  std::vector<int> all;
  for (std::size_t i = 0; i < b.points.size(); ++i)
    if (b.points[i][0] < 0.001 || b.points[i][0] > 6 * length - 0.001) all.push_back(int(i));
  return all;
}
Blade across(double x) {
  return {{Point(x, -1, -1), Point(x, -1, 1)}, {Point(x + 0.02, 1, -1), Point(x + 0.02, 1, 1)}};
}
template <class Sim>
Point momentum(Sim& sim) {
  auto& node = sim.template at<"body">();
  std::vector<Point> p(node.state().size(), Point::Zero());
  node.forEachComponent(on<role::Mass>(
      [&](auto const& mass) { mass.addMDx(p, node.state().position, node.state().velocity, 1); }));
  Point sum = Point::Zero();
  for (auto const& q : p) sum += q;
  return sum;
}
template <class Sim>
Body body_of(Sim& sim) {
  auto& node = sim.template at<"body">();
  auto const& topology = node.template get<MeshTopology>();
  return {node.state().restPosition,
          topology.tetrahedra,
          sim.template at<"body/skin">().template get<MeshTopology>().triangles};
}

}  // namespace

TEST_CASE(
    "a cut leaves mass, momentum, volume, energies and the forces of a strained, moving body as they are") {
  const Body b = bar(0.1);
  auto check = [&](auto const& mass, bool momentumStays) {
    auto sim = scene(b, mass, strained(b, 0.1), moving(b), {5000}, {0});
    sim.init();
    const Point before = momentum(sim);
    const double kinetic = sim.kineticEnergy(), potential = sim.potentialEnergy();
    const Cut done = sim.cut("body", across(0.31));
    CHECK(done.faces >= 8);
    auto& state = sim.template at<"body">().state();
    CHECK(state.size() == done.change.points.size());
    CHECK(sim.potentialEnergy() == Approx(potential).epsilon(1e-12));
    Body now = body_of(sim);
    CHECK(volume(now) == Approx(volume(b)).epsilon(1e-12));
    CHECK(pieces(now) == 2);
    CHECK(has_its_skin(now));
    if (!momentumStays) return;
    CHECK((momentum(sim) - before).norm() < 1e-12 * before.norm());
    // lumped: that of points between others is less than theirs
    CHECK(sim.kineticEnergy() == Approx(kinetic).epsilon(0.05));
    sim.animate(1e-6);
    CHECK((momentum(sim) - before).norm() < 1e-3 * before.norm());
  };
  check(DiagonalMass<Vec3d>{.massDensity = 1000}, true);
  check(MeshMatrixMass<Vec3d>{.massDensity = {1000}}, true);
  check(DiagonalMass<Vec3d>{.totalMass = 3}, true);
  check(UniformMass<Vec3d>{.totalMass = 3}, false);
}

TEST_CASE("a body at rest stays at rest, and one under tension opens") {
  const Body b = bar();
  for (const double stretch : {0., 0.2}) {
    std::vector<Point> x;
    for (auto const& p : b.points) x.emplace_back(p[0] * (1 + stretch), p[1], p[2]);
    auto sim = scene(b, DiagonalMass<Vec3d>{.massDensity = 1000}, x, {}, {5000}, ends(b));
    sim.init();
    sim.cut("body", across(0.31 * (1 + stretch)));
    for (int i = 0; i < 100; ++i) sim.animate(0.01);
    double low = 0, high = 1;  // where the left piece ends, and the right one begins
    auto const& state = sim.at<"body">().state();
    const double middle = 0.3 * (1 + stretch) + 0.01;
    for (std::size_t i = 0; i < state.size(); ++i) {
      CHECK((stretch > 0 || (state.position[i] - state.restPosition[i]).norm() < 1e-12));
      if (state.position[i][0] < middle)
        low = std::max(low, state.position[i][0]);
      else
        high = std::min(high, state.position[i][0]);
    }
    if (stretch > 0) CHECK(high - low > 0.05);
  }
}

TEST_CASE(
    "parts have the material of their element, points between held ones are held, and all surfaces follow") {
  const Body b = bar();
  std::vector<double> young;
  for (std::size_t e = 0; e < b.tetrahedra.size(); ++e) young.push_back(1000. + double(e));
  std::vector<int> fixed;
  for (std::size_t i = 0; i < b.points.size(); ++i)
    if (b.points[i][2] < 0.001) fixed.push_back(int(i));
  auto sim = scene(b, DiagonalMass<Vec3d>{.massDensity = 1000}, b.points, {}, young, fixed, {0, 0, -9.81});
  sim.init();
  const Cut done = sim.cut("body", across(0.33));
  auto& node = sim.at<"body">();
  auto const& come = done.change.of(ElementKind::tetrahedron).come;
  auto const& now = node.get<TetrahedronFEMForceField<Vec3d>>().youngModulus;
  REQUIRE(now.size() == node.get<MeshTopology>().tetrahedra.size());
  REQUIRE(come.size() > 10);
  for (std::size_t k = 0; k < come.size(); ++k)
    CHECK(now[b.tetrahedra.size() + k] == young[std::size_t(come[k].a)]);
  auto const& held = node.get<FixedConstraint<Vec3d>>().indices;
  std::size_t below = 0;
  for (auto const& p : node.state().restPosition) below += p[2] < 0.001;
  CHECK(held.size() == below);
  CHECK(below > fixed.size());
  CHECK(sim.at<"body/surface">().get<MeshTopology>().triangles ==
        sim.at<"body/skin">().get<MeshTopology>().triangles);
  CHECK(sim.at<"body/skin/look">().visual().mesh.triangles ==
        sim.at<"body/skin">().get<MeshTopology>().triangles);
  CHECK(sim.at<"body/skin/look">().visual().position.size() == node.state().size());
  for (int i = 0; i < 20; ++i) sim.animate(0.01);
  for (const int i : held)
    CHECK(node.state().position[std::size_t(i)] == node.state().restPosition[std::size_t(i)]);
}

TEST_CASE("a cut body moves as one that was meshed so from the start") {
  const Body b = bar(0.1);
  auto sim = scene(b,
                   DiagonalMass<Vec3d>{.massDensity = 1000},
                   strained(b, 0.1),
                   moving(b),
                   {5000},
                   ends(b),
                   {0, 0, -9.81});
  sim.init();
  for (int i = 0; i < 3; ++i) sim.animate(0.005);
  sim.cut("body", across(0.35));
  sim.cut("body", {{Point(-1, 0.1, -1), Point(-1, 0.12, 1)}, {Point(2, 0.12, -1), Point(2, 0.1, 1)}});
  auto& node = sim.at<"body">();
  auto fresh = scene(body_of(sim),
                     DiagonalMass<Vec3d>{.massDensity = 1000},
                     node.state().position,
                     node.state().velocity,
                     {5000},
                     node.get<FixedConstraint<Vec3d>>().indices,
                     {0, 0, -9.81});
  fresh.init();
  for (int i = 0; i < 10; ++i) sim.animate(0.005), fresh.animate(0.005);
  auto const &x = node.state().position, &y = fresh.at<"body">().state().position;
  REQUIRE(x.size() == y.size());
  for (std::size_t i = 0; i < x.size(); ++i) CHECK((x[i] - y[i]).norm() < 1e-9);
}

TEST_CASE("a cut that cannot be made changes nothing, and says why") {
  const Body b = bar();
  auto sim = scene(b, DiagonalMass<Vec3d>{.massDensity = 1000}, b.points, {}, {5000}, {0});
  CHECK_THROWS_AS(sim.cut("body", across(0.3)), Error);  // before init
  sim.init();
  auto refused = [&](std::string_view path, auto&& blade, CutRules const& rules, std::string_view words) {
    std::string message;
    try {
      sim.cut(path, blade(), rules);
    } catch (Error const& error) {
      message = error.what();
    }
    CHECK(message.find(words) != std::string::npos);
    CHECK(body_of(sim).points == b.points);
    CHECK(body_of(sim).tetrahedra == b.tetrahedra);
  };
  auto good = [] { return across(0.3); };
  refused("bodi", good, {}, "there is no topology at this path");
  refused("body", good, {.capacity = 70}, "and may have 70");
  refused("body", good, {.snapping = 1}, "snapping");
  refused(
      "body",
      [] {
        return Blade{{Point(0, 0, std::nan("")), Point(0, 0, 1)}, {Point(1, 0, 0), Point(1, 0, 1)}};
      },
      {},
      "not finite");
  refused(
      "body", [] { return Blade{}; }, {}, "two at least");
  CHECK(sim.cut("body", across(3)).elements == 0);
  auto weighed = scene(b,
                       DiagonalMass<Vec3d>{.vertexMass = std::vector<double>(b.points.size(), 1)},
                       b.points,
                       {},
                       {5000},
                       {0});
  weighed.init();
  CHECK_THROWS_AS(weighed.cut("body", across(0.3)), Error);
}

}  // namespace test_cutting
