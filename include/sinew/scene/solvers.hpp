// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/scene/scope.hpp>

#include <utility>

namespace sinew {

/// f(ODE solver, scope of its node) for the solvers that move the states below a scope, each with those that
/// stand beside it: below a node that has one no other is looked for.
template <class S, class F>
void for_each_solver(S const& scope, F&& f) {
  bool solved = false;
  auto visit = on<role::OdeSolver>([&](auto& ode) {
    f(ode, scope);
    solved = true;
  });
  if (scope.integrates()) scope.forEachComponent(visit);
  if constexpr (!S::template always<role::OdeSolver>)
    if (!solved)
      scope.template forEachChild<role::OdeSolver>([&](auto const& child) { for_each_solver(child, f); });
}
/// The same without those that stand beside others.
template <class S, class F>
void for_each_integrator(S const& scope, F&& f) {
  for_each_solver(scope, [&](auto& ode, auto const& solved) {
    if constexpr (!stands_beside<std::decay_t<decltype(ode)>>) f(ode, solved);
  });
}

/// f(component) for the first with a role in the node of a scope; says whether there is one.
template <class Role, class S, class F>
bool with_first(S const& scope, F&& f) {
  bool found = false;
  auto visit = on<Role>([&](auto& c) {
    if (!std::exchange(found, true)) f(c);
  });
  scope.forEachComponent(visit);
  return found;
}

}  // namespace sinew
