// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>
#include <sinew/core/roles/force_field.hpp>

namespace sinew {

// A force between two states, at the paths that its Ends name. The shortest:
//
//   /// Pulls the first points of two states together.   E = 1/2 |d|^2 [J],   d = x2 - x1
//   template <class Between>
//   struct Tie {
//     using Role = role::InteractionForceField;
//     using DataTypes = Vec3d;
//     using Ends = Between;
//     using V = Vec3d::VecDeriv;
//     static constexpr std::string_view className = "Tie";
//     static constexpr auto fields() { return field_list(); }
//
//     void init(InitContext<Vec3d> const&, InitContext<Vec3d> const&) {}
//     void addForce(MechanicalParams const&, V& f1, V& f2, Vec3d::VecCoord const& x1, Vec3d::VecCoord const&
//     x2,
//                   V const&, V const&) const {
//       f1[0] += x2[0] - x1[0];
//       f2[0] += x1[0] - x2[0];
//     }
//     void addDForce(MechanicalParams const& p, V& df1, V& df2, V const& dx1, V const& dx2) const {
//       df1[0] += p.k * (dx2[0] - dx1[0]);
//       df2[0] += p.k * (dx1[0] - dx2[0]);
//     }
//     double potentialEnergy(Vec3d::VecCoord const& x1, Vec3d::VecCoord const& x2) const {
//       return (x2[0] - x1[0]).squaredNorm() / 2;
//     }
//   };

template <class C>
concept HasEnds = requires { typename C::Ends; };
/// The same as those of a force field, each with the vectors of both states.
template <class C>
concept HasAddForceOfTwo =
    (ElementForce<C> && !named::addForce<C>) ||
    requires(C c, MechanicalParams const p, typename C::DataTypes::VecDeriv f,
             typename C::DataTypes::VecCoord const x,
             typename C::DataTypes::VecDeriv const v) { c.addForce(p, f, f, x, x, v, v); };
template <class C>
concept HasAddDForceOfTwo =
    (ElementForce<C> && !named::addDForce<C>) ||
    requires(C c, MechanicalParams const p, typename C::DataTypes::VecDeriv df,
             typename C::DataTypes::VecDeriv const dx) { c.addDForce(p, df, df, dx, dx); };
template <class C>
concept HasPotentialEnergyOfTwo = (ElementForce<C> && !named::potentialEnergy<C>) ||
                                  requires(C c, typename C::DataTypes::VecCoord const x) {
                                    { c.potentialEnergy(x, x) } -> std::convertible_to<double>;
                                  };

template <class C>
concept InteractionForceField = HasRole<C, role::InteractionForceField> && HasEnds<C> && HasInitOfTwo<C> &&
                                HasAddForceOfTwo<C> && HasAddDForceOfTwo<C> && HasPotentialEnergyOfTwo<C>;

// Hook: AddsToMatrix, as force fields have it, with sink.add<Side, Side>(i, j, block).

template <>
struct Promise<role::InteractionForceField> : NoPromise {
  template <class C>
  static constexpr bool kept = InteractionForceField<C>;
  template <class C>
  static constexpr bool assembled = AddsToMatrix<C>;

  template <class C>
  struct Broken {
    static_assert(HasDataTypes<C>,
                  "Sinew: an interaction has no DataTypes; write 'using DataTypes = D;' with those of the "
                  "states that it joins, such as Vec3d.");
    static_assert(HasEnds<C>,
                  "Sinew: an interaction has no Ends, which name the two states that it joins; write 'using "
                  "Ends = Between<\"left\", \"right\">;'.");
    static_assert(!HasDataTypes<C> || HasInitOfTwo<C>,
                  "Sinew: an interaction has no 'void init(InitContext<DataTypes> const& first, "
                  "InitContext<DataTypes> const& second)'.");
    static_assert(
        !HasDataTypes<C> || HasAddForceOfTwo<C>,
        "Sinew: an interaction has no 'void addForce(MechanicalParams const& p, VecDeriv& f1, VecDeriv& "
        "f2, VecCoord const& x1, VecCoord const& x2, VecDeriv const& v1, VecDeriv const& v2)'.");
    static_assert(!HasDataTypes<C> || HasAddDForceOfTwo<C>,
                  "Sinew: an interaction has no 'void addDForce(MechanicalParams const& p, VecDeriv& df1, "
                  "VecDeriv& df2, VecDeriv const& dx1, VecDeriv const& dx2)'.");
    static_assert(
        !HasDataTypes<C> || HasPotentialEnergyOfTwo<C>,
        "Sinew: an interaction has no 'double potentialEnergy(VecCoord const& x1, VecCoord const& x2) "
        "const' [J]; it may return 0.");
  };
  template <class C>
  struct NotAssembled {
    static constexpr bool adds = AddsToMatrix<C>;  // compilers explain a concept at length
    static_assert(
        adds,
        "Sinew: an interaction is under a linear solver that assembles a matrix, and has no 'template "
        "<class Sink> void addToMatrix(MechanicalParams const& p, Sink const& sink)', which adds its "
        "blocks by sink.template add<0, 1>(i, j, block); add it, or take CGLinearSolver<> without a "
        "matrix.");
  };
};

}  // namespace sinew
