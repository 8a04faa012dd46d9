// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/engine/nearest_point_roi.hpp>
#include <sinew/engine/pair_box_roi.hpp>

namespace test_point_pairs {

using namespace sinew;

namespace {

static_assert(Engine<PairBoxROI<Vec3d>> && Engine<PairBoxROI<Rigid2d>> && Engine<NearestPointROI<Vec1f>>);
using Ints = std::vector<int>;

template <class E>
void refuses(E engine, std::string_view name, std::string_view words) {
  std::string said;
  try {
    engine.update("/root/roi");
  } catch (Error const& error) {
    said = error.what();
  }
  INFO(said);
  CHECK(said.starts_with(text("/root/roi: ", name, ": ")));
  CHECK(said.find(words) != said.npos);
}

std::vector<Eigen::Vector3d> grid(int n) {
  std::vector<Eigen::Vector3d> points;
  for (int k = 0; k < n * n * n; ++k) points.emplace_back(k % n, k / n % n, k / (n * n));
  return points;
}

}  // namespace

TEST_CASE("PairBoxROI chooses the points between two boxes") {
  // the outer layer of a grid of 5 x 5 x 5 points
  PairBoxROI<Vec3d> layer{.inclusiveBox = Vec<double, 6>{{4, 4, 4, 0, 0, 0}},  // corners in any order
                          .includedBox = Vec<double, 6>{{0.5, 0.5, 0.5, 3, 3, 3}},
                          .position = grid(5)};
  layer.update("layer");
  CHECK(layer.indices.size() == 125 - 27);
  REQUIRE(layer.pointsInROI.size() == layer.indices.size());
  for (std::size_t k = 0; k < layer.indices.size(); ++k) {
    auto const& p = layer.pointsInROI[k];
    CHECK(p == layer.position[std::size_t(layer.indices[k])]);
    CHECK((p.minCoeff() == 0 || p.maxCoeff() == 4));
  }
  // faces belong to their boxes
  layer.includedBox = Vec<double, 6>{{0, 0, 0, 4, 4, 3}};
  layer.update("layer");
  CHECK(layer.indices.size() == 25);
  layer.inclusiveBox = Vec<double, 6>{{0, 0, 0, 1, 1, 4}};
  layer.update("layer");
  CHECK(layer.indices == Ints{100, 101, 105, 106});

  PairBoxROI<Rigid2d> plane{.inclusiveBox = Vec<double, 6>{{0, 0, 7, 3, 3, 8}},
                            .includedBox = Vec<double, 6>{{0, 0, 7, 1, 1, 8}},
                            .position = {{.center = {0.5, 0.5}}, {.center = {2, 2}}, {.center = {4, 2}}}};
  plane.update("plane");
  CHECK(plane.indices == Ints{1});

  const std::string_view name = "PairBoxROI<Vec3d>";
  PairBoxROI<Vec3d> bad = layer;
  bad.position.clear();
  refuses(bad, name, "position is empty");
  bad = layer;
  bad.includedBox.reset();
  refuses(bad, name, "give inclusiveBox and includedBox");
  bad = layer;
  (*bad.inclusiveBox)[3] = std::nan("");
  refuses(bad, name, "inclusiveBox is nan m");
}

TEST_CASE("NearestPointROI pairs the points of two states") {
  NearestPointROI<Vec3d> pairs{.position1 = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}},
                               .position2 = {{0.9, 0, 0}, {1.5, 0, 0}, {5, 0, 0}, {2.2, 0.1, 0}},
                               .radius = 0.6};
  pairs.update("pairs");
  // 1.5 is as near to 1 as to 2; 5 is too far from all
  CHECK(pairs.indices1 == Ints{1, 1, 2});
  CHECK(pairs.indices2 == Ints{0, 1, 3});
  CHECK(pairs.indexPairs == Ints{0, 1, 1, 0, 0, 1, 1, 1, 0, 2, 1, 3});
  CHECK(pairs.edges == std::vector<Edge>{{0, 1}, {2, 3}, {4, 5}});
  REQUIRE(pairs.distances.size() == 3);
  CHECK(pairs.distances[0] == Approx(0.1));
  CHECK(pairs.distances[2] == Approx(std::hypot(0.2, 0.1)));
  // the radius itself is too far, as in SOFA
  pairs.radius = 0.5;
  pairs.update("pairs");
  CHECK(pairs.indices2 == Ints{0, 3});
  // only some points
  pairs.inputIndices1 = {0}, pairs.inputIndices2 = {3, 0}, pairs.radius = 10;
  pairs.update("pairs");
  CHECK(pairs.indices1 == Ints{0, 0});
  CHECK(pairs.indices2 == Ints{3, 0});

  // against all distances
  NearestPointROI<Vec3d> many{.position1 = grid(4), .radius = 3};
  for (int k = 0; k < 40; ++k)
    many.position2.push_back(Eigen::Vector3d(std::sin(k), std::sin(2.0 + 3 * k), std::cos(5.0 * k)) * 2.5);
  many.update("many");
  for (std::size_t k = 0; k < many.indices1.size(); ++k)
    for (auto const& p : many.position1)
      CHECK((p - many.position2[std::size_t(many.indices2[k])]).norm() >= many.distances[k]);
  CHECK(many.indices1.size() > 10);

  const std::string_view name = "NearestPointROI<Vec3d>";
  NearestPointROI<Vec3d> bad = pairs;
  bad.position2.clear();
  refuses(bad, name, "position2 is empty");
  bad = pairs;
  bad.inputIndices1 = {3};
  refuses(bad, name, "inputIndices1 has 3, but position1 has 3 points");
  bad.inputIndices1 = {-1};
  refuses(bad, name, "inputIndices1[0] is -1");
  bad = pairs;
  bad.radius = 0;
  refuses(bad, name, "radius is 0 m");
}

}  // namespace test_point_pairs
