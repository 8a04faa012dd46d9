// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/fluid/cell_grid.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace sinew::fluid {

enum class CellKind : std::uint8_t { fluid, air, solid };
/// Of the faces of cells: pressure drives those beside a fluid cell, a solid on one side holds others, and
/// what is inside air or inside solids follows from those around it.
enum class FaceKind : std::uint8_t { fluid, wall, inside };

/// Velocity on a staggered grid (Harlow, Welch 1965): component c in the middle of the lower face of each
/// cell across axis c. Places are in cells from the lower corner of the grid on, velocities in m/s.
template <class Real, int N>
struct StaggeredVelocity {
  using Vector = Eigen::Matrix<Real, N, 1>;
  using Field = std::vector<Real>;

  CellGrid<N> grid{};
  bool slips = true;             // along solids; else it sticks to them
  std::vector<CellKind> cell{};  // solid, for the layer around, unless the axis is periodic
  Each<std::vector<FaceKind>, N> kind{};
  Each<Field, N> value{};
  Each<Field, N> solid{};  // velocities of the solids, at the faces that they have

  void init(CellGrid<N> const& g) {
    grid = g;
    cell.assign(grid.size, CellKind::solid);
    for (std::size_t c = 0; c < axes<N>; ++c) {
      kind[c].assign(grid.size, FaceKind::inside);
      value[c].assign(grid.size, Real(0));
      solid[c].assign(grid.size, Real(0));
      layer_[c].assign(grid.size, 0);
      for (auto& front : fronts_[c]) front.reserve(grid.size);
    }
  }

  /// Kinds of faces from those of cells.
  void classify(SomeWorkers workers) {
    grid.wrap(std::span<CellKind>(cell));
    for (std::size_t c = 0; c < axes<N>; ++c) {
      const std::ptrdiff_t s = grid.stride[c];
      grid.forCells(workers,
                    [&](std::ptrdiff_t i) { kind[c][at(i)] = kindBetween(cell[at(i - s)], cell[at(i)]); });
      grid.forSides(c, false, [&](std::ptrdiff_t outer, std::ptrdiff_t inner, std::ptrdiff_t, int side) {
        if (side == 1) kind[c][at(outer)] = kindBetween(cell[at(inner)], cell[at(outer)]);
      });
      grid.wrap(std::span<FaceKind>(kind[c]));
    }
  }
  /// Faces of solids move with them.
  void holdWalls(SomeWorkers workers) {
    for (std::size_t c = 0; c < axes<N>; ++c) {
      auto hold = [&](std::ptrdiff_t i) {
        if (kind[c][at(i)] == FaceKind::wall) value[c][at(i)] = solid[c][at(i)];
      };
      grid.forCells(workers, hold);
      grid.forSides(c, false, [&](std::ptrdiff_t outer, std::ptrdiff_t, std::ptrdiff_t, int side) {
        if (side == 1) hold(outer);
      });
    }
  }

  /// Values of component c in the layer around: behind walls such that the velocity at the wall, in the
  /// middle between two faces, is that of the wall, or has no gradient.
  void fillAround(std::size_t c, Field& field) const {
    for (std::size_t axis = 0; axis < N; ++axis) {
      if (grid.periodic[axis]) {
        grid.forSides(axis, true, [&](std::ptrdiff_t outer, std::ptrdiff_t, std::ptrdiff_t other, int) {
          field[at(outer)] = field[at(other)];
        });
      } else if (axis == c) {
        grid.forSides(axis, true, [&](std::ptrdiff_t outer, std::ptrdiff_t inner, std::ptrdiff_t, int side) {
          const std::ptrdiff_t face = side == 0 ? inner : outer;
          field[at(face)] = solid[c][at(face)];
        });
      } else {
        grid.forSides(axis, true, [&](std::ptrdiff_t outer, std::ptrdiff_t inner, std::ptrdiff_t, int) {
          field[at(outer)] = slips ? field[at(inner)] : 2 * solid[c][at(outer)] - field[at(inner)];
        });
      }
    }
  }

  /// Velocities of faces inside air and solids, so many layers of them, as means of those next to them that
  /// are known (Bridson 2015, section 4.1): constant, by and by, along the way out of the fluid; zero behind
  /// the last layer.
  void extrapolate(int layers, SomeWorkers workers) {
    auto component = [&](std::size_t c) { extrapolate(c, layers); };
    if (grid.inner() < 4096)
      for (std::size_t c = 0; c < axes<N>; ++c) component(c);
    else
      workers.run([&](WorkShare share) {
        for (std::size_t c = share.begin(axes<N>); c < share.end(axes<N>); ++c) component(c);
      });
  }

