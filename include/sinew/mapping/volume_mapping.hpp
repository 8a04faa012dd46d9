// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/cross_matrix.hpp>
#include <sinew/mapping/element_measure_mapping.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace sinew {

struct TetrahedronVolumes {
  static constexpr std::string_view className = "VolumeMapping", noun = "tetrahedron", plural = "tetrahedra",
                                    stiffnessWords =
                                        "geometric stiffness: what rotating faces add to the stiffness";
  static constexpr auto elements = &TopologyView::tetrahedra;
  static constexpr ElementKind element = ElementKind::tetrahedron;

  template <class In>
  struct Measure {
    static_assert(!In::rigid && In::size == 3, "VolumeMapping maps Vec3 to Vec1");
    using Real = typename In::Real;
    static constexpr int arity = 4;
    std::array<Vec<Real, 3>, 4> edge{}, area{};  // xk - x0, dV/dxk

    Real value(std::array<Vec<Real, 3>, 4> const& x) {
      for (std::size_t k = 0; k < 4; ++k) edge[k] = x[k] - x[0];
      area[1] = edge[2].cross(edge[3]) / 6;
      area[2] = edge[3].cross(edge[1]) / 6;
      area[3] = edge[1].cross(edge[2]) / 6;
      area[0] = -area[1] - area[2] - area[3];
      return edge[1].dot(area[1]);
    }
    Vec<Real, 3> slope(int k) const { return area[std::size_t(k)]; }
    // [e]x / 6, e from the one to the other of the two points that are left, in the order that makes (i, j,
    // from, to) an odd permutation
    Mat<Real, 3> second(int i, int j) const {
      if (i == j) return Mat<Real, 3>::Zero();
      std::array<int, 2> left{};
      for (int k = 0, n = 0; k < 4; ++k)
        if (k != i && k != j) left[std::size_t(n++)] = k;
      const bool odd = (i > j) != ((std::max(i, j) - std::min(i, j)) % 2 == 0);
      return cross_matrix(
          Vec<Real, 3>((edge[std::size_t(left[1])] - edge[std::size_t(left[0])]) / Real(odd ? 6 : -6)));
    }
  };
};

/// Each point of the child is the volume of a tetrahedron of the parent, negative where it is inside out:
///   V = e1 . (e2 x e3) / 6,  ek = xk - x0       dV/dxk = ak  with  6 a1 = e2 x e3, ..., a0 = -a1 - a2 - a3
///   K_g = f d2V/dx2                              with f the force on V
/// where 6 d2V/dx1 dx2 v = -e3 x v and so on cyclically, and blocks on the diagonal are zero. The tetrahedra
/// are those of the topology in the node of the mapping, or else of the parent's. `stabilized` has K_g, as
/// SOFA, for tetrahedra that are pulled together (f < 0) only; d2V/dx2 has both signs anyway.
template <class I, class O>
using VolumeMapping = ElementMeasureMapping<I, O, TetrahedronVolumes>;

}  // namespace sinew
