// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/lists.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// Turns a part of a surface to and fro about an axis, as a plate would that is glued to it: its points are
/// held at their places relative to each other, and have a moment M cos(2 pi nu t) about the axis together.
/// With a the arms of the points from the axis at rest, b those now, o their feet on the axis, and the mean
/// turn
///   p = sum |b| angle(a, b) / sum |b|,
/// a point has
///   k (o + R(p) a - x) + e w (M cos(2 pi nu t) - m) / |b|,   e = u x b / |b|                      [N]
/// with m the moment of the first parts, so that the sum is M cos(2 pi nu t), and the shares, sum w = 1,
///   w_i ~ sum over triangles of A/3 |a_i| (|a_i|^2 + s_ij^2 + s_ik^2 + t_i^2 + g^2),
/// of mean distances from the axis, s = (|a_i| + |a_j|)/2, t_i = (|a_i| + s_ij + s_ik)/3, g = sum |a|/3, as
/// SOFA has them. The triangles are those of `triangleList`, else those whose points lie at rest between two
/// planes, dmin < u.x < dmax. Turns are less than half a one. The force has no energy, and is that of the
/// start of a step, as in SOFA: steps h have h^2 k below 4 times the mass of a point.
template <class D>
struct OscillatingTorsionPressureForceField {
  using Role = role::ForceField;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  using Vec3 = Vec<Real, 3>;
  static_assert(!D::rigid && D::size == 3,
                "Sinew: OscillatingTorsionPressureForceField is for points in space (Vec3d).");
  static constexpr std::string_view className = "OscillatingTorsionPressureForceField";

  double moment = 0;
  std::vector<int> triangleList{};
  Eigen::Vector3d axis{0, 0, 1}, center{0, 0, 0};
  double penalty = 1000, frequency = 1, dmin = 0, dmax = 0;

  static constexpr auto fields() {
    using F = OscillatingTorsionPressureForceField;
    return field_list(
        field("moment", &F::moment, "N m", "greatest moment about the axis"),
        field("triangleList", &F::triangleList, "", "triangles that are turned", range::nonNegative)
            .numbersOf(Of::triangles),
        field(
            "axis", &F::axis, "", "direction of the axis, and normal of the two planes; of any length but 0"),
        field("center", &F::center, "m", "a point of the axis"),
        field(
            "penalty", &F::penalty, "N/m", "stiffness that holds points in their places", range::nonNegative),
        field("frequency", &F::frequency, "1/s", "oscillations per second", range::nonNegative),
        field("dmin", &F::dmin, "m", "where the lower plane is, axis.x = dmin"),
        field("dmax", &F::dmax, "m", "where the higher plane is; no planes where it is dmin"));
  }

  static constexpr ForceProperties properties() {
    return {.internal = false,
            .objective = false,
            .conservative = false,
            .exactTangent = false,
            .implicit = false};
  }

  bool none = false;  // all of the triangles with a number have been removed
  static constexpr auto state() {
    return field_list(field("none",
                            &OscillatingTorsionPressureForceField::none,
                            "",
                            "all of the triangles with a number have been removed"));
  }

  struct Point {
    std::size_t point;
    Vec3 arm, foot;  // a, o
    Real share;      // w
  };
  std::vector<Point> points{};
  std::vector<Vec3> pulls{};  // the first parts of the forces
  Vec3 direction = Vec3::Zero();

