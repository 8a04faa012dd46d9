// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/contact.hpp>

#include <cmath>

namespace sinew {

namespace detail {
/// What friction holds against: the tangential displacement `way` since the contact sticks; where that asks
/// for more than the cone of Coulomb allows, as much as it allows.
struct Friction {
  Eigen::Vector3d way, slip;
  double most;  // |slip| at the edge of the cone
  bool slides;

  Friction(Contact const& c, Eigen::Vector3d const& displacement, double normalForce)
      : way(displacement - c.normal.dot(displacement) * c.normal),
        slip(way),
        most(c.friction * normalForce / c.stiffness),
        slides(way.norm() > most) {
    if (slides) slip *= most / way.norm();
  }
};
}  // namespace detail

/// Penalty with damping and Coulomb friction. The force on b is, with the gap g = n.u - thickness,
///   N n - k s,   N = max(0, k (limit - g) - c g'),
/// where s is the tangential displacement since the contact sticks, cut to |k s| <= mu N (Cundall, Strack
/// 1979). Under an implicit solver the contact acts from where the step will bring it below the limit, with
/// the force that then is right at the end of the step, and so stops what is fast within one step.
struct PenalityContactForceField {
  static constexpr std::string_view className = "PenalityContactForceField";
  static constexpr std::string_view aliases = "PenalityContact PenaltyContact FrictionContact default";

  double dt = 0;  // of the step, set by the manager

  void evaluate(Contact& c, Eigen::Vector3d const& u, Eigen::Vector3d const& rate) const {
    const double gap = c.normal.dot(u) - c.thickness, gapRate = c.normal.dot(rate);
    c.force.setZero();
    c.sliding.setZero();
    c.stiffnessMatrix.setZero();
    c.dampingMatrix.setZero();
    const double ahead = c.implicit ? std::min(gap, gap + dt * gapRate) : gap;
    if (!(ahead < c.limit)) return;
    double push = c.stiffness * (c.limit - gap) - c.damping * gapRate;
    if (!c.implicit || gap < c.limit) push = std::max(0.0, push);
    const Eigen::Matrix3d nn = c.normal * c.normal.transpose(),
                          along = Eigen::Matrix3d(Eigen::Matrix3d::Identity()) - nn;
    c.force = push * c.normal;
    c.stiffnessMatrix = c.stiffness * nn;
    c.dampingMatrix = c.damping * nn;
    if (!(c.friction > 0)) return;
    // whether it slides is asked of the end of an implicit step, too: at the edge of the cone it would stick
    // for ever
    const Eigen::Vector3d way = c.slip + (u - c.start),
                          next = c.implicit ? Eigen::Vector3d(way + dt * rate) : way;
    const detail::Friction friction(c, next, c.stiffness * std::max(0.0, c.limit - ahead));
    // where it would slide back it has come to rest in between, and sticks for a step
    if (!friction.slides || friction.slip.dot(c.slide) < 0) {
      c.force -= c.stiffness * (way - c.normal.dot(way) * c.normal);
      c.stiffnessMatrix += c.stiffness * along;
    } else {
      // the force keeps its size and turns with the direction t: -dF/du = k m/|s| (I - nn' - tt'), but for a
      // part that goes with the normal force and is not symmetric
      c.force -= c.stiffness * friction.slip;
      c.sliding = friction.slip;
      if (friction.most > 0) {
        const Eigen::Vector3d t = friction.slip / friction.most;
        c.stiffnessMatrix +=
            (c.stiffness * friction.most / friction.way.norm()) * (along - t * t.transpose());
      }
    }
  }
  void settle(Contact& c, Eigen::Vector3d const& u) const {
    if (!(c.friction > 0)) return;
    const double push = c.stiffness * std::max(0.0, c.limit + c.thickness - c.normal.dot(u));
    c.slip = detail::Friction(c, c.slip + (u - c.start), push).slip;
    c.slide = c.sliding;
  }
};

}  // namespace sinew
