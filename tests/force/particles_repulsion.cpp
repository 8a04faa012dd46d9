// SPDX-License-Identifier: BSL-1.0
// Points that keep a distance: forces, energies and products against sums over all pairs, a collision of two
// in closed form, a pile under an implicit solver.
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/force/particles_repulsion.hpp>
#include <sinew/mechanics.hpp>

#include <numbers>
#include <random>

namespace test_particles_repulsion {

using namespace sinew;
using Vectors = std::vector<Eigen::Vector3d>;

namespace {

Vectors scattered(std::size_t n, double width, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0, width);
  Vectors points;
  for (std::size_t i = 0; i < n; ++i) points.push_back({place(random), place(random), place(random)});
  return points;
}

template <class F>
void each_pair(ParticlesRepulsionForceField<Vec3d> const& c, Vectors const& x, F&& f) {
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < x.size(); ++j)
      if (const Eigen::Vector3d d = x[i] - x[j]; i != j && d.norm() > 0 && d.norm() < c.distance)
        f(i, j, d.normalized(), c.distance - d.norm());
}
double largest_difference(Vectors const& a, Vectors const& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).norm());
  return most;
}

}  // namespace

TEST_CASE("repulsion of points is the sum over all pairs") {
  Vectors x = scattered(300, 1, 3), v = scattered(300, 1, 4), dx = scattered(300, 1, 5);
  x[7] = x[8];  // at one place they do not see each other
  for (const double distance : {0.05, 0.2, 3.})
    for (const double damping : {0., 0.7})
      for (const bool implicit : {false, true}) {
        ParticlesRepulsionForceField<Vec3d> c{
            .distance = distance, .stiffness = 30, .damping = damping, .implicit = implicit};
        c.init(InitContext<Vec3d>{"test", x, {}});
        Vectors f(x.size(), Eigen::Vector3d::Zero()), df = f, force = f, product = f;
        c.addForce({}, f, x, v);
        const double k = -0.3, b = -2;
        c.addDForce({.b = b, .k = k}, df, dx);
        double energy = 0, size = 1;
        each_pair(c, x, [&](std::size_t i, std::size_t j, Eigen::Vector3d const& n, double depth) {
          force[i] += 30 * depth * n - damping * depth * (v[i] - v[j]);
          product[i] -= k * 30 * n * n.dot(dx[i] - dx[j]);
          if (implicit) product[i] -= b * damping * depth * (dx[i] - dx[j]);
          energy += 15 * depth * depth / 2;  // each pair twice
          size += 30;
        });
        CHECK(largest_difference(f, force) < 1e-12 * size);
        CHECK(largest_difference(df, product) < 1e-12 * size);
        CHECK(c.potentialEnergy(x) == Approx(energy));
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (auto const& one : f) sum += one;
        CHECK(sum.norm() < 1e-12 * size);
      }
}

TEST_CASE("two points that meet part after half a period of the spring between them") {
  // d = h - r: d'' = -2k/m d, d(t) = v / w sin w t, w = sqrt(2 k / m), v the speed at which they near
  const double k = 200, m = 0.5, h = 0.1, v = 1, w = std::sqrt(2 * k / m), dt = 1e-5;
  Simulation sim{node<"root">(
      EulerExplicitSolver{.symplectic = true},
      MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {h, 0, 0}}, .velocity = {{v, 0, 0}, {0, 0, 0}}},
      UniformMass<Vec3d>{.vertexMass = {m}},
      ParticlesRepulsionForceField<Vec3d>{.distance = h, .stiffness = k, .damping = 0})};
  sim.init();
  auto& state = sim.root().state();
  const double half = std::numbers::pi / w;
  double deepest = 0;
  for (int i = 0; dt * i < 1.1 * half; ++i) {
    sim.animate(dt);
    const double depth = h - (state.position[1][0] - state.position[0][0]), t = sim.time();
    deepest = std::max(deepest, depth);
    // of first order in dt
    if (t < half) CHECK(depth == Approx(v / w * std::sin(w * t)).margin(v * dt));
  }
  CHECK(deepest == Approx(v / w).epsilon(1e-3));
  CHECK(state.velocity[0][0] == Approx(0).margin(w * dt * v));
  CHECK(state.velocity[1][0] == Approx(v).epsilon(w * dt));
}

TEST_CASE(
    "implicit solvers carry a pile of points that keep a distance, in steps that explicit ones cannot") {
  // a column of 5 on the lowest, which is fixed: each pair bears the weight above. Explicit steps are stable
  // up to 2/w = 35 ms, w = 1.8 sqrt(k/m).
  const double k = 1000, m = 1, g = 10, h = 0.1;
  Vectors column;
  for (int i = 0; i < 5; ++i) column.push_back({0, 0, 0.6 * h * i});
  Simulation sim{
      node<"root">(Gravity{{0, 0, -g}},
                   EulerImplicitSolver{.rayleighMass = 1},
                   CGLinearSolver<>{.iterations = 50, .tolerance = 1e-12},
                   MechanicalObject<Vec3d>{column},
                   UniformMass<Vec3d>{.vertexMass = {m}},
                   FixedConstraint<Vec3d>{.indices = {0}},
                   ParticlesRepulsionForceField<Vec3d>{.distance = h, .stiffness = k, .damping = 0})};
  sim.init();
  for (int i = 0; i < 400; ++i) sim.animate(0.05);
  auto const& x = sim.root().state().position;
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    CHECK(h - (x[i + 1][2] - x[i][2]) == Approx(double(x.size() - 1 - i) * m * g / k).epsilon(1e-6));
}

TEST_CASE("repulsion without a distance, or of points that are nowhere, is refused") {
  auto run = [](double distance, double stiffness, double place) {
    return error_of([&] {
      Simulation sim{
          node<"root">(EulerExplicitSolver{},
                       MechanicalObject<Vec3d>{Vectors{{0, 0, 0}, {place, 0, 0}}},
                       UniformMass<Vec3d>{},
                       ParticlesRepulsionForceField<Vec3d>{.distance = distance, .stiffness = stiffness})};
      sim.init();
      sim.animate(0.01);
    });
  };
  CHECK(run(1, 1, 0.5).empty());
  CHECK_THAT(run(0, 1, 1), Catch::Contains("ParticlesRepulsionForceField") && Catch::Contains("distance"));
  CHECK_THAT(run(1, -1, 1), Catch::Contains("stiffness"));
  CHECK_THAT(run(1e-9, 1, 1), Catch::Contains("more than 2^20 cells"));
}

}  // namespace test_particles_repulsion
