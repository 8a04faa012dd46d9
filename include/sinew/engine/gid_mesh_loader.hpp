// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/engine/mesh_loader.hpp>
#include <sinew/io/read_gid.hpp>

namespace sinew {

namespace detail {
struct GidFormat {
  static constexpr std::string_view className = "GIDMeshLoader", aliases = "", endings = ".gidmsh",
                                    header = "sinew/engine/gid_mesh_loader.hpp";
  static Mesh read(std::string const& path) { return io::read_gid(path); }
};
}  // namespace detail

/// Reads a mesh of the preprocessor GiD (.gidmsh).
using GIDMeshLoader = MeshLoader<detail::GidFormat>;

}  // namespace sinew
