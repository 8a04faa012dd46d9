// SPDX-License-Identifier: BSL-1.0
#pragma once

// Needs libccd, as convex.hpp does.
#include <sinew/collision/convex.hpp>
#include <sinew/collision/proximity.hpp>
#include <sinew/collision/ray_hits.hpp>

#include <cmath>

namespace sinew {

namespace detail {

/// A primitive of N corners, or a hull (N = 0), where it will be after `time` at the velocity it has; before,
/// where it is less than 0.
template <std::size_t N>
struct MovedPrimitive {
  using V = Eigen::Vector3d;
  CollisionSurface const& surface;
  int element;
  std::array<V, N == 0 ? 1 : N> corners;
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();

  MovedPrimitive(CollisionSurface const& s, int e, double time) : surface(s), element(e) {
    for (std::size_t c = 0; c < corners.size(); ++c)
      corners[c] = s.position[vertex(c)] + time * s.velocity[vertex(c)];
    if constexpr (N == 0) {
      orientation = s.orientation[vertex(0)];
      const V turn = time * s.spin[vertex(0)];
      if (const double angle = turn.norm(); angle > 0)
        orientation = Eigen::Quaterniond(Eigen::AngleAxisd(angle, V(turn / angle))) * orientation;
    }
  }
  std::size_t vertex(std::size_t c) const { return std::size_t(surface.elements[std::size_t(element)][c]); }
  double size() const { return N == 0 ? surface.hull->radius() : 0; }
  ConvexView view(V const& origin) const {
    if constexpr (N == 0)
      return convex_view(PosedHull{*surface.hull, {corners[0], orientation}}, origin);
    else
      return convex_view(corners, origin);
  }
  double centreAlong(V const& n) const {
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < corners.size(); ++c)
      most = std::max(most, n.dot(surface.velocity[vertex(c)]));
    return most;
  }
  /// No point goes faster along n [m/s].
  double fastestAlong(V const& n) const {
    double most = centreAlong(n);
    if constexpr (N == 0) most += surface.spin[vertex(0)].norm() * surface.hull->reach();
    return most;
  }
};

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
    const V outwards = side * (body.turn.transpose() * n), sx = body.turn.transpose() * s,
            tx = body.turn.transpose() * t;
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
    std::array<double, directions> most;
    most.fill(-std::numeric_limits<double>::infinity());
    std::array<int, directions> best{};
    for (std::size_t i = 0; i < body.count; ++i) {
      const P x(sx.dot(body.points[i]), tx.dot(body.points[i]));
      const double up = body.points[i].dot(outwards) / 0.2027;  // tan 0.2
      for (int k = 0; k < directions; ++k)
        if (const double reach = x.dot(around[std::size_t(k)]) + up; reach > most[std::size_t(k)])
          most[std::size_t(k)] = reach, best[std::size_t(k)] = int(i);
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
  /// One of `of` directions around; turned a little, so that no edge of a usual body is across it.
  static P direction(int k, int of) {
    const double angle = 0.1234567 + 2 * 3.14159265358979323846 * k / of;
    return {std::cos(angle), std::sin(angle)};
  }
  P const& operator[](int c) const { return at[std::size_t(c)]; }
  int next(int c) const { return c + 1 < count ? c + 1 : 0; }
  double plane(P const& x) const { return deepestHeight + slope.dot(x - deepest); }
  int edges() const { return count == 2 ? 1 : count == 1 ? 0 : count; }
  std::array<int, 2> edge(int c) const {
    const auto [i, j] = std::minmax(corner[std::size_t(c)], corner[std::size_t(next(c))]);
    return {i, j};
  }
  /// Where it is neither corner nor edge of a segment or a point.
  std::array<int, 2> inside() const {
    if (count == 1) return {corner[0], -1};
    if (count == 2) return edge(0);
    return {-2, -2};
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

/// One place of a manifold: across n, heights along n on both, and corner, edge or face of each.
struct ManifoldPoint {
  Eigen::Vector2d at;
  double heightA, heightB;
  std::array<int, 2> featureA, featureB;
};

/// Where two polygons meet: corners of one inside the other, and crossings of edges; of more than 8 those
/// that are outermost in 8 directions. Points nearer than `tolerance` are one.
struct Manifold {
  using P = Eigen::Vector2d;
  static constexpr int most = 8;
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
        const double turn = SupportPolygon::cross(u, v);
        if (std::abs(turn) <= 1e-9 * u.norm() * v.norm()) continue;
        const double s = SupportPolygon::cross(d, v) / turn, r = SupportPolygon::cross(d, u) / turn;
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
      const std::array<int, 2> corner{a.corner[std::size_t(i)], -1};
      if (!b.holds(a[i], tolerance, innerTolerance)) continue;
      add(ofA ? ManifoldPoint{a[i], mine, other, corner, b.inside()}
              : ManifoldPoint{a[i], other, mine, b.inside(), corner},
          tolerance);
    }
  }
  void reduce() {
    if (count <= most) return;
    std::array<int, most> kept{};
    for (int k = 0; k < most; ++k) {
      const P d = SupportPolygon::direction(k, most);
      for (int i = 1; i < count; ++i)
        if (points[std::size_t(i)].at.dot(d) > points[std::size_t(kept[std::size_t(k)])].at.dot(d))
          kept[std::size_t(k)] = i;
    }
    std::sort(kept.begin(), kept.end());
    count = int(std::unique(kept.begin(), kept.end()) - kept.begin());
    for (int i = 0; i < count; ++i) points[std::size_t(i)] = points[std::size_t(kept[std::size_t(i)])];
  }
};

/// Weights of the corners of a simplex at a place near its corner, edge or face.
template <std::size_t N>
Eigen::Vector3d weights_at(std::array<Eigen::Vector3d, N> const& p, Eigen::Vector3d const& x,
                           std::array<int, 2> const& feature) {
  Eigen::Vector3d w(0, 0, 0);
  if (feature[0] >= 0 && feature[1] < 0) {
    w[feature[0]] = 1;
  } else if (feature[0] >= 0) {
    const auto i = std::size_t(feature[0]), j = std::size_t(feature[1]);
    const Eigen::Vector3d u = p[j] - p[i];
    w[feature[1]] = std::clamp(u.dot(x - p[i]) / u.squaredNorm(), 0.0, 1.0);
    w[feature[0]] = 1 - w[feature[1]];
  } else {
    w = SimplexFrame<double, N>(p).nearest(x - p[0]);
  }
  // an edge between two triangles is the same edge for both
  for (int c = 0; c < 3; ++c)
    if (w[c] < 1e-9) w[c] = 0;
  return w / w.sum();
}

/// Of a triangle: its normal, and the edges behind which the surface goes on flat, or rises on the side that
/// `towards` points to.
struct TriangleAround {
  Eigen::Vector3d normal{0, 0, 0};  // towards the one that it meets, of length 1; 0 where it has no area
  double side = 1;                  // that is, this times the normal of the corners in turn
  std::array<bool, 3> inner{false, false, false};

