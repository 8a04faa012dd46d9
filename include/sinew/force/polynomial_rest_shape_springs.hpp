// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/core/follow.hpp>
#include <sinew/core/lists.hpp>

#include <array>
#include <cmath>
#include <vector>

namespace sinew {

/// Spring from a point to a fixed place, whose force is a polynomial of how far it is:
///   f = -g(l) d,   g = P(l/L)/q,   P(e) = sum_k a_k e^k, k from 1 on,   q^2 = l^2 + exp(s - c l^2)   [N]
///   E = int_0^l g(r) r dr,   df/dx = -(g I + g'/l d d')
/// with d from the place and l its length. The exponential keeps the direction d/q from jumping where d
/// vanishes: with c = 0 and s far below 0 it is d/l. The energy is integrated by 16 Gauss points.
template <class D>
struct PolynomialHold {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  static constexpr int arity = 1, degree = 8;
  static constexpr bool usesVelocity = false, oneByOne = true, symmetricBlocks = true;

  Real shift{0}, scale{1};  // s, c

  struct Rest {
    Real coefficient[degree];  // a_1, a_2, ... [N]
    Real length;               // L
    std::array<Real, D::size> place;
  };
  struct Tangent {
    Deriv direction;     // d/l
    Real across, along;  // g, g + g' l
  };

  Real energy(Rest const& rest, Coord const (&x)[1]) const {
    // abscissas and weights of the half with positive abscissas
    static constexpr double at[8] = {0.0950125098376374,
                                     0.2816035507792589,
                                     0.4580167776572274,
                                     0.6178762444026438,
                                     0.7554044083550030,
                                     0.8656312023878318,
                                     0.9445750230732326,
                                     0.9894009349916499},
                            weight[8] = {0.1894506104550685,
                                         0.1826034150449236,
                                         0.1691565193950025,
                                         0.1495959888165767,
                                         0.1246289712555339,
                                         0.0951585116824928,
                                         0.0622535239386479,
                                         0.0271524594117541};
    const Real l = from(rest, x[0]).norm();
    Real sum(0);
    for (int i = 0; i < 8; ++i)
      for (const double sign : {-1., 1.}) {
        const Real r = l * Real(0.5 * (1 + sign * at[i]));
        Real g, slope;
        pull(rest, r, g, slope);
        sum += Real(weight[i]) * g * r;
      }
    return sum * l / 2;
  }

  void force(Rest const& rest, Coord const (&x)[1], Deriv const (&)[1], Deriv (&f)[1],
             Tangent& tangent) const {
    const Deriv d = from(rest, x[0]);
    const Real l = d.norm();
    Real slope;
    pull(rest, l, tangent.across, slope);
    tangent.along = tangent.across + slope * l;
    tangent.direction = l > 0 ? Deriv(d / l) : Deriv(Deriv::Zero());
    f[0] = -tangent.across * d;
  }
  void dforce(Rest const&, Tangent const& tangent, Deriv const (&dx)[1], Deriv (&df)[1], Real k,
              Real /*b*/) const {
    df[0] = -k * (tangent.across * dx[0] +
                  (tangent.along - tangent.across) * tangent.direction.dot(dx[0]) * tangent.direction);
  }
  Mat<Real, D::size> block(Rest const&, Tangent const& tangent, int, int, Real k, Real /*b*/) const {
    return -k * (tangent.across * Mat<Real, D::size>::Identity() +
                 (tangent.along - tangent.across) * tangent.direction * tangent.direction.transpose());
  }

 private:
  static Deriv from(Rest const& rest, Coord const& x) {
    Deriv d;
    for (int c = 0; c < D::size; ++c) d[c] = x[c] - rest.place[std::size_t(c)];
    return d;
  }
  // g and g' at a distance; in the place itself g is 0 over 0 without the exponential, and taken as 0
  void pull(Rest const& rest, Real l, Real& g, Real& slope) const {
    const Real e = l / rest.length, extra = std::exp(shift - scale * l * l), q = std::sqrt(l * l + extra);
    Real value(0), rate(0);
    for (int k = degree; k > 0; --k) {
      rate = rate * e + rest.coefficient[k - 1] * Real(k);
      value = (value + rest.coefficient[k - 1]) * e;
    }
    if (!(q > 0)) return void(g = slope = 0);
    g = value / q;
    slope = (rate / rest.length - g * l * (1 - scale * extra) / q) / q;
  }
};

/// Springs that hold points at their rest positions, or at places given, with a polynomial of their distance
/// from there over a length for a force.
template <class D>
struct PolynomialRestShapeSpringsForceField {
  static_assert(!D::rigid, "Sinew: PolynomialRestShapeSpringsForceField is for points.");
  using Role = role::ForceField;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  static constexpr std::string_view className = "PolynomialRestShapeSpringsForceField";

