// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/error.hpp>
#include <sinew/core/mesh.hpp>

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace sinew {

/// The cutting edge of a blade, a polyline, where a movement starts and where it ends [m]. What it sweeps are
/// two triangles for each of its segments.
struct Blade {
  std::vector<Eigen::Vector3d> from{}, to{};
};

/// Where a blade has crossed an edge between two points, a < b: at x = (1 - weight) x_a + weight x_b. The
/// side of a is 1 in front of the blade, -1 behind it. A stroke is what the blade cuts from where it goes in
/// on.
struct Crossing {
  Index a, b;
  double weight;
  int side = 1, stroke = 0;

  bool operator==(Crossing const&) const = default;
};

/// The surface that a blade sweeps.
class SweptBlade {
 public:
  /// Throws Error unless both polylines have as many points, two at least, and all are finite.
  SweptBlade(std::string_view where, Blade const& blade);
  /// The triangles themselves: of a surface that no blade sweeps.
  explicit SweptBlade(std::vector<std::array<Eigen::Vector3d, 3>> const& triangles);

  Eigen::AlignedBox3d const& box() const { return box_; }
  /// The sum of the normals of what it sweeps, as long as the areas are large [m^2].
  Eigen::Vector3d normal() const;

  struct Hit {
    double weight;  // from 0 to 1
    int side;       // of the first point
  };
  /// Where it crosses the edge from x0 to x1 of a body that stands `shift` from where it stood when the blade
  /// started. A point within rounding of the surface lies in front of it, so that a blade along the faces of
  /// a mesh crosses all edges on one side of them.
  std::optional<Hit> crossing(Eigen::Vector3d const& x0, Eigen::Vector3d const& x1,
                              Eigen::Vector3d const& shift) const;

 private:
  struct SweptTriangle {
    Eigen::Vector3d corner[3];
    bool starts[3];  // corners that are of the blade where it starts
  };
  std::vector<SweptTriangle> triangles_{};
  Eigen::AlignedBox3d box_{};

  static double orient(Eigen::Vector3d const& a, Eigen::Vector3d const& b, Eigen::Vector3d const& c,
                       Eigen::Vector3d const& d) {
    return (b - a).cross(c - a).dot(d - a);
  }
};

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>
#include <cmath>

namespace sinew {

SINEW_ONCE SweptBlade::SweptBlade(std::string_view where, Blade const& blade) {
  if (blade.from.size() != blade.to.size() || blade.from.size() < 2)
    throw Error(where,
                text("the blade has ",
                     blade.from.size(),
                     " points where it starts and ",
                     blade.to.size(),
                     " where it ends; give as many of both, two at least"));
  for (auto const* points : {&blade.from, &blade.to})
    for (auto const& p : *points) {
      if (!p.allFinite())
        throw Error(where, "a point of the blade is not finite; correct it, or what moves the blade");
      box_.extend(p);
    }
  for (std::size_t k = 0; k + 1 < blade.from.size(); ++k) {
    triangles_.push_back({{blade.from[k], blade.from[k + 1], blade.to[k + 1]}, {true, true, false}});
    triangles_.push_back({{blade.from[k], blade.to[k + 1], blade.to[k]}, {true, false, false}});
  }
}

SINEW_ONCE SweptBlade::SweptBlade(std::vector<std::array<Eigen::Vector3d, 3>> const& triangles) {
  for (auto const& [a, b, c] : triangles) {
    triangles_.push_back({{a, b, c}, {false, false, false}});
    for (auto const& p : {a, b, c}) box_.extend(p);
  }
}

SINEW_ONCE Eigen::Vector3d SweptBlade::normal() const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (SweptTriangle const& t : triangles_)
    sum += (t.corner[1] - t.corner[0]).cross(t.corner[2] - t.corner[0]) / 2;
  return sum;
}

SINEW_ONCE std::optional<SweptBlade::Hit> SweptBlade::crossing(Eigen::Vector3d const& x0,
                                                               Eigen::Vector3d const& x1,
                                                               Eigen::Vector3d const& shift) const {
  constexpr double rounding = 1e-9;
  const double length = (x1 - x0).norm();
  for (SweptTriangle const& t : triangles_) {
    Eigen::Vector3d c[3];
    for (int k = 0; k < 3; ++k) c[k] = t.starts[k] ? t.corner[k] + shift : t.corner[k];
    const Eigen::Vector3d u = c[1] - c[0], v = c[2] - c[0], area = u.cross(v);
    // a blade that rests, or moves along itself, cuts nothing
    if (area.norm() <= 1e-12 * std::max({u.squaredNorm(), v.squaredNorm(), (u - v).squaredNorm()})) continue;
    const Eigen::Vector3d normal = area.normalized();
    const double d0 = normal.dot(x0 - c[0]), d1 = normal.dot(x1 - c[0]), zero = -rounding * length;
    if ((d0 >= zero) == (d1 >= zero)) continue;
    // inside, or on its border: the line from x0 to x1 passes all three sides on the same side
    double low = 0, high = 0, scale = 0;
    for (int k = 0; k < 3; ++k) {
      const double side = orient(x0, x1, c[k], c[(k + 1) % 3]);
      low = std::min(low, side), high = std::max(high, side);
      scale = std::max(scale, (c[(k + 1) % 3] - c[k]).norm());
    }
    const double margin = rounding * length * length * scale;
    if (low < -margin && high > margin) continue;
    return Hit{std::clamp(d0 / (d0 - d1), 0.0, 1.0), d0 >= zero ? 1 : -1};
  }
  return {};
}

}  // namespace sinew
#endif