  TriangleAround(CollisionSurface const& s, int element, std::array<Eigen::Vector3d, 3> const& p,
                 Eigen::Vector3d const& towards) {
    const Eigen::Vector3d n = (p[1] - p[0]).cross(p[2] - p[0]);
    const double length = n.norm();
    if (!(length > 0)) return;
    side = n.dot(towards) >= 0 || !s.bothSide ? 1 : -1;
    normal = side / length * n;
    for (std::size_t c = 0; c < 3 && !s.across.empty(); ++c) {
      const int other = s.across[std::size_t(element)][c];
      if (other < 0) continue;
      const auto e = s.elements[std::size_t(element)];
      const Eigen::Vector3d start = s.position[std::size_t(e[c])],
                            along = s.position[std::size_t(e[(c + 1) % 3])] - start;
      Eigen::Vector3d way = s.position[std::size_t(other)] - start;
      way -= way.dot(along) / std::max(along.squaredNorm(), 1e-300) * along;
      inner[c] = way.dot(normal) >= -0.02 * way.norm();
    }
  }
  /// Whether a place with these weights is inside the surface, not at a border or a ridge.
  bool holds(Eigen::Vector3d const& w) const {
    if (!(normal.squaredNorm() > 0)) return false;
    for (Eigen::Index c = 0; c < 3; ++c)  // the edge behind corner c is away from corner c + 2
      if (w[(c + 2) % 3] <= 0 && !inner[std::size_t(c)]) return false;
    return true;
  }
};

}  // namespace detail

