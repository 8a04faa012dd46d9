// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/contact.hpp>
#include <sinew/core/compiled.hpp>

namespace sinew {

/// Penalty with damping and Coulomb friction. The force on b is, with the gap g = n.u - thickness,
///   N n - k s,   N = max(0, k (limit - g) - c g'),
/// where s is the tangential displacement since the contact sticks, cut to |k s| <= mu N (Cundall, Strack
/// 1979). Under an implicit solver the contact acts from where the step will bring it below the limit, with
/// the force that then is right at the end of the step, and so stops what is fast within one step. What
/// pushed in the last step also acts where it parts slower than gravity brings the two together again in this
/// one, of which the velocity at the start does not know: stacks would hop by g dt^2.
///
/// One linear step has to know beforehand whether the contact sticks or slides. It goes on as at the end of
/// the step before: what stuck within the cone sticks, by a spring that is as implicit as the normal one;
/// what left the cone slides, against mu N of the end of the step before, until it has reversed within a
/// step. What pushes for the first time, or in an impact, slides against mu N in the direction of the
/// velocity at the end of the step: found deep, N is 1 + k dt^2/m times what it will be, and would throw it
/// back otherwise. Asked of the velocity at the start of the step instead, a spring with k dt^2 > m would
/// alternate between sliding and sticking for ever; and the N of where that velocity would lead is, in an
/// impact, 1 + k dt^2/m times what it will be.
struct PenalityContactForceField {
  static constexpr std::string_view className = "PenalityContactForceField";
  static constexpr std::string_view aliases = "PenalityContact PenaltyContact default";

  double dt = 0;  // of the step, set by the manager

  void evaluate(Contact& c, Eigen::Vector3d const& u, Eigen::Vector3d const& rate) const;
  /// The slip is s at the end of the step.
  void settle(Contact& c, Eigen::Vector3d const& u) const;

 private:
  static constexpr int impactSteps = 4;  // for which an impact goes on
  static double elasticPush(Contact const& c, Eigen::Vector3d const& u) {
    return c.stiffness * std::max(0.0, c.limit + c.thickness - c.normal.dot(u));
  }
};

}  // namespace sinew

#if SINEW_DEFINES
#include <cmath>

namespace sinew::detail {

/// The tangential displacement since the contact sticks, and the part of it, `slip`, whose spring force stays
/// in the cone of Coulomb.
struct Friction {
  Eigen::Vector3d tangential, slip;
  double bound;  // |slip| at the edge of the cone
  bool slides;

  Friction(Contact const& c, Eigen::Vector3d const& displacement, double normalForce)
      : tangential(displacement - c.normal.dot(displacement) * c.normal),
        slip(tangential),
        bound(c.friction * normalForce / c.stiffness),
        slides(tangential.norm() > bound) {
    if (slides) slip *= bound / tangential.norm();
  }
};

}  // namespace sinew::detail

namespace sinew {

SINEW_ONCE void PenalityContactForceField::evaluate(Contact& c, Eigen::Vector3d const& u,
                                                    Eigen::Vector3d const& rate) const {
  const double gap = c.normal.dot(u) - c.thickness, gapRate = c.normal.dot(rate);
  c.evaluated.setZero();
  c.sliding.setZero();
  c.stiffnessMatrix.setZero();
  c.dampingMatrix.setZero();
  const double back = c.pushed ? dt * c.fall : 0;
  const double ahead = c.implicit ? std::min(gap, gap + dt * (gapRate - back)) : gap;
  if (!(ahead < c.limit)) return;
  double push = c.stiffness * (c.limit - gap) - c.damping * gapRate;
  if (!c.implicit || gap < c.limit) push = std::max(0.0, push);
  const Eigen::Matrix3d nn = c.normal * c.normal.transpose(),
                        along = Eigen::Matrix3d(Eigen::Matrix3d::Identity()) - nn;
  c.evaluated = push * c.normal;
  c.stiffnessMatrix = c.stiffness * nn;
  c.dampingMatrix = c.damping * nn;
  if (!(c.friction > 0)) return;
  const Eigen::Vector3d tangential = c.frictionState.slip + (u - c.start),
                        next = c.implicit ? Eigen::Vector3d(tangential + dt * rate) : tangential;
  const detail::Friction friction(c, next, elasticPush(c, u));
  const bool stuck = c.implicit && c.frictionState.mode == FrictionState::Mode::sticks;
  if (stuck || !friction.slides) {
    c.evaluated -= c.stiffness * (tangential - c.normal.dot(tangential) * c.normal);
    c.stiffnessMatrix += c.stiffness * along;
    return;
  }
  c.sliding = friction.tangential.normalized();
  const Eigen::Vector3d along1 = along * rate;
  const double bound = c.stiffness * friction.bound, speed = along1.norm();
  if (c.implicit && !c.frictionState.isSteady() && bound > 0 && speed > 0) {
    // mu N / |v| v, in which only v is of the end of the step: what an impact brings to rest does not reverse
    c.evaluated -= bound / speed * along1;
    c.dampingMatrix += bound / speed * along;
    return;
  }
  // the force keeps its size and rotates with the direction t: -dF/du = k m/|s| (I - nn' - tt'), but for a
  // part that goes with the normal force and is not symmetric
  c.evaluated -= bound * c.sliding;
  c.stiffnessMatrix += (bound / friction.tangential.norm()) * (along - c.sliding * c.sliding.transpose());
}

SINEW_ONCE void PenalityContactForceField::settle(Contact& c, Eigen::Vector3d const& u) const {
  c.pushed = c.evaluated.dot(c.normal) > 0;
  if (!(c.friction > 0)) return;
  const Eigen::Vector3d moved = u - c.start;
  const double push = elasticPush(c, u);
  FrictionState& state = c.frictionState;
  const detail::Friction friction(c, state.slip + moved, push);
  const bool slid = !c.sliding.isZero(0), reversed = moved.dot(c.sliding) <= 0;
  state.slip = friction.slip;
  const bool slides = slid ? !reversed : friction.slides;
  state.mode = !(push > 0) ? FrictionState::Mode::apart
               : slides    ? FrictionState::Mode::slides
                           : FrictionState::Mode::sticks;
  // an impact: it pushes twice or half as much as a step before
  const double before = elasticPush(c, c.start);
  const bool impact = push > 2 * before || 2 * push < before;
  state.impact = !(push > 0) ? 0 : impact ? impactSteps : std::max(0, state.impact - 1);
}

}  // namespace sinew
#endif
