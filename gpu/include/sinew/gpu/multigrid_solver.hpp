// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/multigrid_cycle.hpp>
#include <sinew/gpu/system_rows.hpp>

#include <vector>

namespace sinew::gpu {

/// What MultigridLinearSolver keeps with a body of points on the device.
template <class D>
struct MultigridSolver {
  MultigridCycle<D> cycle{};
  DeviceArray<typename D::Coord> start{};  // places of the modes, where these are not those of now
  // of all bodies of the linear solver, in the first of them
  std::vector<SystemBody<D>> bodies{};
  DeviceArray<unsigned char> held{};
  DeviceArray<double> numbers{};
  std::vector<double> found{};  // what comes back of a solve that is one kernel
  DeviceArray<typename D::Deriv> product{};
  TeamMemory team{};

  MultigridSolver() = default;
  MultigridSolver(MultigridSolver&&) = default;
  MultigridSolver& operator=(MultigridSolver&&) = default;
  // a copy of a body makes its own
  MultigridSolver(MultigridSolver const&) {}
  MultigridSolver& operator=(MultigridSolver const&) { return *this = MultigridSolver(); }
};

}  // namespace sinew::gpu
