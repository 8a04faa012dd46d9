// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/profile.hpp>
#include <sinew/runtime/any_component.hpp>
#include <sinew/runtime/live_graph.hpp>
#include <sinew/runtime/view_element.hpp>

#include <algorithm>
#include <map>
#include <memory>
#include <string_view>
#include <vector>

namespace sinew {

class Workers;
template <class R>
class RuntimeNode;

/// What a runtime tree knows of the typed node that it hangs below, if any: filled in at each traversal.
struct Mount {
  void const* scope = nullptr;
  std::string (*path)(void const*) = nullptr;
  Eigen::Vector3d (*gravity)(void const*) = nullptr;
  TopologyView (*topology)(void const*) = nullptr;
  void const* (*topologyAddress)(void const*) = nullptr;
  void (*expand)(void const*, int point, struct JacobianVisitor const&) = nullptr;
  std::string_view dataTypes{};  // of the state above; empty: none
  void* state = nullptr;
  bool mapped = false;
  Workers* workers = nullptr;
  BodyView (*body)(void const*, BodySearch) = nullptr;
  void* distribution = nullptr;  // of a scene that is distributed
};

/// One component of a runtime node, and what is known of it besides.
template <class R>
struct RuntimeEntry {
  AnyComponent<R> component;
  std::string name;      // by which paths and links find it
  std::string origin{};  // where it was written, for messages: "liver.scn:12:3"
  std::map<std::string, std::string, std::less<>>
      links{};  // fields whose values a scene file took from elsewhere

  // after init
  bool initialised = false;
  std::vector<void const*> surroundings{};  // states, mappings and topologies it was initialised with
  std::vector<RuntimeNode<R>*> ends{};  // of an interaction, or parents of a mapping with several: found when
                                        // first asked for
  ProfileNumber profiled{};
};

/// A node of a scene that is composed while the program runs: components of the classes of a registry R, and
/// children, added and removed at will before the scene starts; afterwards through Simulation::change.
/// Simulation runs it as it runs typed nodes.
template <class R>
class RuntimeNode {
 public:
  using Entry = RuntimeEntry<R>;
  using Verdict = typename AnyComponent<R>::Verdict;
  std::string name;
  Mount mount{};
  std::vector<std::string> errors{};    // of the top node: what init has found wrong so far
  std::vector<std::string> warnings{};  // of the top node: what the last init has noticed
  std::vector<ViewElement> view{};      // of the top node: what a scene file says of how it is looked at
  LiveGraph<R> live{};                  // what follows other values while the scene runs
  std::vector<std::size_t> listing{};   // of the top node: children whose pipelines list their models
  Profile* profile = nullptr;           // of the top node: what times its steps; copies are not timed

  explicit RuntimeNode(std::string n = "root", Verdict = {}) : name(std::move(n)) {}
  RuntimeNode(RuntimeNode const& other)
      : name(other.name),
        mount(other.mount),
        view(other.view),
        live(other.live),
        listing(other.listing),
        entries_(other.entries_) {
    for (auto const& child : other.children_) children_.push_back(std::make_unique<RuntimeNode>(*child));
    adopt();
  }
  RuntimeNode(RuntimeNode&& other) noexcept
      : name(std::move(other.name)),
        mount(other.mount),
        warnings(std::move(other.warnings)),
        view(std::move(other.view)),
        live(std::move(other.live)),
        listing(std::move(other.listing)),
        profile(std::exchange(other.profile, nullptr)),
        entries_(std::move(other.entries_)),
        children_(std::move(other.children_)) {
    adopt();
  }
  RuntimeNode& operator=(RuntimeNode other) noexcept {
    name.swap(other.name);
    mount = other.mount;
    warnings.swap(other.warnings);
    view.swap(other.view);
    std::swap(live, other.live);
    listing.swap(other.listing);
    entries_.swap(other.entries_);
    children_.swap(other.children_);
    adopt();
    return *this;
  }

  // components

  /// Adds a component under a name, by default that of its class, and returns it.
  template <class C>
  C& add(C component, std::string componentName = {}) {
    if (componentName.empty()) componentName = std::string(C::className);
    Entry& entry = add(Entry{AnyComponent<R>::of(std::move(component)), std::move(componentName)});
    return *static_cast<C*>(entry.component.address());
  }
  Entry& add(Entry entry) {
    entries_.push_back(std::move(entry));
    refresh();
    return entries_.back();
  }
  void remove(std::string_view componentName) {
    std::erase_if(entries_, [&](Entry const& entry) { return entry.name == componentName; });
    refresh();
  }
  std::vector<Entry> const& components() const { return entries_; }
  std::vector<Entry>& components() { return entries_; }
  /// The component of a name; null where there is none.
  Entry* find(std::string_view componentName) {
    for (auto& entry : entries_)
      if (entry.name == componentName) return &entry;
    return nullptr;
  }
  /// The first component of class C; null where there is none.
  template <class C>
  C* get() const {
    for (auto const& entry : entries_)
      if (C* c = entry.component.template getIf<C>()) return c;
    return nullptr;
  }
  /// The entry whose component is at an address.
  Entry& entryOf(void const* component) {
    for (auto& entry : entries_)
      if (entry.component.address() == component) return entry;
    throw Error(path(), "a component is not in this node; this is a mistake in Sinew");
  }

