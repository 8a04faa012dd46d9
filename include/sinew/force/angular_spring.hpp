// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/core/follow.hpp>
#include <sinew/core/lists.hpp>

#include <cmath>
#include <vector>

namespace sinew {

/// Spring between the orientations q0 and q1 of two rigid bodies.
///   E = k/2 |t|^2,   t = rotation vector of q1 r^-1 q0^-1                                       [J]
///   torque1 = -torque0 = -k t                                                                  [N m]
/// r is the rotation from the first body to the second without torque, in axes of the first. With
/// S = (1 - s |t|^2) I + s t t', s = (1 - |t|/2 cot(|t|/2)) / |t|^2 and A = -[t]x/2, rotations w of the
/// bodies change t by (S + A) w1 - (S - A) w0; the tangent is the symmetric part of what follows for the
/// torques.
template <class D>
struct AngularSpring {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  static constexpr int arity = 2;
  static constexpr bool usesVelocity = false;

  struct Rest {
    Quat<Real> rotation;  // r
    Real stiffness;
  };
  struct Tangent {
    Mat<Real, 3> symmetric, skew;  // S, A
  };

  SINEW_HD Real energy(Rest const& rest, Coord const (&x)[2]) const {
    return Real(0.5) * rest.stiffness * rotationVector(rest, x).squaredNorm();
  }

  SINEW_HD void force(Rest const& rest, Coord const (&x)[2], Deriv const (&)[2], Deriv (&f)[2],
                      Tangent& tangent) const {
    const Vec<Real, 3> t = rotationVector(rest, x);
    for (int i = 0; i < 2; ++i) f[i].template head<3>().setZero();
    f[0].template tail<3>() = rest.stiffness * t;
    f[1].template tail<3>() = -f[0].template tail<3>();
    const Real square = t.squaredNorm(), half = std::sqrt(square) / 2;
    const Real s = half < Real(1e-3) ? Real(1) / 12 + square / 720 : (1 - half / std::tan(half)) / square;
    tangent.symmetric = (1 - s * square) * Mat<Real, 3>::Identity() + s * t * t.transpose();
    tangent.skew << 0, t[2] / 2, -t[1] / 2, -t[2] / 2, 0, t[0] / 2, t[1] / 2, -t[0] / 2, 0;
  }

  SINEW_HD void dforce(Rest const& rest, Tangent const& tangent, Deriv const (&dx)[2], Deriv (&df)[2], Real k,
                       Real /*b*/) const {
    const Vec<Real, 3> w0 = dx[0].template tail<3>(), w1 = dx[1].template tail<3>();
    const Real factor = k * rest.stiffness;
    for (int i = 0; i < 2; ++i) df[i].template head<3>().setZero();
    df[0].template tail<3>() = factor * (tangent.symmetric * (w1 - w0) + tangent.skew * w1);
    df[1].template tail<3>() = factor * (tangent.symmetric * (w0 - w1) - tangent.skew * w0);
  }

  SINEW_HD Mat<Real, 6> block(Rest const& rest, Tangent const& tangent, int i, int j, Real k,
                              Real /*b*/) const {
    Mat<Real, 6> block = Mat<Real, 6>::Zero();
    auto rotation = block.template bottomRightCorner<3, 3>();
    rotation = (i == j ? -k : k) * rest.stiffness * tangent.symmetric;
    if (i != j) rotation += (i < j ? k : -k) * rest.stiffness * tangent.skew;
    return block;
  }

 private:
  SINEW_HD static Vec<Real, 3> rotationVector(Rest const& rest, Coord const (&x)[2]) {
    Coord from;
    from.orientation = x[0].orientation * rest.rotation;
    from.center = x[1].center;
    return D::difference(from, x[1]).template tail<3>();
  }
};

/// Springs against rotation between rigid bodies that follow one another: each body of `indices` but the
/// first is joined to the body before it in the state. They are relaxed at rest. (In SOFA they are where two
/// bodies have the same orientation, and only the second one feels the torque.)
template <class D>
struct AngularSpringForceField {
  static_assert(D::rigid && D::spatial == 3,
                "Sinew: AngularSpringForceField is for rigid bodies in space (Rigid3d).");
  using Role = role::ForceField;
  using DataTypes = D;
  using Real = typename D::Real;
  static constexpr std::string_view className = "AngularSpringForceField";

  std::vector<int> indices{};
  std::vector<double> angularStiffness{100};

  static constexpr auto fields() {
    using F = AngularSpringForceField;
    return field_list(field("indices",
                            &F::indices,
                            "",
                            "bodies, each held by the one before it; the first is not held",
                            range::nonNegative)
                          .numbersOf(Of::points),
                      field("angularStiffness",
                            &F::angularStiffness,
                            "N m/rad",
                            "torque per angle: one value, or one for each of the indices",
                            range::nonNegative)
                          .oneEach(Of::entries));
  }

  static constexpr ForceProperties properties() { return {.exactTangent = false}; }

  bool none = false;  // all of them have been removed

  static constexpr auto state() {
    return field_list(
        field("none", &AngularSpringForceField::none, "", "all of the springs have been removed"));
  }

  /// A spring goes with the body before its own, too; the first of the indices, which has no spring, stands
  /// for any body.
  void follow(Followed const& change) {
    std::vector<bool> stays(indices.size(), true);
    for (std::size_t k = 1; k < indices.size(); ++k)
      stays[k] = change.points.stays(indices[k]) && change.points.stays(indices[k] - 1);
    const Renumbering springs = Renumbering::of(stays);
    springs.filter(angularStiffness);
    springs.filter(indices);
    none = indices.size() < 2;
    if (none)
      indices.clear();
    else if (!change.points.stays(indices[0]))
      indices[0] = indices[1];
  }

  using Driver = ElementDriver<AngularSpring, D>;
  Driver driver{};

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<AngularSpringForceField>());
    check_one_or_each(where, "angularStiffness", angularStiffness.size(), indices.size(), "indices");
    check_numbers(where, "indices", indices, context.rest.size(), "bodies", "the state");
    std::vector<typename Driver::Indices> bodies;
    std::vector<typename Driver::Rest> rest;
    for (std::size_t k = 1; k < indices.size(); ++k) {
      const int i = indices[k];
      if (i == 0)
        throw Error(where,
                    "indices has 0 behind its first entry, but no body stands before body 0; remove it");
      Quat<Real> const& before = context.rest[std::size_t(i - 1)].orientation;
      bodies.push_back({i - 1, i});
      rest.push_back({(before.conjugate() * context.rest[std::size_t(i)].orientation).normalized(),
                      Real(one_or_each(angularStiffness, k))});
    }
    if (bodies.empty() && !none)
      throw Error(where, "there is no spring; give two indices or more, of which all but the first are held");
    driver.init(bodies, rest);
  }
};

}  // namespace sinew
