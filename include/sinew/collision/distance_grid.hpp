// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/axis_box.hpp>
#include <sinew/core/compiled.hpp>
#include <sinew/core/mesh.hpp>

#include <Eigen/Geometry>
#include <array>
#include <span>
#include <string>
#include <vector>

namespace sinew {

/// Distances to a closed surface at the points of a regular grid [m], negative inside. Between them they are
/// trilinear: where the surface is smooth over a cell of size h, distances have an error of h^2/8 times the
/// second derivatives of the distance, the curvature of the surface at that distance, and normals one of
/// order h.
struct DistanceGrid {
  using V = Eigen::Vector3d;

  std::array<int, 3> n{0, 0, 0};          // points along the axes
  AxisBox box{};                          // of the grid
  AxisBox around{};                       // of the surface; of a surface around its outside, that of the grid
  std::vector<double> values{};           // of point (i, j, k) at i + n0 (j + n1 k)
  std::vector<Eigen::Vector3d> points{};  // on the surface, by which one grid meets another

  V cell() const {
    V h;
    for (int c = 0; c < 3; ++c) h[c] = (box.max[c] - box.min[c]) / (n[std::size_t(c)] - 1);
    return h;
  }

  struct Sample {
    double distance;
    V gradient;
  };
  /// The interpolated distance with its gradient at a place in the box.
  Sample sample(V const& x) const;

  /// The nearest place on the surface: the distance to it, negative inside; the direction out of it, of
  /// length 1, or zero where that is not known, as in the middle of a ball; and where it is, x - distance
  /// normal. Beyond the box it is that of the nearest place in the box: no nearer than the surface, and near
  /// to the box right.
  struct Place {
    double distance;
    V normal, point;
  };
  Place nearest(V const& x) const;

  /// Inside becomes outside.
  void flip();
};

/// How a grid is laid: points along the axes, at least 2, and a box in which the surface has to be; by
/// default that of the surface and a tenth of its size around it.
struct GridLayout {
  std::array<int, 3> n{64, 64, 64};
  AxisBox box{};
};

/// Where a shape stands in the axes of its grid.
struct ShapeFrame {
  Eigen::Vector3d translation{0, 0, 0};
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

/// Around a ball, and a cube of half side `half`.
DistanceGrid grid_of_ball(std::string const& where, double radius, ShapeFrame const& at,
                          GridLayout const& layout);
DistanceGrid grid_of_cube(std::string const& where, double half, ShapeFrame const& at,
                          GridLayout const& layout);

/// Around a closed surface, whichever of its sides its triangles show. Distances are those of the nearest
/// place on it, their sign that of the normal there: of edges and corners that of the triangles around, by
/// their angles (Baerentzen, Aanaes 2005). Points in one place become one. Throws Error where it is not
/// closed.
DistanceGrid grid_of_surface(std::string const& where, std::span<Eigen::Vector3d const> positions,
                             std::span<Triangle const> triangles, std::span<Quad const> quads,
                             GridLayout const& layout);

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/collision/bounding_tree.hpp>
#include <sinew/collision/closest_points.hpp>
#include <sinew/core/error.hpp>
#include <sinew/topology/inertia.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>

namespace sinew {

SINEW_ONCE DistanceGrid::Sample DistanceGrid::sample(V const& x) const {
  std::size_t first[3];
  double t[3];
  const V h = cell();
  for (int c = 0; c < 3; ++c) {
    const double at = (x[c] - box.min[c]) / h[c];
    const double low = std::clamp(std::floor(at), 0., double(n[std::size_t(c)] - 2));
    first[c] = std::size_t(low);
    t[c] = at - low;
  }
  const std::size_t dy = std::size_t(n[0]), dz = dy * std::size_t(n[1]);
  double const* const v = values.data() + first[0] + dy * first[1] + dz * first[2];
  // along x, then y, then z: values, and their slopes so far
  double value[2], slopeX[2], slopeY[2];
  for (std::size_t k = 0; k < 2; ++k) {
    double const* const p = v + k * dz;
    const double low = p[0] + t[0] * (p[1] - p[0]), high = p[dy] + t[0] * (p[dy + 1] - p[dy]);
    value[k] = low + t[1] * (high - low);
    slopeX[k] = (1 - t[1]) * (p[1] - p[0]) + t[1] * (p[dy + 1] - p[dy]);
    slopeY[k] = high - low;
  }
  return {value[0] + t[2] * (value[1] - value[0]),
          {(slopeX[0] + t[2] * (slopeX[1] - slopeX[0])) / h[0],
           (slopeY[0] + t[2] * (slopeY[1] - slopeY[0])) / h[1],
           (value[1] - value[0]) / h[2]}};
}

SINEW_ONCE DistanceGrid::Place DistanceGrid::nearest(V const& x) const {
  V in = x;
  for (int c = 0; c < 3; ++c) in[c] = std::clamp(x[c], box.min[c], box.max[c]);
  const Sample s = sample(in);
  const double length = s.gradient.norm();
  const V normal = length > 1e-9 ? V(s.gradient / length) : V(0, 0, 0);
  const V point = in - s.distance * normal;
  const V apart = x - point;
  const double far = apart.norm();
  if (in == x || !(far > 0)) return {s.distance, normal, point};
  return s.distance < 0 ? Place{-far, -apart / far, point} : Place{far, apart / far, point};
}

SINEW_ONCE void DistanceGrid::flip() {
  for (double& d : values) d = -d;
  around = box;
}

namespace detail {

// lays out the grid around a surface
inline DistanceGrid empty_grid(std::string const& where, AxisBox const& surface, GridLayout const& layout) {
  double count = 1;
  for (const int n : layout.n) {
    if (n < 2)
      throw Error(where,
                  text("a grid of ", n, " points along an axis has no cells; give nx, ny and nz at least 2"));
    count *= n;
  }
  if (count > double(1 << 28))
    throw Error(where,
                text("a grid of ",
                     layout.n[0],
                     " x ",
                     layout.n[1],
                     " x ",
                     layout.n[2],
                     " points takes more than 2 GB; give fewer"));
  DistanceGrid grid;
  grid.n = layout.n;
  grid.around = surface;
  grid.box = layout.box;
  if (layout.box.empty()) {
    const Eigen::Vector3d margin = 0.1 * (surface.max - surface.min);
    grid.box = {surface.min - margin, surface.max + margin};
  }
  grid.box.include(surface);
  for (int c = 0; c < 3; ++c)
    if (!(grid.box.max[c] > grid.box.min[c]))
      throw Error(where,
                  "the surface is flat, and no distance to it is negative; give a surface with an inside");
  grid.values.resize(std::size_t(count));
  return grid;
}

// values[...] = distance(place), row by row
template <class F>
void fill_grid(DistanceGrid& grid, F&& distance) {
  const Eigen::Vector3d h = grid.cell();
  std::size_t at = 0;
  for (int k = 0; k < grid.n[2]; ++k)
    for (int j = 0; j < grid.n[1]; ++j)
      for (int i = 0; i < grid.n[0]; ++i)
        grid.values[at++] =
            distance(Eigen::Vector3d(grid.box.min + h.cwiseProduct(Eigen::Vector3d(i, j, k))));
}

// A closed surface with the normals of its triangles, edges and corners.
class SignedSurface {
 public:
  using V = Eigen::Vector3d;
  AxisBox box{};
  std::vector<V> points{};

