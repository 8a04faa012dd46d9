// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/assembly.hpp>
#include <sinew/core/phase.hpp>
#include <sinew/scene/node.hpp>

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// What is above the root of a scene.
struct NoScope {
  static constexpr bool hasState = false, isMapped = false, profiled = false, threaded = false,
                        distributed = false;
  static std::string path() { return ""; }
  static Eigen::Vector3d gravity() { return Eigen::Vector3d::Zero(); }
  static TopologyView topology() { return {}; }
  static void const* topologyAddress() { return nullptr; }
  static BodyView body(BodySearch) { return {}; }
  static constexpr OneThread workers() { return {}; }
  template <class F>
  static void withLinearSolverIfAny(F&&) {}
  template <class F>
  static void withNearestContacts(F&&) {}
  static constexpr NotTimed span(Phase) { return {}; }
  template <class S, class C>
  static constexpr NotTimed visit(S const&, C const&) {
    return {};
  }
};

/// Whether an init is the first one, or that of a scene that has changed, in which these components have to
/// be initialised again.
struct InitAgain {
  bool again = false;
  std::vector<void const*> touched{};  // in rising order

  explicit operator bool() const { return again; }
  bool touches(void const* component) const {
    return std::binary_search(touched.begin(), touched.end(), component, std::less<>{});
  }
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
/// The node at a path below a typed node.
template <FixedString Path, class N>
auto& node_at(N& node) {
  if constexpr (Path.view().empty())
    return node;
  else
    return node_at<rest_of_path<Path>()>(
        hana::at_c<std::size_t(N::childIndex(first_name(Path.view())))>(node.children));
}
/// What a component over the points of a state is given. A state with other points than its grid has does not
/// lie where that does.
template <class D, class S>
InitContext<D> init_context(std::string where, S const& state, TopologyView topology) {
  if (!state.pointsOfTopology) topology.places = {};
  return {std::move(where), state.restPosition, topology};
}
}  // namespace detail

template <class N, class A>
struct Scope;

/// The scope of a child of a typed node; other kinds of nodes specialise it.
template <class N, class A>
struct ScopeOf {
  using type = Scope<N, A>;
};

/// The same for traversals: without the child's name, so that equal nodes are seen by one type. Profiles keep
/// names, by which they tell nodes apart.
template <class N, class A>
struct ScopeBelow : ScopeOf<N, A> {};
template <class Name, class Components, class Children, class A>
requires(!A::profiled)
struct ScopeBelow<Node<Name, Components, Children>, A> : ScopeOf<NodeParts<Components, Children>, A> {};

