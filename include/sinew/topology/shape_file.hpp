// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/data_types.hpp>
#include <sinew/core/mesh.hpp>

#include <string>
#include <vector>

namespace sinew {

/// The points of a mesh: .msh, .obj, .stl, .ply or .vtk. Throws Error where the file cannot be read.
std::vector<Eigen::Vector3d> points_in_file(std::string const& path);

/// The surface in such a file: its points, triangles and quads.
Mesh surface_in_file(std::string const& path);

/// Mass and inertia of a rigid body: those that SOFA's .rigid says, or those of 1 kg that fills a closed
/// surface around the origin (.msh, .obj, .stl, .ply, .vtk) evenly. Throws Error where the file cannot be
/// read, where the surface is not closed, and where its centre of mass is not at the origin.
RigidMass<double, 3> rigid_mass_in_file(std::string const& path);

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/io/read_rigid.hpp>
#include <sinew/io/text_mesh_file.hpp>
#include <sinew/topology/inertia.hpp>

#include <cmath>

namespace sinew {

SINEW_ONCE std::vector<Eigen::Vector3d> points_in_file(std::string const& path) {
  return io::read_text_mesh(path).positions;
}

SINEW_ONCE Mesh surface_in_file(std::string const& path) { return io::read_text_mesh(path); }

SINEW_ONCE RigidMass<double, 3> rigid_mass_in_file(std::string const& path) {
  if (io::file_ending(path) == ".rigid") return io::read_rigid(path);
  const Mesh mesh = io::read_text_mesh(path, " and .rigid");
  const MassProperties p = mass_properties(path, mesh.positions, mesh.triangles, mesh.quads);
  // a mesh that is round about the origin has its centre there up to what faces take away
  const double radius = std::sqrt(p.inertia.trace() / (2 * p.volume));
  if (p.center.norm() > 0.01 * radius)
    throw Error(path,
                text("the centre of mass is at (",
                     p.center[0],
                     ", ",
                     p.center[1],
                     ", ",
                     p.center[2],
                     ") m, but a rigid body has it at the origin; move the surface there, or take "
                     "GenerateRigidMass and its centerToOrigin"));
  return {1, p.inertia / p.volume};
}

}  // namespace sinew
#endif
