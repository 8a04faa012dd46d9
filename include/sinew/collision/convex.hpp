// SPDX-License-Identifier: BSL-1.0
#pragma once

// Needs libccd (Debian: libccd-dev; BSD licence). Not in sinew.hpp; CMake's target sinew::ccd, there where
// libccd is installed, brings it.
#include <sinew/collision/convex_hull.hpp>
#include <sinew/collision/overlap.hpp>

#include <ccd/ccd.h>

#include <utility>

namespace sinew {

/// A hull at a place: body axes to world axes by `pose`, whose quaternion is of unit length. The hull
/// outlives it.
struct PosedHull {
  ConvexHull const& hull;
  RigidCoord3<double> pose{};
};

/// Where two convex bodies are nearest, or how deep they are in one another.
struct ConvexContact {
  double distance;                // below 0: the depth
  Vec<double, 3> direction;       // unit vector from A to B; moved along it by the depth, B leaves A
  Vec<double, 3> pointA, pointB;  // pointB = pointA + distance direction: surface points, nearest or deepest
  Vec<double, 3> position() const { return (pointA + pointB) / 2; }
};

namespace detail {

/// Points, rotated and translated, and a ball of radius `margin` around each.
struct ConvexView {
  using V = Vec<double, 3>;
  V const* points;
  std::size_t count;
  Mat<double, 3> rotation;
  V shift, middle;
  double radius, margin;
  bool isBox = false;

  /// The directions of the edges, where they are known: of a box, and of up to four points; else -1.
  int edges(std::array<V, 6>& directions) const {
    if (isBox) {
      for (int k = 0; k < 3; ++k) directions[std::size_t(k)] = rotation.col(k);
      return 3;
    }
    if (count > 4) return -1;
    int n = 0;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = i + 1; j < count; ++j)
        directions[std::size_t(n++)] = rotation * (points[j] - points[i]);
    return n;
  }

  V support(V const& d) const {
    const V inBody = rotation.transpose() * d;
    std::size_t best = 0;
    double maximum = points[0].dot(inBody);
    for (std::size_t i = 1; i < count; ++i)
      if (const double h = points[i].dot(inBody); h > maximum) best = i, maximum = h;
    return rotation * points[best] + shift;
  }
};

inline ConvexView convex_view(PosedHull const& h, Vec<double, 3> const& origin) {
  const Mat<double, 3> rotation = h.pose.orientation.toRotationMatrix();
  const Vec<double, 3> shift = h.pose.center - origin;
  return {h.hull.points().data(),
          h.hull.points().size(),
          rotation,
          shift,
          rotation * h.hull.middle() + shift,
          h.hull.radius(),
          0,
          h.hull.isBox()};
}
inline ConvexView convex_view(Sphere<double> const& s, Vec<double, 3> const& origin) {
  const Vec<double, 3> at = s.center - origin;
  return {&s.center, 1, Mat<double, 3>::Identity(), -origin, at, 0, s.radius};
}
template <std::size_t N>
ConvexView convex_view(std::array<Vec<double, 3>, N> const& p, Vec<double, 3> const& origin) {
  Vec<double, 3> middle(0, 0, 0);
  for (auto const& x : p) middle += (x - origin) / double(N);
  double radius = 0;
  for (auto const& x : p) radius = std::max(radius, (x - origin - middle).norm());
  return {p.data(), N, Mat<double, 3>::Identity(), -origin, middle, radius, 0};
}
inline Vec<double, 3> convex_origin(PosedHull const& h) { return h.pose.center; }
inline Vec<double, 3> convex_origin(Sphere<double> const& s) { return s.center; }
template <std::size_t N>
Vec<double, 3> convex_origin(std::array<Vec<double, 3>, N> const& p) {
  return p[0];
}

/// The distance of the points of a and of b + move (without margins) by Gilbert, Johnson, Keerthi 1988: a
/// simplex of differences b - a, whose point nearest to 0 leads to the next difference. Its nearest point is
/// that of the best face (SimplexFrame), so that flat simplices do no harm.
class Gjk {
 public:
  using V = Vec<double, 3>;
  V pointA, pointB, difference;
  bool overlapping = false;
  std::array<V, 4> simplex;  // of the end; 0 lies in it where a and b overlap
  std::size_t count = 0;

  Gjk(ConvexView const& a, ConvexView const& b, V const& move, double size) {
    constexpr double eps = std::numeric_limits<double>::epsilon();
    difference = b.middle + move - a.middle;
    if (!(difference.squaredNorm() > 0)) difference = V(0, 0, 1);
    double last = std::numeric_limits<double>::infinity();
    // exact arithmetic never sees a simplex twice; the number is for rounding
    for (int i = 0; i < 200; ++i) {
      const V onA = a.support(difference), onB = b.support(-difference) + move, w = onB - onA;
      const double square = difference.squaredNorm();
      if (count > 0 && !(square - w.dot(difference) > 4 * eps * size * std::sqrt(square))) return;
      ends_[count] = {onA, onB};
      simplex[count++] = w;
      const V before = difference, beforeA = pointA, beforeB = pointB;
      if (reduce()) {
        overlapping = true;
        return;
      }
      if (difference.norm() <= 8 * eps * size) {
        overlapping = true;
        return;
      }
      if (!(difference.squaredNorm() < last)) {
        if (i > 0) difference = before, pointA = beforeA, pointB = beforeB;
        return;
      }
      last = difference.squaredNorm();
    }
  }

