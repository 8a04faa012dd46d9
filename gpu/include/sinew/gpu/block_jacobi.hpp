// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/phase.hpp>
#include <sinew/gpu/assembled_system.hpp>
#include <sinew/linalg/block_inverse.hpp>
#include <sinew/linalg/preconditioner.hpp>

#include <type_traits>
#include <utility>

namespace sinew::gpu {

/// A block for each point on the device: component c of that of point i is entry c * points + i, so that
/// neighbouring threads read neighbouring addresses.
template <class D>
struct PointBlocks {
  using DataTypes = D;
  using Real = typename D::Real;
  using Deriv = typename D::Deriv;
  using Block = Mat<Real, D::size>;
  static constexpr int n = D::size;
  int points;
  Real* blocks;

  SINEW_HD Real& at(int r, int c, int i) const { return blocks[(r * n + c) * std::ptrdiff_t(points) + i]; }
  SINEW_HD Block load(int i) const {
    Block b;
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c) b(r, c) = at(r, c, i);
    return b;
  }

  // what threads do

  struct Clear {
    PointBlocks all;
    SINEW_HD void operator()(int i) const {
      for (int k = 0; k < n * n; ++k) all.at(0, k, i) = Real(0);
    }
  };
  struct AddColumn {
    PointBlocks all;
    Deriv const* from;
    int c;
    SINEW_HD void operator()(int i) const {
      for (int r = 0; r < n; ++r) all.at(r, c, i) += from[i][r];
    }
  };
  /// The inverse of C d C + (I - C), where C is what constraints leave of the point's motion.
  struct Invert {
    PointBlocks all, left;
    bool diagonalOnly;
    SINEW_HD void operator()(int i) const {
      const Block c = left.load(i);
      const Block d = (c * all.load(i) * c + (Block::Identity() - c)).eval();
      Block to;
      if (diagonalOnly || !invert_definite(d, to)) invert_diagonal(d, to);
      for (int r = 0; r < n; ++r)
        for (int k = 0; k < n; ++k) all.at(r, k, i) = to(r, k);
    }
  };
  /// z = P^-1 r; returns r.z.
  struct Apply {
    PointBlocks all;
    Deriv const* r;
    Deriv* z;
    SINEW_HD double operator()(int i) const {
      const Deriv from = r[i], to = all.load(i) * from;
      z[i] = to;
      double sum = 0;
      for (int c = 0; c < n; ++c) sum += double(from[c]) * double(to[c]);
      return sum;
    }
  };
};

/// Makes the preconditioner of the states below a solver: the inverse diagonal blocks of what elements on the
/// device and masses of each state add, as constraints leave them; where there is nothing, 1. `unit` and
/// `column` are workspace.
template <class Operations, class MultiVec>
void make_block_jacobi(Operations& operations, MatrixFactors factors, bool diagonalOnly, MultiVec& unit,
                       MultiVec& column) {
  [[maybe_unused]] const auto span = operations.root.span(Phase::factorisation);
  operations.forEachIndependent([&](auto& state) {
    using D = typename std::decay_t<decltype(state)>::DataTypes;
    if constexpr (OnDevice<D>) {
      using Real = typename D::Real;
      using Blocks = PointBlocks<D>;
      const std::size_t points = state.size(), entries = points * std::size_t(D::size * D::size);
      state.solverWorkspace.diagonal.resize(2 * entries);
      Real* const workspace = state.solverWorkspace.diagonal.overwrite();
      const Blocks blocks{int(points), workspace}, left{int(points), workspace + entries};
      for_each_index(points, typename Blocks::Clear{blocks});
      for_each_index(points, typename Blocks::Clear{left});
      detail::for_each_acting_on<role::ForceField>(operations, state, [&](auto& c) {
        c.driver.addDiagonal(law_of(c), workspace, points, Real(factors.k), Real(factors.b));
      });
      detail::for_each_mass_column(operations, state, factors.m, unit, column, [&](int c) {
        operations.projectResponse(unit.id);
        for_each_index(points,
                       typename Blocks::AddColumn{blocks, std::as_const(state[column.id]).device(), c});
        for_each_index(points, typename Blocks::AddColumn{left, std::as_const(state[unit.id]).device(), c});
      });
      for_each_index(points, typename Blocks::Invert{blocks, left, diagonalOnly});
    }
  });
}

}  // namespace sinew::gpu
