// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/core/lists.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace sinew {

/// Spring from a point to a fixed place; of a rigid body, also from its orientation to a fixed one.
///   E = k/2 |d|^2 + k_a/2 |t|^2                                                               [J]
///   f = -k d,  torque = -k_a t,   d = x - x_rest,  t = rotation vector of q q_rest^-1         [N], [N m]
/// In space the derivative of t by a rotation of the body is J = I + [t]x/2 + s [t]x [t]x with
/// s = (1 - |t|/2 cot(|t|/2)) / |t|^2; its symmetric part is the tangent. Directions that are not active have
/// neither force nor torque; where torques about some axes only are left, they have no energy.
template <class D>
struct RestShapeSpring {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  static constexpr int arity = 1;
  static constexpr bool usesVelocity = false, oneByOne = true;
  static constexpr bool rotates = D::rigid && D::spatial == 3;

  std::array<Real, D::size> active = all();  // 1, or 0 where springs do not act in a direction

  struct Rest {
    std::conditional_t<D::rigid, Coord, std::array<Real, D::size>> place;
    Real stiffness, angularStiffness;
  };
  struct Nothing {};
  struct RotationTangent {
    Mat<Real, 3> derivative;  // symmetric part of J
  };
  using Tangent = std::conditional_t<rotates, RotationTangent, Nothing>;

  SINEW_HD Real energy(Rest const& rest, Coord const (&x)[1]) const {
    const Deriv d = displacement(rest, x[0]);
    return Real(0.5) * d.dot(scaled(rest, d));
  }

  SINEW_HD void force(Rest const& rest, Coord const (&x)[1], Deriv const (&)[1], Deriv (&f)[1],
                      Tangent& tangent) const {
    const Deriv d = displacement(rest, x[0]);
    f[0] = -scaled(rest, d);
    if constexpr (rotates) {
      const Vec<Real, 3> t = d.template tail<3>();
      const Real square = t.squaredNorm(), half = std::sqrt(square) / 2;
      const Real s = half < Real(1e-3) ? Real(1) / 12 + square / 720 : (1 - half / std::tan(half)) / square;
      tangent.derivative = (1 - s * square) * Mat<Real, 3>::Identity() + s * t * t.transpose();
    }
  }

  SINEW_HD void dforce(Rest const& rest, Tangent const& tangent, Deriv const (&dx)[1], Deriv (&df)[1], Real k,
                       Real /*b*/) const {
    Deriv d = dx[0] * (-k);
    if constexpr (rotates) {
      for (int c = 3; c < 6; ++c) d[c] = d[c] * active[std::size_t(c)];
      d.template tail<3>() = (tangent.derivative * d.template tail<3>()).eval();
    }
    df[0] = scaled(rest, d);
  }

  SINEW_INLINE Mat<Real, D::size> block(Rest const& rest, Tangent const& tangent, int, int, Real k,
                                        Real /*b*/) const {
    Deriv diagonal;
    for (int c = 0; c < D::size; ++c) diagonal[c] = -k;
    diagonal = scaled(rest, diagonal);
    Mat<Real, D::size> block;
    for (int c = 0; c < D::size; ++c)
      for (int r = 0; r < D::size; ++r) block(r, c) = r == c ? diagonal[r] : Real(0);
    if constexpr (rotates)
      for (int c = 3; c < 6; ++c)
        for (int r = 3; r < 6; ++r)
          block(r, c) = -k * rest.angularStiffness * tangent.derivative(r - 3, c - 3) *
                        active[std::size_t(r)] * active[std::size_t(c)];
    return block;
  }

 private:
  static constexpr std::array<Real, D::size> all() {
    std::array<Real, D::size> a{};
    for (auto& one : a) one = Real(1);
    return a;
  }
  SINEW_INLINE static Deriv displacement(Rest const& rest, Coord const& x) {
    if constexpr (D::rigid) {
      return D::difference(rest.place, x);
    } else {
      Deriv d;
      for (int c = 0; c < D::size; ++c) d[c] = x[c] - rest.place[std::size_t(c)];
      return d;
    }
  }
  SINEW_INLINE Deriv scaled(Rest const& rest, Deriv d) const {
    for (int c = 0; c < D::size; ++c)
      d[c] = d[c] * ((D::rigid && c >= D::spatial ? rest.angularStiffness : rest.stiffness) *
                     active[std::size_t(c)]);
    return d;
  }
};

/// Springs that hold points at their rest positions, or at places given.
template <class D>
struct RestShapeSpringsForceField {
  using Role = role::ForceField;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  static constexpr std::string_view className = "RestShapeSpringsForceField";
  static constexpr std::string_view aliases = "FixedWeakConstraint";