/// Contacts of hulls with hulls, segments and triangles, by their faces: where the two come nearest, or have
/// the least depth, the faces seen from there (up to 11 degrees from the plane across the normal) are cut
/// with one another; what a body stands on is up to 8 contacts with one normal, each with its own distance.
/// With points and spheres it is one contact. Contacts are known again by the corners and edges of the hull.
///
/// Triangles that go on flat into one another act as one face: their inner edges are not felt. A triangle of
/// a one-sided surface (bothSide = false) pushes to its outer side wherever the hull is inside it.
///
/// Under a continuous method, hulls that are not yet near advance by conservative advancement (Mirtich 1996):
/// with the distance d along n, and no point of either approaching faster than w = n.(v_a - v_b) + |w_a| r_a
/// + |w_b| r_b, they cannot meet before d / w; the contact is where they will first meet during the step.
/// What no solver moves comes from where it was a step before. A body that would hit askew and turn over the
/// place that is stopped, and so pass by, is stopped as a whole: where the centres approach by more than a
/// fifth of the radius in a step, and would come nearer than at the impact, the contact keeps them from that
/// without a torque. In such a step angular momentum is not kept; the next ones, in which it is slow, turn
/// it.
template <std::size_t NA, std::size_t NB>
struct HullContacts {
  using V = Eigen::Vector3d;

  template <class Intersection, class Add>
  static void find(PrimitivePair<NA, NB> const& pair, Intersection const& method, Add&& add) {
    static_assert(
        requires { method.limit(); },
        "Sinew: an intersection method that meets hulls has limit(), the distance below which the "
        "response acts.");
    const double limit = method.limit() + pair.proximity(), reach = method.reach() + pair.proximity();
    if constexpr (Intersection::continuous)
      if (const double time = impact(pair, limit); time >= 0) {
        contacts(pair, true, time, limit, time > 0 ? std::numeric_limits<double>::infinity() : reach, add);
        return;
      }
    contacts(pair, false, 0, limit, reach, add);
  }

 private:
  using MovedA = detail::MovedPrimitive<NA>;
  using MovedB = detail::MovedPrimitive<NB>;

  static ConvexContact nearest(MovedA const& a, MovedB const& b, V const& origin) {
    return detail::convex_contact(a.view(origin), b.view(origin));
  }
  static V originOf(MovedA const& a, MovedB const& b) { return NA == 0 ? a.corners[0] : b.corners[0]; }
  // when, of the time since the step began, a surface is where it is: what no solver moves is at the end
  static double present(CollisionSurface const& s, double dt) { return s.solver < 0 ? dt : 0; }

  /// When the two come nearer than `limit` [s]: 0 where they are, -1 where they do not during this step.
  static double impact(PrimitivePair<NA, NB> const& pair, double limit) {
    double time = 0;
    const double near = limit + pair.thickness();
    for (int i = 0; i < 1000; ++i) {
      const MovedA a(pair.a, pair.elementA, time - present(pair.a, pair.dt));
      const MovedB b(pair.b, pair.elementB, time - present(pair.b, pair.dt));
      const ConvexContact c = nearest(a, b, originOf(a, b));
      const double gap = c.distance - near;
      if (gap <= 1e-3 * limit + 1e-9 * (a.size() + b.size())) return time;
      const double rate = a.fastestAlong(c.direction) + b.fastestAlong(-c.direction);
      if (!(rate * (pair.dt - time) > gap)) return -1;
      time += gap / rate;
    }
    return time;
  }

