// SPDX-License-Identifier: BSL-1.0
#pragma once

// A typed scene whose steps are timed:
//   Simulation sim{profiled(node<"root">(...))};
//   ...
//   std::cout << profile_table(sim.root().profile());   // scene/profile_report.hpp
// A scene without `profiled` has no trace of it.
#include <sinew/core/profile.hpp>
#include <sinew/scene/scope.hpp>

#include <utility>

namespace sinew {

namespace detail {
/// "liver/skin"; the root is "".
template <class S>
std::string profiled_path() {
  if constexpr (requires { typename S::Above::NodeType; }) {
    const std::string above = profiled_path<typename S::Above>();
    return text(above, above.empty() ? "" : "/", S::NodeType::name.view());
  } else {
    return "";
  }
}
template <class S>
std::string profiled_place() {
  const std::string path = profiled_path<S>();
  return path.empty() ? std::string(S::NodeType::name.view()) : path;
}
template <class S, class C>
inline constexpr ProfiledClass profiled_class{&profiled_place<S>, &component_name<C>};
}  // namespace detail

/// What is above the root of a typed scene that is profiled.
struct ProfiledTop : NoScope {
  static constexpr bool profiled = true;
  mutable Profile timer{};

  Profile& profile() const { return timer; }
  Span span(Phase phase) const { return {&timer, phase}; }
  template <class S, class C>
  Span visit(S const& scope, C const& component) const {
    const auto place = reinterpret_cast<char const*>(&component) - reinterpret_cast<char const*>(&scope.node);
    return {&timer, {&detail::profiled_class<S, C>, int(place)}};
  }
};

/// The root of a typed scene with the profile of its steps; a copy of the scene has one of its own.
template <class N>
struct ProfiledNode : N {
  ProfiledTop aboveRoot{};

  Profile& profile() const { return aboveRoot.timer; }
};
template <class N>
struct ScopeOf<ProfiledNode<N>, NoScope> {
  using type = Scope<N, ProfiledTop>;
};

/// The scene with timers. With room for events the profile can be written as a trace.
template <class N>
ProfiledNode<N> profiled(N root, Profile profile = Profile()) {
  return {std::move(root), {{}, std::move(profile)}};
}

}  // namespace sinew