 private:
  std::array<std::pair<V, V>, 4> ends_;

  /// Leaves the corners that carry the point nearest to 0; true where 0 is inside a tetrahedron.
  bool reduce() {
    std::array<double, 4> weights{1, 0, 0, 0};
    std::array<std::size_t, 4> corner{0, 1, 2, 3};
    std::size_t carriers = count;
    auto of = [&]<std::size_t N>(std::array<std::size_t, N> const& index) {
      Simplex<double, N> p;
      for (std::size_t i = 0; i < N; ++i) p[i] = simplex[index[i]];
      const V w = SimplexFrame<double, N>(p).nearest(-p[0]);
      return std::pair(w, weighted_point<double, N>(p, w).squaredNorm());
    };
    auto take = [&](V const& w) {
      for (std::size_t i = 0; i < 3; ++i) weights[i] = w[Eigen::Index(i)];
    };
    if (count == 2) take(of(std::array<std::size_t, 2>{0, 1}).first);
    if (count == 3) take(of(std::array<std::size_t, 3>{0, 1, 2}).first);
    if (count == 4) {
      // 0 is inside where it lies on the inner side of all faces
      const V &p = simplex[0], &q = simplex[1], &r = simplex[2], &s = simplex[3];
      const double whole = (q - p).cross(r - p).dot(s - p);
      const double parts[4] = {q.cross(r).dot(s), -p.cross(r).dot(s), p.cross(q).dot(s), -p.cross(q).dot(r)};
      bool inside = whole != 0;
      for (const double part : parts) inside = inside && part * whole > 0;
      if (inside) return true;
      double minimum = std::numeric_limits<double>::infinity();
      constexpr std::array<std::array<std::size_t, 3>, 4> faces{{{0, 1, 3}, {0, 2, 3}, {1, 2, 3}, {0, 1, 2}}};
      for (auto const& face : faces)
        if (const auto [w, square] = of(face); square < minimum) {
          minimum = square;
          take(w);
          std::copy(face.begin(), face.end(), corner.begin());
        }
      carriers = 3;
    }
    std::size_t kept = 0;
    const auto oldSimplex = simplex;
    const auto oldEnds = ends_;
    difference = pointA = pointB = V(0, 0, 0);
    for (std::size_t i = 0; i < carriers; ++i)
      if (weights[i] > 0) {
        simplex[kept] = oldSimplex[corner[i]];
        ends_[kept] = oldEnds[corner[i]];
        difference += weights[i] * simplex[kept];
        pointA += weights[i] * ends_[kept].first;
        pointB += weights[i] * ends_[kept].second;
        ++kept;
      }
    count = kept;
    return false;
  }
};

/// How far a reaches past the near end of b along n: b, moved by that, touches a.
inline double depth_along(ConvexView const& a, ConvexView const& b, Vec<double, 3> const& n) {
  return (a.support(n) - b.support(-n)).dot(n);
}

/// The direction of libccd's expanding polytope (van den Bergen 2001). libccd takes anything below 2e-16 for
/// zero: it sees the bodies in units of `size`, about the middle of a. Zero where it has no answer.
inline Vec<double, 3> expanding_polytope(ConvexView const& a, ConvexView const& b, double size) {
  using V = Vec<double, 3>;
  struct Body {
    ConvexView const& view;
    V origin;
    double size;
  };
  const Body bodyA{a, a.middle, size}, bodyB{b, a.middle, size};
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = ccd.support2 = [](void const* body, ccd_vec3_t const* d, ccd_vec3_t* to) {
    Body const& k = *static_cast<Body const*>(body);
    const V x = (k.view.support(V(d->v[0], d->v[1], d->v[2])) - k.origin) / k.size;
    for (int i = 0; i < 3; ++i) to->v[i] = x[i];
  };
  ccd.max_iterations = 200;
  ccd.epa_tolerance = 1e-6;
  ccd_real_t depth = 0;
  ccd_vec3_t d{{0, 0, 0}}, position{{0, 0, 0}};
  if (ccdGJKPenetration(&bodyA, &bodyB, &ccd, &depth, &d, &position) != 0) return {0, 0, 0};
  const V n(d.v[0], d.v[1], d.v[2]);
  const double length = n.norm();
  return length > 0.5 && length < 2 ? V(n / length) : V(0, 0, 0);
}

inline ConvexContact convex_contact(ConvexView const& a, ConvexView const& b) {
  using V = Vec<double, 3>;
  const V between = b.middle - a.middle;
  const double size = std::max({between.norm() + a.radius + b.radius, a.margin, b.margin});
  const double margin = a.margin + b.margin;
  if (!(size > 0)) return {0, V(0, 0, 1), a.middle, b.middle};
  Gjk apart(a, b, V(0, 0, 0), size);
  ConvexContact c;
  if (!apart.overlapping) {
    c.distance = apart.difference.norm();
    c.direction = apart.difference / c.distance;
    c.pointA = apart.pointA;
    c.pointB = apart.pointB;
  } else {
    // candidates, the best few of which are each improved
    constexpr int few = 4;
    std::array<std::pair<double, V>, few> best;
    best.fill({std::numeric_limits<double>::infinity(), V(0, 0, 1)});
    auto offer = [&](V const& d) {
      const double length = d.norm();
      if (!(length > 0)) return;
      std::pair<double, V> next{depth_along(a, b, d / length), d / length};
      for (auto& kept : best) {
        if ((next.second - kept.second).squaredNorm() < 1e-6) return;
        if (next.first < kept.first) std::swap(next, kept);
      }
    };
    auto both = [&](V const& d) { d.dot(between) < 0 ? (offer(-d), offer(d)) : (offer(d), offer(-d)); };
    std::array<V, 6> ofA, ofB;
    const int edgesA = a.edges(ofA), edgesB = b.edges(ofB);
    if (edgesA >= 0 && edgesB >= 0) {
      // The faces of the difference of the two are parallel to two edges, so that this is all that it can be
      // (the axes of Gottschalk, Lin, Manocha 1996). Where all edges are parallel there is no face; what is
      // on a line is parted across it.
      auto edge = [&](int i) -> V const& {
        return i < edgesA ? ofA[std::size_t(i)] : ofB[std::size_t(i - edgesA)];
      };
      for (int i = 0; i < edgesA + edgesB; ++i)
        for (int j = i + 1; j < edgesA + edgesB; ++j) both(edge(i).cross(edge(j)));
      for (int i = 0; i < edgesA + edgesB; ++i)
        if (edge(i).squaredNorm() > 0) both(edge(i).unitOrthogonal());
      both(V(0, 0, 1));
    } else {
      // what libccd finds, the normals of the last simplex, which are right for bodies without a volume, the
      // line between the middles, and 26 directions all around
      offer(expanding_polytope(a, b, size));
      for (std::size_t i = 0; i + 2 < apart.count; ++i)
        for (std::size_t j = i + 1; j + 1 < apart.count; ++j)
          for (std::size_t k = j + 1; k < apart.count; ++k)
            both((apart.simplex[j] - apart.simplex[i]).cross(apart.simplex[k] - apart.simplex[i]));
      offer(between);
      for (int k = 0; k < 27; ++k) offer(V(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1));
    }

    // apart along a candidate, the bodies show the face of their difference that is near: its normal to
    // rounding
    double depth = std::numeric_limits<double>::infinity();
    for (auto [h, n] : best) {
      if (!(h < std::numeric_limits<double>::infinity())) continue;
      for (int pass = 0; pass < 8; ++pass) {
        const Gjk outside(a, b, n * (h + size / 2), size);
        if (outside.overlapping) break;
        if (h < depth) depth = h, c.direction = n, c.pointA = outside.pointA;
        const V d = outside.difference / outside.difference.norm();
        const double next = depth_along(a, b, d);
        if (!(next < h)) break;
        h = next, n = d;
      }
    }
    depth = std::max(depth, 0.0);  // they touch
    c.distance = -depth;
    c.pointB = c.pointA + c.distance * c.direction;
  }
  c.pointA += a.margin * c.direction;
  c.pointB -= b.margin * c.direction;
  c.distance -= margin;
  return c;
}

}  // namespace detail

