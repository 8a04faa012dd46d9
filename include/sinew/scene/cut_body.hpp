// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/follow.hpp>
#include <sinew/scene/scope.hpp>
#include <sinew/scene/states_of.hpp>
#include <sinew/topology/blade_crossings.hpp>
#include <sinew/topology/cut_plan.hpp>

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// What is to be cut, and how.
struct CutOrder {
  BladeStroke stroke;
  CutRules rules{};
  CutFront front{};  // what the blade was not done with
  std::vector<Eigen::Vector3d>
      before{};  // where the points were when the blade started; empty: where they are
};

/// What a cut has done.
struct Cut {
  TopologyChange change{};
  std::size_t elements = 0;  // through which the blade has gone
  std::size_t faces = 0;     // that have parted
  CutFront front{};          // what the blade is not done with
};

/// A body that is cut: all states that have its points, one by one, with the topologies and visual models
/// over them.
template <class RootScope>
class CutBody {
 public:
  struct Body {
    void const* address;  // of a topology or a visual model
    TopologyView view;
    bool editable;
    std::string path;
  };
  std::set<void const*> states{};  // and visual models
  std::vector<Body> bodies{};

  /// Throws Error where something stands on these points that cannot follow.
  CutBody(RootScope const& root, void const* topology, void const* state) : root_(root), topology_(topology) {
    states.insert(state);
    collectStates();
    collectBodies();
    traverse(root_, on<AnyRole>([this](auto& c, auto const& scope) { this->check(c, scope); }));
    traverse(root_, on<role::State>([&](auto& s, auto const& scope) {
               if (static_cast<void const*>(&s) == state) take(s, scope.path());
             }));
  }

  /// Where the points are.
  std::vector<Eigen::Vector3d> const& positions() const { return x_; }

  CutPlan plan(CutOrder const& order) const {
    std::vector<TopologyView> views;
    std::vector<bool> grows;
    std::size_t first = 0;
    for (std::size_t t = 0; t < bodies.size(); ++t) {
      if (bodies[t].address == topology_) first = t;
      views.push_back(bodies[t].view);
      grows.push_back(!mechanical_.contains(bodies[t].address));
    }
    TopologyView const& body = views[first];
    if (!order.before.empty() && order.before.size() != x_.size())
      throw Error(bodies[first].path, "the points before the stroke are not those of the body");
    CutFront front = order.front;
    if (!body.tetrahedra.empty())
      add_crossings(body.tetrahedra, x_, order.before, order.stroke, front);
    else
      add_crossings(body.triangles, x_, order.before, order.stroke, front);
    try {
      return plan_cut(rest_, views, first, grows, front, order.rules);
    } catch (Error const& error) {
      throw Error(bodies[first].path, error.what());
    }
  }

 private:
  RootScope const& root_;
  void const* topology_;
  std::set<void const*> mechanical_{};  // topologies on which forces and masses act
  std::vector<Eigen::Vector3d> x_{}, rest_{};

  void collectStates() {
    traverse(root_, on<role::Mapping>([this](auto& mapping, auto const& scope) {
               scope.withMapped(mapping, [&](auto& part, auto& child, auto& parent) {
                 if (!states.contains(&parent)) return;
                 if constexpr (requires { std::decay_t<decltype(part)>::samePoints; }) {
                   states.insert(&child);
                   if constexpr (HasRole<std::decay_t<decltype(child)>, role::VisualModel>)
                     add(child, child.mesh, scope.path());
                 }
               });
             }));
  }
  template <class C>
  void add(C const& model, Mesh const& mesh, std::string path) {
    bodies.push_back({&model, {.edges = mesh.edges, .triangles = mesh.triangles}, true, std::move(path)});
  }
  void collectBodies() {
    traverse(root_, on<role::Topology>([this](auto& t, auto const& scope) {
               if (!states.contains(scope.pointsAddress())) return;
               using T = std::decay_t<decltype(t)>;
               constexpr bool editable = requires { t.edit(); };
               const TopologyView view = t.view();
               bodies.push_back({&t, view, editable, scope.path()});
               if (!view.hexahedra.empty() || !view.quads.empty())
                 throw Error(text(scope.path(), ": ", component_name<T>()),
                             "hexahedra and quads are not cut; give the body tetrahedra "
                             "(Hexa2TetraTopologicalMapping), or triangles");
               if (static_cast<void const*>(&t) != topology_) return;
               if (!editable)
                 throw Error(
                     text(scope.path(), ": ", component_name<T>()),
                     "the elements of this topology are made from a few numbers, and none of them can be "
                     "cut; give the node a MeshTopology with these elements");
               if (view.tetrahedra.empty() && view.triangles.empty())
                 throw Error(text(scope.path(), ": ", component_name<T>()),
                             "there are neither tetrahedra nor triangles to cut; give it some");
             }));
    traverse(root_, on<role::ForceField, role::Mass>([this](auto&, auto const& scope) {
               mechanical_.insert(scope.topologyAddress());
             }));
  }

  // what has a value for each point, or each element, that cannot be shared out among those that come
  template <class C, class S>
  void check(C& c, S const& scope) const {
    auto refuse = [&](std::string_view why) {
      throw Error(text(scope.path(), ": ", component_name<C>()), text(why, ", and its body is to be cut"));
    };
    if constexpr (HasRole<C, role::Mapping>) {
      if constexpr (over_parent<C>)
        scope.withMapped(c, [&](auto&, auto&, auto& parent) {
          if (states.contains(&parent)) refuse("it maps a value from each element; take it away");
        });
    } else if constexpr (ActsOnState<C> && !JoinsTwo<C> && !HasRole<C, role::ProjectiveConstraint>) {
      if (!states.contains(scope.stateAddress())) return;
      for_each_field(c, [&](auto const& fd, auto const& value) {
        if constexpr (detail::is_list<std::decay_t<decltype(value)>>)
          if (fd.entries == Of::points && !fd.numbers && value.size() > 1)
            refuse(text(fd.name, " has a value for each point; give one for all, or a density"));
      });
    }
  }

  template <class State>
  void take(State const& s, std::string const& path) {
    using D = typename State::DataTypes;
    if constexpr (D::rigid || D::spatial != 3 || D::size != 3) {
      throw Error(path, "bodies of points in space are cut (Vec3d, Vec3f), and this state has others");
    } else {
      for (auto const& x : s.position) x_.push_back(x.template cast<double>());
      for (auto const& x : s.restPosition) rest_.push_back(x.template cast<double>());
    }
  }
};

}  // namespace sinew
