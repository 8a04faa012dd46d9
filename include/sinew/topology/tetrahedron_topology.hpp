// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

#include <Eigen/LU>
#include <vector>

namespace sinew {

/// Tetrahedra over the points of the node's state. Points 1, 2, 3 turn counter-clockwise seen from point 0's
/// far side: det(x1-x0, x2-x0, x3-x0) > 0.
struct TetrahedronTopology {
  using Role = role::Topology;
  static constexpr std::string_view className = "TetrahedronTopology";
  static constexpr bool hasTetrahedra = true;

  std::vector<Tetrahedron> tetrahedra{};

  static constexpr auto fields() {
    return field_list(
        field("tetrahedra", &TetrahedronTopology::tetrahedra, "", "four points each", range::nonNegative));
  }

  TopologyView view() const { return {.tetrahedra = tetrahedra}; }

  /// Throws Error at an index out of range, and at an element that is flat or inside out.
  template <class D>
  void init(InitContext<D> const& context) const {
    const std::string where = text(context.where, ": TetrahedronTopology");
    detail::check_indices(where, "tetrahedron", tetrahedra, context.rest.size());
    if constexpr (D::spatial == 3)
      for (std::size_t e = 0; e < tetrahedra.size(); ++e) {
        Mat<double, 3> edges;
        for (int c = 0; c < 3; ++c)
          edges.col(c) = (D::center(context.rest[std::size_t(tetrahedra[e][std::size_t(c) + 1])]) -
                          D::center(context.rest[std::size_t(tetrahedra[e][0])]))
                             .template cast<double>();
        const double volume = edges.determinant() / 6, longest = edges.colwise().norm().maxCoeff();
        if (!(std::abs(volume) > 1e-14 * longest * longest * longest))
          throw Error(where, text("tetrahedron ", e, " has no volume; move or merge its points"));
        if (volume < 0)
          throw Error(
              where,
              text("tetrahedron ", e, " is inside out (volume ", volume, " m^3); swap two of its points"));
      }
  }
};

}  // namespace sinew
