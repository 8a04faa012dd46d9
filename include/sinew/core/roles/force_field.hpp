// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>

namespace sinew {

// A force on the points of the state of its node, or of the nearest above. The shortest:
//
//   /// Pulls each point to the origin.   E = k/2 |x|^2 [J],   f = -k x [N],   df/dx = -k I
//   struct OriginSpring {
//     using Role = role::ForceField;
//     using DataTypes = Vec3d;
//     static constexpr std::string_view className = "OriginSpring";
//
//     double stiffness = 1;
//
//     static constexpr auto fields() {
//       return field_list(field("stiffness", &OriginSpring::stiffness, "N/m", "of each point",
//       range::positive));
//     }
//
//     void init(InitContext<Vec3d> const&) {}
//     void addForce(MechanicalParams const&, Vec3d::VecDeriv& f, Vec3d::VecCoord const& x,
//                   Vec3d::VecDeriv const&) const {
//       for (std::size_t i = 0; i < x.size(); ++i) f[i] -= stiffness * x[i];
//     }
//     void addDForce(MechanicalParams const& p, Vec3d::VecDeriv& df, Vec3d::VecDeriv const& dx) const {
//       for (std::size_t i = 0; i < dx.size(); ++i) df[i] -= p.k * stiffness * dx[i];
//     }
//     double potentialEnergy(Vec3d::VecCoord const& x) const {
//       double energy = 0;
//       for (auto const& point : x) energy += stiffness / 2 * point.squaredNorm();
//       return energy;
//     }
//   };

/// A force that is its fields, a list of elements and their law: `driver`, an ElementDriver made by init.
/// law() is the law with its settings, where it has any; law<L>() where it may be asked for lanes or one
/// element at a time. What forces do is in core/element_force.hpp; the functions that other forces have are
/// left to it, unless the component has one of its own.
template <class C>
concept ElementForce = requires {
  typename C::Driver::Law;
  requires std::same_as<decltype(C::driver), typename C::Driver>;
};

/// f += the forces at (x, v).
template <class C>
concept HasAddForce = (ElementForce<C> && !named::addForce<C>) ||
                      requires(C c, MechanicalParams const p, typename C::DataTypes::VecDeriv f,
                               typename C::DataTypes::VecCoord const x,
                               typename C::DataTypes::VecDeriv const v) { c.addForce(p, f, x, v); };
/// df += (k K + b B) dx at the last addForce.
template <class C>
concept HasAddDForce = (ElementForce<C> && !named::addDForce<C>) ||
                       requires(C c, MechanicalParams const p, typename C::DataTypes::VecDeriv df,
                                typename C::DataTypes::VecDeriv const dx) { c.addDForce(p, df, dx); };
template <class C>
concept HasPotentialEnergy = (ElementForce<C> && !named::potentialEnergy<C>) ||
                             requires(C c, typename C::DataTypes::VecCoord const x) {
                               { c.potentialEnergy(x) } -> std::convertible_to<double>;
                             };

template <class C>
concept PlainForce = HasAddForce<C> && HasAddDForce<C> && HasPotentialEnergy<C>;

template <class C>
concept ForceField = HasRole<C, role::ForceField> && HasInit<C> && PlainForce<C>;

// Hooks, what a force field may have beside these:

/// K = k df/dx + b df/dv at the last addForce, added block by block as sink.add(i, j, block): what solvers
/// need that assemble a matrix.
template <class C>
concept AddsToMatrix =
    (ElementForce<C> && !named::addToMatrix<C>) ||
    requires(C c, MechanicalParams const p, AnySink const sink) { c.addToMatrix(p, sink); };

/// A force that does not depend on positions and velocities: no matrix has anything of it.
template <class C>
concept Load = requires { requires C::isLoad; };

/// The stresses of its elements [Pa] where points are at x, in the axes of the world, from the rest positions
/// in a context: addStress(context, x, stress) adds them, in the order of the elements of the topology.
template <class C>
concept GivesStress =
    HasDataTypes<C> &&
    requires(C const c, InitContext<typename C::DataTypes> const at, typename C::DataTypes::VecCoord const x,
             std::vector<Eigen::Matrix3d> stress) { c.addStress(at, x, stress); };

/// What a force field claims of itself (as `properties()`), and the law suite proves. The defaults are those
/// of an elastic force between points of one body; a field that says nothing claims them all.
struct ForceProperties {
  bool internal = true;      // moving the body as a whole changes nothing, and the forces sum to zero
  bool objective = true;     // the same for rotating it, and torques
  bool conservative = true;  // f = -dE/dx
  bool exactTangent =
      true;  // addDForce is the derivative of addForce everywhere, not only in the undeformed body
  bool inMatrix =
      true;  // addToMatrix has what addDForce has; else nothing, for solvers that assemble a matrix
  bool implicit = true;  // addDForce has it; else forces are those at the start of a step, and it is nothing
};
template <class C>
ForceProperties properties_of(C const& c) {
  if constexpr (requires { c.properties(); })
    return c.properties();
  else
    return {};
}

template <>
struct Promise<role::ForceField> : NoPromise {
  template <class C>
  static constexpr bool kept = ForceField<C>;
  template <class C>
  static constexpr bool assembled = AddsToMatrix<C>;

  template <class C>
  struct Broken {
    static_assert(HasDataTypes<C>,
                  "Sinew: a force field has no DataTypes; write 'using DataTypes = D;' with those of the "
                  "state on which it acts, such as Vec3d.");
    static_assert(!HasDataTypes<C> || HasInit<C>,
                  "Sinew: a force field has no 'void init(InitContext<DataTypes> const& context)'.");
    static_assert(
        !HasDataTypes<C> || HasAddForce<C>,
        "Sinew: a force field has no 'void addForce(MechanicalParams const& p, VecDeriv& f, VecCoord "
        "const& x, VecDeriv const& v)', which adds its forces to f.");
    static_assert(!HasDataTypes<C> || HasAddDForce<C>,
                  "Sinew: a force field has no 'void addDForce(MechanicalParams const& p, VecDeriv& df, "
                  "VecDeriv const& dx)', which adds (p.k df/dx + p.b df/dv) dx to df.");
    static_assert(!HasDataTypes<C> || HasPotentialEnergy<C>,
                  "Sinew: a force field has no 'double potentialEnergy(VecCoord const& x) const' [J]; it may "
                  "return 0.");
  };
  template <class C>
  struct NotAssembled {
    static constexpr bool adds = AddsToMatrix<C>;  // compilers explain a concept at length
    static_assert(
        adds,
        "Sinew: a force field is under a linear solver that assembles a matrix, and has no 'template "
        "<class Sink> void addToMatrix(MechanicalParams const& p, Sink const& sink)', which adds "
        "p.k df/dx + p.b df/dv by sink.add(i, j, block); add it, or take CGLinearSolver<> without a "
        "matrix.");
  };
};

}  // namespace sinew
