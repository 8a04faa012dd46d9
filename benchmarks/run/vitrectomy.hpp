// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "vitrectomy/eye.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

/// The vitrectomy as one would write it by hand: no scene and nothing of Sinew, plain loops over springs and
/// points, a tree of boxes around the points for the blade. The eye and the movement of the tool are data.
struct HandVitrectomy {
  using Point = Eigen::Vector3d;
  struct Spring {
    int a, b;
    double stiffness, length;
    Point direction;  // at the last evaluation of forces
    double tension;   // over length
  };
  struct Box {
    Point min, max;
    int left, right;  // children; a leaf has points [left, right) and no box inside it
    bool leaf;
  };

  std::vector<Point> x, v, b, r, p, q, dv;
  std::vector<double> mass;
  std::vector<Spring> springs, cuttable;
  std::vector<int> fixed;
  std::vector<Box> tree;
  std::vector<int> order;  // of the points in the leaves
  std::vector<char> touched;

  // the tool
  std::vector<double> times;
  std::vector<Point> places;
  std::vector<Eigen::Quaterniond> turns;
  std::vector<Point> blade, bladeNow;
  std::vector<std::array<int, 2>> edges;
  double radius, reach, time = 0;
  std::size_t key = 0;

  explicit HandVitrectomy(examples::Eye const& eye)
      : x(eye.position),
        v(x.size(), Point::Zero()),
        b(v),
        r(v),
        p(v),
        q(v),
        dv(v),
        mass(x.size(), 0.0),
        fixed(eye.fixed),
        touched(x.size(), 0),
        times(eye.times),
        blade(eye.blade.positions),
        bladeNow(blade),
        radius(eye.sphereRadius),
        reach(eye.contactDistance) {
    auto take = [](auto const& from, std::vector<Spring>& to) {
      for (auto const& s : from) to.push_back({s.first, s.second, s.stiffness, *s.length, Point::Zero(), 0});
    };
    take(eye.springs, springs);
    take(eye.cuttable, cuttable);
    for (auto const& quad : eye.quads) {
      auto at = [&](std::size_t c) { return x[std::size_t(quad[c])]; };
      const double area = (at(2) - at(0)).cross(at(3) - at(1)).norm() / 2;
      for (const int i : quad) mass[std::size_t(i)] += eye.density * area / 4;
    }
    for (auto const& e : eye.blade.edges) edges.push_back({e[0], e[1]});
    for (auto const& place : eye.places) {
      places.push_back(place.center);
      turns.emplace_back(
          place.orientation.w(), place.orientation.x(), place.orientation.y(), place.orientation.z());
    }
    order.resize(x.size());
    std::iota(order.begin(), order.end(), 0);
    build(0, int(order.size()));
  }

  void step(double h) {
    moveTool(time + h);
    cut();
    const double rK = 0.01, rM = 10, k = h * (h + rK);
    const std::size_t n = x.size();

    // b = h (f - rM M v + (h + rK) K v)
    for (auto& f : b) f.setZero();
    addForces(springs);
    addForces(cuttable);
    for (std::size_t i = 0; i < n; ++i) b[i] -= rM * mass[i] * v[i];
    addStiffness(springs, b, v, h + rK);
    addStiffness(cuttable, b, v, h + rK);
    for (auto& f : b) f *= h;
    for (const int i : fixed) b[std::size_t(i)].setZero();

    // ((1 + h rM) M - h (h + rK) K) dv = b
    double rho = 0;
    for (std::size_t i = 0; i < n; ++i) {
      dv[i].setZero();
      r[i] = p[i] = b[i];
      rho += b[i].squaredNorm();
    }
    for (int iteration = 0; iteration < 25 && rho > 0; ++iteration) {
      for (std::size_t i = 0; i < n; ++i) q[i] = (1 + h * rM) * mass[i] * p[i];
      addStiffness(springs, q, p, -k);
      addStiffness(cuttable, q, p, -k);
      for (const int i : fixed) q[std::size_t(i)].setZero();
      double curvature = 0;
      for (std::size_t i = 0; i < n; ++i) curvature += p[i].dot(q[i]);
      if (!(std::abs(curvature) > 0)) break;
      const double alpha = rho / curvature;
      double next = 0;
      for (std::size_t i = 0; i < n; ++i) {
        dv[i] += alpha * p[i];
        r[i] -= alpha * q[i];
        next += r[i].squaredNorm();
      }
      for (std::size_t i = 0; i < n; ++i) p[i] = r[i] + next / rho * p[i];
      rho = next;
    }
    for (std::size_t i = 0; i < n; ++i) {
      v[i] += dv[i];
      x[i] += h * v[i];
    }
    time += h;
  }

