// SPDX-License-Identifier: BSL-1.0
#pragma once

// Needs libccd, as convex.hpp does.
#include <sinew/collision/contact_key.hpp>
#include <sinew/collision/convex.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sinew::detail {

/// What a convex body shows along n, as a polygon across n: its farthest corners in 32 directions around n,
/// which lean by 0.2 from it. They are the corners of the face there, if it leans by less.
struct SupportPolygon {
  using V = Eigen::Vector3d;
  using P = Eigen::Vector2d;
  static constexpr int directions = 32;
  std::array<P, directions> at;           // counterclockwise about n of the frame
  std::array<double, directions> height;  // along n
  std::array<int, directions> corner;
  std::array<bool, directions> inner{};  // the edge behind a corner is inside a surface that goes on flat
  int count = 0;
  P deepest, slope{0, 0};  // of the plane through the deepest corner and two others
  double deepestHeight;

  /// `side`: 1 where n leads out of the body, else -1.
  SupportPolygon(ConvexView const& body, V const& s, V const& t, V const& n, double side) {
    const V outwards = side * (body.rotation.transpose() * n), sx = body.rotation.transpose() * s,
            tx = body.rotation.transpose() * t;
    const P shift(s.dot(body.shift), t.dot(body.shift));
    std::size_t first = 0;
    for (std::size_t i = 1; i < body.count; ++i)
      if (body.points[i].dot(outwards) > body.points[first].dot(outwards)) first = i;
    auto place = [&](std::size_t i) { return P(P(sx.dot(body.points[i]), tx.dot(body.points[i])) + shift); };
    auto heightOf = [&](std::size_t i) { return side * body.points[i].dot(outwards) + n.dot(body.shift); };
    deepest = place(first);
    deepestHeight = heightOf(first);
    std::array<P, directions> around;
    for (int k = 0; k < directions; ++k) around[std::size_t(k)] = direction(k, directions);
    std::array<double, directions> maximum;
    maximum.fill(-std::numeric_limits<double>::infinity());
    std::array<int, directions> best{};
    for (std::size_t i = 0; i < body.count; ++i) {
      const P x(sx.dot(body.points[i]), tx.dot(body.points[i]));
      const double up = body.points[i].dot(outwards) / 0.2027;  // tan 0.2
      for (int k = 0; k < directions; ++k)
        if (const double reach = x.dot(around[std::size_t(k)]) + up; reach > maximum[std::size_t(k)])
          maximum[std::size_t(k)] = reach, best[std::size_t(k)] = int(i);
    }
    for (const int i : best) {
      const auto c = std::size_t(count);
      if (std::find(corner.begin(), corner.begin() + count, i) != corner.begin() + count) continue;
      corner[c] = i;
      at[c] = place(std::size_t(i));
      height[c] = heightOf(std::size_t(i));
      ++count;
    }
    // where the body is round they need not be convex
    for (int c = 0; count > 2 && c < count;) {
      const int before = c > 0 ? c - 1 : count - 1;
      if (cross(at[std::size_t(c)] - at[std::size_t(before)], (*this)[next(c)] - at[std::size_t(c)]) > 0) {
        ++c;
        continue;
      }
      for (auto k = std::size_t(c); k + 1 < std::size_t(count); ++k)
        at[k] = at[k + 1], height[k] = height[k + 1], corner[k] = corner[k + 1];
      --count;
      c = 0;
    }
    P far = deepest, aside = deepest;
    double farthest = 0, widest = 0;
    for (int c = 0; c < count; ++c)
      if (const double away = ((*this)[c] - deepest).norm(); away > farthest)
        farthest = away, far = (*this)[c];
    // the plane
    int third = -1;
    for (int c = 0; c < count; ++c)
      if (const double wide = std::abs(cross(far - deepest, at[std::size_t(c)] - deepest)); wide > widest)
        widest = wide, third = c, aside = at[std::size_t(c)];
    auto heightAt = [&](P const& x) {
      for (int c = 0; c < count; ++c)
        if (at[std::size_t(c)] == x) return height[std::size_t(c)] - deepestHeight;
      return 0.0;
    };
    const P u = far - deepest, v = aside - deepest;
    if (!(farthest > 0)) return;
    const double rise = heightAt(far);
    if (third < 0 || widest < 1e-6 * farthest * farthest)
      slope = rise / u.squaredNorm() * u;
    else
      slope = P(rise * v[1] - heightAt(aside) * u[1], heightAt(aside) * u[0] - rise * v[0]) / cross(u, v);
  }

