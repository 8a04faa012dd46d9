// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/proximity.hpp>
#include <sinew/collision/time_of_impact.hpp>
#include <sinew/core/component.hpp>

namespace sinew {

/// Contacts between primitives that are near each other, or will be during the step: at the time of their
/// first impact, by conservative advancement (time_of_impact.hpp), so that nothing is passed through, however
/// fast.
///
/// `continuousCollisionType` says where corners go in the step: by `inertia` on as fast as they are, and an
/// implicit solver meets what they meet at the end of the step; by `freeMotion` straight to where the forces
/// of the step take them without multipliers, x + t (x_free - x) / dt, so that what starts to fall or is
/// thrown in this step is seen, and what forces hold back is not. Contacts are found behind the free motion
/// then, and so they are answered by multipliers alone, under a FreeMotionAnimationLoop. `none`: what is near
/// at the start.
struct ContinuousIntersection {
  using Role = role::Intersection;
  static constexpr std::string_view className = "ContinuousIntersection";
  static constexpr std::string_view aliases = "CCDTightInclusionIntersection";
  static constexpr bool continuous = true;

  double alarmDistance = 1;
  double contactDistance = 0.5;
  StepMotion continuousCollisionType = StepMotion::inertia;

  static constexpr auto fields() {
    return proximity_fields<ContinuousIntersection>(field(
        "continuousCollisionType",
        &ContinuousIntersection::continuousCollisionType,
        "",
        "where points go in a step: inertia, on as fast as they are; freeMotion, where forces take them "
        "without multipliers; none, nowhere"));
  }

  StepMotion motion() const { return continuousCollisionType; }

  double reach() const { return std::max(alarmDistance, contactDistance); }
  double limit() const { return contactDistance; }

  template <Shape A, Shape B>
  std::optional<Contact> intersect(PrimitivePair<A, B> const& pair) const {
    const auto a = pair.cornersA();
    const auto b = pair.cornersB();
    const double limit = contactDistance + pair.proximity();
    auto now = contact_at(pair, a, b);
    // as far behind a one-sided triangle as in front of it: what is farther is on the other side of the body
    const double far = reach() + pair.proximity() + pair.thickness();
    if (now && now->start.norm() > far) now.reset();
    // What rests stays at the limit, to the tolerance of a solver: on the way from there a search for the
    // impact would go by such gaps, for nothing but the same contact.
    const double resting = limit + 0.01 * contactDistance;
    if (now && !is_of_pair(pair, *now)) {
      if (now->distance <= resting) return std::nullopt;  // another pair has the contact there
      now.reset();
    }
    if (now) now->limit = limit;
    if (now && now->distance <= resting) return now;
    // what no solver moves stands where it will be at the end of the step, and comes from before
    auto moved = [&](auto corners, CollisionSurface const& s, int element, int first, double time) {
      if (s.solver < 0) time -= pair.dt;
      for (std::size_t c = 0; c < corners.size(); ++c)
        corners[c] +=
            time * s.velocity[std::size_t(s.elements[std::size_t(element)][std::size_t(first) + c])];
      return corners;
    };
    auto atA = [&](double time) { return moved(a, pair.a, pair.elementA, pair.firstA, time); };
    auto atB = [&](double time) { return moved(b, pair.b, pair.elementB, pair.firstB, time); };
    const auto impact = time_of_impact(atA(0), atA(pair.dt), atB(0), atB(pair.dt), pair.thickness() + limit);
    if (!impact) return now;
    const double time = *impact * pair.dt;
    auto then = contact_at(pair, atA(time), atB(time), false);
    if (!then || !is_of_pair(pair, *then)) return std::nullopt;
    then->limit = limit;
    then->distance =
        then->normal.dot(position_of(then->b, pair.b) - position_of(then->a, pair.a)) - then->thickness;
    // one-sided triangles stop what comes from outside, and let out what comes from behind
    if (then->distance < -then->thickness &&
        (is_of_one_sided_face(then->a, pair.a) || is_of_one_sided_face(then->b, pair.b)))
      return std::nullopt;
    return then;
  }
};

}  // namespace sinew
