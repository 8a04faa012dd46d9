// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// Chosen points never change their velocity.
template <class D>
struct FixedConstraint {
  using Role = role::ProjectiveConstraint;
  using DataTypes = D;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "FixedConstraint";

  std::vector<int> indices{};

  static constexpr auto fields() {
    return field_list(
        field("indices", &FixedConstraint::indices, "", "points held in place", range::nonNegative));
  }

  void init(InitContext<D> const& context) {
    for (const int i : indices)
      if (std::size_t(i) >= context.rest.size())
        throw Error(text(context.where, ": ", component_name<FixedConstraint>()),
                    text("indices has ",
                         i,
                         ", but the state has ",
                         context.rest.size(),
                         " points, numbered from 0; correct the index"));
  }

  void projectResponse(VecDeriv& dx) const {
    for (const int i : indices) dx[std::size_t(i)].setZero();
  }
  template <class Sink>
  void projectMatrix(Sink const& sink) const {
    for (const int i : indices) sink.fix(i);
  }
};

}  // namespace sinew