  /// How messages name a component: by its class, and where there are several of that in this node by the
  /// name that it was given, or by its place among them, as in "StiffSpringForceField<Vec3d> 'left'" and
  /// "StiffSpringForceField<Vec3d> (2 of 3)".
  std::string labelOf(Entry const& entry) const {
    int seen = 0, place = 0, namesakes = 0;
    for (auto const& other : entries_) {
      if (other.component.type() != entry.component.type()) continue;
      if (++seen; &other == &entry) place = seen;
      namesakes += other.name == entry.name;
    }
    const std::string ofClass = entry.component.name();
    if (seen == 1) return ofClass;
    if (namesakes == 1 && !entry.component.isCalled(entry.name)) return text(ofClass, " '", entry.name, "'");
    return text(ofClass, " (", place, " of ", seen, ')');
  }
  template <class C>
  requires(!std::is_same_v<C, Entry>)
  std::string labelOf(C const& component) {
    return labelOf(entryOf(&component));
  }

  // children

  RuntimeNode& addChild(RuntimeNode child) {
    children_.push_back(std::make_unique<RuntimeNode>(std::move(child)));
    children_.back()->parent_ = this;
    return *children_.back();
  }
  RuntimeNode& addChild(std::string childName) { return addChild(RuntimeNode(std::move(childName))); }
  /// Takes a child out of this node.
  RuntimeNode takeChild(RuntimeNode& child) {
    for (auto c = children_.begin(); c != children_.end(); ++c)
      if (c->get() == &child) {
        RuntimeNode taken(std::move(**c));
        children_.erase(c);
        taken.parent_ = nullptr;
        return taken;
      }
    throw Error(path(), text("'", child.name, "' is no child of this node"));
  }
  std::vector<std::unique_ptr<RuntimeNode>> const& children() const { return children_; }
  RuntimeNode* parent() const { return parent_; }
  RuntimeNode& top() { return parent_ ? parent_->top() : *this; }

  /// The node at a path from here ("liver/skin"; "" is this node); null where there is none.
  RuntimeNode* find_node(std::string_view at) {
    if (at.empty()) return this;
    const std::size_t slash = std::min(at.find('/'), at.size());
    for (auto const& child : children_)
      if (child->name == at.substr(0, slash))
        return child->find_node(at.substr(std::min(slash + 1, at.size())));
    return nullptr;
  }
  /// The node at a path that links use: names, "." and "..", from the top where it starts with '/'. Null
  /// where there is none.
  RuntimeNode* resolve(std::string_view at) {
    RuntimeNode* found = at.starts_with('/') ? &top() : this;
    while (found && !at.empty()) {
      const std::string_view step = at.substr(0, at.find('/'));
      at.remove_prefix(std::min(step.size() + 1, at.size()));
      if (step == "..")
        found = found->parent_;
      else if (!step.empty() && step != ".")
        found = found->find_node(step);
    }
    return found;
  }
  /// Whether this is a node, or one below it.
  bool isBelow(RuntimeNode const& node) const { return this == &node || (parent_ && parent_->isBelow(node)); }
  /// Whether there is a state here or below that no mapping moves.
  bool hasIndependent() const {
    return (state_ && !mapping_) ||
           std::any_of(children_.begin(), children_.end(), [](auto const& c) { return c->hasIndependent(); });
  }
  /// "root/liver/skin".
  std::string path() const { return parent_ ? text(parent_->path(), '/', name) : text('/', name); }

  /// Steps of the scene below this top node are timed from now on; null: no more. The profile has to live as
  /// long.
  void profileWith(Profile* timer) {
    profile = timer;
    if (timer) timer->reserveFor(nameFor(*timer));
  }

  // what steps ask for, found once

  Entry* state() const { return state_; }
  Entry* mapping() const { return mapping_; }
  Entry* visual() const { return visual_; }
  Entry* topology() const { return topology_; }
  Entry* execution() const { return execution_; }

 private:
  std::vector<Entry> entries_{};
  std::vector<std::unique_ptr<RuntimeNode>> children_{};
  RuntimeNode* parent_ = nullptr;
  Entry *state_ = nullptr, *mapping_ = nullptr, *visual_ = nullptr, *topology_ = nullptr,
        *execution_ = nullptr;

  void adopt() {
    for (auto& child : children_) child->parent_ = this;
    live.bound = false;
    clearEnds();
    refresh();
  }
  // names all components for a profile, and counts them
  std::size_t nameFor(Profile& timer) {
    std::size_t count = entries_.size();
    for (auto& entry : entries_)
      entry.profiled = timer.add(text(path(), '/', entry.name), entry.component.name());
    for (auto& child : children_) count += child->nameFor(timer);
    return count;
  }
  void clearEnds() {
    for (auto& entry : entries_) entry.ends.clear();
    for (auto& child : children_) child->clearEnds();
  }
  void refresh() {
    auto first = [&]<class Role>() -> Entry* {
      for (auto& entry : entries_)
        if (entry.component.template is<Role>()) return &entry;
      return nullptr;
    };
    state_ = first.template operator()<role::State>();
    mapping_ = first.template operator()<role::Mapping>();
    visual_ = first.template operator()<role::VisualModel>();
    topology_ = first.template operator()<role::Topology>();
    execution_ = first.template operator()<role::Execution>();
  }
};

template <class R>
inline constexpr bool is_node<RuntimeNode<R>> = true;

}  // namespace sinew
