// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>
#include <sinew/core/vec_id.hpp>

namespace sinew {

// Integrates its node and all below it in time, by MechanicalOperations. The shortest:
//
//   /// v += dt M^-1 f,  x += dt v
//   struct SymplecticEuler {
//     using Role = role::OdeSolver;
//     static constexpr std::string_view className = "SymplecticEuler";
//     static constexpr bool implicit = false;
//     static constexpr Auxiliary auxiliary{};
//     static constexpr auto fields() { return field_list(); }
//
//     template <class Operations>
//     void solve(Operations& o, double dt) const {
//       o.computeForce(vec_id::force, vec_id::position, vec_id::velocity);
//       o.accFromF(vec_id::dx, vec_id::force, vec_id::position);
//       o.peq(vec_id::velocity, vec_id::dx, dt);
//       o.peq(vec_id::position, vec_id::velocity, dt);
//     }
//   };

/// Whether it solves linear systems, and so needs a linear solver.
template <class C>
concept SaysImplicit = requires { requires std::convertible_to<decltype(C::implicit), bool>; };
/// How many auxiliary vectors it takes from the pool at the same time.
template <class C>
concept SaysAuxiliary = requires { requires std::convertible_to<decltype(C::auxiliary), Auxiliary>; };
template <class C>
concept Integrates = requires(C c, AnyOperations operations) { c.solve(operations, 0.0); };

/// `convergenceOrder`, that of the error in time with its settings as they are by default, is proved in
/// tests/validation; 0 for one that does not integrate.
template <class C>
concept OdeSolver = HasRole<C, role::OdeSolver> && SaysImplicit<C> && SaysAuxiliary<C> && Integrates<C>;

// Hooks, what an ODE solver may have beside these:

/// It does not integrate but changes the state after the solver that stands before it in its node.
template <class C>
inline constexpr bool stands_beside = requires { requires C::beside; };
/// An explicit one that takes a linear solver where masses are not diagonal: `solvesMass`.
template <class C>
concept SolvesMass = requires { C::solvesMass; };

/// How multipliers f [N] act in a step: A u = impulse J' f with the matrix A = m M + b B + k K of the step and the
/// Jacobian J of the constraints; positions move by position u, velocities change by velocity u.
struct ConstraintFactors {
  MatrixFactors matrix{};
  double impulse = 0, position = 0, velocity = 0;
};
/// An implicit solver says it for a step of length h, for scenes with an animation loop that solves constraints. It
/// may have `prepareCorrection(operations)`, which is called after the step without multipliers where constraints act on
/// its bodies, before its linear solver is asked for u, and `corrected(operations, u, ofVelocity)`, which is called when
/// positions and velocities have taken u; with `ofVelocity` positions have moved by the velocities times h instead. Where
/// the first steps have other factors, changesFactors() says so.
template <class C>
concept HasConstraintFactors = requires(C const c) {
  { c.constraintFactors(0.01) } -> std::same_as<ConstraintFactors>;
};

/// What an ODE solver makes of multipliers in a step of length h, and which of the auxiliary vectors are free
/// then.
struct MultiplierResponse {
  ConstraintFactors factors{};
  bool bySystem = false;  // by the system that the solver has solved, else by the masses
  int derivs = 0;

  template <class Ode>
  static MultiplierResponse of(Ode const& ode, double h) {
    ConstraintFactors factors{{.m = 1}, h, h, 1};
    if constexpr (HasConstraintFactors<Ode>) factors = ode.constraintFactors(h);
    const bool ofForces = factors.matrix.b != 0 || factors.matrix.k != 0;
    return {factors, (Ode::implicit && ofForces) || SolvesMass<Ode>, Ode::auxiliary.derivs};
  }
  /// Vectors that it takes beside those of the solvers.
  static constexpr Auxiliary auxiliary{.coords = 1, .derivs = 2};
  DerivId force() const { return {DerivId::reserved + derivs}; }
  DerivId motion() const { return {DerivId::reserved + derivs + 1}; }
};
/// Whether an ODE solver takes part in a scene with constraints by multipliers.
template <class Ode>
inline constexpr bool takes_multipliers = !Ode::implicit || HasConstraintFactors<Ode> || stands_beside<Ode>;

template <>
struct Promise<role::OdeSolver> : NoPromise {
  template <class C>
  static constexpr bool kept =
      OdeSolver<C> && is_called(named::constraintFactors<C>, HasConstraintFactors<C>);
  template <class C>
  struct Broken {
    static_assert(
        SaysImplicit<C>,
        "Sinew: an ODE solver does not say whether it solves linear systems; write 'static constexpr "
        "bool implicit = false;', or true.");
    static_assert(
        SaysAuxiliary<C>,
        "Sinew: an ODE solver does not say how many auxiliary vectors it takes; write 'static constexpr "
        "Auxiliary auxiliary{.coords = 0, .derivs = 1};'.");
    static_assert(
        Integrates<C>,
        "Sinew: an ODE solver has no 'template <class Operations> void solve(Operations& operations, "
        "double dt)', which makes a step.");
    static_assert(is_called(named::constraintFactors<C>, HasConstraintFactors<C>),
                  "Sinew: an ODE solver has a constraintFactors that nothing calls; write 'ConstraintFactors "
                  "constraintFactors(double h) const'.");
  };
};

}  // namespace sinew
