// SPDX-License-Identifier: BSL-1.0
// Of sinew::compiled: components and the scene.
#include "base.hpp"
#include "constraints.hpp"

#undef SINEW_DEFINES
#define SINEW_DEFINES 1
#include <sinew/collision/attachment.hpp>
#include <sinew/collision/broad_phase.hpp>
#include <sinew/collision/collision_surface.hpp>
#include <sinew/collision/contact_assembly.hpp>
#include <sinew/collision/contact_limit.hpp>
#include <sinew/collision/contact_rules.hpp>
#include <sinew/collision/convex_hull.hpp>
#include <sinew/collision/default_pipeline.hpp>
#include <sinew/collision/overlaps.hpp>
#include <sinew/collision/penalty_contact.hpp>
#include <sinew/collision/ray_hits.hpp>
#include <sinew/collision/stick_contact.hpp>
#include <sinew/collision/surface_cones.hpp>
#include <sinew/collision/surface_elements.hpp>
#include <sinew/collision/vertex_contacts.hpp>
#include <sinew/constraint/constrained_points.hpp>
#include <sinew/engine/edge2quad_topological_mapping.hpp>
#include <sinew/engine/grid_mesh_creator.hpp>
#include <sinew/engine/mesh_loader.hpp>
#include <sinew/engine/mesh_subdivision.hpp>
#include <sinew/engine/roi.hpp>
#include <sinew/engine/sphere_loader.hpp>
#include <sinew/engine/string_mesh_creator.hpp>
#include <sinew/engine/topological_mapping.hpp>
#include <sinew/fluid/fluid2d.hpp>
#include <sinew/fluid/fluid3d.hpp>
#include <sinew/force/element_pressure.hpp>
#include <sinew/force/hyperelastic_material.hpp>
#include <sinew/force/viscoelastic_material.hpp>
#include <sinew/lagrangian/compliance_file.hpp>
#include <sinew/mapping/particle_surface.hpp>
#include <sinew/scene/path.hpp>
#include <sinew/scene/profile_report.hpp>
#include <sinew/scene/removed_border.hpp>
#include <sinew/solver/dfsph_flow.hpp>
#include <sinew/visual/visual_model.hpp>
