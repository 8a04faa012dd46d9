// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/engine/roi.hpp>

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// Divides a mesh in two: the elements of which all points are in one of the boxes, or of the spheres where
/// there are some, surfaces included, and the others. With localIndices each of the two is a mesh of its own:
/// its elements count its own points, of which those on the border, points inside of elements that are not,
/// are the first `nbrborder` of both, in the same order.
template <class D>
struct SubsetTopology {
  using Role = role::Engine;
  using DataTypes = D;
  static constexpr std::string_view className = "SubsetTopology";

  std::vector<Vec<double, 6>> box{};
  std::vector<Eigen::Vector3d> centers{};
  std::vector<double> radii{};
  typename D::VecCoord position{};
  std::vector<Edge> edges{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<Hexahedron> hexahedra{};
  std::optional<std::vector<int>> tetrahedraInput{};
  bool localIndices = false;

  static constexpr auto fields() {
    using S = SubsetTopology;
    return field_list(
        field("box",
              &S::box,
              "m",
              "boxes, each xmin ymin zmin xmax ymax zmax; that from 0 to 1 where none is given"),
        field("centers", &S::centers, "m", "centres of spheres, in the place of boxes"),
        field("radii", &S::radii, "m", "of the spheres, one each", range::nonNegative),
        field("rest_position", &S::position, "m", "points of the mesh").also("position"),
        field("edges", &S::edges, "", "edges of the mesh", range::nonNegative),
        field("triangles", &S::triangles, "", "triangles of the mesh", range::nonNegative),
        field("quads", &S::quads, "", "quads of the mesh", range::nonNegative),
        field("tetrahedra", &S::tetrahedra, "", "tetrahedra of the mesh", range::nonNegative),
        field("hexahedra", &S::hexahedra, "", "hexahedra of the mesh", range::nonNegative),
        field("tetrahedraInput",
              &S::tetrahedraInput,
              "",
              "tetrahedra that are inside, in the place of those in boxes or spheres; of other elements "
              "those that have only points of these",
              range::nonNegative),
        field("localIndices", &S::localIndices, "", "elements count the points of their own part"));
  }

  // after update
  std::vector<int> indices{}, edgeIndices{}, triangleIndices{}, quadIndices{}, tetrahedronIndices{},
      hexahedronIndices{};
  typename D::VecCoord pointsInROI{}, pointsOutROI{};
  std::vector<Edge> edgesInROI{}, edgesOutROI{};
  std::vector<Triangle> trianglesInROI{}, trianglesOutROI{};
  std::vector<Quad> quadsInROI{}, quadsOutROI{};
  std::vector<Tetrahedron> tetrahedraInROI{}, tetrahedraOutROI{};
  std::vector<Hexahedron> hexahedraInROI{}, hexahedraOutROI{};
  int nbrborder = 0;

  static constexpr auto outputs() {
    using S = SubsetTopology;
    return field_list(field("indices", &S::indices, "", "the points inside"),
                      field("edgeIndices", &S::edgeIndices, "", "the edges inside"),
                      field("triangleIndices", &S::triangleIndices, "", "the triangles inside"),
                      field("quadIndices", &S::quadIndices, "", "the quads inside"),
                      field("tetrahedronIndices", &S::tetrahedronIndices, "", "the tetrahedra inside"),
                      field("hexahedronIndices", &S::hexahedronIndices, "", "the hexahedra inside"),
                      field("pointsInROI", &S::pointsInROI, "m", "positions of the points inside"),
                      field("pointsOutROI", &S::pointsOutROI, "m", "positions of the points outside"),
                      field("edgesInROI", &S::edgesInROI, "", "points of the edges inside"),
                      field("edgesOutROI", &S::edgesOutROI, "", "points of the other edges"),
                      field("trianglesInROI", &S::trianglesInROI, "", "points of the triangles inside"),
                      field("trianglesOutROI", &S::trianglesOutROI, "", "points of the other triangles"),
                      field("quadsInROI", &S::quadsInROI, "", "points of the quads inside"),
                      field("quadsOutROI", &S::quadsOutROI, "", "points of the other quads"),
                      field("tetrahedraInROI", &S::tetrahedraInROI, "", "points of the tetrahedra inside"),
                      field("tetrahedraOutROI", &S::tetrahedraOutROI, "", "points of the other tetrahedra"),
                      field("hexahedraInROI", &S::hexahedraInROI, "", "points of the hexahedra inside"),
                      field("hexahedraOutROI", &S::hexahedraOutROI, "", "points of the other hexahedra"),
                      field("nbrborder", &S::nbrborder, "", "number of points on the border"));
  }

  /// Throws Error where there is no point, a sphere has no radius, or an element refers to a missing point;
  /// the outputs then stay.
  void update(std::string_view where) {
    check_fields(*this, where);
    const std::string at = text(where, ": ", component_name<SubsetTopology>());
    const std::size_t n = position.size();
    if (n == 0)
      throw Error(at, "rest_position is empty; link it to the points of a loader, topology or state");
    if (centers.size() != radii.size())
      throw Error(
          at,
          text("there are ", centers.size(), " centers and ", radii.size(), " radii; give one radius each"));
    detail::check_elements(at, *this, n);
    if (tetrahedraInput)
      for (const int t : *tetrahedraInput)
        if (std::size_t(t) >= tetrahedra.size())
          throw Error(at,
                      text("tetrahedraInput has ",
                           t,
                           ", but the mesh has ",
                           tetrahedra.size(),
                           " tetrahedra, numbered from 0; correct the index"));

    // which regions hold a point, and which elements all of their points
    const std::size_t regions = regionCount();
    std::vector<std::vector<bool>> held(regions, std::vector<bool>(n));
    std::vector<bool> in(n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t r = 0; r < regions; ++r) {
        held[r][i] = holds(r, i);
        in[i] = in[i] || held[r][i];
      }
    if (tetrahedraInput) {
      tetrahedronIndices = *tetrahedraInput;
      std::sort(tetrahedronIndices.begin(), tetrahedronIndices.end());
      tetrahedronIndices.erase(std::unique(tetrahedronIndices.begin(), tetrahedronIndices.end()),
                               tetrahedronIndices.end());
      in.assign(n, false);
      for (const int t : tetrahedronIndices)
        for (const Index i : tetrahedra[std::size_t(t)]) in[std::size_t(i)] = true;
      held = {in};
    }
    auto inside = [&](auto const& element) {
      return std::any_of(held.begin(), held.end(), [&](std::vector<bool> const& of) {
        return std::all_of(element.begin(), element.end(), [&](Index i) { return of[std::size_t(i)]; });
      });
    };
    choose(edges, edgeIndices, inside);
    choose(triangles, triangleIndices, inside);
    choose(quads, quadIndices, inside);
    if (!tetrahedraInput) choose(tetrahedra, tetrahedronIndices, inside);
    choose(hexahedra, hexahedronIndices, inside);

    std::vector<bool> border(n);
    if (localIndices) {
      onBorder(edges, edgeIndices, in, border);
      onBorder(triangles, triangleIndices, in, border);
      onBorder(quads, quadIndices, in, border);
      onBorder(tetrahedra, tetrahedronIndices, in, border);
      onBorder(hexahedra, hexahedronIndices, in, border);
    }
    nbrborder = int(std::count(border.begin(), border.end(), true));
    indices.clear();
    pointsInROI.clear();
    pointsOutROI.clear();
    std::vector<Index> numberIn(n), numberOut(n);  // of a point in its part
    auto add = [&](std::size_t i, bool inPart) {
      auto& part = inPart ? pointsInROI : pointsOutROI;
      (inPart ? numberIn : numberOut)[i] = Index(part.size());
      part.push_back(position[i]);
      if (inPart) indices.push_back(int(i));
    };
    for (std::size_t i = 0; i < n; ++i)
      if (border[i]) add(i, true), add(i, false);
    for (std::size_t i = 0; i < n; ++i)
      if (!border[i]) add(i, in[i]);
    if (!localIndices) {
      std::iota(numberIn.begin(), numberIn.end(), 0);
      numberOut = numberIn;
    }
    divide(edges, edgeIndices, numberIn, numberOut, edgesInROI, edgesOutROI);
    divide(triangles, triangleIndices, numberIn, numberOut, trianglesInROI, trianglesOutROI);
    divide(quads, quadIndices, numberIn, numberOut, quadsInROI, quadsOutROI);
    divide(tetrahedra, tetrahedronIndices, numberIn, numberOut, tetrahedraInROI, tetrahedraOutROI);
    divide(hexahedra, hexahedronIndices, numberIn, numberOut, hexahedraInROI, hexahedraOutROI);
  }

 private:
  std::size_t regionCount() const {
    return !centers.empty() ? centers.size() : std::max<std::size_t>(1, box.size());
  }
  bool holds(std::size_t region, std::size_t point) const {
    const Eigen::Vector3d x = D::center(position[point]).template cast<double>();
    if (!centers.empty()) return (x - centers[region]).norm() <= radii[region];
    return box_holds<3>(box.empty() ? Vec<double, 6>(0, 0, 0, 1, 1, 1) : box[region], x);
  }
  template <class Elements, class Inside>
  static void choose(Elements const& all, std::vector<int>& numbers, Inside const& inside) {
    numbers.clear();
    for (std::size_t e = 0; e < all.size(); ++e)
      if (inside(all[e])) numbers.push_back(int(e));
  }
  // f(element, whether it is inside); the numbers of those inside rise
  template <class Elements, class F>
  static void forEach(Elements const& all, std::vector<int> const& numbers, F const& f) {
    std::size_t next = 0;
    for (std::size_t e = 0; e < all.size(); ++e) {
      const bool inside = next < numbers.size() && std::size_t(numbers[next]) == e;
      next += inside;
      f(all[e], inside);
    }
  }
  // points inside of elements that are not
  template <class Elements>
  static void onBorder(Elements const& all, std::vector<int> const& numbers, std::vector<bool> const& in,
                       std::vector<bool>& border) {
    forEach(all, numbers, [&](auto const& element, bool inside) {
      if (inside) return;
      for (const Index i : element)
        if (in[std::size_t(i)]) border[std::size_t(i)] = true;
    });
  }
  template <class Elements>
  static void divide(Elements const& all, std::vector<int> const& numbers, std::vector<Index> const& numberIn,
                     std::vector<Index> const& numberOut, Elements& ofInside, Elements& others) {
    ofInside.clear();
    others.clear();
    forEach(all, numbers, [&](auto element, bool inside) {
      for (Index& i : element) i = (inside ? numberIn : numberOut)[std::size_t(i)];
      (inside ? ofInside : others).push_back(element);
    });
  }
};

}  // namespace sinew
