// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/workers.hpp>
#include <sinew/runtime/erased_assembly.hpp>
#include <sinew/runtime/node.hpp>
#include <sinew/scene/live_engines.hpp>
#include <sinew/scene/scope.hpp>

#include <new>

namespace sinew {

template <class R>
struct RuntimeScope;
template <class R>
void runtime_checks(RuntimeScope<R> const& scope);

/// A node of a runtime tree as traversals, operations and solvers see it: the members of Scope, with every
/// choice made when asked. `atMount`: the place in a typed scene that the top node hangs below.
template <class R>
struct RuntimeScope {
  using NodeType = RuntimeNode<R>;
  using Classes = R;
  static constexpr bool provedAtInit = true, isVisual = false;
  static constexpr bool profiled = true;  // where the top node has a profile
  static constexpr bool threaded = true;  // where a node says so
  static constexpr bool distributed = requires { typename R::Distribution; };
  NodeType& node;
  bool atMount = false;
  Profile* profile = nullptr;

  RuntimeScope(NodeType& n, bool above = false, Profile* timer = nullptr)
      : node(n), atMount(above), profile(timer) {}
  RuntimeScope(NodeType& top, NoScope const&) : node(top), profile(top.profile) { top.mount = {}; }
  /// Of a distributed scene, whose registry says what is known of its parts.
  template <class A>
  requires(A::distributed)
  RuntimeScope(NodeType& top, A const& above) : node(top), profile(top.profile) {
    top.mount = {};
    top.mount.distribution = &above.distribution();
  }
  template <class N, class A>
  RuntimeScope(NodeType& top, Scope<N, A> const& typed) : node(top) {
    using S = Scope<N, A>;
    if constexpr (S::profiled) profile = &typed.profile();
    top.mount = {&typed,
                 [](void const* s) { return static_cast<S const*>(s)->path(); },
                 [](void const* s) { return static_cast<S const*>(s)->gravity(); },
                 [](void const* s) { return static_cast<S const*>(s)->topology(); },
                 [](void const* s) { return static_cast<S const*>(s)->topologyAddress(); },
                 nullptr};
    top.mount.body = [](void const* s, BodySearch next) { return static_cast<S const*>(s)->body(next); };
    static_assert(
        S::distributed == distributed,
        "Sinew: a runtime tree in a distributed scene needs a registry that has `using Distribution = "
        "mpi::Distribution`, and one in another scene a registry without it.");
    if constexpr (S::distributed) top.mount.distribution = &typed.distribution();
    if constexpr (S::threaded) top.mount.workers = typed.workers().workers;
    if constexpr (S::hasState) {
      auto& state = typed.stateScope().node.state();
      using D = typename std::decay_t<decltype(state)>::DataTypes;
      top.mount.state = &state;
      top.mount.dataTypes = data_types_name<D>::value;
      top.mount.mapped = typed.stateScope().mapped();
      top.mount.expand = [](void const* s, int point, JacobianVisitor const& visitor) {
        static_cast<S const*>(s)->template withDofs<D>([&](auto const& dofs) {
          dofs.expand(point, [&](int dof, auto const& j) { detail::emit(visitor, dof, j); });
        });
      };
    }
  }

  template <class Role>
  static constexpr bool always = false;
  template <class Role>
  bool has() const {
    for (auto const& entry : node.components())
      if (entry.component.template is<Role>()) return true;
    return false;
  }
  Mount const& mount() const { return node.mount; }

  RuntimeScope above() const {
    return node.parent() ? RuntimeScope(*node.parent(), false, profile) : RuntimeScope(node, true, profile);
  }
  bool ownsState() const { return atMount ? mount().state != nullptr : node.state() != nullptr; }
  bool hasState() const { return ownsState() || (!atMount && above().hasState()); }
  bool mapped() const { return atMount ? mount().mapped : node.mapping() != nullptr; }
  bool integrates() const { return node.hasIndependent(); }

