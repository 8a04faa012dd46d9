// SPDX-License-Identifier: BSL-1.0
#include "one_component.hpp"
#include "registry_scene.hpp"

#include <sinew/context/gravity.hpp>
#include <sinew/force/virtual_coupling.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/solver/runge_kutta4.hpp>
#include <sinew/solver/sparse_ldl_solver.hpp>
#include <sinew/state/mechanical_object.hpp>

namespace test_virtual_coupling {

using namespace sinew;
using Eigen::Vector3d;
using one::force;
using one::product;
using one::ready;
using one::refuses;

namespace {

template <class... Solvers>
auto tool(VirtualCoupling<Rigid3d> const& coupling, Vector3d const& gravity, Rigid3d::Deriv const& velocity,
          Solvers... solvers) {
  // 0.05 kg, 1e-4 kg m^2
  const RigidMass<double, 3> mass{0.05, 1e-4 * Eigen::Matrix3d::Identity()};
  return RegistryScene{node<"root">(Gravity{gravity},
                                    solvers...,
                                    MechanicalObject<Rigid3d>{.position = {{}}, .velocity = {velocity}},
                                    UniformMass<Rigid3d>{.vertexMass = mass},
                                    coupling)};
}

Rigid3d::Deriv six(double a, double b) {
  Rigid3d::Deriv v;
  v << a, 0, 0, 0, 0, b;
  return v;
}

}  // namespace

TEST_CASE("a virtual coupling draws points to its target by k d and c v") {
  auto c =
      ready(VirtualCoupling<Vec3d>{.points = {1}, .stiffness = 200, .damping = 3}, {{0, 0, 0}, {1, 0, 0}});
  const auto f = force(c, {{5, 5, 5}, {1.01, 0.02, 0}}, {{1, 1, 1}, {0.1, 0, 0.2}});
  CHECK(f[0].norm() == 0);
  CHECK((f[1] - Vector3d(-200 * 0.01 - 0.3, -200 * 0.02, -0.6)).norm() < 1e-13);
  CHECK(potential_energy(c, {{5, 5, 5}, {1.01, 0.02, 0}}) == Approx(100 * 5e-4));
  c.setTarget({1.01, 0.02, 0}, {0.1, 0, 0.2});
  CHECK(force(c, {{5, 5, 5}, {1.01, 0.02, 0}}, {{1, 1, 1}, {0.1, 0, 0.2}})[1].norm() == 0);
  c.enabled = false;
  c.setTarget({9, 9, 9}, {9, 9, 9});
  CHECK(force(c, {{5, 5, 5}, {1, 0, 0}})[1].norm() == 0);
  CHECK(product(c, {{1, 1, 1}, {1, 1, 1}}, 1, 1)[1].norm() == 0);
  CHECK(potential_energy(c, {{5, 5, 5}, {1, 0, 0}}) == 0);
}

TEST_CASE("a virtual coupling of points has one target for all, or each its own") {
  auto all =
      ready(VirtualCoupling<Vec3d>{.points = {0, 1}, .stiffness = 1, .damping = 0, .target = {{1, 0, 0}}},
            {{0, 0, 0}, {3, 0, 0}});
  auto f = force(all, {{0, 0, 0}, {3, 0, 0}});
  CHECK(f[0][0] == 1);
  CHECK(f[1][0] == -2);
  auto each = ready(VirtualCoupling<Vec3d>{.points = {0, 1},
                                           .stiffness = 1,
                                           .damping = 2,
                                           .target = {{1, 0, 0}, {2, 0, 0}},
                                           .targetVelocity = {{1, 0, 0}, {0, 1, 0}}},
                    {{0, 0, 0}, {3, 0, 0}});
  f = force(each, {{0, 0, 0}, {3, 0, 0}});
  CHECK(f[0] == Vector3d(3, 0, 0));
  CHECK(f[1] == Vector3d(-1, 2, 0));
}

TEST_CASE("a virtual coupling turns a tool by k t and c w") {
  Rigid3d::Coord target, x;
  target.orientation = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 2) / 3);
  x = target;
  const Vector3d rotation = 2.5 * Vector3d(2, -1, 2) / 3;
  Rigid3d::Deriv d, w;
  d << 0.1, 0, 0, rotation;
  w << 0, 0, 0, 1, 2, 3;
  Rigid3d::increment(x, d);
  auto c = ready(VirtualCoupling<Rigid3d>{.stiffness = 100,
                                          .damping = 0,
                                          .angularStiffness = 0.4,
                                          .angularDamping = 0.01,
                                          .target = {target}},
                 {{}});
  Rigid3d::Deriv expected;
  expected << -10, 0, 0, -0.4 * rotation - 0.01 * Vector3d(1, 2, 3);
  CHECK((force(c, {x}, {w})[0] - expected).norm() < 1e-13);
  CHECK(potential_energy(c, {x}) == Approx(50 * 0.01 + 0.2 * 6.25));
}

TEST_CASE("a tool hangs below its target by m g / k") {
  VirtualCoupling<Rigid3d> coupling{.stiffness = 400};
  auto sim = tool(coupling,
                  {0, -9.81, 0},
                  Rigid3d::Deriv::Zero(),
                  EulerImplicitSolver{},
                  SparseLDLSolver<CompressedRowSparseMatrixd>{});
  sim.init();
  for (int i = 0; i < 3000; ++i) sim.animate(0.01);
  CHECK(sim.root().state().position[0].center[1] == Approx(-0.05 * 9.81 / 400).epsilon(1e-10));
}

