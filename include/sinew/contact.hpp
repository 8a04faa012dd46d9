// SPDX-License-Identifier: BSL-1.0
#pragma once

// Bodies that touch: collision models, the stages of detection, and what answers contacts.
// All components of collision:
#include <sinew/collision/brute_force_broad_phase.hpp>
#include <sinew/collision/bvh_narrow_phase.hpp>
#include <sinew/collision/capsule_collision_model.hpp>
#include <sinew/collision/carving_manager.hpp>
#include <sinew/collision/collision_model.hpp>
#include <sinew/collision/contact_manager.hpp>
#include <sinew/collision/continuous_intersection.hpp>
#include <sinew/collision/cutting_manager.hpp>
#include <sinew/collision/default_pipeline.hpp>
#include <sinew/collision/discrete_intersection.hpp>
#include <sinew/collision/line_collision_model.hpp>
#include <sinew/collision/local_min_distance.hpp>
#include <sinew/collision/min_proximity_intersection.hpp>
#include <sinew/collision/point_collision_model.hpp>
#include <sinew/collision/ray_trace_narrow_phase.hpp>
#include <sinew/collision/rigid_distance_grid_collision_model.hpp>
#include <sinew/collision/sphere_collision_model.hpp>
#include <sinew/collision/sub_collision_pipeline.hpp>
#include <sinew/collision/tetrahedron_collision_model.hpp>
#include <sinew/collision/tree_broad_phase.hpp>
#include <sinew/collision/triangle_collision_model.hpp>
