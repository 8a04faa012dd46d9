// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/mapping/child_points.hpp>
#include <sinew/mapping/measured_elements.hpp>
#include <sinew/mapping/stretch.hpp>
#include <sinew/topology/adjacency.hpp>
#include <sinew/topology/element_checks.hpp>

#include <vector>

namespace sinew {

/// Each point of the child is by how much an edge of the parent is longer than at rest:
///   c = l - L,  l = |d|,  d = x1 - x0       J = (-u', u'),  u = d/l
///   K_g = f/l (I - u u') (1 -1; -1 1)       with f the force on c
/// The edges are those of the topology in the node of the mapping, or else of the parent's: its edges, or,
/// where it has none, the sides of its elements. Two points in one place have no direction: J and K_g are
/// zero there. `stabilized` has no K_g for edges that push (f > 0), where it is not negative.
template <class I, class O>
struct DistanceMapping {
  using Role = role::Mapping;
  using In = I;
  using Out = O;
  using Real = typename In::Real;
  static constexpr int N = In::spatial;
  static_assert(!Out::rigid && Out::size == 1, "DistanceMapping maps to Vec1");
  static constexpr std::string_view className = "DistanceMapping";
  static constexpr bool overParent = true;

  bool computeDistance = false;
  std::vector<double> restLengths{};
  GeometricStiffness geometricStiffness = GeometricStiffness::stabilized;

  static constexpr auto fields() {
    using M = DistanceMapping;
    return field_list(
        field("computeDistance", &M::computeDistance, "", "lengths at rest are 0 where none are given"),
        field("restLengths",
              &M::restLengths,
              "m",
              "length of each edge at rest; where none is given, that of the rest positions",
              range::nonNegative)
            .oneEach(Of::points),
        field("geometricStiffness",
              &M::geometricStiffness,
              "",
              "geometric stiffness: what rotating edges add to the stiffness"));
  }

  struct Link {
    Edge ends;
    Stretch<Real, N> stretch;
  };
  std::vector<Link> links{};

  void init(InitContext<In> const& parent, InitContext<Out> const& child, typename Out::VecCoord& positions) {
    const std::string where = text(child.where, ": ", component_name<DistanceMapping>());
    const std::vector<Edge> edges = detail::measured_elements(parent, child, where, "edge", "edges", edgesOf);
    check_rest_lengths(where, *this, edges.size());
    links.clear();
    for (std::size_t e = 0; e < edges.size(); ++e) {
      auto const [a, b] = edges[e];
      const Real apart =
          (In::center(parent.rest[std::size_t(b)]) - In::center(parent.rest[std::size_t(a)])).norm();
      links.push_back({edges[e], {rest_length(*this, e, apart)}});
    }
    place_child(positions, links.size(), where, "edges");
  }

  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) {
    for (std::size_t e = 0; e < links.size(); ++e) {
      Link& link = links[e];
      out[e][0] =
          typename Out::Real(link.stretch.of(In::center(in[end(link, 1)]) - In::center(in[end(link, 0)])));
    }
  }
  void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
    for (std::size_t e = 0; e < links.size(); ++e)
      out[e][0] = typename Out::Real(links[e].stretch.direction.dot(difference(links[e], in)));
  }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
    for (std::size_t e = 0; e < links.size(); ++e)
      spread(links[e], in, links[e].stretch.direction * Real(out[e][0]));
  }
  template <class F>
  void forEachJacobianBlock(int point, F&& f) const {
    Link const& link = links[std::size_t(point)];
    Mat<typename Out::Real, 1, In::size> j = Mat<typename Out::Real, 1, In::size>::Zero();
    j.template head<N>() = -link.stretch.direction.transpose().template cast<typename Out::Real>();
    f(link.ends[0], j);
    f(link.ends[1], Mat<typename Out::Real, 1, In::size>(-j));
  }

  std::vector<bool> pointsThatStay(TopologyView const& before, TopologyChange const& change) const {
    if (!before.edges.empty()) return change.of(ElementKind::edge).stays();
    Mesh left;
    auto filter = [&](auto& list, auto const& from, ElementKind kind) {
      list.assign(from.begin(), from.end());
      change.of(kind).filter(list);
    };
    filter(left.triangles, before.triangles, ElementKind::triangle);
    filter(left.quads, before.quads, ElementKind::quad);
    filter(left.tetrahedra, before.tetrahedra, ElementKind::tetrahedron);
    filter(left.hexahedra, before.hexahedra, ElementKind::hexahedron);
    filter(left.pyramids, before.pyramids, ElementKind::pyramid);
    filter(left.prisms, before.prisms, ElementKind::prism);
    const std::vector<Edge> edges = edgesOf({.triangles = left.triangles,
                                             .quads = left.quads,
                                             .tetrahedra = left.tetrahedra,
                                             .hexahedra = left.hexahedra,
                                             .pyramids = left.pyramids,
                                             .prisms = left.prisms});
    std::vector<bool> stays;
    for (Link const& link : links) stays.push_back(std::binary_search(edges.begin(), edges.end(), link.ends));
    return stays;
  }

  void updateK(typename Out::VecDeriv const& f) {
    for (std::size_t e = 0; e < links.size(); ++e)
      links[e].stretch.updateK(Real(f[e][0]), geometricStiffness);
  }
  void addKx(typename In::VecDeriv& df, typename In::VecDeriv const& dx, double k) const {
    if (geometricStiffness == GeometricStiffness::none) return;
    for (Link const& link : links) spread(link, df, link.stretch.pull(difference(link, dx), Real(k)));
  }
  template <class Sink>
  void addToMatrix(MechanicalParams const& p, Sink const& sink) const {
    if (geometricStiffness == GeometricStiffness::none) return;
    for (Link const& link : links) {
      Mat<Real, In::size> block = Mat<Real, In::size>::Zero();
      block.template topLeftCorner<N, N>() = link.stretch.stiffness(Real(p.k));
      const auto [a, b] = link.ends;
      sink.add(a, a, block), sink.add(b, b, block);
      block = -block;
      sink.add(a, b, block), sink.add(b, a, block);
    }
  }

 private:
  static std::vector<Edge> edgesOf(TopologyView const& t) {
    std::vector<Edge> edges(t.edges.begin(), t.edges.end());
    auto list = [](auto const& span) { return std::vector(span.begin(), span.end()); };
    auto add = [&](std::vector<Edge> const& more) { edges.insert(edges.end(), more.begin(), more.end()); };
    if (!edges.empty()) return edges;
    check_first_order("DistanceMapping", t);
    add(edges_of(list(t.triangles))), add(edges_of_quads(list(t.quads)));
    add(edges_of(list(t.tetrahedra))), add(edges_of(list(t.hexahedra)));
    add(edges_of(list(t.pyramids))), add(edges_of(list(t.prisms)));
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
  }
  static std::size_t end(Link const& link, std::size_t k) { return std::size_t(link.ends[k]); }
  static Vec<Real, N> difference(Link const& link, typename In::VecDeriv const& v) {
    return v[end(link, 1)].template head<N>() - v[end(link, 0)].template head<N>();
  }
  // to the second end, and the opposite to the first
  static void spread(Link const& link, typename In::VecDeriv& to, Vec<Real, N> const& f) {
    to[end(link, 0)].template head<N>() -= f;
    to[end(link, 1)].template head<N>() += f;
  }
};

}  // namespace sinew
