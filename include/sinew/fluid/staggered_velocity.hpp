// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/point_loop.hpp>
#include <sinew/fluid/face_loops.hpp>
#include <sinew/fluid/grid_loops.hpp>

#include <vector>

namespace sinew::fluid {

/// Velocity on a staggered grid (Harlow, Welch 1965): component c in the middle of the lower face of each
/// cell across axis c. Places are in cells from the lower corner of the grid on, velocities in m/s.
template <class Real, int N, class Loops = HostLoops>
struct StaggeredVelocity {
  using Vector = Eigen::Matrix<Real, N, 1>;
  template <class T>
  using Array = typename Loops::template Array<T>;
  using Field = Array<Real>;

  CellGrid<N> grid{};
  bool slips = true;       // along solids; else it sticks to them
  Array<CellKind> cell{};  // solid, for the layer around, unless the axis is periodic
  Each<Array<FaceKind>, N> kind{};
  Each<Field, N> value{};
  Each<Field, N> solid{};  // velocities of the solids, at the faces that they have

  void init(CellGrid<N> const& g) {
    grid = g;
    Loops::assign(cell, grid.size, CellKind::solid);
    for (std::size_t c = 0; c < axes<N>; ++c) {
      Loops::assign(kind[c], grid.size, FaceKind::inside);
      Loops::assign(value[c], grid.size, Real(0));
      Loops::assign(solid[c], grid.size, Real(0));
      Loops::assign(layer_[c], grid.size, std::uint8_t(0));
      if constexpr (Loops::onHost)
        for (auto& front : fronts_[c]) front.reserve(grid.size);
    }
  }

  VelocityView<Real, N> view() const {
    VelocityView<Real, N> v{grid, slips, entries(cell), {}, {}, {}};
    for (std::size_t c = 0; c < axes<N>; ++c) {
      v.kind[c] = entries(kind[c]);
      v.value[c] = entries(value[c]);
      v.solid[c] = entries(solid[c]);
    }
    return v;
  }

  /// Kinds of faces from those of cells.
  void classify(Loops const& loops) {
    loops.wrap(grid, entries(cell));
    for (std::size_t c = 0; c < axes<N>; ++c) {
      const ClassifyFaces<N> body{entries(std::as_const(cell)), entries(kind[c]), grid.stride[c]};
      loops.cells(grid, body);
      loops.sides(grid, c, false, body);
      loops.wrap(grid, body.kind);
    }
  }
  /// Faces of solids move with them.
  void holdWalls(Loops const& loops) {
    for (std::size_t c = 0; c < axes<N>; ++c) {
      const HoldWalls<Real, N> body{
          entries(std::as_const(kind[c])), entries(std::as_const(solid[c])), entries(value[c])};
      loops.cells(grid, body);
      loops.sides(grid, c, false, body);
    }
  }

  /// Values of component c in the layer around: behind walls such that the velocity at the wall, in the
  /// middle between two faces, is that of the wall, or has no gradient.
  void fillAround(std::size_t c, Field& field, Loops const& loops) const {
    for (std::size_t axis = 0; axis < N; ++axis)
      loops.sides(grid,
                  axis,
                  true,
                  FillFaces<Real>{entries(field), entries(solid[c]), grid.periodic[axis], axis == c, slips});
  }

  /// Velocities of faces inside air and solids, so many layers of them, as means of those next to them that
  /// are known (Bridson 2015, section 4.1): constant, by and by, along the way out of the fluid; zero behind
  /// the last layer.
  void extrapolate(int layers, Loops const& loops) {
    if constexpr (Loops::onHost) {
      auto component = [&](std::size_t c) { extrapolate(c, layers); };
      if (grid.inner() < 4096)
        for (std::size_t c = 0; c < axes<N>; ++c) component(c);
      else
        loops.workers().run([&](WorkShare share) {
          for (std::size_t c = share.begin(axes<N>); c < share.end(axes<N>); ++c) component(c);
        });
    } else {
      for (std::size_t c = 0; c < axes<N>; ++c) {
        auto outward = outwardMeans(c);
        loops.cells(grid, KnownFaces<Real, N>{outward, entries(std::as_const(kind[c]))});
        for (outward.number = 1; outward.number <= layers; ++outward.number) loops.cells(grid, outward);
        if (!slips) loops.cells(grid, mirrored(c, outward));
      }
    }
    for (std::size_t c = 0; c < axes<N>; ++c) fillAround(c, value[c], loops);
  }

  /// The fastest of all components [m/s]; not finite where one of them is not.
  double fastest(Loops const& loops, typename Loops::Numbers& numbers) const {
    double most = 0;
    for (std::size_t c = 0; c < axes<N>; ++c) {
      const double u = loops.most(grid, numbers, Speed<Real>{entries(value[c])});
      if (!(u <= most)) most = u;
      if (!std::isfinite(most)) return most;
    }
    return most;
  }

 private:
  Each<Array<std::uint8_t>, N> layer_{};
  Each<std::array<std::vector<int>, 2>, N> fronts_{};

  static std::size_t at(std::ptrdiff_t i) { return std::size_t(i); }
  OutwardMeans<Real, N> outwardMeans(std::size_t c) {
    return {grid, entries(value[c]), entries(layer_[c]), 0};
  }
  MirrorInSolids<Real, N> mirrored(std::size_t c, OutwardMeans<Real, N> const& outward) const {
    return {outward, entries(cell), entries(solid[c]), grid.stride[c]};
  }

  // from front to front, so that a layer costs what it has
  void extrapolate(std::size_t c, int layers) {
    const OutwardMeans<Real, N> outward = outwardMeans(c);
    constexpr std::uint8_t unknown = OutwardMeans<Real, N>::unknown;
    auto& layer = layer_[c];
    const KnownFaces<Real, N> known{outward, kind[c].data()};
    bool some = false;
    auto forCells = [&](auto&& f) {
      grid.forRows(WorkShare{}, [&](std::size_t, std::ptrdiff_t first) {
        for (std::ptrdiff_t i = first; i < first + grid.cells[0]; ++i) f(i);
      });
    };
    forCells([&](std::ptrdiff_t i) {
      known({}, i);
      some = some || layer[at(i)] == unknown;
    });
    if (!some) return;
    std::vector<int>*front = &fronts_[c][0], *next = &fronts_[c][1];
    front->clear();
    forCells([&](std::ptrdiff_t i) {
      if (layer[at(i)] != unknown) return;
      bool beside = false;
      grid.forNeighbours(i, [&](std::ptrdiff_t j) { beside = beside || layer[at(j)] == 0; });
      if (beside) front->push_back(int(i));
    });
    for (const int i : *front) layer[std::size_t(i)] = 1;
    for (int l = 1; l <= layers && !front->empty(); ++l) {
      next->clear();
      for (const int i : *front) outward.take(grid.placeOf(i), i, l);
      if (l == layers) break;
      for (const int i : *front)
        grid.forNeighbours(i, [&](std::ptrdiff_t j) {
          if (layer[at(j)] != unknown) return;
          layer[at(j)] = std::uint8_t(l + 1);
          next->push_back(int(j));
        });
      std::swap(front, next);
    }
    if (!slips) {
      const MirrorInSolids<Real, N> mirror = mirrored(c, outward);
      forCells([&](std::ptrdiff_t i) { mirror({}, i); });
    }
  }
};

}  // namespace sinew::fluid
