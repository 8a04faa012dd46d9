// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// Points at random inside a closed surface whose triangles look outwards, no two of them nearer than
/// minDistanceBetweenPoints. A point is inside where each of numberOfTests rays in random directions leaves
/// the surface first. The numbers are those of a generator of its own, the same with each run for one seed;
/// where there is no room for as many points, there are fewer.
struct RandomPointDistributionInSurface {
  using Role = role::Engine;
  static constexpr std::string_view className = "RandomPointDistributionInSurface";

  int randomSeed = 0;
  double minDistanceBetweenPoints = 0.1;
  int numberOfInPoints = 10, numberOfTests = 5;
  std::vector<Eigen::Vector3d> vertices{};
  std::vector<Triangle> triangles{};

  static constexpr auto fields() {
    using E = RandomPointDistributionInSurface;
    return field_list(
        field("randomSeed", &E::randomSeed, "", "begins the random numbers", range::nonNegative),
        field("minDistanceBetweenPoints",
              &E::minDistanceBetweenPoints,
              "m",
              "least distance of two points; none where it is negative"),
        field("numberOfInPoints", &E::numberOfInPoints, "", "points inside", range::closed(0, 1 << 20)),
        field("numberOfTests", &E::numberOfTests, "", "rays that test a point", range::closed(1, 1001)),
        field("vertices", &E::vertices, "m", "points of the surface"),
        field("triangles", &E::triangles, "", "of the surface", range::nonNegative));
  }

  // after update
  std::vector<Eigen::Vector3d> inPoints{}, outPoints{};

  static constexpr auto outputs() {
    using E = RandomPointDistributionInSurface;
    return field_list(field("inPoints", &E::inPoints, "m", "the points inside"),
                      field("outPoints", &E::outPoints, "m", "those that were tried and left out"));
  }

  /// Throws Error where there is no triangle, or one refers to a missing point; the outputs then stay.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/topology/ray_triangle.hpp>

#include <limits>
#include <random>

namespace sinew {

SINEW_ONCE void RandomPointDistributionInSurface::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  if (triangles.empty() || vertices.empty())
    throw Error(at, "there is no surface; link vertices and triangles to those of a loader or topology");
  detail::check_indices(at, "triangle", triangles, vertices.size());
  inPoints.clear(), outPoints.clear();

  std::mt19937_64 generator(static_cast<unsigned>(randomSeed));
  // what std::uniform_real_distribution gives differs between libraries
  auto random = [&](double low, double high) {
    return low + (high - low) * (double(generator() >> 11) * 0x1p-53);
  };
  std::vector<Eigen::Vector3d> directions(std::size_t(numberOfTests | 1));
  for (auto& d : directions)
    for (double& c : d) c = random(-1, 1);
  auto x = [&](Index i) -> Eigen::Vector3d const& { return vertices[std::size_t(i)]; };
  auto leaves = [&](Eigen::Vector3d const& p, Eigen::Vector3d const& d) {
    double nearest = std::numeric_limits<double>::infinity();
    bool outwards = false;
    for (auto const& [a, b, c] : triangles)
      if (const auto t = line_meets_triangle(p, d, x(a), x(b), x(c)); t && *t >= 0 && *t < nearest) {
        nearest = *t;
        outwards = d.dot((x(b) - x(a)).cross(x(c) - x(a))) > 0;
      }
    return outwards;
  };
  Eigen::Vector3d low = vertices[0], high = vertices[0];
  for (auto const& v : vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
  const double least = minDistanceBetweenPoints;
  auto taken = [&](Eigen::Vector3d const& p) {
    for (auto const& d : directions)
      if (!leaves(p, d)) return false;
    for (auto const& q : inPoints)
      if (least > 0 && (p - q).squaredNorm() < least * least) return false;
    return true;
  };
  const std::size_t wanted = std::size_t(numberOfInPoints);
  for (std::size_t tries = 200 * wanted; tries > 0 && inPoints.size() < wanted; --tries) {
    Eigen::Vector3d p;
    for (int c = 0; c < 3; ++c) p[c] = random(low[c], high[c]);
    (taken(p) ? inPoints : outPoints).push_back(p);
  }
}

}  // namespace sinew
#endif
