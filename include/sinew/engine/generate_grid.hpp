// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <array>
#include <vector>

namespace sinew {

/// A block of cells between two corners, made without a file: hexahedra, and six tetrahedra for each; a sheet
/// of quads, with two triangles for each, where the resolution along z is 0. Points are numbered x fastest,
/// cells z fastest.
struct GenerateGrid {
  using Role = role::Engine;
  static constexpr std::string_view className = "GenerateGrid";

  Eigen::Vector3d min{0, 0, 0}, max{0, 0, 0};
  std::array<int, 3> resolution{3, 3, 3};

  static constexpr auto fields() {
    using E = GenerateGrid;
    return field_list(field("min", &E::min, "m", "the one corner of the block"),
                      field("max", &E::max, "m", "the opposite corner"),
                      field("resolution",
                            &E::resolution,
                            "",
                            "cells along x, y and z; 0 along z makes a sheet",
                            range::nonNegative));
  }

  // after update
  std::vector<Eigen::Vector3d> position{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<Hexahedron> hexahedra{};

  static constexpr auto outputs() {
    using E = GenerateGrid;
    return field_list(field("output_position", &E::position, "m", "points, x fastest").also("position"),
                      field("triangles", &E::triangles, "", "two of each square of a sheet"),
                      field("quads", &E::quads, "", "the squares of a sheet"),
                      field("tetrahedra", &E::tetrahedra, "", "six of each cell of a block"),
                      field("hexahedra", &E::hexahedra, "", "the cells of a block"));
  }

  /// Throws Error where the block has no extent, or more than 2^24 points.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
namespace sinew {

SINEW_ONCE void GenerateGrid::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  const auto [nx, ny, nz] = resolution;
  if (nx < 1 || ny < 1)
    throw Error(at, text("resolution is ", nx, ' ', ny, ' ', nz, "; give 1 or more along x and y"));
  if ((nx + 1.0) * (ny + 1.0) * (nz + 1.0) > 16777216)
    throw Error(at, text("resolution is ", nx, ' ', ny, ' ', nz, ", more than 2^24 points; make it coarser"));
  const Eigen::Vector3d size = max - min;
  for (int c = 0; c < (nz > 0 ? 3 : 2); ++c)
    if (size[c] == 0)
      throw Error(
          at,
          text("min and max are at one ", "xyz"[c], ", ", min[c], " m; give corners that are apart there"));
  position.clear(), triangles.clear(), quads.clear(), tetrahedra.clear(), hexahedra.clear();
  for (int k = 0; k <= nz; ++k)
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i)
        position.push_back(
            min + Eigen::Vector3d(i * size[0] / nx, j * size[1] / ny, nz > 0 ? k * size[2] / nz : 0));
  auto point = [row = nx + 1, layer = (nx + 1) * (ny + 1)](int i, int j, int k) -> Index {
    return i + row * j + layer * k;
  };
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j) {
      if (nz == 0) {
        const Quad q{point(i, j, 0), point(i + 1, j, 0), point(i + 1, j + 1, 0), point(i, j + 1, 0)};
        quads.push_back(q);
        triangles.push_back({q[0], q[1], q[3]});
        triangles.push_back({q[3], q[1], q[2]});
      }
      for (int k = 0; k < nz; ++k) {
        const Hexahedron h{point(i, j, k),
                           point(i + 1, j, k),
                           point(i + 1, j + 1, k),
                           point(i, j + 1, k),
                           point(i, j, k + 1),
                           point(i + 1, j, k + 1),
                           point(i + 1, j + 1, k + 1),
                           point(i, j + 1, k + 1)};
        hexahedra.push_back(h);
        // around the diagonal from corner 0 to 6
        constexpr std::size_t cut[6][4] = {
            {0, 5, 1, 6}, {0, 1, 3, 6}, {1, 3, 6, 2}, {6, 3, 0, 7}, {6, 7, 0, 5}, {7, 5, 4, 0}};
        for (auto const& c : cut) tetrahedra.push_back({h[c[0]], h[c[1]], h[c[2]], h[c[3]]});
      }
    }
}

}  // namespace sinew
#endif
