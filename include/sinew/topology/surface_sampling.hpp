// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// Points that cover a surface of triangles and quads at a distance of about `spacing`: its corners, points
/// inside its sides, and a lattice inside each triangle, none nearer than half of the spacing to one before
/// it. They are for boundary particles (FluidBoundary) at the distance of the particles of the fluid.
struct SurfaceSampling {
  using Role = role::Topology;
  static constexpr std::string_view className = "SurfaceSampling";

  std::vector<Eigen::Vector3d> position{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  double spacing = 0.1;

  static constexpr auto fields() {
    using T = SurfaceSampling;
    return field_list(
        field("position", &T::position, "m", "points of the surface"),
        field("triangles", &T::triangles, "", "three points each", range::nonNegative),
        field("quads", &T::quads, "", "four points each, in the order around the quad", range::nonNegative),
        field("spacing", &T::spacing, "m", "distance of the samples", range::positive));
  }

  std::vector<Eigen::Vector3d> samples{};  // after generate

  static constexpr auto outputs() {
    return field_list(field("samples", &SurfaceSampling::samples, "m", "the points that cover the surface"));
  }

  TopologyView view() const { return {.positions = samples}; }

  /// Throws Error where the surface is empty, has other points than it says, or would have more than 2^24
  /// samples.
  void generate(std::string_view where);

  template <class D>
  void init(InitContext<D> const& context) const {
    if (context.rest.size() < samples.size())
      throw Error(text(context.where, ": ", className),
                  text("the state has ",
                       context.rest.size(),
                       " points for ",
                       samples.size(),
                       " samples; leave its positions out"));
  }
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/topology/point_cells.hpp>

#include <array>
#include <cmath>

namespace sinew {

SINEW_ONCE void SurfaceSampling::generate(std::string_view where) {
  const std::string at = text(where, ": ", className);
  std::vector<Triangle> all = triangles;
  for (Quad const& q : quads) {
    all.push_back({q[0], q[1], q[2]});
    all.push_back({q[0], q[2], q[3]});
  }
  if (all.empty()) throw Error(at, "the surface has no triangles and no quads; give some");
  double area = 0, sides = 0;
  for (Triangle const& t : all) {
    for (const Index i : t)
      if (i < 0 || std::size_t(i) >= position.size())
        throw Error(at,
                    text("a face has the point ",
                         i,
                         ", but there are ",
                         position.size(),
                         " points, numbered from 0; correct it"));
    auto const &a = position[std::size_t(t[0])], &b = position[std::size_t(t[1])],
               &c = position[std::size_t(t[2])];
    area += (b - a).cross(c - a).norm() / 2;
    sides += (b - a).norm() + (c - b).norm() + (a - c).norm();
  }
  if (!(area / (spacing * spacing) + sides / spacing < double(1 << 24)))
    throw Error(at,
                text("an area of ",
                     area,
                     " m^2 with sides of ",
                     sides,
                     " m has more than 2^24 samples ",
                     spacing,
                     " m apart; take them wider"));

  // candidates, the best first: corners, sides, insides
  std::vector<Eigen::Vector3d> found;
  for (Triangle const& t : all)
    for (const Index i : t) found.push_back(position[std::size_t(i)]);
  auto parts = [&](double length) { return std::max(1, int(std::lround(length / spacing))); };
  for (Triangle const& t : all)
    for (std::size_t k = 0; k < 3; ++k) {
      // of both triangles of a side the same points
      const Index from = std::min(t[k], t[(k + 1) % 3]), to = std::max(t[k], t[(k + 1) % 3]);
      const Eigen::Vector3d a = position[std::size_t(from)], b = position[std::size_t(to)];
      const int n = parts((b - a).norm());
      for (int i = 1; i < n; ++i) found.push_back(a + (b - a) * (double(i) / n));
    }
  // rows along the longest side
  for (Triangle const& t : all) {
    std::size_t longest = 0;
    std::array<double, 3> length{};
    for (std::size_t k = 0; k < 3; ++k)
      length[k] = (position[std::size_t(t[(k + 1) % 3])] - position[std::size_t(t[k])]).norm();
    for (std::size_t k = 1; k < 3; ++k)
      if (length[k] > length[longest]) longest = k;
    const Eigen::Vector3d a = position[std::size_t(t[longest])],
                          b = position[std::size_t(t[(longest + 1) % 3])],
                          c = position[std::size_t(t[(longest + 2) % 3])];
    if (!(length[longest] > 0)) continue;
    const double height = (b - a).cross(c - a).norm() / length[longest];
    const int rows = parts(height);
    for (int r = 1; r < rows; ++r) {
      const Eigen::Vector3d p = a + (c - a) * (double(r) / rows), q = b + (c - b) * (double(r) / rows);
      const int n = parts((q - p).norm());
      for (int i = 1; i < n; ++i) found.push_back(p + (q - p) * (double(i) / n));
    }
  }

  // one goes that has a nearer one before it
  const double nearest = 0.5 * spacing;
  PointCells cells;
  cells.sort(found, nearest, at);
  std::vector<char> stays(found.size(), 1);
  std::vector<std::vector<int>> around(found.size());
  cells.forEachCell({}, [&](PointCells::Range const& cell, std::array<PointCells::Range, 9> const& rows) {
    for (int i = cell.first; i < cell.second; ++i)
      for (auto const& [begin, end] : rows)
        for (int j = begin; j < end; ++j) {
          const int a = cells.order()[std::size_t(i)], b = cells.order()[std::size_t(j)];
          if (b < a && (found[std::size_t(a)] - found[std::size_t(b)]).norm() < nearest)
            around[std::size_t(a)].push_back(b);
        }
  });
  samples.clear();
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (const int j : around[i])
      if (stays[std::size_t(j)]) stays[i] = 0;
    if (stays[i]) samples.push_back(found[i]);
  }
}

}  // namespace sinew
#endif
