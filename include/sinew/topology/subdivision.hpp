// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/mesh.hpp>

namespace sinew {

/// The mesh with each edge in 2, triangle and quad in 4, tetrahedron and hexahedron in 8, on the same lines,
/// faces and volumes (those of multilinear quads and hexahedra): lengths, areas of plane elements and volumes
/// stay what they are, elements that matched still match, and orientations stay. The points there were come
/// first, then the new ones, level by level; an element's parts stand where it stood. Throws Error on a bad
/// index, a point that an element uses twice, and where it might come to more than 2^28 points.
Mesh subdivide(Mesh mesh, int levels = 1);

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/topology/hexahedra.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <string_view>

namespace sinew::detail {

/// The points that subdivision adds to a mesh, each once: amid an edge, a quad or the face of a hexahedron,
/// and a hexahedron.
class AddedPoints {
 public:
  explicit AddedPoints(std::vector<Eigen::Vector3d>& positions) : positions_(positions) {}

  Index midpoint(Index a, Index b) {
    if (a == b) throw Error("subdivide", text("an element uses point ", a, " twice; remove or correct it"));
    return find(edges_, Edge{std::min(a, b), std::max(a, b)}, Edge{a, b});
  }
  Index midpoint(Quad const& face) {
    Quad sorted = face;
    std::sort(sorted.begin(), sorted.end());
    return find(faces_, sorted, face);
  }
  Index inside(Hexahedron const& cell) { return add(cell); }

 private:
  std::vector<Eigen::Vector3d>& positions_;
  std::map<Edge, Index> edges_{};
  std::map<Quad, Index> faces_{};

  template <class Corners>
  Index add(Corners const& corners) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Index i : corners) sum += positions_[std::size_t(i)];
    positions_.push_back(sum / double(corners.size()));
    return Index(positions_.size()) - 1;
  }
  template <class Key>
  Index find(std::map<Key, Index>& known, Key const& key, Key const& corners) {
    const auto [entry, fresh] = known.try_emplace(key, -1);
    if (fresh) entry->second = add(corners);
    return entry->second;
  }
};

/// Permutes the points 1, 2, 3 of a tetrahedron cyclically so that of the four tetrahedra that subdivision
/// puts around the line from the midpoint of 0 and 2 to that of 1 and 3, all of one volume, the worst, with
/// the longest edges, is as good as it can be.
inline void choose_diagonal(Tetrahedron& t, std::vector<Eigen::Vector3d> const& positions) {
  auto worst = [&](Tetrahedron const& u) {
    auto midpoint = [&](std::size_t i, std::size_t j) -> Eigen::Vector3d {
      return positions[std::size_t(u[i])] + positions[std::size_t(u[j])];
    };
    const Eigen::Vector3d ends[2] = {midpoint(0, 2), midpoint(1, 3)},
                          ring[4] = {midpoint(0, 1), midpoint(0, 3), midpoint(2, 3), midpoint(1, 2)};
    double maximum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      auto const &p = ring[k], &q = ring[(k + 1) % 4];
      double sum = (ends[0] - ends[1]).squaredNorm() + (p - q).squaredNorm();
      for (auto const& end : ends) sum += (end - p).squaredNorm() + (end - q).squaredNorm();
      maximum = std::max(maximum, sum);
    }
    return maximum;
  };
  Tetrahedron best = t;
  for (int k = 0; k < 2; ++k) {
    std::rotate(t.begin() + 1, t.begin() + 2, t.end());
    if (worst(t) < (1 - 1e-9) * worst(best)) best = t;
  }
  t = best;
}

/// Eight tetrahedra, four at the corners and four around a diagonal of the octahedron between them, of which
/// further subdivision makes no more than three shapes in all (Bey 1995). Oriented as the whole; the two that
/// Bey has the other way round are reversed by exchanging their points 0 and 2, which leaves all later
/// diagonals as they are.
inline void subdivide_tetrahedron(Tetrahedron const& t, AddedPoints& points, std::vector<Tetrahedron>& to) {
  const Index a = points.midpoint(t[0], t[1]), b = points.midpoint(t[0], t[2]),
              c = points.midpoint(t[0], t[3]), d = points.midpoint(t[1], t[2]),
              e = points.midpoint(t[1], t[3]), f = points.midpoint(t[2], t[3]);
  for (Tetrahedron const& part : {Tetrahedron{t[0], a, b, c},
                                  Tetrahedron{a, t[1], d, e},
                                  Tetrahedron{b, d, t[2], f},
                                  Tetrahedron{c, e, f, t[3]},
                                  Tetrahedron{a, b, c, e},
                                  Tetrahedron{d, b, a, e},
                                  Tetrahedron{b, c, e, f},
                                  Tetrahedron{e, d, b, f}})
    to.push_back(part);
}

