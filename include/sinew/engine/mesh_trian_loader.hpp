// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/engine/mesh_loader.hpp>
#include <sinew/io/read_trian.hpp>

namespace sinew {

namespace detail {
struct TrianFormat {
  static constexpr std::string_view className = "MeshTrianLoader", aliases = "", endings = ".trian",
                                    header = "sinew/engine/mesh_trian_loader.hpp";
  static Mesh read(std::string const& path) { return io::read_trian(path); }
};
}  // namespace detail

/// Reads a surface of triangles from a TRIAN file (.trian).
using MeshTrianLoader = MeshLoader<detail::TrianFormat>;

}  // namespace sinew
