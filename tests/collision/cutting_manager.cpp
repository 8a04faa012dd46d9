// SPDX-License-Identifier: BSL-1.0
// A blade that moves through a body while that moves.
#include "../topology/cut_bodies.hpp"

#include <sinew/contact.hpp>
#include <sinew/mechanics.hpp>

namespace test_cutting_manager {

using namespace cutting;

namespace {

auto scene(Body const& b, CuttingManager const& manager, std::vector<Point> const& blade,
           double stretch = 0) {
  std::vector<Point> x;
  std::vector<int> ends;
  for (std::size_t i = 0; i < b.points.size(); ++i) {
    x.emplace_back(b.points[i][0] * (1 + stretch), b.points[i][1], b.points[i][2]);
    if (b.points[i][0] < 0.01 || b.points[i][0] > 5.99) ends.push_back(int(i));
  }
  return Simulation{
      node<"root">(Gravity{{0, 0, -1}},
                   manager,
                   node<"body">(EulerImplicitSolver{.rayleighMass = 1},
                                CGLinearSolver<>{.iterations = 100, .tolerance = 1e-10, .threshold = 1e-20},
                                MeshTopology{.tetrahedra = b.tetrahedra},
                                MechanicalObject<Vec3d>{.position = x, .restPosition = b.points},
                                DiagonalMass<Vec3d>{.massDensity = 1},
                                TetrahedronFEMForceField<Vec3d>{.youngModulus = {100}, .poissonRatio = 0.3},
                                FixedConstraint<Vec3d>{.indices = ends},
                                node<"skin">(MeshTopology{.triangles = b.skin})),
                   node<"tool">(MechanicalObject<Vec3d>{.position = blade}))};
}
template <class Sim>
Body body_of(Sim& sim) {
  return {sim.template at<"body">().state().restPosition,
          sim.template at<"body">().template get<MeshTopology>().tetrahedra,
          sim.template at<"body/skin">().template get<MeshTopology>().triangles};
}
CuttingManager manager() { return {.toolModel = "tool", .bodyModel = "body"}; }
template <class Sim>
CuttingManager& manager_of(Sim& sim) {
  return sim.root().template get<CuttingManager>();
}

}  // namespace

TEST_CASE("a blade goes through a body that moves, and parts it") {
  for (const int steps : {7, 40}) {
    const Body b = block(6, 2, 2, 0.1);
    auto sim = scene(b, manager(), {{3.2, -0.5, -1}, {3.3, -0.5, 1}, {3.4, -0.5, 4}}, 0.1);
    sim.init();
    sim.animate(0.01);
    std::size_t points = b.points.size();
    for (int i = 0; i < steps; ++i) {
      for (auto& p : sim.at<"tool">().state().position) p[1] += 4. / steps;
      sim.animate(0.01);
      const Body now = body_of(sim);
      CHECK(now.points.size() >= points);
      points = now.points.size();
      CHECK(volume(now) == Approx(volume(b)).epsilon(1e-12));
      CHECK(worst(now) >= std::min(0.1, worst(b)) * (1 - 1e-9));
      CHECK(has_its_skin(now));
    }
    CHECK(pieces(body_of(sim)) == 2);
    CHECK(manager_of(sim).refused == 0);
    CHECK(manager_of(sim).cut > 10);
    // the pieces go apart
    for (int i = 0; i < 100; ++i) sim.animate(0.02);
    CHECK(pieces(body_of(sim)) == 2);
  }
}

TEST_CASE(
    "a blade that stops leaves a partial cut, which it completes later; what is cut stays so after a reset") {
  const Body b = block(6, 2, 2);
  auto sim = scene(b, manager(), {{3.2, -0.5, -1}, {3.2, -0.5, 4}});
  sim.init();
  auto move = [&](double y, int steps) {
    for (int i = 0; i < steps; ++i) {
      for (auto& p : sim.at<"tool">().state().position) p[1] += y / steps;
      sim.animate(0.01);
    }
  };
  move(0, 5);
  CHECK(body_of(sim).points.size() == b.points.size());
  move(1.6, 10);
  move(0, 20);
  const std::size_t points = body_of(sim).points.size();
  CHECK(points > b.points.size());
  CHECK(pieces(body_of(sim)) == 1);
  move(-0.8, 5);
  move(0.8, 5);
  CHECK(body_of(sim).points.size() <= points + 4);
  move(1.6, 10);
  CHECK(pieces(body_of(sim)) == 2);
  const Body now = body_of(sim);
  sim.reset();
  CHECK(body_of(sim).tetrahedra == now.tetrahedra);
  sim.animate(0.01);
}

TEST_CASE("cuts that cannot be made are counted, and nothing has changed") {
  const Body b = block(6, 2, 2);
  auto full = manager();
  full.capacity = int(b.points.size());
  auto sim = scene(b, full, {{3.2, -0.5, -1}, {3.2, -0.5, 4}});
  sim.init();
  sim.animate(0.01);
  for (auto& p : sim.at<"tool">().state().position) p[1] += 4;
  sim.animate(0.01);
  CHECK(manager_of(sim).refused == 1);
  CHECK(manager_of(sim).message.find("capacity") != std::string::npos);
  CHECK(body_of(sim).tetrahedra == b.tetrahedra);
  CHECK(!sim.warnings().list().empty());
}

TEST_CASE("hundreds of random strokes, with jumps, removals and a blade that is none") {
  for (int seed = 0; seed < 3; ++seed) {
    std::mt19937 random{unsigned(seed)};
    std::uniform_real_distribution<double> u(-1, 1);
    const Body b = block(6, 2, 2, 0.15);
    auto limited = manager();
    limited.capacity = 500;
    limited.snapping = 0.1 * seed;
    auto sim = scene(b, limited, {{3, 1, -1}, {3, 1, 3}}, 0.1);
    sim.init();
    for (int i = 0; i < (brief ? 60 : 150); ++i) {
      auto& blade = sim.at<"tool">().state().position;
      const bool jumps = i % 10 == 0;
      for (auto& p : blade) p += Point(u(random), u(random), u(random)) * (jumps ? 3. : 0.4);
      const Point lost = Point(3, 1, 1) - (blade[0] + blade[1]) / 2;
      if (lost.norm() > 3)
        for (auto& p : blade) p += lost;
      if (i % 40 == 39)
        sim.removeElements("body", {.tetrahedra = {Index(body_of(sim).tetrahedra.size() / 2)}});
      const double before = volume(body_of(sim));
      sim.animate(0.01);
      const Body now = body_of(sim);
      CHECK(volume(now) == Approx(before).epsilon(1e-12));
      CHECK(worst(now) >= std::min(0.1, worst(b)) * (1 - 1e-9));
      CHECK(has_its_skin(now));
      CHECK(now.points.size() <= 500);
    }
    CHECK(manager_of(sim).cut > 100);
    sim.at<"tool">().state().position[0][0] = std::nan("");
    const long refused = manager_of(sim).refused;
    CHECK_THROWS_AS(sim.animate(0.01), Error);  // a state that is not finite
    CHECK(manager_of(sim).refused == refused + 1);
  }
}

TEST_CASE("a manager without blade or body is refused, and one that is not active does nothing") {
  const Body b = block(2, 2, 2);
  auto refused = [&](CuttingManager const& m, std::vector<Point> const& blade, std::string_view words) {
    auto sim = scene(b, m, blade);
    std::string message;
    try {
      sim.init();
    } catch (Error const& error) {
      message = error.what();
    }
    CHECK(message.find(words) != std::string::npos);
  };
  const std::vector<Point> two{{1, 0, 0}, {1, 1, 0}};
  refused({.bodyModel = "body"}, two, "toolModel is not given");
  refused({.toolModel = "tool"}, two, "bodyModel is not given");
  refused({.toolModel = "tol", .bodyModel = "body"}, two, "no state with points");
  refused({.toolModel = "tool", .bodyModel = "bod"}, two, "no topology over a state");
  refused({.toolModel = "tool", .indices = {0, 2}, .bodyModel = "body"}, two, "indices has 2");
  refused(manager(), {{1, 0, 0}}, "one point");
  auto off = manager();
  off.active = false;
  auto sim = scene(b, off, {{1, -1, -1}, {1, -1, 3}});
  sim.init();
  for (int i = 0; i < 5; ++i) {
    for (auto& p : sim.at<"tool">().state().position) p[1] += 1;
    sim.animate(0.01);
  }
  CHECK(body_of(sim).points.size() == b.points.size());
}

}  // namespace test_cutting_manager
