// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/topology/point_location.hpp>

#include <random>

namespace test_point_location {

using namespace sinew;

namespace {

std::vector<Triangle> strips(int n) {
  std::vector<Triangle> all;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int a = i * (n + 1) + j, b = a + 1, c = a + n + 1, d = c + 1;
      all.push_back({a, b, d});
      all.push_back({a, d, c});
    }
  return all;
}
std::vector<Eigen::Vector3d> sheet(int n, Eigen::Vector3d const& scale) {
  std::vector<Eigen::Vector3d> all;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      all.push_back(scale.cwiseProduct(Eigen::Vector3d(double(i) / n, double(j) / n, std::sin(i + 2.0 * j))));
  return all;
}

}  // namespace

TEST_CASE("the nearest triangle is that of a search through all, whatever the size of the sheet") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-0.5, 1.5);
  const auto list = strips(12);
  for (const double size : {1.0, 1e-120, 1e120}) {
    const auto points = sheet(12, {size, size, 0.1 * size});
    const ElementLocator<TriangleFit> locator(points, list);
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3d p = size * Eigen::Vector3d(number(random), number(random), number(random));
      double best = -std::numeric_limits<double>::infinity();
      for (auto const& t : list) best = std::max(best, TriangleFit(points, t).fit(p).score);
      CAPTURE(size, i);
      CHECK(locator.locate(p).fit.score == best);
    }
  }
}

TEST_CASE("triangles that are all at one place, or as far away as numbers go, take one cell") {
  const auto list = strips(12);
  for (auto const& scale : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1e308, 1e308, 1e308)}) {
    const auto points = sheet(12, scale);
    const ElementLocator<TriangleFit> locator(points, list);
    for (int i = 0; i < 1000; ++i) CHECK(locator.locate({0.1 * i, 0, 0}).element < int(list.size()));
  }
}

}  // namespace test_point_location
