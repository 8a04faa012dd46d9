// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>
#include <sinew/core/follow.hpp>
#include <sinew/core/lists.hpp>

#include <vector>

namespace sinew {

// what bears the load, and how SOFA's three classes call it.
namespace pressed {
struct Triangles {
  static constexpr std::string_view className = "TrianglePressureForceField", list = "triangleList",
                                    older = "triangleIndices", kind = "triangle", unit = "Pa",
                                    load = "force per area of the triangles at rest";
  static constexpr Of what = Of::triangles;
  static std::vector<Triangle> of(TopologyView const& t) { return {t.triangles.begin(), t.triangles.end()}; }
};
struct Quads {
  static constexpr std::string_view className = "QuadPressureForceField", list = "quadList",
                                    older = "quadIndices", kind = "quad", unit = "Pa",
                                    load = "force per area of the quads at rest";
  static constexpr Of what = Of::quads;
  static std::vector<Quad> of(TopologyView const& t) { return {t.quads.begin(), t.quads.end()}; }
};
// the sides of the triangles, or of the quads, where the topology has no edges
struct Edges {
  static constexpr std::string_view className = "EdgePressureForceField", list = "edgeIndices",
                                    older = "edgeList", kind = "edge", unit = "N/m",
                                    load = "force per length of the edges at rest";
  static constexpr Of what = Of::edges;
  static std::vector<Edge> of(TopologyView const& t);
};
}  // namespace pressed

/// A load that stays as it is: p times the area (or length) A of an element at rest, shared evenly by its
/// points.
///   f_i = p A / n [N],   E = -sum_i f_i.(x_i - x_i at rest) [J]
/// It acts on the elements with the given numbers and on those whose points all lie between two planes at
/// rest, dmin < normal.x < dmax; where neither is given, or a selection is empty, on none. A load that
/// follows area and normal is SurfacePressureForceField's.
///
/// Those of EdgePressureForceField may also be given by their points. Where there is no `pressure` they bear,
/// with a binormal b, an intensity p across the edge as it lies now, of unit tangent t, and of length L at
/// rest:
///   f_i = p L / 2 n,   n = b x t / |b x t|       [N]
/// It has no energy, and its derivative is left out, as in SOFA.
template <class D, class Kind>
struct ElementPressure {
  using Role = role::ForceField;
  static constexpr bool isLoad = true;
  using DataTypes = D;
  using Real = typename D::Real;
  using Deriv = typename D::Deriv;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = Kind::className;

  Deriv pressure = Deriv::Zero();
  std::vector<int> pressedElements{};
  Eigen::Vector3d normal{0, 0, 0};
  double dmin = 0, dmax = 0;
  // of edges
  std::vector<Edge> edges{};
  double intensity = 0;
  Eigen::Vector3d binormal{0, 0, 0};

  static constexpr bool ofEdges = std::is_same_v<Kind, pressed::Edges>;

  static constexpr auto fields() {
    using F = ElementPressure;
    auto with = [](auto... more) {
      return field_list(
          field("pressure", &F::pressure, Kind::unit, Kind::load),
          field(
              Kind::list, &F::pressedElements, "", "numbers of the elements that bear it", range::nonNegative)
              .also(Kind::older)
              .numbersOf(Kind::what),
          field("normal", &F::normal, "", "normal of the two planes, used at the length given"),
          field("dmin", &F::dmin, "m", "where the lower plane is, normal.x = dmin"),
          field("dmax", &F::dmax, "m", "where the higher plane is; no planes where it is dmin"),
          more...);
    };
    if constexpr (ofEdges)
      return with(
          field("edges", &F::edges, "", "edges that bear it, by their points", range::nonNegative),
          field("p_intensity", &F::intensity, "N/m", "force per length across the edges, without pressure"),
          field("binormal", &F::binormal, "", "direction with which the force is at a right angle"));
    else
      return with();
  }

  ForceProperties properties() const {
    return {.internal = false,
            .objective = false,
            .conservative = !followsEdges(),
            .exactTangent = !followsEdges()};
  }

  bool none = false;  // all of them have been removed, or a link has chosen none
  static constexpr auto state() {
    return field_list(field("none",
                            &ElementPressure::none,
                            "",
                            "all of the elements with a number have been removed, or none was chosen"));
  }

  struct Load {
    int point;
    Deriv force;
  };
  std::vector<Load> loads{};  // each point once
  VecCoord rest{};
  struct Across {
    Edge points;
    Real load;  // at each of them [N]
  };
  std::vector<Across> across{};  // where the load follows the edges

