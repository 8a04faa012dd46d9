// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/scope.hpp>
#include <sinew/scene/rules.hpp>
#include <sinew/scene/solvers.hpp>

#include <map>
#include <set>

namespace sinew {

namespace detail {

/// DataTypes of the state on which components of a scope act; empty where there is none.
template <class R>
std::string_view data_types_at(RuntimeScope<R> const& scope) {
  const RuntimeScope<R> owner = scope.stateScope();
  if (owner.atMount) return owner.mount().dataTypes;
  std::string_view name;
  if (owner.node.state())
    owner.node.state()->component.template visit<role::State>(
        [&](auto const& s) { name = data_types_name<typename std::decay_t<decltype(s)>::DataTypes>::value; });
  return name;
}

/// The node whose ODE solver moves a node: the topmost that has one and something to move; null where there
/// is none, or above a runtime tree.
template <class R>
RuntimeNode<R> const* solver_of(RuntimeNode<R> const& node) {
  if (node.parent())
    if (auto const* above = solver_of(*node.parent())) return above;
  if (!node.hasIndependent()) return nullptr;
  for (auto const& entry : node.components()) {
    bool moves = false;
    entry.component.template visit<role::OdeSolver>(
        [&](auto const& ode) { moves = !stands_beside<std::decay_t<decltype(ode)>>; });
    if (moves) return &node;
  }
  return nullptr;
}

/// Whether a traversal comes to a node before another.
template <class R>
bool comes_before(RuntimeNode<R> const& first, RuntimeNode<R> const& second) {
  RuntimeNode<R> const* branch = &second;
  for (auto* at = second.parent(); at; branch = at, at = at->parent()) {
    if (at == &first) return true;
    for (auto const& child : at->children()) {
      if (child.get() == branch) break;
      if (first.isBelow(*child)) return true;
    }
  }
  return false;
}

/// What rules::broken asks about a component of a runtime node, and what its sentence leaves open: which
/// node, which DataTypes. Whether a topology has tetrahedra is known when it is made, and said by the
/// component.
template <class R>
struct RuntimeFacts {
  using Node = RuntimeNode<R>;
  using Scope = RuntimeScope<R>;
  using Place = rules::Place;
  using Rule = rules::Rule;
  Scope const& scope;
  RuntimeEntry<R>& entry;
  std::string_view dataTypes{}, in{}, in2{}, out{};  // of the component
  std::vector<std::string> paths{};                  // of its ends or parents
  Rule wrongNames = Rule::none;

  Rule named() const { return wrongNames; }
  bool solved() const { return solver_of(scope.node); }
  bool solverAbove() const { return scope.node.parent() && solver_of(*scope.node.parent()); }
  bool solverHere() const { return solver_of(scope.node) == &scope.node; }
  bool integrates() const { return scope.integrates(); }
  bool linearSolver() const {
    bool found = false;
    scope.withLinearSolver([&](auto&) { found = true; });
    return found;
  }
  bool inRoot() const { return !scope.node.parent() && !scope.mount().scope; }
  bool constraintSolver() const { return any_below<role::ConstraintSolver>(scope); }
  bool severalConstraintSolvers() const {
    int count = 0;
    traverse(scope, on<role::ConstraintSolver>([&](auto const&, auto const&) { ++count; }));
    return count > 1;
  }
  bool loopInRoot() const {
    return scope.node.top().mount.scope || Scope(scope.node.top()).template has<role::AnimationLoop>();
  }
  bool pipelineAbove() const {
    for (auto* n = &scope.node; n; n = n->parent())
      if (Scope(*n).template has<role::CollisionPipeline>()) return true;
    for (auto const& ofRoot : scope.node.top().children())
      for (auto const& part : ofRoot->components())
        if (Scope::lists_models(part.component)) return true;
    return false;
  }
  bool pipelineHere() const { return scope.template has<role::CollisionPipeline>(); }
  bool allStages() const {
    return scope.template has<role::BroadPhase>() && scope.template has<role::NarrowPhase>() &&
           scope.template has<role::Intersection>() && scope.template has<role::ContactManager>();
  }
  bool visual() const { return scope.node.visual(); }
  static constexpr bool tetrahedra() { return true; }
  static constexpr bool parentTetrahedra() { return true; }
  Place own() const { return place(scope, dataTypes); }
  Place parent() const { return place(scope.above(), in); }
  Place child() const {
    return {.state = scope.node.state() != nullptr, .sameDataTypes = out == childDataTypes()};
  }
  std::vector<Place> ends() const {
    std::vector<Place> found;
    for (Node* end : nodes()) {
      found.push_back(end ? place(Scope(*end), dataTypes) : Place{.there = false});
      found.back().below = end && end->isBelow(scope.node);
    }
    return found;
  }
  std::vector<Place> parents() const {
    std::vector<Place> found;
    for (Node* node : nodes()) {
      found.push_back(node ? place(Scope(*node), inOf(found.size())) : Place{.there = false});
      found.back().before = node && comes_before(*node, scope.node);
    }
    return found;
  }

