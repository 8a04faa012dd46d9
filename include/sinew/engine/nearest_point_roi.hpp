// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

#include <numeric>
#include <vector>

namespace sinew {

/// Pairs of points of two states that are near each other: for each of the second the nearest of the first,
/// where it is nearer than `radius`. Of several at one distance the first counts.
template <class D>
struct NearestPointROI {
  using Role = role::Engine;
  using DataTypes = D;
  static constexpr std::string_view className = "NearestPointROI";

  typename D::VecCoord position1{}, position2{};
  std::vector<int> inputIndices1{}, inputIndices2{};
  double radius = 1;

  static constexpr auto fields() {
    using R = NearestPointROI;
    return field_list(
        field("position1", &R::position1, "m", "points of the first state"),
        field("position2", &R::position2, "m", "points of the second state"),
        field("inputIndices1",
              &R::inputIndices1,
              "",
              "points of the first state to choose from; none for all",
              range::nonNegative),
        field("inputIndices2",
              &R::inputIndices2,
              "",
              "points of the second state to choose from; none for all",
              range::nonNegative),
        field("radius", &R::radius, "m", "distance up to which points are a pair", range::positive));
  }

  // after update
  std::vector<int> indices1{}, indices2{}, indexPairs{};
  std::vector<Edge> edges{};
  std::vector<double> distances{};

  static constexpr auto outputs() {
    using R = NearestPointROI;
    return field_list(
        field("indices1", &R::indices1, "", "point of the first state of each pair"),
        field("indices2", &R::indices2, "", "point of the second state of each pair"),
        field("indexPairs",
              &R::indexPairs,
              "",
              "0 and the point of the first state, 1 and that of the second, of each pair"),
        field("edges",
              &R::edges,
              "",
              "2 k and 2 k + 1 for pair k: its points in a state with the points of indexPairs"),
        field("distances", &R::distances, "m", "distance of the points of each pair"));
  }

  /// Throws Error when a state has no point or an index is out of range; the outputs then stay.
  void update(std::string_view where) {
    check_fields(*this, where);
    const std::string at = text(where, ": ", component_name<NearestPointROI>());
    const std::vector<int> first = chosen(at, '1', position1, inputIndices1),
                           second = chosen(at, '2', position2, inputIndices2);
    indices1.clear(), indices2.clear(), indexPairs.clear(), edges.clear(), distances.clear();
    for (const int j : second) {
      int nearest = first[0];
      for (const int i : first)
        if (distance(i, j) < distance(nearest, j)) nearest = i;
      if (distance(nearest, j) >= radius) continue;
      const int k = int(indices1.size());
      indices1.push_back(nearest);
      indices2.push_back(j);
      indexPairs.insert(indexPairs.end(), {0, nearest, 1, j});
      edges.push_back({2 * k, 2 * k + 1});
      distances.push_back(distance(nearest, j));
    }
  }

 private:
  double distance(int i, int j) const {
    return double((D::center(position1[std::size_t(i)]) - D::center(position2[std::size_t(j)])).norm());
  }
  static std::vector<int> chosen(std::string const& at, char state, typename D::VecCoord const& position,
                                 std::vector<int> const& indices) {
    if (position.empty())
      throw Error(at, text("position", state, " is empty; link it to the rest_position of a state"));
    for (const int i : indices)
      if (std::size_t(i) >= position.size())
        throw Error(at,
                    text("inputIndices",
                         state,
                         " has ",
                         i,
                         ", but position",
                         state,
                         " has ",
                         position.size(),
                         " points, numbered from 0; correct the index"));
    if (!indices.empty()) return indices;
    std::vector<int> all(position.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
};

}  // namespace sinew
