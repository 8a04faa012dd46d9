// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/phase.hpp>
#include <sinew/gpu/solver_room.hpp>
#include <sinew/gpu/vector_operations.hpp>
#include <sinew/scene/scope.hpp>

#include <array>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew::gpu {

namespace detail {

/// What a thread does for column c of a point's block of a mass: M e_c.
template <class D>
struct UnitVectors {
  typename D::Deriv* to;
  int c;
  SINEW_HD void operator()(int i) const { to[i] = D::Deriv::Unit(c); }
};
template <class D>
struct PutColumn {
  typename D::Real* blocks;
  typename D::Deriv const* from;
  int c;
  SINEW_HD void operator()(int i) const {
    constexpr int n = D::size;
    for (int r = 0; r < n; ++r) blocks[(std::ptrdiff_t(i) * n + r) * n + c] = from[i][r];
  }
};

// f(component, state) for the force fields and masses that act on a state of the device, in their order
template <class Operations, class State, class F>
void for_each_acting_on(Operations& operations, State& state, F&& f) {
  using D = typename State::DataTypes;
  traverse(operations.root, on<role::ForceField, role::Mass>([&](auto& c, auto const& scope) {
             using C = std::decay_t<decltype(c)>;
             if constexpr (std::is_same_v<typename C::DataTypes, D>)
               if (scope.stateAddress() == &state) f(c);
           }));
}
template <class C>
concept HasDeviceElements = requires(C c) {
  c.driver.lastLaw;
};

}  // namespace detail

/// Whether all that a solver's matrix consists of can be summed up on the device: elements there and masses,
/// on states that are no mapped ones; nothing between two states.
template <class Operations>
bool can_assemble(Operations& operations) {
  bool can = true;
  traverse(operations.root,
           on<role::ForceField, role::InteractionForceField, role::Mapping, role::CollisionModel, role::Mass>(
               [&](auto& c, auto const& scope) {
                 using C = std::decay_t<decltype(c)>;
                 if constexpr (HasRole<C, role::Mapping>)
                   scope.withChild(c, [&](auto& child) {
                     if constexpr (HasRole<std::decay_t<decltype(child)>, role::State>) can = false;
                   });
                 else if constexpr (HasRole<C, role::ForceField>)
                   can = can && (detail::HasDeviceElements<C> || Load<C>);
                 else if constexpr (!HasRole<C, role::Mass>)
                   can = false;
               }));
  return can;
}

/// The matrix m M + b B + k K of a solver, in rows on the device for each state: planned where that is not
/// done. `unit` and `column` are room.
template <class Operations, class MultiVec>
void assemble_on_device(Operations& operations, MatrixFactors factors, MultiVec& unit, MultiVec& column) {
  [[maybe_unused]] const auto span = operations.root.span(Phase::assembly);
  operations.forEachIndependent([&](auto& state) {
    using D = typename std::decay_t<decltype(state)>::DataTypes;
    if constexpr (OnDevice<D>) {
      using Real = typename D::Real;
      using Source = typename BlockRows<D>::Source;
      BlockRows<D>& rows = state.solverRoom.rows;
      if (!rows.planned()) {
        std::vector<std::array<int, 1>> points(state.size());
        for (std::size_t i = 0; i < points.size(); ++i) points[i] = {int(i)};
        std::vector<Source> sources{Source(points)};
        detail::for_each_acting_on(operations, state, [&]<class C>(C& c) {
          if constexpr (detail::HasDeviceElements<C>) sources.push_back(Source(c.driver.elements));
        });
        rows.plan(std::move(sources), state.size());
      }
      for (int k = 0; k < D::size; ++k) {
        using Vectors = VectorOperations<D>;
        Vectors::clear(OneThread{}, state[column.id]);
        for_each_index(state.size(), detail::UnitVectors<D>{state[unit.id].overwrite(), k});
        detail::for_each_acting_on(operations, state, [&]<class C>(C& c) {
          if constexpr (HasRole<C, role::Mass>)
            c.addMDx(state[column.id], state[vec_id::position], state[unit.id], Real(factors.m));
        });
        for_each_index(state.size(),
                       detail::PutColumn<D>{rows.blocksOf(0), std::as_const(state[column.id]).device(), k});
      }
      std::size_t source = 1;
      detail::for_each_acting_on(operations, state, [&]<class C>(C& c) {
        if constexpr (detail::HasDeviceElements<C>)
          rows.fill(source++, *c.driver.lastLaw, c.driver.view(), Real(factors.k), Real(factors.b));
      });
      rows.sum();
    }
  });
}

}  // namespace sinew::gpu
