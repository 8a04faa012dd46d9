// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/error.hpp>
#include <sinew/core/small_matrix.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

namespace sinew {

using Index = int;
using Edge = std::array<Index, 2>;
using Triangle = std::array<Index, 3>;
using Quad = std::array<Index, 4>;
using Tetrahedron = std::array<Index, 4>;
using Hexahedron = std::array<Index, 8>;
using Pyramid = std::array<Index, 5>;  // its base, then its apex
using Prism = std::array<Index, 6>;    // a triangle, then the opposite one: VTK's wedge
// Elements of second order: their corners, then the middles of edges, of faces (x-, x+, y-, y+, z-, z+), and
// of all, in VTK's order. Gmsh has another (io/cells.hpp).
using QuadraticTetrahedron = std::array<Index, 10>;
using QuadraticHexahedron = std::array<Index, 20>;
using TriquadraticHexahedron = std::array<Index, 27>;

/// Points and the elements over them, as files hold them. Node order of elements is VTK's.
struct Mesh {
  std::vector<Eigen::Vector3d> positions{};
  std::vector<Edge> edges{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<Hexahedron> hexahedra{};
  std::vector<Pyramid> pyramids{};
  std::vector<Prism> prisms{};
  std::vector<QuadraticTetrahedron> quadraticTetrahedra{};
  std::vector<QuadraticHexahedron> quadraticHexahedra{};
  std::vector<TriquadraticHexahedron> triquadraticHexahedra{};

  bool operator==(Mesh const&) const = default;
};

/// The kinds of elements that a topology has, in the order in which messages and changes list them.
enum class ElementKind {
  edge,
  triangle,
  quad,
  tetrahedron,
  hexahedron,
  pyramid,
  prism,
  quadraticTetrahedron,
  quadraticHexahedron,
  triquadraticHexahedron
};
inline constexpr int element_kinds = 10;
constexpr std::string_view element_kind_name(int kind) {
  constexpr std::array<std::string_view, element_kinds> names{"edge",
                                                              "triangle",
                                                              "quad",
                                                              "tetrahedron",
                                                              "hexahedron",
                                                              "pyramid",
                                                              "prism",
                                                              "quadratic tetrahedron",
                                                              "quadratic hexahedron",
                                                              "triquadratic hexahedron"};
  return names[std::size_t(kind)];
}
constexpr int dimension_of_kind(int kind) { return kind == 0 ? 1 : kind < 3 ? 2 : 3; }

/// f(kind, list) for each list of elements of a mesh, or of what has lists of these names; not all have
/// pyramids and prisms, nor elements of second order.
template <class Lists, class F>
constexpr void for_each_kind(Lists&& lists, F&& f) {
  f(0, lists.edges), f(1, lists.triangles), f(2, lists.quads), f(3, lists.tetrahedra), f(4, lists.hexahedra);
  if constexpr (requires { lists.prisms; }) f(5, lists.pyramids), f(6, lists.prisms);
  if constexpr (requires { lists.quadraticTetrahedra; })
    f(7, lists.quadraticTetrahedra), f(8, lists.quadraticHexahedra), f(9, lists.triquadraticHexahedra);
}
/// The highest dimension of which there are elements; 0 for none.
template <class Lists>
constexpr int dimension_of(Lists const& lists) {
  int highest = 0;
  for_each_kind(lists, [&](int kind, auto const& list) {
    if (!list.empty() && dimension_of_kind(kind) > highest) highest = dimension_of_kind(kind);
  });
  return highest;
}
/// f(kind, list) for each list of elements of the highest dimension that there are; of edges where there are
/// none.
template <class Lists, class F>
constexpr void for_each_highest(Lists const& lists, F&& f) {
  const int dimension = dimension_of(lists) > 0 ? dimension_of(lists) : 1;
  for_each_kind(lists, [&](int kind, auto const& list) {
    if (dimension_of_kind(kind) == dimension) f(kind, list);
  });
}

namespace detail {
template <class Elements>
void check_indices(std::string_view where, std::string_view kind, Elements const& elements,
                   std::size_t points) {
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (const Index i : elements[e])
      if (i < 0 || std::size_t(i) >= points)
        throw Error(where,
                    text(kind,
                         ' ',
                         e,
                         " refers to point ",
                         i,
                         ", but there are ",
                         points,
                         " points, numbered from 0; correct the index or add the point"));
}

/// Throws Error at an element of second order that has a point twice.
template <std::size_t N>
void check_distinct(std::string_view where, std::string_view kind, std::array<Index, N> element,
                    std::size_t number) {
  static_assert(N > 8);
  std::sort(element.begin(), element.end());
  if (const auto twice = std::adjacent_find(element.begin(), element.end()); twice != element.end())
    throw Error(where,
                text(kind, ' ', number, " has point ", *twice, " twice; give it ", N, " different points"));
}

/// The same of all elements of a mesh, or of what has lists of these names.
template <class Lists>
void check_elements(std::string_view where, Lists const& lists, std::size_t points) {
  for_each_kind(lists, [&](int kind, auto const& list) {
    check_indices(where, element_kind_name(kind), list, points);
    if constexpr (std::tuple_size_v<std::decay_t<decltype(list[0])>> > 8)
      for (std::size_t e = 0; e < list.size(); ++e)
        check_distinct(where, element_kind_name(kind), list[e], e);
  });
}
}  // namespace detail

/// Throws Error, naming `where` and the element, unless all coordinates are finite and all indices in range.
void check_mesh(std::string_view where, Mesh const& mesh);

}  // namespace sinew

#if SINEW_DEFINES
#include <cmath>
#include <string>

namespace sinew {

SINEW_ONCE void check_mesh(std::string_view where, Mesh const& mesh) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (!all_finite(mesh.positions[i]))
      throw Error(where,
                  text("point ", i, " has a coordinate that is not a finite number; correct the file"));
  detail::check_elements(where, mesh, mesh.positions.size());
}

}  // namespace sinew
#endif
