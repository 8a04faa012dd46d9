// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// A flat sheet, made without a file: resolution[0] x resolution[1] points over the unit square of the xy
/// plane, x fastest, and quads or triangles between them.
struct GridMeshCreator {
  using Role = role::Engine;
  static constexpr std::string_view className = "GridMeshCreator";

  std::array<int, 2> resolution{2, 2};
  int trianglePattern = 2;
  Eigen::Vector3d translation{0, 0, 0}, rotation{0, 0, 0}, scale3d{1, 1, 1};

  static constexpr auto fields() {
    using E = GridMeshCreator;
    return field_list(
        field("resolution", &E::resolution, "", "points along x and y", range::atLeast(2)),
        field("trianglePattern",
              &E::trianglePattern,
              "",
              "0: quads; 1: triangles with alternating diagonals; 2: all along x = y; 3: all across it",
              range::closed(0, 3)),
        field("translation", &E::translation, "m", "moves the sheet, last of all"),
        field("rotation",
              &E::rotation,
              "degrees",
              "rotates the sheet about the axes x, y and z, in this order"),
        field("scale3d", &E::scale3d, "", "sizes along the axes x, y and z, applied first").also("scale"));
  }

  // after update
  std::vector<Eigen::Vector3d> position{};
  std::vector<Edge> edges{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};

  static constexpr auto outputs() {
    using E = GridMeshCreator;
    return field_list(field("position", &E::position, "m", "points, x fastest").also("points"),
                      field("edges", &E::edges, "", "sides of the elements, each once").also("lines"),
                      field("triangles", &E::triangles, "", "two of each square, row by row"),
                      field("quads", &E::quads, "", "the squares, row by row"));
  }

  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/placement.hpp>
#include <sinew/topology/adjacency.hpp>

namespace sinew {

SINEW_ONCE void GridMeshCreator::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  const auto [nx, ny] = resolution;
  if (double(nx) * ny > 16777216)
    throw Error(at, text("resolution is ", nx, " x ", ny, ", more than 2^24 points; make it coarser"));
  const Placement placed = placement(translation, rotation, scale3d);
  position.clear(), quads.clear(), triangles.clear();
  for (int y = 0; y < ny; ++y)
    for (int x = 0; x < nx; ++x)
      position.push_back(placed * Eigen::Vector3d(double(x) / (nx - 1), double(y) / (ny - 1), 0));
  for (int y = 0; y + 1 < ny; ++y)
    for (int x = 0; x + 1 < nx; ++x) {
      const Index a = x + nx * y, b = a + 1, c = b + nx, d = a + nx;
      const bool upward = trianglePattern == 2 || (trianglePattern == 1 && (x + y) % 2 == 0);
      if (trianglePattern == 0) {
        quads.push_back({a, b, c, d});
      } else if (upward) {
        triangles.push_back({a, b, c});
        triangles.push_back({a, c, d});
      } else {
        triangles.push_back({a, b, d});
        triangles.push_back({b, c, d});
      }
    }
  edges = trianglePattern == 0 ? edges_of_quads(quads) : edges_of(triangles);
}

}  // namespace sinew
#endif
