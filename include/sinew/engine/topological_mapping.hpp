// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>
#include <sinew/topology/adjacency.hpp>
#include <sinew/topology/hexahedra.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

namespace sinew {

namespace detail {

/// The sides that one element only has, in the order of the elements and with their orientation.
template <class Side, class Element, std::size_t N>
std::vector<Side> border(std::vector<Element> const& elements,
                         std::size_t const (&sides)[N][std::tuple_size_v<Side>]) {
  std::map<Side, int> uses;
  auto forEachSide = [&](auto f) {
    for (Element const& element : elements)
      for (auto const& corners : sides) {
        Side side;
        for (std::size_t k = 0; k < side.size(); ++k) side[k] = element[corners[k]];
        Side sorted = side;
        std::sort(sorted.begin(), sorted.end());
        f(side, uses[sorted]);
      }
  };
  forEachSide([](Side const&, int& used) { ++used; });
  std::vector<Side> list;
  forEachSide([&](Side const& side, int used) {
    if (used == 1) list.push_back(side);
  });
  return list;
}

/// Six tetrahedra for each hexahedron, cut as in SOFA: four around the diagonal from corner 0 to 6, and those
/// at the corners 2 and 4. In a grid neighbours match so; where they do not, all are cut as by
/// hexahedra_to_tetrahedra().
struct Hexa2Tetra {
  using Elements = std::vector<Hexahedron>;
  using Converted = std::vector<Tetrahedron>;
  static constexpr std::string_view
      className = "Hexa2TetraTopologicalMapping",
      from = "hexahedra", to = "tetrahedra", purpose = "six tetrahedra for each hexahedron",
      cuts = "whether the cells of a grid are mirrored alternately along each axis";
  static constexpr bool swapsByDefault = false;
  static Converted convert(Elements const& hexahedra, GridCells const& cut) {
    return hexahedra_to_tetrahedra(hexahedra, cut, 2);
  }
};
/// Two prisms for each hexahedron, cut between its edges 0-3 and 5-6 as in SOFA.
struct Hexa2Prism {
  using Elements = std::vector<Hexahedron>;
  using Converted = std::vector<Prism>;
  static constexpr std::string_view className = "Hexa2PrismTopologicalMapping", from = "hexahedra",
                                    to = "prisms", purpose = "two prisms for each hexahedron";
  static Converted convert(Elements const& hexahedra) {
    Converted prisms;
    prisms.reserve(2 * hexahedra.size());
    for (Hexahedron const& h : hexahedra) {
      prisms.push_back({h[0], h[5], h[1], h[3], h[6], h[2]});
      prisms.push_back({h[0], h[4], h[5], h[3], h[7], h[6]});
    }
    return prisms;
  }
};
struct Tetra2Triangle {
  using Elements = std::vector<Tetrahedron>;
  using Converted = std::vector<Triangle>;
  static constexpr std::string_view className = "Tetra2TriangleTopologicalMapping", from = "tetrahedra",
                                    to = "triangles", purpose = "the surface of the tetrahedra",
                                    withoutFirst = "noInitialTriangles";
  static Converted convert(Elements const& tetrahedra) { return boundary_triangles(tetrahedra); }
};
struct Hexa2Quad {
  using Elements = std::vector<Hexahedron>;
  using Converted = std::vector<Quad>;
  static constexpr std::string_view className = "Hexa2QuadTopologicalMapping", from = "hexahedra",
                                    to = "quads", purpose = "the surface of the hexahedra";
  static Converted convert(Elements const& hexahedra) { return border<Quad>(hexahedra, hexahedronFaces); }
};
struct Quad2Triangle {
  using Elements = std::vector<Quad>;
  using Converted = std::vector<Triangle>;
  static constexpr std::string_view className = "Quad2TriangleTopologicalMapping", from = "quads",
                                    to = "triangles", purpose = "two triangles for each quad",
                                    cuts = "whether the diagonals of a grid alternate as on a chessboard";
  static constexpr bool swapsByDefault = true;
  static Converted convert(Elements const& quads, GridCells const& cut);
};
struct Triangle2Edge {
  using Elements = std::vector<Triangle>;
  using Converted = std::vector<Edge>;
  static constexpr std::string_view className = "Triangle2EdgeTopologicalMapping", from = "triangles",
                                    to = "edges", purpose = "the border of the triangles";
  static Converted convert(Elements const& triangles) {
    constexpr std::size_t sides[3][2] = {{0, 1}, {1, 2}, {2, 0}};
    return border<Edge>(triangles, sides);
  }
};

}  // namespace detail

/// Elements of another kind over the same points: a surface of a volume, a subdivision. In a scene file its
/// `input` is the topology that it takes elements from, and its `output` the one that gets them.
template <class Conversion>
struct TopologicalMapping {
  using Role = role::Engine;
  static constexpr bool joinsTopologies = true;
  static constexpr std::string_view className = Conversion::className;

