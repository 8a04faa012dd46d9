// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/mesh.hpp>
#include <sinew/fluid/advection.hpp>
#include <sinew/fluid/surface_loops.hpp>

namespace sinew::fluid {

/// A free surface as the zero of a signed distance in the centres of cells, negative in the fluid, in cells
/// (Osher, Sethian 1988).
template <class Real, int N, class Loops = HostLoops>
class LevelSet {
 public:
  using Velocity = StaggeredVelocity<Real, N, Loops>;
  using Field = typename Loops::template Array<Real>;

  Field value{};
  /// Distances farther than that are not kept.
  Real band = 5;

  void init(CellGrid<N> const& grid, Real far) {
    band = far;
    Loops::assign(value, grid.size, -band);
    Loops::assign(next_, grid.size, -band);
    room_.init(grid.size);
    Loops::assign(fixed_, grid.size, std::uint8_t(0));
    numbers_.init(grid);
  }

  /// Is carried along by the velocity for a step [cells per m/s].
  void advect(Velocity const& u, Real step, Advection method, Loops const& loops) {
    Field const& now = value;
    fluid::advect(u,
                  -1,
                  now,
                  next_,
                  step,
                  method,
                  room_,
                  loops,
                  InBand<Real>{entries(now), entries(u.cell), band},
                  [&](Field& field) { fillAround(u.grid, field, loops); });
    value.swap(next_);
  }

  /// Makes it a distance again without moving its zero: next to the surface by the slope there (Russo,
  /// Smereka 2000), from there on by the upwind equation |grad d| = 1 (Rouy, Tourin 1992), cell by cell as
  /// far as the band goes. Solids take the mean of what is beside them, so that the surface meets them at a
  /// right angle.
  void redistance(Velocity const& u, Loops const& loops) {
    CellGrid<N> const& grid = u.grid;
    Field const& now = value;
    // into next_, since the mean of one must not be that of another
    loops.cells(grid, FillSolids<Real, N>{grid, entries(u.cell), entries(now), entries(next_)});
    value.swap(next_);
    fillAround(grid, value, loops);
    loops.cells(grid, FixNearSurface<Real, N>{grid, entries(now), entries(next_), entries(fixed_), band});
    fillAround(grid, next_, loops);
    value.swap(next_);
    const int rounds = int(band) + 2;
    for (int round = 0; round < rounds; ++round) {
      loops.cells(
          grid,
          ExtendDistance<Real, N>{grid, entries(now), entries(next_), entries(std::as_const(fixed_)), band});
      fillAround(grid, next_, loops);
      value.swap(next_);
    }
  }

  /// The part of a cell in which fluid is, as of a plane surface along an axis.
  Real fraction(std::ptrdiff_t i) const {
    return std::clamp(Real(0.5) - value[std::size_t(i)], Real(0), Real(1));
  }
  /// The sum of the parts [cells], of cells of which solids leave this room; none is given where they leave
  /// it all.
  double volume(Velocity const& u, Real const* room, Loops const& loops) {
    return measure(u, room, loops, 0)[0];
  }

  /// Moves the whole surface outwards or inwards, by half a cell at most, until the volume is `wanted`
  /// [cells]. Returns by how much [cells].
  double keepVolume(Velocity const& u, Real const* room, double wanted, Loops const& loops) {
    double offset = 0;
    for (int k = 0; k < 8; ++k) {
      const auto [now, surface] = measure(u, room, loops, offset);
      const double missing = wanted - now;
      if (std::abs(missing) <= 1e-10 * wanted || !(surface > 0)) break;
      offset = std::clamp(offset + missing / surface, -0.5, 0.5);
    }
    if (offset != 0) {
      loops.cells(u.grid, MoveSurface<Real, N>{entries(value), Real(offset), band});
      fillAround(u.grid, value, loops);
    }
    return offset;
  }

  /// Values in the layer around are those next to it.
  static void fillAround(CellGrid<N> const& grid, Field& field, Loops const& loops = {}) {
    for (std::size_t axis = 0; axis < N; ++axis)
      loops.sides(grid, axis, true, FillFromInside<Real>{entries(field), grid.periodic[axis]});
  }

 private:
  Field next_{};
  AdvectionRoom<Real, Loops> room_{};
  typename Loops::template Array<std::uint8_t> fixed_{};
  typename Loops::Numbers numbers_{};

  // volume, and what it gains where the surface moves outwards by a cell, at an offset
  std::array<double, 2> measure(Velocity const& u, Real const* room, Loops const& loops, double offset) {
    PartOfCell<Real> part{entries(u.cell), entries(std::as_const(value)), room, offset, false};
    loops.sum(u.grid, numbers_, 0, part);
    part.crosses = true;
    loops.sum(u.grid, numbers_, 1, part);
    return numbers_.readTwo(0);
  }
};

}  // namespace sinew::fluid
