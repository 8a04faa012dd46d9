// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>

namespace sinew {

// The mass of the state of its node, or of the nearest above. The shortest:
//
//   /// A mass of 1 kg in each point.
//   struct UnitMass {
//     using Role = role::Mass;
//     using DataTypes = Vec3d;
//     static constexpr std::string_view className = "UnitMass";
//     static constexpr auto fields() { return field_list(); }
//
//     void init(InitContext<Vec3d> const&) {}
//     void addForce(MechanicalParams const& p, Vec3d::VecDeriv& f, Vec3d::VecCoord const&,
//                   Vec3d::VecDeriv const&) const {
//       for (auto& force : f) force += p.gravity;
//     }
//     void addMDx(Vec3d::VecDeriv& f, Vec3d::VecCoord const&, Vec3d::VecDeriv const& dx, double factor) const
//     {
//       for (std::size_t i = 0; i < dx.size(); ++i) f[i] += factor * dx[i];
//     }
//     void accFromF(Vec3d::VecDeriv& a, Vec3d::VecCoord const&, Vec3d::VecDeriv const& f) const { a = f; }
//     double kineticEnergy(Vec3d::VecCoord const&, Vec3d::VecDeriv const& v) const {
//       double energy = 0;
//       for (auto const& velocity : v) energy += velocity.squaredNorm() / 2;
//       return energy;
//     }
//   };

/// f += the weight, and gyroscopic forces of rigids.
template <class C>
concept HasWeight =
    HasDataTypes<C> && requires(C c, MechanicalParams const p, typename C::DataTypes::VecDeriv f,
                                typename C::DataTypes::VecCoord const x,
                                typename C::DataTypes::VecDeriv const v) { c.addForce(p, f, x, v); };
/// f += factor M dx.
template <class C>
concept HasAddMDx = HasDataTypes<C> &&
                    requires(C c, typename C::DataTypes::VecDeriv f, typename C::DataTypes::VecCoord const x,
                             typename C::DataTypes::VecDeriv const dx) { c.addMDx(f, x, dx, 1.0); };
/// a = M^-1 f.
template <class C>
concept HasAccFromF =
    HasDataTypes<C> &&
    requires(C c, typename C::DataTypes::VecDeriv a, typename C::DataTypes::VecCoord const x,
             typename C::DataTypes::VecDeriv const f) { c.accFromF(a, x, f); };
template <class C>
concept HasKineticEnergy = HasDataTypes<C> && requires(C c, typename C::DataTypes::VecCoord const x,
                                                       typename C::DataTypes::VecDeriv const v) {
  { c.kineticEnergy(x, v) } -> std::convertible_to<double>;
};

template <class C>
concept Mass = HasRole<C, role::Mass> && HasInit<C> && HasWeight<C> && HasAddMDx<C> && HasAccFromF<C> &&
               HasKineticEnergy<C>;

// Hooks, what a mass may have beside these:

/// Whether accFromF is M^-1 f, and not that of the sums of the rows; a mass that says nothing has it exactly.
template <class C>
concept HasExactInverse = requires(C c) {
  { c.exactInverse() } -> std::convertible_to<bool>;
};
/// p.m M, added block by block as sink.add(i, j, block): what solvers need that assemble a matrix.
template <class C>
concept AddsMassToMatrix =
    HasDataTypes<C> && requires(C c, MechanicalParams const p, typename C::DataTypes::VecCoord const x,
                                AnySink const sink) { c.addToMatrix(p, x, sink); };

template <>
struct Promise<role::Mass> : NoPromise {
  template <class C>
  static constexpr bool kept = Mass<C> && is_called(named::exactInverse<C>, HasExactInverse<C>);
  template <class C>
  static constexpr bool assembled = AddsMassToMatrix<C>;

  template <class C>
  struct Broken {
    static_assert(
        HasDataTypes<C>,
        "Sinew: a mass has no DataTypes; write 'using DataTypes = D;' with those of the state whose "
        "mass it is, such as Vec3d.");
    static_assert(!HasDataTypes<C> || HasInit<C>,
                  "Sinew: a mass has no 'void init(InitContext<DataTypes> const& context)'.");
    static_assert(
        !HasDataTypes<C> || HasWeight<C>,
        "Sinew: a mass has no 'void addForce(MechanicalParams const& p, VecDeriv& f, VecCoord const& "
        "x, VecDeriv const& v)', which adds its weight, by p.gravity, to f.");
    static_assert(
        !HasDataTypes<C> || HasAddMDx<C>,
        "Sinew: a mass has no 'void addMDx(VecDeriv& f, VecCoord const& x, VecDeriv const& dx, double "
        "factor) const', which adds factor M dx to f.");
    static_assert(
        !HasDataTypes<C> || HasAccFromF<C>,
        "Sinew: a mass has no 'void accFromF(VecDeriv& a, VecCoord const& x, VecDeriv const& f) const', "
        "which makes a = M^-1 f.");
    static_assert(
        !HasDataTypes<C> || HasKineticEnergy<C>,
        "Sinew: a mass has no 'double kineticEnergy(VecCoord const& x, VecDeriv const& v) const' [J].");
    static_assert(is_called(named::exactInverse<C>, HasExactInverse<C>),
                  "Sinew: a mass has an exactInverse that nothing calls; write 'bool exactInverse() const'.");
  };
  template <class C>
  struct NotAssembled {
    static_assert(
        AddsMassToMatrix<C>,
        "Sinew: a mass is under a linear solver that assembles a matrix, and has no 'template <class "
        "Sink> void addToMatrix(MechanicalParams const& p, VecCoord const& x, Sink const& sink) const', "
        "which adds p.m M by sink.add(i, j, block); add it, or take CGLinearSolver<> without a matrix.");
  };
};

}  // namespace sinew
