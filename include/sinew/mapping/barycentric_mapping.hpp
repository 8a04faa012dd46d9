// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/mapping/carried_frames.hpp>
#include <sinew/mapping/carried_points.hpp>
#include <sinew/topology/element_checks.hpp>
#include <sinew/topology/point_location.hpp>
#include <sinew/topology/quadratic_elements.hpp>
#include <sinew/topology/twins.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

namespace sinew {

/// Each point of the child is carried by the element of the parent that contains it at rest, or by the
/// nearest one: x = sum_k w_k x_k. The weights are barycentric coordinates in tetrahedra and triangles,
/// multilinear ones in hexahedra, quads and edges, and the shape functions of pyramids and prisms; of
/// tetrahedra of ten points and hexahedra of 27, those of the eight linear parts between their points.
/// Volumes carry where the parent has some, else surfaces, else edges; on the latter two the child follows
/// its projection. Affine motion of the parent is reproduced exactly. Where the parent has the points of its
/// RegularGridTopology or SparseGridTopology, the child is looked for in the cells as they lie before
/// translation, rotation and scale3d of the parent, as in SOFA: these put the child into place with the grid.
/// Where hexahedra of a SparseGridRamificationTopology are at one place, a point goes with the one whose
/// finer cell is around it.
///
/// Frames (Rigid3) are carried by tetrahedra and hexahedra: their centres as points are, and they turn with
/// the rotation R of the polar decomposition F = R S of the deformation gradient where they are,
///   w = R (tr(S) I - S)^-1 sum_k g_k x R' v_k        (g_k: gradient of w_k at rest)
/// of which forces have the transpose: they do the same work on both, and what it adds to the stiffness of
/// the parent is left out. SOFA has another angular velocity, sum_k X_k x v_k of the four places in the
/// world, which is no derivative of the orientation and depends on where the origin is.
///
/// Points of the child are looked for where they are given, among elements at rest. With `useRestPosition`
/// they are looked for where they rest: a child that starts elsewhere is then carried from there to its
/// parent.
template <class I, class O>
struct BarycentricMapping {
  using Role = role::Mapping;
  using In = I;
  using Out = O;
  using Real = typename Out::Real;
  using Weight = typename In::Real;
  static_assert(!In::rigid && In::size == 3 && Out::spatial == 3 && (Out::rigid || Out::size == 3),
                "BarycentricMapping joins points, or frames, to points in space");
  static constexpr std::string_view className = "BarycentricMapping";
  // points that lie in elements of the parent
  static constexpr std::string_view aliases =
      "Mesh2PointMechanicalMapping SimpleTesselatedTetraMechanicalMapping";
  static constexpr bool needsParentTetrahedra = true, carriesPoints = true;

  bool useRestPosition = false;

  static constexpr auto fields() {
    return field_list(field("useRestPosition",
                            &BarycentricMapping::useRestPosition,
                            "",
                            "whether points of the child are looked for where they rest"));
  }

  // of each point; the other points of elements with more than four, empty where there is none
  std::vector<Carrier<Weight>> carriers{}, others{};
  std::conditional_t<Out::rigid, CarriedFrames<In, Out>, CarriedPoints<In, Out>> together{};
  bool shared = false;

  /// In a scene whose ranks have parts of both states, a point stays with the element that it had in the
  /// whole one.
  void shareOut(Renumbering const& points, Renumbering const& parents)
  requires(!Out::rigid)
  {
    points.filter(carriers), points.filter(others);
    for (auto* list : {&carriers, &others})
      for (auto& carrier : *list)
        for (std::size_t k = 0; k < 4; ++k) {
          parents.renumber(carrier.points[k]);
          if (carrier.points[k] < 0) carrier.points[k] = 0;  // of no weight
        }
    shared = true;
  }

