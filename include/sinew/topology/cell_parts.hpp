// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/context.hpp>
#include <sinew/topology/hexahedra.hpp>
#include <sinew/topology/surface_cells.hpp>

#include <array>
#include <span>
#include <string>
#include <vector>

// Where a coarse cell holds several pieces of a body that do not meet in it, each becomes a hexahedron of its
// own at the same place (Nesme, Kry, Jerabkova, Faure 2009, Preserving topology and elasticity for embedded
// deformable models): so fingers of a hand move apart though they share cells.
namespace sinew::detail {

/// Parts of two cells that meet at a face: the one below along an axis and the one above.
struct CellLink {
  int below, above, axis;
};

/// The cells of a regular grid that are kept, and the parts of each.
struct CellParts {
  Eigen::Vector3i count{0, 0, 0};        // cells each way
  std::vector<int> number{};             // of each cell of the grid, x fastest; -1 of one left out
  std::vector<Eigen::Vector3i> cells{};  // that are kept
  std::vector<int> first{0};             // the first part of each of them, and how many there are
  std::vector<CellLink> links{};
  std::vector<double> stiffness{}, mass{};  // how filled a part is
  std::vector<int> whole{};                 // the part of the coarser grid that each belongs to

  int numberOf(Eigen::Vector3i const& c) const;
};

/// Cells that touch the surface, then those inside, a part each: SOFA's order.
CellParts finest_parts(SurfaceCells const& grid, bool onlyInsideCells);

/// Cells that touch the surface are half filled where that counts, all others are full.
void fill_by_surface(CellParts& parts, SurfaceCells const& grid, bool fillWeighted);

/// Links the parts of neighbours for which joined(below, above, axis) says so.
template <class Joined>
void link_neighbours(CellParts& parts, Joined&& joined) {
  for (std::size_t p = 0; p < parts.cells.size(); ++p)
    for (int axis = 2; axis >= 0; --axis) {  // in the order in which SOFA joins points
      Eigen::Vector3i below = parts.cells[p];
      if (--below[axis] < 0) continue;
      const int q = parts.numberOf(below);
      if (q >= 0 && joined(below, parts.cells[p], axis)) parts.links.push_back({q, int(p), axis});
    }
}
/// Joins cells with a face in common; with a surface, two that touch it only where that crosses the face.
void link_by_faces(CellParts& parts, SurfaceCells const& grid, Mesh const* surface);

/// The cells of twice the length. With `split`, members that are linked inside a cell are one part of it.
/// A cell is as filled as its eight members in the mean; a part of one that is split, as its last member over
/// 8, as in SOFA.
CellParts coarser_parts(CellParts& finer, bool split);

/// Hexahedra of the parts over points that they share where they are linked.
Mesh linked_hexahedra(CellParts const& parts, std::array<std::vector<double>, 3> const& coordinates);

/// Hexahedra of the cells over points that all share; z runs fastest, as in SOFA.
Mesh cell_hexahedra(CellParts const& parts, std::array<std::vector<double>, 3> const& coordinates);

/// What grids over surfaces are made of.
struct SparseCells {
  Mesh mesh{};
  std::vector<double> stiffness{}, mass{};
  Mesh finer{};                     // the finest cells, where the hexahedra are parts of cells
  std::vector<int> parents{};       // the hexahedron of each
  std::vector<CellLevel> levels{};  // from the halves of the hexahedra to the finest cells
};
/// `levels` times coarser than the finest cells. With `split`, cells have parts. Throws Error where no cell
/// is kept.
SparseCells sparse_cells(std::string const& at, CellParts finest, SurfaceCells const& grid, int levels,
                         bool split, bool onlyInsideCells);

/// Points each way of a grid whose cells are halved `levels` times. Throws Error above 2^24.
std::array<int, 3> finer_grid(std::string const& at, std::array<int, 3> n, int levels);

}  // namespace sinew::detail

#if SINEW_DEFINES
#include <sinew/topology/regular_grid.hpp>

#include <algorithm>
#include <numeric>
#include <tuple>

namespace sinew::detail {

/// Sets that are joined, each known by one of its members.
struct JoinedSets {
  std::vector<int> up;

