// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/engine/mesh_loader.hpp>
#include <sinew/io/read_ply.hpp>

namespace sinew {

namespace detail {
struct PlyFormat {
  static constexpr std::string_view className = "MeshPLYLoader", aliases = "MeshPlyLoader", endings = ".ply",
                                    header = "sinew/engine/mesh_ply_loader.hpp";
  static Mesh read(std::string const& path) { return io::read_ply(path); }
};
}  // namespace detail

/// Reads a mesh of points, edges and faces from a polygon file of Stanford (.ply).
using MeshPLYLoader = MeshLoader<detail::PlyFormat>;

}  // namespace sinew
