// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/mesh.hpp>

#include <string>
#include <string_view>

namespace sinew::io {

/// The ending of a file's name with its dot, in lower case; empty where it has none.
std::string file_ending(std::string_view path);

/// Reads a mesh by the ending of its name, letter case ignored: .msh (Gmsh), .obj (Wavefront), .stl
/// (stereolithography), .ply (Stanford) or .vtk (legacy VTK). `others` names the endings that the caller
/// knows beside these. Throws Error on any other ending, and as the reader of the format does.
Mesh read_text_mesh(std::string const& path, std::string_view others = "");

}  // namespace sinew::io

#if SINEW_DEFINES
#include <sinew/io/read_gmsh.hpp>
#include <sinew/io/read_obj.hpp>
#include <sinew/io/read_ply.hpp>
#include <sinew/io/read_stl.hpp>
#include <sinew/io/read_vtk.hpp>

namespace sinew::io {

SINEW_ONCE std::string file_ending(std::string_view path) {
  const std::size_t name = path.rfind('/') + 1, dot = path.rfind('.');  // npos + 1 is 0
  return dot == path.npos || dot < name ? "" : lower_case(path.substr(dot));
}

SINEW_ONCE Mesh read_text_mesh(std::string const& path, std::string_view others) {
  const std::string ending = file_ending(path);
  if (ending == ".msh") return read_gmsh(path);
  if (ending == ".obj") return read_obj(path);
  if (ending == ".stl") return read_stl(path);
  if (ending == ".ply") return read_ply(path);
  if (ending == ".vtk") return read_vtk(path);
  throw Error(path,
              text(ending.empty() ? "has no ending that tells its format"
                                  : text("files ending in ", in_quotes(ending), " are not read"),
                   "; the known endings are .msh (Gmsh), .obj (Wavefront), .stl (stereolithography), .ply "
                   "(Stanford), .vtk (VTK)",
                   others));
}

}  // namespace sinew::io
#endif
