// SPDX-License-Identifier: BSL-1.0
// Edges that keep their length, and tetrahedra that keep their volume.
#include "catch.hpp"
#include "registry_scene.hpp"

#include <sinew/lagrangian.hpp>
#include <sinew/mechanics.hpp>

#include <cmath>

namespace test_uniform_lagrangian_constraint {

using namespace sinew;

namespace {

constexpr double g = 9.81, length = 1.5, mass = 2;
const BlockGaussSeidelConstraintSolver gaussSeidel{.maxIterations = 10000, .tolerance = 1e-13};

// points joined by edges in a row from the origin, the first fixed; `turned` from the lowest position
template <class Ode, class... Linear>
auto chain(int links, double turned, UniformLagrangianConstraint<Vec1d> constraint,
           FreeMotionAnimationLoop loop, Ode ode, Linear... linear) {
  std::vector<Eigen::Vector3d> x;
  std::vector<Edge> edges;
  for (int i = 0; i <= links; ++i) {
    x.push_back(length / links * i * Eigen::Vector3d(std::sin(turned), -std::cos(turned), 0));
    if (i > 0) edges.push_back({i - 1, i});
  }
  return RegistryScene{node<"root">(
      Gravity{{0, -g, 0}},
      loop,
      gaussSeidel,
      node<"points">(ode,
                     linear...,
                     MeshTopology{.edges = edges},
                     MechanicalObject<Vec3d>{.position = x},
                     UniformMass<Vec3d>{.vertexMass = mass},
                     FixedConstraint<Vec3d>{.indices = {0}},
                     node<"edges">(MechanicalObject<Vec1d>{}, DistanceMapping<Vec3d, Vec1d>{}, constraint)))};
}
template <class Sim>
auto& state(Sim& sim) {
  return sim.template at<"points">().state();
}
template <class Sim>
auto& multipliers(Sim& sim) {
  return sim.template at<"points/edges">().template get<UniformLagrangianConstraint<Vec1d>>().multipliers;
}

}  // namespace

TEST_CASE("a pendulum of constant length swings in the time of the elliptic integral, and keeps its energy") {
  const double amplitude = 0.8, k = std::sin(amplitude / 2);
  const double period = 4 * std::sqrt(length / g) * std::comp_ellint_1(k),
               energy = g * length * (1 - std::cos(amplitude));
  struct Result {
    double period, energy;
  };
  auto swing = [&](double dt, bool velocityFirst) {
    auto sim =
        chain(1, amplitude, {}, {.solveVelocityConstraintFirst = velocityFirst}, EulerExplicitSolver{});
    sim.init();
    double before = length * std::sin(amplitude);
    int crossings = 0;
    Result result{};
    while (crossings < 4) {
      sim.animate(dt);
      auto const& x = state(sim).position[1];
      auto const& v = state(sim).velocity[1];
      // the end of a step is beside the circle by what a tangent of v dt is, and no more later
      CHECK(std::abs(x.norm() - length) <= 1.01 * 2 * energy * dt * dt / (2 * length));
      if (x[0] * before < 0 && crossings++ % 2 == 1) {  // where it has swung back
        result.period = sim.time() - dt * x[0] / (x[0] - before);
        result.energy = (v.squaredNorm() / 2 + g * (x[1] + length)) / energy;
      }
      before = x[0];
    }
    result.period /= 1.75;  // from the side
    return result;
  };
  for (const bool velocityFirst : {false, true}) {
    const Result coarse = swing(2e-3, velocityFirst), fine = swing(1e-3, velocityFirst);
    // what a step of v dt is to the circle, twice as much with twice the step, and of the energy at most
    CHECK(std::abs(fine.period / period - 1) < 2e-3);
    CHECK((coarse.period / period - 1) / (fine.period / period - 1) == Approx(2).epsilon(0.05));
    CHECK(std::abs(fine.energy - 1) < 2e-3);
    CHECK(std::abs(coarse.energy - 1) > 1.9 * std::abs(fine.energy - 1));
    CHECK((2 * fine.period - coarse.period) / period == Approx(1).margin(2e-5));  // extrapolated
  }
}

TEST_CASE("the multiplier of a pendulum is the tension of its edge") {
  auto sim = chain(1, 1.2, {}, {}, EulerImplicitSolver{}, SparseLDLSolver<>{});
  sim.init();
  for (int i = 0; i < 300; ++i) {
    sim.animate(1e-3);
    auto const& x = state(sim).position[1];
    const double tension = mass * (g * -x[1] / length + state(sim).velocity[1].squaredNorm() / length);
    REQUIRE(multipliers(sim).size() == 1);
    CHECK(-multipliers(sim)[0] == Approx(tension).epsilon(0.01));  // to the order of the step
  }
}

TEST_CASE(
    "an implicit step knows how the tension of the last one turns: that of a pendulum is backward Euler's") {
  // (1 + w^2 h^2) v1 = v0 - w^2 h x0 of small swings, stable for any h, here w h = 3; what is left out is of
  // the second order of the angle
  const double omega = std::sqrt(g / length), h = 3 / omega, angle = 1e-5;
  for (const bool velocityFirst : {false, true}) {
    auto sim = chain(1,
                     angle,
                     {},
                     {.solveVelocityConstraintFirst = velocityFirst},
                     EulerImplicitSolver{},
                     SparseLDLSolver<>{});
    sim.init();
    sim.animate(h);  // there was no tension before
    double x = state(sim).position[1][0], v = state(sim).velocity[1][0];
    CHECK(std::abs(x) > angle);  // it has jumped over its lowest point
    for (int i = 0; i < 20; ++i) {
      sim.animate(h);
      v = (v - omega * omega * h * x) / (1 + omega * omega * h * h);
      x += h * v;
      CHECK(state(sim).position[1][0] == Approx(x).margin(1e-8));
      CHECK(state(sim).velocity[1][0] == Approx(v).margin(1e-8));
    }
    CHECK(std::abs(state(sim).position[1][0]) < 1e-8);
  }
}

TEST_CASE("a chain that cannot be stretched hangs on its upper edge, however its equations are grouped") {
  auto run = [](bool iterative, bool velocityFirst, auto... solvers) {
    auto sim =
        chain(9, 0, {.iterative = iterative}, {.solveVelocityConstraintFirst = velocityFirst}, solvers...);
    sim.init();
    for (int i = 0; i < 1000; ++i) sim.animate(0.01);
    for (int i = 0; i <= 9; ++i) {
      const auto p = std::size_t(i);
      CHECK((state(sim).position[p] - length / 9 * i * -Eigen::Vector3d::UnitY()).norm() < 1e-10);
      CHECK(state(sim).velocity[p].norm() < 1e-10);
      if (i > 0) CHECK(-multipliers(sim)[p - 1] == Approx((10 - i) * mass * g).epsilon(1e-8));
    }
  };
  for (const bool iterative : {true, false}) {
    run(iterative, false, EulerExplicitSolver{});
    run(iterative, true, EulerImplicitSolver{.rayleighMass = 0}, SparseLDLSolver<>{});
  }
}

TEST_CASE("a chain that swings keeps its lengths to the order of the step, for a thousand steps") {
  auto sim = chain(5, 1.5, {.iterative = false}, {}, EulerImplicitSolver{}, SparseLDLSolver<>{});
  sim.init();
  double early = 0, late = 0;
  for (int i = 0; i < 1000; ++i) {
    sim.animate(0.002);
    auto& worst = i < 500 ? early : late;
    for (std::size_t k = 1; k <= 5; ++k)
      worst = std::max(worst,
                       std::abs((state(sim).position[k] - state(sim).position[k - 1]).norm() - length / 5));
  }
  // (v dt)^2 / 2 edge, with the difference of velocities of an edge v below 2 sqrt(2 g length)
  CHECK(early < std::pow(2 * std::sqrt(2 * g * length) * 0.002, 2) / (2 * length / 5));
  CHECK(late < 2 * early);
}

TEST_CASE("a tetrahedron of constant volume lets its apex slide in parallel to its base") {
  // V = A h / 3, so that the apex has the multiplier f A / 3 along the normal
  auto run = [](bool toRest, bool velocityFirst) {
    const Eigen::Vector3d gravity(1, 2, -4);
    RegistryScene sim{node<"root">(
        Gravity{gravity},
        FreeMotionAnimationLoop{.solveVelocityConstraintFirst = velocityFirst},
        gaussSeidel,
        node<"cell">(EulerExplicitSolver{},
                     MeshTopology{.tetrahedra = {{0, 1, 2, 3}}},
                     MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 1}}},
                     UniformMass<Vec3d>{.vertexMass = mass},
                     FixedConstraint<Vec3d>{.indices = {0, 1, 2}},
                     node<"volume">(MechanicalObject<Vec1d>{},
                                    VolumeMapping<Vec3d, Vec1d>{},
                                    UniformLagrangianConstraint<Vec1d>{.constrainToRestPos = toRest})))};
    sim.init();
    const int steps = 50;
    const double dt = 0.01, t = steps * dt;
    for (int i = 0; i < steps; ++i) sim.animate(dt);
    auto const& cell = sim.at<"cell">().state();
    const double height = toRest ? 1 : 0;  // a volume of zero where it is not that at rest
    CHECK(std::abs(cell.position[3][2] - height) < 1e-10);
    CHECK(std::abs(cell.velocity[3][2]) < 1e-8);
    for (int k = 0; k < 2; ++k) {
      CHECK(cell.velocity[3][k] == Approx(gravity[k] * t));
      CHECK(cell.position[3][k] == Approx(gravity[k] * t * (t + dt) / 2));
    }
    auto const& f = sim.at<"cell/volume">().get<UniformLagrangianConstraint<Vec1d>>().multipliers;
    REQUIRE(f.size() == 1);
    CHECK(f[0] == Approx(mass * 4 * 3 / 3.0));  // m g_n over A / 3, A = 3
  };
  for (const bool velocityFirst : {false, true}) {
    run(true, velocityFirst);
    run(false, velocityFirst);
  }
}

