// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/fluid/multigrid_loops.hpp>
#include <sinew/fluid/velocity_view.hpp>

namespace sinew::fluid {

/// What loops read of a GridFluid, where they run.
template <class Real, int N>
struct FluidView {
  using Vector = Eigen::Matrix<double, N, 1>;

  VelocityView<Real, N> u;
  Real const* distance;       // from the surface; none: fluid is everywhere
  Each<Real const*, N> open;  // parts of faces, and of cells, outside solids; none: these cut no cell
  Real const* room;
  Vector corner;
  double width;

  SINEW_INLINE Vector centre(Each<int, N> const& at) const {
    Vector x;
    for (int c = 0; c < N; ++c) x[c] = corner[c] + (double(at[std::size_t(c)]) - 0.5) * width;
    return x;
  }
  SINEW_INLINE double filled(std::ptrdiff_t i) const {
    if (!distance) return 1.0;
    const Real part = Real(0.5) - distance[i];
    return double(part < Real(0) ? Real(0) : (Real(1) < part ? Real(1) : part));
  }
  SINEW_INLINE double roomOf(std::ptrdiff_t i) const { return room ? double(room[i]) : 1.0; }
  SINEW_INLINE double part(std::ptrdiff_t i) const { return filled(i) * roomOf(i); }
  /// Of the fluid in a cell, for one that is cut as by a plane across an axis [m].
  SINEW_INLINE Vector middle(std::ptrdiff_t i) const {
    Vector x = centre(u.grid.placeOf(i));
    const double full = filled(i);
    if (full <= 0 || full >= 1) return x;
    Vector slope;
    for (int c = 0; c < N; ++c) {
      const std::ptrdiff_t s = u.grid.stride[std::size_t(c)];
      slope[c] = double(distance[i + s] - distance[i - s]);
    }
    const double norm = slope.norm();
    if (norm > 0) x -= slope / norm * ((1 - full) / 2 * width);
    return x;
  }
  /// How far from a fluid cell the surface is towards an air cell.
  SINEW_INLINE Real toSurface(std::ptrdiff_t fluidCell, std::ptrdiff_t airCell) const {
    const Real a = distance[fluidCell], b = distance[airCell], part = a / (a - b);
    return part < Real(0.01) ? Real(0.01) : (Real(1) < part ? Real(1) : part);
  }
  SINEW_INLINE Real openPart(std::size_t c, std::ptrdiff_t i) const { return room ? open[c][i] : Real(1); }
  /// Through a face, of the fluid and of the solid in it.
  SINEW_INLINE Real flow(std::size_t c, std::ptrdiff_t i) const {
    const Real v = u.value[c][i];
    return room ? open[c][i] * v + (1 - open[c][i]) * u.solid[c][i] : v;
  }
  SINEW_INLINE Real outflow(std::ptrdiff_t i) const {
    Real sum = 0;
    for (std::size_t c = 0; c < axes<N>; ++c) sum += flow(c, i + u.grid.stride[c]) - flow(c, i);
    return sum;
  }
};

// Bodies of the loops of GridFluid.

/// Cells behind the surface have air, others but solids fluid.
template <class Real, int N>
struct ClassifyCells {
  Real const* distance;
  CellKind* cell;
  SINEW_INLINE void operator()(Each<int, N> const&, std::ptrdiff_t i) const {
    if (cell[i] != CellKind::solid) cell[i] = distance[i] < 0 ? CellKind::fluid : CellKind::air;
  }
};
/// Where an obstacle leaves room, fluid is.
template <int N>
struct FreeCells {
  std::uint8_t const* obstacle;
  CellKind* cell;
  SINEW_INLINE void operator()(Each<int, N> const&, std::ptrdiff_t i) const {
    if (!obstacle[i]) cell[i] = CellKind::fluid;
  }
};

/// Faces that the fluid carries along.
struct IsOfFluid {
  FaceKind const* kind;
  SINEW_INLINE bool operator()(std::ptrdiff_t i) const { return kind[i] == FaceKind::fluid; }
};

/// Fluid where distance(centre) < 0 [m], with a velocity.
template <class Real, int N, class Distance>
struct Pour {
  FluidView<Real, N> of;
  Distance distance;
  typename FluidView<Real, N>::Vector speed;
  Real far;
  Real* surface;
  Each<Real*, N> value;

  SINEW_INLINE void operator()(Each<int, N> const& at, std::ptrdiff_t i) const {
    if (of.u.cell[i] == CellKind::solid) return;
    const Real d = Real(distance(of.centre(at)) / of.width);
    surface[i] = std::min(surface[i], std::max(d, -far));
    if (d < Real(0.5))
      for (std::size_t c = 0; c < axes<N>; ++c)
        value[c][i] = value[c][i + of.u.grid.stride[c]] = Real(speed[int(c)]);
  }
};
/// [m]
template <int N>
struct BallDistance {
  Eigen::Matrix<double, N, 1> centre;
  double radius;
  SINEW_INLINE double operator()(Eigen::Matrix<double, N, 1> const& x) const {
    return (x - centre).norm() - radius;
  }
};

template <class Real, int N>
struct Accelerate {
  FaceKind const* kind;
  Real* value;
  Real gain;
  SINEW_INLINE void operator()(Each<int, N> const&, std::ptrdiff_t i) const {
    if (kind[i] == FaceKind::fluid) value[i] += gain;
  }
};

/// The equations of pressure of a cell.
template <class Real, int N>
struct PressureEquation {
  FluidView<Real, N> of;
  LevelView<Real, N> level;

