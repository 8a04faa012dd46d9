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
#include <sinew/collision/distance_grid.hpp>
#include <sinew/collision/grid_contacts.hpp>
#include <sinew/collision/overlaps.hpp>
#include <sinew/collision/penalty_contact.hpp>
#include <sinew/collision/ray_hits.hpp>
#include <sinew/collision/ray_trace_narrow_phase.hpp>
#include <sinew/collision/solid_contacts.hpp>
#include <sinew/collision/stick_contact.hpp>
#include <sinew/collision/sub_collision_pipeline.hpp>
#include <sinew/collision/surface_cones.hpp>
#include <sinew/collision/surface_elements.hpp>
#include <sinew/collision/vertex_contacts.hpp>
#include <sinew/constraint/constrained_points.hpp>
#include <sinew/engine/clustering_engine.hpp>
#include <sinew/engine/complementary_roi.hpp>
#include <sinew/engine/difference_engine.hpp>
#include <sinew/engine/dilate_engine.hpp>
#include <sinew/engine/displacement_matrix_engine.hpp>
#include <sinew/engine/edge2quad_topological_mapping.hpp>
#include <sinew/engine/extrude_edges.hpp>
#include <sinew/engine/extrude_quads.hpp>
#include <sinew/engine/extrude_surface.hpp>
#include <sinew/engine/generate_cylinder.hpp>
#include <sinew/engine/generate_grid.hpp>
#include <sinew/engine/generate_sphere.hpp>
#include <sinew/engine/grid_mesh_creator.hpp>
#include <sinew/engine/hausdorff_distance.hpp>
#include <sinew/engine/index_value_mapper.hpp>
#include <sinew/engine/indices2values_mapper.hpp>
#include <sinew/engine/indices_from_values.hpp>
#include <sinew/engine/join_points.hpp>
#include <sinew/engine/map_indices.hpp>
#include <sinew/engine/math_op.hpp>
#include <sinew/engine/merge_rois.hpp>
#include <sinew/engine/merge_sets.hpp>
#include <sinew/engine/merge_vectors.hpp>
#include <sinew/engine/mesh2point_topological_mapping.hpp>
#include <sinew/engine/mesh_barycentric_mapper.hpp>
#include <sinew/engine/mesh_boundary_roi.hpp>
#include <sinew/engine/mesh_closing.hpp>
#include <sinew/engine/mesh_loader.hpp>
#include <sinew/engine/mesh_sampler.hpp>
#include <sinew/engine/mesh_splitting.hpp>
#include <sinew/engine/mesh_subdivision.hpp>
#include <sinew/engine/mesh_subset.hpp>
#include <sinew/engine/mesh_tetra_stuffing.hpp>
#include <sinew/engine/norm_engine.hpp>
#include <sinew/engine/normals_from_points.hpp>
#include <sinew/engine/projective_transform.hpp>
#include <sinew/engine/quat_to_rigid.hpp>
#include <sinew/engine/random_point_distribution.hpp>
#include <sinew/engine/rigid_to_quat.hpp>
#include <sinew/engine/roi.hpp>
#include <sinew/engine/roi_value_mapper.hpp>
#include <sinew/engine/select_label_roi.hpp>
#include <sinew/engine/simple_tesselated_tetra_topological_mapping.hpp>
#include <sinew/engine/smooth_mesh.hpp>
#include <sinew/engine/sphere_loader.hpp>
#include <sinew/engine/spiral.hpp>
#include <sinew/engine/string_mesh_creator.hpp>
#include <sinew/engine/sum_engine.hpp>
#include <sinew/engine/topological_mapping.hpp>
#include <sinew/engine/transform_matrix_engine.hpp>
#include <sinew/engine/transform_position.hpp>
#include <sinew/engine/values.hpp>
#include <sinew/engine/values_from_indices.hpp>
#include <sinew/engine/vertex2frame.hpp>
#include <sinew/engine/voxel_grid_loader.hpp>
#include <sinew/fluid/fluid2d.hpp>
#include <sinew/fluid/fluid3d.hpp>
#include <sinew/force/composite_cells.hpp>
#include <sinew/force/element_pressure.hpp>
#include <sinew/force/hyperelastic_material.hpp>
#include <sinew/force/material_axes.hpp>
#include <sinew/force/reaction.hpp>
#include <sinew/force/viscoelastic_material.hpp>
#include <sinew/lagrangian/compliance_file.hpp>
#include <sinew/mapping/articulated_bodies.hpp>
#include <sinew/mapping/particle_surface.hpp>
#include <sinew/scene/path.hpp>
#include <sinew/scene/profile_report.hpp>
#include <sinew/scene/removed_border.hpp>
#include <sinew/solver/dfsph_flow.hpp>
#include <sinew/visual/visual_model.hpp>

namespace sinew {
template struct Fluid2D<Vec2d>;
template struct Fluid2D<Vec2f>;
template struct Fluid3D<Vec3d>;
template struct Fluid3D<Vec3f>;
}  // namespace sinew
