// SPDX-License-Identifier: BSL-1.0
#pragma once

// What has functions in constraints.cpp.
#include <sinew/lagrangian/anderson_acceleration.hpp>
#include <sinew/lagrangian/block_solve.hpp>
#include <sinew/lagrangian/conjugate_residuals.hpp>
#include <sinew/lagrangian/constraint_problem.hpp>
#include <sinew/lagrangian/constraint_sweeps.hpp>
#include <sinew/lagrangian/constraint_terms.hpp>
#include <sinew/lagrangian/contact_potential.hpp>
#include <sinew/lagrangian/convex_step.hpp>
#include <sinew/lagrangian/convex_step_settings.hpp>
#include <sinew/lagrangian/convex_updates.hpp>
#include <sinew/lagrangian/lemke.hpp>
#include <sinew/lagrangian/linear_complementarity.hpp>
#include <sinew/lagrangian/null_space_rows.hpp>
#include <sinew/lagrangian/unbuilt_compliance.hpp>
