// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/mesh.hpp>
#include <sinew/fluid/advection.hpp>

namespace sinew::fluid {

/// A free surface as the zero of a signed distance in the centres of cells, negative in the fluid, in cells
/// (Osher, Sethian 1988).
template <class Real, int N>
class LevelSet {
 public:
  std::vector<Real> value{};
  /// Distances farther than that are not kept.
  Real band = 5;

  void init(CellGrid<N> const& grid, Real far) {
    band = far;
    value.assign(grid.size, -band);
    next_ = value;
    room_.init(grid.size);
    fixed_.assign(grid.size, 0);
    sums_.assign(grid.rows(), 0.0);
  }

  /// Is carried along by the velocity for a step [cells per m/s].
  void advect(StaggeredVelocity<Real, N> const& u, Real step, Advection method, SomeWorkers workers) {
    fluid::advect(
        u,
        -1,
        value,
        next_,
        step,
        method,
        room_,
        workers,
        [&](std::ptrdiff_t i) {
          return std::abs(value[std::size_t(i)]) < band && u.cell[std::size_t(i)] != CellKind::solid;
        },
        [&](std::vector<Real>& field) { fillAround(u.grid, field); });
    value.swap(next_);
  }

  /// Makes it a distance again without moving its zero: next to the surface by the slope there (Russo,
  /// Smereka 2000), from there on by the upwind equation |grad d| = 1 (Rouy, Tourin 1992), cell by cell as
  /// far as the band goes. Solids take the mean of what is beside them, so that the surface meets them at a
  /// right angle.
  void redistance(StaggeredVelocity<Real, N> const& u, SomeWorkers workers) {
    CellGrid<N> const& grid = u.grid;
    fillSolids(u, workers);
    fillAround(grid, value);
    grid.forCells(workers, [&](std::ptrdiff_t i) {
      const Real here = value[at(i)];
      bool beside = false;
      Real slope = 0;
      for (std::size_t c = 0; c < axes<N>; ++c) {
        const Real below = value[at(i - grid.stride[c])], above = value[at(i + grid.stride[c])];
        beside = beside || inFluid(below) != inFluid(here) || inFluid(above) != inFluid(here);
        const Real most =
            std::max(std::max(std::abs(here - below), std::abs(above - here)), std::abs(above - below) / 2);
        slope += most * most;
      }
      fixed_[at(i)] = beside;
      // a slope of about 1 is let be, since each correction roughens the surface a little
      const Real correction =
          slope > Real(0.25) && slope < 4 ? Real(1) : 1 / std::sqrt(std::max(slope, Real(1e-12)));
      next_[at(i)] = beside ? here * correction : (inFluid(here) ? -band : band);
    });
    fillAround(grid, next_);
    value.swap(next_);
    const int rounds = int(band) + 2;
    for (int round = 0; round < rounds; ++round) {
      grid.forCells(workers, [&](std::ptrdiff_t i) {
        const Real here = value[at(i)];
        if (fixed_[at(i)]) {
          next_[at(i)] = here;
          return;
        }
        Each<Real, N> nearest;
        Real least = band;
        for (std::size_t c = 0; c < axes<N>; ++c) {
          nearest[c] =
              std::min(std::abs(value[at(i - grid.stride[c])]), std::abs(value[at(i + grid.stride[c])]));
          least = std::min(least, nearest[c]);
        }
        const Real far = std::abs(here);
        const Real distance = least < band - 1 || far < band ? std::min(far, upwind(nearest)) : far;
        next_[at(i)] = std::copysign(std::min(distance, band), here);
      });
      fillAround(grid, next_);
      value.swap(next_);
    }
  }

  /// The part of a cell in which fluid is, as of a plane surface along an axis.
  Real fraction(std::ptrdiff_t i) const { return std::clamp(Real(0.5) - value[at(i)], Real(0), Real(1)); }
  /// The sum of the parts [cells], of cells of which solids leave this room; none is given where they leave
  /// it all.
  double volume(StaggeredVelocity<Real, N> const& u, std::span<Real const> room, SomeWorkers workers) {
    return measure(u, room, workers, 0)[0];
  }

