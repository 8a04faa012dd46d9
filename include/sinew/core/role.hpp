// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <sinew/core/context.hpp>
#include <sinew/core/roles/names.hpp>

#include <array>
#include <concepts>
#include <string_view>
#include <type_traits>

namespace sinew {

/// What a component is in its node. A component names its role (`using Role = role::Mass;`) and fulfils the
/// concept of the role, in the header of its name in core/roles; it has no base class and knows no other
/// component.
namespace role {
#define SINEW_ROLE(Role, kind, name) struct Role;
#include <sinew/core/roles/roles.def>
}  // namespace role

template <class C, class R>
concept HasRole = std::same_as<typename C::Role, R>;

/// The role of a class, as a value.
enum class RoleKind {
#define SINEW_ROLE(Role, kind, name) kind,
#include <sinew/core/roles/roles.def>
};
namespace detail {
inline constexpr std::array role_names{
#define SINEW_ROLE(Role, kind, name) std::string_view(name),
#include <sinew/core/roles/roles.def>
};
template <class Role>
inline constexpr int role_index = -1;
#define SINEW_ROLE(Role, kind, name) \
  template <>                        \
  inline constexpr int role_index<role::Role> = int(RoleKind::kind);
#include <sinew/core/roles/roles.def>
}  // namespace detail
constexpr auto const& enum_names(RoleKind) { return detail::role_names; }
template <class Role>
constexpr RoleKind role_kind() {
  return RoleKind(detail::role_index<Role>);
}

/// What a component promises by its role, in the header of the role: `kept<C>`, whether C fulfils the
/// concept; `assembled<C>`, whether it also does what solvers ask of it that assemble a matrix; and what says
/// in a sentence for each function that it is missing. Of the roles whose headers have none nothing is asked.
struct NoPromise {
  template <class C>
  static constexpr bool kept = true;
  template <class C>
  static constexpr bool assembled = true;
  template <class C>
  struct Broken {};
  template <class C>
  struct NotAssembled {};
};
template <class R>
struct Promise : NoPromise {};

/// A hook that a component has (`named`) is called where it has the right signature.
constexpr bool is_called(bool named, bool rightly) { return !named || rightly; }

// parts of the concepts of several roles

template <class D>
concept IsDataTypes = requires {
  typename D::Real;
  typename D::VecCoord;
  typename D::VecDeriv;
};
/// A component over DataTypes: those of the state on which it acts.
template <class C>
concept HasDataTypes = IsDataTypes<typename C::DataTypes>;
/// A component that is initialised on one state, or on two.
template <class C>
concept HasInit =
    HasDataTypes<C> && requires(C c, InitContext<typename C::DataTypes> const context) { c.init(context); };
template <class C>
concept HasInitOfTwo = HasDataTypes<C> && requires(C c, InitContext<typename C::DataTypes> const context) {
  c.init(context, context);
};
/// A component between two states, at the paths that its `ends` name.
template <class C>
concept JoinsTwo = HasRole<C, role::InteractionForceField> || requires {
  typename C::Ends;
  requires C::between;
};

}  // namespace sinew
