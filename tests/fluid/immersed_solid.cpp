// SPDX-License-Identifier: BSL-1.0
// Solids in fluids on grids: lift, floating, added mass, volume, momentum, bad input.
#include "catch.hpp"
#include "error_of.hpp"
#include "immersed_shapes.hpp"

#include <sinew/fluid/fluid2d.hpp>
#include <sinew/fluid/fluid3d.hpp>
#include <sinew/force/immersed_solid.hpp>
#include <sinew/mechanics.hpp>

namespace test_immersed_solid {

using namespace sinew;
using Eigen::Vector3d;

namespace {

constexpr double g = 9.81, rho = 1000;

Vector3d sum(std::vector<Vector3d> const& all) {
  Vector3d total(0, 0, 0);
  for (auto const& v : all) total += v;
  return total;
}

// how far the lift on a fixed sphere is from the weight of the water that it displaces, relative
double lift_error(int n) {
  const Mesh ball = shapes::sphere(0.3, 4, {0.013, 0.017, -0.011});
  Simulation sim{
      node<"root">(Gravity{{0, -g, 0}},
                   node<"water">(Fluid3D<Vec3d>{
                       .nx = n + 2, .ny = n + 2, .nz = n + 2, .cellwidth = 1. / n, .height = 0.9 * n}),
                   node<"ball">(MeshTopology{.triangles = ball.triangles},
                                MechanicalObject<Vec3d>{.position = ball.positions},
                                ImmersedSolid<Vec3d>{}))};
  sim.init();
  sim.animate(0.01);
  const Vector3d lift = sum(sim.template at<"ball">().template get<ImmersedSolid<Vec3d>>().body.forces);
  const double weight = rho * g * shapes::volume(ball);
  CHECK(std::abs(lift[0]) < 1e-4 * weight);
  CHECK(std::abs(lift[2]) < 1e-4 * weight);
  CHECK(sim.kineticEnergy() < 1e-8);
  return std::abs(lift[1] / weight - 1);
}

}  // namespace

TEST_CASE("the lift on a fixed sphere is the weight of the water that it displaces") {
  const double coarse = lift_error(10), fine = lift_error(20);
  CAPTURE(coarse, fine);
  CHECK(coarse < 0.08);  // 6 cells across: 0.6 (h / R)^2
  CHECK(fine < coarse / 3);
}

TEST_CASE("a sphere that is let go has the acceleration of its weight, its lift and its added mass") {
  // (m - rho V) g = (m + C rho V) a with C = 1/2. A shell of five radii around it makes that
  // 1/2 (5^3 + 2) / (5^3 - 1) = 0.512, and walls of a cube are farther away.
  const Mesh ball = shapes::sphere(0.1, 3);
  const double volume = shapes::volume(ball), dt = 1e-3;
  double displaced = 1;  // of the volume, as the cells see it
  for (const double part : {1., 0.02, 3.}) {
    Simulation sim{node<"root">(
        Gravity{{0, -g, 0}},
        node<"water">(Fluid3D<Vec3d>{.nx = 42, .ny = 42, .nz = 42, .cellwidth = 1. / 40, .height = 0}),
        node<"ball">(EulerExplicitSolver{},
                     MechanicalObject<Rigid3d>{.position = {Rigid3d::zero()}},
                     UniformMass<Rigid3d>{.vertexMass = Rigid3d::MassType{.mass = part * rho * volume}},
                     node<"skin">(MeshTopology{.triangles = ball.triangles},
                                  MechanicalObject<Vec3d>{.position = ball.positions},
                                  RigidMapping<Rigid3d, Vec3d>{},
                                  ImmersedSolid<Vec3d>{})))};
    sim.init();
    sim.animate(dt);
    const double a = sim.at<"ball">().state().velocity[0][1] / dt;
    CAPTURE(part, a, displaced);
    if (part == 1.) {
      displaced += 1.5 * a / g;
      CHECK(displaced == Approx(1).margin(0.07));  // 8 cells across, (h / R)^2 = 0.06
    } else {
      // of the volume that the cells see
      CHECK(((displaced - part) * g / a - part) / displaced == Approx(0.506).margin(0.02));
    }
    // what the fluid foresaw is what the body did
    auto const& body = sim.at<"water">().get<Fluid3D<Vec3d>>().bodies[0];
    CHECK((body.motion - sim.at<"ball">().state().velocity[0]).norm() < 1e-9);
  }
}

TEST_CASE("a box that is lighter than water floats at Archimedes' depth, level, however light", "[long]") {
  for (const double density : {500., 50.}) {
    const double w = 0.3, h = 0.2, mass = density * w * h;
    const std::vector<Eigen::Vector2d> corners{
        {-w / 2, -h / 2}, {w / 2, -h / 2}, {w / 2, h / 2}, {-w / 2, h / 2}};
    Rigid2d::Coord start = Rigid2d::zero();
    start.center = {0.03, 0.13};
    start.orientation = 0.1;
    Simulation sim{node<"root">(
        Gravity{{0, -g, 0}},
        node<"water">(
            Fluid2D<Vec2d>{.nx = 34, .ny = 34, .cellwidth = 1. / 32, .height = 16.5, .viscosity = 5}),
        node<"box">(EulerExplicitSolver{},
                    MechanicalObject<Rigid2d>{.position = {start}},
                    UniformMass<Rigid2d>{.vertexMass = Rigid2d::MassType{.mass = mass,
                                                                         .inertia = Mat<double, 1>(
                                                                             mass * (w * w + h * h) / 12)}},
                    node<"skin">(MeshTopology{.edges = {{0, 1}, {1, 2}, {2, 3}, {3, 0}}},
                                 MechanicalObject<Vec2d>{.position = corners},
                                 RigidMapping<Rigid2d, Vec2d>{},
                                 ImmersedSolid<Vec2d>{})))};
    sim.init();
    double height = 0, turn = 0, lift = 0;
    const int steps = 1600, last = 400;
    for (int k = 0; k < steps; ++k) {
      sim.animate(0.005);
      if (k < steps - last) continue;
      height += sim.at<"box">().state().position[0].center[1] / last;
      turn += sim.at<"box">().state().position[0].orientation / last;
      lift += sim.at<"box/skin">().get<ImmersedSolid<Vec2d>>().body.load[1] / last;
    }
    const double level = -0.5 + sim.at<"water">().get<Fluid2D<Vec2d>>().volume() + mass / rho;
    const double depth = level - (height - h / 2);
    CAPTURE(density, level, height, depth * 32, mass / (rho * w) * 32, turn);
    CHECK(depth == Approx(mass / (rho * w)).margin(0.25 / 32));  // a quarter of a cell
    CHECK(std::abs(turn) < 0.03);
    CHECK(lift == Approx(mass * g).epsilon(0.02));
  }
}

TEST_CASE("a piston that moves through a tank keeps the volume of the water, and lifts it") {
  // It begins behind the wall at the left, so that only its front is in the tank. The volume is kept by the
  // equations of pressure alone.
  const double speed = 0.1, dt = 0.01;
  const std::vector<Eigen::Vector2d> corners{{-2, -2}, {-0.4, -2}, {-0.4, 2}, {-2, 2}};
  Simulation sim{node<"root">(
      node<"water">(
          Gravity{{0, -g, 0}},
          Fluid2D<Vec2d>{.nx = 42, .ny = 42, .cellwidth = 1. / 40, .height = 20.5, .keepVolume = false}),
      node<"piston">(EulerExplicitSolver{},
                     MeshTopology{.edges = {{0, 1}, {1, 2}, {2, 3}, {3, 0}}},
                     MechanicalObject<Vec2d>{.position = corners, .velocity = {{speed, 0}}},
                     UniformMass<Vec2d>{.vertexMass = 1e12},
                     ImmersedSolid<Vec2d>{}))};
  sim.init();
  Fluid2D<Vec2d>& water = sim.at<"water">().get<Fluid2D<Vec2d>>();
  sim.animate(dt);
  const double volume = water.volume();
  CHECK(volume == Approx(0.9 * 0.5).epsilon(1e-3));
  double push = 0, widths = 0;
  const int steps = 300;
  for (int k = 1; k < steps; ++k) {
    sim.animate(dt);
    if (k >= steps - 100) push += sim.at<"piston">().get<ImmersedSolid<Vec2d>>().body.load[0] / 100;
    if (k >= steps - 100) widths += (0.9 - speed * (k + 1) * dt) / 100;
  }
  CHECK(water.volume() == Approx(volume).epsilon(0.01));
  CHECK(water.grid.divergence() < 1e-4);
  // the piston holds back water of the depth V / width: rho g depth^2 / 2 a metre
  const double depth = volume / widths;
  CHECK(-push == Approx(rho * g * depth * depth / 2).epsilon(0.03));
}

TEST_CASE("a body that is pushed shares its momentum with the fluid") {
  fluid::GridFluidSettings<2> settings;
  settings.cells = {32, 32};
  settings.periodic = {true, true};
  settings.cellWidth = 1. / 32;
  settings.hasSurface = false;
  settings.tolerance = 1e-12;
  fluid::GridFluid<double, 2> water;
  water.init("periodic", settings);
  water.begin();
  ImmersedBody body;
  body.dimension = 2;
  body.elements = {{0, 1, -1}, {1, 2, -1}, {2, 0, -1}};
  body.positions = {{0.3, 0.32, 0}, {0.72, 0.41, 0}, {0.47, 0.7, 0}};
  body.velocities.assign(3, Vector3d::Zero());
  body.rigid = true;
  body.centre = {0.5, 0.48, 0};
  body.motion << 1, 0.3, 0, 0, 0, 2;
  const double mass = 40, inertia = 0.8;
  body.response.diagonal() << 1 / mass, 1 / mass, 0, 0, 0, 1 / inertia;
  const auto before = body.motion;
  water.bodies = {body};
  water.reserveForBodies();
  water.step(1e-9, {0, 0}, {});  // so short that nothing is carried along
  auto const& after = water.bodies[0];
  Eigen::Vector2d carried(0, 0);
  water.grid().forCells({}, [&](std::ptrdiff_t i) {
    const auto k = std::size_t(i);
    for (std::size_t c = 0; c < 2; ++c)
      carried[Eigen::Index(c)] +=
          rho * water.cellVolume() * water.cut.open[c][k] * water.velocity.value[c][k];
  });
  CHECK((mass * after.motion.head<2>() + carried - mass * before.head<2>()).norm() < 1e-6 * mass);
  CHECK((before - after.motion).head<2>().norm() > 0.5);  // it has given most of it away
  // the motion, the load and the forces on the points are one
  CHECK((after.motion - before - after.response * after.load * 1e-9).norm() < 1e-12);
  Vector3d force(0, 0, 0), moment(0, 0, 0);
  for (std::size_t k = 0; k < 3; ++k) {
    force += after.forces[k];
    moment += (after.positions[k] - after.centre).cross(after.forces[k]);
  }
  CHECK((force - after.load.head<3>()).norm() < 1e-9 * force.norm());
  CHECK((moment - after.load.tail<3>()).norm() < 1e-9 * force.norm());
}

TEST_CASE("a body does not feel its own acceleration twice: at rest on a spring it bears weight less lift",
          "[long]") {
  const Mesh cube = shapes::box({-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2});
  const double volume = 0.4 * 0.4 * 0.4, mass = 2500 * volume, stiffness = 2e5;
  Simulation sim{node<"root">(
      Gravity{{0, -g, 0}},
      node<"water">(Fluid3D<Vec3d>{.nx = 18, .ny = 18, .nz = 18, .cellwidth = 1. / 16, .height = 14.5}),
      node<"ball">(
          EulerExplicitSolver{},
          MechanicalObject<Rigid3d>{.position = {Rigid3d::zero()}},
          UniformMass<Rigid3d>{
              .vertexMass =
                  Rigid3d::MassType{.mass = mass, .inertia = Eigen::Matrix3d::Identity() * mass * 0.16 / 6}},
          UniformVelocityDampingForceField<Rigid3d>{.dampingCoefficient = 2000},
          RestShapeSpringsForceField<Rigid3d>{.stiffness = {stiffness}, .angularStiffness = {1e5}},
          node<"skin">(MeshTopology{.quads = cube.quads},
                       MechanicalObject<Vec3d>{.position = cube.positions},
                       RigidMapping<Rigid3d, Vec3d>{},
                       ImmersedSolid<Vec3d>{})))};
  sim.init();
  for (int k = 0; k < 600; ++k) sim.animate(0.002);
  const double sunk = -sim.at<"ball">().state().position[0].center[1];
  CHECK(sunk * stiffness == Approx((mass - rho * volume) * g).epsilon(0.02));
  CHECK(sim.at<"ball">().state().velocity[0].norm() < 1e-3);
}

TEST_CASE("solids in fluids: bad input") {
  auto wrong = [](Mesh const& mesh) {
    Simulation sim{
        node<"root">(node<"water">(Fluid3D<Vec3d>{.nx = 8, .ny = 8, .nz = 8, .cellwidth = 0.1, .height = 4}),
                     node<"stone">(MeshTopology{.triangles = mesh.triangles, .quads = mesh.quads},
                                   MechanicalObject<Vec3d>{.position = mesh.positions},
                                   ImmersedSolid<Vec3d>{}))};
    return error_of([&] {
      sim.init();
      sim.animate(0.01);
    });
  };
  using Catch::Contains;
  CHECK(wrong(shapes::box({-0.1, -0.1, -0.1}, {0.12, 0.12, 0.12})) == "");
  CHECK_THAT(wrong(shapes::box({5, 5, 5}, {6, 6, 6})),
             Contains("Fluid3D") && Contains("/root/stone") && Contains("outside of the grid"));
  CHECK_THAT(wrong(shapes::box({0.02, 0.02, 0.02}, {0.05, 0.05, 0.05})), Contains("smaller than a cell"));
  CHECK_THAT(wrong(shapes::box({-9, -9, -9}, {9, 9, 9})), Contains("/root/stone") && Contains("fill all"));
  Mesh broken = shapes::box({-0.1, -0.1, -0.1}, {0.12, 0.12, 0.12});
  broken.quads.pop_back();
  CHECK_THAT(wrong(broken), Contains("/root/stone: ImmersedSolid") && Contains("not closed"));
  broken.quads.clear();
  CHECK_THAT(wrong(broken), Contains("/root/stone: ImmersedSolid") && Contains("triangles or quads"));

  // a body that diverges
  const Mesh cube = shapes::box({-0.1, -0.1, -0.1}, {0.12, 0.12, 0.12});
  Simulation sim{
      node<"root">(node<"water">(Fluid3D<Vec3d>{.nx = 8, .ny = 8, .nz = 8, .cellwidth = 0.1, .height = 4}),
                   node<"stone">(MeshTopology{.quads = cube.quads},
                                 MechanicalObject<Vec3d>{.position = cube.positions},
                                 ImmersedSolid<Vec3d>{}))};
  sim.init();
  sim.at<"stone">().state().position[3][1] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(error_of([&] { sim.animate(0.01); }),
             Contains("point 3") && Contains("/root/stone") && Contains("not finite"));
}

}  // namespace test_immersed_solid
