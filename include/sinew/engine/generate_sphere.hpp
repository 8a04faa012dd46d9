// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <array>
#include <string_view>
#include <vector>

namespace sinew {

/// Regular bodies whose sides are triangles.
enum class PlatonicSolid { tetrahedron, octahedron, icosahedron };
constexpr auto enum_names(PlatonicSolid) {
  return std::to_array<std::string_view>({"tetrahedron", "octahedron", "icosahedron"});
}

/// A ball, made without a file: each side of a regular body is divided into tessellationDegree^2 triangles
/// with their points on the sphere, which look outwards (those of SOFA's icosahedron look inwards), and each
/// makes a tetrahedron with the centre. On the edges of
/// the body points are apart by one angle; inside its sides they are what lies at
/// (i a + j b + k c) / |i a + j b + k c|, i + j + k the degree.
struct GenerateSphere {
  using Role = role::Engine;
  static constexpr std::string_view className = "GenerateSphere";

  double radius = 0.2;
  Eigen::Vector3d origin{0, 0, 0};
  int tessellationDegree = 1;
  PlatonicSolid platonicSolid = PlatonicSolid::icosahedron;

  static constexpr auto fields() {
    using E = GenerateSphere;
    return field_list(field("radius", &E::radius, "m", "of the ball", range::positive),
                      field("origin", &E::origin, "m", "centre of the ball"),
                      field("tessellationDegree",
                            &E::tessellationDegree,
                            "",
                            "parts of each edge of the regular body",
                            range::closed(1, 512)),
                      field("platonicSolid", &E::platonicSolid, "", "the regular body"));
  }

