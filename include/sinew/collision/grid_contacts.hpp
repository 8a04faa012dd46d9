// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/contact.hpp>
#include <sinew/core/compiled.hpp>

#include <tuple>
#include <vector>

namespace sinew {

/// What find_in_grid needs room for; kept from step to step.
struct GridSearch {
  struct Vertex {
    int vertex;
    double radius;
    int element;
    bool operator<(Vertex const& other) const {
      return std::tuple(vertex, -radius, element) < std::tuple(other.vertex, -other.radius, other.element);
    }
  };
  std::vector<int> near{};
  std::vector<Vertex> vertices{};
};

/// The contacts of a surface with a grid of distances on each of its rigids (CollisionSurface::grid) with
/// another surface, into `found`, the grid on the side a, or b where it is not `first`. They are at the
/// vertices of the other surface, with the radius around them, and at the places inside its lines and
/// triangles that are nearer to the grid's surface, or deeper in it, than their corners; of another grid at
/// the points on its surface. The normal is the gradient of the distance, however deep they are. `limit`:
/// below which distance the response acts; `reach`: up to which there are contacts [m].
void find_in_grid(CollisionSurface const& grid, CollisionSurface const& other, double limit, double reach,
                  bool first, GridSearch& search, std::vector<Contact>& found);

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/collision/closest_points.hpp>
#include <sinew/collision/distance_grid.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace sinew {
namespace detail {

class GridContacts {
 public:
  using V = Eigen::Vector3d;

  GridContacts(CollisionSurface const& grid, CollisionSurface const& other, double limit, double reach,
               bool first, GridSearch& search, std::vector<Contact>& found)
      : surface_(grid),
        grid_(*grid.grid),
        other_(other),
        limit_(limit),
        reach_(reach),
        first_(first),
        search_(search),
        found_(found) {}

  void find() {
    for (int e = 0; e < int(surface_.size()); ++e) {
      element_ = e;
      vertex_ = surface_.elements[std::size_t(e)][0];
      center_ = surface_.position[std::size_t(vertex_)];
      rotation_ = surface_.orientation[std::size_t(vertex_)].toRotationMatrix();
      search_.near.clear();
      other_.tree.near(surface_.boxes[std::size_t(e)], 0, [&](int i) {
        if (!surface_.isOneWith(e, other_, i)) search_.near.push_back(i);
      });
      if (search_.near.empty()) continue;
      std::sort(search_.near.begin(), search_.near.end());
      if (other_.grid)
        ofPoints();
      else if (other_.corners() == 1)
        for (const int i : search_.near) ofVertex(i, other_.elements[std::size_t(i)][0], other_.radiusOf(i));
      else
        ofSimplices();
    }
  }

 private:
  CollisionSurface const& surface_;
  DistanceGrid const& grid_;
  CollisionSurface const& other_;
  double limit_, reach_;
  bool first_;
  GridSearch& search_;
  std::vector<Contact>& found_;
  int element_ = 0, vertex_ = 0;
  V center_{0, 0, 0};
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();

  V inGrid(V const& x) const { return rotation_.transpose() * (x - center_); }

  // of the place of a side, with a radius around it
  void add(ContactSide const& side, V const& x, double radius, DistanceGrid::Place const& place) {
    const double distance = place.distance - radius;
    if (!(distance <= reach_) || place.normal.isZero()) return;
    Contact c;
    c.normal = rotation_ * place.normal;
    c.distance = distance;
    c.limit = limit_;
    c.a.element = element_;
    c.a.vertices[0] = vertex_;
    c.a.weights[0] = 1;
    c.a.lever = place.point;
    c.a.feature = Feature::face();
    c.b = side;
    c.thickness = radius;
    if (radius > 0 && other_.rigid) {  // on its skin
      c.b.lever -= other_.orientation[std::size_t(side.vertices[0])].conjugate() * (radius * c.normal);
      c.thickness = 0;
    }
    c.start = x - (center_ + rotation_ * place.point);
    if (!first_) {
      std::swap(c.a, c.b);
      c.normal = -c.normal;
      c.start = -c.start;
    }
    found_.push_back(c);
  }

  void ofPoints() {
    if (!other_.gridPoints) return;
    for (const int i : search_.near) {
      ContactSide side;
      side.element = i;
      side.vertices[0] = other_.elements[std::size_t(i)][0];
      side.weights[0] = 1;
      const auto v = std::size_t(side.vertices[0]);
      const Eigen::Matrix3d turn = rotation_.transpose() * other_.orientation[v].toRotationMatrix();
      const V from = inGrid(other_.position[v]);
      const AxisBox near = grid_.around.grown(std::max(reach_, 0.));
      for (std::size_t p = 0; p < other_.grid->points.size(); ++p) {
        const V x = from + turn * other_.grid->points[p];
        if (!near.contains(x)) continue;
        side.lever = other_.grid->points[p];
        side.feature = Feature::vertex(int(p));
        add(side, center_ + rotation_ * x, 0, grid_.nearest(x));
      }
    }
  }