  template <class Add>
  static void contacts(PrimitivePair<NA, NB> const& pair, bool swept, double time, double limit, double reach,
                       Add&& add) {
    const MovedA a(pair.a, pair.elementA, swept ? time - present(pair.a, pair.dt) : 0);
    const MovedB b(pair.b, pair.elementB, swept ? time - present(pair.b, pair.dt) : 0);
    const V origin = originOf(a, b);
    const detail::ConvexView viewA = a.view(origin), viewB = b.view(origin);
    ConvexContact c = detail::convex_contact(viewA, viewB);
    if (c.distance > reach + pair.thickness()) return;

    // the normal of a face of a surface, where the nearest place is inside it
    std::array<bool, 3> innerA{}, innerB{};
    bool ofFace = false;
    auto look =
        [&]<std::size_t N>(
            detail::MovedPrimitive<N> const& p, V const& place, double side, std::array<bool, 3>& inner) {
          if constexpr (N == 2 || N == 3) {
            const V away = side * c.direction;
            const V w = detail::weights_at<N>(p.corners, place + origin, {-2, -2});
            ContactSide at;
            detail::set_side<N>(at, p.surface, p.element, w);
            if constexpr (N == 3) {
              const detail::TriangleAround around(p.surface, p.element, p.corners, away);
              inner = around.inner;
              if (around.holds(w) && (c.distance <= 0 || w.minCoeff() <= 0 || !p.surface.bothSide)) {
                ofFace = true;
                c.direction = side * around.normal;
                c.distance = -detail::depth_along(viewA, viewB, c.direction);
                return true;
              }
            }
            return time > 0 || c.distance <= 0 || p.surface.isLocalMinimum(p.element, at.vertices, away);
          }
          return true;
        };
    if (!look(a, c.pointA, 1, innerA) || !look(b, c.pointB, -1, innerB)) return;
    const V n = c.direction;
    if (swept && addWhole(pair, a, b, c, origin, time, limit, add)) return;

    // across n, along axes of the hull, so that it shows the same corners when it moves
    Eigen::Index axis = 0;
    const Eigen::Matrix3d turn = NA == 0 ? viewA.turn : viewB.turn;
    for (Eigen::Index k = 1; k < 3; ++k)
      if (std::abs(turn.col(k).dot(n)) < std::abs(turn.col(axis).dot(n))) axis = k;
    const V s = n.cross(V(turn.col(axis))).normalized(), t = n.cross(s);

    detail::Manifold manifold;
    auto single = [&] {
      const double along = n.dot(c.pointA);
      auto feature = [&](detail::ConvexView const& view, double side) {
        return detail::SupportPolygon(view, s, t, n, side).inside();
      };
      manifold.add({{s.dot(c.pointA), t.dot(c.pointA)},
                    along,
                    along + c.distance,
                    feature(viewA, 1),
                    feature(viewB, -1)},
                   -1);
    };
    if constexpr (NA == 1 || NB == 1) {
      single();
    } else {
      detail::SupportPolygon faceA(viewA, s, t, n, 1), faceB(viewB, s, t, n, -1);
      mark(faceA, innerA);
      mark(faceB, innerB);
      double size = std::numeric_limits<double>::infinity();
      for (const double r : {viewA.radius, viewB.radius})
        if (r > 0) size = std::min(size, r);
      if (!(size < std::numeric_limits<double>::infinity())) size = 0;
      manifold.meet(faceA, faceB, 1e-3 * size, 1e-9 * size);
      manifold.reduce();
      if (!ofFace) {
        // nothing is nearer than the nearest, which is one of them
        double least = std::numeric_limits<double>::infinity();
        for (int i = 0; i < manifold.count; ++i) {
          auto& p = manifold.points[std::size_t(i)];
          p.heightB = std::max(p.heightB, p.heightA + c.distance);
          least = std::min(least, p.heightB - p.heightA);
        }
        if (!(least <= c.distance + 1e-3 * size)) single();
      }
    }

    for (int i = 0; i < manifold.count; ++i) {
      detail::ManifoldPoint const& p = manifold.points[std::size_t(i)];
      const V across = p.at[0] * s + p.at[1] * t + origin;
      Contact contact;
      contact.normal = n;
      contact.thickness = pair.thickness();
      place(contact.a, a, across + p.heightA * n, p.featureA, n, contact.thickness);
      place(contact.b, b, across + p.heightB * n, p.featureB, -n, contact.thickness);
      contact.limit = limit;
      contact.distance =
          n.dot(position_of(contact.b, pair.b) - position_of(contact.a, pair.a)) - contact.thickness;
      if (contact.distance <= reach) add(contact);
    }
  }