  std::string path() const {
    if (!atMount) return text(above().path(), '/', node.name);
    return mount().scope ? mount().path(mount().scope) : "";
  }
  Eigen::Vector3d gravity() const {
    if (atMount)
      return mount().scope ? mount().gravity(mount().scope) : Eigen::Vector3d(Eigen::Vector3d::Zero());
    for (auto const& entry : node.components()) {
      Eigen::Vector3d value = Eigen::Vector3d::Zero();
      if (entry.component.template visit<role::Context>([&](auto const& c) { value = c.gravity; }))
        return value;
    }
    return above().gravity();
  }
  SomeWorkers workers() const {
    for (NodeType* n = &node; !atMount && n; n = n->parent())
      if (n->execution()) {
        SomeWorkers found;
        n->execution()->component.template visit<role::Execution>(
            [&](auto const& c) { found = c.workers(); });
        return found;
      }
    return {node.top().mount.workers};
  }
  auto& distribution() const {
    return *static_cast<typename R::Distribution*>(node.top().mount.distribution);
  }
  TopologyView topology() const {
    if (atMount) return mount().scope ? mount().topology(mount().scope) : TopologyView{};
    if (node.topology()) {
      TopologyView view;
      node.topology()->component.template visit<role::Topology>([&](auto const& t) { view = t.view(); });
      return view;
    }
    return node.state() ? TopologyView{} : above().topology();
  }

  RuntimeScope stateScope() const { return ownsState() || atMount ? *this : above().stateScope(); }
  template <class D>
  auto& state() const {
    using S = typename StateOf<R, D>::type;
    static_assert(!std::is_void_v<S>,
                  "Sinew: the registry has no MechanicalObject for the DataTypes of one of its components.");
    const RuntimeScope owner = stateScope();
    return *static_cast<S*>(owner.atMount ? owner.mount().state : owner.node.state()->component.address());
  }
  void const* stateAddress() const {
    const RuntimeScope owner = stateScope();
    return owner.atMount        ? owner.mount().state
           : owner.node.state() ? owner.node.state()->component.address()
                                : nullptr;
  }
  void const* pointsAddress() const {
    if (overEntries()) return nullptr;
    return overParent() ? parentScope().stateAddress() : stateAddress();
  }
  void const* topologyAddress() const {
    if (atMount) return mount().scope ? mount().topologyAddress(mount().scope) : nullptr;
    if (node.topology()) return node.topology()->component.address();
    return node.state() ? nullptr : above().topologyAddress();
  }
  template <class D>
  InitContext<D> context() const {
    return detail::init_context<D>(path(), state<D>(), topology());
  }
  BodyView body(BodySearch next = BodySearch::values) const {
    if (atMount) return mount().scope ? mount().body(mount().scope, next) : BodyView{};
    const bool topologyHere = node.topology() && next != BodySearch::state;
    if (topologyHere && next == BodySearch::values) return {};
    BodyView found;
    if (topologyHere) next = BodySearch::state;
    if (node.state() && next == BodySearch::values)
      next = BodySearch::topology;
    else if (node.state() && next == BodySearch::state)
      node.state()->component.template visit<role::State>([&](auto const& s) {
        if constexpr (BodyView::inSpace<std::decay_t<decltype(s)>>) found = BodyView::over(s);
      });
    if (!found.state) found = above().body(next);
    if (topologyHere) {
      found.topology = topology();
      found.topologyAddress = topologyAddress();
    }
    return found;
  }
  RuntimeScope parentScope() const { return above().stateScope(); }
  template <class D>
  InitContext<D> parentContext() const {
    return parentScope().template context<D>();
  }
  bool overParent() const {
    bool over = false;
    if (!atMount && node.mapping())
      node.mapping()->component.template visit<role::Mapping>(
          [&](auto& mapping) { over = over_parent<std::decay_t<decltype(mapping)>>; });
    return over;
  }
  bool overEntries() const {
    bool over = false;
    if (!atMount && node.mapping())
      node.mapping()->component.template visit<role::Mapping>(
          [&](auto& mapping) { over = over_entries<std::decay_t<decltype(mapping)>>; });
    return over;
  }
  template <class F>
  void withContext(F&& f) const {
    if (overEntries()) return;
    if (overParent()) {
      node.mapping()->component.template visit<role::Mapping>(
          [&](auto& mapping) { f(parentContext<typename std::decay_t<decltype(mapping)>::In>()); });
      return;
    }
    const RuntimeScope owner = stateScope();
    if (!owner.atMount && owner.node.state())
      owner.node.state()->component.template visit<role::State>(
          [&](auto& s) { f(context<typename std::decay_t<decltype(s)>::DataTypes>()); });
  }

