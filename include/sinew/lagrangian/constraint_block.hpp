// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <Eigen/Core>

#include <limits>

namespace sinew {

/// Rows of constraints that are solved together. d is their violation at the end of the step, f their
/// multipliers.
struct ConstraintBlock {
  enum class Kind {
    equality,  // d = 0
    interval,  // one row: lower <= d <= upper; f >= 0 at the lower end, f <= 0 at the upper one, else 0
    friction,  // a normal and two tangents: d_n >= 0, f_n >= 0, d_n f_n = 0, |f_t| <= mu f_n; where d_t is
               // not 0, f_t = -mu f_n d_t / |d_t| (Signorini, Coulomb)
  };
  static constexpr int maxRows = 6;

  Kind kind = Kind::equality;
  int first = 0, rows = 1;
  double friction = 0;  // mu
  double lower = 0, upper = std::numeric_limits<double>::infinity();

  static ConstraintBlock equality(int first, int rows) { return {Kind::equality, first, rows}; }
  static ConstraintBlock unilateral(int first) { return {Kind::interval, first, 1}; }
  static ConstraintBlock interval(int first, double lower, double upper) {
    return {Kind::interval, first, 1, 0, lower, upper};
  }
  static ConstraintBlock contact(int first, double mu) { return {Kind::friction, first, 3, mu}; }
  bool operator==(ConstraintBlock const&) const = default;
};

using BlockMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, ConstraintBlock::maxRows,
                                  ConstraintBlock::maxRows>;
using BlockVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, ConstraintBlock::maxRows, 1>;

}  // namespace sinew
