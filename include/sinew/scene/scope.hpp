// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/scene/node.hpp>

#include <string>
#include <string_view>

namespace sinew {

/// What is above the root of a scene.
struct NoScope {
  static constexpr bool hasState = false, isMapped = false;
  static std::string path() { return ""; }
  static Eigen::Vector3d gravity() { return Eigen::Vector3d::Zero(); }
  static TopologyView topology() { return {}; }
};

namespace detail {
constexpr std::string_view first_name(std::string_view path) { return path.substr(0, path.find('/')); }
template <FixedString Path>
constexpr auto rest_of_path() {
  constexpr std::size_t n = first_name(Path.view()).size();
  if constexpr (n == Path.view().size()) {
    return FixedString("");
  } else {
    char rest[Path.view().size() - n]{};
    std::copy_n(Path.chars + n + 1, sizeof rest, rest);
    return FixedString(rest);
  }
}
}  // namespace detail

/// A node of a typed scene seen from the path that leads to it. All traversals, operations and checks know a
/// tree through these members only; every choice here is made by the compiler.
template <class N, class A>
struct Scope {
  using NodeType = N;
  using Above = A;
  N& node;
  A const& above;

  static constexpr bool ownsState = N::template count<role::State> > 0;
  static constexpr bool hasState = ownsState || A::hasState;
  static constexpr bool isMapped = N::template count<role::Mapping> > 0;
  static constexpr bool isVisual = N::template count<role::VisualModel> > 0;

  static constexpr bool mapped() { return isMapped; }
  static constexpr bool visual() { return isVisual; }
  std::string path() const { return text(above.path(), '/', N::name.view()); }

  Eigen::Vector3d gravity() const {
    if constexpr (N::template count < role::Context >> 0)
      return node.template first<role::Context>().gravity;
    else
      return above.gravity();
  }

  /// The nearest topology upwards, of the nodes that share this node's points.
  TopologyView topology() const {
    if constexpr (N::template count < role::Topology >> 0)
      return node.template first<role::Topology>().view();
    else if constexpr (ownsState)
      return {};
    else
      return above.topology();
  }

  /// The scope that owns the state on which components of this node act: this one, or the nearest above.
  auto const& stateScope() const {
    if constexpr (ownsState)
      return *this;
    else
      return above.stateScope();
  }
  template <class D>
  auto& state() const {
    return stateScope().node.template first<role::State>();
  }
  template <class D>
  auto& parentState() const {
    return above.stateScope().node.template first<role::State>();
  }
  template <class D>
  InitContext<D> context() const {
    return {path(), state<D>().restPosition, topology()};
  }

  template <class F>
  void forEachComponent(F&& f) const {
    hana::for_each(node.components, f);
  }
  template <class F>
  void forEachChild(F&& f) const {
    hana::for_each(node.children, [&](auto& child) {
      f(Scope<std::decay_t<decltype(child)>, Scope>{child, *this});
    });
  }
  /// f(child state, parent state) for the mapping of this node, unless it carries a visual model.
  template <class C, class F>
  void forMechanicalMapping(C const&, F&& f) const {
    if constexpr (ownsState) f(node.state(), above.stateScope().node.state());
  }
  /// The state that this scope owns depends on another through a mapping, or it is independent.
  template <class IfMapped, class IfIndependent>
  void withMappingOrState(IfMapped&& ifMapped, IfIndependent&& ifIndependent) const {
    if constexpr (isMapped)
      ifMapped(node.template first<role::Mapping>(), above.stateScope());
    else
      ifIndependent(node.state());
  }

  /// f(scope) for the node at a path from here, which exists.
  template <FixedString Path, class F>
  decltype(auto) descend(F&& f) const {
    if constexpr (Path.view().empty()) {
      return f(*this);
    } else {
      constexpr int i = N::childIndex(detail::first_name(Path.view()));
      auto& child = hana::at_c<std::size_t(i)>(node.children);
      return Scope<std::decay_t<decltype(child)>, Scope>{child, *this}
          .template descend<detail::rest_of_path<Path>()>(f);
    }
  }
  /// f(scope of the first end, scope of the second) of an interaction in this node.
  template <class C, class F>
  void withEnds(C const&, F&& f) const {
    descend<C::Ends::first>(
        [&](auto const& a) { descend<C::Ends::second>([&](auto const& b) { f(a, b); }); });
  }

  /// f(linear solver) with the nearest one, from this node upwards.
  template <class F>
  void withLinearSolver(F&& f) const {
    if constexpr (N::template count < role::LinearSolver >> 0)
      f(node.template first<role::LinearSolver>());
    else
      above.withLinearSolver(f);
  }
};

/// down(component, scope) from the root to the leaves, up(component, scope) on the way back. Unrolled by the
/// compiler.
template <class S, class Down, class Up>
void traverse(S const& scope, Down&& down, Up&& up) {
  scope.forEachComponent([&](auto& component) { down(component, scope); });
  scope.forEachChild([&](auto const& child) { traverse(child, down, up); });
  scope.forEachComponent([&](auto& component) { up(component, scope); });
}

template <class S, class Down>
void traverse(S const& scope, Down&& down) {
  scope.forEachComponent([&](auto& component) { down(component, scope); });
  scope.forEachChild([&](auto const& child) { traverse(child, down); });
}

}  // namespace sinew