  void init(InitContext<D> const& context) {
    const std::string where =
        text(context.where, ": ", component_name<OscillatingTorsionPressureForceField>());
    TopologyView const& t = context.topology;
    const std::size_t n = context.rest.size();
    detail::check_indices(where, "triangle", t.triangles, n);
    check_numbers(where, "triangleList", triangleList, t.triangles.size(), "triangles", "the topology");
    if (!(axis.norm() > 0))
      throw Error(where, "axis is 0 0 0, which has no direction; give that of the axis");
    if (dmin > dmax) throw Error(where, text("dmin is ", dmin, ", above dmax, ", dmax, "; exchange them"));
    direction = axis.normalized().template cast<Real>();
    const Vec3 middle = center.template cast<Real>();

    std::vector<Vec3> arms;
    for (auto const& x : context.rest) arms.push_back(armOf(x - middle));
    std::vector<Real> shares(n, Real(0));
    std::vector<bool> turned(n, false);
    for (const Triangle& e : chosen(t, context.rest)) {
      auto at = [&](int i) -> Vec3 { return context.rest[std::size_t(e[std::size_t(i)])]; };
      Real d[3];
      for (int i = 0; i < 3; ++i) d[i] = arms[std::size_t(e[std::size_t(i)])].norm();
      const Real area = (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2, mean = (d[0] + d[1] + d[2]) / 3;
      for (int i = 0; i < 3; ++i) {
        const Real s = (d[i] + d[(i + 1) % 3]) / 2, r = (d[i] + d[(i + 2) % 3]) / 2,
                   third = (d[i] + s + r) / 3;
        const auto point = std::size_t(e[std::size_t(i)]);
        turned[point] = true;
        shares[point] += area / 3 * d[i] * (d[i] * d[i] + s * s + r * r + third * third + mean * mean);
      }
    }
    Real sum = 0;
    for (const Real share : shares) sum += share;
    points.clear();
    for (std::size_t i = 0; i < n; ++i)
      if (turned[i])
        points.push_back({i, arms[i], context.rest[i] - arms[i], sum > 0 ? shares[i] / sum : Real(0)});
    if (!points.empty() && !(sum > 0))
      throw Error(where,
                  "all of its triangles lie on the axis, or have no area, so that nothing turns them; "
                  "correct axis, center or triangleList");
    pulls.assign(points.size(), Vec3::Zero());
  }
  /// The warning of init; empty for none.
  std::string_view warning() const {
    return points.empty() && !none ? "it acts on no triangle; give triangleList, or dmin and dmax with all "
                                     "points of one between them"
                                   : "";
  }

  void addForce(MechanicalParams const& p, VecDeriv& f, VecCoord const& x, VecDeriv const&) {
    const Real turn = meanTurn(x);
    const Quat<Real> rotation(Eigen::AngleAxis<Real>(turn, direction));
    Real done = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      Point const& one = points[k];
      pulls[k] = Real(penalty) * (one.foot + rotation * one.arm - x[one.point]);
      done += direction.dot(arm(one, x).cross(pulls[k]));
    }
    const double phase = 2 * std::numbers::pi * frequency * p.time;
    const Real left = Real(moment * std::cos(phase)) - done;
    for (std::size_t k = 0; k < points.size(); ++k) {
      Point const& one = points[k];
      const Vec3 b = arm(one, x);
      f[one.point] += pulls[k];
      if (const Real square = b.squaredNorm(); square > Real(0))
        f[one.point] += direction.cross(b) * (left * one.share / square);
    }
  }
  void addDForce(MechanicalParams const&, VecDeriv&, VecDeriv const&) const {}
  template <class Sink>
  void addToMatrix(MechanicalParams const&, Sink const&) const {}
  double potentialEnergy(VecCoord const&) const { return 0; }

  /// The mean turn of the points about the axis from rest [rad].
  Real meanTurn(VecCoord const& x) const {
    Real sum = 0, weight = 0;
    for (Point const& one : points) {
      const Vec3 b = arm(one, x);
      const Real length = b.norm();
      if (!(length > Real(0)) || !(one.arm.squaredNorm() > Real(0))) continue;
      sum += length * std::atan2(direction.dot(one.arm.cross(b)), one.arm.dot(b));
      weight += length;
    }
    return weight > Real(0) ? sum / weight : Real(0);
  }

 private:
  Vec3 armOf(Vec3 const& fromCenter) const { return fromCenter - direction * direction.dot(fromCenter); }
  Vec3 arm(Point const& one, VecCoord const& x) const { return armOf(x[one.point] - one.foot); }

  std::vector<Triangle> chosen(TopologyView const& t, VecCoord const& rest) const {
    std::vector<Triangle> all;
    for (const int e : triangleList) all.push_back(t.triangles[std::size_t(e)]);
    if (!triangleList.empty() || dmin == dmax || none) return all;
    for (Triangle const& e : t.triangles)
      if (std::all_of(e.begin(), e.end(), [&](int i) {
            const double d = double(direction.dot(rest[std::size_t(i)]));
            return d > dmin && d < dmax;
          }))
        all.push_back(e);
    return all;
  }
};

}  // namespace sinew
