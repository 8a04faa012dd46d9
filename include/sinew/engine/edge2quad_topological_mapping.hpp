// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <limits>
#include <vector>

namespace sinew {

/// Makes a tube of the edges of another topology: a circle of N points in the plane of y and z around each of
/// its points, i N to i N + N - 1 around point i, and N quads along each edge. Below a TubularMapping the
/// circles turn with frames. With radiusFocal they are ellipses whose axis of that length is the focalAxis.
struct Edge2QuadTopologicalMapping {
  using Role = role::Engine;
  static constexpr bool joinsTopologies = true;
  static constexpr std::string_view className = "Edge2QuadTopologicalMapping";

  std::vector<Eigen::Vector3d> position{};
  std::vector<Edge> edges{};
  int nbPointsOnEachCircle = 0;
  double radius = 1, radiusFocal = 0;
  Eigen::Vector3d focalAxis{0, 0, 1};
  std::vector<int> edgeList{};
  bool flipNormals = false;

  static constexpr auto fields() {
    using T = Edge2QuadTopologicalMapping;
    return field_list(
        field("position", &T::position, "m", "points").also("points"),
        field("edges", &T::edges, "", "elements over them", range::nonNegative),
        field("nbPointsOnEachCircle", &T::nbPointsOnEachCircle, "", "points around each", range::nonNegative),
        field("radius", &T::radius, "m", "of the circles", range::positive),
        field("radiusFocal",
              &T::radiusFocal,
              "m",
              "of ellipses along the focal axis; 0: circles",
              range::nonNegative),
        field("focalAxis", &T::focalAxis, "", "direction of the second axis of ellipses"),
        field("edgeList", &T::edgeList, "", "the edges that get quads; none: all", range::nonNegative)
            .numbersOf(Of::edges),
        field("flipNormals", &T::flipNormals, "", "whether quads are seen from inside"));
  }

  // after update
  std::vector<Eigen::Vector3d> circles{};
  std::vector<Quad> quads{};

  static constexpr auto outputs() {
    using T = Edge2QuadTopologicalMapping;
    return field_list(field("position", &T::circles, "m", "points of the circles").also("points"),
                      field("quads", &T::quads, "", "faces of the tube"));
  }

  /// Throws Error where an edge or the edgeList leads nowhere, there is no number of points, or the focal
  /// axis has no direction.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/lists.hpp>
#include <sinew/core/memory_limit.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace sinew {

SINEW_ONCE void Edge2QuadTopologicalMapping::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  if (nbPointsOnEachCircle < 1)
    throw Error(at, "nbPointsOnEachCircle is 0; give how many points are around each point");
  const std::size_t n = std::size_t(nbPointsOnEachCircle);
  // a topology may have no points of its own: those of the state, which its edges number
  std::size_t points = position.size();
  if (position.empty())
    for (Edge const& e : edges) points = std::max(points, std::size_t(std::max(e[0], e[1])) + 1);
  detail::check_indices(at, "edge", edges, points);
  check_numbers(at, "edgeList", edgeList, edges.size(), "edges", "the topology");
  check_memory(at, text(points, " circles of ", n, " points"), double(points) * double(n));
  Eigen::Vector3d y(0, 1, 0), z(0, 0, 1);
  if (radiusFocal > 0) {
    z = focalAxis.normalized();
    y = z.cross(Eigen::Vector3d::UnitX());
    if (!(y.norm() > 0))
      throw Error(at, "focalAxis is along x, or no direction; give one across, such as 0 0 1");
    y.normalize();
  }
  circles.clear(), quads.clear();
  for (std::size_t i = 0; i < points; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const double phi = 2 * std::numbers::pi * double(j) / double(n);
      const Eigen::Vector3d center = position.empty() ? Eigen::Vector3d::Zero().eval() : position[i];
      circles.push_back(center + radius * std::cos(phi) * y +
                        (radiusFocal > 0 ? radiusFocal : radius) * std::sin(phi) * z);
    }
  auto add = [&](Edge const& e) {
    for (int j = 0; j < nbPointsOnEachCircle; ++j) {
      const Index next = (j + 1) % nbPointsOnEachCircle, a = e[0] * nbPointsOnEachCircle,
                  b = e[1] * nbPointsOnEachCircle;
      Quad q{a + j, b + j, b + next, a + next};
      if (flipNormals) std::reverse(q.begin(), q.end());
      quads.push_back(q);
    }
  };
  if (edgeList.empty())
    for (Edge const& e : edges) add(e);
  else
    for (const int i : edgeList) add(edges[std::size_t(i)]);
}

}  // namespace sinew
#endif