  std::vector<int> points{};
  std::vector<double> stiffness{100}, angularStiffness{100};
  VecCoord externalRestShape{};
  std::vector<int> externalPoints{};
  std::vector<bool> activeDirections{};

  static constexpr auto fields() {
    using F = RestShapeSpringsForceField;
    return field_list(
        field("points", &F::points, "", "points that are held; none for all of them", range::nonNegative)
            .numbersOf(Of::points)
            .also("indices"),
        field("stiffness",
              &F::stiffness,
              "N/m",
              "force per distance from rest: one value, or one a point",
              range::nonNegative)
            .oneEach(Of::entries),
        field("angularStiffness",
              &F::angularStiffness,
              "N m/rad",
              "torque per angle from rest of rigid bodies: one value, or one a point",
              range::nonNegative)
            .oneEach(Of::entries),
        field("external_rest_shape",
              &F::externalRestShape,
              "m",
              "places to which points are held, instead of their rest positions: those of a state that does "
              "not move"),
        field("external_points",
              &F::externalPoints,
              "",
              "which of these places each point has; none for one after the other",
              range::nonNegative)
            .oneEach(Of::entries),
        field(
            "activeDirections",
            &F::activeDirections,
            "",
            "flags of the directions in which springs act, and of rigid bodies about which; one or none for "
            "all"));
  }

  ForceProperties properties() const {
    const bool some =
        std::find(activeDirections.begin(), activeDirections.end(), false) != activeDirections.end();
    return {.internal = false,
            .objective = false,
            .conservative = !(RestShapeSpring<D>::rotates && some),
            .exactTangent = !RestShapeSpring<D>::rotates};
  }

  bool none = false;  // all of them have been removed

  static constexpr auto state() {
    return field_list(
        field("none", &RestShapeSpringsForceField::none, "", "all of the points have been removed"));
  }

  using Driver = ElementDriver<RestShapeSpring, D>;
  Driver driver{};

  template <class L>
  L law() const {
    L law{};
    for (std::size_t c = 0; c < law.active.size() && !activeDirections.empty(); ++c)
      law.active[c] = typename L::Real(one_or_each(activeDirections, c) ? 1 : 0);
    return law;
  }

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<RestShapeSpringsForceField>());
    const std::size_t n = none ? 0 : points.empty() ? context.rest.size() : points.size();
    // SOFA has a flag for each number of a position, of which a quaternion has four
    const std::size_t directions = std::size_t(D::size),
                      numbers = directions + (RestShapeSpring<D>::rotates ? 1 : 0);
    if (activeDirections.size() > 1 && activeDirections.size() != directions &&
        activeDirections.size() != numbers)
      throw Error(where,
                  text("activeDirections has ",
                       activeDirections.size(),
                       " flags for ",
                       directions,
                       " directions; give one for each"));
    VecCoord const& places = externalRestShape.empty() ? context.rest : externalRestShape;
    const bool elsewhere = !externalRestShape.empty();
    if (!elsewhere && !externalPoints.empty())
      throw Error(where, "external_points are places of external_rest_shape, which is not given; give it");
    const bool listed = !externalPoints.empty();
    if (elsewhere && !none && (listed ? externalPoints.size() : places.size()) != n)
      throw Error(where,
                  text(listed ? "external_points has " : "external_rest_shape has ",
                       listed ? externalPoints.size() : places.size(),
                       " places for ",
                       n,
                       " points; give one for each"));
    if (elsewhere && !listed)  // places stay with their points when some of these go
      for (std::size_t i = 0; i < n; ++i) externalPoints.push_back(int(i));
    check_points(where, "points", points, context.rest.size());
    if (elsewhere && !none)
      check_numbers(where, "external_points", externalPoints, places.size(), "places", "external_rest_shape");
    if (n > 0) {
      check_one_or_each(where, "stiffness", stiffness.size(), n, "points");
      if (D::rigid) check_one_or_each(where, "angularStiffness", angularStiffness.size(), n, "points");
    }
    std::vector<typename Driver::Indices> indices;
    std::vector<typename Driver::Rest> rest;
    for (std::size_t i = 0; i < n; ++i) {
      const int p = points.empty() ? int(i) : points[i];
      indices.push_back({p});
      rest.emplace_back();
      auto const& place = places[std::size_t(elsewhere ? externalPoints[i] : p)];
      if constexpr (D::rigid)
        rest.back().place = place;
      else
        for (int c = 0; c < D::size; ++c) rest.back().place[std::size_t(c)] = place[c];
      rest.back().stiffness = Real(one_or_each(stiffness, i));
      rest.back().angularStiffness = D::rigid ? Real(one_or_each(angularStiffness, i)) : Real(0);
    }
    driver.init(indices, rest);
  }
};

}  // namespace sinew
