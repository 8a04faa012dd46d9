// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/context/gravity.hpp>
#include <sinew/core/component.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>

#include <string_view>
#include <type_traits>

namespace sinew {

template <class D>
struct MechanicalObject;
template <class D>
struct UniformMass;
template <class D>
struct DiagonalMass;
template <class D>
struct FixedConstraint;
template <class D>
struct PartialFixedConstraint;

namespace gpu {

namespace detail {

template <class C>
struct IsState : std::bool_constant<HasRole<C, role::State>> {};
template <class C>
struct IsMass : std::bool_constant<HasRole<C, role::Mass>> {};
template <class C>
struct IsForceField : std::bool_constant<HasRole<C, role::ForceField>> {};
template <class C>
struct IsConstraint : std::bool_constant<HasRole<C, role::ProjectiveConstraint>> {};
template <class C>
struct IsGravity : std::is_same<C, Gravity> {};
template <class C>
struct IsOdeSolver : std::is_same<C, EulerImplicitSolver> {};
template <class C>
struct IsLinearSolver : std::is_same<C, CGLinearSolver<GraphScattered>> {};
/// What a fused step runs.
template <class C>
struct IsFused : std::disjunction<IsState<C>, IsMass<C>, IsForceField<C>, IsConstraint<C>, IsGravity<C>,
                                  IsOdeSolver<C>, IsLinearSolver<C>> {};
/// What takes part in mechanics and has no place in a fused step, such as a force field that steps change. (A
/// mapping has one, where it leads to no state.)
template <class C>
struct IsForeign
    : std::bool_constant<HasRole<C, role::InteractionForceField> || HasRole<C, role::CollisionModel> ||
                         HasRole<C, role::Carving> || HasRole<C, role::LagrangianConstraint> ||
                         HasRole<C, role::AnimationLoop> || HasRole<C, role::ConstraintSolver> ||
                         HasRole<C, role::ConstraintCorrection> || ActsBeforeStep<C> ||
                         (HasRole<C, role::ForceField> && Resettable<C>) ||
                         (HasRole<C, role::OdeSolver> && !IsOdeSolver<C>::value) ||
                         (HasRole<C, role::LinearSolver> && !IsLinearSolver<C>::value)> {};

}  // namespace detail

/// The fields of a component that a fused step honours, by their names, apart by blanks. All others must have
/// their defaults. Of a force field all are honoured, since its law and its elements are made of them.
inline constexpr std::string_view every_field = "*";
template <class C>
inline constexpr std::string_view fused_fields = HasRole<C, role::ForceField> ? every_field : "";

template <>
inline constexpr std::string_view fused_fields<EulerImplicitSolver> =
    "rayleighStiffness rayleighMass vdamping";
template <>
inline constexpr std::string_view fused_fields<CGLinearSolver<GraphScattered>> =
    "iterations tolerance threshold";
template <>
inline constexpr std::string_view fused_fields<Gravity> = "gravity";
// what the simulation has made of them is loaded
template <class D>
inline constexpr std::string_view fused_fields<MechanicalObject<D>> =
    "position velocity rest_position reset_position reset_velocity translation rotation scale3d history "
    "last_solution points_of_topology starts_empty";
template <class D>
inline constexpr std::string_view fused_fields<UniformMass<D>> = "vertexMass totalMass";
template <class D>
inline constexpr std::string_view fused_fields<DiagonalMass<D>> = "massDensity totalMass vertexMass";
template <class D>
inline constexpr std::string_view fused_fields<FixedConstraint<D>> = "indices fixAll";
template <class D>
inline constexpr std::string_view fused_fields<PartialFixedConstraint<D>> = "indices fixAll fixedDirections";

namespace detail {

/// Whether all names of a list are those of fields of C.
template <class C>
constexpr bool are_fields_of(std::string_view names) {
  bool all = true;
  for_each_name(names, [&](std::string_view name) {
    bool found = false;
    for_each_field_of<C>([&](auto const& field) { found = found || field.name == name; });
    all = all && found;
  });
  return all;
}

/// Throws Error where a field that a fused step does not honour has another value than by default.
template <class C>
void refuse_other_fields(C const& component) {
  constexpr std::string_view honoured = fused_fields<C>;
  if constexpr (honoured != every_field) {
    static_assert(are_fields_of<C>(honoured), "Sinew: fused_fields names a field that the component lacks.");
    const C plain{};
    for_each_field(component, [&](auto const& field, auto const& value) {
      if (!has_name(honoured, field.name) && !(value == plain.*field.member))
        throw Error("FusedSimulation",
                    text(component_name<C>(),
                         ": ",
                         field.name,
                         " (",
                         field.documentation,
                         ") has another value than its default, which is all that a fused step knows; leave "
                         "it out, or take Simulation"));
    });
  }
}

}  // namespace detail

}  // namespace gpu

}  // namespace sinew
