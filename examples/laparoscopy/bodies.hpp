// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/mesh.hpp>

#include <Eigen/Core>
#include <array>
#include <vector>

namespace examples {

/// The body lies on its back: x to its left, y to its head, z to its front [m].
///
/// What an organ is made of: the points that move, on a grid or as tetrahedra; the skin that they carry and
/// that touches other bodies; points held by what is not simulated, rigidly (fixed) or by springs (tethered).
struct Organ {
  std::array<int, 3> grid{0, 0, 0};  // points of the grid; 0: there are tetrahedra
  sinew::Mesh volume{}, skin{};
  std::vector<int> fixed{}, tethered{};
  double volumeOfSkin = 0, cell = 0;  // [m^3]; edge of a cell of the grid [m]
};

/// The room in which all is, an ellipsoid.
struct AbdominalWall {
  Eigen::Vector3d center{0, -0.08, 0}, radii{0.17, 0.25, 0.10};
  /// (Nearly) the distance from the wall; negative inside.
  double operator()(Eigen::Vector3d const& p) const;
};

struct LaparoscopyBodies {
  Organ liver, intestines;
  sinew::Mesh wall, ribs;
  AbdominalWall room{};
};

/// With so many tetrahedra in the liver; or with a grid of so many points around it, and grids for all.
/// Throws sinew::Error.
LaparoscopyBodies make_bodies(int tetrahedra);
LaparoscopyBodies make_bodies(std::array<int, 3> const& grid);

/// Volume inside of a closed surface [m^3].
double enclosed_volume(std::vector<Eigen::Vector3d> const& points,
                       std::vector<sinew::Triangle> const& triangles);
/// Whether a place is inside of it: whether the surface goes round it (the sum of the solid angles of its
/// triangles, van Oosterom and Strackee 1983).
bool is_inside(Eigen::Vector3d const& place, std::vector<Eigen::Vector3d> const& points,
               std::vector<sinew::Triangle> const& triangles);

}  // namespace examples
