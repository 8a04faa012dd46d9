// SPDX-License-Identifier: BSL-1.0
#pragma once

// The one reader for all formats. It needs pugixml, as read_vtu.hpp does.
#include <sinew/io/read_vtu.hpp>
#include <sinew/io/text_mesh_file.hpp>

namespace sinew::io {

/// Reads a mesh by the ending of its name, letter case ignored: .msh (Gmsh), .obj (Wavefront), .stl
/// (stereolithography), .ply (Stanford), .vtk (legacy VTK) or .vtu (VTK XML). Throws Error on any other
/// ending, and as the reader of the format does.
inline Mesh read_mesh(std::string const& path) {
  return file_ending(path) == ".vtu" ? read_vtu(path) : read_text_mesh(path, " and .vtu");
}

}  // namespace sinew::io