 private:
  void addForces(std::vector<Spring>& list) {
    for (Spring& s : list) {
      const Point d = x[std::size_t(s.b)] - x[std::size_t(s.a)];
      const double length = d.norm(), force = s.stiffness * (length - s.length);
      s.direction = d / length;
      s.tension = force / length;
      b[std::size_t(s.a)] += force * s.direction;
      b[std::size_t(s.b)] -= force * s.direction;
    }
  }
  static void addStiffness(std::vector<Spring> const& list, std::vector<Point>& to,
                           std::vector<Point> const& dx, double factor) {
    for (Spring const& s : list) {
      const Point d = dx[std::size_t(s.b)] - dx[std::size_t(s.a)];
      const Point df =
          factor * (s.tension * d + (s.stiffness - s.tension) * d.dot(s.direction) * s.direction);
      to[std::size_t(s.a)] += df;
      to[std::size_t(s.b)] -= df;
    }
  }

  // linear between two keys, and turning on the shorter way
  void moveTool(double t) {
    while (key + 2 < times.size() && times[key + 1] < t) ++key;
    const double part = std::clamp((t - times[key]) / (times[key + 1] - times[key]), 0.0, 1.0);
    const Point place = places[key] + part * (places[key + 1] - places[key]);
    const Eigen::Quaterniond rotation = turns[key].slerp(part, turns[key + 1]);
    for (std::size_t i = 0; i < blade.size(); ++i) bladeNow[i] = place + rotation * blade[i];
  }

  // median splits, once; the boxes follow
  int build(int first, int last) {
    const int node = int(tree.size());
    tree.push_back({{}, {}, first, last, last - first <= 8});
    if (tree.back().leaf) return node;
    Point low = x[std::size_t(order[std::size_t(first)])], high = low;
    for (int i = first; i < last; ++i) {
      low = low.cwiseMin(x[std::size_t(order[std::size_t(i)])]);
      high = high.cwiseMax(x[std::size_t(order[std::size_t(i)])]);
    }
    int axis = 0;
    (high - low).maxCoeff(&axis);
    const int middle = (first + last) / 2;
    std::nth_element(order.begin() + first, order.begin() + middle, order.begin() + last, [&](int i, int j) {
      return x[std::size_t(i)][axis] < x[std::size_t(j)][axis];
    });
    const int left = build(first, middle), right = build(middle, last);
    tree[std::size_t(node)].left = left;
    tree[std::size_t(node)].right = right;
    return node;
  }
  void refit() {
    for (std::size_t n = tree.size(); n-- > 0;) {
      Box& box = tree[n];
      if (box.leaf) {
        box.min = box.max = x[std::size_t(order[std::size_t(box.left)])];
        for (int i = box.left + 1; i < box.right; ++i) {
          Point const& at = x[std::size_t(order[std::size_t(i)])];
          box.min = box.min.cwiseMin(at);
          box.max = box.max.cwiseMax(at);
        }
      } else {
        box.min = tree[std::size_t(box.left)].min.cwiseMin(tree[std::size_t(box.right)].min);
        box.max = tree[std::size_t(box.left)].max.cwiseMax(tree[std::size_t(box.right)].max);
      }
    }
  }
  // the points near an edge of the blade
  bool near(int node, Point const& a, Point const& end, Point const& low, Point const& high) {
    Box const& box = tree[std::size_t(node)];
    for (int c = 0; c < 3; ++c)
      if (box.min[c] > high[c] || box.max[c] < low[c]) return false;
    if (!box.leaf) {
      const bool left = near(box.left, a, end, low, high), right = near(box.right, a, end, low, high);
      return left || right;
    }
    bool found = false;
    const Point d = end - a;
    for (int i = box.left; i < box.right; ++i) {
      const auto point = std::size_t(order[std::size_t(i)]);
      const double t = std::clamp((x[point] - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
      if ((a + t * d - x[point]).norm() - radius < reach) touched[point] = 1, found = true;
    }
    return found;
  }
  void cut() {
    refit();
    bool any = false;
    const Point around = Point::Constant(radius + reach);
    for (auto const& [i, j] : edges) {
      Point const &a = bladeNow[std::size_t(i)], &end = bladeNow[std::size_t(j)];
      any |= near(0, a, end, a.cwiseMin(end) - around, a.cwiseMax(end) + around);
    }
    if (!any) return;
    std::erase_if(cuttable,
                  [&](Spring const& s) { return touched[std::size_t(s.a)] || touched[std::size_t(s.b)]; });
    std::fill(touched.begin(), touched.end(), 0);
  }
};