  /// The fastest of all components [m/s]; not finite where one of them is not.
  double fastest(SomeWorkers workers, std::span<double> rows) const {
    double most = 0;
    for (std::size_t c = 0; c < axes<N>; ++c) {
      grid.forRows(workers, [&](std::size_t row, std::ptrdiff_t first) {
        double rowMost = 0;
        for (std::ptrdiff_t i = first; i < first + grid.cells[0]; ++i) {
          const double u = std::abs(double(value[c][at(i)]));
          if (!(u <= rowMost)) rowMost = u;
          if (!std::isfinite(u)) break;
        }
        rows[row] = rowMost;
      });
      for (std::size_t row = 0; row < grid.rows(); ++row)
        if (!(rows[row] <= most)) {
          most = rows[row];
          if (!std::isfinite(most)) return most;
        }
    }
    return most;
  }

  /// The value of a field at a place, multilinear. Its cells have theirs in their centres, or in the middle
  /// of their lower faces across axis c (-1: none). `low` and `high` take the least and largest of the values
  /// around.
  template <bool Bounds = false>
  SINEW_INLINE Real interpolate(Real const* field, int c, Vector const& x, Real* low = nullptr,
                                Real* high = nullptr) const {
    auto along = [&](int d) { return Along(x[d] + (d == c ? Real(1) : Real(0.5)), grid, d); };
    const Along i = along(0), j = along(1);
    if constexpr (N == 2) {
      return face<Bounds>(field + i.base + j.base, i.fraction, j.fraction, low, high);
    } else {
      const Along k = along(2);
      return between<Bounds>(field + i.base + j.base + k.base, i.fraction, j.fraction, k.fraction, low, high);
    }
  }
  SINEW_INLINE Vector velocity(Vector const& x) const {
    const Along fi(x[0] + 1, grid, 0), i(x[0] + Real(0.5), grid, 0), fj(x[1] + 1, grid, 1),
        j(x[1] + Real(0.5), grid, 1);
    if constexpr (N == 2) {
      return {face(value[0].data() + fi.base + j.base, fi.fraction, j.fraction),
              face(value[1].data() + i.base + fj.base, i.fraction, fj.fraction)};
    } else {
      const Along fk(x[2] + 1, grid, 2), k(x[2] + Real(0.5), grid, 2);
      return {between(value[0].data() + fi.base + j.base + k.base, fi.fraction, j.fraction, k.fraction),
              between(value[1].data() + i.base + fj.base + k.base, i.fraction, fj.fraction, k.fraction),
              between(value[2].data() + i.base + j.base + fk.base, i.fraction, j.fraction, fk.fraction)};
    }
  }
  /// A place brought back into the grid: to the other end along periodic axes, onto the walls along others.
  SINEW_INLINE Vector inside(Vector x) const {
    for (int d = 0; d < N; ++d) {
      const Real n = Real(grid.cells[std::size_t(d)]);
      if (grid.periodic[std::size_t(d)]) x[d] -= std::floor(x[d] / n) * n;
      x[d] = std::min(n, std::max(Real(0), x[d]));
    }
    return x;
  }
  /// Where what is at x has come from, a step ago in units of cells per velocity, by the midpoint rule; u is
  /// the velocity at x.
  Vector trace(Vector const& x, Vector const& u, Real step) const {
    return inside(x - step * velocity(inside(x - step / 2 * u)));
  }
  /// The velocity in the middle of a face of axis c, or in the centre of a cell (-1).
  SINEW_INLINE Vector velocityAt(int c, std::ptrdiff_t i) const {
    Vector u;
    for (int d = 0; d < N; ++d) {
      Real const* field = value[std::size_t(d)].data();
      const std::ptrdiff_t s = grid.stride[std::size_t(d)];
      if (d == c) {
        u[d] = field[i];
      } else if (c < 0) {
        u[d] = (field[i] + field[i + s]) / 2;
      } else {
        const std::ptrdiff_t t = grid.stride[std::size_t(c)];
        u[d] = (field[i] + field[i + s] + field[i - t] + field[i - t + s]) / 4;
      }
    }
    return u;
  }

  /// f(neighbour) of the inner cell i, across the ends of periodic axes
  template <class F>
  void forNeighbours(std::ptrdiff_t i, F&& f) const {
    std::ptrdiff_t rest = i;
    for (std::size_t d = axes<N>; d-- > 0;) {
      const std::ptrdiff_t s = grid.stride[d], n = grid.cells[d], k = rest / s;
      rest %= s;
      if (k > 1)
        f(i - s);
      else if (grid.periodic[d])
        f(i + (n - 1) * s);
      if (k < n)
        f(i + s);
      else if (grid.periodic[d])
        f(i - (n - 1) * s);
    }
  }

