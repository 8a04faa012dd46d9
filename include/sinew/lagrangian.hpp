// SPDX-License-Identifier: BSL-1.0
#pragma once

// Constraints by Lagrange multipliers, and what solves them.

#include <sinew/scene/constrained_step.hpp>

// All components of lagrangian:
#include <sinew/lagrangian/augmented_lagrangian_constraint.hpp>
#include <sinew/lagrangian/bilateral_lagrangian_constraint.hpp>
#include <sinew/lagrangian/block_gauss_seidel_constraint_solver.hpp>
#include <sinew/lagrangian/convex_constraint_solver.hpp>
#include <sinew/lagrangian/fixed_lagrangian_constraint.hpp>
#include <sinew/lagrangian/free_motion_animation_loop.hpp>
#include <sinew/lagrangian/improved_jacobi_constraint_solver.hpp>
#include <sinew/lagrangian/lcp_constraint_solver.hpp>
#include <sinew/lagrangian/linear_solver_constraint_correction.hpp>
#include <sinew/lagrangian/nncg_constraint_solver.hpp>
#include <sinew/lagrangian/precomputed_constraint_correction.hpp>
#include <sinew/lagrangian/preconditioned_conjugate_residual.hpp>
#include <sinew/lagrangian/sliding_lagrangian_constraint.hpp>
#include <sinew/lagrangian/stopper_lagrangian_constraint.hpp>
#include <sinew/lagrangian/unbuilt_gauss_seidel_constraint_solver.hpp>
#include <sinew/lagrangian/uncoupled_constraint_correction.hpp>
#include <sinew/lagrangian/uniform_lagrangian_constraint.hpp>
#include <sinew/lagrangian/unilateral_lagrangian_constraint.hpp>
