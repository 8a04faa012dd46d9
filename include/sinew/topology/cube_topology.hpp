// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/topology/element_checks.hpp>

#include <optional>
#include <vector>

namespace sinew {

/// The surface of a box of nx x ny x nz points: squares with their fronts outside, and their sides. The
/// points are those of the lowest layer, x fastest, of the highest, and of each one between its row of lowest
/// y, that of highest y, the column of lowest x and that of highest x; with `internalPoints` all of the box,
/// as a RegularGridTopology numbers them; with `splitNormals` each of the six faces has its own, in the order
/// of lowest x, y, z and highest x, y, z.
struct CubeTopology {
  using Role = role::Topology;
  static constexpr std::string_view className = "CubeTopology";

  int nx = 2, ny = 2, nz = 2;
  bool internalPoints = false, splitNormals = false;
  Eigen::Vector3d min{0, 0, 0}, max{1, 1, 1};
  std::optional<double> xmin{}, ymin{}, zmin{}, xmax{}, ymax{}, zmax{};

  static constexpr auto fields() {
    using T = CubeTopology;
    return field_list(field("nx", &T::nx, "", "points along x", range::atLeast(2)),
                      field("ny", &T::ny, "", "points along y", range::atLeast(2)),
                      field("nz", &T::nz, "", "points along z", range::atLeast(2)),
                      field("internalPoints", &T::internalPoints, "", "the points inside are there, too"),
                      field("splitNormals", &T::splitNormals, "", "each face has points of its own"),
                      field("min", &T::min, "m", "lowest corner of the box"),
                      field("max", &T::max, "m", "highest corner of the box"),
                      field("xmin", &T::xmin, "m", "lowest x, in place of that of min"),
                      field("ymin", &T::ymin, "m", "lowest y, in place of that of min"),
                      field("zmin", &T::zmin, "m", "lowest z, in place of that of min"),
                      field("xmax", &T::xmax, "m", "highest x, in place of that of max"),
                      field("ymax", &T::ymax, "m", "highest y, in place of that of max"),
                      field("zmax", &T::zmax, "m", "highest z, in place of that of max"));
  }

  // after generate
  std::vector<Eigen::Vector3d> position{};
  std::vector<Edge> edges{};
  std::vector<Quad> quads{};

  static constexpr auto outputs() {
    using T = CubeTopology;
    return field_list(field("position", &T::position, "m", "the points").also("points"),
                      field("edges", &T::edges, "", "the sides of the quads, each once").also("lines"),
                      field("quads", &T::quads, "", "those of lowest and highest z, then y, then x"));
  }

  TopologyView view() const { return {.positions = position, .edges = edges, .quads = quads}; }

  /// Throws Error when the box is empty, or above 2^24 points.
  void generate(std::string_view where);

  /// Throws Error where the state has fewer points than the surface.
  template <class D>
  void init(InitContext<D> const& context) const {
    check_grid_state(text(context.where, ": ", className), position.size(), context.rest.size());
  }

 private:
  template <class Use>
  static void useSurface(std::array<int, 3> const& n, Use&& use) {
    auto point = [&n](int x, int y, int z) { return x + n[0] * (y + n[1] * z); };
    for (const int z : {0, n[2] - 1})
      for (int y = 0; y < n[1]; ++y)
        for (int x = 0; x < n[0]; ++x) use(point(x, y, z));
    for (int z = 1; z + 1 < n[2]; ++z) {
      for (const int y : {0, n[1] - 1})
        for (int x = 0; x < n[0]; ++x) use(point(x, y, z));
      for (const int x : {0, n[0] - 1})
        for (int y = 1; y + 1 < n[1]; ++y) use(point(x, y, z));
    }
  }
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/topology/regular_grid.hpp>

#include <algorithm>

namespace sinew {

SINEW_ONCE void CubeTopology::generate(std::string_view where) {
  const std::string at = text(where, ": ", className);
  const Eigen::Vector3d lo(xmin.value_or(min[0]), ymin.value_or(min[1]), zmin.value_or(min[2]));
  const Eigen::Vector3d hi(xmax.value_or(max[0]), ymax.value_or(max[1]), zmax.value_or(max[2]));
  const std::array<int, 3> n{nx, ny, nz};
  const std::vector<Eigen::Vector3d> box = detail::grid_points(at, n, lo, hi, 2, 24).positions;
  const std::array<Index, 3> step{1, nx, nx * ny};

  position.clear(), edges.clear(), quads.clear();
  std::vector<Index> number(box.size(), -1);  // of the points of the box
  auto use = [&](Index p) {
    number[std::size_t(p)] = Index(position.size());
    position.push_back(box[std::size_t(p)]);
  };
  if (internalPoints && !splitNormals)
    for (Index p = 0; p < Index(box.size()); ++p) use(p);
  else if (!splitNormals)
    useSurface(n, use);

  // which squares turn outwards depends on the side: (a, b, axis) is right-handed for z and x, left-handed
  // for y
  struct Face {
    std::size_t axis, a, b;
    bool high;
  };
  auto squares = [&](Face const& face) {
    const Index base = face.high ? (n[face.axis] - 1) * step[face.axis] : 0;
    for (int j = 0; j + 1 < n[face.b]; ++j)
      for (int i = 0; i + 1 < n[face.a]; ++i) {
        const Index p = base + i * step[face.a] + j * step[face.b], a = step[face.a], b = step[face.b];
        Quad q = face.high == (face.axis != 1) ? Quad{p, p + a, p + a + b, p + b}
                                               : Quad{p, p + b, p + a + b, p + a};
        for (Index& k : q) k = number[std::size_t(k)];
        quads.push_back(q);
      }
  };
  constexpr Face inOrder[] = {{2, 0, 1, false},
                              {2, 0, 1, true},
                              {1, 0, 2, false},
                              {1, 0, 2, true},
                              {0, 1, 2, false},
                              {0, 1, 2, true}};
  if (splitNormals) {
    // their points have another order than their squares
    std::vector<Quad> ofFace[6];
    for (const std::size_t f : {4U, 2U, 0U, 5U, 3U, 1U}) {
      Face const& face = inOrder[f];
      const Index base = face.high ? (n[face.axis] - 1) * step[face.axis] : 0;
      for (int j = 0; j < n[face.b]; ++j)
        for (int i = 0; i < n[face.a]; ++i) use(base + i * step[face.a] + j * step[face.b]);
      squares(face);
      ofFace[f] = std::move(quads);
      quads.clear();
    }
    for (auto const& list : ofFace) quads.insert(quads.end(), list.begin(), list.end());
  } else {
    for (Face const& face : inOrder) squares(face);
  }
  for (Quad const& q : quads)
    for (std::size_t k = 0; k < 4; ++k)
      edges.push_back({std::min(q[k], q[(k + 1) % 4]), std::max(q[k], q[(k + 1) % 4])});
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
}

}  // namespace sinew
#endif
