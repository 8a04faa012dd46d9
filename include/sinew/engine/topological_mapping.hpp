// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>
#include <sinew/topology/adjacency.hpp>
#include <sinew/topology/hexahedra.hpp>

#include <map>

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

struct Hexa2Tetra {
  using Elements = std::vector<Hexahedron>;
  static constexpr std::string_view className = "Hexa2TetraTopologicalMapping", from = "hexahedra",
                                    to = "tetrahedra", purpose = "six tetrahedra for each hexahedron";
  static std::vector<Tetrahedron> convert(Elements const& hexahedra) {
    return hexahedra_to_tetrahedra(hexahedra);
  }
};
struct Tetra2Triangle {
  using Elements = std::vector<Tetrahedron>;
  static constexpr std::string_view className = "Tetra2TriangleTopologicalMapping", from = "tetrahedra",
                                    to = "triangles", purpose = "the surface of the tetrahedra";
  static std::vector<Triangle> convert(Elements const& tetrahedra) { return boundary_triangles(tetrahedra); }
};
struct Hexa2Quad {
  using Elements = std::vector<Hexahedron>;
  static constexpr std::string_view className = "Hexa2QuadTopologicalMapping", from = "hexahedra",
                                    to = "quads", purpose = "the surface of the hexahedra";
  static std::vector<Quad> convert(Elements const& hexahedra) {
    return border<Quad>(hexahedra, hexahedronFaces);
  }
};
struct Quad2Triangle {
  using Elements = std::vector<Quad>;
  static constexpr std::string_view className = "Quad2TriangleTopologicalMapping", from = "quads",
                                    to = "triangles", purpose = "two triangles for each quad";
  static std::vector<Triangle> convert(Elements const& quads);
};
struct Triangle2Edge {
  using Elements = std::vector<Triangle>;
  static constexpr std::string_view className = "Triangle2EdgeTopologicalMapping", from = "triangles",
                                    to = "edges", purpose = "the border of the triangles";
  static std::vector<Edge> convert(Elements const& triangles) {
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
  static constexpr std::string_view className = Conversion::className;

  std::vector<Eigen::Vector3d> position{};
  typename Conversion::Elements elements{};
  bool flipNormals = false;

  static constexpr auto fields() {
    using T = TopologicalMapping;
    return field_list(field("position", &T::position, "m", "points").also("points"),
                      field(Conversion::from, &T::elements, "", "elements over them", range::nonNegative),
                      field("flipNormals", &T::flipNormals, "", "whether faces and edges are turned over"));
  }

  // after update
  decltype(Conversion::convert(elements)) converted{};

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
      converted = Conversion::convert(elements);
    } catch (Error const& error) {
      throw Error(at, error.what());
    }
    if (flipNormals && Conversion::to != "tetrahedra")
      for (auto& element : converted) std::reverse(element.begin(), element.end());
  }
};

using Hexa2TetraTopologicalMapping = TopologicalMapping<detail::Hexa2Tetra>;
using Tetra2TriangleTopologicalMapping = TopologicalMapping<detail::Tetra2Triangle>;
using Hexa2QuadTopologicalMapping = TopologicalMapping<detail::Hexa2Quad>;
using Quad2TriangleTopologicalMapping = TopologicalMapping<detail::Quad2Triangle>;
using Triangle2EdgeTopologicalMapping = TopologicalMapping<detail::Triangle2Edge>;

}  // namespace sinew

#if SINEW_DEFINES
namespace sinew::detail {

SINEW_ONCE std::vector<Triangle> Quad2Triangle::convert(Elements const& quads) {
  std::vector<Triangle> triangles;
  triangles.reserve(2 * quads.size());
  for (auto const& q : quads) {
    triangles.push_back({q[0], q[1], q[2]});
    triangles.push_back({q[0], q[2], q[3]});
  }
  return triangles;
}

}  // namespace sinew::detail
#endif
