// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>
#include <sinew/core/roles/ode_solver.hpp>

#include <concepts>

namespace sinew {

// Says what multipliers do to a body. Without one it is the system of the body's ODE solver that answers, by its
// linear solver, or by its masses where the solver is explicit. The shortest:
//
//   /// Each point follows a force as a mass of 1 kg would.
//   struct OneKilogram {
//     using Role = role::ConstraintCorrection;
//     using DataTypes = Vec3d;
//     static constexpr std::string_view className = "OneKilogram";
//     static constexpr auto fields() { return field_list(); }
//
//     void init(InitContext<Vec3d> const&) {}
//     void addCorrection(Vec3d::VecDeriv& u, Vec3d::VecDeriv const& f, Vec3d::VecCoord const&,
//                        ConstraintFactors const& factors) const {
//       for (std::size_t i = 0; i < u.size(); ++i) u[i] += factors.impulse * f[i];
//     }
//   };

/// u += C f for the forces f [N] that multipliers are on the points of its state, with its compliance C, which is symmetric;
/// positions then move by factors.position u, velocities change by factors.velocity u.
template <class C>
concept CorrectsState =
    HasDataTypes<C> && HasInit<C> &&
    requires(C const c, typename C::DataTypes::VecDeriv u, typename C::DataTypes::VecDeriv const f,
             typename C::DataTypes::VecCoord const x,
             ConstraintFactors const factors) { c.addCorrection(u, f, x, factors); };

// Hooks, what such a correction may have beside these:

/// Its points do not feel each other, and addCorrection for unit forces on all of them tells what each does, so that
/// a row costs no more than its points: `static constexpr bool answersByPoint = true`.
template <class C>
concept AnswersByPoint = CorrectsState<C> && requires { requires C::answersByPoint; };
/// `bool answersByMasses() const`: the masses of the state answer in its place.
template <class C>
concept MayAnswerByMasses = requires(C const c) {
  { c.answersByMasses() } -> std::convertible_to<bool>;
};
/// Positions and velocities of its state take other parts of u than the factors of the ODE solver say: those of
/// moved(factors, dt, ofVelocity). With `ofVelocity` constraints are solved for velocities, which then move positions.
template <class C>
concept MovesByOwnFactors = requires(C const c, ConstraintFactors const factors) {
  { c.moved(factors, 0.01, false) } -> std::same_as<ConstraintFactors>;
};
/// Is called before rows are answered, with positions at the start of the step: beginCorrections(x).
template <class C>
concept BeginsCorrections = requires(C c, typename C::DataTypes::VecCoord const x) { c.beginCorrections(x); };
/// Keeps the A^-1 of the system of its solver at rest: where needsCompliance(dt), setColumn(dof, u) is called before the
/// step for each column of it, with what it has on the points of the state, and then keepCompliance(dt).
template <class C>
concept KeepsCompliance = requires(C c, typename C::DataTypes::VecDeriv const u) {
  { c.needsCompliance(0.01) } -> std::convertible_to<bool>;
  c.setColumn(0, u);
  c.keepCompliance(0.01);
};
/// `regularizationTerm`, of all corrections: what is added to the compliance of each row that acts on the state, or, of
/// one that stands for the system, on states at and below its node [m/(N s)]. `complianceFactor`, of those that stand for
/// the system: it answers as many times as much.
template <class C>
concept Regularizes = requires(C const c) {
  { c.regularizationTerm } -> std::convertible_to<double>;
};
template <class C>
concept ScalesCompliance = requires(C const c) {
  { c.complianceFactor } -> std::convertible_to<double>;
};

/// It says that the system of the ODE solver answers.
template <class C>
concept CorrectsBySystem = requires { requires C::ofSystem; };

template <class C>
concept ConstraintCorrection =
    HasRole<C, role::ConstraintCorrection> && (CorrectsState<C> || CorrectsBySystem<C>);

template <>
struct Promise<role::ConstraintCorrection> : NoPromise {
  template <class C>
  static constexpr bool kept = ConstraintCorrection<C>;
  template <class C>
  struct Broken {
    static_assert(CorrectsBySystem<C> || HasDataTypes<C>,
                  "Sinew: a constraint correction has no DataTypes; write 'using DataTypes = D;' with those "
                  "of the state "
                  "that it moves, such as Vec3d.");
    static_assert(
        CorrectsBySystem<C> || !HasDataTypes<C> || HasInit<C>,
        "Sinew: a constraint correction has no 'void init(InitContext<DataTypes> const& context)'.");
    static_assert(
        CorrectsBySystem<C> || !HasDataTypes<C> || !HasInit<C> || CorrectsState<C>,
        "Sinew: a constraint correction has no 'void addCorrection(VecDeriv& u, VecDeriv const& f, VecCoord "
        "const& x, ConstraintFactors const& factors) const', which adds what forces do.");
  };
};

}  // namespace sinew