  template <class F, class... Roles, class... Args>
  void forEachComponent(RoleVisitor<F, Roles...> const& visitor, Args const&... args) const {
    const auto f = [&](auto& component) { visitor.f(component, args...); };
    if (profile) [[unlikely]]
      return forEachTimed(AnyComponent<R>::template visits<Roles...>(f), AnyComponent<R>::address_of(f));
    for (auto& entry : node.components()) entry.component.template visit<Roles...>(f);
  }
  Span span(Phase phase) const { return {profile, phase}; }
  Span visit(RuntimeEntry<R>& entry) const {
    if (!profile) return {nullptr, {}};
    if (entry.profiled.by != profile)
      entry.profiled = profile->add(text(path(), '/', entry.name), entry.component.name());
    return {profile, {profile, -1 - entry.profiled.number}};
  }
  template <class... Roles, class F>
  void forEachChild(F&& f) const {
    for (auto const& child : node.children()) f(RuntimeScope(*child, false, profile));
  }
  template <class... Roles, class F>
  void forEachChildReversed(F&& f) const {
    auto const& children = node.children();
    for (auto child = children.rbegin(); child != children.rend(); ++child)
      f(RuntimeScope(**child, false, profile));
  }
  template <class F>
  void withMass(F&& f) const {
    if (atMount) return;
    for (auto& entry : node.components())
      if (entry.component.template visit<role::Mass>(f)) return;
  }

  template <class C, class F>
  void located(C const& c, F&& f) const {
    locate(&c, FunctionRef(f));
  }
  template <class C, class F>
  void ifNew(C const& c, InitAgain const& again, F&& f) const {
    initialise(&c, again, FunctionRef(f));
  }
  /// Collects an error, so that all are reported together; raise() throws them.
  template <class F>
  void collect(F&& f) const {
    collectErrors(FunctionRef(f));
  }
  void raise() const {
    auto& errors = node.top().errors;
    if (errors.empty()) return;
    std::string lines;
    for (auto const& e : errors) lines += text(lines.empty() ? "" : "\n", e);
    errors.clear();
    throw Error("", lines);
  }
  void checkFields(InitAgain const& again) const {
    for (auto const& entry : node.components()) {
      auto checked = [&] { entry.component.checkFields(path()); };
      initialise(entry.component.address(), again, FunctionRef(checked));
    }
    forEachChild([&](RuntimeScope const& child) { child.checkFields(again); });
  }
  /// Adds a warning: the simulation goes on, but perhaps not as it was meant.
  void warn(RuntimeEntry<R> const& entry, std::string_view message) const {
    const std::string where = text(path(), ": ", node.labelOf(entry), ": ", message);
    node.top().warnings.push_back(entry.origin.empty() ? where : text(entry.origin, ": ", where));
  }
  void warn(void const* component, std::string_view message) const { warn(node.entryOf(component), message); }
  void check() const {
    if (!node.parent()) node.warnings.clear();
    runtime_checks(*this);
    forEachChild([](RuntimeScope const& child) { child.check(); });
  }
  template <FixedString Path, class F>
  decltype(auto) descend(F&& f) const {
    static_assert(Path.view().empty(),
                  "Sinew: below a runtime node paths are found at run time: find_node(path).");
    return f(*this);
  }
  void settled() const {
    for (auto& entry : node.components()) {
      entry.initialised = true;
      entry.surroundings = surroundings(entry);
    }
    forEachChild([](RuntimeScope const& child) { child.settled(); });
  }
  /// The states, mappings and topologies on which what a component computes at init depends.
  std::vector<void const*> surroundings(RuntimeEntry<R>& entry) const {
    std::vector<void const*> all;
    if (entry.component.template is<role::State>() && !mapped()) return all;
    addSurroundings(all);
    if (const BodyView found = body(); found.state) {
      all.push_back(found.state);
      all.push_back(found.topologyAddress);
    }
    for (auto* end : endsOf(entry))
      if (end) RuntimeScope(*end).addSurroundings(all);
    // masses that it may have asked for
    if (entry.component.template is<role::Mapping>()) {
      parentScope().addMass(all);
    } else if (entry.component.template is<role::ProjectiveConstraint>()) {
      addMass(all);
      for (auto* end : entry.ends)
        if (end) RuntimeScope(*end).addMass(all);
    }
    return all;
  }

