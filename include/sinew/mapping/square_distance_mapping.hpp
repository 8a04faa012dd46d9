// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/mapping/measure_driver.hpp>
#include <sinew/mapping/measured_elements.hpp>

#include <array>
#include <string_view>

namespace sinew {

/// Each point of the child is the squared length of an edge of the parent:
///   c = d.d,  d = x1 - x0        J = (-2 d', 2 d')        K_g = 2 f (1 -1; -1 1) I
/// The edges are those of the topology in the node of the mapping, or else of the parent's. `stabilized` has
/// no K_g for edges that push (f > 0), where it is not negative.
template <class I, class O>
struct SquareDistanceMapping {
  using Role = role::Mapping;
  using In = I;
  using Out = O;
  using Real = typename In::Real;
  static constexpr int N = In::spatial;
  static constexpr std::string_view className = "SquareDistanceMapping";
  static constexpr bool overParent = true;

  GeometricStiffness geometricStiffness = GeometricStiffness::stabilized;

  static constexpr auto fields() {
    using M = SquareDistanceMapping;
    return field_list(field("geometricStiffness",
                            &M::geometricStiffness,
                            "",
                            "geometric stiffness: what rotating edges add to the stiffness"));
  }

  struct Measure {
    static constexpr int arity = 2;
    Vec<Real, N> d = Vec<Real, N>::Zero();

    Real value(std::array<Vec<Real, N>, 2> const& x) {
      d = x[1] - x[0];
      return d.squaredNorm();
    }
    Vec<Real, N> slope(int k) const { return Real(k == 0 ? -2 : 2) * d; }
    Mat<Real, N> second(int i, int j) const { return Real(i == j ? 2 : -2) * Mat<Real, N>::Identity(); }
  };
  MeasureDriver<In, Out, Measure> measures{};

  /// Throws Error where there are no edges, or a child has another number of points.
  void init(InitContext<In> const& parent, InitContext<Out> const& child, typename Out::VecCoord& positions) {
    const std::string where = text(child.where, ": ", component_name<SquareDistanceMapping>());
    measures.all.clear();
    for (Edge const& e :
         detail::measured_elements(parent, child, where, "edge", "edges", &TopologyView::edges))
      measures.all.push_back({e, {}});
    measures.place(positions, where, "edges");
  }

  std::vector<bool> pointsThatStay(TopologyView const&, TopologyChange const& change) const {
    return change.of(ElementKind::edge).stays();
  }

  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) { measures.apply(out, in); }
  void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
    measures.applyJ(out, in);
  }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
    measures.applyJT(in, out);
  }
  template <class F>
  void forEachJacobianBlock(int point, F&& f) const {
    measures.forEachJacobianBlock(point, f);
  }
  void updateK(typename Out::VecDeriv const& f) { measures.updateK(f, geometricStiffness); }
  void addKx(typename In::VecDeriv& df, typename In::VecDeriv const& dx, double k) const {
    if (geometricStiffness != GeometricStiffness::none) measures.addKx(df, dx, k);
  }
  template <class Sink>
  void addToMatrix(MechanicalParams const& p, Sink const& sink) const {
    if (geometricStiffness != GeometricStiffness::none) measures.addToMatrix(p, sink);
  }
};

}  // namespace sinew