  std::string_view inOf(std::size_t parent) const { return parent == 1 && !in2.empty() ? in2 : in; }

  std::string details(rules::Broken const& broken) const {
    const std::size_t which = broken.which;
    switch (broken.rule) {
      case Rule::otherDataTypes:
        return text(dataTypes, " on ", data_types_at(scope));
      case Rule::mappingIn:
        return text(in, " from ", data_types_at(scope.above()));
      case Rule::mappingOut:
        return text(out, " to ", childDataTypes());
      case Rule::solverBelowSolver:
        return text("that of '", solver_of(*scope.node.parent())->path(), "'");
      case Rule::stateAcrossSolvers:
        return text("the state of '",
                    paths.empty() ? scope.stateScope().path() : Scope(*nodes()[which]).stateScope().path(),
                    "', the solver of '",
                    solver_of(scope.node)->path(),
                    "'");
      case Rule::parentsAcrossSolvers:
        if (paths.empty()) return text("at '", scope.above().stateScope().path(), "'");
        [[fallthrough]];
      case Rule::noParentNode:
      case Rule::parentComesLater:
      case Rule::parentWithoutState:
        return text("at '", paths[which], "'");
      case Rule::parentOfOtherDataTypes:
        return text(
            inOf(which), " from ", data_types_at(Scope(*nodes()[which])), ", at '", paths[which], "'");
      case Rule::endOfOtherDataTypes:
        return text(dataTypes,
                    " on ",
                    data_types_at(Scope(*nodes()[which])),
                    ", object",
                    which + 1,
                    " at '",
                    paths[which],
                    "'");
      case Rule::noEnd:
      case Rule::endNotBelow:
      case Rule::endWithoutState:
        return text("object", which + 1, " at '", paths[which], "'");
      default:
        return {};
    }
  }

 private:
  std::string_view childDataTypes() const {
    return scope.node.state() ? data_types_at(scope) : std::string_view("Vec3f");
  }
  std::vector<Node*> const& nodes() const { return scope.endsOf(entry); }
  Place place(Scope const& at, std::string_view wanted) const {
    const std::string_view found = data_types_at(at);
    const Scope owner = at.stateScope();
    return {.state = !found.empty(),
            .sameDataTypes = found == wanted,
            .mapped = owner.mapped(),
            .sameSolver = owner.atMount || solver_of(owner.node) == solver_of(scope.node)};
  }
};

/// An Error, or a warning, with the sentence of a rule.
template <class R>
void say(RuntimeScope<R> const& scope, RuntimeEntry<R> const& entry, rules::Rule rule,
         std::string const& details) {
  rules::Sentence const& sentence = rules::sentence(rule);
  const std::string message =
      text(sentence.cause, details.empty() ? "" : text(" (", details, ")"), "; ", sentence.remedy);
  if (rules::only_warns(rule)) return scope.warn(entry, message);
  const std::string where = text(scope.path(), ": ", scope.node.labelOf(entry));
  if (entry.origin.empty()) throw Error(where, message);
  throw Error(entry.origin, text(where, ": ", message));
}

template <class R>
struct RuntimeChecker {
  RuntimeScope<R> const& scope;
  RuntimeEntry<R>& entry;

