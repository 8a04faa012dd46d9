// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/shape.hpp>

#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace sinew {

/// CollisionSurface::isLocalMinimum, for a surface that may be in memory of a GPU.
template <class Surface>
SINEW_HD bool is_local_minimum(Surface const& s, int element, std::array<int, 3> const& vertices,
                               Eigen::Vector3d const& d, double cone) {
  if (s.corners() < 2 || vertices[2] >= 0) return true;
  auto towards = [&](Eigen::Vector3d const& direction) {
    return d.dot(direction) > cone * d.norm() * direction.norm();
  };
  // a thinner capsule need not be nearer where its axis is
  auto isAsThick = [&]([[maybe_unused]] int neighbour) {
    if constexpr (requires { s.radiusAround; })
      return s.shape != Shape::capsule || s.radiusAround[std::size_t(neighbour)] >= s.radiusOf(element);
    else
      return true;
  };
  auto at = [&s](int vertex) -> Eigen::Vector3d const& { return s.position[std::size_t(vertex)]; };
  if (vertices[1] < 0) {
    const auto v = std::size_t(vertices[0]);
    for (int k = s.firstAround[v]; k < s.firstAround[v + 1]; ++k)
      if (isAsThick(k) && towards(at(s.around[std::size_t(k)]) - at(vertices[0]))) return false;
    return true;
  }
  // into the triangle that an edge has with a corner
  auto intoTriangle = [&](int p, int q, int corner) {
    const Eigen::Vector3d edge = at(q) - at(p), direction = at(corner) - at(p);
    const double square = edge.squaredNorm();
    return towards(direction - (direction.dot(edge) / (square > 1e-300 ? square : 1e-300)) * edge);
  };
  auto const& e = s.elements[std::size_t(element)];
  if (skeleton(s.shape) == Shape::line) {
    if (s.beside.empty()) return true;
    for (const int corner : s.beside[std::size_t(element)])
      if (corner >= 0 && intoTriangle(e[0], e[1], corner)) return false;
    return true;
  }
  for (std::size_t c = 0; c < 3; ++c) {
    const int p = e[c], q = e[(c + 1) % 3], other = s.across[std::size_t(element)][c];
    if ((p == vertices[0] && q == vertices[1]) || (q == vertices[0] && p == vertices[1]))
      return other < 0 || !intoTriangle(p, q, other);
  }
  return true;
}

}  // namespace sinew
