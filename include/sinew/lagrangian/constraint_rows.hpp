// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/lagrangian/constraint_problem.hpp>

#include <Eigen/Core>

#include <array>
#include <vector>

namespace sinew {

/// The equations of a step, as constraints add them: blocks of rows, each row with its violation d at the end
/// of the step without multipliers, a first guess of its multiplier [N], and its Jacobian dd/dx over points
/// of the states on which the constraint acts. For a scene that solves velocities first, d is a rate and the
/// Jacobian is the same.
class ConstraintRows {
 public:
  /// What a row has in one point.
  struct Entry {
    int row, side, point, size;
    std::array<double, 6> values;
  };

  std::vector<ConstraintBlock> blocks{};
  std::vector<double> violation{}, multipliers{};
  std::vector<double> compliance{};  // of each row: what it adds to d for each newton of its multiplier
  std::vector<Entry> entries{};      // rising by row
  bool ofVelocity = false;           // violations are rates, of the velocities without multipliers

  int count() const { return int(violation.size()); }

  // Each adds a block with violations and guesses of zero, and returns its first row.

  /// d = 0.
  int addEquality(int rows) { return add(ConstraintBlock::equality(count(), rows)); }
  /// d >= 0.
  int addUnilateral() { return add(ConstraintBlock::unilateral(count())); }
  /// lower <= d <= upper.
  int addInterval(double lower, double upper) {
    return add(ConstraintBlock::interval(count(), lower, upper));
  }
  /// A normal with d >= 0 and two tangents with Coulomb's friction.
  int addContact(double mu) { return add(ConstraintBlock::contact(count(), mu)); }

  /// The Jacobian of a row in a point: what each component of its velocity or, of a rigid, of its angular
  /// velocity adds to the rate of d. Rows are filled in their order. `side`: 1 for the second of two states.
  template <class Derived>
  void addTo(int row, int point, Eigen::MatrixBase<Derived> const& direction, int side = 0) {
    Entry e{row, side, point, int(direction.size()), {}};
    for (int i = 0; i < e.size; ++i) e.values[std::size_t(i)] = double(direction[i]);
    entries.push_back(e);
  }
  void setViolation(int row, double d) { violation[std::size_t(row)] = d; }
  void setMultiplier(int row, double f) { multipliers[std::size_t(row)] = f; }
  /// The row gives way: its condition is one for d + C f [m/N; of a rate m/(N s)].
  void soften(int row, double c) { compliance[std::size_t(row)] = c; }

  void clear() {
    blocks.clear();
    violation.clear();
    multipliers.clear();
    compliance.clear();
    entries.clear();
  }

 private:
  int add(ConstraintBlock const& block) {
    blocks.push_back(block);
    violation.resize(violation.size() + std::size_t(block.rows), 0);
    multipliers.resize(violation.size(), 0);
    compliance.resize(violation.size(), 0);
    return block.first;
  }
};

/// Blocks of equalities for all coordinates of the difference of two points of D, the orientation of rigid
/// bodies in one of its own: each(row, coordinate) fills a row.
template <class D, class F>
void add_point_equalities(ConstraintRows& rows, F&& each) {
  for (int begin = 0; begin < D::size;) {
    const int size = D::rigid && begin == 0 ? D::spatial : D::size - begin;
    const int first = rows.addEquality(size);
    for (int c = 0; c < size; ++c) each(first + c, begin + c);
    begin += size;
  }
}

}  // namespace sinew
