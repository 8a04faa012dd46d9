// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/mesh.hpp>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace sinew {

/// Which points of a triangle or tetrahedron lie on which side of a blade that has gone through it.
template <std::size_t N>
struct SidesOfSimplex {
  std::array<int, N> side{};  // 1, -1; 0: the point lies in the cut
  bool whole = false;         // the blade has gone through all of it

  /// A simplex is cut where the blade has crossed all edges between two groups of its points, and no other.
  /// `crossed(i, j)` says that of an edge; a point whose bit is in `inCut` belongs to no group, and its edges
  /// do not count.
  template <class Crossed>
  static SidesOfSimplex of(Crossed&& crossed, unsigned inCut) {
    SidesOfSimplex sides;
    bool any[2] = {false, false};
    std::size_t first = N;
    for (std::size_t i = 0; i < N; ++i) {
      if (inCut >> i & 1u) continue;
      if (first == N) first = i;
      sides.side[i] = i != first && crossed(first, i) ? -1 : 1;
      any[sides.side[i] > 0] = true;
    }
    sides.whole = any[0] && any[1];
    for (std::size_t i = 0; i < N; ++i)
      for (std::size_t j = i + 1; j < N; ++j)
        if (((inCut >> i | inCut >> j) & 1u) == 0)
          sides.whole = sides.whole && crossed(i, j) == (sides.side[i] * sides.side[j] < 0);
    return sides;
  }
};

/// How near a simplex is to the regular one: 1 there, 0 where it is flat, below 0 where it is inside out.
/// Volume over the cubed root mean square of its edges (Parthasarathy, Graichen, Hathaway 1994), and area
/// over the square of it.
inline double simplex_quality(std::array<Eigen::Vector3d, 4> const& x) {
  double squares = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) squares += (x[j] - x[i]).squaredNorm();
  const double edge = std::sqrt(squares / 6), six = (x[1] - x[0]).dot((x[2] - x[0]).cross(x[3] - x[0]));
  return edge > 0 ? std::sqrt(2.0) * six / (edge * edge * edge) : 0;
}
inline double simplex_quality(std::array<Eigen::Vector3d, 3> const& x) {
  const Eigen::Vector3d a = x[1] - x[0], b = x[2] - x[0];
  const double squares = (a.squaredNorm() + b.squaredNorm() + (a - b).squaredNorm()) / 3;
  return squares > 0 ? a.cross(b).norm() / 2 * 4 / (std::sqrt(3.0) * squares) : 0;
}

/// The parts of a simplex some of whose edges are split, in an order that is that of all elements: each split
/// halves what has the edge, so that neighbours have the same parts of their common face, whatever the
/// pattern is (bisection, Rivara 1984).
struct EdgeSplit {
  Index a, b, middle;
};
template <std::size_t N>
void split_simplex(std::array<Index, N> const& element, std::span<EdgeSplit const> splits,
                   std::vector<std::array<Index, N>>& parts) {
  parts.assign(1, element);
  for (EdgeSplit const& s : splits)
    for (std::size_t p = 0, n = parts.size(); p < n; ++p) {
      std::size_t atA = N, atB = N;
      for (std::size_t k = 0; k < N; ++k) {
        if (parts[p][k] == s.a) atA = k;
        if (parts[p][k] == s.b) atB = k;
      }
      if (atA == N || atB == N) continue;
      parts.push_back(parts[p]);
      parts[p][atB] = s.middle;
      parts.back()[atA] = s.middle;
    }
}

}  // namespace sinew