/// A PosedHull, an array of 1, 2 or 3 points (a point, a segment, a triangle), or a Sphere<double>.
template <class Shape>
concept ConvexShape = requires(Shape const& s, Vec<double, 3> const& origin) {
  detail::convex_view(s, origin);
  detail::convex_origin(s);
};

/// Apart: distance and nearest points, right to some machine epsilons of the common size; where two needles
/// or sheets touch, to the square root of epsilon. Overlapping: depth, direction and deepest points of the
/// least motion that parts them. Its direction is the best of what libccd's EPA and 26 directions around lead
/// to, each improved to the rounding of a face of the Minkowski difference: of 20,000 random pairs of hulls
/// none was deeper than need be, or one among hulls of small whole coordinates, which EPA alone has wrong in
/// one of 20 pairs. Of boxes, segments, triangles and points with one another it is in closed form: the best
/// of the directions across two of their edges. Moved by the depth the bodies are apart in any case. Bodies
/// that touch, within 8 epsilons of the size, count as overlapping. A sphere is its centre with a margin, as
/// exact as a point. libccd takes heap memory for each pair of other hulls that overlaps; nothing else does.
template <ConvexShape A, ConvexShape B>
ConvexContact convex_contact(A const& a, B const& b) {
  const Vec<double, 3> origin = detail::convex_origin(a);
  ConvexContact c = detail::convex_contact(detail::convex_view(a, origin), detail::convex_view(b, origin));
  c.pointA += origin;
  c.pointB += origin;
  return c;
}

}  // namespace sinew
