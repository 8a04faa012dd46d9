// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/mapping/element_measure_mapping.hpp>

#include <array>

namespace sinew {

struct EdgeSquares {
  static constexpr std::string_view className = "SquareDistanceMapping", noun = "edge", plural = "edges",
                                    stiffnessWords =
                                        "geometric stiffness: what rotating edges add to the stiffness";
  static constexpr auto elements = &TopologyView::edges;
  static constexpr ElementKind element = ElementKind::edge;

  template <class In>
  struct Measure {
    using Real = typename In::Real;
    static constexpr int N = In::spatial;
    static constexpr int arity = 2;
    Vec<Real, N> d = Vec<Real, N>::Zero();

    Real value(std::array<Vec<Real, N>, 2> const& x) {
      d = x[1] - x[0];
      return d.squaredNorm();
    }
    Vec<Real, N> slope(int k) const { return Real(k == 0 ? -2 : 2) * d; }
    Mat<Real, N> second(int i, int j) const { return Real(i == j ? 2 : -2) * Mat<Real, N>::Identity(); }
  };
};

/// Each point of the child is the squared length of an edge of the parent:
///   c = d.d,  d = x1 - x0        J = (-2 d', 2 d')        K_g = 2 f (1 -1; -1 1) I
/// The edges are those of the topology in the node of the mapping, or else of the parent's. `stabilized` has
/// no K_g for edges that push (f > 0), where it is not negative.
template <class I, class O>
using SquareDistanceMapping = ElementMeasureMapping<I, O, EdgeSquares>;

}  // namespace sinew
