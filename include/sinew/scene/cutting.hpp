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
          path = c.body.substr(std::min(c.body.size(), root.path().size() + 1));
          const Body body = this->bodyAt(c.body);
          if (auto sweep = c.sweep(this->bladeOf(c), positionsOf(body)))
            order = CutOrder{sweep->stroke, sweep->rules, sweep->front, sweep->before};
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
    const std::size_t points = pointsOf(c.tool);
    if (points == 0) wrong("toolModel leads to ", c.tool, ", where there is no state with points");
    for (const int i : c.indices)
      if (std::size_t(i) >= points)
        wrong("indices has ", i, ", but the blade has ", points, " points, numbered from 0; correct it");
    if ((c.indices.empty() ? points : c.indices.size()) < 2)
      wrong("the blade is one point; give two or more, in their order along it");
    const Body body = bodyAt(c.body);
    if (!body.topology)
      wrong("bodyModel leads to ", c.body, ", where there is no topology over a state; name the node of one");
    CutBody<RootScope> cut(root, body.topology, body.state);
    c.prepare(cut.positions().size());
  }

  Body bodyAt(std::string const& path) const {
    Body found;
    traverse(root, on<role::Topology>([&](auto& t, auto const& scope) {
               if (!found.topology && scope.path() == path && scope.pointsAddress())
                 found = {&t, scope.pointsAddress()};
             }));
    return found;
  }
  std::vector<Eigen::Vector3d> positionsOf(Body const& body) const {
    std::vector<Eigen::Vector3d> x;
    traverse(root, on<role::State>([&](auto const& s, auto const&) {
               if (static_cast<void const*>(&s) == body.state) x = centers_of(s, s.position);
             }));
    return x;
  }
  std::size_t pointsOf(std::string const& path) const {
    std::size_t count = 0;
    traverse(root, on<role::State>([&](auto const& s, auto const& scope) {
               if (scope.path() == path) count = s.size();
             }));
    return count;
  }
  template <class C>
  std::vector<Eigen::Vector3d> bladeOf(C const& c) const {
    std::vector<Eigen::Vector3d> all, blade;
    traverse(root, on<role::State>([&](auto const& s, auto const& scope) {
               if (scope.path() == c.tool) all = centers_of(s, s.position);
             }));
    if (c.indices.empty()) return all;
    for (const int i : c.indices)
      if (std::size_t(i) < all.size()) blade.push_back(all[std::size_t(i)]);
    return blade;
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
