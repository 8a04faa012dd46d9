// SPDX-License-Identifier: BSL-1.0
#pragma once

// The one reader for all formats. It needs pugixml, as read_vtu.hpp does.
#include <sinew/io/read_gmsh.hpp>
#include <sinew/io/read_obj.hpp>
#include <sinew/io/read_vtk.hpp>
#include <sinew/io/read_vtu.hpp>

namespace sinew::io {

/// Reads a mesh by the ending of its name, letter case ignored: .msh (Gmsh), .obj (Wavefront), .vtk (legacy
/// VTK) or .vtu (VTK XML). Throws Error on any other ending, and as the reader of the format does.
inline Mesh read_mesh(std::string const& path) {
  const std::size_t name = path.rfind('/') + 1, dot = path.rfind('.');  // npos + 1 is 0
  const std::string ending = dot == std::string::npos || dot < name ? "" : lower_case(path.substr(dot));
  if (ending == ".msh") return read_gmsh(path);
  if (ending == ".obj") return read_obj(path);
  if (ending == ".vtk") return read_vtk(path);
  if (ending == ".vtu") return read_vtu(path);
  throw Error(path,
              text(ending.empty() ? "has no ending that tells its format"
                                  : text("files ending in ", quoted(ending), " are not read"),
                   "; the known endings are .msh (Gmsh), .obj (Wavefront), .vtk and .vtu (VTK)"));
}

}  // namespace sinew::io