 private:
  Each<std::vector<std::uint8_t>, N> layer_{};
  Each<std::array<std::vector<int>, 2>, N> fronts_{};

  static std::size_t at(std::ptrdiff_t i) { return std::size_t(i); }
  // between which two values along an axis a place is
  struct Along {
    std::ptrdiff_t base;
    Real fraction;
    SINEW_INLINE Along(Real place, CellGrid<N> const& grid, int d) {
      const int first = std::min(int(place), grid.cells[std::size_t(d)]);
      base = first * grid.stride[std::size_t(d)];
      fraction = place - Real(first);
    }
  };
  // linear between the values at an edge, of a square, and of a cube
  template <bool Bounds = false>
  SINEW_INLINE static Real edge(Real const* at, Real x, Real* low = nullptr, Real* high = nullptr) {
    const Real a = at[0], b = at[1];
    if constexpr (Bounds) {
      *low = std::min(*low, std::min(a, b));
      *high = std::max(*high, std::max(a, b));
    }
    return a + x * (b - a);
  }
  template <bool Bounds = false>
  SINEW_INLINE Real face(Real const* at, Real x, Real y, Real* low = nullptr, Real* high = nullptr) const {
    const Real a = edge<Bounds>(at, x, low, high), b = edge<Bounds>(at + grid.stride[1], x, low, high);
    return a + y * (b - a);
  }
  template <bool Bounds = false>
  SINEW_INLINE Real between(Real const* at, Real x, Real y, Real z, Real* low = nullptr,
                            Real* high = nullptr) const {
    const Real a = face<Bounds>(at, x, y, low, high), b = face<Bounds>(at + grid.stride[2], x, y, low, high);
    return a + z * (b - a);
  }
  static FaceKind kindBetween(CellKind a, CellKind b) {
    if (a == CellKind::solid || b == CellKind::solid) return a == b ? FaceKind::inside : FaceKind::wall;
    return a == CellKind::fluid || b == CellKind::fluid ? FaceKind::fluid : FaceKind::inside;
  }

  void extrapolate(std::size_t c, int layers) {
    constexpr std::uint8_t unknown = 255;
    auto& layer = layer_[c];
    auto& field = value[c];
    bool some = false;
    const std::ptrdiff_t s = grid.stride[c];
    grid.forRows(WorkShare{}, [&](std::size_t, std::ptrdiff_t first) {
      for (std::ptrdiff_t i = first; i < first + grid.cells[0]; ++i) {
        const bool known = kind[c][at(i)] != FaceKind::inside;
        layer[at(i)] = known ? 0 : unknown;
        if (!known) field[at(i)] = 0, some = true;
      }
    });
    if (some) {
      std::vector<int>*front = &fronts_[c][0], *next = &fronts_[c][1];
      front->clear();
      grid.forRows(WorkShare{}, [&](std::size_t, std::ptrdiff_t first) {
        for (std::ptrdiff_t i = first; i < first + grid.cells[0]; ++i) {
          if (layer[at(i)] != unknown) continue;
          bool beside = false;
          forNeighbours(i, [&](std::ptrdiff_t j) { beside = beside || layer[at(j)] == 0; });
          if (beside) front->push_back(int(i));
        }
      });
      for (const int i : *front) layer[std::size_t(i)] = 1;
      for (int l = 1; l <= layers && !front->empty(); ++l) {
        next->clear();
        for (const int i : *front) {
          Real sum = 0;
          int count = 0;
          forNeighbours(i, [&](std::ptrdiff_t j) {
            if (layer[at(j)] < l) sum += field[at(j)], ++count;
          });
          field[std::size_t(i)] = sum / Real(count);
        }
        if (l == layers) break;
        for (const int i : *front)
          forNeighbours(i, [&](std::ptrdiff_t j) {
            if (layer[at(j)] != unknown) return;
            layer[at(j)] = std::uint8_t(l + 1);
            next->push_back(int(j));
          });
        std::swap(front, next);
      }
      if (!slips) {  // what is inside a solid mirrors what is outside
        grid.forRows(WorkShare{}, [&](std::size_t, std::ptrdiff_t first) {
          for (std::ptrdiff_t i = first; i < first + grid.cells[0]; ++i)
            if (layer[at(i)] == 1 && cell[at(i)] == CellKind::solid && cell[at(i - s)] == CellKind::solid)
              field[at(i)] = 2 * solid[c][at(i)] - field[at(i)];
        });
      }
    }
    fillAround(c, field);
  }
};

}  // namespace sinew::fluid