  void init(InitContext<In> const& parent, InitContext<Out> const& child, typename Out::VecCoord& positions) {
    if (shared && carriers.size() == positions.size())
      return together.init(parent.rest.size(), carriers, others);
    const std::string where = text(child.where, ": ", component_name<BarycentricMapping>());
    TopologyView const& topology = parent.topology;
    check_element_indices(text(where, ": ", parent.where), topology, parent.rest.size());
    if (!topology.quadraticHexahedra.empty())
      throw Error(text(where, ": ", parent.where),
                  "quadratic hexahedra have no node inside, by whose parts points would be carried; take "
                  "hexahedra of 27 points, or tetrahedra of ten");
    std::vector<Eigen::Vector3d> points;
    points.reserve(parent.rest.size());
    if (topology.places.size() == parent.rest.size())
      points.assign(topology.places.begin(), topology.places.end());
    else
      for (auto const& x : parent.rest) points.push_back(x.template cast<double>());

    std::vector<Choice> choices(positions.size());
    auto const& places = useRestPosition ? child.rest : positions;
    if (places.size() != positions.size())
      throw Error(where,
                  text("the child has ",
                       positions.size(),
                       " points and ",
                       places.size(),
                       " rest positions; give it as many, or leave out useRestPosition"));
    auto offer = [&]<class Fit>(std::type_identity<Fit>, auto const& elements) {
      const ElementLocator<Fit> locator(points, elements);
      for (std::size_t i = 0; i < choices.size() && !elements.empty(); ++i)
        if (choices[i].score < 0)
          choices[i].consider(locator.locate(Out::center(places[i]).template cast<double>()), elements);
    };
    if (Out::rigid && topology.tetrahedra.empty() && topology.hexahedra.empty())
      throw Error(where,
                  text("the topology of ",
                       parent.where,
                       " has neither tetrahedra nor hexahedra, with which frames would turn; give the parent "
                       "some, or map to points"));
    if (dimension_of(topology) == 3) {
      offer(std::type_identity<TetrahedronFit>{}, topology.tetrahedra);
      if (topology.finer.hexahedra.empty() || !topology.tetrahedra.empty())
        offer(std::type_identity<MultilinearFit<3>>{}, topology.hexahedra);
      else
        chooseByFinerCells(choices, points, topology, places);
      if constexpr (!Out::rigid) {
        offer(std::type_identity<CollapsedFit<Pyramid>>{}, topology.pyramids);
        offer(std::type_identity<CollapsedFit<Prism>>{}, topology.prisms);
        offer(std::type_identity<TetrahedronFit>{}, partsOf<Tetrahedron>(topology.quadraticTetrahedra));
        offer(std::type_identity<MultilinearFit<3>>{}, partsOf<Hexahedron>(topology.triquadraticHexahedra));
      }
    } else if (!topology.triangles.empty() || !topology.quads.empty()) {
      offer(std::type_identity<TriangleFit>{}, topology.triangles);
      offer(std::type_identity<MultilinearFit<2>>{}, topology.quads);
    } else if (!topology.edges.empty()) {
      offer(std::type_identity<MultilinearFit<1>>{}, topology.edges);
    } else {
      throw Error(
          where,
          text("the topology of ", parent.where, " has no elements; give the parent a topology with some"));
    }

    if constexpr (!Out::rigid)
      if (!child.faces.empty() && topology.quads.empty() && topology.hexahedra.empty() &&
          topology.pyramids.empty() && topology.prisms.empty() && topology.triquadraticHexahedra.empty()) {
        if (!topology.tetrahedra.empty())
          goWithNeighbours<TetrahedronFit>(choices, points, topology.tetrahedra, child.faces, places);
        else if (!topology.triangles.empty())
          goWithNeighbours<TriangleFit>(choices, points, topology.triangles, child.faces, places);
      }
    carriers.assign(choices.size(), {});
    const bool more = !topology.hexahedra.empty() || !topology.pyramids.empty() || !topology.prisms.empty() ||
                      !topology.triquadraticHexahedra.empty();
    others.assign(more ? choices.size() : 0, {});
    for (std::size_t i = 0; i < choices.size(); ++i) {
      if (choices[i].score == Choice{}.score)
        throw Error(
            where,
            text(
                "the elements of ", parent.where, " are all flat and carry no point; move its points apart"));
      for (std::size_t k = 0; k < 8; ++k)
        if (k < 4 || !others.empty()) {
          auto& carrier = (k < 4 ? carriers : others)[i];
          carrier.points[k % 4] = choices[i].points[k];
          carrier.weights[k % 4] = Weight(choices[i].weights[k]);
        }
    }
    together.init(parent.rest.size(), carriers, others);
    if constexpr (Out::rigid) together.place(points, places, carriers, others);
  }

  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) const
  requires(!Out::rigid)
  {
    together.apply(out, in, carriers, others);
  }
  // frames keep where their elements are
  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in)
  requires(Out::rigid)
  {
    together.apply(out, in, carriers, others);
  }
  void ask(typename Out::VecCoord const& out, typename In::VecCoord const& in) const {
    together.ask(out, in);
  }
  void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
    together.apply(out, in, carriers, others);
  }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
    together.applyJT(in, out, carriers, others);
  }
  template <class F>
  void forEachJacobianBlock(int point, F&& f) const {
    if constexpr (Out::rigid)
      together.forEachJacobianBlock(point, carriers, others, f);
    else
      for (auto const* list : {&carriers, &others})
        for (std::size_t k = 0; k < 4 && !list->empty(); ++k) {
          auto const& carrier = (*list)[std::size_t(point)];
          if (carrier.weights[k] != 0)
            f(carrier.points[k], Mat<Real, 3>(Mat<Real, 3>::Identity() * Real(carrier.weights[k])));
        }
  }

 private:
  template <class Part, class Elements>
  static std::vector<Part> partsOf(Elements const& elements) {
    std::vector<Part> all;
    for (auto const& e : elements)
      for (Part const& part : parts_of(e)) all.push_back(part);
    return all;
  }
  // the best element so far for one point; elements with fewer points repeat their first with no weight
  struct Choice {
    double score = -std::numeric_limits<double>::infinity();
    std::array<Index, 8> points{};
    std::array<double, 8> weights{};

    template <class Located, class Elements>
    void consider(Located const& located, Elements const& elements) {
      if (!(located.fit.score > score)) return;
      auto const& element = elements[std::size_t(located.element)];
      score = located.fit.score;
      points.fill(element[0]);
      weights.fill(0);
      for (std::size_t k = 0; k < element.size(); ++k) {
        points[k] = element[k];
        weights[k] = located.fit.weights[Eigen::Index(k)];
      }
    }
  };

  // Where the parent is cut, its points are there twice, and a point of the child near the cut may lie in an
  // element on the other side of it: a surface is cut by the same blade, but a cut may be as far from that as
  // snapping has it. So points go with elements that have points in common with those of their neighbours in
  // the surface, from where it is clear on: from those that are as far from the cut as a part of an element.
  template <class Fit, class Elements>
  static void goWithNeighbours(std::vector<Choice>& choices, std::vector<Eigen::Vector3d> const& points,
                               Elements const& elements, std::span<Triangle const> faces,
                               typename Out::VecCoord const& places) {
    constexpr double clear = 0.55;  // a cut passes through the nearer end of an edge
    std::vector<char> isTwin(points.size(), 0);
    for (const Index i : twins(points)) isTwin[std::size_t(i)] = 1;
    std::vector<Index> near;
    std::vector<Fit> fits;
    for (std::size_t e = 0; e < elements.size(); ++e)
      if (std::any_of(
              elements[e].begin(), elements[e].end(), [&](Index i) { return isTwin[std::size_t(i)] != 0; }))
        near.push_back(Index(e)), fits.emplace_back(points, elements[e]);
    if (near.empty()) return;
    std::vector<std::vector<Index>> beside(choices.size());
    for (Triangle const& t : faces)
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t l = 1; l < 3; ++l) beside[std::size_t(t[k])].push_back(t[(k + l) % 3]);
    // what its element has of it beside the corners at a cut
    auto clarity = [&](Choice const& c) {
      double sum = 0;
      for (std::size_t k = 0; k < c.points.size(); ++k)
        if (!isTwin[std::size_t(c.points[k])]) sum += c.weights[k];
      return sum;
    };
    auto common = [](auto const& element, Choice const& other) {
      return std::any_of(element.begin(), element.end(), [&](Index i) {
        return std::find(other.points.begin(), other.points.end(), i) != other.points.end();
      });
    };
    std::vector<char> settled(choices.size(), 0);
    std::vector<Index> queue, order;
    for (std::size_t i = 0; i < choices.size(); ++i) {
      if (clarity(choices[i]) >= clear || beside[i].empty())
        settled[i] = 1, queue.push_back(Index(i));
      else
        order.push_back(Index(i));
    }
    std::stable_sort(order.begin(), order.end(), [&](Index i, Index j) {
      return clarity(choices[std::size_t(i)]) > clarity(choices[std::size_t(j)]);
    });
    std::size_t next = 0;  // of those of a piece that is nowhere clear, the clearest one
    for (std::size_t q = 0;; ++q) {
      if (q == queue.size()) {
        while (next < order.size() && settled[std::size_t(order[next])]) ++next;
        if (next == order.size()) break;
        settled[std::size_t(order[next])] = 1;
        queue.push_back(order[next]);
      }
      for (const Index i : beside[std::size_t(queue[q])]) {
        if (settled[std::size_t(i)]) continue;
        const Eigen::Vector3d place = places[std::size_t(i)].template cast<double>();
        int most = -1;
        Choice best;
        for (std::size_t n = 0; n < near.size(); ++n) {
          auto const& element = elements[std::size_t(near[n])];
          int count = 0;
          for (const Index j : beside[std::size_t(i)])
            count += settled[std::size_t(j)] && common(element, choices[std::size_t(j)]);
          if (count < most) continue;
          if (count > most) best = {};
          most = count;
          best.consider(typename ElementLocator<Fit>::Located{near[n], fits[n].fit(place)}, elements);
        }
        if (best.score != Choice{}.score) choices[std::size_t(i)] = best;
        settled[std::size_t(i)] = 1;
        queue.push_back(i);
      }
    }
  }

  // where several hexahedra are at one place, each point goes with the one of its finer cell
  static void chooseByFinerCells(std::vector<Choice>& choices, std::vector<Eigen::Vector3d> const& points,
                                 TopologyView const& topology, typename Out::VecCoord const& positions) {
    using Fit = MultilinearFit<3>;
    const ElementLocator<Fit> locator(topology.finer.positions, topology.finer.hexahedra);
    for (std::size_t i = 0; i < choices.size(); ++i) {
      const Eigen::Vector3d p = Out::center(positions[i]).template cast<double>();
      const int cell = locator.locate(p).element;
      if (cell < 0) continue;
      const Index parent = topology.finer.parents[std::size_t(cell)];
      choices[i].consider(
          typename ElementLocator<Fit>::Located{parent,
                                                Fit(points, topology.hexahedra[std::size_t(parent)]).fit(p)},
          topology.hexahedra);
    }
  }
};

}  // namespace sinew
