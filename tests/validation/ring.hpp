// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>

inline const double pi = std::numbers::pi;

/// The frequency [rad/s] of a linear system that swings in one mode: its positions after each step h of the
/// trapezoidal rule, projected on how it was let go, fulfil q+ + q- = 2 cos(W h) q, and tan(W h/2) = w h/2.
template <class Sim, class Coords>
double ring(Sim& sim, Coords const& rest, double h, int steps = 30) {
  auto const& x = sim.root().state().position;
  Coords shape = x;
  for (std::size_t i = 0; i < rest.size(); ++i) shape[i] -= rest[i];
  auto project = [&] {
    double q = 0;
    for (std::size_t i = 0; i < rest.size(); ++i) q += (x[i] - rest[i]).dot(shape[i]);
    return q;
  };
  double q[3] = {0, project(), 0}, above = 0, below = 0;
  sim.animate(h);
  q[2] = project();
  for (int i = 0; i < steps; ++i) {
    sim.animate(h);
    q[0] = q[1], q[1] = q[2], q[2] = project();
    above += (q[0] + q[2]) * q[1], below += 2 * q[1] * q[1];
  }
  return 2 / h * std::tan(std::acos(above / below) / 2);
}
