// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>
#include <sinew/topology/adjacency.hpp>
#include <sinew/topology/element_checks.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace sinew {

/// Overlapping clusters of points around centres that are as far from each other as they may be: each further
/// one is the point farthest from those before (Gonzalez 1985), the first one is point 0. A cluster has the
/// points within a radius, and at least those to which its centre is the nearest, with those beside them.
/// Distances are along edges where there are some, and `useTopo`; a cluster then has what hangs together.
struct ClusterPoints {
  std::vector<Eigen::Vector3d> const &position, &fixedPosition;
  std::vector<Edge> const& edges;  // empty: distances are straight
  double radius, fixedRadius;
  int number;

  std::vector<std::vector<int>> clusters() const;
};

/// Groups points into clusters that overlap, of which shapes may be matched (ShapeMatching). The first point
/// of each is its centre.
template <class D>
struct ClusteringEngine {
  using Role = role::Engine;
  using DataTypes = D;
  static_assert(!D::rigid && D::size == 3, "ClusteringEngine is over points in space");
  static constexpr std::string_view className = "ClusteringEngine";

  bool useTopo = true;
  double radius = 1, fixedRadius = 1;
  int number = -1;
  std::vector<Eigen::Vector3d> fixedPosition{}, position{};
  std::vector<Edge> edges{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<Hexahedron> hexahedra{};
  DataFile inFile{};

  static constexpr auto fields() {
    using C = ClusteringEngine;
    return field_list(
        field("useTopo", &C::useTopo, "", "measure along the edges of the elements, where there are some"),
        field("radius", &C::radius, "m", "of a cluster", range::positive),
        field("fixedRadius",
              &C::fixedRadius,
              "m",
              "within which fixed points are of a cluster",
              range::positive),
        field("number", &C::number, "", "of clusters; -1: one around each point", range::atLeast(-1)),
        field("fixedPosition", &C::fixedPosition, "m", "fixed points, numbered behind the others"),
        field("position", &C::position, "m", "points to be grouped").also("rest_position"),
        field("edges", &C::edges, "", "over the points", range::nonNegative),
        field("triangles", &C::triangles, "", "over the points", range::nonNegative),
        field("quads", &C::quads, "", "over the points", range::nonNegative),
        field("tetrahedra", &C::tetrahedra, "", "over the points", range::nonNegative),
        field("hexahedra", &C::hexahedra, "", "over the points", range::nonNegative),
        field("inFile", &C::inFile, "", "clusters as SOFA writes them, in the place of all this"));
  }

  // after update
  std::vector<std::vector<int>> cluster{};

  static constexpr auto outputs() {
    return field_list(
        field("cluster", &ClusteringEngine::cluster, "", "points of each cluster, its centre first"));
  }

  /// Throws Error where there is no point, an element refers to a missing one, or the file is none of
  /// clusters.
  void update(std::string_view where);
};

/// Clusters of a file: `useTopo radius fixedRadius`, how many, `number`; then of each the count and the
/// points. Throws Error with the line.
std::vector<std::vector<int>> read_clusters(std::string const& path);

template <class D>
void ClusteringEngine<D>::update(std::string_view where) {
  check_fields(*this, where);
  if (!inFile.path.empty()) return void(cluster = read_clusters(inFile.path));
  const std::string at = text(where, ": ", component_name<ClusteringEngine>());
  if (position.empty()) throw Error(at, "position is empty; link it to the points of a loader or topology");
  if (number == 0)
    throw Error(at, "number is 0; give how many clusters there are to be, or -1 for one a point");
  check_element_indices(at,
                        {.edges = edges,
                         .triangles = triangles,
                         .quads = quads,
                         .tetrahedra = tetrahedra,
                         .hexahedra = hexahedra},
                        position.size());
  std::vector<Edge> all;
  if (useTopo) {
    auto add = [&all](std::vector<Edge> const& more) { all.insert(all.end(), more.begin(), more.end()); };
    for (auto const& [a, b] : edges) all.push_back({std::min(a, b), std::max(a, b)});
    add(edges_of(triangles)), add(edges_of_quads(quads)), add(edges_of(tetrahedra)), add(edges_of(hexahedra));
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
  }
  cluster = ClusterPoints{position, fixedPosition, all, radius, fixedRadius, number}.clusters();
}

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/io/text_reader.hpp>
#include <sinew/topology/cells_along_edges.hpp>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace sinew {

SINEW_ONCE std::vector<std::vector<int>> ClusterPoints::clusters() const {
  const std::size_t n = position.size();
  std::vector<std::vector<std::size_t>> around(edges.empty() ? 0 : n);
  for (auto const& [a, b] : edges) {
    around[std::size_t(a)].push_back(std::size_t(b));
    around[std::size_t(b)].push_back(std::size_t(a));
  }
  const bool along = !edges.empty();
  std::vector<std::size_t> centers, cell(n, 0);  // the nearest centre of each
  if (number < 0) {
    centers.resize(n);
    std::iota(centers.begin(), centers.end(), std::size_t(0));
    cell = centers;
  } else {
    std::vector<double> distance(n, std::numeric_limits<double>::max());
    auto measure = [&] {
      const std::size_t c = centers.size() - 1, center = centers[c];
      if (!along) {
        for (std::size_t i = 0; i < n; ++i)
          if (const double d = (position[i] - position[center]).norm(); d < distance[i])
            distance[i] = d, cell[i] = c;
        return;
      }
      detail::EdgeFront front{{0, center}};
      distance[center] = 0, cell[center] = c;
      detail::spread_cells(std::move(front), position, around, distance, cell);
    };
    centers = {0};
    measure();
    while (centers.size() < std::min(n, std::size_t(number))) {
      const auto farthest =
          std::size_t(std::max_element(distance.begin(), distance.end()) - distance.begin());
      if (!(distance[farthest] > 0)) break;
      centers.push_back(farthest);
      measure();
    }
  }

  std::vector<std::vector<int>> all(centers.size());
  std::vector<bool> inSome(n, false);
  auto near = [&](std::size_t c, std::size_t i) {
    return (position[centers[c]] - position[i]).norm() < radius;
  };
  for (std::size_t c = 0; c < centers.size(); ++c) {
    std::vector<bool> has(n, false);
    auto add = [&](std::size_t i) {
      has[i] = inSome[i] = true;
      all[c].push_back(int(i));
    };
    add(centers[c]);
    if (along) {
      for (std::size_t k = 0; k < all[c].size(); ++k) {
        const auto from = std::size_t(all[c][k]);
        for (const std::size_t to : around[from])
          if (!has[to] && (cell[from] == c || near(c, to))) add(to);
      }
    } else {
      for (std::size_t i = 0; i < n; ++i)
        if (!has[i] && near(c, i)) add(i);
    }
  }
  // along edges, the points of its cell hang together with a centre
  for (std::size_t i = 0; i < n && !along; ++i)
    if (!inSome[i]) all[cell[i]].push_back(int(i));
  for (std::size_t j = 0; j < fixedPosition.size(); ++j)
    for (std::size_t c = 0; c < centers.size(); ++c)
      if ((fixedPosition[j] - position[centers[c]]).norm() < fixedRadius) all[c].push_back(int(n + j));
  return all;
}

SINEW_ONCE std::vector<std::vector<int>> read_clusters(std::string const& path) {
  const std::string content = io::read_file(path);
  io::TextReader in(path, content);
  in.rejectBinary();
  in.integer("whether there is a topology, 0 or 1");
  in.real("the radius"), in.real("the radius of fixed points");
  std::vector<std::vector<int>> all(in.count("clusters", 1));
  in.integer("the number of clusters asked for");
  for (auto& cluster : all) {
    cluster.resize(in.count("points of a cluster", 1));
    for (int& i : cluster) i = int(in.index(std::size_t(std::numeric_limits<int>::max())));
  }
  return all;
}

}  // namespace sinew
#endif