  /// Edges by their points go with these.
  void follow(Followed const& change)
  requires ofEdges
  {
    const bool some = !edges.empty();
    std::erase_if(edges,
                  [&](Edge const& e) { return !change.points.stays(e[0]) || !change.points.stays(e[1]); });
    for (Edge& e : edges)
      for (Index& i : e) change.points.renumber(i);
    none = none || (some && edges.empty());
  }

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<ElementPressure>());
    const auto elements = Kind::of(context.topology);
    if (elements.empty() && edges.empty() && !none && !context.topology.grows)
      throw Error(where, text("the topology has no ", Kind::kind, "; give the node a topology with some"));
    detail::check_indices(where, Kind::kind, elements, context.rest.size());
    if (dmin > dmax) throw Error(where, text("dmin is ", dmin, ", above dmax, ", dmax, "; exchange them"));
    if constexpr (ofEdges) {
      detail::check_indices(where, "edge", edges, context.rest.size());
      if (intensity != 0 && pressure.isZero(0) && binormal.isZero(0))
        throw Error(where,
                    "p_intensity is across the edges; give binormal, with which it is at a right angle");
    }
    std::vector<bool> bears(elements.size(), false);
    check_numbers(where, Kind::list, pressedElements, elements.size(), "such elements", "the topology");
    for (const int e : pressedElements) bears[std::size_t(e)] = true;
    std::vector<double> share(context.rest.size(), 0.0);
    across.clear();
    auto load = [&](auto const& element) {
      auto at = [&](std::size_t k) -> Eigen::Vector3d {
        return context.rest[std::size_t(element[k])].template cast<double>();
      };
      const double each = size(element, at) / double(element.size());
      for (const Index i : element) share[std::size_t(i)] += each;
      if constexpr (ofEdges)
        if (followsEdges()) across.push_back({element, Real(intensity * each)});
    };
    for (std::size_t e = 0; e < elements.size(); ++e) {
      auto at = [&](std::size_t k) -> Eigen::Vector3d {
        return context.rest[std::size_t(elements[e][k])].template cast<double>();
      };
      bool between = dmin < dmax;
      for (std::size_t k = 0; k < elements[e].size() && between; ++k)
        between = normal.dot(at(k)) > dmin && normal.dot(at(k)) < dmax;
      if (bears[e] || between) load(elements[e]);
    }
    if constexpr (ofEdges)
      for (Edge const& e : edges) load(e);
    loads.clear();
    for (std::size_t i = 0; i < share.size(); ++i)
      if (share[i] > 0 && !followsEdges()) loads.push_back({int(i), Deriv(pressure * Real(share[i]))});
    rest = context.rest;
  }

  /// The warning of init; empty for none.
  std::string warning() const {
    if (none || !loads.empty() || !across.empty()) return {};
    return text("presses nothing: no element has a number in ",
                Kind::list,
                ofEdges ? ", is in edges" : "",
                " or lies between the planes of normal, dmin and dmax; select some");
  }

  void addForce(MechanicalParams const&, VecDeriv& f, VecCoord const& x, VecDeriv const&) const {
    for (Load const& l : loads) f[std::size_t(l.point)] += l.force;
    for (auto const& [points, load] : across) {
      auto& [a, b] = points;
      const Deriv along = x[std::size_t(b)] - x[std::size_t(a)],
                  n = Deriv(binormal.template cast<Real>()).cross(along);
      const Real length = n.norm();
      if (!(length > 0)) continue;
      f[std::size_t(a)] += n * (load / length);
      f[std::size_t(b)] += n * (load / length);
    }
  }
  void addDForce(MechanicalParams const&, VecDeriv&, VecDeriv const&) const {}
  template <class Sink>
  void addToMatrix(MechanicalParams const&, Sink const&) const {}
  double potentialEnergy(VecCoord const& x) const {
    double energy = 0;
    for (Load const& l : loads)
      energy -= double(l.force.dot(x[std::size_t(l.point)] - rest[std::size_t(l.point)]));
    return energy;
  }

 private:
  bool followsEdges() const { return ofEdges && pressure.isZero(0) && intensity != 0; }

  // length of an edge; area of a triangle, and of the two in a quad
  template <class Element, class At>
  static double size(Element const&, At const& at) {
    constexpr std::size_t n = std::tuple_size_v<Element>;
    if constexpr (n == 2) {
      return (at(1) - at(0)).norm();
    } else {
      const Eigen::Vector3d a = at(1) - at(0), b = at(2) - at(0);
      double area = a.cross(b).norm() / 2;
      if constexpr (n == 4) area += b.cross(at(3) - at(0)).norm() / 2;
      return area;
    }
  }
};

/// A load on chosen triangles that keeps its direction, as a force per area at rest.
template <class D>
using TrianglePressureForceField = ElementPressure<D, pressed::Triangles>;
/// A load on chosen quads that keeps its direction, as a force per area at rest.
template <class D>
using QuadPressureForceField = ElementPressure<D, pressed::Quads>;
/// A load on chosen edges, as a force per length. Where the topology has no edges, the sides of its triangles
/// or quads are the edges.
template <class D>
using EdgePressureForceField = ElementPressure<D, pressed::Edges>;

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/topology/adjacency.hpp>

#include <algorithm>

namespace sinew::pressed {

SINEW_ONCE std::vector<Edge> Edges::of(TopologyView const& t) {
  if (!t.edges.empty()) return {t.edges.begin(), t.edges.end()};
  if (!t.triangles.empty()) return edges_of(std::vector<Triangle>(t.triangles.begin(), t.triangles.end()));
  return edges_of_quads({t.quads.begin(), t.quads.end()});
}

}  // namespace sinew::pressed
#endif