  /// The contact of the centres: `c` with all levers along the normal, and room for what the hulls turn by
  /// in the rest of the step. False where the centres do not come so near, or are slow.
  template <class Add>
  static bool addWhole(PrimitivePair<NA, NB> const& pair, MovedA const& a, MovedB const& b,
                       ConvexContact const& c, V const& origin, double time, double limit, Add&& add) {
    const V n = c.direction;
    double radius = std::numeric_limits<double>::infinity(), turns = 0;
    auto regard = [&](auto const& p) {
      if (p.surface.solver < 0 || !(p.size() > 0)) return;
      const double reach = p.surface.hull->reach();
      radius = std::min(radius, p.size());
      turns += std::min(1.0, p.surface.spin[p.vertex(0)].norm() * (pair.dt - time)) * reach;
    };
    regard(a), regard(b);
    const double approach = a.centreAlong(n) - b.centreAlong(n);
    if (!(approach * pair.dt > 0.2 * radius)) return false;
    Contact contact;
    contact.normal = n;
    contact.thickness = pair.thickness();
    // where c is, n.p is that of the two, whatever the face
    place(contact.a, a, c.pointA + origin, {-3, -3}, n, contact.thickness);
    place(contact.b, b, V(c.pointA + c.distance * n + origin), {-3, -3}, -n, contact.thickness);
    toCentre(contact.a, a, n), toCentre(contact.b, b, n);
    contact.limit = limit;
    const double gap =
        n.dot(position_of(contact.b, pair.b) - position_of(contact.a, pair.a)) - contact.thickness;
    const double room = std::clamp(gap - limit, 0.0, turns);
    contact.thickness += room;
    contact.distance = gap - room;
    if (!(contact.distance - approach * pair.dt < limit)) return false;
    add(contact);
    return true;
  }
  template <std::size_t N>
  static void toCentre(ContactSide& side, detail::MovedPrimitive<N> const& p, V const& n) {
    if constexpr (N == 0)
      if (p.surface.solver >= 0)
        side.lever =
            p.surface.orientation[p.vertex(0)].conjugate() * V(n.dot(p.orientation * side.lever) * n);
  }

  // the edge behind corner c of a triangle is that from c to c + 1
  static void mark(detail::SupportPolygon& face, std::array<bool, 3> const& inner) {
    if (face.count != 3) return;
    if (!inner[0] && !inner[1] && !inner[2]) return;
    for (int k = 0; k < 3; ++k) {
      const int i = face.corner[std::size_t(k)], j = face.corner[std::size_t(face.next(k))];
      face.inner[std::size_t(k)] = inner[std::size_t((i + 1) % 3 == j ? i : j)];
    }
  }

  template <std::size_t N>
  static void place(ContactSide& side, detail::MovedPrimitive<N> const& p, V const& at,
                    std::array<int, 2> const& feature, V const& outwards, double& thickness) {
    if constexpr (N == 0) {
      side.element = p.element;
      side.vertices = {int(p.vertex(0)), -1, -1};
      side.weights = {1, 0, 0};
      side.lever = p.orientation.conjugate() * (at - p.corners[0]);
      side.feature = feature;
    } else {
      detail::set_side<N>(side, p.surface, p.element, detail::weights_at<N>(p.corners, at, feature));
      // what touches a sphere of a rigid does so on its skin
      if (!p.surface.rigid) return;
      const double radius = p.surface.radiusOf(p.element);
      side.lever = p.surface.orientation[p.vertex(0)].conjugate() * (radius * outwards);
      thickness -= radius;
    }
  }
};

/// By advancement: from a place at the distance d of the hull, in the direction n, the ray goes d /
/// (n.direction) to the plane that keeps the hull from it (van den Bergen 2004).
template <>
struct HullRay<CollisionSurface> {
  static RayHit of(Ray const& ray, CollisionSurface const& s, int element, double end) {
    const detail::MovedPrimitive<0> hull(s, element, 0);
    const detail::ConvexView view = hull.view(hull.corners[0]);
    const Eigen::Vector3d start = ray.origin - hull.corners[0];
    const double far = start.norm() + s.hull->reach();
    double t = enter(view, start, ray.direction, far);
    if (t == 0) {
      t = 2 * far - enter(view, start + 2 * far * ray.direction, -ray.direction, 2 * far);
      if (!(t >= 0)) t = 0;
    }
    RayHit hit;
    if (t <= end) hit.distance = t;
    return hit;
  }

 private:
  static double enter(detail::ConvexView const& view, Eigen::Vector3d const& start,
                      Eigen::Vector3d const& direction, double end) {
    constexpr double never = std::numeric_limits<double>::infinity();
    double t = 0;
    for (int i = 0; i < 200; ++i) {
      const std::array<Eigen::Vector3d, 1> at{start + t * direction};
      const detail::ConvexView point{at.data(), 1, Eigen::Matrix3d::Identity(), {0, 0, 0}, at[0], 0, 0};
      const double size = (view.middle - at[0]).norm() + view.radius;
      const detail::Gjk nearest(point, view, {0, 0, 0}, size);
      const double d = nearest.overlapping ? 0 : nearest.difference.norm();
      if (d <= 1e-12 * size) return t;
      const double rate = nearest.difference.dot(direction) / d;
      if (!(rate * (end - t) >= d)) return never;
      t += d / rate;
    }
    return t;
  }
};

}  // namespace sinew
