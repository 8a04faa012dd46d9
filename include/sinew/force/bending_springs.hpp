// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/force/spring_law.hpp>
#include <sinew/topology/hinges.hpp>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace sinew {

// which faces bend, whether points that lie across two edges have one spring or two, and SOFA's settings: its
// four classes differ in nothing else.
namespace bending {
struct Triangular {
  static constexpr std::string_view className = "TriangularBendingSprings";
  static constexpr double stiffness = 1e5, damping = 1;
  static constexpr bool triangles = true, quads = false, once = false;
};
// quads are two triangles each, which bend too
struct Triangle {
  static constexpr std::string_view className = "TriangleBendingSprings";
  static constexpr double stiffness = 100, damping = 5;
  static constexpr bool triangles = true, quads = true, once = false;
};
struct Quadular {
  static constexpr std::string_view className = "QuadularBendingSprings";
  static constexpr double stiffness = 1e5, damping = 1;
  static constexpr bool triangles = false, quads = true, once = false;
};
struct Quad {
  static constexpr std::string_view className = "QuadBendingSprings";
  static constexpr double stiffness = 100, damping = 5;
  static constexpr bool triangles = false, quads = true, once = true;
};
}  // namespace bending

/// Springs across the edges that two faces of the topology share, which get shorter when the surface folds:
/// between the points opposite the edge of two triangles; between those next to each end of the edge of two
/// quads. QuadBendingSprings joins two points once, QuadularBendingSprings for each edge that they lie
/// across, which are two inside a sheet. They are relaxed at rest. Faces that touch at height h above their
/// edge, folded by the angle phi from flat, have E = k/2 (2 h (1 - cos(phi/2)))^2 a spring: of the fourth
/// order in phi, so that a flat sheet has no stiffness against small bending.
template <class D, class Kind>
struct BendingSprings {
  using Role = role::ForceField;
  static constexpr bool sharesWork = true;
  using DataTypes = D;
  using Real = typename D::Real;
  static constexpr std::string_view className = Kind::className;

  double stiffness = Kind::stiffness, damping = Kind::damping;

  static constexpr auto fields() {
    using F = BendingSprings;
    return field_list(
        field("stiffness", &F::stiffness, "N/m", "force per extension of each spring", range::nonNegative),
        field("damping",
              &F::damping,
              "N s/m",
              "force per rate of extension of each spring",
              range::nonNegative));
  }

  using Driver = ElementDriver<SpringLaw, D>;
  Driver driver{};
  bool hadEdges = false;  // a surface of which elements have gone may have lost them all

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<BendingSprings>());
    TopologyView const& t = context.topology;
    detail::check_indices(where, "triangle", t.triangles, context.rest.size());
    detail::check_indices(where, "quad", t.quads, context.rest.size());
    std::vector<typename Driver::Indices> ends;
    std::vector<typename Driver::Rest> rest;
    std::set<std::pair<Index, Index>> joined;
    auto join = [&](Index i, Index j) {
      if (i == j) return;  // faces on either side of one another
      if (Kind::once && !joined.insert(std::minmax(i, j)).second) return;
      ends.push_back({i, j});
      rest.push_back({Real(stiffness),
                      Real(damping),
                      (context.rest[std::size_t(j)] - context.rest[std::size_t(i)]).norm()});
    };
    for (Hinge const& hinge : hinges(t)) {
      join(hinge.next[0][0], hinge.next[1][0]);
      if (!Kind::triangles) join(hinge.next[0][1], hinge.next[1][1]);
    }
    hadEdges = hadEdges || !ends.empty();
    if (!hadEdges && !t.grows)
      throw Error(where,
                  text("no two ",
                       Kind::triangles ? "triangles" : "quads",
                       " share an edge; give the node a topology with some that do"));
    driver.init(ends, rest);
  }

 private:
  static std::vector<Hinge> hinges(TopologyView const& t) {
    if constexpr (!Kind::triangles) return find_hinges(t.quads);
    std::vector<std::array<Index, 3>> halves;
    // the triangles of a grid are those of its quads
    if (Kind::quads && (t.grid[0] == 0 || t.triangles.empty()))
      for (auto const& q : t.quads) halves.insert(halves.end(), {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}});
    return find_hinges(t.triangles, halves);
  }
};

/// Springs across the edges of the triangles, so that a surface resists bending.
template <class D>
using TriangularBendingSprings = BendingSprings<D, bending::Triangular>;
/// Springs across the edges of the triangles, and of quads as two triangles each, so that a surface resists
/// bending.
template <class D>
using TriangleBendingSprings = BendingSprings<D, bending::Triangle>;
/// Springs across the edges of the quads, one for each edge that two points lie across, so that a surface
/// resists bending.
template <class D>
using QuadularBendingSprings = BendingSprings<D, bending::Quadular>;
/// Springs across the edges of the quads, one for two points, so that a surface resists bending.
template <class D>
using QuadBendingSprings = BendingSprings<D, bending::Quad>;

}  // namespace sinew
