// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/topology/bcc_lattice.hpp>

#include <array>
#include <cstddef>

// The second step of isosurface stuffing: lattice points too near to the surface move onto it. What the paper
// leaves to the resolution of the lattice is repaired, so that the boundary of the body is a closed manifold
// always.

namespace sinew::detail {

/// The triangles and edges that the 24 lattice tetrahedra around a point show it: its link, a sphere of 14
/// points.
struct BccLink {
  std::array<std::array<int, 4>, 36> edges{};  // two directions, and the third points of its two triangles
  std::array<std::array<int, 3>, 24> triangles{};      // three directions
  std::array<std::array<int, 3>, 24> triangleEdges{};  // edges opposite to these
};

constexpr BccLink make_bcc_link() {
  auto adjacent = [](int u, int v) {
    auto const &a = bccDirections[std::size_t(u)], &b = bccDirections[std::size_t(v)];
    return bcc_direction(a[0] - b[0], a[1] - b[1], a[2] - b[2]) >= 0;
  };
  BccLink link;
  std::array<std::array<int, 14>, 14> number{};
  std::size_t edges = 0, triangles = 0;
  for (int u = 0; u < 14; ++u)
    for (int v = u + 1; v < 14; ++v) {
      if (!adjacent(u, v)) continue;
      number[std::size_t(u)][std::size_t(v)] = number[std::size_t(v)][std::size_t(u)] = int(edges);
      std::size_t thirds = 2;
      link.edges[edges][0] = u, link.edges[edges][1] = v;
      for (int w = 0; w < 14; ++w)
        if (adjacent(u, w) && adjacent(v, w)) link.edges[edges][thirds++] = w;
      ++edges;
    }
  for (int u = 0; u < 14; ++u)
    for (int v = u + 1; v < 14; ++v)
      for (int w = v + 1; w < 14; ++w)
        if (adjacent(u, v) && adjacent(v, w) && adjacent(u, w)) {
          const auto a = std::size_t(u), b = std::size_t(v), c = std::size_t(w);
          link.triangles[triangles] = {u, v, w};
          link.triangleEdges[triangles++] = {number[b][c], number[a][c], number[a][b]};
        }
  return link;
}

inline constexpr BccLink bccLink = make_bcc_link();

/// Whether the boundary of the body around the surface point p is one disk (or p is not on the boundary): the
/// boundary meets the link of p in a single closed curve that passes no point twice.
bool is_manifold_at(BccLattice const& lattice, int p);

/// Moves each point that a cut point violates (see bcc_alpha) to the nearest such cut point. The edges of a
/// moved point count as uncut from then on, so their cut points violate no other point.
void snap(BccLattice& lattice);

/// Moves points back to the lattice where the body, too thin for this spacing, would touch itself in a point
/// or an edge, and inside points next to flat cavities.
void unsnap_pinched(BccLattice& lattice);

/// Makes all inside points outside points, except for those of the largest group whose tetrahedra are joined
/// by faces: inside points that share an edge, or see each other through a face with three corners on the
/// surface.
void keep_largest_component(BccLattice& lattice);

}  // namespace sinew::detail

#if SINEW_DEFINES
#include <algorithm>
#include <vector>

namespace sinew::detail {

SINEW_ONCE bool is_manifold_at(BccLattice const& lattice, int p) {
  auto const& steps = lattice.steps_of(p);
  std::array<int, 14> label;
  for (std::size_t d = 0; d < 14; ++d) label[d] = lattice.label[std::size_t(p + steps[d])];
  // nodes of the curve: link points on the surface (0 to 13), cut link edges (14 to 49)
  std::array<int, 50> root, degree{};
  for (int i = 0; i < 50; ++i) root[std::size_t(i)] = i;
  auto find = [&](int i) {
    while (root[std::size_t(i)] != i) i = root[std::size_t(i)];
    return i;
  };
  int curves = 0;
  auto arc = [&](int a, int b) {
    curves += (degree[std::size_t(a)]++ == 0) + (degree[std::size_t(b)]++ == 0);
    const int ra = find(a), rb = find(b);
    if (ra != rb) root[std::size_t(rb)] = ra, --curves;
  };
  for (std::size_t t = 0; t < 24; ++t) {
    int nodes[3], count = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto u = std::size_t(bccLink.triangles[t][(c + 1) % 3]),
                 v = std::size_t(bccLink.triangles[t][(c + 2) % 3]);
      if (label[u] * label[v] < 0) nodes[count++] = 14 + bccLink.triangleEdges[t][c];
    }
    if (count == 1)  // inside, outside, surface
      for (const int u : bccLink.triangles[t])
        if (label[std::size_t(u)] == 0) nodes[count++] = u;
    if (count == 2) arc(nodes[0], nodes[1]);
  }
  for (auto const& [u, v, left, right] : bccLink.edges)
    if (label[std::size_t(u)] == 0 && label[std::size_t(v)] == 0 &&
        (label[std::size_t(left)] > 0) != (label[std::size_t(right)] > 0))
      arc(u, v);
  for (std::size_t i = 0; i < 14; ++i)
    if (degree[i] != 0 && degree[i] != 2) return false;
  return curves <= 1;
}

