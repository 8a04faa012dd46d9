// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/context.hpp>
#include <sinew/core/fields.hpp>
#include <sinew/fluid/grid_fluid.hpp>

#include <cmath>

namespace sinew::fluid {

// What the components Fluid2D and Fluid3D have in common, over their fields. The layer of cells around is
// counted, as in SOFA: its walls are cells of the grid.

/// The fields behind the numbers of cells along each axis.
template <class F, class... Cells>
constexpr auto grid_component_fields(std::string_view obstacleWords, Cells... cells) {
  return field_list(
      cells...,
      field("cellwidth", &F::cellwidth, "m", "width of each cell", range::positive),
      field("center", &F::center, "m", "position of the centre of the grid"),
      field("height",
            &F::height,
            "",
            "how far the surface is at first from the centre of the first cell, which belongs to the "
            "walls, along dir [cells]; 0: the fluid fills the box and has no surface"),
      field("dir", &F::dir, "", "normal of the surface at first, out of the fluid"),
      field("tstart", &F::tstart, "s", "from when on the source pours fluid"),
      field("tstop", &F::tstop, "s", "until when"),
      field("density", &F::density, "kg/m^3", "of the fluid", range::positive),
      field("viscosity",
            &F::viscosity,
            "Pa s",
            "dynamic viscosity; that of water is 0.001",
            range::nonNegative),
      field("walls", &F::walls, "", "whether fluid slips along walls and obstacles, or sticks to them"),
      field("advection", &F::advection, "", "how velocity and surface are carried along"),
      field("obstacle", &F::obstacle, "m", obstacleWords),
      field("source", &F::source, "m", "centre of the source"),
      field("sourceRadius",
            &F::sourceRadius,
            "m",
            "radius of the source; 0: there is none",
            range::nonNegative),
      field("sourceVelocity", &F::sourceVelocity, "m/s", "of what it pours"),
      field("keepVolume",
            &F::keepVolume,
            "",
            "moves the whole surface by a small part of a cell after each step, so that the fluid keeps "
            "its volume"),
      field("tolerance", &F::tolerance, "", "of the pressure: residual over right side", range::open(0, 1)),
      field("iterations", &F::iterations, "", "most iterations for the pressure", range::atLeast(1)));
}

template <int N, class C>
Each<int, N> cell_counts(C const& c) {
  if constexpr (N == 3)
    return {c.nx, c.ny, c.nz};
  else
    return {c.nx, c.ny};
}

template <int N, class C>
GridFluidSettings<N> grid_settings(C const& c) {
  GridFluidSettings<N> s;
  s.cells = cell_counts<N>(c);
  for (int& n : s.cells) n -= 2;
  s.cellWidth = c.cellwidth;
  for (int d = 0; d < N; ++d) s.corner[d] = -s.cells[std::size_t(d)] * c.cellwidth / 2;
  s.corner += c.center.template head<N>();
  s.density = c.density;
  s.viscosity = c.viscosity;
  s.walls = c.walls;
  s.advection = c.advection;
  s.hasSurface = c.height != 0;
  s.keepsVolume = c.keepVolume;
  s.tolerance = c.tolerance;
  s.maxIterations = c.iterations;
  return s;
}

template <int N, class C>
void start(C& c, std::string const& where) {
  using Vector = Eigen::Matrix<double, N, 1>;
  const GridFluidSettings<N> settings = grid_settings<N>(c);
  if (settings.hasSurface && !(c.dir.norm() > 0))
    throw Error(where,
                "dir is zero; give the normal of the surface of the fluid, such as that against gravity");
  for (std::size_t k = 0; k < c.obstacle.size(); ++k)
    if (!(c.obstacle[k].template head<N>().array() < c.obstacle[k].template tail<N>().array()).all())
      throw Error(
          where,
          text("obstacle[",
               k,
               "] is empty; give its lower corner, then its upper one, which is larger along each axis"));
  auto& grid = c.grid;
  grid.init(where, settings);
  grid.setSolids([&](Vector const& x) {
    for (auto const& box : c.obstacle)
      if ((x.array() >= box.template head<N>().array()).all() &&
          (x.array() <= box.template tail<N>().array()).all())
        return true;
    return false;
  });
  if (grid.saves(c.flow)) {
    grid.restore(c.flow);
    return;
  }
  const double h = settings.cellWidth;
  const Vector first = settings.corner.array() - h / 2;  // the centre of the first cell, of the walls
  if (settings.hasSurface)
    grid.setSurface([&](Vector const& x) { return (x - first).dot(c.dir.normalized()) - c.height * h; });
  grid.begin();
  grid.save(c.flow, {});
}

/// f() while the grid has the bodies of its component.
template <class C, class F>
void with_bodies(C& c, F&& f) {
  c.grid.bodies.swap(c.bodies);
  f();
  c.grid.bodies.swap(c.bodies);
}

template <int N, class C>
void advance(C& c, StepAhead const& ahead, Eigen::Vector3d const& gravity, SomeWorkers workers) {
  auto& grid = c.grid;
  const double middle = ahead.begin + ahead.dt / 2;
  if (grid.settings().hasSurface && c.sourceRadius > 0 && middle >= c.tstart && middle < c.tstop)
    grid.pour(BallDistance<N>{c.source, c.sourceRadius}, c.sourceVelocity, workers);
  with_bodies(c, [&] { grid.step(ahead.dt, gravity.head<N>(), workers); });
  grid.save(c.flow, workers);
}

/// Beyond which a step is long for what moves with the fluid [cells].
inline constexpr double longStep = 5;

template <class Grid>
std::string_view notice_of(Grid const& grid) {
  if (!grid.pressureSolve.converged)
    return "the pressure is not solved to its tolerance, so that the fluid does not quite keep its volume; "
           "raise "
           "iterations";
  if (grid.courant > longStep)
    return "the fluid goes more than 5 cells in a step: it is stable, but loses energy, small waves and "
           "splashes; take "
           "a smaller dt, or larger cells";
  return {};
}

}  // namespace sinew::fluid
