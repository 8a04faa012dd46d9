// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/mapping/carried_frames.hpp>
#include <sinew/mapping/carried_points.hpp>
#include <sinew/topology/element_checks.hpp>
#include <sinew/topology/point_location.hpp>

#include <array>
#include <limits>
#include <type_traits>
#include <vector>

namespace sinew {

/// Each point of the child is carried by the element of the parent that contains it at rest, or by the
/// nearest one: x = sum_k w_k x_k. The weights are barycentric coordinates in tetrahedra and triangles,
/// multilinear ones in hexahedra, quads and edges, and the shape functions of pyramids and prisms. Volumes
/// carry where the parent has some, else surfaces, else edges; on the latter two the child follows its
/// projection. Affine motion of the parent is reproduced exactly. Where the parent has the points of its
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
  static constexpr bool needsParentTetrahedra = true;

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

    carriers.assign(choices.size(), {});
    const bool more = !topology.hexahedra.empty() || !topology.pyramids.empty() || !topology.prisms.empty();
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

  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) {
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
