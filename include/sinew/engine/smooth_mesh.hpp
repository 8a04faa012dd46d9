// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// Smooths a mesh: again and again each point, or each of some, goes to the mean of those to which edges lead
/// (Laplacian smoothing; Field 1988).
struct SmoothMeshEngine {
  using Role = role::Engine;
  static constexpr std::string_view className = "SmoothMeshEngine";

  std::vector<Eigen::Vector3d> inputPosition{};
  std::vector<int> inputIndices{};
  int nbIterations = 1;
  std::vector<Edge> edges{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<Hexahedron> hexahedra{};

  static constexpr auto fields() {
    using E = SmoothMeshEngine;
    return field_list(
        field("input_position", &E::inputPosition, "m", "where the points are"),
        field("input_indices", &E::inputIndices, "", "points that move; none for all", range::nonNegative),
        field("nb_iterations", &E::nbIterations, "", "how often", range::nonNegative),
        field("edges", &E::edges, "", "of the mesh", range::nonNegative),
        field("triangles", &E::triangles, "", "whose edges count, too", range::nonNegative),
        field("quads", &E::quads, "", "whose edges count, too", range::nonNegative),
        field("tetrahedra", &E::tetrahedra, "", "whose edges count, too", range::nonNegative),
        field("hexahedra", &E::hexahedra, "", "whose edges count, too", range::nonNegative));
  }

  std::vector<Eigen::Vector3d> outputPosition{};  // after update

  static constexpr auto outputs() {
    return field_list(
        field("output_position", &SmoothMeshEngine::outputPosition, "m", "where the points come to"));
  }

  /// Throws Error where the mesh has no edge, or an index is out of range; the output then stays.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/lists.hpp>
#include <sinew/topology/adjacency.hpp>

#include <numeric>
#include <set>

namespace sinew {

SINEW_ONCE void SmoothMeshEngine::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  const std::size_t n = inputPosition.size();
  detail::check_elements(at, *this, n);
  check_numbers(at, "input_indices", inputIndices, n, "points", "input_position");
  std::vector<std::set<Index>> around(n);
  std::size_t count = 0;
  for (auto const& list :
       {edges, edges_of(triangles), edges_of_quads(quads), edges_of(tetrahedra), edges_of(hexahedra)})
    for (auto const& [a, b] : list) {
      around[std::size_t(a)].insert(b), around[std::size_t(b)].insert(a);
      ++count;
    }
  if (count == 0) throw Error(at, "the mesh has no edge; put it below a topology that has elements");
  std::vector<int> moved = inputIndices;
  if (moved.empty()) {
    moved.resize(n);
    std::iota(moved.begin(), moved.end(), 0);
  }
  std::vector<Eigen::Vector3d> now = inputPosition, next;
  for (int iteration = 0; iteration < nbIterations; ++iteration) {
    next = now;
    for (const int i : moved) {
      if (around[std::size_t(i)].empty()) continue;
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const Index j : around[std::size_t(i)]) sum += now[std::size_t(j)];
      next[std::size_t(i)] = sum / double(around[std::size_t(i)].size());
    }
    now.swap(next);
  }
  outputPosition = std::move(now);
}

}  // namespace sinew
#endif
