// SPDX-License-Identifier: BSL-1.0
// Fluid2D and Fluid3D in scenes: gravity and threads of their nodes, what is seen, energies, reset, bad
// input.
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/fluid/fluid2d.hpp>
#include <sinew/fluid/fluid3d.hpp>
#include <sinew/mechanics.hpp>

#include <map>

namespace test_fluid_components {

using namespace sinew;

namespace {

Fluid3D<Vec3d> tank() {
  return {
      .nx = 18, .ny = 14, .nz = 10, .cellwidth = 0.1, .center = {1, 2, 3}, .height = 6.5, .dir = {0.4, 1, 0}};
}
auto scene(Fluid3D<Vec3d> const& fluid, int threads = 1) {
  return Simulation{node<"root">(Gravity{{0, -9.81, 0}}, Threads{.count = threads}, node<"water">(fluid))};
}

// the volume inside a closed border of quads
double volume_inside(Mesh const& mesh) {
  double sum = 0;
  for (auto const& q : mesh.quads) {
    auto at = [&](std::size_t k) -> Eigen::Vector3d const& { return mesh.positions[std::size_t(q[k])]; };
    sum += at(0).dot(at(1).cross(at(2))) / 6 + at(0).dot(at(2).cross(at(3))) / 6;
  }
  return sum;
}

}  // namespace

TEST_CASE("a fluid of a scene falls by the gravity of its node, and only then") {
  auto falling = scene(tank());
  falling.init();
  for (int k = 0; k < 10; ++k) falling.animate(0.01);
  CHECK(falling.kineticEnergy() > 1);

  Simulation floating{node<"root">(Gravity{{0, 0, 0}}, node<"water">(tank()))};
  floating.init();
  for (int k = 0; k < 10; ++k) floating.animate(0.01);
  CHECK(floating.kineticEnergy() == 0);
}

TEST_CASE("a fluid beside a body: each has its energy, and they do not feel each other") {
  Simulation sim{node<"root">(Gravity{{0, -9.81, 0}},
                              node<"water">(Fluid2D<Vec2d>{.nx = 10, .ny = 10, .height = 4.5}),
                              node<"ball">(EulerExplicitSolver{},
                                           MechanicalObject<Vec3d>{.position = {{0, 0, 0}}},
                                           UniformMass<Vec3d>{.vertexMass = 2}))};
  sim.init();
  for (int k = 0; k < 10; ++k) sim.animate(0.01);
  // the pool rests; v = g t of the ball
  CHECK(sim.kineticEnergy() == Approx(0.981 * 0.981).epsilon(1e-9));
}

TEST_CASE("a fluid that sloshes gains no energy") {
  Simulation sim{node<"root">(Gravity{{0, -9.81, 0}},
                              node<"water">(Fluid2D<Vec2d>{
                                  .nx = 66, .ny = 50, .cellwidth = 0.025, .height = 24.5, .dir = {0.4, 1}}))};
  sim.init();
  Fluid2D<Vec2d>& fluid = sim.at<"water">().get<Fluid2D<Vec2d>>();
  const Eigen::Vector3d g(0, -9.81, 0);
  const double start = fluid.gravityEnergy(g) + fluid.kineticEnergy(), volume = fluid.volume();
  // what is above a level pool: rho g L of the mean square of the tilt over 2
  const double available = 1000 * 9.81 * 1.6 * (0.4 * 1.6) * (0.4 * 1.6) / 12 / 2;
  double most = 0;
  for (int k = 0; k < 400; ++k) {
    sim.animate(0.0025);
    // cells that are cut are known as if the surface crossed them along an axis
    CHECK(fluid.gravityEnergy(g) + fluid.kineticEnergy() < start + 0.05 * available);
    most = std::max(most, fluid.kineticEnergy());
  }
  CHECK(most > 0.9 * available);
  CHECK(most < 1.02 * available);
  CHECK(fluid.volume() == Approx(volume).epsilon(1e-8));
  CHECK(sim.kineticEnergy() == fluid.kineticEnergy());
}

TEST_CASE("height counts from the walls, as in SOFA") {
  // cells 1 to 8 of 10 have fluid, the centre of cell k is at k: a surface at 4.5 is 4 cells above the floor
  Simulation sim{
      node<"root">(node<"water">(Fluid2D<Vec2d>{.nx = 10, .ny = 10, .cellwidth = 0.5, .height = 4.5}))};
  sim.init();
  Fluid2D<Vec2d>& fluid = sim.at<"water">().get<Fluid2D<Vec2d>>();
  CHECK(fluid.volume() == Approx(8 * 4 * 0.25));
  Mesh const border = fluid.border();
  Eigen::Vector3d low = border.positions[0], high = low;
  for (auto const& p : border.positions) low = low.cwiseMin(p), high = high.cwiseMax(p);
  CHECK((low - Eigen::Vector3d(-2, -2, 0)).norm() < 0.3);
  CHECK((high - Eigen::Vector3d(2, 0, 0)).norm() < 0.3);
  CHECK(border.edges.size() == border.positions.size());  // one closed line

  Simulation full{node<"root">(node<"water">(Fluid2D<Vec2d>{.nx = 10, .ny = 10, .height = 0}))};
  full.init();
  CHECK(full.at<"water">().get<Fluid2D<Vec2d>>().volume() == 64);
}

TEST_CASE("the border of a fluid is closed, and has its volume inside") {
  auto sim = scene(tank());
  sim.init();
  for (int k = 0; k < 20; ++k) sim.animate(0.01);
  Fluid3D<Vec3d>& fluid = sim.at<"water">().get<Fluid3D<Vec3d>>();
  const Mesh border = fluid.border();
  CHECK_NOTHROW(check_mesh("border", border));
  std::map<std::pair<Index, Index>, int> edges;
  for (auto const& q : border.quads)
    for (std::size_t k = 0; k < 4; ++k) ++edges[{q[k], q[(k + 1) % 4]}];
  for (auto const& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    REQUIRE(back != edges.end());
    CHECK(back->second == count);
  }
  // faces look outwards; the surface is cut off where it is bent
  CHECK(volume_inside(border) == Approx(fluid.volume()).epsilon(0.04));
}

TEST_CASE("a fluid of a scene has the same bits with threads, after a reset, and from what was kept") {
  auto sim = scene(tank());
  sim.init();
  for (int k = 0; k < 8; ++k) sim.animate(0.01);
  const std::vector<double> flow = sim.at<"water">().get<Fluid3D<Vec3d>>().flow;

  auto threaded = scene(tank(), 3);
  threaded.init();
  for (int k = 0; k < 8; ++k) threaded.animate(0.01);
  CHECK(threaded.at<"water">().get<Fluid3D<Vec3d>>().flow == flow);

  sim.reset();
  for (int k = 0; k < 8; ++k) sim.animate(0.01);
  CHECK(sim.at<"water">().get<Fluid3D<Vec3d>>().flow == flow);

  Fluid3D<Vec3d> kept = tank();
  kept.flow = flow;
  auto goesOn = scene(kept);
  goesOn.init(0.08, 8);
  sim.animate(0.01);
  goesOn.animate(0.01);
  CHECK(goesOn.at<"water">().get<Fluid3D<Vec3d>>().flow == sim.at<"water">().get<Fluid3D<Vec3d>>().flow);
}

TEST_CASE("a source pours from tstart to tstop") {
  Simulation sim{node<"root">(Gravity{{0, -9.81, 0}},
                              node<"water">(Fluid2D<Vec2d>{.nx = 26,
                                                           .ny = 26,
                                                           .cellwidth = 0.1,
                                                           .tstart = 0.05,
                                                           .tstop = 0.1,
                                                           .source = {0, 0.6},
                                                           .sourceRadius = 0.3,
                                                           .sourceVelocity = {0, -2}}))};
  sim.init();
  Fluid2D<Vec2d>& fluid = sim.at<"water">().get<Fluid2D<Vec2d>>();
  const double start = fluid.volume();
  for (int k = 0; k < 5; ++k) sim.animate(0.01);
  CHECK(fluid.volume() == Approx(start).epsilon(1e-8));
  for (int k = 0; k < 5; ++k) sim.animate(0.01);
  const double poured = fluid.volume();
  CHECK(poured - start > 0.25);  // the disc alone has 0.28
  for (int k = 0; k < 5; ++k) sim.animate(0.01);
  CHECK(fluid.volume() == Approx(poured).epsilon(1e-8));
}

TEST_CASE("a fluid says when its step is too long, and goes on") {
  auto sim = scene(tank());
  sim.init();
  for (int k = 0; k < 12; ++k) sim.animate(0.2);
  REQUIRE(sim.warnings().list().size() >= 1);
  CHECK_THAT(std::string(sim.warnings().list()[0].message), Catch::Contains("more than 5 cells in a step"));
}

TEST_CASE("what Fluid2D and Fluid3D refuse") {
  auto refused = [](auto change) {
    return error_of([&] {
      Fluid3D<Vec3d> fluid = tank();
      change(fluid);
      auto sim = scene(fluid);
      sim.init();
      sim.animate(0.01);
    });
  };
  CHECK(refused([](Fluid3D<Vec3d>&) {}).empty());
  CHECK_THAT(refused([](Fluid3D<Vec3d>& f) { f.nx = f.ny = f.nz = 10000; }),
             Catch::Contains("/root/water: Fluid3D") && Catch::Contains("would take"));
  CHECK_THAT(refused([](Fluid3D<Vec3d>& f) { f.ny = 2; }),
             Catch::Contains("ny") && Catch::Contains("at least 3"));
  CHECK_THAT(refused([](Fluid3D<Vec3d>& f) { f.nz = -5; }), Catch::Contains("nz"));
  CHECK_THAT(refused([](Fluid3D<Vec3d>& f) { f.cellwidth = 0; }), Catch::Contains("cellwidth"));
  CHECK_THAT(refused([](Fluid3D<Vec3d>& f) { f.height = std::nan(""); }), Catch::Contains("height"));
  CHECK_THAT(refused([](Fluid3D<Vec3d>& f) { f.center[1] = std::nan(""); }), Catch::Contains("center"));
  CHECK_THAT(refused([](Fluid3D<Vec3d>& f) { f.dir = {0, 0, 0}; }), Catch::Contains("dir is zero"));
  CHECK_THAT(refused([](Fluid3D<Vec3d>& f) { f.height = -3; }),
             Catch::Contains("there is no fluid in the grid"));
  CHECK_THAT(refused([](Fluid3D<Vec3d>& f) { f.density = 0; }), Catch::Contains("density"));
  CHECK_THAT(refused([](Fluid3D<Vec3d>& f) { f.viscosity = -1; }), Catch::Contains("viscosity"));
  CHECK_THAT(refused([](Fluid3D<Vec3d>& f) { f.tolerance = 0; }), Catch::Contains("tolerance"));
  CHECK_THAT(refused([](Fluid3D<Vec3d>& f) {
               f.obstacle.push_back({0, 0, 0, 1, -1, 1});
             }),
             Catch::Contains("obstacle[0] is empty"));
  CHECK_THAT(refused([](Fluid3D<Vec3d>& f) {
               f.obstacle.push_back({-9, -9, -9, 9, 9, 9});
             }),
             Catch::Contains("there is no fluid"));
}

}  // namespace test_fluid_components
