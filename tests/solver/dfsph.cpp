// SPDX-License-Identifier: BSL-1.0
// Incompressible fluids of particles: momentum, density, hydrostatic pressure, substeps, bad input.
#include "catch.hpp"
#include "error_of.hpp"
#include "fluid_tank.hpp"

#include <sinew/control/threads.hpp>
#include <sinew/force/fluid_boundary.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/solver/dfsph.hpp>

namespace test_dfsph {

using namespace sinew;
using tank::Points;

TEST_CASE("two blocks of a fluid meet: momentum stays to rounding, the density to 0.1 %") {
  const double d = 0.1;
  Points x = tank::block(d, 5, 5, 5), v(x.size(), {2, 0, 0});
  for (auto const& p : tank::block(d, 5, 5, 5, {0.6, 0.03, 0.02})) x.push_back(p), v.push_back({-1, 0, 0});
  Simulation sim{node<"root">(DFSPHSolver{.radius = 2 * d},
                              MechanicalObject<Vec3d>{.position = x, .velocity = v},
                              UniformMass<Vec3d>{.vertexMass = 1000 * d * d * d})};
  sim.init();
  const Eigen::Vector3d before = tank::sum(v);
  const double energy = sim.kineticEnergy();
  double worst = 0;
  while (sim.time() < 0.25) {
    sim.animate(0.002);
    worst =
        std::max(worst, tank::compression(tank::densities(sim.root().state().position, d * d * d, 2 * d)));
  }
  CHECK((tank::sum(sim.root().state().velocity) - before).norm() < 1e-11 * double(x.size()));
  // The solver leaves a mean of 1e-4 of what a step of the linear model predicts; what positions add to that
  // is of the order of the square of the step, (v dt / d)^2 = 1.6e-3 where particles are fastest, of which a
  // part is compression.
  CHECK(worst < 1e-3);
  CHECK(worst > 0);  // they have met
  CHECK(sim.kineticEnergy() < energy);
}

TEST_CASE("a column comes to rest, walls bear its weight to 0.5 %, and the pressure rises by the depth",
          "[long]") {
  const double d = 0.05, g = 9.81, density = 1000, mass = density * d * d * d;
  const int n = 6, height = 8;
  const Points x = tank::block(d, n, height, n);
  Simulation sim{
      node<"root">(Gravity{{0, -g, 0}},
                   node<"water">(DFSPHSolver{.radius = 2 * d, .density = density},
                                 MechanicalObject<Vec3d>{.position = x},
                                 UniformMass<Vec3d>{.vertexMass = mass},
                                 SPHFluidForceField<Vec3d>{.radius = 2 * d,
                                                           .mass = mass,
                                                           .density = density,
                                                           .viscosity = 50,
                                                           .kernelType = 1,
                                                           .pressureType = 0,
                                                           .viscosityType = 2}),
                   node<"walls">(MechanicalObject<Vec3d>{.position = tank::walls(d, n, height + 4, n)},
                                 FluidBoundary<Vec3d>{}))};
  sim.init();
  auto& water = sim.at<"water">();
  auto& solver = water.first<role::OdeSolver>();
  auto& walls = sim.at<"walls">().first<role::ForceField>();
  while (sim.time() < 3) sim.animate(0.01);

  Eigen::Vector3d force(0, 0, 0);
  double sy = 0, sp = 0, syy = 0, syp = 0, worst = 0;
  int count = 0;
  const WendlandKernel<double> kernel(2 * d, tank::wendland_factor);
  const int steps = 100;
  for (int step = 0; step < steps; ++step) {
    sim.animate(0.01);
    force += tank::sum(walls.forces) / steps;
    worst = std::max(worst, tank::compression(solver.flow.densities));
    if (step % 10 != 0) continue;
    auto const& now = water.state().position;
    for (std::size_t i = 0; i < now.size(); ++i) {
      auto inside = [&](double at, double size) { return at > 1.6 * d && at < size - 1.6 * d; };
      if (!inside(now[i][0], n * d) || !inside(now[i][2], n * d) || !inside(now[i][1], height * d)) continue;
      // by the virial of its forces the pressure is density k_i C_i, C_i = -1/3 sum_j V_j x_ij.grad W_ij
      double c = 0;
      for (auto const& other : now)
        if (const double r = (other - now[i]).norm(); r < 2 * d && r > 0)
          c -= d * d * d * r * r * kernel.densitySlope(r / (2 * d)) / 3;
      const double y = now[i][1], p = density * solver.pressures[i] * c;
      sy += y, sp += p, syy += y * y, syp += y * p, ++count;
    }
  }
  const double weight = mass * g * double(x.size());
  CHECK(-force[1] == Approx(weight).epsilon(0.005));
  CHECK(std::hypot(force[0], force[2]) < 0.005 * weight);
  CHECK(worst < 1e-3);
  for (auto const& v : water.state().velocity) CHECK(v.norm() < 0.02 * std::sqrt(2 * g * height * d));
  // dp/dy = -density g, as well as a few particles across a column tell it
  REQUIRE(count > 100);
  const double slope = (count * syp - sy * sp) / (count * syy - sy * sy);
  CHECK(slope == Approx(-density * g).epsilon(0.05));
}

TEST_CASE("what falls freely has no pressure") {
  const double d = 0.1;
  const Points x = tank::block(d, 3, 3, 3);
  Simulation sim{node<"root">(Gravity{{0, -10, 0}},
                              DFSPHSolver{.radius = 2 * d},
                              MechanicalObject<Vec3d>{.position = x},
                              UniformMass<Vec3d>{.vertexMass = 1000 * d * d * d})};
  sim.init();
  for (int i = 0; i < 10; ++i) sim.animate(0.01);
  for (std::size_t i = 0; i < x.size(); ++i) {
    CHECK((sim.root().state().velocity[i] - Eigen::Vector3d(0, -1, 0)).norm() < 1e-12);
    // symplectic Euler: h^2 g n (n + 1) / 2
    CHECK((sim.root().state().position[i] - x[i] - Eigen::Vector3d(0, -0.055, 0)).norm() < 1e-12);
  }
}

TEST_CASE("a step beyond the CFL limit is divided, and refused where it takes too many") {
  const double d = 0.1;
  auto fast = [&](int most) {
    Points x{{0, 0, 0}, {0.5, 0, 0}};
    return Simulation{node<"root">(DFSPHSolver{.radius = 2 * d, .maxSubsteps = most},
                                   MechanicalObject<Vec3d>{.position = x, .velocity = {{10, 0, 0}}},
                                   UniformMass<Vec3d>{.vertexMass = 1000 * d * d * d})};
  };
  auto sim = fast(20);
  sim.init();
  sim.animate(0.03);  // 0.3 m, and 0.04 m at most in a substep
  CHECK(sim.root().first<role::OdeSolver>().substeps == 8);
  CHECK(sim.root().state().position[0][0] == Approx(0.3));
  auto refused = fast(7);
  refused.init();
  CHECK_THAT(error_of([&] { refused.animate(0.03); }),
             Catch::Contains("CFL") && Catch::Contains("/root: DFSPHSolver") && Catch::Contains("0.028 s"));
}

TEST_CASE("threads find the same bits, and a reset goes back to them", "[long]") {
  const double d = 0.1;
  auto run = [&](auto... threads) {
    Simulation sim{node<"root">(threads...,
                                Gravity{{0, -9.81, 0}},
                                node<"water">(DFSPHSolver{.radius = 2 * d},
                                              MechanicalObject<Vec3d>{.position = tank::block(d, 12, 14, 12)},
                                              UniformMass<Vec3d>{.vertexMass = 1000 * d * d * d}),
                                node<"walls">(MechanicalObject<Vec3d>{.position = tank::walls(d, 12, 16, 12)},
                                              FluidBoundary<Vec3d>{}))};
    sim.init();
    for (int i = 0; i < 5; ++i) sim.animate(0.01);
    const auto first = sim.template at<"water">().state().position;
    sim.reset();
    for (int i = 0; i < 5; ++i) sim.animate(0.01);
    CHECK(sim.template at<"water">().state().position == first);
    return first;
  };
  const auto one = run();
  CHECK(run(Threads{.count = 3}) == one);
}

TEST_CASE("single precision, forces that are kept, and particles that are held") {
  const double d = 0.1;
  std::vector<Eigen::Vector3f> x;
  for (auto const& p : tank::block(d, 3, 4, 3)) x.push_back(p.cast<float>());
  Simulation sim{
      node<"root">(Gravity{{0, -10, 0}},
                   DFSPHSolver{.radius = 2 * d},
                   MechanicalObject<Vec3f>{.position = x},
                   UniformMass<Vec3f>{.vertexMass = 1},
                   FixedConstraint<Vec3f>{.indices = {4}},
                   PlaneForceField<Vec3f>{.normal = {0, 1, 0}, .d = 0.05, .stiffness = 1000, .damping = 0})};
  sim.init();
  sim.keepForces(true);
  for (int i = 0; i < 20; ++i) {
    const auto before = sim.root().state().velocity;
    sim.animate(0.005);
    auto const& s = sim.root().state();
    for (std::size_t k = 0; k < x.size(); ++k)
      CHECK(((s.velocity[k] - before[k]) / 0.005f - s.applied[k] - s.reaction[k]).norm() < 1e-2f);
  }
  CHECK(sim.root().state().position[4] == x[4]);
}

TEST_CASE("what is no fluid is refused with what and where") {
  auto wrong = [](DFSPHSolver solver, Points const& x, double mass) {
    Simulation sim{
        node<"root">(solver, MechanicalObject<Vec3d>{.position = x}, UniformMass<Vec3d>{.vertexMass = mass})};
    return error_of([&] { sim.init(); });
  };
  const Points two{{0, 0, 0}, {0.1, 0, 0}};
  CHECK(wrong({.radius = 0.2}, two, 1) == "");
  CHECK_THAT(wrong({.radius = 0}, two, 1), Catch::Contains("radius") && Catch::Contains("/root"));
  CHECK_THAT(wrong({.radius = 5}, two, 1),
             Catch::Contains("radius is 5 m") && Catch::Contains("0.1 m apart"));
  CHECK_THAT(wrong({.radius = 0.2, .density = -1}, two, 1), Catch::Contains("density"));
  CHECK_THAT(wrong({.radius = 0.2, .cflFactor = 2}, two, 1), Catch::Contains("cflFactor"));
  CHECK_THAT(wrong({.radius = 0.2, .maxError = std::nan("")}, two, 1), Catch::Contains("maxError"));
  CHECK_THAT(wrong({.radius = 0.2}, {{0, 0, 0}, {0, 0, 0}}, 1),
             Catch::Contains("particles 0 and 1 are in one place"));

  Simulation massless{node<"root">(DFSPHSolver{.radius = 0.2}, MechanicalObject<Vec3d>{.position = two})};
  CHECK_THAT(error_of([&] { massless.init(); }), Catch::Contains("UniformMass"));
  Simulation several{node<"root">(DFSPHSolver{.radius = 0.2},
                                  node<"a">(MechanicalObject<Vec3d>{.position = two}, UniformMass<Vec3d>{}),
                                  node<"b">(MechanicalObject<Vec3d>{.position = two}, UniformMass<Vec3d>{}))};
  CHECK_THAT(error_of([&] { several.init(); }), Catch::Contains("2 states"));
  Simulation rigid{node<"root">(DFSPHSolver{.radius = 0.2},
                                MechanicalObject<Rigid3d>{.position = {Rigid3d::zero()}},
                                UniformMass<Rigid3d>{})};
  CHECK_THAT(error_of([&] { rigid.init(); }), Catch::Contains("solver of their own"));
}

}  // namespace test_dfsph