  explicit JoinedSets(std::size_t n) : up(n) { std::iota(up.begin(), up.end(), 0); }
  int find(int i) {
    while (up[std::size_t(i)] != i) i = up[std::size_t(i)] = up[std::size_t(up[std::size_t(i)])];
    return i;
  }
  /// Members of the set of `from` are known by what those of `to` are known by.
  void join(int from, int to) { up[std::size_t(find(from))] = find(to); }
};

SINEW_ONCE int CellParts::numberOf(Eigen::Vector3i const& c) const {
  for (int k = 0; k < 3; ++k)
    if (c[k] < 0 || c[k] >= count[k]) return -1;
  return number[std::size_t(c[0]) +
                std::size_t(count[0]) * (std::size_t(c[1]) + std::size_t(count[1]) * std::size_t(c[2]))];
}

SINEW_ONCE CellParts finest_parts(SurfaceCells const& grid, bool onlyInsideCells) {
  CellParts parts;
  parts.count = grid.cells;
  parts.number.assign(grid.kinds.size(), -1);
  for (const auto kind : {SurfaceCells::touched, SurfaceCells::inside}) {
    if (kind == SurfaceCells::touched && onlyInsideCells) continue;
    std::size_t cell = 0;
    for (int k = 0; k < grid.cells[2]; ++k)
      for (int j = 0; j < grid.cells[1]; ++j)
        for (int i = 0; i < grid.cells[0]; ++i, ++cell)
          if (grid.kinds[cell] == kind) {
            parts.number[cell] = int(parts.cells.size());
            parts.cells.push_back({i, j, k});
          }
  }
  parts.first.resize(parts.cells.size() + 1);
  std::iota(parts.first.begin(), parts.first.end(), 0);
  return parts;
}

SINEW_ONCE void fill_by_surface(CellParts& parts, SurfaceCells const& grid, bool fillWeighted) {
  for (auto const& c : parts.cells)
    parts.stiffness.push_back(fillWeighted && grid.kinds[grid.number(c)] == SurfaceCells::touched ? 0.5 : 1);
  parts.mass = parts.stiffness;
}

SINEW_ONCE void link_by_faces(CellParts& parts, SurfaceCells const& grid, Mesh const* surface) {
  std::vector<bool> crossed[3];  // the face of a cell to the one below it
  if (surface)
    for (auto& faces : crossed) faces.assign(grid.kinds.size(), false);
  for (std::size_t t = 0; surface && t < surface->triangles.size(); ++t) {
    Eigen::Vector3d x[3];
    for (std::size_t k = 0; k < 3; ++k) x[k] = surface->positions[std::size_t(surface->triangles[t][k])];
    grid.forCellsNear(x, [&](Eigen::Vector3i const& cell) {
      const Eigen::Vector3d low = grid.corner(cell), high = grid.corner(cell + Eigen::Vector3i::Ones());
      for (int axis = 0; axis < 3; ++axis) {
        Eigen::Vector3d center = (low + high) / 2, half = (high - low) / 2;
        center[axis] = low[axis], half[axis] = 0;
        if (triangle_meets_box(x, center, half + grid.slack)) crossed[axis][grid.number(cell)] = true;
      }
    });
  }
  link_neighbours(parts, [&](Eigen::Vector3i const& below, Eigen::Vector3i const& above, int axis) {
    auto touched = [&](Eigen::Vector3i const& c) {
      return grid.kinds[grid.number(c)] == SurfaceCells::touched;
    };
    return !surface || !touched(below) || !touched(above) || crossed[axis][grid.number(above)];
  });
}

SINEW_ONCE CellParts coarser_parts(CellParts& finer, bool split) {
  CellParts coarse;
  coarse.count = (finer.count.array() + 1) / 2;
  coarse.number.assign(std::size_t(coarse.count.prod()), -1);
  const std::size_t members = std::size_t(finer.first.back());
  std::vector<Eigen::Vector3i> cellOf(members);
  for (std::size_t c = 0; c < finer.cells.size(); ++c)
    for (int p = finer.first[c]; p < finer.first[c + 1]; ++p) cellOf[std::size_t(p)] = finer.cells[c] / 2;
  JoinedSets sets(members);
  for (auto const& l : finer.links)
    if (cellOf[std::size_t(l.below)] == cellOf[std::size_t(l.above)]) sets.join(l.below, l.above);

  finer.whole.assign(members, -1);
  std::vector<std::array<int, 2>> found;  // the set of a part, and its last member
  for (int i = 0; i < coarse.count[0]; ++i)
    for (int j = 0; j < coarse.count[1]; ++j)
      for (int k = 0; k < coarse.count[2]; ++k) {
        const int begin = coarse.first.back();
        double stiffness = 0, mass = 0;
        found.clear();
        for (int child = 0; child < 8; ++child) {
          const int c = finer.numberOf({2 * i + (child & 1), 2 * j + (child >> 1 & 1), 2 * k + (child >> 2)});
          if (c < 0) continue;
          stiffness += finer.stiffness[std::size_t(c)] / 8;
          mass += finer.mass[std::size_t(c)] / 8;
          for (int p = finer.first[std::size_t(c)]; p < finer.first[std::size_t(c) + 1]; ++p) {
            const int set = split ? sets.find(p) : 0;
            std::size_t part = 0;
            while (part < found.size() && found[part][0] != set) ++part;
            if (part == found.size()) found.push_back({set, p});
            found[part][1] = p;
            finer.whole[std::size_t(p)] = begin + int(part);
          }
        }
        if (found.empty()) continue;
        coarse.number[std::size_t(i) + std::size_t(coarse.count[0]) *
                                           (std::size_t(j) + std::size_t(coarse.count[1]) * std::size_t(k))] =
            int(coarse.cells.size());
        coarse.cells.push_back({i, j, k});
        coarse.first.push_back(begin + int(found.size()));
        for (auto const& [set, last] : found) {
          const bool alone = found.size() == 1;
          coarse.stiffness.push_back(alone ? stiffness : finer.stiffness[std::size_t(last)] / 8);
          coarse.mass.push_back(alone ? mass : finer.mass[std::size_t(last)] / 8);
        }
      }
  for (auto const& l : finer.links)
    if (cellOf[std::size_t(l.below)] != cellOf[std::size_t(l.above)])
      coarse.links.push_back({finer.whole[std::size_t(l.below)], finer.whole[std::size_t(l.above)], l.axis});
  auto key = [](CellLink const& l) { return std::tuple(l.above, -l.axis, l.below); };
  std::sort(coarse.links.begin(), coarse.links.end(), [&](auto const& a, auto const& b) {
    return key(a) < key(b);
  });
  coarse.links.erase(std::unique(coarse.links.begin(),
                                 coarse.links.end(),
                                 [&](auto const& a, auto const& b) { return key(a) == key(b); }),
                     coarse.links.end());
  return coarse;
}

SINEW_ONCE Mesh linked_hexahedra(CellParts const& parts,
                                 std::array<std::vector<double>, 3> const& coordinates) {
  // corners of the part above and below that are one, where they are neighbours along x, y and z
  constexpr int pairs[3][4][2] = {
      {{0, 1}, {4, 5}, {7, 6}, {3, 2}}, {{0, 3}, {4, 7}, {5, 6}, {1, 2}}, {{0, 4}, {1, 5}, {2, 6}, {3, 7}}};
  const int n = parts.first.back();
  JoinedSets corners(std::size_t(n) * 8);
  for (auto const& l : parts.links)
    for (auto const& pair : pairs[l.axis]) corners.join(8 * l.above + pair[0], 8 * l.below + pair[1]);
  Mesh mesh;
  std::vector<Index> number(std::size_t(n) * 8, -1);
  for (std::size_t c = 0; c < parts.cells.size(); ++c)
    for (int p = parts.first[c]; p < parts.first[c + 1]; ++p)
      for (std::size_t k = 0; k < 8; ++k)
        if (const int corner = 8 * p + int(k); corners.find(corner) == corner) {
          number[std::size_t(corner)] = Index(mesh.positions.size());
          Eigen::Vector3d x;
          for (int a = 0; a < 3; ++a)
            x[a] = coordinates[std::size_t(a)]
                              [std::size_t(parts.cells[c][a] + hexahedronCorners[k][std::size_t(a)])];
          mesh.positions.push_back(x);
        }
  mesh.hexahedra.resize(std::size_t(n));
  for (std::size_t p = 0; p < mesh.hexahedra.size(); ++p)
    for (std::size_t k = 0; k < 8; ++k)
      mesh.hexahedra[p][k] = number[std::size_t(corners.find(int(8 * p + k)))];
  return mesh;
}

SINEW_ONCE Mesh cell_hexahedra(CellParts const& parts,
                               std::array<std::vector<double>, 3> const& coordinates) {
  Mesh mesh;
  const auto nx = std::size_t(parts.count[0] + 1), ny = std::size_t(parts.count[1] + 1),
             nz = std::size_t(parts.count[2] + 1);
  std::vector<Index> number(nx * ny * nz, -1);
  auto place = [&](Eigen::Vector3i const& c, std::size_t k) {
    auto at = [&](int a) { return std::size_t(c[a] + hexahedronCorners[k][std::size_t(a)]); };
    return at(2) + nz * (at(1) + ny * at(0));
  };
  for (auto const& c : parts.cells)
    for (std::size_t k = 0; k < 8; ++k) number[place(c, k)] = 0;
  std::size_t p = 0;
  for (std::size_t i = 0; i < nx; ++i)
    for (std::size_t j = 0; j < ny; ++j)
      for (std::size_t k = 0; k < nz; ++k, ++p)
        if (number[p] == 0) {
          number[p] = Index(mesh.positions.size());
          mesh.positions.push_back({coordinates[0][i], coordinates[1][j], coordinates[2][k]});
        }
  for (auto const& c : parts.cells) {
    Hexahedron h;
    for (std::size_t k = 0; k < 8; ++k) h[k] = number[place(c, k)];
    mesh.hexahedra.push_back(h);
  }
  return mesh;
}

/// The corner of the cell of twice the length at which each part lies.
SINEW_ONCE std::vector<int> octants_of(CellParts const& parts) {
  std::vector<int> octants(std::size_t(parts.first.back()));
  for (std::size_t c = 0; c < parts.cells.size(); ++c) {
    const Eigen::Vector3i half = parts.cells[c].unaryExpr([](int i) { return i & 1; });
    const int corner = 4 * half[2] + (half[1] ? 3 - half[0] : half[0]);
    std::fill(octants.begin() + parts.first[c], octants.begin() + parts.first[c + 1], corner);
  }
  return octants;
}

SINEW_ONCE std::array<int, 3> finer_grid(std::string const& at, std::array<int, 3> n, int levels) {
  for (int level = 0; level < levels; ++level)
    for (int& points : n) {
      points = 2 * points - 1;
      if (points > 1 << 24)
        throw Error(at,
                    text("nbVirtualFinerLevels is ",
                         levels,
                         ", which makes more than 2^24 points; give fewer levels or a coarser grid"));
    }
  return n;
}

SINEW_ONCE SparseCells sparse_cells(std::string const& at, CellParts finest, SurfaceCells const& grid,
                                    int levels, bool split, bool onlyInsideCells) {
  if (finest.cells.empty())
    throw Error(at,
                onlyInsideCells ? "no cell is inside the surface without touching it; take a finer grid, or "
                                  "onlyInsideCells=\"false\""
                                : "no cell touches the surface or is inside; correct min and max");
  std::vector<CellParts> all{std::move(finest)};
  for (int level = 0; level < levels; ++level) {
    CellParts next = coarser_parts(all.back(), split);
    all.push_back(std::move(next));
  }
  std::array<std::vector<double>, 3> coordinates = grid.coordinates;
  SparseCells made;
  if (split && levels > 0) {
    made.finer = cell_hexahedra(all[0], coordinates);
    for (int part : all[0].whole) {
      for (std::size_t level = 1; level + 1 < all.size(); ++level) part = all[level].whole[std::size_t(part)];
      made.parents.push_back(part);
    }
  }
  for (std::size_t level = all.size() - 1; level-- > 0;) {
    made.levels.push_back({.hexahedra = (split ? linked_hexahedra(all[level], coordinates)
                                               : cell_hexahedra(all[level], coordinates))
                                            .hexahedra,
                           .parents = std::move(all[level].whole),
                           .octants = octants_of(all[level]),
                           .fill = std::move(all[level].stiffness),
                           .massFill = std::move(all[level].mass)});
  }
  for (std::size_t c = 0; c < 3; ++c)
    coordinates[c] = grid_coordinates(
        all.back().count[Eigen::Index(c)] + 1, coordinates[c].front(), coordinates[c].back());
  CellParts& last = all.back();
  made.mesh = split ? linked_hexahedra(last, coordinates) : cell_hexahedra(last, coordinates);
  made.stiffness = std::move(last.stiffness);
  made.mass = std::move(last.mass);
  return made;
}

}  // namespace sinew::detail
#endif
