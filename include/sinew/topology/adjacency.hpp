// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/mesh.hpp>

#include <array>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

namespace sinew {

/// For each of a range of items a list of numbers, one list after the other (compressed sparse rows).
/// The list of item i is targets[offsets[i]] ... targets[offsets[i + 1] - 1]; a[i] is a span of it.
struct Adjacency {
  std::vector<std::size_t> offsets{0};
  std::vector<Index> targets{};

  std::size_t size() const { return offsets.size() - 1; }
  std::span<Index const> operator[](std::size_t i) const {
    return {targets.data() + offsets[i], offsets[i + 1] - offsets[i]};
  }
  bool operator==(Adjacency const&) const = default;
};

namespace detail {

using EdgeCorners = std::array<std::size_t, 2>;
inline constexpr std::array<EdgeCorners, 3> triangleSides{{{0, 1}, {1, 2}, {0, 2}}};
inline constexpr std::array<EdgeCorners, 4> quadSides{{{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
inline constexpr std::array<EdgeCorners, 6> tetrahedronEdges{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
inline constexpr std::array<EdgeCorners, 12> hexahedronEdges{
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};
inline constexpr std::array<EdgeCorners, 8> pyramidEdges{
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}};
inline constexpr std::array<EdgeCorners, 9> prismEdges{
    {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}};

/// A face without its orientation, which is kept apart: the outward order is an even permutation of `points`,
/// or odd.
struct Face {
  Triangle points;
  bool odd;
};

}  // namespace detail

/// The different edges of triangles, tetrahedra, hexahedra (12 a cell), pyramids or prisms. In each edge the
/// lower point comes first; the edges are in lexicographic order. Throws Error on a negative index or an edge
/// from a point to itself.
std::vector<Edge> edges_of(std::vector<Triangle> const& triangles);
std::vector<Edge> edges_of(std::vector<Tetrahedron> const& tetrahedra);
std::vector<Edge> edges_of(std::vector<Hexahedron> const& hexahedra);
std::vector<Edge> edges_of(std::vector<Pyramid> const& pyramids);
std::vector<Edge> edges_of(std::vector<Prism> const& prisms);

/// The different sides of quads, as edges_of. (Quad and Tetrahedron are one type, hence the other name.)
std::vector<Edge> edges_of_quads(std::vector<Quad> const& quads);

/// The faces that belong to one tetrahedron only, their front outwards where the tetrahedra are positively
/// oriented. Each starts with its lowest point; they are in lexicographic order of their sorted points.
/// Throws Error on a negative index, a point used twice by a tetrahedron, or a face of three tetrahedra.
std::vector<Triangle> boundary_triangles(std::vector<Tetrahedron> const& tetrahedra);

/// For each of `points` points the elements (edges, triangles...) that use it, in ascending order.
/// Throws Error when an element refers to a point that is missing.
template <class Element>
Adjacency elements_around(std::vector<Element> const& elements, std::size_t points) {
  detail::check_indices("elements_around", "element", elements, points);
  Adjacency around;
  around.offsets.assign(points + 1, 0);
  for (Element const& element : elements)
    for (const Index i : element) ++around.offsets[std::size_t(i) + 1];
  std::partial_sum(around.offsets.begin(), around.offsets.end(), around.offsets.begin());
  around.targets.resize(around.offsets.back());
  std::vector<std::size_t> next(around.offsets.begin(), around.offsets.end() - 1);
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (const Index i : elements[e]) around.targets[next[std::size_t(i)]++] = Index(e);
  return around;
}

/// For each of `points` points those that an edge joins to it, in ascending order. Edges must differ, as
/// those of edges_of do. Throws Error when an edge refers to a point that is missing.
Adjacency neighbours(std::vector<Edge> const& edges, std::size_t points);

/// Drops the points that no element uses; the others keep their order. Throws Error on an index out of range.
void remove_unused_points(Mesh& mesh);

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/error.hpp>

#include <algorithm>
#include <limits>
#include <string_view>

namespace sinew::detail {

/// The different edges of the elements, lower end first, in lexicographic order.
template <class Element, std::size_t N>
std::vector<Edge> unique_edges(std::string_view kind, std::vector<Element> const& elements,
                               std::array<EdgeCorners, N> const& corners) {
  check_indices("edges_of", kind, elements, std::numeric_limits<std::size_t>::max());
  std::vector<Edge> edges;
  edges.reserve(N * elements.size());
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (auto const& [i, j] : corners) {
      const Index a = elements[e][i], b = elements[e][j];
      if (a == b)
        throw Error("edges_of",
                    text(kind, ' ', e, " uses point ", a, " twice; remove or correct the element"));
      edges.push_back({std::min(a, b), std::max(a, b)});
    }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

inline Face sorted_face(Triangle t) {
  bool odd = false;
  auto order = [&](Index& a, Index& b) {
    if (a > b) std::swap(a, b), odd = !odd;
  };
  order(t[0], t[1]), order(t[1], t[2]), order(t[0], t[1]);
  return {t, odd};
}

}  // namespace sinew::detail

namespace sinew {

SINEW_ONCE std::vector<Edge> edges_of(std::vector<Triangle> const& triangles) {
  return detail::unique_edges("triangle", triangles, detail::triangleSides);
}

SINEW_ONCE std::vector<Edge> edges_of(std::vector<Tetrahedron> const& tetrahedra) {
  return detail::unique_edges("tetrahedron", tetrahedra, detail::tetrahedronEdges);
}

SINEW_ONCE std::vector<Edge> edges_of(std::vector<Hexahedron> const& hexahedra) {
  return detail::unique_edges("hexahedron", hexahedra, detail::hexahedronEdges);
}

SINEW_ONCE std::vector<Edge> edges_of(std::vector<Pyramid> const& pyramids) {
  return detail::unique_edges("pyramid", pyramids, detail::pyramidEdges);
}

SINEW_ONCE std::vector<Edge> edges_of(std::vector<Prism> const& prisms) {
  return detail::unique_edges("prism", prisms, detail::prismEdges);
}

SINEW_ONCE std::vector<Edge> edges_of_quads(std::vector<Quad> const& quads) {
  return detail::unique_edges("quad", quads, detail::quadSides);
}

SINEW_ONCE std::vector<Triangle> boundary_triangles(std::vector<Tetrahedron> const& tetrahedra) {
  const std::string_view where = "boundary_triangles";
  detail::check_indices(where, "tetrahedron", tetrahedra, std::numeric_limits<std::size_t>::max());
  std::vector<detail::Face> faces;
  faces.reserve(4 * tetrahedra.size());
  for (std::size_t e = 0; e < tetrahedra.size(); ++e) {
    const auto& [a, b, c, d] = tetrahedra[e];
    if (a == b || a == c || a == d || b == c || b == d || c == d)
      throw Error(where, text("tetrahedron ", e, " uses a point twice; remove or correct it"));
    for (Triangle const& t : {Triangle{b, c, d}, Triangle{a, d, c}, Triangle{a, b, d}, Triangle{a, c, b}})
      faces.push_back(detail::sorted_face(t));
  }
  std::sort(faces.begin(), faces.end(), [](auto const& f, auto const& g) { return f.points < g.points; });
  std::vector<Triangle> boundary;
  for (std::size_t i = 0, next; i < faces.size(); i = next) {
    const auto& [a, b, c] = faces[i].points;
    for (next = i + 1; next < faces.size() && faces[next].points == faces[i].points;) ++next;
    if (next - i > 2)
      throw Error(where,
                  text("the face of points ",
                       a,
                       ", ",
                       b,
                       ", ",
                       c,
                       " belongs to ",
                       next - i,
                       " tetrahedra, which must overlap; at most 2 can share it. Remove the duplicates"));
    if (next - i == 1) boundary.push_back(faces[i].odd ? Triangle{a, c, b} : Triangle{a, b, c});
  }
  return boundary;
}

SINEW_ONCE Adjacency neighbours(std::vector<Edge> const& edges, std::size_t points) {
  Adjacency around = elements_around(edges, points);
  for (std::size_t i = 0; i < points; ++i) {
    const auto begin = around.targets.begin() + std::ptrdiff_t(around.offsets[i]);
    const auto end = around.targets.begin() + std::ptrdiff_t(around.offsets[i + 1]);
    std::transform(begin, end, begin, [&](Index e) {
      Edge const& edge = edges[std::size_t(e)];
      return edge[0] == Index(i) ? edge[1] : edge[0];
    });
    std::sort(begin, end);
  }
  return around;
}

SINEW_ONCE void remove_unused_points(Mesh& mesh) {
  check_mesh("remove_unused_points", mesh);
  std::vector<Index> number(mesh.positions.size(), -1);
  auto each = [&](auto change) {
    for_each_kind(mesh, [&](int, auto& elements) {
      for (auto& element : elements)
        for (Index& i : element) change(i);
    });
  };
  each([&](Index& i) { number[std::size_t(i)] = 0; });
  Index count = 0;
  for (std::size_t i = 0; i < number.size(); ++i)
    if (number[i] == 0) mesh.positions[std::size_t(count)] = mesh.positions[i], number[i] = count++;
  mesh.positions.resize(std::size_t(count));
  each([&](Index& i) { i = number[std::size_t(i)]; });
}

}  // namespace sinew
#endif
