// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/element_force.hpp>
#include <sinew/core/phase.hpp>
#include <sinew/gpu/reduction.hpp>
#include <sinew/gpu/solver_workspace.hpp>
#include <sinew/gpu/team_solver.hpp>
#include <sinew/gpu/vector_operations.hpp>
#include <sinew/scene/scope.hpp>
#include <sinew/scene/solvers.hpp>

#include <type_traits>
#include <utility>
#include <vector>

namespace sinew::gpu {

namespace detail {

template <class C>
concept HasDeviceElements = requires(C c) { c.driver.view(); };

// f(component) for the force fields with elements on the device, or the masses, that act on a state itself,
// in their order
template <class Role, class Operations, class State, class F>
void for_each_acting_on(Operations& operations, State& state, F&& f) {
  traverse(operations.root, on<Role>([&](auto& c, auto const& scope) {
             using C = std::decay_t<decltype(c)>;
             if constexpr (std::is_same_v<typename C::DataTypes, typename State::DataTypes> &&
                           (HasDeviceElements<C> || std::is_same_v<Role, role::Mass>))
               if (scope.stateAddress() == &state) f(c);
           }));
}

template <class D>
struct UnitVectors {
  typename D::Deriv* to;
  int c;
  SINEW_HD void operator()(int i) const { to[i] = D::Deriv::Unit(c); }
};

template <class D>
struct Ones {
  typename D::Deriv* to;
  SINEW_HD void operator()(int i) const { to[i] = D::Deriv::Ones(); }
};

// the vector `column` of a state = m M times its vector `unit`, with M the masses on the state
template <class Operations, class State, class MultiVec>
void multiply_masses(Operations& operations, State& state, double m, MultiVec& unit, MultiVec& column) {
  using D = typename State::DataTypes;
  VectorOperations<D>::clear(OneThread{}, state[column.id]);
  for_each_acting_on<role::Mass>(operations, state, [&](auto& mass) {
    mass.addMDx(state[column.id], state[vec_id::position], state[unit.id], typename D::Real(m));
  });
}

/// f(c) for each component c of a state's points, where `unit` is e_c for all of them, 0 for those of other
/// states, and `column` is m M e_c, with M the masses on the state.
template <class Operations, class State, class MultiVec, class F>
void for_each_mass_column(Operations& operations, State& state, double m, MultiVec& unit, MultiVec& column,
                          F&& f) {
  using D = typename State::DataTypes;
  for (int c = 0; c < D::size; ++c) {
    unit.clear();
    for_each_index(state.size(), UnitVectors<D>{state[unit.id].overwrite(), c});
    multiply_masses(operations, state, m, unit, column);
    f(c);
  }
}

// whether none of the contacts of a solver is a force, now, or ever: multipliers answer all
template <class Operations>
bool only_multipliers_answer(Operations& operations, bool now) {
  bool only = true;
  operations.root.withContacts(
      [&](auto& manager) { only = !manager.acts() && (now || manager.asksForMultipliersOnly()); });
  return only;
}

}  // namespace detail

/// Whether all that a solver's matrix consists of can be summed up on the device: elements there and masses,
/// on states that are no mapped ones; nothing between two states. `now`: mapped states that add nothing may
/// be there; collision models may be as long as their contacts add nothing, now or ever.
template <class Operations>
bool can_assemble(Operations& operations, bool now) {
  bool can = true;
  traverse(operations.root,
           on<role::ForceField, role::InteractionForceField, role::Mapping, role::CollisionModel, role::Mass>(
               [&](auto& c, auto const& scope) {
                 using C = std::decay_t<decltype(c)>;
                 if constexpr (HasRole<C, role::Mapping>)
                   scope.withChild(c, [&](auto& child) {
                     if constexpr (HasRole<std::decay_t<decltype(child)>, role::State>)
                       can = can && now && !HasGeometricStiffness<C>;
                   });
                 else if constexpr (HasRole<C, role::CollisionModel>)
                   can = can && detail::only_multipliers_answer(operations, now);
                 else if constexpr (HasRole<C, role::InteractionForceField>)
                   can = false;
                 else
                   can = can && !scope.stateScope().mapped() &&
                         (HasRole<C, role::Mass> || detail::HasDeviceElements<C> || Load<C>);
               }));
  return can;
}

/// The matrix m M + b B + k K of a solver, in rows on the device for each state: planned where that is not
/// done. `unit` and `column` are workspace.
template <class Operations, class MultiVec>
void assemble_on_device(Operations& operations, MatrixFactors factors, MultiVec& unit, MultiVec& column) {
  [[maybe_unused]] const auto span = operations.root.span(Phase::assembly);
  operations.forEachIndependent([&](auto& state) {
    using D = typename std::decay_t<decltype(state)>::DataTypes;
    if constexpr (OnDevice<D>) {
      using Real = typename D::Real;
      using Source = typename BlockRows<D>::Source;
      BlockRows<D>& rows = state.solverWorkspace.rows;
      if (!rows.planned()) {
        std::vector<Source> sources;
        detail::for_each_acting_on<role::ForceField>(
            operations, state, [&](auto& c) { sources.push_back(Source(c.driver.elements)); });
        rows.plan(std::move(sources), state.size());
      }
      std::size_t source = 0;
      detail::for_each_acting_on<role::ForceField>(operations, state, [&](auto& c) {
        rows.add(source++, law_of(c), c.driver.view(), Real(factors.k), Real(factors.b));
      });
      if (source == 0) rows.clear();
      if (!D::rigid && operations.massIsDiagonal()) {
        for_each_index(state.size(), detail::Ones<D>{state[unit.id].overwrite()});
        detail::multiply_masses(operations, state, factors.m, unit, column);
        rows.addDiagonal(std::as_const(state[column.id]).device());
      } else {
        detail::for_each_mass_column(operations, state, factors.m, unit, column, [&](int c) {
          rows.addColumn(std::as_const(state[column.id]).device(), c);
        });
      }
    }
  });
}

template <class D, class Operations, class MultiVec>
bool take_held(Operations& operations, MultiVec& room, DeviceArray<unsigned char>& held,
               std::vector<SystemBody<D>>& bodies, std::size_t first) {
  if (!any_below<role::ProjectiveConstraint>(operations.root)) return true;
  if (recording()) return false;  // the host looks at what these do
  int points = 0;
  for (std::size_t k = first; k < bodies.size(); ++k) points += bodies[k].points;
  held.resize(std::size_t(points));
  operations.forEachIndependent([&](auto& s) {
    if constexpr (std::is_same_v<typename std::decay_t<decltype(s)>::DataTypes, D>)
      for_each_index(s.size(), typename SystemOfBodies<D>::SetNumbers{s[room.id].overwrite()});
  });
  operations.projectResponse(room.id);
  double mixed = 0;
  unsigned char* to = held.data();
  operations.forEachIndependent([&](auto& s) {
    if constexpr (std::is_same_v<typename std::decay_t<decltype(s)>::DataTypes, D>) {
      mixed +=
          sum_on_host(s.size(), typename SystemOfBodies<D>::TakeHeld{std::as_const(s[room.id]).device(), to});
      bodies[first++].held = to;
      to += s.size();
    }
  });
  return mixed == 0;
}

}  // namespace sinew::gpu
