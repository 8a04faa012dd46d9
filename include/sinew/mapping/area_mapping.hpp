// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/cross_matrix.hpp>
#include <sinew/mapping/element_measure_mapping.hpp>

#include <Eigen/Geometry>
#include <array>
#include <limits>

namespace sinew {

struct TriangleAreas {
  static constexpr std::string_view className = "AreaMapping", noun = "triangle", plural = "triangles",
                                    stiffnessWords =
                                        "geometric stiffness: what rotating sides add to the stiffness";
  static constexpr auto elements = &TopologyView::triangles;
  static constexpr ElementKind element = ElementKind::triangle;

  template <class In>
  struct Measure {
    static_assert(!In::rigid && In::size == 3, "Sinew: AreaMapping maps Vec3 to Vec1");
    using Real = typename In::Real;
    static constexpr int arity = 3;
    std::array<Vec<Real, 3>, 3> side{};  // s_k
    Vec<Real, 3> normal = Vec<Real, 3>::Zero();
    Real inverse{0};  // 1/|N|

    Real value(std::array<Vec<Real, 3>, 3> const& x) {
      for (std::size_t k = 0; k < 3; ++k) side[k] = x[(k + 1) % 3] - x[(k + 2) % 3];
      const Vec<Real, 3> twice = side[1].cross(side[2]);
      const Real size = twice.norm(), tiny = std::numeric_limits<Real>::epsilon() * side[0].squaredNorm();
      inverse = size > tiny ? 1 / size : Real(0);
      normal = twice * inverse;
      return size / 2;
    }
    Vec<Real, 3> slope(int k) const { return side[std::size_t(k)].cross(normal) / 2; }
    Mat<Real, 3> second(int i, int j) const {
      const Mat<Real, 3> across = Mat<Real, 3>::Identity() - normal * normal.transpose();
      Mat<Real, 3> m = cross_matrix(side[std::size_t(i)]).transpose() * across *
                       cross_matrix(side[std::size_t(j)]) * inverse;
      if (i != j) m += (j == (i + 1) % 3 ? Real(-1) : Real(1)) * cross_matrix(normal);
      return m / 2;
    }
  };
};

/// Each point of the child is the area of a triangle of the parent. With s_k the side across corner k, in the
/// order of the corners, N = s_1 x s_2 and n = N/|N|:
///   A = |N|/2,   dA/dx_k = s_k x n / 2
///   d2A/dx_i dx_j = ([s_i]x' (I - n n') [s_j]x / |N| + c_ij [n]x) / 2,  c_ij = -1, 1, 0 for j = i + 1, i -
///   1, i
/// The triangles are those of the topology in the node of the mapping, or else of the parent's. One without
/// area has no J and no K_g. `stabilized` has no K_g for triangles that push (f > 0).
template <class I, class O>
using AreaMapping = ElementMeasureMapping<I, O, TriangleAreas>;

}  // namespace sinew