/// Eight cells around the middle, as the coordinates of a trilinear cell are halved.
inline void subdivide_hexahedron(Hexahedron const& h, AddedPoints& points, std::vector<Hexahedron>& to) {
  // corner of the cell by its coordinates, each 0 or 1
  auto corner = [&h](int x, int y, int z) {
    for (std::size_t k = 0; k < 8; ++k)
      if (hexahedronCorners[k][0] == x && hexahedronCorners[k][1] == y && hexahedronCorners[k][2] == z)
        return h[k];
    return h[0];
  };
  // the 27 points of the halved cell, at 0, 1, 2 along each axis
  Index grid[3][3][3];
  for (int z = 0; z < 3; ++z)
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 3; ++x) {
        const int at[3] = {x, y, z};
        const int middle = (x == 1) + (y == 1) + (z == 1);
        // the corners around: both ends of each axis on which the place is in the middle
        Index around[8];
        std::size_t n = 0;
        for (int k = 0; k < (1 << middle); ++k) {
          int end[3], bit = 0;
          for (int c = 0; c < 3; ++c) end[c] = at[c] == 1 ? k >> bit++ & 1 : at[c] / 2;
          around[n++] = corner(end[0], end[1], end[2]);
        }
        grid[z][y][x] = middle == 0   ? around[0]
                        : middle == 1 ? points.midpoint(around[0], around[1])
                        : middle == 2 ? points.midpoint(Quad{around[0], around[1], around[3], around[2]})
                                      : points.inside(h);
      }
  for (int part = 0; part < 8; ++part) {
    Hexahedron cell;
    for (std::size_t k = 0; k < 8; ++k)
      cell[k] = grid[(part >> 2) + hexahedronCorners[k][2]][(part >> 1 & 1) + hexahedronCorners[k][1]]
                    [(part & 1) + hexahedronCorners[k][0]];
    to.push_back(cell);
  }
}

}  // namespace sinew::detail

namespace sinew {

SINEW_ONCE Mesh subdivide(Mesh mesh, int levels) {
  constexpr std::string_view where = "subdivide";
  if (levels < 0) throw Error(where, text(levels, " levels were asked for; give 0 or more"));
  check_mesh(where, mesh);
  // as if no two elements shared a new point
  double maximum = double(mesh.positions.size()), part2 = double(mesh.edges.size()),
         part4 = 3. * double(mesh.triangles.size()) + 5. * double(mesh.quads.size()),
         part8 = 6. * double(mesh.tetrahedra.size()) + 19. * double(mesh.hexahedra.size());
  for (int level = 0; level < levels && maximum <= 268435456; ++level) {
    maximum += part2 + part4 + part8;
    part2 *= 2, part4 *= 4, part8 *= 8;
  }
  if (maximum > 268435456)
    throw Error(where, text(levels, " levels are too many: they may need more than 2^28 points; take fewer"));
  if (levels > 0)
    for (auto& t : mesh.tetrahedra) detail::choose_diagonal(t, mesh.positions);
  for (; levels > 0; --levels) {
    Mesh fine;
    fine.positions = std::move(mesh.positions);
    detail::AddedPoints points(fine.positions);
    for (auto const& [a, b] : mesh.edges) {
      const Index m = points.midpoint(a, b);
      fine.edges.push_back({a, m});
      fine.edges.push_back({m, b});
    }
    for (auto const& [a, b, c] : mesh.triangles) {
      const Index ab = points.midpoint(a, b), bc = points.midpoint(b, c), ca = points.midpoint(c, a);
      for (Triangle const& part :
           {Triangle{a, ab, ca}, Triangle{ab, b, bc}, Triangle{ca, bc, c}, Triangle{ab, bc, ca}})
        fine.triangles.push_back(part);
    }
    for (Quad const& q : mesh.quads) {
      const Index m = points.midpoint(q);
      for (std::size_t k = 0; k < 4; ++k) {
        // the corner that was at place k stays there
        Quad part;
        part[k] = q[k];
        part[(k + 1) % 4] = points.midpoint(q[k], q[(k + 1) % 4]);
        part[(k + 2) % 4] = m;
        part[(k + 3) % 4] = points.midpoint(q[k], q[(k + 3) % 4]);
        fine.quads.push_back(part);
      }
    }
    for (Tetrahedron const& t : mesh.tetrahedra) detail::subdivide_tetrahedron(t, points, fine.tetrahedra);
    for (Hexahedron const& h : mesh.hexahedra) detail::subdivide_hexahedron(h, points, fine.hexahedra);
    mesh = std::move(fine);
  }
  return mesh;
}

}  // namespace sinew
#endif
