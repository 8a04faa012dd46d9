// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/block_rows.hpp>
#include <sinew/gpu/contact_search.hpp>
#include <sinew/gpu/convex_motion.hpp>
#include <sinew/gpu/multigrid_solver.hpp>
#include <sinew/gpu/team_solver.hpp>
#include <sinew/state/vector_operations.hpp>

#include <type_traits>

namespace sinew {

template <class H>
struct SolverWorkspace<CudaTypes<H>> {
  struct Nothing {};
  using MultigridWorkspace =
      std::conditional_t<!H::rigid && H::size == 3, gpu::MultigridSolver<CudaTypes<H>>, Nothing>;
  gpu::DeviceVector<double> numbers{};             // of conjugate gradients (CgScalars)
  gpu::DeviceVector<typename H::Real> diagonal{};  // blocks of a preconditioner (PointBlocks), two a point
  gpu::BlockRows<CudaTypes<H>> rows{};             // the assembled system
  MultigridWorkspace multigrid{};               // of MultigridLinearSolver, where these are points in space
  gpu::TeamSolver<CudaTypes<H>> team{};         // of all bodies of a linear solver, in the first of them
  gpu::ConvexMotion<CudaTypes<H>> motion{};     // of a scene with constraints by multipliers
  gpu::ContactSearch<CudaTypes<H>> contacts{};  // of a collision model of its points
};

}  // namespace sinew
