// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/core/ends.hpp>
#include <sinew/core/follow.hpp>
#include <sinew/core/lists.hpp>

#include <limits>
#include <vector>

namespace sinew {

/// Spring between two points whose force is a polynomial of its strain.
///   E = L sum_k a_k |e|^(k+1) / (k + 1),  e = (l - L)/L,  l = |d|,  d = x1 - x0                  [J]
///   f0 = -f1 = F u,  F = sign(e) P(|e|),  P(e) = sum_k a_k e^k, k from 1 on,  u = d/l            [N]
///   df0/dx1 = F/l (I - u u') + P'(|e|)/L u u'
/// Shorter than L it does nothing, unless it pushes.
template <class D>
struct PolynomialSpring {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  static constexpr int arity = 2, degree = 8;
  static constexpr bool usesVelocity = false;

  bool pushes = false;

  struct Rest {
    Real coefficient[degree];  // a_1, a_2, ... [N]
    Real length;
  };
  struct Tangent {
    Deriv direction;
    Real tension, slope;  // F/l, P'/L
  };

  SINEW_HD Real energy(Rest const& rest, Coord const (&x)[2]) const {
    using std::sqrt, std::abs, sinew::sqrt, sinew::abs;
    const Real strain = (sqrt((x[1] - x[0]).squaredNorm()) - rest.length) / rest.length, e = abs(strain);
    Real sum(0);
    for (int k = degree; k > 0; --k) sum = (sum + rest.coefficient[k - 1] * Real(1.0 / (k + 1))) * e;
    if (!pushes) sum = select(strain > Real(0), sum, Real(0));
    return sum * e * rest.length;
  }

  SINEW_HD void force(Rest const& rest, Coord const (&x)[2], Deriv const (&)[2], Deriv (&f)[2],
                      Tangent& tangent) const {
    using std::sqrt, std::abs, sinew::sqrt, sinew::abs;
    const Deriv d = x[1] - x[0];
    const Real length = sqrt(d.squaredNorm()), strain = (length - rest.length) / rest.length, e = abs(strain);
    Real value(0), slope(0);
    for (int k = degree; k > 0; --k) {
      slope = slope * e + rest.coefficient[k - 1] * Real(k);
      value = (value + rest.coefficient[k - 1]) * e;
    }
    // two points in one place have no direction, and no force
    auto acts = length > Real(std::numeric_limits<lane_scalar<Real>>::min());
    if (!pushes) acts = both(acts, strain > Real(0));
    const Real inverse = select(acts, Real(1) / length, Real(0));
    const Real force = select(strain > Real(0), value, -value);
    tangent.direction = d * inverse;
    tangent.tension = force * inverse;
    tangent.slope = slope / rest.length;
    f[0] = tangent.direction * force;
    f[1] = -f[0];
  }

  SINEW_HD void dforce(Rest const&, Tangent const& tangent, Deriv const (&dx)[2], Deriv (&df)[2], Real k,
                       Real /*b*/) const {
    const Deriv d = (dx[1] - dx[0]) * k;
    df[0] = d * tangent.tension +
            tangent.direction * ((tangent.slope - tangent.tension) * d.dot(tangent.direction));
    df[1] = -df[0];
  }

  SINEW_INLINE Mat<Real, D::size> block(Rest const&, Tangent const& tangent, int i, int j, Real k,
                                        Real /*b*/) const {
    const Real factor = i == j ? -k : k;
    Mat<Real, D::size> block;
    for (int c = 0; c < D::size; ++c)
      for (int r = 0; r < D::size; ++r) {
        block(r, c) =
            factor * (tangent.slope - tangent.tension) * tangent.direction[r] * tangent.direction[c];
        if (r == c) block(r, c) += factor * tangent.tension;
      }
    return block;
  }
};

/// Springs with a polynomial of the strain for a force, between points of one body (`E` = Within) or of two
/// (see StiffSpringForceField).
template <class D, class E = Within>
struct PolynomialSpringsForceField {
  using Ends = E;
  template <class Other>
  using WithEnds = PolynomialSpringsForceField<D, Other>;
  static constexpr bool between = !std::is_same_v<E, Within>;
  using Role = std::conditional_t<between, role::InteractionForceField, role::ForceField>;
  using DataTypes = D;
  using Real = typename D::Real;
  static constexpr std::string_view className = "PolynomialSpringsForceField";

  std::vector<int> firstObjectPoints{}, secondObjectPoints{};
  std::vector<double> polynomialStiffness{100};
  std::vector<int> polynomialDegree{1};
  bool computeZeroLength = true;
  std::vector<double> zeroLength{};
  bool compressible = false;
  [[no_unique_address]] E ends{};

