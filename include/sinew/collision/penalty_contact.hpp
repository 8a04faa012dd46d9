// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/contact.hpp>

#include <cmath>

namespace sinew {

namespace detail {
/// What friction holds against at the displacement u: the memory, and what has been added since detection,
/// along the surface; where that asks for more than the cone of Coulomb allows, as much as it allows.
struct Friction {
  Eigen::Vector3d slip;
  double most;    // |slip| at the edge of the cone
  bool slides;

  Friction(Contact const& c, Eigen::Vector3d const& u, double normalForce) {
    const Eigen::Vector3d way = c.slip + (u - c.start);
    slip = way - c.normal.dot(way) * c.normal;
    most = c.friction * normalForce / c.stiffness;
    const double length = slip.norm();
    slides = length > most;
    if (slides) slip *= most / length;
  }
};
}  // namespace detail

/// Penalty with damping and Coulomb friction. The force on b is, with the gap g = n.u - thickness,
///   N n - k s,   N = max(0, k (limit - g) - c g'),
/// where s is the tangential displacement since the contact sticks, cut to |k s| <= mu N (Cundall, Strack 1979).
/// Under an implicit solver the contact acts from where the step will bring it below the limit, with the
/// force that then is right at the end of the step, and so stops what is fast within one step.
struct PenalityContactForceField {
  static constexpr std::string_view className = "PenalityContactForceField";
  static constexpr std::string_view aliases = "PenaltyContact FrictionContact";

  double dt = 0;  // of the step, set by the manager

  void evaluate(Contact& c, Eigen::Vector3d const& u, Eigen::Vector3d const& rate) const {
    const double gap = c.normal.dot(u) - c.thickness, gapRate = c.normal.dot(rate);
    c.force.setZero();
    c.stiffnessMatrix.setZero();
    c.dampingMatrix.setZero();
    const double ahead = c.implicit ? std::min(gap, gap + dt * gapRate) : gap;
    if (!(ahead < c.limit)) return;
    double push = c.stiffness * (c.limit - gap) - c.damping * gapRate;
    if (!c.implicit || gap < c.limit) push = std::max(0.0, push);
    const Eigen::Matrix3d nn = c.normal * c.normal.transpose(), along = Eigen::Matrix3d(Eigen::Matrix3d::Identity()) - nn;
    c.force = push * c.normal;
    c.stiffnessMatrix = c.stiffness * nn;
    c.dampingMatrix = c.damping * nn;
    if (!(c.friction > 0)) return;
    const detail::Friction friction(c, u, c.stiffness * std::max(0.0, c.limit - ahead));
    c.force -= c.stiffness * friction.slip;
    if (!friction.slides) c.stiffnessMatrix += c.stiffness * along;
    // while it slides the force keeps its size and turns with the direction: of the tangent
    // k m/|s| (I - nn' - tt') the part that is left out is not symmetric
    if (friction.slides && friction.most > 0) {
      const Eigen::Vector3d t = friction.slip / friction.most;
      const Eigen::Vector3d way = c.slip + (u - c.start), tangential = way - c.normal.dot(way) * c.normal;
      c.stiffnessMatrix += (c.stiffness * friction.most / tangential.norm()) * (along - t * t.transpose());
    }
  }
  void settle(Contact& c, Eigen::Vector3d const& u) const {
    const double push = c.stiffness * std::max(0.0, c.limit + c.thickness - c.normal.dot(u));
    c.slip = c.friction > 0 ? detail::Friction(c, u, push).slip : Eigen::Vector3d(Eigen::Vector3d::Zero());
  }
};

}  // namespace sinew