  // after update
  std::vector<Eigen::Vector3d> position{}, surfacePosition{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<Triangle> triangles{};

  static constexpr auto outputs() {
    using E = GenerateSphere;
    return field_list(field("output_TetrahedraPosition", &E::position, "m", "points of the tetrahedra")
                          .also("output_position position"),
                      field("output_TrianglesPosition", &E::surfacePosition, "m", "points of the triangles"),
                      field("tetrahedra", &E::tetrahedra, "", "over output_TetrahedraPosition"),
                      field("triangles", &E::triangles, "", "over output_TrianglesPosition"));
  }

  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/topology/adjacency.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace sinew {

namespace detail {

struct RegularBody {
  std::vector<Eigen::Vector3d> corners;  // on the unit sphere
  std::vector<Triangle> sides;
};

SINEW_ONCE RegularBody regular_body(PlatonicSolid solid) {
  using Eigen::Vector3d;
  if (solid == PlatonicSolid::tetrahedron) {
    const double s = std::numbers::sqrt2, r = std::sqrt(3.0);
    return {{{0, 0, 1}, {0, 2 * s / 3, -1 / 3.}, {-s / r, -s / 3, -1 / 3.}, {s / r, -s / 3, -1 / 3.}},
            {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  }
  if (solid == PlatonicSolid::octahedron)
    return {{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {-1, 0, 0}, {0, -1, 0}},
            {{0, 1, 2}, {0, 2, 4}, {0, 4, 5}, {0, 5, 1}, {1, 5, 3}, {1, 3, 2}, {3, 5, 4}, {2, 3, 4}}};
  // the frame of SOFA's icosahedron: six corners, and those opposite to them
  RegularBody body{{{0.4249358858193742, -0.6234212590752522, -0.901521749427252},
                    {-0.5999406907417391, 0.05914133178387721, -1.009227188986324},
                    {0.4980672603913731, 0.6101449500603583, -0.872707378430782},
                    {1.170388006823068, -0.06734654200022822, -0.0873067158600265},
                    {0.4878971283264427, -1.037062929459035, 0.2615777778398508},
                    {-0.606226178027942, -0.958889124295748, -0.3082004094765843}},
                   {{0, 1, 5},  {0, 2, 1},  {0, 3, 2},   {0, 4, 3},  {0, 5, 4},   {1, 2, 10}, {1, 9, 5},
                    {1, 10, 9}, {2, 3, 11}, {2, 11, 10}, {3, 4, 7},  {3, 7, 11},  {4, 5, 8},  {4, 8, 7},
                    {5, 9, 8},  {6, 7, 8},  {6, 8, 9},   {6, 9, 10}, {6, 10, 11}, {6, 11, 7}}};
  for (std::size_t i = 0; i < 6; ++i) {
    body.corners[i].normalize();
    body.corners.push_back(-body.corners[i]);
  }
  return body;
}

}  // namespace detail

SINEW_ONCE void GenerateSphere::update(std::string_view where) {
  check_fields(*this, where);
  detail::RegularBody body = detail::regular_body(platonicSolid);
  for (auto& [a, b, c] : body.sides) {
    auto x = [&](Index i) -> Eigen::Vector3d const& { return body.corners[std::size_t(i)]; };
    if (x(a).dot(x(b).cross(x(c))) < 0) std::swap(b, c);
  }
  const int n = tessellationDegree;
  std::vector<Eigen::Vector3d> unit = body.corners;
  triangles.clear();

  // points on the edges, from the lower corner on, in the order of the edges
  std::map<Edge, Index> edgeStart;
  std::vector<Edge> edges;
  for (auto const& side : body.sides)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(side[k], side[(k + 1) % 3]);
      if (edgeStart.try_emplace(Edge{low, high}, 0).second) edges.push_back({low, high});
    }
  std::sort(edges.begin(), edges.end());
  for (Edge const& e : edges) {
    edgeStart[e] = Index(unit.size());
    const Eigen::Vector3d a = body.corners[std::size_t(e[0])], b = body.corners[std::size_t(e[1])];
    const Eigen::Vector3d across = a.cross(b).cross(a).normalized();
    const double angle = std::acos(a.dot(b));
    for (int j = 1; j < n; ++j)
      unit.push_back(std::cos(angle * j / n) * a + std::sin(angle * j / n) * across);
  }
  for (auto const& side : body.sides) {
    auto corner = [&](std::size_t k) { return body.corners[std::size_t(side[k])]; };
    // the number of the point of weights i j k, which are n together
    std::map<Triangle, Index> number{{{n, 0, 0}, side[0]}, {{0, n, 0}, side[1]}, {{0, 0, n}, side[2]}};
    for (std::size_t opposite = 0; opposite < 3; ++opposite) {
      const std::size_t from = (opposite + 1) % 3, to = (opposite + 2) % 3;
      const auto [low, high] = std::minmax(side[from], side[to]);
      for (int k = 1; k < n; ++k) {
        Triangle weights{0, 0, 0};
        weights[from] = n - k, weights[to] = k;
        const bool forward = side[from] == low;
        number[weights] = edgeStart[{low, high}] + (forward ? k : n - k) - 1;
      }
    }
    for (int i = 1; i < n; ++i)
      for (int j = 1; j < n - i; ++j) {
        number[{i, j, n - i - j}] = Index(unit.size());
        unit.push_back((i * corner(0) + j * corner(1) + (n - i - j) * corner(2)).normalized());
      }
    for (int i = 1; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j) {
        const int k = n - i - j;
        const Index a = number[{i, j, k}], b = number[{i - 1, j + 1, k}];
        triangles.push_back({a, b, number[{i - 1, j, k + 1}]});
        if (i + j < n) triangles.push_back({a, number[{i, j + 1, k - 1}], b});
      }
  }

  surfacePosition.clear(), position.clear(), tetrahedra.clear();
  for (auto const& p : unit) surfacePosition.push_back(origin + radius * p);
  if (n == 1 && platonicSolid == PlatonicSolid::tetrahedron) {
    position = surfacePosition;
    tetrahedra.push_back({0, 1, 3, 2});
  } else {
    position.push_back(origin);
    position.insert(position.end(), surfacePosition.begin(), surfacePosition.end());
    for (auto const& t : triangles) tetrahedra.push_back({0, t[0] + 1, t[1] + 1, t[2] + 1});
  }
}

}  // namespace sinew
#endif
