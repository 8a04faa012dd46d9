// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/mesh.hpp>
#include <sinew/fluid/staggered_velocity.hpp>

namespace sinew::fluid {

/// f(index, place) for all cells, of the layer around, too.
template <int N, class F>
void for_all_cells(CellGrid<N> const& grid, F&& f) {
  Each<int, N> place{};
  for (std::size_t i = 0; i < grid.size; ++i) {
    f(std::ptrdiff_t(i), place);
    for (std::size_t c = 0; c < axes<N>; ++c) {
      if (++place[c] < grid.cells[c] + 2) break;
      place[c] = 0;
    }
  }
}

/// The border of the fluid: in space quads around it, in the plane edges (dual contours: Gibson 1998), with
/// walls where it meets them. Points are the means of where the edges between centres of cells cross the
/// surface.
template <class Fluid>
Mesh border_of(Fluid const& fluid) {
  constexpr int N = Fluid::dimension;
  using Vector = Eigen::Matrix<double, N, 1>;
  auto at = [](std::ptrdiff_t i) { return std::size_t(i); };
  auto const& grid = fluid.grid();
  Mesh mesh;
  auto inside = [&](std::ptrdiff_t i) { return fluid.velocity.cell[at(i)] == CellKind::fluid; };
  // the square or cube between the centres of a cell and those above it has the number of that cell
  std::vector<Index> vertex(grid.size, -1);
  std::array<std::ptrdiff_t, std::size_t(1) << N> corners{};
  for (std::size_t k = 0; k < corners.size(); ++k) {
    corners[k] = 0;
    for (std::size_t c = 0; c < axes<N>; ++c)
      if (k >> c & 1) corners[k] += grid.stride[c];
  }
  for_all_cells(grid, [&](std::ptrdiff_t i, Each<int, N> const& place) {
    for (std::size_t c = 0; c < axes<N>; ++c)
      if (place[c] > grid.cells[c]) return;
    Vector sum = Vector::Zero();
    Each<bool, N> atWall{};
    int crossings = 0;
    for (std::size_t k = 0; k < corners.size(); ++k)
      for (int c = 0; c < N; ++c) {
        if (k >> c & 1) continue;
        const std::ptrdiff_t a = i + corners[k], b = a + grid.stride[std::size_t(c)];
        if (inside(a) == inside(b)) continue;
        Vector x = Vector::Zero();
        for (int d = 0; d < N; ++d) x[d] = double(k >> d & 1);
        x[c] = fluid.crossing(a, b);
        if (fluid.isSolid(a) || fluid.isSolid(b)) atWall[std::size_t(c)] = true;
        sum += x;
        ++crossings;
      }
    if (crossings == 0) return;
    vertex[at(i)] = Index(mesh.positions.size());
    Vector mean = sum / crossings;
    for (int c = 0; c < N; ++c)
      if (atWall[std::size_t(c)]) mean[c] = 0.5;
    const Vector x = fluid.centre(i) + fluid.settings().cellWidth * mean;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    position.template head<N>() = x;
    mesh.positions.push_back(position);
  });
  for_all_cells(grid, [&](std::ptrdiff_t i, Each<int, N> const& place) {
    for (std::size_t c = 0; c < axes<N>; ++c) {
      bool between = place[c] <= grid.cells[c];
      for (std::size_t d = 0; d < axes<N>; ++d)
        between = between && (d == c || (place[d] >= 1 && place[d] <= grid.cells[d]));
      if (!between || inside(i) == inside(i + grid.stride[c])) continue;
      const bool forth = inside(i);  // out of the fluid along the axis
      if constexpr (N == 2) {
        const std::ptrdiff_t s = grid.stride[1 - c];
        mesh.edges.push_back({vertex[at(i - s)], vertex[at(i)]});
      } else {
        const std::ptrdiff_t s = grid.stride[(c + 1) % 3], t = grid.stride[(c + 2) % 3];
        Quad quad{vertex[at(i - s - t)], vertex[at(i - t)], vertex[at(i)], vertex[at(i - s)]};
        if (!forth) std::swap(quad[1], quad[3]);
        mesh.quads.push_back(quad);
      }
    }
  });
  return mesh;
}
/// The cells as elements, quads or hexahedra, without those of solids, over their corners.
template <class Fluid>
Mesh cells_of(Fluid const& fluid) {
  constexpr int N = Fluid::dimension;
  using Vector = Eigen::Matrix<double, N, 1>;
  auto at = [](std::ptrdiff_t i) { return std::size_t(i); };
  auto const& grid = fluid.grid();
  Mesh mesh;
  std::vector<Index> point(grid.size, -1);
  for_all_cells(grid, [&](std::ptrdiff_t i, Each<int, N> const& place) {
    for (std::size_t c = 0; c < axes<N>; ++c)
      if (place[c] < 1) return;
    point[at(i)] = Index(mesh.positions.size());
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    position.template head<N>() = Vector(fluid.centre(i).array() - fluid.settings().cellWidth / 2);
    mesh.positions.push_back(position);
  });
  grid.forCells({}, [&](std::ptrdiff_t i) {
    if (fluid.velocity.cell[at(i)] == CellKind::solid) return;
    auto corner = [&](std::ptrdiff_t offset) { return point[at(i + offset)]; };
    const std::ptrdiff_t s = grid.stride[0], t = grid.stride[1];
    if constexpr (N == 2) {
      mesh.quads.push_back({corner(0), corner(s), corner(s + t), corner(t)});
    } else {
      const std::ptrdiff_t r = grid.stride[2];
      mesh.hexahedra.push_back({corner(0),
                                corner(s),
                                corner(s + t),
                                corner(t),
                                corner(r),
                                corner(r + s),
                                corner(r + s + t),
                                corner(r + t)});
    }
  });
  return mesh;
}

}  // namespace sinew::fluid
