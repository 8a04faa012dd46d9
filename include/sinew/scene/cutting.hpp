// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/step_warnings.hpp>
#include <sinew/scene/cut_body.hpp>
#include <sinew/scene/path.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace sinew {

/// What the blades of a scene cut before a step.
template <class RootScope>
struct Cutting {
  RootScope const& root;

  /// Throws Error where one has no blade, or nothing to cut, or where something in the body cannot follow.
  void check() const {
    traverse(root, on<role::Cutting>([this](auto& c, auto const& scope) { this->check(c, scope); }));
  }

  /// By cut(path, order), after which the scene is another one, at the same place. Says whether something has
  /// changed.
  template <class F>
  bool make(StepNotes const& notes, F&& cut) const {
    int count = 0;
    traverse(root, on<role::Cutting>([&](auto const&, auto const&) { ++count; }));
    bool any = false;
    for (int number = 0; number < count; ++number) {
      std::optional<CutOrder> order;
      std::string path;
      auto refuse = [&](std::string const& why) {
        at(number, [&](auto& c, auto const& scope) {
          c.refuse(why);
          notes.warn(scope.path(), "a cut was not made", [&] { return text("a cut was not made: ", why); });
        });
      };
      try {
        at(number, [&](auto& c, auto const&) {
          this->look(c);
          auto sweep = c.sweep();
          if (!sweep) return;
          path = c.body.substr(std::min(c.body.size(), root.path().size() + 1));
          order = CutOrder{
              std::move(sweep->stroke), sweep->rules, std::move(sweep->front), std::move(sweep->before)};
        });
        if (!order) continue;
        const auto done = cut(path, *order);
        at(number, [&](auto& c, auto const&) { c.accept(done); });
        any = any || done.change.changes();
      } catch (Error const& error) {
        refuse(error.what());
      }
    }
    return any;
  }

 private:
  struct Body {
    int number = -1;  // of its topology
    void const *topology = nullptr, *state = nullptr;
  };

  template <class C, class S>
  void check(C& c, S const& scope) const {
    auto wrong = [&](auto const&... what) {
      throw Error(scope.path(), text(component_name<C>(), ": ", what...));
    };
    if (c.toolModel.empty()) wrong("toolModel is not given; name the node of the state with the blade");
    if (c.bodyModel.empty())
      wrong("bodyModel is not given; name the node with the topology that is to be cut");
    c.tool = path_from(scope.path(), c.toolModel);
    c.body = path_from(scope.path(), c.bodyModel);
    std::size_t points = 0;
    int number = 0;
    traverse(root, on<role::State>([&](auto const& s, auto const& owner) {
               if (owner.path() == c.tool) points = s.size(), c.toolState = number;
               ++number;
             }));
    if (points == 0) wrong("toolModel leads to ", c.tool, ", where there is no state with points");
    for (const int i : c.indices)
      if (std::size_t(i) >= points)
        wrong("indices has ", i, ", but the blade has ", points, " points, numbered from 0; correct it");
    if ((c.indices.empty() ? points : c.indices.size()) < 2)
      wrong("the blade is one point; give two or more, in their order along it");
    const Body body = bodyWhere([&](int, auto const& owner) { return owner.path() == c.body; });
    if (!body.topology)
      wrong("bodyModel leads to ", c.body, ", where there is no topology over a state; name the node of one");
    c.bodyTopology = body.number;
    CutBody<RootScope>(root, body.topology, body.state);  // it has looked at all that stands on these points
    look(c);
    c.prepare();
  }

  // the first topology over a state for which is(number, scope)
  template <class F>
  Body bodyWhere(F const& is) const {
    Body found;
    int number = 0;
    traverse(root, on<role::Topology>([&](auto& t, auto const& scope) {
               if (!found.topology && scope.pointsAddress() && is(number, scope))
                 found = {number, &t, scope.pointsAddress()};
               ++number;
             }));
    return found;
  }
  // where blade and body are
  template <class C>
  void look(C& c) const {
    const Body body = bodyWhere([&](int number, auto const&) { return number == c.bodyTopology; });
    int number = 0;
    traverse(root, on<role::State>([&](auto const& s, auto const&) {
               if (static_cast<void const*>(&s) == body.state) set_centers(c.positionsNow, s, s.position);
               if (number++ != c.toolState) return;
               if (c.indices.empty()) return set_centers(c.bladeNow, s, s.position);
               c.bladeNow.clear();
               for (const int i : c.indices)
                 if (std::size_t(i) < s.size())
                   c.bladeNow.push_back(center_of(s, s.position[std::size_t(i)]));
             }));
  }
  template <class F>
  void at(int number, F&& f) const {
    int here = 0;
    traverse(root, on<role::Cutting>([&](auto& c, auto const& scope) {
               if (here++ == number) f(c, scope);
             }));
  }
};

}  // namespace sinew
