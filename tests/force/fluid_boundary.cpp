// SPDX-License-Identifier: BSL-1.0
// Fluids that push bodies, and bodies that push fluids: momentum, Archimedes, the order of solvers.
#include "catch.hpp"
#include "error_of.hpp"
#include "fluid_tank.hpp"

#include <sinew/force/fluid_boundary.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/solver/dfsph.hpp>

namespace test_fluid_boundary {

using namespace sinew;
using tank::Points;

namespace {

/// The surface of a cube of n^3 points around the origin.
Points shell(double d, int n) {
  Points x;
  const double half = (n - 1) * d / 2;
  for (auto const& p : tank::block(d, n, n, n, Eigen::Vector3d::Constant(-n * d / 2)))
    if (p.cwiseAbs().maxCoeff() > half - d / 4) x.push_back(p);
  return x;
}

// a block of a fluid hits a rigid body, and one of springs
template <class Solver, class... Forces>
void check_momentum(Solver const& solver, double dt, double d, Forces const&... forces) {
  const double mass = 1000 * d * d * d;
  const Points x = tank::block(d, 4, 4, 4, {-2 * d, -2 * d, 0});
  Rigid3d::Coord body = Rigid3d::zero();
  body.center = {0.5 * d, 0, -2.6 * d};
  Points soft;
  for (auto const& p : shell(d, 3)) soft.push_back(p + Eigen::Vector3d(0, 0, 6.2 * d));
  std::vector<Edge> edges;
  for (int i = 0; i < int(soft.size()); ++i)
    for (int j = 0; j < i; ++j)
      if ((soft[std::size_t(i)] - soft[std::size_t(j)]).norm() < 1.8 * d) edges.push_back({j, i});
  Simulation sim{node<"root">(
      node<"water">(solver,
                    MechanicalObject<Vec3d>{.position = x, .velocity = {{0, 0, -1}}},
                    UniformMass<Vec3d>{.vertexMass = mass},
                    forces...),
      node<"rigid">(EulerExplicitSolver{},
                    MechanicalObject<Rigid3d>{.position = {body}},
                    UniformMass<Rigid3d>{.vertexMass = Rigid3d::MassType{.mass = 40 * mass}},
                    node<"surface">(MechanicalObject<Vec3d>{.position = shell(d, 4)},
                                    RigidMapping<Rigid3d, Vec3d>{},
                                    FluidBoundary<Vec3d>{})),
      node<"soft">(EulerExplicitSolver{},
                   MeshTopology{.edges = edges},
                   MechanicalObject<Vec3d>{.position = soft, .velocity = {{0, 0, -3}}},
                   UniformMass<Vec3d>{.vertexMass = mass},
                   MeshSpringForceField<Vec3d>{.stiffness = 200 * mass},
                   node<"surface">(
                       MechanicalObject<Vec3d>{}, IdentityMapping<Vec3d, Vec3d>{}, FluidBoundary<Vec3d>{})))};
  sim.init();
  auto momentum = [&] {
    return Eigen::Vector3d(mass * tank::sum(sim.template at<"water">().state().velocity) +
                           mass * tank::sum(sim.template at<"soft">().state().velocity) +
                           40 * mass * sim.template at<"rigid">().state().velocity[0].template head<3>());
  };
  const Eigen::Vector3d before = momentum();
  while (sim.time() < 2 * d) sim.animate(dt);
  CHECK((momentum() - before).norm() < 1e-12 * before.norm() * double(x.size()));
  CHECK(sim.template at<"rigid">().state().velocity[0].norm() > 0.01);  // all have met
  CHECK((tank::sum(sim.template at<"soft">().state().velocity) / double(soft.size()) -
         Eigen::Vector3d(0, 0, -3))
            .norm() > 0.01);
}

}  // namespace

TEST_CASE("fluid, rigid body and soft body keep their momentum to rounding, by both kinds of fluid") {
  const double d = 0.1;
  check_momentum(DFSPHSolver{.radius = 2 * d}, 0.002, d);
  const SPHFluidForceField<Vec3d> fluid{
      .radius = 2 * d, .mass = 1000 * d * d * d, .pressure = 400, .density = 1000};
  auto tense = fluid, viscous = fluid, adhesive = fluid;
  tense.viscosity = 10, tense.surfaceTension = 1;
  tense.kernelType = 1, tense.surfaceTensionType = 2;
  viscous.viscosity = 10;
  viscous.kernelType = 0, viscous.viscosityType = 2;
  adhesive.surfaceTension = 20, adhesive.adhesion = 10;
  adhesive.kernelType = 1, adhesive.viscosityType = 0, adhesive.surfaceTensionType = 3;
  for (auto const& forces : {tense, viscous, adhesive})
    check_momentum(EulerExplicitSolver{}, 0.001, d, forces);
}

TEST_CASE("the pressure of SPHFluidForceField at a wall is that of its sums over all pairs") {
  const double d = 0.1, radius = 2 * d, mass = 1000 * d * d * d, pressure = 50;
  const Points x = tank::block(d, 3, 3, 3, {0, 0, 0}), wall = tank::block(d, 5, 1, 5, {-d, -0.9 * d, -d});
  Simulation sim{
      node<"root">(node<"water">(EulerExplicitSolver{},
                                 MechanicalObject<Vec3d>{.position = x},
                                 UniformMass<Vec3d>{.vertexMass = mass},
                                 SPHFluidForceField<Vec3d>{.radius = radius,
                                                           .mass = mass,
                                                           .pressure = pressure,
                                                           .density = 1000,
                                                           .viscosity = 0,
                                                           .kernelType = 1}),
                   node<"wall">(MechanicalObject<Vec3d>{.position = wall}, FluidBoundary<Vec3d>{}))};
  sim.init();
  sim.animate(1e-6);
  const CubicKernels<double> kernel(radius);
  std::vector<double> weight, push;
  auto q = [&](Eigen::Vector3d const& a, Eigen::Vector3d const& b) {
    return std::min(1.0, (a - b).norm() / radius);
  };
  for (auto const& a : wall) {
    double around = 0;
    for (auto const& b : wall) around += kernel.density(q(a, b));
    weight.push_back(1000 / around);
  }
  for (auto const& a : x) {
    double rho = 0;
    for (auto const& b : x) rho += mass * kernel.density(q(a, b));
    for (std::size_t k = 0; k < wall.size(); ++k) rho += weight[k] * kernel.density(q(a, wall[k]));
    push.push_back(pressure * (rho - 1000) / (rho * rho));
  }
  auto const& forces = sim.at<"wall">().first<role::ForceField>().forces;
  for (std::size_t k = 0; k < wall.size(); ++k) {
    Eigen::Vector3d expected(0, 0, 0);
    for (std::size_t i = 0; i < x.size(); ++i)
      expected -= mass * weight[k] * push[i] * kernel.densitySlope(std::max(1e-9, q(wall[k], x[i]))) *
                  (wall[k] - x[i]);
    CHECK((forces[k] - expected).norm() < 1e-10);
  }
}

TEST_CASE("a box of half the density of the water floats with half of it below the surface", "[long]") {
  const double d = 0.05, g = 9.81, mass = 1000 * d * d * d;
  const int n = 10, height = 5;
  // the surface of the fluid is half a distance from its particles, and a distance from those of the box
  const double side = 4 * d, floats = 500 * side * side * side;
  Points x;
  for (auto const& p : tank::block(d, n, height, n))
    if ((p - Eigen::Vector3d(n * d / 2, height * d, n * d / 2)).cwiseAbs().maxCoeff() > 2 * d) x.push_back(p);
  Rigid3d::Coord body = Rigid3d::zero();
  body.center = {n * d / 2, height * d, n * d / 2};
  Simulation sim{
      node<"root">(Gravity{{0, -g, 0}},
                   node<"water">(DFSPHSolver{.radius = 2 * d},
                                 MechanicalObject<Vec3d>{.position = x},
                                 UniformMass<Vec3d>{.vertexMass = mass},
                                 SPHFluidForceField<Vec3d>{.radius = 2 * d,
                                                           .mass = mass,
                                                           .density = 1000,
                                                           .viscosity = 50,
                                                           .kernelType = 1,
                                                           .pressureType = 0,
                                                           .viscosityType = 2}),
                   node<"walls">(MechanicalObject<Vec3d>{.position = tank::walls(d, n, height + 4, n)},
                                 FluidBoundary<Vec3d>{}),
                   node<"box">(EulerExplicitSolver{},
                               MechanicalObject<Rigid3d>{.position = {body}},
                               UniformMass<Rigid3d>{.vertexMass = Rigid3d::MassType{.mass = floats}},
                               // upright: only up and down
                               PartialFixedConstraint<Rigid3d>{
                                   .indices = {0}, .fixedDirections = {true, false, true, true, true, true}},
                               node<"surface">(MechanicalObject<Vec3d>{.position = shell(d, 4)},
                                               RigidMapping<Rigid3d, Vec3d>{},
                                               FluidBoundary<Vec3d>{})))};
  sim.init();
  auto& surface = sim.at<"box/surface">().first<role::ForceField>();
  while (sim.time() < 2) sim.animate(0.005);
  double centre = 0, lift = 0;
  const int steps = 100;
  for (int i = 0; i < steps; ++i) {
    sim.animate(0.005);
    centre += sim.at<"box">().state().position[0].center[1] / steps;
    lift += tank::sum(surface.forces)[1] / steps;
  }
  CHECK(lift == Approx(floats * g).epsilon(0.02));  // at rest
  // water below the level: what it displaces, and its own volume
  const double level = (double(x.size()) * d * d * d + floats / 1000) / (n * d * n * d);
  const double below = level - (centre - side / 2);
  CAPTURE(level / d, centre / d);
  CHECK(below == Approx(floats / (1000 * side * side)).margin(0.3 * d));  // to a third of the resolution
}

TEST_CASE("a body that moves before the fluid, or with it, is refused") {
  const Points two{{0, 0, 0}, {0.1, 0, 0}}, other{{1, 0, 0}};
  auto water = node<"water">(DFSPHSolver{.radius = 0.2},
                             MechanicalObject<Vec3d>{.position = two},
                             UniformMass<Vec3d>{.vertexMass = 1});
  auto body = node<"body">(EulerExplicitSolver{},
                           MechanicalObject<Vec3d>{.position = other},
                           UniformMass<Vec3d>{},
                           FluidBoundary<Vec3d>{});
  Simulation right{node<"root">(water, body)};
  CHECK(error_of([&] { right.init(); }) == "");
  Simulation wrong{node<"root">(body, water)};
  CHECK_THAT(error_of([&] { wrong.init(); }),
             Catch::Contains("/root/water") && Catch::Contains("/root/body"));
}

}  // namespace test_fluid_boundary
