// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/mesh.hpp>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace sinew {

/// Finds the tetrahedron around a point, through a uniform grid of cells of about one element each.
struct TetrahedronLocator {
  struct Located {
    int element;
    Eigen::Vector4d weights;  // barycentric coordinates, which sum to 1; some negative outside
  };

  TetrahedronLocator(std::span<Eigen::Vector3d const> points, std::span<Tetrahedron const> tetrahedra) {
    low.setConstant(std::numeric_limits<double>::infinity());
    Eigen::Vector3d high = -low;
    for (auto const& t : tetrahedra) {
      Element e;
      e.origin = points[std::size_t(t[0])];
      Eigen::Matrix3d edges;
      for (int c = 0; c < 3; ++c) edges.col(c) = points[std::size_t(t[std::size_t(c) + 1])] - e.origin;
      e.inverse = edges.inverse();
      e.size = std::cbrt(std::abs(edges.determinant()));
      e.low = e.high = e.origin;
      for (const Index i : t) {
        e.low = e.low.cwiseMin(points[std::size_t(i)]);
        e.high = e.high.cwiseMax(points[std::size_t(i)]);
      }
      low = low.cwiseMin(e.low);
      high = high.cwiseMax(e.high);
      elements.push_back(e);
    }
    const Eigen::Vector3d extent = (high - low).cwiseMax(1e-12 * (high - low).maxCoeff() + 1e-300);
    cell = std::cbrt(extent.prod() / double(elements.size()));
    for (int c = 0; c < 3; ++c) {
      cell = std::max(cell, extent[c] / 512);
      count[c] = 1;
    }
    for (int c = 0; c < 3; ++c) count[c] = std::clamp(int(extent[c] / cell) + 1, 1, 513);

    // two passes: count, then fill, so that cell c holds members[start[c]] ... in the order of the elements
    start.assign(std::size_t(count.prod()) + 1, 0);
    for (int pass = 0; pass < 2; ++pass) {
      std::vector<int> at = start;
      for (std::size_t e = 0; e < elements.size(); ++e)
        forCells(cellOf(elements[e].low), cellOf(elements[e].high), [&](std::size_t c) {
          if (pass == 0)
            ++start[c + 1];
          else
            members[std::size_t(at[c]++)] = int(e);
        });
      if (pass == 0) {
        for (std::size_t c = 1; c < start.size(); ++c) start[c] += start[c - 1];
        members.resize(std::size_t(start.back()));
      }
    }
  }

  /// The element that contains p; outside all, the one whose smallest barycentric coordinate, as a length, is
  /// least negative among the elements in the nearest cells.
  Located locate(Eigen::Vector3d const& p) const {
    const Eigen::Vector3i home = cellOf(p);
    Located best{-1, {}};
    double bestScore = -std::numeric_limits<double>::infinity();
    auto visit = [&](std::size_t c) {
      for (int m = start[c]; m < start[c + 1]; ++m) {
        Element const& e = elements[std::size_t(members[std::size_t(m)])];
        const Eigen::Vector3d w = e.inverse * (p - e.origin);
        const Eigen::Vector4d weights(1 - w.sum(), w[0], w[1], w[2]);
        const double least = weights.minCoeff(), score = least < 0 ? least * e.size : 0;
        const int element = members[std::size_t(m)];
        if (score > bestScore || (score == bestScore && element < best.element))
          bestScore = score, best = {element, weights};
      }
    };
    // rings of cells, one more than the first that has any element
    int last = count.maxCoeff();
    for (int ring = 0; ring <= last; ++ring) {
      forCells((home.array() - ring).matrix(), (home.array() + ring).matrix(), visit);
      if (bestScore == 0) break;
      if (best.element >= 0 && last == count.maxCoeff()) last = std::min(last, ring + 1);
    }
    return best;
  }

 private:
  struct Element {
    Eigen::Vector3d origin, low, high;
    Eigen::Matrix3d inverse;
    double size;
  };
  std::vector<Element> elements{};
  Eigen::Vector3d low;
  double cell = 1;
  Eigen::Vector3i count{1, 1, 1};
  std::vector<int> start{}, members{};

  Eigen::Vector3i cellOf(Eigen::Vector3d const& p) const {
    Eigen::Vector3i c;
    for (int k = 0; k < 3; ++k) c[k] = int(std::clamp((p[k] - low[k]) / cell, 0.0, double(count[k] - 1)));
    return c;
  }
  template <class F>
  void forCells(Eigen::Vector3i a, Eigen::Vector3i b, F&& f) const {
    a = a.cwiseMax(0);
    b = b.cwiseMin(count - Eigen::Vector3i::Ones());
    for (int z = a[2]; z <= b[2]; ++z)
      for (int y = a[1]; y <= b[1]; ++y)
        for (int x = a[0]; x <= b[0]; ++x)
          f((std::size_t(z) * std::size_t(count[1]) + std::size_t(y)) * std::size_t(count[0]) +
            std::size_t(x));
  }
};

}  // namespace sinew
