// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/phase.hpp>
#include <sinew/gpu/assembled_system.hpp>
#include <sinew/gpu/multigrid_solver.hpp>
#include <sinew/gpu/vector_operations.hpp>
#include <sinew/solver/linear_system.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew::gpu {

namespace detail {

/// The numbers of conjugate gradients with a cycle, on the device.
struct CycleScalars {
  double *size, *rho, *curvature, *turned;  // r.r, r.z, p.Ap, Ap.z
};

/// q = A p of a row, without what is held; p.q.
template <class D>
struct HeldProduct {
  typename BlockRows<D>::RowProduct product;
  unsigned char const* held;
  SINEW_HD double operator()(int row) const {
    typename D::Real sum[3];
    product.rowOf(row, sum);
    const int bits = held ? held[row] : 0;
    double total = 0;
    for (int c = 0; c < 3; ++c) {
      const auto value = bits >> c & 1 ? typename D::Real(0) : sum[c];
      product.r[row][c] = value;
      total += double(value) * double(product.x[row][c]);
    }
    return total;
  }
};
/// x += alpha p, r -= alpha q with alpha = r.z / p.q; r.r.
template <class Operations>
struct CycleAdvance {
  using Real = typename Operations::Real;
  Real *x, *r;
  Real const *p, *q;
  CycleScalars s;
  SINEW_HD typename Operations::Advance ofThread() const {
    return {x, r, p, q, *s.curvature == 0 ? Real(0) : Real(*s.rho / *s.curvature)};
  }
};
/// p = z + beta p with beta = (r - r before).z / (r.z before) = -q.z / p.q, after Polak and Ribiere.
template <class Real>
struct CycleDirection {
  Real* p;
  Real const* z;
  CycleScalars s;
  SINEW_HD void operator()(int i) const {
    p[i] = z[i] + (*s.curvature == 0 ? Real(0) : Real(-*s.turned / *s.curvature)) * p[i];
  }
};

}  // namespace detail