/// A node of a typed scene seen from the path that leads to it. All traversals, operations and solvers know a
/// tree through these members only (RuntimeScope has the same); every choice here is made by the compiler.
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
  static constexpr bool profiled = A::profiled;
  static constexpr bool threaded = A::threaded || N::template count<role::Execution> > 0;
  /// Other processes have other parts of the scene: sinew/mpi/distribution.hpp.
  static constexpr bool distributed = A::distributed;

  /// The node has a component of this role, whatever happens at run time.
  template <class R>
  static constexpr bool always = N::template count<R> > 0;
  /// The node has one now.
  template <class R>
  static constexpr bool has() {
    return always<R>;
  }

  static constexpr bool mapped() { return isMapped; }
  /// Whether there is a state here or below that a solver of this node would move: one that no mapping moves.
  bool integrates() const {
    bool found = ownsState && !isMapped;
    if constexpr (!(ownsState && !isMapped))
      forEachChild<role::State>([&](auto const& child) { found = found || child.integrates(); });
    return found;
  }
  static constexpr bool overParent() {
    if constexpr (isMapped)
      return over_parent<std::decay_t<decltype(std::declval<N&>().template first<role::Mapping>())>>;
    else
      return false;
  }
  static constexpr bool overEntries() {
    if constexpr (isMapped)
      return over_entries<std::decay_t<decltype(std::declval<N&>().template first<role::Mapping>())>>;
    else
      return false;
  }
  std::string path() const {
    if constexpr (requires { N::name; })
      return text(above.path(), '/', N::name.view());
    else
      return text(above.path(), '/', above.nameOf(node));
  }
  /// The name of a child of this node.
  template <class Child>
  std::string_view nameOf(Child const& child) const {
    std::string_view name;
    hana::unpack(node.children, [&](auto const&... c) {
      ((static_cast<void const*>(&c) == &child ? void(name = c.name.view()) : void()), ...);
    });
    return name;
  }

  Eigen::Vector3d gravity() const {
    if constexpr (always<role::Context>)
      return node.template first<role::Context>().gravity;
    else
      return above.gravity();
  }

  /// The threads by which solvers of this node work: those of the nearest node upwards that says so.
  auto workers() const {
    if constexpr (always<role::Execution>)
      return node.template first<role::Execution>().workers();
    else
      return above.workers();
  }

  /// What is known of the parts of a distributed scene.
  auto& distribution() const { return above.distribution(); }

  /// The nearest topology upwards, of the nodes that share this node's points.
  TopologyView topology() const {
    if constexpr (always<role::Topology>)
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
  /// Where the state and the topology of components of this node are; null for none.
  void const* stateAddress() const {
    if constexpr (hasState)
      return &stateScope().node.state();
    else
      return nullptr;
  }
  /// The state over whose points the topology of this node is.
  void const* pointsAddress() const {
    if constexpr (overEntries())
      return nullptr;
    else if constexpr (overParent())
      return parentScope().stateAddress();
    else
      return stateAddress();
  }
  void const* topologyAddress() const {
    if constexpr (always<role::Topology>)
      return &node.template first<role::Topology>();
    else if constexpr (ownsState)
      return nullptr;
    else
      return above.topologyAddress();
  }
  template <class D>
  InitContext<D> context() const {
    return detail::init_context<D>(path(), state<D>(), topology());
  }
  /// The body on which the values of the state of this node lie.
  BodyView body(BodySearch next = BodySearch::values) const {
    if constexpr (always<role::Topology>) {
      if (next == BodySearch::values) return {};
      if (next == BodySearch::topology) {
        BodyView found = bodyState(BodySearch::state);
        found.topology = topology();
        found.topologyAddress = topologyAddress();
        return found;
      }
    }
    return bodyState(next);
  }
  /// The scope that owns the state that the mapping of this node follows.
  auto const& parentScope() const { return above.stateScope(); }
  template <class D>
  auto parentContext() const {
    return parentScope().template context<D>();
  }
  /// f(context) for the points over which the topology of this node is, if there are some.
  template <class F>
  void withContext(F&& f) const {
    if constexpr (overEntries()) {
      return;
    } else if constexpr (overParent()) {
      f(parentContext<typename std::decay_t<decltype(node.template first<role::Mapping>())>::In>());
    } else if constexpr (hasState) {
      f(context<typename std::decay_t<decltype(stateScope().node.state())>::DataTypes>());
    }
  }

  /// f(component, args...) for those with one of the roles of a RoleVisitor.
  template <class F, class... Roles, class... Args>
  void forEachComponent(RoleVisitor<F, Roles...> const& visitor, Args const&... args) const {
    if constexpr (profiled)
      node.forEachComponent(on<Roles...>([&](auto& component) {
        const auto span = visit(*this, component);
        visitor.f(component, args...);
      }));
    else
      node.forEachComponent(visitor, args...);
  }
  /// Times a phase, or what is done with a component of a scope, while the result lives, if the scene is
  /// profiled.
  auto span(Phase phase) const { return above.span(phase); }
  auto& profile() const { return above.profile(); }
  template <class S, class C>
  auto visit(S const& scope, C const& component) const {
    return above.visit(scope, component);
  }
  /// f(scope) for each child, or for each below which a component with one of the roles may be.
  template <class... Roles, class F>
  void forEachChild(F&& f) const {
    hana::unpack(node.children, [&](auto&... child) { (visitChild<Roles...>(f, child), ...); });
  }
  /// The same from the last to the first.
  template <class... Roles, class F>
  void forEachChildReversed(F&& f) const {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (visitChild<Roles...>(f, hana::at_c<sizeof...(I) - 1 - I>(node.children)), ...);
    }(std::make_index_sequence<std::size_t(N::childCount)>{});
  }
  /// What the compiler could not prove is checked at init: that of runtime nodes.
  void check() const {
    forEachChild<NoRole>([](auto const& child) { child.check(); });
  }
  /// Runs a part of init that concerns one component, unless that is initialised already (`again`) and
  /// nothing around it has changed. settled() ends the init.
  template <class C, class F>
  void ifNew(C const& c, InitAgain const& again, F&& f) const {
    if (!again || again.touches(&c)) located(c, f);
  }
  /// Adds to the errors of a component which of its class it is; the path is reported here.
  template <class C, class F>
  void located([[maybe_unused]] C const& c, F&& f) const {
    if constexpr (N::template countOfClass<C> > 1) {
      try {
        f();
      } catch (Error const& error) {
        throw Error({}, with_label(error.what(), component_name<C>(), node.labelOf(c)));
      }
    } else {
      f();
    }
  }
  /// Throws all errors that init of runtime nodes has found so far.
  void raise() const {
    forEachChild<NoRole>([](auto const& child) { child.raise(); });
  }
  void settled() const {
    forEachChild<NoRole>([](auto const& child) { child.settled(); });
  }

  /// f(mass) for that of the state in this node, if it has one.
  template <class F>
  void withMass(F&& f) const {
    if constexpr (always<role::Mass>) f(node.template first<role::Mass>());
  }

  /// f(state or visual model that the mapping of this node moves).
  template <class M, class F>
  void withChild(M&, F&& f) const {
    if constexpr (ownsState)
      f(node.state());
    else
      f(node.visual());
  }
  /// f(number, scope that owns the state) for each parent of a mapping with several.
  template <class M, class F>
  void forEachParent(M&, F&& f) const {
    withParents(f, typename M::Parents{}, [] {
      if constexpr (HasTwoKindsOfParents<M>)
        return ParentNumber<0>{};
      else
        return std::size_t(0);
    }());
  }
  /// f(mapping, child, parent state) for the mapping of this node, or for each part of one with several
  /// parents; the child is a state or a visual model.
  template <class M, class F>
  void withMapped(M& mapping, F&& f) const {
    withChild(mapping, [&](auto& child) {
      if constexpr (HasParents<M>)
        forEachParent(mapping, [&](auto k, auto const& parent) {
          auto&& part = mapping.part(k);
          f(part, child, parent.node.state());
        });
      else
        f(mapping, child, above.stateScope().node.state());
    });
  }

  /// A matrix as components see it: runtime trees have one type for all.
  template <class Matrix>
  static Matrix& assembled(Matrix& matrix) {
    return matrix;
  }
  /// f(degrees of freedom of the state of this scope in an assembled system).
  template <class D, class F>
  void withDofs(F&& f) const {
    if constexpr (!ownsState) {
      above.template withDofs<D>(f);
    } else if constexpr (isMapped) {
      auto& mapping = node.template first<role::Mapping>();
      using M = std::decay_t<decltype(mapping)>;
      if constexpr (HasParents<M>)
        withParentDofs(mapping, f, typename M::Parents{});
      else
        above.stateScope().template withDofs<typename M::In>([&](auto const& dofs) {
          f(MappedDofs<M, std::decay_t<decltype(dofs)>>{mapping, dofs});
        });
    } else {
      f(DirectDofs<D::size>{node.state().dofOffset});
    }
  }

  /// f(scope) for the node at a path from here that may begin with "..", which exists.
  template <FixedString Path, class F>
  decltype(auto) reach(F&& f) const {
    if constexpr (detail::first_name(Path.view()) == "..")
      return above.template reach<detail::rest_of_path<Path>()>(f);
    else
      return descend<Path>(f);
  }
  /// f(scope) for the node at a path from here, which exists.
  template <FixedString Path, class F>
  decltype(auto) descend(F&& f) const {
    if constexpr (Path.view().empty()) {
      return f(*this);
    } else {
      constexpr int i = N::childIndex(detail::first_name(Path.view()));
      auto& child = hana::at_c<std::size_t(i)>(node.children);
      return below(child).template descend<detail::rest_of_path<Path>()>(f);
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
    if constexpr (always<role::LinearSolver>) {
      auto& linear = node.template first<role::LinearSolver>();
      if constexpr (profiled) {
        const auto span = visit(*this, linear);
        f(linear);
        count_iterations(profile(), linear);
      } else {
        f(linear);
      }
    } else {
      above.withLinearSolver(f);
    }
  }
  /// The same, if there is one.
  template <class F>
  void withLinearSolverIfAny(F&& f) const {
    if constexpr (always<role::LinearSolver>)
      withLinearSolver(f);
    else
      above.withLinearSolverIfAny(f);
  }
  /// f(contact manager) with those that may have contacts of models here: the nearest one, from this node
  /// upwards, if there is one, and those of pipelines that list their models.
  template <class F>
  void withContacts(F&& f) const {
    withNearestContacts(f);
    withListedContacts(f);
  }
  template <class F>
  void withNearestContacts(F&& f) const {
    if constexpr (always<role::ContactManager>)
      f(node.template first<role::ContactManager>());
    else
      above.withNearestContacts(f);
  }
  template <class F>
  void withListedContacts(F&& f) const {
    if constexpr (requires { above.withListedContacts(f); })
      above.withListedContacts(f);
    else
      forEachChild<role::ContactManager>([&](auto const& child) {
        with_first<role::CollisionPipeline>(child, [&](auto const& pipeline) {
          if constexpr (ListsModels<std::decay_t<decltype(pipeline)>>)
            with_first<role::ContactManager>(child, f);
        });
      });
  }

 private:
  BodyView bodyState(BodySearch next) const {
    if constexpr (ownsState) {
      using S = std::decay_t<decltype(node.state())>;
      if (next == BodySearch::values) return above.body(BodySearch::topology);
      if constexpr (BodyView::inSpace<S>)
        if (next == BodySearch::state) return BodyView::over(node.state());
    }
    return above.body(next);
  }
  template <class Child>
  auto below(Child& child) const {
    return typename ScopeBelow<Child, Scope>::type{child, *this};
  }
  template <class... Roles, class F, class Child>
  void visitChild(F& f, Child& child) const {
    if constexpr (sizeof...(Roles) == 0 || holds<Child, Roles...>()) f(below(child));
  }
  template <class F, class K, FixedString... Paths>
  void withParents(F& f, Parents<Paths...>, K k) const {
    if constexpr (std::is_same_v<K, std::size_t>)
      (reach<Paths>([&](auto const& parent) { f(k++, parent.stateScope()); }), ...);
    else
      withNumberedParents<K::value>(f, Parents<Paths...>{});
  }
  template <std::size_t K, class F, FixedString Path, FixedString... Paths>
  void withNumberedParents(F& f, Parents<Path, Paths...>) const {
    reach<Path>([&](auto const& parent) { f(ParentNumber<K>{}, parent.stateScope()); });
    if constexpr (sizeof...(Paths) > 0) withNumberedParents<K + 1>(f, Parents<Paths...>{});
  }
  template <class M, class F, class... Found>
  void withParentDofs(M const& mapping, F&& f, Parents<>, Found const&... found) const {
    f(MultiMappedDofs<M, Found...>{mapping, {found...}});
  }
  template <class M, class F, FixedString Path, FixedString... Paths, class... Found>
  void withParentDofs(M const& mapping, F&& f, Parents<Path, Paths...>, Found const&... found) const {
    reach<Path>([&](auto const& parent) {
      parent.template withDofs<InOfParent<M, ParentNumber<sizeof...(found)>>>(
          [&](auto const& dofs) { withParentDofs(mapping, f, Parents<Paths...>{}, found..., dofs); });
    });
  }
};

/// f(component, scope) from the root to the leaves, for the components with one of its roles:
/// traverse(scope, on<role::Mass>([](auto& mass, auto const& scope) {...})).
template <class S, class F, class... Roles>
void traverse(S const& scope, RoleVisitor<F, Roles...> const& visitor) {
  scope.forEachComponent(visitor, scope);
  scope.template forEachChild<Roles...>([&](auto const& child) { traverse(child, visitor); });
}
/// The same on the way back: nodes in the reverse order.
template <class S, class F, class... Roles>
void traverse_back(S const& scope, RoleVisitor<F, Roles...> const& visitor) {
  scope.template forEachChildReversed<Roles...>([&](auto const& child) { traverse_back(child, visitor); });
  scope.forEachComponent(visitor, scope);
}

}  // namespace sinew
