// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>
#include <sinew/core/roles/ode_solver.hpp>

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
/// Its points do not feel each other: answer(point, f, factors) is what C f is for a force on one, so that what a row does
/// costs no more than its points.
template <class C>
concept AnswersByPoint = CorrectsState<C> && requires(C const c, typename C::DataTypes::Deriv const f,
                                                      ConstraintFactors const factors) {
  { c.answer(std::size_t(0), f, factors) } -> std::convertible_to<typename C::DataTypes::Deriv>;
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
