// SPDX-License-Identifier: BSL-1.0
#pragma once

// Data made before a scene starts: meshes that are loaded, generated or changed, and selections of points.
// All components of engine, topology:
#include <sinew/engine/box_roi.hpp>
#include <sinew/engine/edge2quad_topological_mapping.hpp>
#include <sinew/engine/generate_rigid_mass.hpp>
#include <sinew/engine/grid_mesh_creator.hpp>
#include <sinew/engine/mesh_loader.hpp>
#include <sinew/engine/mesh_subdivision.hpp>
#include <sinew/engine/nearest_point_roi.hpp>
#include <sinew/engine/pair_box_roi.hpp>
#include <sinew/engine/plane_roi.hpp>
#include <sinew/engine/points_from_indices.hpp>
#include <sinew/engine/sphere_loader.hpp>
#include <sinew/engine/sphere_roi.hpp>
#include <sinew/engine/string_mesh_creator.hpp>
#include <sinew/engine/subset_topology.hpp>
#include <sinew/engine/topological_mapping.hpp>
#include <sinew/engine/transform_engine.hpp>
#include <sinew/topology/cube_topology.hpp>
#include <sinew/topology/cylinder_grid_topology.hpp>
#include <sinew/topology/mesh_topology.hpp>
#include <sinew/topology/regular_grid_topology.hpp>
#include <sinew/topology/sparse_grid_multiple_topology.hpp>
#include <sinew/topology/sparse_grid_ramification_topology.hpp>
#include <sinew/topology/sparse_grid_topology.hpp>
#include <sinew/topology/sphere_grid_topology.hpp>
#include <sinew/topology/surface_sampling.hpp>
#include <sinew/topology/tetrahedron_topology.hpp>
#include <sinew/topology/topological_change_processor.hpp>
#include <sinew/topology/topology_bounding_trasher.hpp>
