// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>

#include <string>

namespace sinew {

// Has degrees of freedom of its own, which no ODE solver moves, and steps them: SOFA's BehaviorModel. The shortest:
//
//   /// A clock that is late.
//   struct LateClock {
//     using Role = role::BehaviorModel;
//     static constexpr std::string_view className = "LateClock";
//     static constexpr auto fields() { return field_list(); }
//
//     double shown = 0;
//
//     void init(std::string const&) { shown = 0; }
//     template <class Workers>
//     void step(StepAhead const& ahead, Eigen::Vector3d const&, Workers const&) { shown += 0.99 * ahead.dt; }
//     double kineticEnergy() { return 0; }
//   };

/// init(where) sizes it, and takes what its state() has kept; step(ahead, gravity, workers) goes on by a step, before the ODE
/// solvers do, with the gravity of its node [m/s^2] and the threads there (core/workers.hpp); kineticEnergy() [J].
template <class C>
concept StepsItself = requires(C c, std::string const where, StepAhead const ahead, Eigen::Vector3d const gravity) {
  c.init(where);
  c.step(ahead, gravity, OneThread{});
  { c.kineticEnergy() } -> std::convertible_to<double>;
};
template <class C>
concept BehaviorModel = HasRole<C, role::BehaviorModel> && StepsItself<C>;

// Hooks, what a behavior model may have beside these:

/// notice(), words that are the same in each step for what a step has noticed; empty where there is nothing.
template <class C>
concept Notices = requires(C const c) {
  { c.notice() } -> std::convertible_to<std::string_view>;
};
/// border(), a Mesh of what is seen of it now.
template <class C>
concept HasBorder = requires(C const c) { c.border(); };

template <>
struct Promise<role::BehaviorModel> : NoPromise {
  template <class C>
  static constexpr bool kept = BehaviorModel<C>;
  template <class C>
  struct Broken {
    static constexpr bool steps = StepsItself<C>;  // compilers explain a concept at length
    static_assert(steps,
                  "Sinew: a behavior model has no 'void init(std::string const& where)', no 'template <class "
                  "Workers> void step(StepAhead const& ahead, Eigen::Vector3d const& gravity, Workers const& "
                  "workers)', or no 'double kineticEnergy()' [J].");
  };
};

}  // namespace sinew
