// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/mesh.hpp>
#include <sinew/core/platform.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace sinew::view {

/// The faces of the convex hull of points, as triangles that look outwards; where all points lie in a plane,
/// the polygon around them, on one side; none where they lie on a line (quickhull: Barber, Dobkin, Huhdanpaa
/// 1996). Points that are farther out than 1e-9 of the size are corners.
class HullFaces {
 public:
  explicit HullFaces(std::vector<Eigen::Vector3d> const& points) : points_(points) {
    if (!begin()) return;
    // each round takes the farthest point outside of a face; a face that is made has a larger number
    for (std::size_t f = 0; f < faces_.size(); ++f)
      if (faces_[f].stays && !faces_[f].outside.empty()) grow(f);
  }
  std::vector<Triangle> triangles() const {
    std::vector<Triangle> all;
    for (Face const& face : faces_)
      if (face.stays) all.push_back({Index(face.corners[0]), Index(face.corners[1]), Index(face.corners[2])});
    return all;
  }

 private:
  struct Face {
    std::array<int, 3> corners{};
    Eigen::Vector3d normal{0, 0, 0};
    double offset = 0;
    std::vector<int> outside{};  // points in front of it, and of no face before
    bool stays = true;
  };
  std::vector<Eigen::Vector3d> const& points_;
  std::vector<Face> faces_{};
  double tolerance_ = 0;

  Eigen::Vector3d const& at(int i) const { return points_[std::size_t(i)]; }
  double above(Face const& face, int i) const { return face.normal.dot(at(i)) - face.offset; }
  // the place of the largest value, and that
  template <class Value>
  std::pair<int, double> farthest(Value&& value) const {
    std::pair<int, double> best{-1, -1};
    for (int i = 0; i < int(points_.size()); ++i)
      if (const double v = value(at(i)); v > best.second) best = {i, v};
    return best;
  }
  void add(int a, int b, int c) {
    Face face{.corners = {a, b, c}};
    const Eigen::Vector3d area = (at(b) - at(a)).cross(at(c) - at(a));
    if (area.norm() > 0) face.normal = area.normalized();
    face.offset = face.normal.dot(at(a));
    faces_.push_back(std::move(face));
  }
  // gives points to the first of the faces from `first` on that they are in front of
  void share(std::vector<int> const& points, std::size_t first) {
    for (const int i : points)
      for (std::size_t f = first; f < faces_.size(); ++f)
        if (above(faces_[f], i) > tolerance_) {
          faces_[f].outside.push_back(i);
          break;
        }
  }
  // a tetrahedron of points far from each other
  bool begin() {
    if (points_.size() < 3) return false;
    using V = Eigen::Vector3d;
    const int a = farthest([](V const& p) { return p.allFinite() ? 1. : 0.; }).first;
    const auto [b, size] = farthest([&](V const& p) { return (p - at(a)).norm(); });
    tolerance_ = 1e-9 * size;
    if (!(size > 0) || !std::isfinite(size)) return false;
    const V along = (at(b) - at(a)) / size;
    const auto [c, width] = farthest([&](V const& p) { return (p - at(a)).cross(along).norm(); });
    if (!(width > tolerance_)) return false;
    const V normal = along.cross(at(c) - at(a)).normalized();
    const auto [d, height] = farthest([&](V const& p) { return std::abs(normal.dot(p - at(a))); });
    if (!(height > tolerance_)) return flat(along, normal.cross(along));
    const bool upwards = normal.dot(at(d) - at(a)) > 0;
    const int second = upwards ? c : b, third = upwards ? b : c;
    add(a, second, third);
    add(a, third, d);
    add(third, second, d);
    add(second, a, d);
    std::vector<int> all;
    for (int i = 0; i < int(points_.size()); ++i)
      if (i != a && i != b && i != c && i != d) all.push_back(i);
    share(all, 0);
    return true;
  }
  // the polygon of points in a plane with these axes, as a fan (monotone chain: Andrew 1979)
  bool flat(Eigen::Vector3d const& x, Eigen::Vector3d const& y) {
    std::vector<std::pair<Eigen::Vector2d, int>> sorted;
    for (int i = 0; i < int(points_.size()); ++i)
      sorted.push_back({{x.dot(at(i) - at(0)), y.dot(at(i) - at(0))}, i});
    std::sort(sorted.begin(), sorted.end(), [](auto const& a, auto const& b) {
      return a.first[0] != b.first[0] ? a.first[0] < b.first[0] : a.first[1] < b.first[1];
    });
    std::vector<std::pair<Eigen::Vector2d, int>> polygon;
    for (const bool back : {false, true}) {
      const std::size_t first = polygon.size();
      for (auto const& p : sorted) {
        while (polygon.size() >= first + 2) {
          const Eigen::Vector2d u = polygon.back().first - polygon[polygon.size() - 2].first,
                                v = p.first - polygon.back().first;
          if (u[0] * v[1] - u[1] * v[0] > tolerance_ * u.norm()) break;  // it turns left
          polygon.pop_back();
        }
        polygon.push_back(p);
      }
      polygon.pop_back();
      if (!back) std::reverse(sorted.begin(), sorted.end());
    }
    for (std::size_t k = 2; k < polygon.size(); ++k)
      add(polygon[0].second, polygon[k - 1].second, polygon[k].second);
    return true;
  }
  // the farthest point outside of a face takes the place of all that it sees
  void grow(std::size_t from) {
    std::vector<int> const& outside = faces_[from].outside;
    const int apex = *std::max_element(outside.begin(), outside.end(), [&](int i, int j) {
      return above(faces_[from], i) < above(faces_[from], j);
    });
    std::vector<int> waiting;
    std::set<std::pair<int, int>> edges;  // of what it sees, from corner to corner
    for (Face& face : faces_) {
      if (!face.stays || !(above(face, apex) > tolerance_)) continue;
      face.stays = false;
      for (std::size_t k = 0; k < 3; ++k) edges.emplace(face.corners[k], face.corners[(k + 1) % 3]);
      waiting.insert(waiting.end(), face.outside.begin(), face.outside.end());
      face.outside.clear();
    }
    std::erase(waiting, apex);
    const std::size_t first = faces_.size();
    for (auto const& [i, j] : edges)
      if (!edges.contains({j, i})) add(i, j, apex);
    share(waiting, first);
  }
};

}  // namespace sinew::view