/// What MultigridLinearSolver does where all states below it are of points over D: the cycle and what
/// iterates on the device, over the matrix that is assembled there. Bodies are solved one after the other,
/// since nothing joins them; small ones by one kernel, of others the host sees the residual of each
/// iteration. `again`: with the matrix and the cycle of the last solve; `update`: the cycle is filled anew.
/// False where it cannot: constraints mix coordinates, or another kind of state is there.
template <class D, class Operations, class Solver, class MultiVec>
bool multigrid_gradients(Operations& operations, Solver& solver, MatrixFactors factors, MultiVec& x,
                         MultiVec& b, bool update, bool again) {
  using V = VectorOperations<D>;
  using Real = typename D::Real;
  if (recording())
    throw Error("MultigridLinearSolver",
                "its iterations end when the host has seen that the system is solved, which a recorded step "
                "cannot; animate() the simulation");
  MultigridSolver<D>* own = nullptr;
  bool can = true;
  operations.forEachIndependent([&](auto& state) {
    if constexpr (std::is_same_v<typename std::decay_t<decltype(state)>::DataTypes, D>) {
      if (!own) own = &state.solverWorkspace.multigrid;
    } else {
      can = false;
    }
  });
  if (!can || !own) return false;
  MultiVec r(operations), p(operations), q(operations), z(operations);
  if (!again) {
    assemble_on_device(operations, factors, p, q);
    own->bodies.clear();
    int points = 0;
    operations.forEachIndependent([&](auto& state) {
      if constexpr (std::is_same_v<typename std::decay_t<decltype(state)>::DataTypes, D>) {
        own->bodies.push_back(body_of<D>(state, points, 1));
        points += int(state.size());
      }
    });
    if (!take_held<D>(operations, p, own->held, own->bodies, 0)) return false;
  }
  own->found.resize(std::size_t(solver.iterations) + 2);
  own->numbers.resize(std::max<std::size_t>(4, own->found.size()));
  double* const numbers = own->numbers.data();
  const detail::CycleScalars s{numbers, numbers + 1, numbers + 2, numbers + 3};
  solver.residuals.clear();
  keep_residual(solver.residuals, 1);
  x.clear();
  r.eq(b);

  std::size_t body = 0;
  operations.forEachIndependent([&](auto& state) {
    if constexpr (std::is_same_v<typename std::decay_t<decltype(state)>::DataTypes, D>) {
      SystemBody<D> const& system = own->bodies[body++];
      MultigridSolver<D>& mine = state.solverWorkspace.multigrid;
      const std::size_t points = state.size(), scalars = V::scalars(state[r.id]);
      if (points == 0) return;
      auto const* places = std::as_const(state.position).device();
      if (update) {
        [[maybe_unused]] const auto span = operations.root.span(Phase::factorisation);
        if (!solver.updateModes) {
          if (!mine.start.data()) {
            mine.start.resize(points);
            copy_on_device(mine.start.data(), places, points);
          }
          places = mine.start.data();
        }
        mine.cycle.settings = solver.multigrid.settings;
        mine.cycle.update(
            some_workers(operations.workers()), state.solverWorkspace.rows, system.held, places);
      }
      auto keep = [&](int i, double left) {
        if (i < int(solver.residuals.size()))
          solver.residuals[std::size_t(i)] = std::max(left, solver.residuals[std::size_t(i)]);
        else
          keep_residual(solver.residuals, left);
      };
      auto product = system.product;
      if (mine.cycle.isWhole()) {
        MultigridTeam<D> team = mine.cycle.team();
        team.product = product;
        team.held = system.held;
        team.x = state[x.id].device();
        team.r = state[r.id].device();
        team.p = state[p.id].overwrite();
        team.q = state[q.id].overwrite();
        team.z = state[z.id].overwrite();
        mine.product.resize(points);
        team.s = mine.product.data();
        team.iterations = solver.iterations;
        team.tolerance = solver.tolerance;
        team.residuals = numbers;
        run_whole_team(points, team, mine.team);
        copy_to_host(own->found.data(), numbers, own->found.size());
        for (int i = 1; i < int(own->found[0]); ++i) keep(i, own->found[std::size_t(i) + 1]);
        return;
      }
      auto const& residual = std::as_const(state[r.id]);
      double whole = 0, size = 0;
      V::dot(residual, residual, s.size);
      copy_to_host(&whole, s.size, 1);
      if (!std::isfinite(whole)) V::teq(state[x.id], Real(notSolved));
      if (!(whole > 0) || !std::isfinite(whole) || 1 <= solver.tolerance) return;
      mine.cycle.apply(residual.device(), state[p.id].overwrite(), s.size, s.rho);
      for (int i = 0; i < solver.iterations; ++i) {
        product.x = std::as_const(state[p.id]).device();
        product.r = state[q.id].overwrite();
        sum_indices(points, detail::HeldProduct<D>{product, system.held}, s.curvature);
        sum_indices(scalars,
                    detail::CycleAdvance<V>{V::flat(state[x.id]),
                                            V::flat(state[r.id]),
                                            V::flat(std::as_const(state[p.id])),
                                            V::flat(std::as_const(state[q.id])),
                                            s},
                    s.size);
        copy_to_host(&size, s.size, 1);
        keep(i + 1, std::sqrt(size / whole));
        if (!(size > solver.tolerance * solver.tolerance * whole)) break;
        mine.cycle.apply(residual.device(), state[z.id].overwrite(), s.size, s.rho);
        V::dot(std::as_const(state[q.id]), std::as_const(state[z.id]), s.turned);
        for_each_index(
            scalars,
            detail::CycleDirection<Real>{V::flat(state[p.id]), V::flat(std::as_const(state[z.id])), s});
      }
    }
  });
  return true;
}

}  // namespace sinew::gpu
