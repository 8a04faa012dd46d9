// SPDX-License-Identifier: BSL-1.0
#pragma once

// Scenes of one moving mass whose motion has a closed form, and the error of a solver at their end.

#include "registry_scene.hpp"

#include <sinew/sinew.hpp>
#include <sinew/solver/sparse_ldl_solver.hpp>

#include <cmath>
#include <numbers>

namespace closed_form {

using namespace sinew;

/// log2 of the ratio of two errors, dt halved between them.
inline double order(double coarse, double fine) { return std::log2(coarse / fine); }
template <class Error>
double order(Error&& error, int steps) {
  return order(error(steps), error(2 * steps));
}

template <class Solver>
auto mass_on_spring(Solver solver, Eigen::Vector2d x, Eigen::Vector2d v) {
  const auto scene = node<"root">(
      solver,
      SparseLDLSolver<CompressedRowSparseMatrixd>{},
      MechanicalObject<Vec2d>{.position = {{0, 0}, x}, .velocity = {{0, 0}, v}},
      UniformMass<Vec2d>{.vertexMass = 2},
      StiffSpringForceField<Vec2d>{.springs = {{.first = 0, .second = 1, .stiffness = 8, .length = 1}}},
      FixedConstraint<Vec2d>{.indices = {0}});
  auto started = [](auto sim) {
    sim.init();
    return sim;
  };
  if constexpr (registered_index<Standard, Solver> >= 0)
    return started(RegistryScene{scene});
  else
    return started(Simulation{scene});
}

/// Along the spring: x = 1 + e^-ct (cos wt + c/w sin wt) / 2 with c = (rM + 4 rK) / 2, w^2 = 4 - c^2. The
/// error of position and velocity at time 1.3; steps are in the ratio 1 : `uneven` by turns.
template <class Solver>
double oscillator_error(Solver solver, int steps, double rM = 0, double rK = 0, double uneven = 1) {
  const double end = 1.3, c = (rM + 4 * rK) / 2, w = std::sqrt(4 - c * c);
  auto sim = mass_on_spring(solver, {1.5, 0}, {0, 0});
  for (int i = 0; i < steps; ++i) sim.animate(2 * end / steps / (1 + uneven) * (i % 2 ? uneven : 1));
  const double decay = std::exp(-c * end),
               x = 1 + 0.5 * decay * (std::cos(w * end) + c / w * std::sin(w * end)),
               v = -0.5 * decay * 4 / w * std::sin(w * end);
  auto const& s = sim.root().state();
  return std::hypot(s.position[1][0] - x, s.velocity[1][0] - v);
}

/// Around the spring's end, on a circle of radius 2, where the pull 8 (2 - 1) is 2 w^2 2: w = sqrt(2). Not
/// linear.
template <class Solver>
double orbit_error(Solver solver, int steps) {
  const double end = 2, w = std::sqrt(2.0);
  auto sim = mass_on_spring(solver, {2, 0}, {0, 2 * w});
  for (int i = 0; i < steps; ++i) sim.animate(end / steps);
  auto const& s = sim.root().state();
  const Eigen::Vector2d x(2 * std::cos(w * end), 2 * std::sin(w * end)), v(-w * x[1], w * x[0]);
  return std::hypot((s.position[1] - x).norm(), (s.velocity[1] - v).norm());
}

/// The same orbit, slung to an ellipse: energy and angular momentum at the start and their largest errors,
/// relative.
struct Drift {
  double energy = 0, momentum = 0;
};
template <class Solver>
Drift orbit_drift(Solver solver, int steps, double dt) {
  auto sim = mass_on_spring(solver, {2, 0}, {0, 2});
  auto energy = [&] { return sim.kineticEnergy() + sim.potentialEnergy(); };
  auto momentum = [&] {
    auto const& s = sim.root().state();
    return s.position[1][0] * s.velocity[1][1] - s.position[1][1] * s.velocity[1][0];
  };
  const double e = energy(), m = momentum();
  Drift drift;
  for (int i = 0; i < steps; ++i) {
    sim.animate(dt);
    drift.energy = std::max(drift.energy, std::abs(energy() / e - 1));
    drift.momentum = std::max(drift.momentum, std::abs(momentum() / m - 1));
  }
  return drift;
}

}  // namespace closed_form
