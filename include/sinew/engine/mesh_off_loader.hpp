// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/engine/mesh_loader.hpp>
#include <sinew/io/read_off.hpp>

namespace sinew {

namespace detail {
struct OffFormat {
  static constexpr std::string_view className = "MeshOffLoader", aliases = "", endings = ".off",
                                    header = "sinew/engine/mesh_off_loader.hpp";
  static Mesh read(std::string const& path) { return io::read_off(path); }
};
}  // namespace detail

/// Reads a surface from a file of the Object File Format (.off).
using MeshOffLoader = MeshLoader<detail::OffFormat>;

}  // namespace sinew
