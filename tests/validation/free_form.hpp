// SPDX-License-Identifier: BSL-1.0
#pragma once

// A liver of which there is a skin, in a sparse grid of cells that carry it.

#include "bars.hpp"
#include "registry_scene.hpp"

#include <sinew/topology/implicit_surface.hpp>
#include <sinew/topology/surface_mesh.hpp>

namespace free_form {

using namespace bars;

inline const LiverShape liver{};
inline Mesh liver_skin() { return surface(liver, liver.box_min(), liver.box_max(), 0.012); }

/// The cells of a grid that touch the skin or lie inside it, all equally stiff.
inline SparseGridTopology cells_around(Mesh const& skin, double width, bool onlyInside = false) {
  return {.position = skin.positions,
          .triangles = skin.triangles,
          .cellWidth = width,
          .onlyInsideCells = onlyInside,
          .fillWeighted = false};
}
inline double volume_of(SparseGridTopology grid) {
  grid.generate("grid");
  auto const& h = grid.hexahedra[0];
  const Vector3d a = grid.points[std::size_t(h[0])], b = grid.points[std::size_t(h[6])];
  return (b - a).prod() * double(grid.hexahedra.size());
}

/// A grid of cells with a force field, which carries the skin.
template <class Force, class... More>
auto carried(Mesh const& skin, SparseGridTopology const& cells, Force const& force, More const&... more) {
  return RegistryScene{node<"grid">(
      to_rounding(),
      SparseLDLSolver<>{},
      cells,
      MechanicalObject<Vec3d>{},
      force,
      more...,
      node<"skin">(MechanicalObject<Vec3d>{skin.positions}, BarycentricMapping<Vec3d, Vec3d>{}))};
}

}  // namespace free_form