  static double cross(P const& u, P const& v) { return u[0] * v[1] - u[1] * v[0]; }
  /// One of `of` directions around; rotated a little, so that no edge of a usual body is across it.
  static P direction(int k, int of) {
    const double angle = 0.1234567 + 2 * 3.14159265358979323846 * k / of;
    return {std::cos(angle), std::sin(angle)};
  }
  P const& operator[](int c) const { return at[std::size_t(c)]; }
  int next(int c) const { return c + 1 < count ? c + 1 : 0; }
  double plane(P const& x) const { return deepestHeight + slope.dot(x - deepest); }
  int edges() const { return count == 2 ? 1 : count == 1 ? 0 : count; }
  Feature edge(int c) const { return Feature::edge(corner[std::size_t(c)], corner[std::size_t(next(c))]); }
  /// Where it is neither corner nor edge of a segment or a point.
  Feature inside() const {
    if (count == 1) return Feature::vertex(corner[0]);
    if (count == 2) return edge(0);
    return Feature::face();
  }
  bool holds(P const& x, double tolerance, double innerTolerance) const {
    if (count == 1) return (x - at[0]).norm() <= tolerance;
    if (count == 2) {
      const P u = at[1] - at[0];
      const double along = std::clamp((x - at[0]).dot(u) / u.squaredNorm(), 0.0, 1.0);
      return (x - at[0] - along * u).norm() <= tolerance;
    }
    for (int c = 0; c < count; ++c) {
      const P u = (*this)[next(c)] - (*this)[c];
      if (cross(u, x - (*this)[c]) < -(inner[std::size_t(c)] ? innerTolerance : tolerance) * u.norm())
        return false;
    }
    return true;
  }
};

/// One place of a manifold: across n, heights along n on both, and what of each is there.
struct ManifoldPoint {
  Eigen::Vector2d at;
  double heightA, heightB;
  Feature featureA, featureB;
};

/// Where two polygons meet: corners of one inside the other, and crossings of edges; of more than 8 those
/// that are outermost in 8 directions. Points nearer than `tolerance` are one.
struct Manifold {
  using P = Eigen::Vector2d;
  static constexpr int maximum = 8;
  std::array<ManifoldPoint, 4 * SupportPolygon::directions> points;
  int count = 0;

  void add(ManifoldPoint const& p, double tolerance) {
    for (int i = 0; i < count; ++i)
      if ((points[std::size_t(i)].at - p.at).norm() <= tolerance) return;
    if (count < int(points.size())) points[std::size_t(count++)] = p;
  }
  void meet(SupportPolygon const& a, SupportPolygon const& b, double tolerance, double innerTolerance) {
    addCorners(a, b, true, tolerance, innerTolerance);
    addCorners(b, a, false, tolerance, innerTolerance);
    for (int i = 0; i < a.edges(); ++i)
      for (int j = 0; j < b.edges(); ++j) {
        if (a.inner[std::size_t(i)] || b.inner[std::size_t(j)]) continue;
        const P u = a[a.next(i)] - a[i], v = b[b.next(j)] - b[j], d = b[j] - a[i];
        const double determinant = SupportPolygon::cross(u, v);
        if (std::abs(determinant) <= 1e-9 * u.norm() * v.norm()) continue;
        const double s = SupportPolygon::cross(d, v) / determinant,
                     r = SupportPolygon::cross(d, u) / determinant;
        if (s < 0 || s > 1 || r < 0 || r > 1) continue;
        auto mix = [](auto const& body, int k, double w) {
          return (1 - w) * body.height[std::size_t(k)] + w * body.height[std::size_t(body.next(k))];
        };
        add({a[i] + s * u, mix(a, i, s), mix(b, j, r), a.edge(i), b.edge(j)}, tolerance);
      }
  }
  /// Corners of a before the face b, or of b before the face a.
  void addCorners(SupportPolygon const& a, SupportPolygon const& b, bool ofA, double tolerance,
                  double innerTolerance) {
    for (int i = 0; i < a.count; ++i) {
      const double mine = a.height[std::size_t(i)], other = b.plane(a[i]);
      const Feature corner = Feature::vertex(a.corner[std::size_t(i)]);
      if (!b.holds(a[i], tolerance, innerTolerance)) continue;
      add(ofA ? ManifoldPoint{a[i], mine, other, corner, b.inside()}
              : ManifoldPoint{a[i], other, mine, b.inside(), corner},
          tolerance);
    }
  }
  void reduce() {
    if (count <= maximum) return;
    std::array<int, maximum> kept{};
    for (int k = 0; k < maximum; ++k) {
      const P d = SupportPolygon::direction(k, maximum);
      for (int i = 1; i < count; ++i)
        if (points[std::size_t(i)].at.dot(d) > points[std::size_t(kept[std::size_t(k)])].at.dot(d))
          kept[std::size_t(k)] = i;
    }
    std::sort(kept.begin(), kept.end());
    count = int(std::unique(kept.begin(), kept.end()) - kept.begin());
    for (int i = 0; i < count; ++i) points[std::size_t(i)] = points[std::size_t(kept[std::size_t(i)])];
  }
};

}  // namespace sinew::detail
