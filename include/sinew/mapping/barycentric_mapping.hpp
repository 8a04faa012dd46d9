// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/mapping/carried_runs.hpp>
#include <sinew/mapping/point_weights.hpp>
#include <sinew/topology/element_checks.hpp>
#include <sinew/topology/point_location.hpp>

#include <array>
#include <vector>

namespace sinew {

/// Each point of the child is carried by the element of the parent that contains it at rest, or by the
/// nearest one: x = sum_k w_k x_k. The weights are barycentric coordinates in tetrahedra and triangles,
/// multilinear ones in hexahedra, quads and edges. Volumes carry where the parent has some, else surfaces,
/// else edges; on the latter two the child follows its projection. Affine motion of the parent is reproduced
/// exactly. Where the parent has the points of its RegularGridTopology or SparseGridTopology, the child is
/// looked for in the cells as they lie before translation, rotation and scale3d of the parent, as in SOFA:
/// these put the child into place with the grid.
template <class I, class O>
struct BarycentricMapping {
  using Role = role::Mapping;
  using In = I;
  using Out = O;
  using Real = typename Out::Real;
  using Weight = typename In::Real;
  static_assert(!In::rigid && !Out::rigid && In::size == 3 && Out::size == 3,
                "BarycentricMapping joins points in space");
  static constexpr std::string_view className = "BarycentricMapping";
  static constexpr bool needsParentTetrahedra = true;

  static constexpr auto fields() { return field_list(); }

  struct Carrier {
    std::array<Index, 4> points;
    std::array<Weight, 4> weights;
  };
  std::vector<Carrier> carriers{};  // one a point; those with fewer than four points end in weights of zero
  std::vector<Carrier> others{};    // the other four points of hexahedra; empty where there is none
  CarriedRuns<In, Out> together{};  // those that have an element in common

  void init(InitContext<In> const& parent, InitContext<Out> const& child, typename Out::VecCoord& positions) {
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
    auto offer = [&]<class Fit>(std::type_identity<Fit>, auto const& elements) {
      const ElementLocator<Fit> locator(points, elements);
      for (std::size_t i = 0; i < choices.size() && !elements.empty(); ++i)
        if (choices[i].score < 0)
          choices[i].consider(locator.locate(positions[i].template cast<double>()), elements);
    };
    if (!topology.tetrahedra.empty() || !topology.hexahedra.empty()) {
      offer(std::type_identity<TetrahedronFit>{}, topology.tetrahedra);
      offer(std::type_identity<MultilinearFit<3>>{}, topology.hexahedra);
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

    if constexpr (!onHost)
      weights.init(parent.rest.size(), choices.size(), [&](auto&& add) {
        for (std::size_t i = 0; i < choices.size(); ++i)
          for (std::size_t k = 0; k < 8; ++k)
            if (choices[i].weights[k] != 0)
              add(i, std::size_t(choices[i].points[k]), Weight(choices[i].weights[k]));
      });
    carriers.assign(choices.size(), {});
    others.assign(topology.hexahedra.empty() ? 0 : choices.size(), {});
    for (std::size_t i = 0; i < choices.size(); ++i) {
      if (choices[i].score == Choice{}.score)
        throw Error(
            where,
            text(
                "the elements of ", parent.where, " are all flat and carry no point; move its points apart"));
      for (std::size_t k = 0; k < 8; ++k)
        if (k < 4 || !others.empty()) {
          Carrier& carrier = (k < 4 ? carriers : others)[i];
          carrier.points[k % 4] = choices[i].points[k];
          carrier.weights[k % 4] = Weight(choices[i].weights[k]);
        }
    }
    auto part = [this](int k) -> auto const& { return k < 4 ? carriers : others; };
    together.init(
        carriers.size(),
        others.empty() ? 4 : 8,
        [&](std::size_t i, int k) { return part(k)[i].points[std::size_t(k % 4)]; },
        [&](std::size_t i, int k) { return part(k)[i].weights[std::size_t(k % 4)]; });
  }

  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) const { interpolate(out, in); }
  void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const { interpolate(out, in); }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
    forEachRun(
        together.leastTransposed,
        [&](auto const& run) { together.applyTransposed(run, in, out); },
        [&](std::size_t i) {
          auto add = [&](Carrier const& c) {
            for (std::size_t k = 0; k < 4; ++k)
              in[std::size_t(c.points[k])] += c.weights[k] * out[i].template cast<Weight>();
          };
          add(carriers[i]);
          if (!others.empty()) add(others[i]);
        });
  }
  template <class F>
  void forEachJacobianBlock(int point, F&& f) const {
    for (auto const* list : {&carriers, &others})
      for (std::size_t k = 0; k < 4 && !list->empty(); ++k) {
        Carrier const& carrier = (*list)[std::size_t(point)];
        if (carrier.weights[k] != 0)
          f(carrier.points[k], Mat<Real, 3>(Mat<Real, 3>::Identity() * Real(carrier.weights[k])));
      }
  }

  // with an end on a device
  static constexpr bool onHost = MappedLoops<In, Out>::onHost;
  PointWeights<In, Out> weights{};
  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) const requires(!onHost) {
    weights.apply(out, in);
  }
  void ask(typename Out::VecCoord const& out, typename In::VecCoord const& in) const requires(!onHost) {
    weights.ask(out, in);
  }
  void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const requires(!onHost) {
    weights.apply(out, in);
  }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const requires(!onHost) {
    weights.applyJT(in, out);
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

  void interpolate(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
    Weight const* const x = in.data()->data();
    forEachRun(
        together.least,
        [&](auto const& run) { together.apply(run, out, in); },
        [&](std::size_t i) {
          auto sum = [x](Carrier const& c, int k) {
            return c.weights[0] * x[3 * c.points[0] + k] + c.weights[1] * x[3 * c.points[1] + k] +
                   c.weights[2] * x[3 * c.points[2] + k] + c.weights[3] * x[3 * c.points[3] + k];
          };
          Weight place[3];
          for (int k = 0; k < 3; ++k) place[k] = sum(carriers[i], k);
          if (!others.empty())
            for (int k = 0; k < 3; ++k) place[k] += sum(others[i], k);
          for (int k = 0; k < 3; ++k) out[i][k] = Real(place[k]);
        });
  }

  // the runs of so many points, and the points between them
  template <class OfRun, class OfPoint>
  SINEW_INLINE void forEachRun(std::size_t least, OfRun&& ofRun, OfPoint&& ofPoint) const {
    std::size_t i = 0;
    for (auto run = together.runs.begin();; ++run) {
      while (run != together.runs.end() && run->end - run->first < least) ++run;
      const bool last = run == together.runs.end();
      for (const std::size_t end = last ? carriers.size() : run->first; i < end; ++i) ofPoint(i);
      if (last) return;
      ofRun(*run);
      i = run->end;
    }
  }
};

}  // namespace sinew
