// SPDX-License-Identifier: BSL-1.0
#pragma once

// All of Sinew that needs no other package than Eigen and Boost.Hana.
#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/control/step_callback.hpp>
#include <sinew/force/constant_force.hpp>
#include <sinew/force/gravity.hpp>
#include <sinew/force/stiff_spring.hpp>
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/mapping/barycentric_mapping.hpp>
#include <sinew/mapping/identity_mapping.hpp>
#include <sinew/mapping/rigid_mapping.hpp>
#include <sinew/mapping/subset_mapping.hpp>
#include <sinew/mass/diagonal_mass.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/solver/runge_kutta2.hpp>
#include <sinew/solver/runge_kutta4.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/tetrahedron_topology.hpp>
#include <sinew/visual/visual_model.hpp>
