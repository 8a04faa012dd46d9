// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/engine/clustering_engine.hpp>
#include <sinew/engine/shape_matching.hpp>

#include "io/files.hpp"

#include <cmath>

namespace test_clustering_engine {

using namespace sinew;
using Clustering = ClusteringEngine<Vec3d>;
using Lists = std::vector<std::vector<int>>;

namespace {

std::vector<Eigen::Vector3d> line(int n) {
  std::vector<Eigen::Vector3d> x;
  for (int i = 0; i < n; ++i) x.push_back({double(i), 0, 0});
  return x;
}
Lists clusters(Clustering c) {
  c.update("scene");
  return c.cluster;
}

}  // namespace

TEST_CASE("centres are as far from each other as they may be, and clusters have what is near") {
  // points 0 to 8 on a line: 0, then 8, then 4, the farthest from both
  CHECK(clusters({.radius = 1.5, .number = 3, .position = line(9)}) ==
        Lists{{0, 1, 2}, {8, 7, 6}, {4, 3, 5}});
  // no point is free: 2 belongs to the nearest centre
  const auto far = clusters({.radius = 0.5, .number = 2, .position = line(4)});
  CHECK(far == Lists{{0, 1}, {3, 2}});
  // one cluster a point
  CHECK(clusters({.radius = 1.1, .position = line(3)}) == Lists{{0, 1}, {1, 0, 2}, {2, 1}});
  // there are no more than points
  CHECK(clusters({.radius = 0.1, .number = 7, .position = line(2)}) == Lists{{0}, {1}});
  // points in one place are of one cluster
  CHECK(clusters({.radius = 0.1, .number = 5, .position = {{1, 1, 1}, {1, 1, 1}}}) == Lists{{0, 1}});
  // fixed points come behind
  CHECK(clusters({.radius = 0.1,
                  .fixedRadius = 1.5,
                  .number = 2,
                  .fixedPosition = {{0, 1, 0}, {9, 9, 9}},
                  .position = line(2)}) == Lists{{0, 2}, {1, 2}});
}

TEST_CASE("distances go along edges") {
  // a hairpin: points 0 1 2 3 there, 4 5 6 7 back beside them
  std::vector<Eigen::Vector3d> x;
  for (int i = 0; i < 8; ++i) x.push_back({double(i < 4 ? i : 7 - i), i < 4 ? 0 : 0.1, 0});
  std::vector<Edge> edges;
  for (int i = 0; i + 1 < 8; ++i) edges.push_back({i, i + 1});
  // the end that is beside the start is the farthest along the edges
  const auto along = clusters({.radius = 0.5, .number = 2, .position = x, .edges = edges});
  REQUIRE(along.size() == 2);
  CHECK(along[0].front() == 0);
  CHECK(along[1].front() == 7);
  // each has its half, and the point beside: shapes of the two halves overlap
  CHECK(along[0] == std::vector<int>{0, 1, 2, 3, 4});
  CHECK(along[1] == std::vector<int>{7, 6, 5, 4, 3});
  const auto straight =
      clusters({.useTopo = false, .radius = 0.5, .number = 2, .position = x, .edges = edges});
  CHECK(straight[1].front() == 4);  // at the bend
  // edges are those of elements, each once
  const auto ofFaces = clusters(
      {.radius = 0.5, .number = 1, .position = line(4), .triangles = {{0, 1, 2}}, .quads = {{0, 1, 2, 3}}});
  CHECK(ofFaces == Lists{{0, 1, 2, 3}});
  // what does not hang together is its own
  CHECK(clusters({.radius = 9, .number = 2, .position = line(4), .edges = {{0, 1}, {2, 3}}}) ==
        Lists{{0, 1}, {2, 3}});
}

TEST_CASE("clusters come from a file as SOFA writes it") {
  const files::TempFolder folder;
  folder.write("c.txt", "1 0.5 1 2 -1 \n3 0 1 2 \n2 4 3 \n");
  CHECK(clusters({.inFile = {folder / "c.txt"}}) == Lists{{0, 1, 2}, {4, 3}});
  for (auto const& [content, part] : {std::pair{"1 0.5 1 2 -1 \n3 0 1 \n", "c.txt:3"},
                                      {"1 x", "c.txt:1"},
                                      {"1 0.5 1 1 -1\n2 0 -3\n", "c.txt:2"}}) {
    folder.write("c.txt", content);
    const std::string said = error_of([&] { clusters({.inFile = {folder / "c.txt"}}); });
    INFO(said);
    CHECK(said.find(part) != std::string::npos);
  }
  CHECK(!error_of([&] { clusters({.inFile = {folder / "none"}}); }).empty());
}

TEST_CASE("ShapeMatching has the rigid motion of its clusters") {
  using Matching = ShapeMatching<Vec3d>;
  const std::vector<Eigen::Vector3d> rest{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  std::vector<Eigen::Vector3d> x;
  const Eigen::Matrix3d q = Eigen::AngleAxisd(2, Eigen::Vector3d(1, 1, 0).normalized()).toRotationMatrix();
  for (auto const& p : rest) x.push_back(q * p + Eigen::Vector3d(1, 2, 3));
  Matching m{.position = x, .rest_position = rest, .cluster = {{0, 1, 2, 3}}};
  m.update("scene");
  for (std::size_t i = 0; i < 4; ++i) CHECK((m.targetPosition[i] - x[i]).norm() < 1e-14);
  // points in no cluster stay
  m.cluster = {{0, 1, 2}};
  m.position[3] = {9, 9, 9};
  m.update("scene");
  CHECK(m.targetPosition[3] == Eigen::Vector3d(9, 9, 9));
}

TEST_CASE("bad input of ClusteringEngine and ShapeMatching is told") {
  auto says = [](auto engine, std::string_view part) {
    const std::string said = error_of([&] { engine.update("scene"); });
    INFO(said);
    CHECK(said.find(part) != std::string::npos);
  };
  says(Clustering{}, "position is empty");
  says(Clustering{.radius = -1, .position = line(2)}, "radius");
  says(Clustering{.radius = std::nan(""), .position = line(2)}, "radius");
  says(Clustering{.number = 0, .position = line(2)}, "number is 0");
  says(Clustering{.number = -2, .position = line(2)}, "number");
  says(Clustering{.position = line(2), .triangles = {{0, 1, 7}}}, "7");
  says(Clustering{.position = {{std::nan(""), 0, 0}}}, "position");
  using Matching = ShapeMatching<Vec3d>;
  says(Matching{}, "cluster is empty");
  says(Matching{.position = line(2), .cluster = {{0}}}, "position has 2 points, but rest_position 0");
  says(Matching{.position = line(2), .rest_position = line(2), .cluster = {{5}}}, "cluster 0 has point 5");
}

}  // namespace test_clustering_engine
