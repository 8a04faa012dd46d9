// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "catch.hpp"
#include "sample.hpp"

#include <limits>
#include <map>

namespace laws {

using namespace sinew;
using sample::Random;

/// What rows of a Lagrangian constraint over D have to be, whatever it holds. States are two bodies, the
/// second for the second end of a constraint between two.
template <class D>
struct LagrangianSuite {
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr double dt = 0.25;

  Random random{20220504};
  sample::Body body{random};
  VecCoord rest[2] = {body_positions(), body_positions()};
  VecCoord position[2] = {moved(rest[0]), moved(rest[1])};
  VecDeriv velocity[2] = {sample::derivs<D>(rest[0].size(), random),
                          sample::derivs<D>(rest[0].size(), random)};

  // bodies in space, whose orientations are almost the same: that of a rotation vector of length e in the
  // world has the Jacobian I + O(e)
  static constexpr double turn = 1e-6;
  VecCoord body_positions() {
    VecCoord x = sample::positions<D>(body, random);
    if constexpr (D::rigid)
      for (auto& p : x) p = turned(D::zero(), D::center(p));
    return x;
  }
  typename D::Coord turned(typename D::Coord x, Vec<Real, D::spatial> const& center) {
    auto by = sample::vector<typename D::Deriv>(random, turn);
    by.template head<D::spatial>() = center;
    D::increment(x, by);
    return x;
  }
  VecCoord moved(VecCoord x) {
    for (auto& p : x) {
      auto by = sample::vector<typename D::Deriv>(random, 0.1);
      if constexpr (D::rigid) by.template tail<D::size - D::spatial>() *= Real(10 * turn);
      D::increment(p, by);
    }
    return x;
  }

  template <class C>
  static ConstraintRows rows_of(C& c, bool ofVelocity, ConstrainedState<D> const& first,
                                ConstrainedState<D> const& second) {
    ConstraintRows rows;
    rows.ofVelocity = ofVelocity;
    if constexpr (JoinsTwo<C>)
      c.addRows(rows, first, second);
    else
      c.addRows(rows, first);
    return rows;
  }

  template <class C>
  void run() {
    INFO(component_name<C>());
    int found = 0;
    sample::for_each_variant<C>(random, [&](C c) {
      check_fields(c, "sample");
      const InitContext<D> context{"sample", rest[0], body.topology(), {}};
      if constexpr (JoinsTwo<C>)
        c.init(context, InitContext<D>{"second", rest[1], body.topology(), {}});
      else
        c.init(context);
      for (const bool ofVelocity : {false, true}) found += jacobian(c, ofVelocity);
    });
    CHECK(found > 0);
  }

  // the Jacobian of rows is the change of violations with free positions, or with velocities; returns how
  // many rows there are
  template <class C>
  int jacobian(C& c, bool ofVelocity) {
    INFO((ofVelocity ? "of velocities" : "of positions"));
    VecCoord free[2] = {position[0], position[1]};
    VecDeriv rates[2] = {velocity[0], velocity[1]};
    auto rows = [&] {
      return rows_of(c,
                     ofVelocity,
                     ConstrainedState<D>{position[0], free[0], rates[0], rest[0], dt},
                     ConstrainedState<D>{position[1], free[1], rates[1], rest[1], dt});
    };
    const ConstraintRows at = rows();
    shape(at);
    // of each degree of freedom of the two ends
    std::map<std::array<int, 3>, std::vector<double>> j;
    for (auto const& e : at.entries) {
      CHECK(e.size == D::size);
      CHECK((JoinsTwo<C> || e.side == 0));
      for (int i = 0; i < e.size; ++i) {
        auto& column = j[{e.side, e.point, i}];
        column.resize(std::size_t(at.count()), 0);
        column[std::size_t(e.row)] += e.values[std::size_t(i)];
      }
    }
    // d is linear but in rotations, with a second derivative of 1, which is h; what rounding of d comes to is
    // eps |d| / h
    double largest = 1;
    for (const double d : at.violation) largest = std::max(largest, std::abs(d));
    const double h = 1e-4, rounding = 10 * std::numeric_limits<double>::epsilon() * largest / h,
                 error = D::rigid ? 100 * turn + h * h : rounding;
    for (int side = 0; side < (JoinsTwo<C> ? 2 : 1); ++side)
      for (std::size_t p = 0; p < rest[side].size(); ++p)
        for (int i = 0; i < D::size; ++i) {
          ConstraintRows ends[2];
          for (int k = 0; k < 2; ++k) {
            const typename D::Deriv by = Real(k == 0 ? -h : h) * D::Deriv::Unit(i);
            const auto x = free[side][p];
            const auto v = rates[side][p];
            if (ofVelocity)
              rates[side][p] += by;
            else
              D::increment(free[side][p], by);
            ends[k] = rows();
            free[side][p] = x;
            rates[side][p] = v;
          }
          REQUIRE(ends[0].count() == at.count());
          REQUIRE(ends[1].count() == at.count());
          auto const column = j.find({side, int(p), i});
          double worst = 0;
          for (std::size_t r = 0; r < std::size_t(at.count()); ++r) {
            const double measured = (ends[1].violation[r] - ends[0].violation[r]) / (2 * h);
            worst = std::max(worst, std::abs(measured - (column == j.end() ? 0 : column->second[r])));
          }
          if (!(worst <= error)) INFO("side " << side << ", point " << p << ", coordinate " << i);
          CHECK(worst <= error);
        }
    if constexpr (JoinsTwo<C>) balance(at);
    return at.count();
  }

  // blocks cover rows, entries rise by row, each row holds something, and gives way by no less than nothing
  static void shape(ConstraintRows const& rows) {
    int next = 0;
    for (ConstraintBlock const& b : rows.blocks) {
      CHECK(b.first == next);
      next += b.rows;
    }
    CHECK(next == rows.count());
    std::vector<double> held(std::size_t(rows.count()), 0);
    int last = 0;
    for (auto const& e : rows.entries) {
      CHECK(e.row >= last);
      last = e.row;
      REQUIRE(e.row < rows.count());
      for (double const value : e.values) held[std::size_t(e.row)] += std::abs(value);
    }
    for (double const value : held) CHECK(value > 0.1);
    REQUIRE(rows.compliance.size() == std::size_t(rows.count()));
    REQUIRE(rows.multipliers.size() == std::size_t(rows.count()));
    for (double const value : rows.compliance) CHECK(value >= 0);
  }
  // what joins two bodies gives them opposite forces
  static void balance(ConstraintRows const& rows) {
    std::vector<Eigen::Vector3d> sum(std::size_t(rows.count()), Eigen::Vector3d::Zero());
    for (auto const& e : rows.entries)
      for (int i = 0; i < D::spatial; ++i) sum[std::size_t(e.row)][i] += e.values[std::size_t(i)];
    for (auto const& s : sum) CHECK(s.norm() <= 1e-14);
  }
};

/// Runs the suite on every Lagrangian constraint over D in a registry.
template <class R, class D>
void check_lagrangian_constraints() {
  int found = 0;
  for_each_registered<R>([&]<class C>() {
    if constexpr (HasRole<C, role::LagrangianConstraint>)
      if constexpr (std::is_same_v<typename C::DataTypes, D>) {
        LagrangianSuite<D>{}.template run<C>();
        ++found;
      }
  });
  CHECK(found > 0);
}

}  // namespace laws
