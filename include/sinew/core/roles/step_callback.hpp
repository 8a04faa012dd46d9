// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>

namespace sinew {

// Is called after each step. The shortest:
//
//   /// Counts steps.
//   struct Counter {
//     using Role = role::StepCallback;
//     static constexpr std::string_view className = "Counter";
//     static constexpr auto fields() { return field_list(); }
//     long steps = 0;
//     void call(StepInfo const& step) { steps = step.step; }
//   };

/// A component that watches the state on which it acts: init(context), as force fields have it, and
/// endStep(step, state, kineticEnergy) after each step, where kineticEnergy() is that of the state's mass. It
/// may have finish(), which Simulation::finish() calls.
template <class C>
concept WatchesState = HasRole<C, role::StepCallback> && requires { typename C::DataTypes; };

/// It watches a state, or has call(StepInfo const&), or call(StepInfo const&, node).
template <class C>
concept StepCalled =
    HasRole<C, role::StepCallback> && ((WatchesState<C> && HasInit<C> && may_have<C>(named::endStep<C>)) ||
                                       (!WatchesState<C> && may_have<C>(named::call<C>)));

template <>
struct Promise<role::StepCallback> : NoPromise {
  template <class C>
  static constexpr bool kept = StepCalled<C>;
  template <class C>
  struct Broken {
    static_assert(
        WatchesState<C> || may_have<C>(named::call<C>),
        "Sinew: a step callback has no 'void call(StepInfo const& step)' and no DataTypes of a state "
        "that it watches; add one.");
    static_assert(!WatchesState<C> || HasInit<C>,
                  "Sinew: a step callback with DataTypes has no 'void init(InitContext<DataTypes> const& "
                  "context)'.");
    static_assert(!WatchesState<C> || may_have<C>(named::endStep<C>),
                  "Sinew: a step callback with DataTypes has no 'template <class State, class Energy> void "
                  "endStep(StepInfo const& step, State const& state, Energy&& kineticEnergy)'.");
  };
};

}  // namespace sinew
