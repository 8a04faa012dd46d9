// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/error.hpp>
#include <sinew/core/small_matrix.hpp>

#include <Eigen/Core>
#include <array>
#include <vector>

namespace sinew {

using Index = int;
using Edge = std::array<Index, 2>;
using Triangle = std::array<Index, 3>;
using Quad = std::array<Index, 4>;
using Tetrahedron = std::array<Index, 4>;
using Hexahedron = std::array<Index, 8>;

/// Points and the elements over them, as files hold them. Node order of elements is VTK's (and Gmsh's).
struct Mesh {
  std::vector<Eigen::Vector3d> positions{};
  std::vector<Edge> edges{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<Hexahedron> hexahedra{};

  bool operator==(Mesh const&) const = default;
};

namespace detail {
template <class Elements>
void check_indices(std::string_view where, std::string_view kind, Elements const& elements,
                   std::size_t points) {
  for (std::size_t e = 0; e < elements.size(); ++e)
    for (const Index i : elements[e])
      if (i < 0 || std::size_t(i) >= points)
        throw Error(where,
                    text(kind,
                         ' ',
                         e,
                         " refers to point ",
                         i,
                         ", but there are ",
                         points,
                         " points, numbered from 0; correct the index or add the point"));
}

/// The same of all elements of a mesh, or of what has lists of these names.
template <class Lists>
void check_elements(std::string_view where, Lists const& lists, std::size_t points) {
  check_indices(where, "edge", lists.edges, points);
  check_indices(where, "triangle", lists.triangles, points);
  check_indices(where, "quad", lists.quads, points);
  check_indices(where, "tetrahedron", lists.tetrahedra, points);
  check_indices(where, "hexahedron", lists.hexahedra, points);
}
}  // namespace detail

/// Throws Error, naming `where` and the element, unless all coordinates are finite and all indices in range.
void check_mesh(std::string_view where, Mesh const& mesh);

}  // namespace sinew

#if SINEW_DEFINES
#include <cmath>
#include <string>

namespace sinew {

SINEW_ONCE void check_mesh(std::string_view where, Mesh const& mesh) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (!all_finite(mesh.positions[i]))
      throw Error(where,
                  text("point ", i, " has a coordinate that is not a finite number; correct the file"));
  detail::check_elements(where, mesh, mesh.positions.size());
}

}  // namespace sinew
#endif