TEST_CASE("a tool rings on its coupling as a damped oscillator, to the fourth order of the solver") {
  const double m = 0.05, k = 20, c = 0.4, j = 1e-4, ka = 0.05, ca = 5e-4;
  auto sim = tool({.stiffness = k, .damping = c, .angularStiffness = ka, .angularDamping = ca},
                  {0, 0, 0},
                  six(0.3, 2),
                  RungeKutta4Solver{});
  sim.init();
  const double h = 2e-4;
  for (int i = 0; i < 2500; ++i) sim.animate(h);
  auto ring = [](double v0, double mass, double stiffness, double damping, double t) {
    const double a = damping / (2 * mass), w = std::sqrt(stiffness / mass - a * a);
    return v0 / w * std::exp(-a * t) * std::sin(w * t);
  };
  auto const& x = sim.root().state().position[0];
  // (w h)^4 / 120 of an amplitude of 0.02 m and 0.1 rad, a few turns: 1e-9
  CHECK(x.center[0] == Approx(ring(0.3, m, k, c, 0.5)).margin(1e-10));
  CHECK(Rigid3d::difference({}, x)[5] == Approx(ring(2, j, ka, ca, 0.5)).margin(1e-9));
}

TEST_CASE("implicit steps are those of the damped oscillator's recurrence") {
  const double m = 0.05, k = 500, c = 2, h = 0.01;
  auto sim = tool({.stiffness = k, .damping = c},
                  {0, 0, 0},
                  six(0.3, 0),
                  EulerImplicitSolver{},
                  SparseLDLSolver<CompressedRowSparseMatrixd>{});
  sim.init();
  double x = 0, v = 0.3;
  for (int i = 0; i < 100; ++i) {
    sim.animate(h);
    v = (m * v - h * k * x) / (m + h * c + h * h * k);
    x += h * v;
    REQUIRE(sim.root().state().position[0].center[0] == Approx(x).margin(1e-14));
  }
}

TEST_CASE("a tool follows a target at constant velocity without lag, at any step") {
  for (const double h : {0.001, 0.02}) {
    auto sim = tool({},
                    {0, 0, 0},
                    Rigid3d::Deriv::Zero(),
                    EulerImplicitSolver{},
                    SparseLDLSolver<CompressedRowSparseMatrixd>{});
    sim.init();
    auto& coupling = sim.root().get<VirtualCoupling<Rigid3d>>();
    const Rigid3d::Deriv v = six(0.2, 1.5);
    const int steps = int(std::lround(4 / h));
    Rigid3d::Coord target;
    for (int i = 1; i <= steps; ++i) {
      target = {};
      Rigid3d::increment(target, i * h * v);  // at the end of the step
      coupling.setTarget(target, v);
      sim.animate(h);
    }
    CHECK(Rigid3d::difference(target, sim.root().state().position[0]).norm() < 1e-9);
    CHECK((sim.root().state().velocity[0] - v).norm() < 1e-9);
  }
}

TEST_CASE("a coupling never gives off energy in implicit steps, however stiff") {
  for (const double k : {10., 1e4, 1e8}) {
    auto sim = tool({.stiffness = k, .damping = 0, .angularStiffness = 1e-4 * k, .angularDamping = 0},
                    {0, 0, 0},
                    six(0.3, 2),
                    EulerImplicitSolver{},
                    SparseLDLSolver<CompressedRowSparseMatrixd>{});
    sim.init();
    double before = sim.kineticEnergy() + sim.potentialEnergy();
    for (int i = 0; i < 1000; ++i) {
      sim.animate(0.01);
      const double now = sim.kineticEnergy() + sim.potentialEnergy();
      REQUIRE(now <= before * (1 + 1e-12));
      before = now;
    }
  }
}

TEST_CASE("a virtual coupling refuses bad input, and keeps its target where it is given a bad one") {
  using C = VirtualCoupling<Vec3d>;
  const Vec3d::VecCoord rest{{0, 0, 0}, {1, 0, 0}};
  refuses(C{.points = {2}}, rest, {}, {"body", "VirtualCoupling<Vec3d>", "points has 2", "2 points"});
  refuses(C{.points = {-1}}, rest, {}, {"points[0] is -1"});
  refuses(C{.points = {0}}, {}, {}, {"points has 0", "0 points"});
  refuses(C{.stiffness = -1}, rest, {}, {"stiffness is -1 N/m", "at least 0"});
  refuses(C{.damping = one::notANumber}, rest, {}, {"damping is nan"});
  refuses(C{.target = {{0, one::notANumber, 0}}}, rest, {}, {"target[0] is nan"});
  refuses(C{.points = {0, 1, 1}, .target = {{0, 0, 0}, {1, 0, 0}}}, rest, {}, {"target has 2 values for 3"});
  refuses(C{.targetVelocity = {{0, 0, 0}, {1, 0, 0}}}, rest, {}, {"targetVelocity has 2 values for 1"});
  refuses(VirtualCoupling<Rigid3d>{.target = {{{0, 0, 0}, {0, 0, 0, 0}}}}, {{}}, {}, {"unit quaternion"});
  refuses(VirtualCoupling<Rigid3d>{.angularStiffness = -2}, {{}}, {}, {"angularStiffness is -2"});

  auto c = ready(C{}, rest);
  c.setTarget({1, 2, 3}, {0, 0, 0});
  one::says(
      [&] {
        c.setTarget({one::notANumber, 0, 0}, {0, 0, 0});
      },
      {"VirtualCoupling<Vec3d>", "not finite"});
  one::says([&] { c.setTarget({0, 0, 0}, {0, one::notANumber, 0}); }, {"not finite"});
  CHECK(c.place[0] == Vector3d(1, 2, 3));
  // initialised again, as after a change of the scene or from a checkpoint
  C again{.target = c.target, .targetVelocity = c.targetVelocity};
  again = ready(again, rest);
  CHECK(again.place[0] == Vector3d(1, 2, 3));
}

}  // namespace test_virtual_coupling