  template <class C>
  void operator()(C& c) const {
    constexpr rules::Kind kind = rules::kind_of<C>();
    RuntimeFacts<R> facts{scope, entry};
    entry.ends.clear();
    if constexpr (kind.joins || kind.acts) facts.dataTypes = data_types_name<typename C::DataTypes>::value;
    if constexpr (kind.maps) {
      facts.in = data_types_name<typename C::In>::value;
      facts.out = data_types_name<typename C::Out>::value;
    }
    if constexpr (kind.joins) {
      static_assert(HasLinkedEnds<C>,
                    "Sinew: a component of a registry names its ends in its type, which are unknown to a "
                    "runtime tree; use ends of type Linked.");
      facts.paths = {c.ends.object1, c.ends.object2};
    }
    if constexpr (kind.severalParents) {
      static_assert(HasLinkedParents<C>,
                    "Sinew: a mapping of a registry names its parents in its type, which are unknown to a "
                    "runtime tree; use LinkedParents.");
      facts.paths = c.parents.paths;
      if (facts.paths.empty()) facts.wrongNames = rules::Rule::noParents;
      if constexpr (HasTwoKindsOfParents<C>) {
        facts.in2 = data_types_name<typename C::In2>::value;
        if (facts.paths.size() != 2) facts.wrongNames = rules::Rule::notTwoParents;
      }
    }
    if (const rules::Broken broken = rules::broken<kind>(facts); broken.rule != rules::Rule::none)
      say(scope, entry, broken.rule, facts.details(broken));
  }
};

/// What a node has too many of.
template <class R>
void check_counts(RuntimeScope<R> const& scope) {
  using rules::Rule;
  std::map<std::pair<Rule, int>, RuntimeEntry<R>*> first;
  for (auto& entry : scope.node.components()) {
    auto one = [&]<class Role>(Rule rule, int stage = 0) {
      if (!entry.component.template is<Role>()) return;
      bool beside = false;
      entry.component.template visit<role::OdeSolver>(
          [&](auto const& ode) { beside = stands_beside<std::decay_t<decltype(ode)>>; });
      if (beside) return;
      RuntimeEntry<R>*& earlier = first[{rule, stage}];
      if (earlier)
        scope.collect([&] { say(scope, entry, rule, text("beside ", scope.node.labelOf(*earlier))); });
      else
        earlier = &entry;
    };
    one.template operator()<role::State>(Rule::secondState);
    one.template operator()<role::VisualModel>(Rule::secondState);
    one.template operator()<role::Mapping>(Rule::secondMapping);
    one.template operator()<role::Mass>(Rule::secondMass);
    one.template operator()<role::OdeSolver>(Rule::secondSolver);
    one.template operator()<role::Topology>(Rule::secondTopology);
    one.template operator()<role::CollisionPipeline>(Rule::secondStage, 1);
    one.template operator()<role::BroadPhase>(Rule::secondStage, 2);
    one.template operator()<role::NarrowPhase>(Rule::secondStage, 3);
    one.template operator()<role::Intersection>(Rule::secondStage, 4);
    one.template operator()<role::ContactManager>(Rule::secondStage, 5);
    one.template operator()<role::AnimationLoop>(Rule::secondLoop, 1);
    one.template operator()<role::ConstraintSolver>(Rule::secondLoop, 2);
    one.template operator()<role::StepDivision>(Rule::secondLoop, 3);
  }
  std::set<std::string_view> names;
  for (auto const& child : scope.node.children())
    if (!names.insert(child->name).second)
      scope.collect([&] {
        rules::Sentence const& sentence = rules::sentence(Rule::sameNames);
        throw Error(scope.path(), text(sentence.cause, " ('", child->name, "'); ", sentence.remedy));
      });
}

}  // namespace detail

/// Checks one runtime node against the rules of scene/rules.hpp. Throws Error.
template <class R>
void runtime_checks(RuntimeScope<R> const& scope) {
  detail::check_counts(scope);
  for (auto& entry : scope.node.components())
    scope.collect([&] { entry.component.template visit<AnyRole>(detail::RuntimeChecker<R>{scope, entry}); });
}

}  // namespace sinew