  template <class M, class F>
  void withChild(M const&, F&& f) const {
    if (node.state()) {
      if constexpr (!std::is_void_v<typename StateOf<R, typename M::Out>::type>) f(state<typename M::Out>());
    } else if constexpr (std::is_same_v<typename M::Out, Vec3f>) {
      if (node.visual()) node.visual()->component.template visit<role::VisualModel>(f);
    }
  }
  template <class M, class F>
  void forEachParent(M const&, F&& f) const {
    auto const& parents = endsOf(*node.mapping());
    if constexpr (HasTwoKindsOfParents<M>) {
      f(ParentNumber<0>{}, RuntimeScope(*parents[0]).stateScope());
      f(ParentNumber<1>{}, RuntimeScope(*parents[1]).stateScope());
    } else {
      for (std::size_t k = 0; k < parents.size(); ++k) f(k, RuntimeScope(*parents[k]).stateScope());
    }
  }
  template <class M, class F>
  void withMapped(M& mapping, F&& f) const {
    withChild(mapping, [&](auto& child) {
      if constexpr (HasParents<M>)
        forEachParent(mapping, [&](auto k, RuntimeScope const& parent) {
          auto&& part = mapping.part(k);
          f(part, child, parent.template state<InOfParent<M, decltype(k)>>());
        });
      else
        f(mapping, child, parentScope().template state<typename M::In>());
    });
  }
  /// The nodes that an interaction joins, or that a mapping with several parents follows; nulls where there
  /// is none at a path.
  std::vector<RuntimeNode<R>*> const& endsOf(RuntimeEntry<R>& entry) const {
    if (!entry.ends.empty()) return entry.ends;
    if (Linked const* ends = entry.component.ends())
      entry.ends = {node.resolve(ends->object1), node.resolve(ends->object2)};
    else if (auto const* parents = entry.component.parents())
      for (auto const& path : *parents) entry.ends.push_back(node.resolve(path));
    return entry.ends;
  }

  template <class D, class F>
  void withDofs(F&& f) const {
    const RuntimeScope owner = stateScope();
    if (owner.mapped())
      f(ErasedDofs{&owner, &expandScope});
    else
      f(RuntimeDofs<D::size, typename D::Real>{{owner.template state<D>().dofOffset}});
  }

  /// Values that follow others take theirs, below this top node; `follow()` moves what is mapped from a state
  /// that has moved.
  template <class F>
  void updateLive(bool first, F const& follow) const {
    if (first || !node.live.bound) bindLive();
    for (NodeType* graph : node.live.graphs)
      for (auto& target : graph->live.targets)
        if (target.entry)
          RuntimeScope(*target.at, false, profile).updateTarget(target, first, FunctionRef(follow));
  }

  /// A matrix as components see it.
  template <class Matrix>
  static AnyMatrix assembled(Matrix& matrix) {
    return AnyMatrix(matrix);
  }

  template <class C, class F>
  void withEnds(C const& c, F&& f) const {
    auto const& ends = endsOf(node.entryOf(&c));
    f(RuntimeScope(*ends[0]), RuntimeScope(*ends[1]));
  }

