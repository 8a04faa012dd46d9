// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <span>
#include <string>

namespace sinew {

/// Throws Error at a tetrahedron that refers to a missing point, is flat, or is inside out. What there is no
/// room for in less than three dimensions is not asked.
template <class D>
void check_tetrahedra(std::string const& where, std::span<Tetrahedron const> tetrahedra,
                      typename D::VecCoord const& rest) {
  detail::check_indices(where, "tetrahedron", tetrahedra, rest.size());
  if constexpr (D::spatial == 3)
    for (std::size_t e = 0; e < tetrahedra.size(); ++e) {
      Mat<double, 3> edges;
      for (int c = 0; c < 3; ++c)
        edges.col(c) = (D::center(rest[std::size_t(tetrahedra[e][std::size_t(c) + 1])]) -
                        D::center(rest[std::size_t(tetrahedra[e][0])]))
                           .template cast<double>();
      const double volume = edges.determinant() / 6,
                   longest = std::max({edges.col(0).norm(), edges.col(1).norm(), edges.col(2).norm()});
      if (!(std::abs(volume) > 1e-14 * longest * longest * longest))
        throw Error(where, text("tetrahedron ", e, " has no volume; move or merge its points"));
      if (volume < 0)
        throw Error(
            where,
            text("tetrahedron ", e, " is inside out (volume ", volume, " m^3); swap two of its points"));
    }
}

/// Throws Error where an element of a topology refers to a point that the state has not.
void check_element_indices(std::string const& where, TopologyView const& topology, std::size_t points);

/// Throws Error where a topology has elements of second order, for what works with those of first order only.
void check_first_order(std::string const& where, TopologyView const& topology);

/// Throws Error where values lie on a body with another number of points.
template <class D>
void check_values_of_body(std::string const& where, InitContext<D> const& context) {
  if (!context.body.empty() && context.body.size() != context.rest.size())
    throw Error(where,
                text("the state has ",
                     context.rest.size(),
                     " values, but the body on which they lie has ",
                     context.body.size(),
                     " points; give one value for each"));
}

/// Throws Error where the state has fewer points than the grid over which it is.
inline void check_grid_state(std::string const& where, std::size_t grid, std::size_t state) {
  if (state < grid)
    throw Error(where,
                text("the grid has ",
                     grid,
                     " points, but the state ",
                     state,
                     "; give the state no position, so that it takes those of the grid, or one for each"));
}

}  // namespace sinew

#if SINEW_DEFINES
namespace sinew {

SINEW_ONCE void check_element_indices(std::string const& where, TopologyView const& topology,
                                      std::size_t points) {
  detail::check_elements(where, topology, points);
}

SINEW_ONCE void check_first_order(std::string const& where, TopologyView const& topology) {
  for_each_kind(topology, [&](int kind, auto const& list) {
    if (kind >= int(ElementKind::quadraticTetrahedron) && !list.empty())
      throw Error(
          where,
          text("the topology has a ",
               element_kind_name(kind),
               ", and this takes no elements of second order; give the node a topology of first order "
               "(in Gmsh, Mesh.ElementOrder = 1)"));
  });
}

}  // namespace sinew
#endif
