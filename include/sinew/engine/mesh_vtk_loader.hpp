// SPDX-License-Identifier: BSL-1.0
#pragma once

// It needs pugixml, as read_vtu.hpp does, and is therefore not among the loaders of mesh_loader.hpp.
#include <sinew/engine/mesh_loader.hpp>
#include <sinew/io/read_vtk.hpp>
#include <sinew/io/read_vtu.hpp>
#include <sinew/io/text_mesh_file.hpp>

namespace sinew {

namespace detail {
struct VtkFormat {
  static constexpr std::string_view className = "MeshVTKLoader", aliases = "", endings = ".vtk .vtu",
                                    header = "sinew/engine/mesh_vtk_loader.hpp";
  static Mesh read(std::string const& path) {
    return io::file_ending(path) == ".vtu" ? io::read_vtu(path) : io::read_vtk(path);
  }
};
}  // namespace detail

/// Reads a mesh from a legacy VTK file (.vtk), or from a VTK XML file of an unstructured grid (.vtu).
using MeshVTKLoader = MeshLoader<detail::VtkFormat>;

}  // namespace sinew
