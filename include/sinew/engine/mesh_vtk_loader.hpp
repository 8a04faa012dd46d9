// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/engine/mesh_loader.hpp>
#include <sinew/io/read_vtk.hpp>
#include <sinew/io/read_vtu.hpp>

namespace sinew {

namespace detail {
struct VtkFormat {
  static constexpr std::string_view className = "MeshVTKLoader", aliases = "", endings = ".vtk .vtu .vtp",
                                    header = "sinew/engine/mesh_vtk_loader.hpp";
  // by what the file holds: some that end in .vtk are XML
  static Mesh read(std::string const& path) {
    const std::string content = io::read_file(path);
    const std::size_t first = content.find_first_not_of(" \t\r\n");
    return first != content.npos && content[first] == '<' ? io::parse_vtk_xml(path, content)
                                                          : io::parse_vtk(path, content);
  }
};
}  // namespace detail

/// Reads a mesh from a legacy VTK file (.vtk), or from a VTK XML file of an unstructured grid (.vtu) or of
/// polygonal data (.vtp).
using MeshVTKLoader = MeshLoader<detail::VtkFormat>;

}  // namespace sinew