  std::vector<int> points{};
  std::vector<double> polynomialStiffness{100};
  std::vector<int> polynomialDegree{1};
  std::vector<double> initialLength{1};
  double smoothShift = 0, smoothScale = 1;
  VecCoord externalRestShape{};
  std::vector<int> externalPoints{};

  static constexpr auto fields() {
    using F = PolynomialRestShapeSpringsForceField;
    return field_list(
        field("points", &F::points, "", "points that are held; none for all of them", range::nonNegative)
            .numbersOf(Of::points),
        field("polynomialStiffness",
              &F::polynomialStiffness,
              "N",
              "coefficients of the distance over the length, its square and so on: those of the first point, "
              "then of the second..."),
        field("polynomialDegree",
              &F::polynomialDegree,
              "",
              "number of coefficients of each point; one for all, which then share them",
              range::closed(1, PolynomialHold<D>::degree))
            .oneEach(Of::entries),
        field("initialLength",
              &F::initialLength,
              "m",
              "length of which the distance is a part: one for all, or one a point",
              range::positive)
            .oneEach(Of::entries),
        field("smoothShift",
              &F::smoothShift,
              "",
              "s: how far the direction is smoothed; far below 0 it is not"),
        field("smoothScale",
              &F::smoothScale,
              "1/m^2",
              "c: how fast that ends with the distance",
              range::nonNegative),
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
            .oneEach(Of::entries));
  }

  static constexpr ForceProperties properties() { return {.internal = false, .objective = false}; }

  bool none = false;  // all of them have been removed

  static constexpr auto state() {
    return field_list(field(
        "none", &PolynomialRestShapeSpringsForceField::none, "", "all of the points have been removed"));
  }

  /// Each point takes its coefficients with it.
  void follow(Followed const& change) {
    if (polynomialDegree.size() == 1) return;
    std::vector<bool> stays;
    for (std::size_t s = 0; s < points.size(); ++s)
      stays.insert(stays.end(), std::size_t(polynomialDegree[s]), change.points.stays(points[s]));
    Renumbering::of(stays).filter(polynomialStiffness);
  }

  using Driver = ElementDriver<PolynomialHold, D>;
  Driver driver{};

  template <class L>
  L law() const {
    L law{};
    law.shift = typename L::Real(smoothShift), law.scale = typename L::Real(smoothScale);
    return law;
  }

  void init(InitContext<D> const& context) {
    const std::string where =
        text(context.where, ": ", component_name<PolynomialRestShapeSpringsForceField>());
    if (none) return driver.init({}, {});
    const std::size_t n = points.empty() ? context.rest.size() : points.size();
    check_points(where, "points", points, context.rest.size());
    check_one_or_each(where, "polynomialDegree", polynomialDegree.size(), n, "points", "one");
    check_one_or_each(where, "initialLength", initialLength.size(), n, "points", "one");
    std::size_t coefficients = 0;
    for (const int d : polynomialDegree) coefficients += std::size_t(d);
    if (polynomialStiffness.size() != coefficients)
      throw Error(where,
                  text("polynomialStiffness has ",
                       polynomialStiffness.size(),
                       " coefficients, but polynomialDegree says ",
                       coefficients,
                       "; give one for each power of each point"));
    const bool elsewhere = !externalRestShape.empty(), listed = !externalPoints.empty();
    if (!elsewhere && listed)
      throw Error(where, "external_points are places of external_rest_shape, which is not given; give it");
    VecCoord const& places = elsewhere ? externalRestShape : context.rest;
    if (elsewhere && (listed ? externalPoints.size() : places.size()) < n)
      throw Error(where,
                  text(listed ? "external_points has " : "external_rest_shape has ",
                       listed ? externalPoints.size() : places.size(),
                       " places for ",
                       n,
                       " points; give one for each"));
    if (elsewhere && !listed)  // places stay with their points when some of these go
      for (std::size_t i = 0; i < n; ++i) externalPoints.push_back(int(i));
    if (elsewhere)
      check_numbers(where, "external_points", externalPoints, places.size(), "places", "external_rest_shape");

    std::vector<typename Driver::Indices> indices;
    std::vector<typename Driver::Rest> rest;
    std::size_t next = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const int p = points.empty() ? int(i) : points[i];
      indices.push_back({p});
      typename Driver::Rest spring{};
      auto const& place = places[std::size_t(elsewhere ? externalPoints[i] : p)];
      for (int c = 0; c < D::size; ++c) spring.place[std::size_t(c)] = place[c];
      spring.length = Real(one_or_each(initialLength, i));
      if (polynomialDegree.size() == 1) next = 0;
      for (int k = 0; k < one_or_each(polynomialDegree, i); ++k)
        spring.coefficient[k] = Real(polynomialStiffness[next++]);
      rest.push_back(spring);
    }
    driver.init(indices, rest);
  }
};

}  // namespace sinew