  template <class F>
  void withLinearSolver(F&& f) const {
    if (atMount) return;
    for (auto& entry : node.components())
      if (entry.component.template is<role::LinearSolver>()) {
        const Span span = visit(entry);
        entry.component.template visit<role::LinearSolver>(f);
        if (profile) [[unlikely]]
          entry.component.template visit<role::LinearSolver>(
              [this](auto const& linear) { count_iterations(*profile, linear); });
        return;
      }
    above().withLinearSolver(f);
  }
  template <class F>
  void withLinearSolverIfAny(F&& f) const {
    withLinearSolver(f);
  }
  template <class F>
  void withContacts(F&& f) const {
    withNearestContacts(f);
    if (atMount) return;
    NodeType& top = node.top();
    for (const std::size_t child : top.listing)
      for (auto& entry : top.children()[child]->components())
        if (entry.component.template visit<role::ContactManager>(f)) break;
  }
  template <class F>
  void withNearestContacts(F&& f) const {
    if (atMount) return;
    for (auto& entry : node.components())
      if (entry.component.template visit<role::ContactManager>(f)) return;
    above().withNearestContacts(f);
  }
  /// Finds the children of this top node whose pipelines list their models.
  void findListing() const {
    node.listing.clear();
    for (std::size_t i = 0; i < node.children().size(); ++i)
      for (auto& entry : node.children()[i]->components())
        if (lists_models(entry.component)) node.listing.push_back(i);
  }
  static bool lists_models(AnyComponent<R> const& component) {
    bool lists = false;
    const_cast<AnyComponent<R>&>(component).template visit<role::CollisionPipeline>(
        [&](auto const& pipeline) { lists = ListsModels<std::decay_t<decltype(pipeline)>>; });
    return lists;
  }

 private:
  // one for all visitors: what is rarely asked for costs the compiler little
  void forEachTimed(detail::VisitTable table, void* visitor) const {
    for (auto& entry : node.components())
      if (entry.component.isVisited(table)) {
        const Span span = visit(entry);
        entry.component.visit(table, visitor);
      }
  }
  // a function of the caller, called before it returns
  struct FunctionRef {
    void const* f;
    void (*call)(void const* f);
    template <class F>
    explicit FunctionRef(F const& function)
        : f(&function), call([](void const* p) { (*static_cast<F const*>(p))(); }) {}
    void operator()() const { call(f); }
  };
  // finds what follows what; a link from a component that was removed is no more
  void bindLive() const {
    node.live.graphs.clear();
    addGraphs(node);
    node.live.bound = true;
  }
  void addGraphs(NodeType& from) const {
    if (!from.live.targets.empty()) node.live.graphs.push_back(&from);
    for (auto& target : from.live.targets) {
      target.at = from.find_node(target.node);
      target.entry = target.at ? target.at->find(target.component) : nullptr;
      if (!target.entry) continue;
      std::erase_if(target.links, [&](LiveLink& link) {
        link.value = static_cast<char*>(target.entry->component.address()) + link.to.offset;
        NodeType* const at = from.find_node(link.from.node);
        RuntimeEntry<R> const* const source = at ? at->find(link.from.component) : nullptr;
        if (source)
          link.source = static_cast<char const*>(source->component.address()) + link.from.offset;
        else if (!link.ofEdits)
          RuntimeScope(*target.at)
              .warn(*target.entry,
                    text(link.to.field,
                         " followed '",
                         link.from.component,
                         "', which is not there any more; it keeps the value that it has"));
        return !source;
      });
    }
    for (auto const& child : from.children()) addGraphs(*child);
  }
  void updateTarget(typename LiveGraph<R>::Target& target, bool first, FunctionRef follow) const {
    auto const& component = target.entry->component;
    const auto label = [&] { return text(path(), ": ", node.labelOf(*target.entry)); };
    for (LiveLink& link : target.links) {
      if (link.ofEdits && !first) continue;
      if (link.ofEdits && !std::exchange(link.seen, true)) {
        link.from.numbers.get(link.source, link.from.list, link.numbers);
        continue;
      }
      if (first && !link.ofEdits) link.to.numbers.get(link.value, link.to.list, link.numbers);
      if (!link.look()) continue;
      if (link.keepsCount && link.next.size() != link.numbers.size())
        check_count_stays(label(),
                          link.to.field,
                          text("'", link.from.component, "'"),
                          link.next.size(),
                          link.numbers.size());
      if (!link.to.numbers.set(link.value, link.to.list, link.next))
        throw Error(label(),
                    text(link.to.field,
                         " follows ",
                         link.from.field,
                         " of '",
                         link.from.component,
                         "', which has ",
                         link.next.size(),
                         " numbers now; these are no value of it"));
      std::swap(link.numbers, link.next);
      target.pending = true;
    }
    if (!target.pending) return;
    bool moved = false;
    component.template visit<role::Engine>([&](auto& c) { evaluate_engine(c, *this); });
    component.template visit<AnyRole>([&](auto& c) { moved = take_values(c, *this); });
    target.pending = false;
    if (moved) follow();
  }
  void locate(void const* c, FunctionRef f) const {
    auto const& entry = node.entryOf(c);
    try {
      f();
    } catch (Error const& error) {
      throw Error(entry.origin, with_label(error.what(), entry.component.name(), node.labelOf(entry)));
    } catch (std::bad_alloc const&) {
      const std::string where = text(path(), ": ", node.labelOf(entry));
      throw Error(entry.origin.empty() ? where : text(entry.origin, ": ", where),
                  "there is not enough memory for it; make the scene smaller, or give it more");
    }
  }
  void initialise(void const* c, InitAgain const& again, FunctionRef f) const {
    auto& entry = node.entryOf(c);
    if (again && entry.initialised && !again.touches(c) && entry.surroundings == surroundings(entry)) return;
    collect([&] { locate(c, f); });
  }
  void collectErrors(FunctionRef f) const {
    try {
      f();
    } catch (Error const& error) {
      node.top().errors.push_back(error.what());
    }
  }