  static constexpr auto fields() {
    using F = PolynomialSpringsForceField;
    return field_list(
        field("firstObjectPoints", &F::firstObjectPoints, "", "points at the first ends", range::nonNegative)
            .numbersOf(Of::points),
        field(
            "secondObjectPoints", &F::secondObjectPoints, "", "points at the second ends", range::nonNegative)
            .numbersOf(Of::secondPoints),
        field(
            "polynomialStiffness",
            &F::polynomialStiffness,
            "N",
            "coefficients of strain, its square and so on: those of the first spring, then of the second..."),
        field("polynomialDegree",
              &F::polynomialDegree,
              "",
              "number of coefficients of each spring; one for all, which then share them",
              range::closed(1, PolynomialSpring<D>::degree))
            .oneEach(Of::entries),
        field("computeZeroLength", &F::computeZeroLength, "", "springs are relaxed at rest"),
        field("zeroLength",
              &F::zeroLength,
              "m",
              "else, their lengths without force: one for all, or each",
              range::positive)
            .oneEach(Of::entries),
        field("compressible",
              &F::compressible,
              "",
              "springs that are shorter push, as ones that are longer pull"));
  }

  using Driver = ElementDriver<PolynomialSpring, D>;
  Driver driver{};

  /// The settings of the law, for lanes or one element at a time.
  template <class L>
  L law() const {
    return {compressible};
  }

  bool none = false;  // all of them have been removed

  static constexpr auto state() {
    return field_list(
        field("none", &PolynomialSpringsForceField::none, "", "all of the springs have been removed"));
  }

  /// Each spring takes its coefficients with it.
  void follow(Followed const& change) {
    if (polynomialDegree.size() == 1) return;
    std::vector<bool> stays;
    for (std::size_t s = 0; s < firstObjectPoints.size(); ++s)
      stays.insert(
          stays.end(),
          std::size_t(polynomialDegree[s]),
          change.points.stays(firstObjectPoints[s]) && change.secondPoints.stays(secondObjectPoints[s]));
    Renumbering::of(stays).filter(polynomialStiffness);
  }

  void init(InitContext<D> const& context) { init(context, context); }
  void init(InitContext<D> const& a, InitContext<D> const& b) {
    const std::string where = text(a.where, ": ", component_name<PolynomialSpringsForceField>());
    const std::size_t n = firstObjectPoints.size();
    auto check = [&](bool good, auto const&... message) {
      if (!good) throw Error(where, text(message...));
    };
    if (none) return driver.init({}, {});
    check(n > 0 && secondObjectPoints.size() == n,
          "there are ",
          n,
          " firstObjectPoints and ",
          secondObjectPoints.size(),
          " secondObjectPoints; give both ends of each spring");
    check_one_or_each(where, "polynomialDegree", polynomialDegree.size(), n, "springs", "one");
    std::size_t coefficients = 0;
    for (const int d : polynomialDegree) coefficients += std::size_t(d);
    check(polynomialStiffness.size() == coefficients,
          "polynomialStiffness has ",
          polynomialStiffness.size(),
          " coefficients, but polynomialDegree says ",
          coefficients,
          "; give one for each power of each spring");
    if (!computeZeroLength) check_one_or_each(where, "zeroLength", zeroLength.size(), n, "springs", "one");

    std::vector<typename Driver::Indices> points;
    std::vector<typename Driver::Rest> rest;
    std::size_t next = 0;
    for (std::size_t s = 0; s < n; ++s) {
      const int i = firstObjectPoints[s], j = secondObjectPoints[s];
      check(std::size_t(i) < a.rest.size() && std::size_t(j) < b.rest.size(),
            "spring ",
            s,
            " joins point ",
            i,
            " of ",
            a.where,
            " and point ",
            j,
            " of ",
            b.where,
            ", which have ",
            a.rest.size(),
            " and ",
            b.rest.size(),
            " points, numbered from 0; correct the index");
      check(between || i != j, "spring ", s, " joins point ", i, " to itself; give two points");
      typename Driver::Rest spring{};
      spring.length = computeZeroLength ? (b.rest[std::size_t(j)] - a.rest[std::size_t(i)]).norm()
                                        : Real(one_or_each(zeroLength, s));
      check(spring.length > 0,
            "spring ",
            s,
            " has no length at rest, of which a strain could be; move its points, or give zeroLength");
      if (polynomialDegree.size() == 1) next = 0;
      for (int k = 0; k < one_or_each(polynomialDegree, s); ++k)
        spring.coefficient[k] = Real(polynomialStiffness[next++]);
      points.push_back({i, j});
      rest.push_back(spring);
    }
    driver.init(points, rest);
  }
};

}  // namespace sinew