TEST_CASE("a body of constant volume that turns freely keeps its momentum and its volume") {
  std::vector<Eigen::Vector3d> x, v;
  for (int i = 0; i < 4; ++i) {
    x.push_back(Eigen::Vector3d(i == 1, i == 2, i == 3));
    v.push_back(Eigen::Vector3d(1, 0.5, -1) + Eigen::Vector3d(0, 0, 2).cross(x.back()) + 0.3 * x.back());
  }
  RegistryScene sim{node<"root">(
      FreeMotionAnimationLoop{},
      gaussSeidel,
      node<"cell">(EulerImplicitSolver{},
                   SparseLDLSolver<>{},
                   MeshTopology{.tetrahedra = {{0, 1, 2, 3}}},
                   MechanicalObject<Vec3d>{.position = x, .velocity = v},
                   UniformMass<Vec3d>{.vertexMass = mass},
                   node<"volume">(MechanicalObject<Vec1d>{},
                                  VolumeMapping<Vec3d, Vec1d>{},
                                  UniformLagrangianConstraint<Vec1d>{.constrainToRestPos = true})))};
  auto momentum = [&] {
    Eigen::Vector3d sum(0, 0, 0);
    for (auto const& u : sim.at<"cell">().state().velocity) sum += u;
    return sum;
  };
  sim.init();
  const Eigen::Vector3d before = momentum();
  double worst = 0;
  for (int i = 0; i < 100; ++i) {
    sim.animate(0.001);
    worst = std::max(worst, std::abs(sim.at<"cell/volume">().state().position[0][0] - 1.0 / 6));
  }
  CHECK((momentum() - before).norm() < 1e-12);
  // the second and third differences of V, of edges that move by less than 4 m/s times dt
  CHECK(worst < 3 * std::pow(4e-3, 2));
  CHECK(worst > 0);
}

}  // namespace test_uniform_lagrangian_constraint