  SignedSurface(std::string const& where, std::span<V const> positions, std::span<Triangle const> triangles,
                std::span<Quad const> quads) {
    check_indices(where, "triangle", triangles, positions.size());
    check_indices(where, "quad", quads, positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i)
      if (!positions[i].allFinite())
        throw Error(where, text("point ", i, " of the surface is not finite; correct it"));
    merge(positions);
    auto add = [&](Index a, Index b, Index c) {
      const Triangle t{of_[std::size_t(a)], of_[std::size_t(b)], of_[std::size_t(c)]};
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) triangles_.push_back(t);
    };
    for (Triangle const& t : triangles) add(t[0], t[1], t[2]);
    for (Quad const& q : quads) add(q[0], q[1], q[2]), add(q[0], q[2], q[3]);
    mass_properties(where, points, triangles_, {});  // that it is closed, and has an inside
    double volume = 0;
    for (Triangle const& t : triangles_) {
      const auto p = corners(t);
      volume += (p[0] - points[0]).cross(p[1] - points[0]).dot(p[2] - points[0]);
    }
    if (volume < 0)
      for (Triangle& t : triangles_) std::swap(t[1], t[2]);
    findNormals();
    std::vector<AxisBox> boxes;
    for (Triangle const& t : triangles_) {
      AxisBox b;
      for (V const& p : corners(t)) b.include(p);
      box.include(b);
      boxes.push_back(b);
    }
    tree_.build(boxes, where);
  }

  /// `reach`: no less than the distance.
  double distance(V const& x, double reach) const {
    auto to = [&](int t) { return closest_points(corners(triangles_[std::size_t(t)]), std::array{x}); };
    const auto best = tree_.nearest(x, reach, [&](int t) { return std::sqrt(to(t).squaredDistance); });
    const auto closest = to(best.index);
    const V normal = normalAt(std::size_t(best.index), closest.weightsA);
    return normal.dot(x - closest.pointA) < 0 ? -best.distance : best.distance;
  }

 private:
  std::vector<Index> of_{};  // the point that each of the file became
  std::vector<Triangle> triangles_{};
  std::vector<V> normals_{}, atPoint_{};
  std::vector<std::array<V, 3>> atEdge_{};  // of a triangle, behind each corner
  BoundingTree tree_{};