  SINEW_INLINE void operator()(Each<int, N> const&, std::ptrdiff_t i) const {
    CellKind const* cell = of.u.cell;
    const CellKind here = cell[i];
    level.open[i] = here != CellKind::solid;
    Real surface = 0;
    const bool fluid = here == CellKind::fluid;
    for (std::size_t c = 0; c < axes<N>; ++c) {
      const std::ptrdiff_t s = of.u.grid.stride[c];
      level.face[c][i] = fluid && cell[i - s] == CellKind::fluid ? of.openPart(c, i) : Real(0);
      if (fluid)
        for (int side = 0; side < 2; ++side) {
          const std::ptrdiff_t j = side == 0 ? i - s : i + s;
          if (cell[j] == CellKind::air) surface += of.openPart(c, side == 0 ? i : j) / of.toSurface(i, j);
        }
    }
    level.surface[i] = surface;
  }
};
/// Their right side, and the pressure of the last step as if it had been as long.
template <class Real, int N>
struct PressureStart {
  FluidView<Real, N> of;
  Real const* inverse;
  Real* b;
  Real* pressure;
  bool scales;
  Real factor;

  SINEW_INLINE void operator()(Each<int, N> const&, std::ptrdiff_t i) const {
    const bool fluid = of.u.cell[i] == CellKind::fluid;
    b[i] = fluid && inverse[i] > 0 ? -of.outflow(i) : Real(0);
    if (!fluid)
      pressure[i] = 0;
    else if (scales)
      pressure[i] *= factor;
  }
};
template <class Real>
struct ValueOf {
  Real const* a;
  SINEW_INLINE double operator()(std::ptrdiff_t i) const { return double(a[i]); }
};
template <class Real>
struct IsPositive {
  Real const* a;
  SINEW_INLINE double operator()(std::ptrdiff_t i) const { return a[i] > 0 ? 1.0 : 0.0; }
};
/// b -= sum / count, where something is to be found.
template <class Real, int N>
struct TakeMean {
  struct Known {
    Real const* inverse;
    Real* b;
    Real mean;
    SINEW_INLINE void operator()(Each<int, N> const&, std::ptrdiff_t i) const {
      if (inverse[i] > 0) b[i] -= mean;
    }
  };
  Real const* inverse;
  Real* b;
  double const *sum, *count;
  SINEW_INLINE Known ofThread() const { return {inverse, b, *count > 0 ? Real(*sum / *count) : Real(0)}; }
};
/// Velocities of the faces across an axis without the gradient of pressure.
template <class Real, int N>
struct TakeGradient {
  FluidView<Real, N> of;
  std::size_t axis;
  Real const* pressure;
  Real* value;

  SINEW_INLINE void operator()(Each<int, N> const&, std::ptrdiff_t i) const {
    if (of.u.kind[axis][i] != FaceKind::fluid) return;
    const std::ptrdiff_t s = of.u.grid.stride[axis];
    const bool below = of.u.cell[i - s] == CellKind::fluid, here = of.u.cell[i] == CellKind::fluid;
    Real slope = 0;
    if (below && here)
      slope = pressure[i] - pressure[i - s];
    else if (here)
      slope = pressure[i] / of.toSurface(i, i - s);
    else
      slope = -pressure[i - s] / of.toSurface(i - s, i);
    value[i] -= slope;
  }
};

// terms of sums over a fluid

template <class Real, int N>
struct RoomOfFluid {
  FluidView<Real, N> of;
  SINEW_INLINE double operator()(std::ptrdiff_t i) const {
    return of.u.cell[i] == CellKind::fluid ? of.roomOf(i) : 0.0;
  }
};
/// Half the square of the velocity.
template <class Real, int N>
struct KineticPart {
  FluidView<Real, N> of;
  SINEW_INLINE double operator()(std::ptrdiff_t i) const {
    if (of.u.cell[i] != CellKind::fluid) return 0.0;
    double squares = 0;
    for (std::size_t c = 0; c < axes<N>; ++c) {
      const double a = double(of.u.value[c][i]), b = double(of.u.value[c][i + of.u.grid.stride[c]]);
      squares += (a * a + b * b) / 2;
    }
    return of.part(i) * squares / 2;
  }
};
template <class Real, int N>
struct HeightPart {
  FluidView<Real, N> of;
  typename FluidView<Real, N>::Vector gravity;
  SINEW_INLINE double operator()(std::ptrdiff_t i) const {
    if (of.u.cell[i] == CellKind::solid) return 0.0;
    return of.part(i) * gravity.dot(of.middle(i));
  }
};
template <class Real, int N>
struct Outflow {
  FluidView<Real, N> of;
  SINEW_INLINE double operator()(std::ptrdiff_t i) const {
    return of.u.cell[i] == CellKind::fluid ? std::abs(double(of.outflow(i))) : 0.0;
  }
};

}  // namespace sinew::fluid
