// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/context/gravity.hpp>
#include <sinew/core/component.hpp>
#include <sinew/gpu/data_types.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>

#include <sinew/scene/state_contacts.hpp>

#include <cstddef>
#include <string_view>
#include <type_traits>
#include <vector>

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
struct FreeMotionAnimationLoop;
struct ConvexConstraintSolver;

namespace gpu {

namespace detail {

template <class C>
constexpr bool is_on_device() {
  if constexpr (requires { typename C::DataTypes; })
    return OnDevice<typename C::DataTypes>;
  else
    return false;
}
template <class C>
struct IsState : std::bool_constant<HasRole<C, role::State> && is_on_device<C>()> {};
/// A state that no solver may move.
template <class C>
struct IsStanding : std::bool_constant<HasRole<C, role::State> && !is_on_device<C>()> {};
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
// of contacts
template <class C>
struct IsLoop : std::is_same<C, FreeMotionAnimationLoop> {};
template <class C>
struct IsConstraintSolver : std::is_same<C, ConvexConstraintSolver> {};
template <class C>
struct IsCollisionModel : std::bool_constant<HasRole<C, role::CollisionModel>> {};
template <class C>
struct IsPointModel : std::bool_constant<sinew::detail::is_found_by_states<C>()> {};
template <class C>
struct IsPipeline : std::bool_constant<HasRole<C, role::CollisionPipeline>> {};
template <class C>
struct IsContactManager : std::bool_constant<HasRole<C, role::ContactManager>> {};
template <class C>
constexpr bool is_intersection_of_device() {
  if constexpr (HasRole<C, role::Intersection>)
    return sinew::detail::MeetsAnySurface<C> && !C::continuous && !ChoosesModels<C>;
  else
    return false;
}
template <class C>
struct IsIntersection : std::bool_constant<is_intersection_of_device<C>()> {};
/// What a fused step runs.
template <class C>
struct IsFused : std::disjunction<IsState<C>, IsMass<C>, IsForceField<C>, IsConstraint<C>, IsGravity<C>,
                                  IsOdeSolver<C>, IsLinearSolver<C>, IsLoop<C>, IsConstraintSolver<C>> {};
/// What takes part in mechanics and is more than a body of elements that one solver moves, such as a force
/// field that steps change. (A mapping that leads to no state is not.)
template <class C>
struct IsMoreThanABody
    : std::bool_constant<HasRole<C, role::InteractionForceField> || HasRole<C, role::Carving> ||
                         HasRole<C, role::Cutting> || HasRole<C, role::StepDivision> ||
                         HasRole<C, role::LagrangianConstraint> || HasRole<C, role::ConstraintCorrection> ||
                         ActsBeforeStep<C> ||
                         (HasRole<C, role::ForceField> && Resettable<C> && !IdleBeforeStep<C>)> {};
/// What has no place in a fused step.
template <class C>
struct IsForeign : std::bool_constant<IsMoreThanABody<C>::value ||
                                      (HasRole<C, role::AnimationLoop> && !IsLoop<C>::value) ||
                                      (HasRole<C, role::ConstraintSolver> && !IsConstraintSolver<C>::value) ||
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
template <class Matrix>
inline constexpr std::string_view fused_fields<CGLinearSolver<Matrix>> = "iterations tolerance threshold";
template <>
inline constexpr std::string_view fused_fields<Gravity> = "gravity";
template <>
inline constexpr std::string_view fused_fields<ConvexConstraintSolver> =
    "tolerance momentumTolerance maxUpdates maxIterations stopsUnsolved";
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

/// Throws Error where a field that a fused step, or `who`, does not honour has another value than by default.
template <class C>
void refuse_other_fields(C const& component, char const* who = "FusedSimulation") {
  constexpr std::string_view honoured = fused_fields<C>;
  if constexpr (honoured != every_field) {
    static_assert(are_fields_of<C>(honoured), "Sinew: fused_fields names a field that the component lacks.");
    const C plain{};
    for_each_field(component, [&](auto const& field, auto const& value) {
      if (!has_name(honoured, field.name) && !(value == plain.*field.member))
        throw Error(who,
                    text(component_name<C>(),
                         ": ",
                         field.name,
                         " (",
                         field.documentation,
                         ") has another value than its default, which is all that ",
                         who,
                         " knows; leave it out, or take Simulation"));
    });
  }
}

/// held[i] |= the components of point i that a constraint holds, as bits.
template <class D, class C, class Bits>
void note_held(C const& constraint, std::vector<Bits>& held) {
  auto hold = [&](int i, int bits) { held[std::size_t(i)] = Bits(held[std::size_t(i)] | bits); };
  if constexpr (requires { constraint.fixedDirections; }) {
    for (const int i : constraint.held)
      for (int c = 0; c < 3; ++c) hold(i, constraint.fixedDirections[std::size_t(c)] << c);
  } else {
    static_assert(std::is_same_v<C, FixedConstraint<D>>,
                  "Sinew: FusedSimulation and DistributedSimulation know FixedConstraint and "
                  "PartialFixedConstraint; a scene with others is stepped by Simulation.");
    for (const int i : constraint.held) hold(i, 7);
  }
}

}  // namespace detail

}  // namespace gpu

}  // namespace sinew
