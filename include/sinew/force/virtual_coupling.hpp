// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/lists.hpp>

#include <cmath>
#include <vector>

namespace sinew {

/// A spring and damper that draws a tool to where a haptic device is: the simulation's side of a virtual
/// coupling (Colgate, Stanley and Brown 1995, Issues in the haptic display of tool use). A tool is points or
/// rigid bodies.
///   E = k/2 |d|^2 + k_a/2 |t|^2                                                                [J]
///   f = -k d - c (v - v_t),  torque = -k_a t - c_a (w - w_t),  d = x - x_t                     [N], [N m]
/// with t the rotation vector of q q_t^-1. An implicit step has all of it in its matrix, so that any
/// stiffness and damping are stable in the simulation; of a rotation in space the tangent is the symmetric
/// part. setTarget() sets the target from outside, between steps: that of the end of the step, for a tool
/// that lags least. Without a target the tool is drawn to its rest position.
template <class D>
struct VirtualCoupling {
  using Role = role::ForceField;
  using DataTypes = D;
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "VirtualCoupling";
  static constexpr bool rotates = D::rigid && D::spatial == 3;

  std::vector<int> points{0};
  double stiffness = 500, damping = 2, angularStiffness = 0.5, angularDamping = 0.005;
  VecCoord target{};
  VecDeriv targetVelocity{};
  bool enabled = true;

  static constexpr auto fields() {
    using F = VirtualCoupling;
    return field_list(
        field("points", &F::points, "", "points of the tool", range::nonNegative)
            .numbersOf(Of::points)
            .also("indices"),
        field("stiffness", &F::stiffness, "N/m", "force per distance from the target", range::nonNegative),
        field("damping", &F::damping, "N s/m", "force per speed beside the target's", range::nonNegative),
        field("angularStiffness",
              &F::angularStiffness,
              "N m/rad",
              "torque per angle from the target of rigid bodies",
              range::nonNegative),
        field("angularDamping",
              &F::angularDamping,
              "N m s/rad",
              "torque per angular speed beside the target's of rigid bodies",
              range::nonNegative),
        field("target",
              &F::target,
              "m",
              "where the points are drawn: one for all, or each; their rest positions when not given")
            .oneEach(Of::entries),
        field("targetVelocity",
              &F::targetVelocity,
              "m/s",
              "velocity of the target: one for all, or each; 0 when not given")
            .oneEach(Of::entries),
        field("enabled", &F::enabled, "", "the tool is held; else it is free"));
  }

  static constexpr ForceProperties properties() {
    return {.internal = false, .objective = false, .exactTangent = !rotates};
  }

  VecCoord place{};  // of each point
  VecDeriv speed{};
  std::vector<Mat<Real, 3>> rotationTangent{};  // symmetric part of dt/dq at the last force, where it rotates

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<VirtualCoupling>());
    const std::size_t n = points.size();
    check_points(where, "points", points, context.rest.size());
    if (!target.empty()) check_one_or_each(where, "target", target.size(), n, "points", "one");
    if (!targetVelocity.empty())
      check_one_or_each(where, "targetVelocity", targetVelocity.size(), n, "points", "one");
    place.clear(), speed.clear();
    target.reserve(1), targetVelocity.reserve(1);  // for setTarget
    for (std::size_t i = 0; i < n; ++i) {
      place.push_back(target.empty() ? context.rest[std::size_t(points[i])] : one_or_each(target, i));
      speed.push_back(targetVelocity.empty() ? Deriv(Deriv::Zero()) : one_or_each(targetVelocity, i));
      if constexpr (rotates) {
        if (!(place[i].orientation.norm() > Real(0.5)))
          throw Error(where, text("target [", i, "] has no unit quaternion for orientation; correct it"));
        place[i].orientation.normalize();
      }
    }
    rotationTangent.assign(rotates ? n : 0, Mat<Real, 3>::Identity());
  }

  /// Where the device is, after init, for all points. Throws Error where that is not finite, and leaves the
  /// target as it was.
  void setTarget(Coord const& x, Deriv const& v) {
    if (!D::finite(x) || !v.allFinite())
      throw Error(component_name<VirtualCoupling>(),
                  "the target to follow is not finite; check the pose of the device");
    target.assign(1, x), targetVelocity.assign(1, v);  // a checkpoint has them
    for (auto& p : place) p = x;
    for (auto& s : speed) s = v;
  }

  void addForce(MechanicalParams const&, VecDeriv& f, VecCoord const& x, VecDeriv const& v) {
    if (!enabled) return;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::size_t p = std::size_t(points[i]);
      const Deriv d = D::difference(place[i], x[p]);
      f[p] -= scaled(d, stiffness, angularStiffness) + scaled(v[p] - speed[i], damping, angularDamping);
      if constexpr (rotates) rotationTangent[i] = tangent(Vec<Real, 3>(d.template tail<3>()));
    }
  }
  void addDForce(MechanicalParams const& p, VecDeriv& df, VecDeriv const& dx) const {
    if (!enabled) return;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::size_t at = std::size_t(points[i]);
      df[at] += block(p, i) * dx[at];
    }
  }
  double potentialEnergy(VecCoord const& x) const {
    double sum = 0;
    for (std::size_t i = 0; enabled && i < points.size(); ++i) {
      const Deriv d = D::difference(place[i], x[std::size_t(points[i])]);
      sum += 0.5 * double(d.dot(scaled(d, stiffness, angularStiffness)));
    }
    return sum;
  }
  template <class Sink>
  void addToMatrix(MechanicalParams const& p, Sink const& sink) const {
    for (std::size_t i = 0; i < points.size(); ++i)
      sink.add(points[i], points[i], enabled ? block(p, i) : Mat<Real, D::size>(Mat<Real, D::size>::Zero()));
  }

 private:
  static Deriv scaled(Deriv d, double along, double about) {
    for (int c = 0; c < D::size; ++c) d[c] *= Real(D::rigid && c >= D::spatial ? about : along);
    return d;
  }
  // I + s [t]x [t]x, s = (1 - |t|/2 cot(|t|/2)) / |t|^2
  static Mat<Real, 3> tangent(Vec<Real, 3> const& t) {
    const Real square = t.squaredNorm(), half = std::sqrt(square) / 2;
    const Real s = half < Real(1e-3) ? Real(1) / 12 + square / 720 : (1 - half / std::tan(half)) / square;
    Mat<Real, 3> m;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) m(r, c) = (r == c ? 1 - s * square : Real(0)) + s * t[r] * t[c];
    return m;
  }
  // k K + b B
  Mat<Real, D::size> block(MechanicalParams const& p, std::size_t i) const {
    Mat<Real, D::size> m = Mat<Real, D::size>::Zero();
    const Deriv diagonal = scaled(Deriv::Constant(Real(-p.b)), damping, angularDamping) +
                           scaled(Deriv::Constant(Real(-p.k)), stiffness, angularStiffness);
    for (int c = 0; c < D::size; ++c) m(c, c) = diagonal[c];
    if constexpr (rotates)
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
          m(3 + r, 3 + c) = Real(-p.k * angularStiffness) * rotationTangent[i](r, c) -
                            (r == c ? Real(p.b * angularDamping) : Real(0));
    return m;
  }
};

}  // namespace sinew