/// Whether p, on the surface, borders on nothing outside but on lattice tetrahedra with all corners on the
/// surface, which are left out: they would be a cavity.
inline bool borders_flat_cavity(BccLattice const& lattice, int p) {
  auto const& steps = lattice.steps_of(p);
  auto label = [&](int direction) { return lattice.label[std::size_t(p + steps[std::size_t(direction)])]; };
  for (int d = 0; d < 14; ++d)
    if (label(d) < 0) return false;
  return std::any_of(bccLink.triangles.begin(), bccLink.triangles.end(), [&](auto const& t) {
    return label(t[0]) == 0 && label(t[1]) == 0 && label(t[2]) == 0;
  });
}

SINEW_ONCE void snap(BccLattice& lattice) {
  lattice.for_inner_points([&](int p, auto const& steps) {
    double nearest = 2;
    for (int d = 0; d < 14; ++d) {
      if (lattice.label[std::size_t(p)] * lattice.label[std::size_t(p + steps[std::size_t(d)])] != -1)
        continue;
      const double t = lattice.cut_fraction(p, d), distance = bcc_is_long(d) ? t : t * 0.8660254037844386;
      if (t < bcc_alpha(d) && distance < nearest)
        nearest = distance, lattice.snapped[std::size_t(p)] = static_cast<signed char>(d);
    }
    if (nearest < 2) lattice.label[std::size_t(p)] = 0;
  });
}

SINEW_ONCE void unsnap_pinched(BccLattice& lattice) {
  std::vector<int> moved;
  lattice.for_inner_points([&](int p, auto const&) {
    if (lattice.label[std::size_t(p)] == 0) moved.push_back(p);
  });
  for (bool again = true; again;) {
    again = false;
    for (const int p : moved) {
      const bool inside = lattice.value[std::size_t(p)] < 0;
      if (lattice.label[std::size_t(p)] != 0) continue;
      if (is_manifold_at(lattice, p) && !(inside && borders_flat_cavity(lattice, p))) continue;
      lattice.unsnap(p);
      again = true;
    }
  }
}

SINEW_ONCE void keep_largest_component(BccLattice& lattice) {
  std::vector<int> stack;
  auto label = [&](int p) -> signed char& { return lattice.label[std::size_t(p)]; };
  auto flood = [&](int seed, signed char from, signed char to) {
    int count = 0;
    auto reach = [&](int p) {
      if (label(p) == from) label(p) = to, stack.push_back(p);
    };
    for (reach(seed); !stack.empty(); ++count) {
      const int p = stack.back();
      stack.pop_back();
      auto const& steps = lattice.steps_of(p);
      bool nearSurface = false;
      for (const int step : steps) reach(p + step), nearSurface = nearSurface || label(p + step) == 0;
      if (!nearSurface) continue;
      for (auto const& [u, v, w] : bccLink.triangles) {
        const int a = p + steps[std::size_t(u)], b = p + steps[std::size_t(v)], c = p + steps[std::size_t(w)];
        if (label(a) != 0 || label(b) != 0 || label(c) != 0) continue;
        // the neighbour beyond that face has the corner a + b - p, where short edges join a and b to p
        const int i = bcc_is_long(u) ? v : u, j = bcc_is_long(w) ? v : w;
        const int first = p + steps[std::size_t(i)];
        reach(first + lattice.steps_of(first)[std::size_t(j)]);
      }
    }
    return count;
  };
  int largest = 0, seed = -1;
  lattice.for_inner_points([&](int p, auto const&) {
    if (lattice.label[std::size_t(p)] != 1) return;
    if (const int count = flood(p, 1, 2); count > largest) largest = count, seed = p;
  });
  if (seed >= 0) flood(seed, 2, 1);
  std::replace(
      lattice.label.begin(), lattice.label.end(), static_cast<signed char>(2), static_cast<signed char>(-1));
}

}  // namespace sinew::detail
#endif
