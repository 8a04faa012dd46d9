// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// Closes the holes of a surface: each loop of edges that one triangle or quad only has gets a point in its
/// middle, the mean of its points, and a triangle from there to each of its edges.
struct MeshClosingEngine {
  using Role = role::Engine;
  static constexpr std::string_view className = "MeshClosingEngine";

  std::vector<Eigen::Vector3d> inputPosition{};
  std::vector<Triangle> inputTriangles{};
  std::vector<Quad> inputQuads{};

  static constexpr auto fields() {
    using E = MeshClosingEngine;
    return field_list(field("inputPosition", &E::inputPosition, "m", "points of the surface"),
                      field("inputTriangles", &E::inputTriangles, "", "of the surface", range::nonNegative),
                      field("inputQuads", &E::inputQuads, "", "of the surface", range::nonNegative));
  }

  // after update
  std::vector<Eigen::Vector3d> position{}, closingPosition{};
  std::vector<Triangle> triangles{}, closingTriangles{};
  std::vector<Quad> quads{};
  std::vector<std::vector<int>> indices{};

  static constexpr auto outputs() {
    using E = MeshClosingEngine;
    return field_list(
        field("position", &E::position, "m", "the points, and a middle for each hole"),
        field("triangles", &E::triangles, "", "those of the surface, and those that close it"),
        field("quads", &E::quads, "", "those of the surface"),
        field("indices", &E::indices, "", "of each hole: the points around it, and its middle"),
        field("closingPosition", &E::closingPosition, "m", "the same points for each hole"),
        field("closingTriangles", &E::closingTriangles, "", "what closes the holes, over closingPosition"));
  }

  /// Throws Error where an element refers to a missing point; the outputs then stay.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <map>
#include <set>

namespace sinew {

SINEW_ONCE void MeshClosingEngine::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  detail::check_indices(at, "triangle", inputTriangles, inputPosition.size());
  detail::check_indices(at, "quad", inputQuads, inputPosition.size());
  position = inputPosition, triangles = inputTriangles, quads = inputQuads;
  indices.clear(), closingPosition.clear(), closingTriangles.clear();

  // edges without one of the other direction
  std::set<Edge> open;
  auto add = [&](auto const& face) {
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Index a = face[(k + face.size() - 1) % face.size()], b = face[k];
      if (open.erase({b, a}) == 0) open.insert({a, b});
    }
  };
  for (auto const& t : inputTriangles) add(t);
  for (auto const& q : inputQuads) add(q);
  std::map<Index, Index> next;
  for (auto const& [a, b] : open) next[a] = b;

  while (!next.empty()) {
    // from edge to edge until the loop is closed, or ends
    std::vector<int> loop{next.begin()->first};
    for (auto edge = next.begin(); edge != next.end();) {
      const Index to = edge->second;
      next.erase(edge);
      if (to == loop.front()) break;
      loop.push_back(to);
      edge = next.find(to);
    }
    if (loop.size() < 2) continue;
    const Index middle = Index(position.size()), first = Index(closingPosition.size()),
                last = first + Index(loop.size()) - 1;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < loop.size(); ++k) {
      mean += inputPosition[std::size_t(loop[k])];
      closingPosition.push_back(inputPosition[std::size_t(loop[k])]);
      closingTriangles.push_back({last + 1, first + Index(k), k > 0 ? first + Index(k) - 1 : last});
      triangles.push_back({middle, loop[k], k > 0 ? loop[k - 1] : loop.back()});
    }
    mean /= double(loop.size());
    closingPosition.push_back(mean);
    position.push_back(mean);
    loop.push_back(middle);
    indices.push_back(std::move(loop));
  }
}

}  // namespace sinew
#endif
