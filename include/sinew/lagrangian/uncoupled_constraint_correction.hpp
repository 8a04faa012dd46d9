// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/constrained_points.hpp>

#include <vector>

namespace sinew {

/// Each point answers to the forces of multipliers on it alone, by a compliance c:
///   u = c h J' f,
/// in the place of A^-1 of its solver. With c = 1/m it is what an explicit solver gives. Rigid bodies have
/// seven numbers, for all of them: the compliance of their centres [1/kg], and the upper triangle of that of
/// their rotations, xx xy xz yy yz zz, in world axes [1/(kg m^2)]; where they are given none, their masses
/// answer, with inertias that turn with them.
template <class D>
struct UncoupledConstraintCorrection {
  using Role = role::ConstraintCorrection;
  using DataTypes = D;
  using Real = typename D::Real;
  static constexpr std::string_view className = "UncoupledConstraintCorrection";
  static constexpr bool rotates = D::rigid && D::spatial == 3;
  static constexpr bool answersByPoint = true;

  double defaultCompliance = rotates ? 0 : 1e-5;
  std::vector<double> compliance{};
  bool useOdeSolverIntegrationFactors = true;
  double correctionPositionFactor = 1, correctionVelocityFactor = 1;

  static constexpr auto fields() {
    using C = UncoupledConstraintCorrection;
    return field_list(
        field("defaultCompliance",
              &C::defaultCompliance,
              "1/kg",
              rotates ? "velocity of the centres for an impulse of 1 N s, where no compliance is "
                        "given; 0: their masses answer"
                      : "velocity for an impulse of 1 N s, of points without a compliance of "
                        "their own",
              rotates ? range::nonNegative : range::positive),
        field("compliance",
              &C::compliance,
              rotates ? "1/kg, 1/(kg m^2)" : "1/kg",
              rotates ? "of all bodies: one number for their centres, and six for their "
                        "rotations, xx xy xz yy yz zz"
                      : "one for all points, or one for each")
            .oneEach(rotates ? Of::nothing : Of::points),
        field("useOdeSolverIntegrationFactors",
              &C::useOdeSolverIntegrationFactors,
              "",
              "else compliances are of positions, the displacement in a step for a force [m/N, "
              "rad/(N m)], and velocities change by that over the length of the step"),
        field("correctionPositionFactor",
              &C::correctionPositionFactor,
              "",
              "part of that displacement that positions take, without the factors of the solver",
              range::nonNegative),
        field("correctionVelocityFactor",
              &C::correctionVelocityFactor,
              "",
              "part of it that velocities take",
              range::nonNegative));
  }

  void init(InitContext<D> const& context) {
    const std::string where = place_of<UncoupledConstraintCorrection>(context);
    if (compliance.empty()) return;
    auto positive = [&](std::size_t k) {
      if (!(compliance[k] > 0))
        throw Error(
            where,
            text("compliance[", k, "] is ", compliance[k], ", so that nothing moves; give a number above 0"));
    };
    if constexpr (rotates) {
      if (compliance.size() != 7)
        throw Error(where,
                    text("compliance has ",
                         compliance.size(),
                         " numbers; give 7: one for the centres and six for rotations, xx xy xz yy yz zz"));
      for (const int k : {0, 1, 4, 6}) positive(std::size_t(k));
      if (!(rotationalCompliance().determinant() > 0) ||
          !(compliance[1] * compliance[4] > compliance[2] * compliance[2]))
        throw Error(
            where,
            "compliance has products xy xz yz by which a body turns against what turns it; give those of a "
            "matrix that is positive definite");
    } else {
      check_one_or_each(where, "compliance", compliance.size(), context.rest.size(), "points");
      for (std::size_t k = 0; k < compliance.size(); ++k) positive(k);
    }
  }

  Eigen::Matrix3d rotationalCompliance() const {
    auto const& c = compliance;
    return (Eigen::Matrix3d() << c[1], c[2], c[3], c[2], c[4], c[5], c[3], c[5], c[6]).finished();
  }
  bool answersByMasses() const { return rotates && compliance.empty() && !(defaultCompliance > 0); }

  void addCorrection(typename D::VecDeriv& u, typename D::VecDeriv const& f, typename D::VecCoord const&,
                     ConstraintFactors const& factors) const {
    const Real by = Real(useOdeSolverIntegrationFactors ? factors.impulse : 1 / factors.position);
    if constexpr (rotates) {
      // beside a compliance of centres alone rotations answer as those of 1 kg m^2
      Mat<Real, 3> rotation = Real(factors.impulse) * Mat<Real, 3>::Identity();
      Real center = by * Real(defaultCompliance);
      if (!compliance.empty()) {
        center = by * Real(compliance[0]);
        rotation = by * rotationalCompliance().template cast<Real>();
      }
      for (std::size_t i = 0; i < u.size(); ++i) {
        u[i].template head<3>() += center * f[i].template head<3>();
        u[i].template tail<3>() += rotation * f[i].template tail<3>();
      }
    } else {
      for (std::size_t i = 0; i < u.size(); ++i)
        u[i] += by * Real(compliance.empty() ? defaultCompliance : one_or_each(compliance, i)) * f[i];
    }
  }
  ConstraintFactors moved(ConstraintFactors factors, double dt, bool ofVelocity) const {
    if (useOdeSolverIntegrationFactors) return factors;
    factors.velocity = correctionVelocityFactor * (ofVelocity ? factors.velocity : factors.position / dt);
    factors.position *= correctionPositionFactor;
    return factors;
  }
};

}  // namespace sinew
