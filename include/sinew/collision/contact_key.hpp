// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/fields.hpp>

#include <algorithm>
#include <array>
#include <compare>

namespace sinew {

/// What of a primitive touches. Features stand in an order: as a whole, faces, none, then vertices, each
/// before the edges from it to higher ones.
struct Feature {
  /// whole: a body that is stopped as a whole, wherever it would be hit; none: nothing is said.
  enum class Kind { whole = -3, face = -2, none = -1, vertex, edge };

  // a vertex i is {i, -1}, an edge {i, j} with i < j, a face {Kind::face, its number or -1}
  int first = int(Kind::none), second = -1;

  static constexpr Feature vertex(int i) { return {i, -1}; }
  static constexpr Feature edge(int i, int j) { return {std::min(i, j), std::max(i, j)}; }
  /// Faces of a hull, which is known by its points, have no number.
  static constexpr Feature face(int number = -1) { return {int(Kind::face), number}; }
  static constexpr Feature whole() { return {int(Kind::whole), -1}; }

  constexpr Kind kind() const { return first < 0 ? Kind(first) : second < 0 ? Kind::vertex : Kind::edge; }
  constexpr bool isVertexOrNone() const { return first >= int(Kind::none) && second < 0; }
  static constexpr auto fields() {
    return field_list(field("first", &Feature::first, "", "vertex, first of the edge, or kind"),
                      field("second", &Feature::second, "", "second of the edge, or number of the face"));
  }
  auto operator<=>(Feature const&) const = default;
};

/// By what a contact is known again in the next step, and in which order contacts stand: the two models, in
/// the order of the scene, the vertices that meet, rising, with -1 before them where they are fewer than
/// three, and what of a hull touches. Vertices say more than the number of an element would: an edge between
/// two triangles is the same edge for both.
struct ContactKey {
  std::array<int, 2> surfaces{-1, -1};
  std::array<std::array<int, 3>, 2> vertices{{{-1, -1, -1}, {-1, -1, -1}}};
  std::array<Feature, 2> features{};

  /// Whether one vertex, or one corner of a hull, is all that touches on a side.
  bool ofOneVertex(std::size_t side) const {
    return vertices[side][1] < 0 && features[side].isVertexOrNone();
  }
  auto operator<=>(ContactKey const&) const = default;
};

}  // namespace sinew
