// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/lagrangian/constraint_rows.hpp>

#include <algorithm>
#include <vector>

namespace sinew {

/// All coordinates of a state are zero by multipliers, d = x, or with `constrainToRestPos` those at rest,
/// d = x - x0. Below a DistanceMapping it makes edges inextensible, below a VolumeMapping volumes constant:
/// the unit of d, and of what a multiplier of 1 N does, is that of the state.
template <class D>
struct UniformLagrangianConstraint {
  using Role = role::LagrangianConstraint;
  using DataTypes = D;
  static_assert(!D::rigid, "UniformLagrangianConstraint is for Vec; FixedLagrangianConstraint holds rigids");
  static constexpr std::string_view className = "UniformLagrangianConstraint";

  bool iterative = true, constrainToRestPos = false;

  static constexpr auto fields() {
    using F = UniformLagrangianConstraint;
    return field_list(field("iterative",
                            &F::iterative,
                            "",
                            "each equation is a block of its own for solvers that go through them in turn, "
                            "else up to six that follow each other are solved at once"),
                      field("constrainToRestPos",
                            &F::constrainToRestPos,
                            "",
                            "coordinates stay what they are at rest, else they are zero"));
  }

  std::vector<double> multipliers{};  // of each coordinate, a point's after the other

  static constexpr auto state() {
    return field_list(
        field("multipliers", &UniformLagrangianConstraint::multipliers, "N", "of the last step"));
  }

  void init(InitContext<D> const&) {}

  void addRows(ConstraintRows& rows, ConstrainedState<D> const& state) const {
    const int count = int(state.free.size()) * D::size;
    const int size = iterative ? 1 : ConstraintBlock::maxRows;
    for (int begin = 0; begin < count; begin += size) {
      const int first = rows.addEquality(std::min(size, count - begin));
      for (int k = begin; k < std::min(begin + size, count); ++k) {
        const int row = first + k - begin, point = k / D::size, c = k % D::size;
        const auto p = std::size_t(point);
        double d = double((rows.ofVelocity ? state.position : state.free)[p][c]);
        if (constrainToRestPos) d -= double(state.rest[p][c]);
        if (rows.ofVelocity) d = d / state.dt + double(state.velocity[p][c]);
        rows.addTo(row, point, D::Deriv::Unit(c));
        rows.setViolation(row, d);
      }
    }
  }
};

}  // namespace sinew