  void ofVertex(int element, int vertex, double radius) {
    ContactSide side;
    side.element = element;
    side.vertices[0] = vertex;
    side.weights[0] = 1;
    V const& x = other_.position[std::size_t(vertex)];
    add(side, x, radius, grid_.nearest(inGrid(x)));
  }

  // whether this model, of those on its state, has the places on simplices of so many vertices
  bool takes(int vertices) const {
    return other_.shape == Shape::capsule || other_.smallestAround(vertices) == skeleton(other_.shape);
  }

  void ofSimplices() {
    const int corners = other_.corners();
    if (takes(1)) {
      // each vertex once, with the thickest radius around it
      search_.vertices.clear();
      for (const int i : search_.near)
        for (int c = 0; c < corners; ++c)
          search_.vertices.push_back(
              {other_.elements[std::size_t(i)][std::size_t(c)], other_.radiusOf(i), i});
      std::sort(search_.vertices.begin(), search_.vertices.end());
      for (std::size_t k = 0; k < search_.vertices.size(); ++k) {
        auto const& [vertex, radius, element] = search_.vertices[k];
        if (k == 0 || vertex != search_.vertices[k - 1].vertex) ofVertex(element, vertex, radius);
      }
    }
    for (const int i : search_.near) corners == 2 ? ofInside<2>(i) : ofInside<3>(i);
  }

  // the deepest place of a simplex, by steps down the gradient that stay in it
  template <std::size_t N>
  void ofInside(int element) {
    std::array<V, N> p;
    for (std::size_t c = 0; c < N; ++c)
      p[c] = inGrid(other_.position[std::size_t(other_.elements[std::size_t(element)][c])]);
    V middle(0, 0, 0);
    for (V const& x : p) middle += x / double(N);
    double size = 0;
    for (V const& x : p) size = std::max(size, (x - middle).norm());
    auto best = grid_.nearest(middle);
    const double radius = other_.radiusOf(element);
    if (best.distance - radius - size > reach_) return;
    V at = middle, weights = V::Zero();
    weights.head<Eigen::Index(N)>().setConstant(1. / double(N));
    double least = std::numeric_limits<double>::infinity();  // of the corners
    for (std::size_t c = 0; c < N; ++c) {
      const auto place = grid_.nearest(p[c]);
      least = std::min(least, place.distance);
      if (!(place.distance < best.distance)) continue;
      best = place, at = p[c], weights = V::Unit(Eigen::Index(c));
    }
    const double cell = grid_.cell().minCoeff();
    double step = size;
    for (int i = 0; i < 100 && step > 1e-6 * cell; ++i) {
      const auto trial = closest_points(p, std::array<V, 1>{at - step * best.normal});
      const auto place = grid_.nearest(trial.pointA);
      if (place.distance < best.distance) {
        best = place, at = trial.pointA, weights = trial.weightsA;
      } else {
        step /= 2;
      }
    }
    // what a corner has is its own contact
    if (!(best.distance < least - 1e-3 * cell)) return;
    ContactSide side;
    side.element = element;
    int n = 0;
    for (std::size_t c = 0; c < N; ++c)
      if (weights[Eigen::Index(c)] > 0) {
        side.vertices[std::size_t(n)] = other_.elements[std::size_t(element)][c];
        side.weights[std::size_t(n++)] = weights[Eigen::Index(c)];
      }
    if (n < 2 || !takes(n)) return;
    if (N == 3 && n == 2 && isKnown(side)) return;
    add(side, center_ + rotation_ * at, radius, best);
  }

  // whether the other triangle at the edge has found it
  bool isKnown(ContactSide const& side) const {
    auto of = [](ContactSide const& s) { return std::minmax(s.vertices[0], s.vertices[1]); };
    return std::any_of(found_.begin(), found_.end(), [&](Contact const& c) {
      ContactSide const &its = first_ ? c.b : c.a, &mine = first_ ? c.a : c.b;
      return mine.element == element_ && its.corners() == 2 && of(its) == of(side);
    });
  }
};

}  // namespace detail

SINEW_ONCE void find_in_grid(CollisionSurface const& grid, CollisionSurface const& other, double limit,
                             double reach, bool first, GridSearch& search, std::vector<Contact>& found) {
  detail::GridContacts(grid, other, limit, reach, first, search, found).find();
}

}  // namespace sinew
#endif