  std::vector<Eigen::Vector3d> position{};
  typename Conversion::Elements elements{};
  bool flipNormals = false;
  // of conversions that cut elements
  static constexpr bool hasCuts = requires { Conversion::cuts; };
  bool swapping = [] {
    if constexpr (hasCuts) return Conversion::swapsByDefault;
    return false;
  }();
  std::array<int, 3> grid{0, 0, 0};
  // of the surface of a volume that is cut
  static constexpr bool mayBeEmpty = requires { Conversion::withoutFirst; };
  bool none = false;

  static constexpr auto fields() {
    using T = TopologicalMapping;
    auto with = [](auto... more) {
      return field_list(
          field("position", &T::position, "m", "points").also("points"),
          field(Conversion::from, &T::elements, "", "elements over them", range::nonNegative),
          field("flipNormals", &T::flipNormals, "", "whether the orientation of faces and edges is reversed"),
          more...);
    };
    if constexpr (hasCuts)
      return with(
          field("swapping", &T::swapping, "", Conversion::cuts),
          field(
              "grid", &T::grid, "", "points along x, y, z of the grid that they are of", range::nonNegative));
    else if constexpr (mayBeEmpty)
      return with(field(Conversion::withoutFirst,
                        &T::none,
                        "",
                        "whether the faces that are outside at the start are left out"));
    else
      return with();
  }

  // after update
  using Converted = typename Conversion::Converted;
  Converted converted{};

  static constexpr auto outputs() {
    using T = TopologicalMapping;
    return field_list(field("position", &T::position, "m", "the same points").also("points"),
                      field(Conversion::to, &T::converted, "", Conversion::purpose));
  }

  /// Throws Error when an element uses a point twice, or one that is missing.
  void update(std::string_view where) {
    check_fields(*this, where);
    const std::string at = text(where, ": ", className);
    detail::check_indices(
        at,
        Conversion::from,
        elements,
        position.empty() ? std::size_t(std::numeric_limits<Index>::max()) : position.size());
    try {
      if constexpr (hasCuts)
        converted = Conversion::convert(elements, {grid, swapping});
      else
        converted = Conversion::convert(elements);
    } catch (Error const& error) {
      throw Error(at, error.what());
    }
    if (none) converted.clear();
    if (flipNormals && Conversion::to != "tetrahedra" && Conversion::to != "prisms")
      for (auto& element : converted) std::reverse(element.begin(), element.end());
  }
};

/// Makes six tetrahedra of each hexahedron of another topology.
using Hexa2TetraTopologicalMapping = TopologicalMapping<detail::Hexa2Tetra>;
/// Makes two prisms of each hexahedron of another topology.
using Hexa2PrismTopologicalMapping = TopologicalMapping<detail::Hexa2Prism>;
/// Makes the triangles of the surface of the tetrahedra of another topology.
using Tetra2TriangleTopologicalMapping = TopologicalMapping<detail::Tetra2Triangle>;
/// Makes the quads of the surface of the hexahedra of another topology.
using Hexa2QuadTopologicalMapping = TopologicalMapping<detail::Hexa2Quad>;
/// Makes two triangles of each quad of another topology.
using Quad2TriangleTopologicalMapping = TopologicalMapping<detail::Quad2Triangle>;
/// Makes the edges of the border of the triangles of another topology.
using Triangle2EdgeTopologicalMapping = TopologicalMapping<detail::Triangle2Edge>;

}  // namespace sinew

#if SINEW_DEFINES
namespace sinew::detail {

SINEW_ONCE Quad2Triangle::Converted Quad2Triangle::convert(Elements const& quads, GridCells const& cut) {
  const std::array<int, 3> n = cut.each();
  const std::size_t row = std::size_t(std::max(n[0] > 0 ? n[0] : n[1], 1));
  Converted triangles;
  triangles.reserve(2 * quads.size());
  for (std::size_t i = 0; i < quads.size(); ++i) {
    auto const& q = quads[i];
    if (cut.swapping && (i % row + i / row) % 2 == 1) {
      triangles.push_back({q[0], q[1], q[3]});
      triangles.push_back({q[2], q[3], q[1]});
    } else {
      triangles.push_back({q[1], q[2], q[0]});
      triangles.push_back({q[3], q[0], q[2]});
    }
  }
  return triangles;
}

}  // namespace sinew::detail
#endif