  void addSurroundings(std::vector<void const*>& all) const {
    const RuntimeScope owner = stateScope();
    all.push_back(stateAddress());
    all.push_back(topologyAddress());
    if (!atMount && node.mapping()) {
      all.push_back(node.mapping()->component.address());
      auto const& parents = endsOf(*node.mapping());
      for (auto* parent : parents)
        if (parent) RuntimeScope(*parent).addSurroundings(all);
      if (parents.empty()) above().addSurroundings(all);
    } else if (!owner.atMount && owner.node.mapping() && &owner.node != &node) {
      owner.addSurroundings(all);
    }
  }

  void addMass(std::vector<void const*>& all) const {
    const RuntimeScope owner = stateScope();
    if (owner.atMount) return;
    for (auto const& other : owner.node.components())
      if (other.component.template is<role::Mass>()) all.push_back(other.component.address());
  }

  // the Jacobian of a point of this scope's state with respect to the independent states above it
  void expand(int point, JacobianVisitor const& visitor) const;
  static void expandScope(void const* self, int point, JacobianVisitor const& visitor) {
    static_cast<RuntimeScope const*>(self)->expand(point, visitor);
  }
};

// Outside the class, so that a program may have it instantiated in one place: runtime/precompiled.hpp.
template <class R>
void RuntimeScope<R>::expand(int point, JacobianVisitor const& visitor) const {
  if (atMount) return mount().expand(mount().scope, point, visitor);
  if (!mapped()) {
    node.state()->component.template visit<role::State>([&](auto const& s) {
      visitor.call(
          visitor.self, s.dofOffset + point * std::decay_t<decltype(s)>::DataTypes::size, 0, nullptr);
    });
    return;
  }
  node.mapping()->component.template visit<role::Mapping>([&](auto const& mapping) {
    using M = std::decay_t<decltype(mapping)>;
    auto expandPart = [&](auto const& part, RuntimeScope const& parent) {
      part.forEachJacobianBlock(point, [&](int pointAbove, auto const& j) {
        detail::expand_behind(j, {&parent, &expandScope}, pointAbove, visitor);
      });
    };
    if constexpr (HasParents<M>)
      forEachParent(mapping,
                    [&](auto k, RuntimeScope const& parent) { expandPart(mapping.part(k), parent); });
    else
      expandPart(mapping, above().stateScope());
  });
}

template <class R, class A>
struct ScopeOf<RuntimeNode<R>, A> {
  using type = RuntimeScope<R>;
};

/// A place in a typed scene for what comes and goes: a runtime node with a name for the compiler.
template <FixedString Name, class R>
struct RuntimePlace : RuntimeNode<R> {
  static constexpr auto name = Name;
  RuntimePlace() : RuntimeNode<R>(std::string(Name.view())) {}
};
template <FixedString Name, class R>
inline constexpr bool is_node<RuntimePlace<Name, R>> = true;
template <FixedString Name, class R, class A>
struct ScopeOf<RuntimePlace<Name, R>, A> {
  using type = RuntimeScope<R>;
};

}  // namespace sinew
