// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/broad_phase.hpp>

#include <array>
#include <random>
#include <vector>

namespace moving {

using sinew::AxisBox;
using sinew::BoxPair;
using Point = Eigen::Vector3d;

/// A sheet of 2 n^2 triangles in the unit square, with waves that run through it.
struct Sheet {
  int n;
  double height, phase;
  std::vector<Point> points{};
  std::vector<std::array<int, 3>> triangles{};

  Sheet(int cells, double z, double shift) : n(cells), height(z), phase(shift) {
    points.resize(std::size_t(n + 1) * std::size_t(n + 1));
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const int a = i + (n + 1) * j;
        triangles.push_back({a, a + 1, a + n + 2});
        triangles.push_back({a, a + n + 2, a + n + 1});
      }
    move(0);
  }
  void move(double t) {
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        const double u = double(i) / n, v = double(j) / n;
        points[std::size_t(i + (n + 1) * j)] = {
            u + 0.1 * std::sin(3 * v + t),
            v,
            height + 0.1 * std::sin(7 * u + phase + t) * std::cos(5 * v + phase - t)};
      }
  }
  std::vector<AxisBox> boxes() const {
    std::vector<AxisBox> all(triangles.size());
    for (std::size_t t = 0; t < all.size(); ++t)
      for (const int i : triangles[t]) all[t].include(points[std::size_t(i)]);
    return all;
  }
};

/// Balls of several sizes that fly on straight lines in a cube and turn back at its walls.
struct Balls {
  double side;
  std::vector<Point> centers{}, velocities{};
  std::vector<double> radii{};

  Balls(int n, double cube, unsigned seed) : side(cube) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(0, side), speed(-1, 1), size(0.1, 0.4);
    for (int i = 0; i < n; ++i) {
      centers.push_back({place(random), place(random), place(random)});
      velocities.push_back({speed(random), speed(random), speed(random)});
      radii.push_back(size(random));
    }
  }
  void move(double dt) {
    for (std::size_t i = 0; i < centers.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        centers[i][c] += dt * velocities[i][c];
        if (centers[i][c] < 0 || centers[i][c] > side) velocities[i][c] = -velocities[i][c];
      }
  }
  std::vector<AxisBox> boxes() const {
    std::vector<AxisBox> all;
    for (std::size_t i = 0; i < centers.size(); ++i)
      all.push_back(AxisBox{centers[i], centers[i]}.grown(radii[i]));
    return all;
  }
};

/// All pairs of a box of the one and a box of the other, sorted.
inline std::vector<BoxPair> all_pairs_between(std::vector<AxisBox> const& a, std::vector<AxisBox> const& b,
                                              double margin) {
  std::vector<BoxPair> pairs;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j)
      if (!a[i].empty() && !b[j].empty() && a[i].overlaps(b[j], margin)) pairs.push_back({int(i), int(j)});
  return pairs;
}

// as reported, so that what comes twice stays twice
inline std::vector<BoxPair> reported_self(sinew::BoundingTree const& tree, double margin) {
  std::vector<BoxPair> pairs;
  tree.self_pairs(margin, [&](int i, int j) { pairs.push_back({i, j}); });
  return pairs;
}
inline std::vector<BoxPair> reported(sinew::BoundingTree const& a, sinew::BoundingTree const& b,
                                     double margin) {
  std::vector<BoxPair> pairs;
  a.pairs(b, margin, [&](int i, int j) { pairs.push_back({i, j}); });
  return pairs;
}
inline std::vector<BoxPair> sorted(std::vector<BoxPair> pairs) {
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace moving