  /// Moves the whole surface outwards or inwards, by half a cell at most, until the volume is `wanted`
  /// [cells]. Returns by how much [cells].
  double keepVolume(StaggeredVelocity<Real, N> const& u, std::span<Real const> room, double wanted,
                    SomeWorkers workers) {
    double offset = 0;
    for (int k = 0; k < 8; ++k) {
      const auto [now, surface] = measure(u, room, workers, offset);
      const double missing = wanted - now;
      if (std::abs(missing) <= 1e-10 * wanted || !(surface > 0)) break;
      offset = std::clamp(offset + missing / surface, -0.5, 0.5);
    }
    if (offset != 0) {
      u.grid.forCells(workers, [&](std::ptrdiff_t i) {
        value[at(i)] = std::clamp(value[at(i)] - Real(offset), -band, band);
      });
      fillAround(u.grid, value);
    }
    return offset;
  }

  /// Values in the layer around are those next to it.
  static void fillAround(CellGrid<N> const& grid, std::vector<Real>& field) {
    for (std::size_t axis = 0; axis < N; ++axis)
      grid.forSides(axis, true, [&](std::ptrdiff_t outer, std::ptrdiff_t inner, std::ptrdiff_t other, int) {
        field[at(outer)] = field[at(grid.periodic[axis] ? other : inner)];
      });
  }
  static bool inFluid(Real distance) { return distance < 0; }

 private:
  std::vector<Real> next_{};
  AdvectionRoom<Real> room_{};
  std::vector<std::uint8_t> fixed_{};
  std::vector<double> sums_{};

  static std::size_t at(std::ptrdiff_t i) { return std::size_t(i); }

  // d of sum over axes of max(d - nearest, 0)^2 = 1
  static Real upwind(Each<Real, N> a) {
    std::sort(a.begin(), a.end());
    Real d = a[0] + 1;
    if (d <= a[1]) return d;
    Real sum = a[0] + a[1], product = a[0] - a[1];
    d = (sum + std::sqrt(std::max(Real(0), 2 - product * product))) / 2;
    if constexpr (N == 3) {
      if (d <= a[2]) return d;
      sum += a[2];
      const Real squares = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
      d = (sum + std::sqrt(std::max(Real(0), sum * sum - 3 * (squares - 1)))) / 3;
    }
    return d;
  }
  // into next_, since the mean of one must not be that of another
  void fillSolids(StaggeredVelocity<Real, N> const& u, SomeWorkers workers) {
    CellGrid<N> const& grid = u.grid;
    grid.forCells(workers, [&](std::ptrdiff_t i) {
      next_[at(i)] = value[at(i)];
      if (u.cell[at(i)] != CellKind::solid) return;
      Real sum = 0;
      int count = 0;
      for (std::size_t c = 0; c < axes<N>; ++c)
        for (const std::ptrdiff_t j : {i - grid.stride[c], i + grid.stride[c]})
          if (u.cell[at(j)] != CellKind::solid) sum += value[at(j)], ++count;
      if (count > 0) next_[at(i)] = sum / Real(count);
    });
    value.swap(next_);
  }
  // volume, and what it gains where the surface moves outwards by a cell, at an offset
  std::array<double, 2> measure(StaggeredVelocity<Real, N> const& u, std::span<Real const> room,
                                SomeWorkers workers, double offset) {
    auto sum = [&](auto&& f) {
      return u.grid.sum(workers, sums_, [&](std::ptrdiff_t i) {
        if (u.cell[at(i)] == CellKind::solid) return 0.0;
        return (room.empty() ? 1.0 : double(room[at(i)])) * f(0.5 - double(value[at(i)]) + offset);
      });
    };
    return {sum([](double part) { return std::clamp(part, 0.0, 1.0); }),
            sum([](double part) { return part > 0 && part < 1 ? 1.0 : 0.0; })};
  }
};

}  // namespace sinew::fluid
