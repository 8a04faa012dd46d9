// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/mesh.hpp>

#include <algorithm>
#include <vector>

namespace sinew {

/// An edge from a to b > a that exactly two faces share. next[f] are the points of face f next to a and next
/// to b along its other sides: of a triangle twice the point opposite the edge.
struct Hinge {
  Index a, b;
  std::array<Index, 2> next[2];
};

/// The hinges between faces of one or two kinds, triangles or quads, in lexicographic order of their edges;
/// `next` has the faces in the order in which they are given. Edges of one face, or of more than two, are
/// none.
template <class... Lists>
std::vector<Hinge> find_hinges(Lists const&... lists) {
  struct Side {
    Index a, b;
    std::size_t order;
    std::array<Index, 2> next;
    auto operator<=>(Side const&) const = default;
  };
  std::vector<Side> sides;
  auto add = [&sides](auto const& faces) {
    for (auto const& face : faces)
      for (std::size_t k = 0, n = face.size(); k < n; ++k) {
        Side side{face[k], face[(k + 1) % n], sides.size(), {face[(k + n - 1) % n], face[(k + 2) % n]}};
        if (side.a > side.b) std::swap(side.a, side.b), std::swap(side.next[0], side.next[1]);
        sides.push_back(side);
      }
  };
  (add(lists), ...);
  std::sort(sides.begin(), sides.end());
  std::vector<Hinge> hinges;
  for (std::size_t first = 0, end = 0; first < sides.size(); first = end) {
    while (end < sides.size() && sides[end].a == sides[first].a && sides[end].b == sides[first].b) ++end;
    if (end - first == 2)
      hinges.push_back({sides[first].a, sides[first].b, {sides[first].next, sides[first + 1].next}});
  }
  return hinges;
}

}  // namespace sinew