  std::array<V, 3> corners(Triangle const& t) const {
    return {points[std::size_t(t[0])], points[std::size_t(t[1])], points[std::size_t(t[2])]};
  }
  void merge(std::span<V const> positions) {
    std::vector<Index> order(positions.size());
    std::iota(order.begin(), order.end(), 0);
    auto key = [&](Index i) {
      V const& p = positions[std::size_t(i)];
      return std::array{p[0], p[1], p[2]};
    };
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
      return std::pair(key(a), a) < std::pair(key(b), b);
    });
    of_.resize(positions.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (i == 0 || key(order[i]) != key(order[i - 1])) points.push_back(positions[std::size_t(order[i])]);
      of_[std::size_t(order[i])] = Index(points.size()) - 1;
    }
  }
  void findNormals() {
    atPoint_.assign(points.size(), V(0, 0, 0));
    struct Side {
      Edge edge;
      std::size_t triangle, behind;
    };
    std::vector<Side> sides;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      const auto p = corners(triangles_[i]);
      const V across = (p[1] - p[0]).cross(p[2] - p[0]);
      const double area = across.norm();
      normals_.push_back(area > 0 ? V(across / area) : V(0, 0, 0));
      for (std::size_t c = 0; c < 3; ++c) {
        const V u = p[(c + 1) % 3] - p[c], v = p[(c + 2) % 3] - p[c];
        atPoint_[std::size_t(triangles_[i][c])] += std::atan2(u.cross(v).norm(), u.dot(v)) * normals_[i];
        const auto [a, b] = std::minmax(triangles_[i][c], triangles_[i][(c + 1) % 3]);
        sides.push_back({{a, b}, i, c});
      }
    }
    std::sort(sides.begin(), sides.end(), [](Side const& a, Side const& b) {
      return std::tie(a.edge, a.triangle) < std::tie(b.edge, b.triangle);
    });
    atEdge_.resize(triangles_.size());
    for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
      V sum(0, 0, 0);
      for (; last < sides.size() && sides[last].edge == sides[first].edge; ++last)
        sum += normals_[sides[last].triangle];
      for (std::size_t i = first; i < last; ++i) atEdge_[sides[i].triangle][sides[i].behind] = sum;
    }
  }
  V normalAt(std::size_t triangle, V const& weights) const {
    constexpr double none = 1e-9;  // rounding of weights
    int count = 0, at = 0, without = 0;
    for (int c = 0; c < 3; ++c)
      if (weights[c] > none)
        ++count, at = c;
      else
        without = c;
    if (count == 1) return atPoint_[std::size_t(triangles_[triangle][std::size_t(at)])];
    if (count == 2) return atEdge_[triangle][std::size_t(without + 1) % 3];
    return normals_[triangle];
  }
};

}  // namespace detail

SINEW_ONCE DistanceGrid grid_of_ball(std::string const& where, double radius, ShapeFrame const& at,
                                     GridLayout const& layout) {
  AxisBox box;
  box.include(at.translation);
  DistanceGrid grid = detail::empty_grid(where, box.grown(radius), layout);
  detail::fill_grid(grid, [&](Eigen::Vector3d const& x) { return (x - at.translation).norm() - radius; });
  // spread evenly along a spiral
  constexpr int count = 200;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.) / count, r = std::sqrt(1 - z * z),
                 angle = std::numbers::pi * (3 - std::sqrt(5.)) * i;
    grid.points.push_back(at.translation +
                          radius * Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), z));
  }
  return grid;
}

SINEW_ONCE DistanceGrid grid_of_cube(std::string const& where, double half, ShapeFrame const& at,
                                     GridLayout const& layout) {
  std::vector<Eigen::Vector3d> points;
  AxisBox box;
  constexpr int side = 4;  // cells of a face along a side
  for (int i = 0; i <= side; ++i)
    for (int j = 0; j <= side; ++j)
      for (int k = 0; k <= side; ++k) {
        auto onFace = [](int a) { return a == 0 || a == side; };
        if (!onFace(i) && !onFace(j) && !onFace(k)) continue;
        const Eigen::Vector3d p = half * (Eigen::Vector3d(i, j, k) * (2. / side) - Eigen::Vector3d::Ones());
        points.push_back(at.translation + at.rotation * p);
        box.include(points.back());
      }
  DistanceGrid grid = detail::empty_grid(where, box, layout);
  grid.points = std::move(points);
  detail::fill_grid(grid, [&](Eigen::Vector3d const& x) {
    const Eigen::Vector3d out =
        (at.rotation.conjugate() * (x - at.translation)).cwiseAbs() - Eigen::Vector3d::Constant(half);
    return out.cwiseMax(0).norm() + std::min(out.maxCoeff(), 0.);
  });
  return grid;
}

SINEW_ONCE DistanceGrid grid_of_surface(std::string const& where, std::span<Eigen::Vector3d const> positions,
                                        std::span<Triangle const> triangles, std::span<Quad const> quads,
                                        GridLayout const& layout) {
  const detail::SignedSurface surface(where, positions, triangles, quads);
  DistanceGrid grid = detail::empty_grid(where, surface.box, layout);
  grid.points = surface.points;
  // no place is farther than that before it and the way from there
  Eigen::Vector3d last(0, 0, 0);
  double reach = std::numeric_limits<double>::infinity();
  detail::fill_grid(grid, [&](Eigen::Vector3d const& x) {
    const double d = surface.distance(x, (reach + (x - last).norm()) * (1 + 1e-9));
    last = x, reach = std::abs(d);
    return d;
  });
  return grid;
}

}  // namespace sinew
#endif
