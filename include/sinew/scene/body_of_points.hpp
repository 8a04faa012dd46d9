// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/follow.hpp>
#include <sinew/scene/scope.hpp>
#include <sinew/scene/states_of.hpp>

#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew {

/// A state and all that have its points, one by one: states, and visual models.
template <class RootScope>
std::set<void const*> same_points(RootScope const& root, void const* state) {
  std::set<void const*> states{state};
  traverse(root, on<role::Mapping>([&](auto& mapping, auto const& scope) {
             scope.withMapped(mapping, [&](auto& part, auto& child, auto& parent) {
               if constexpr (requires { std::decay_t<decltype(part)>::samePoints; })
                 if (states.contains(&parent)) states.insert(&child);
             });
           }));
  return states;
}

/// Where a point of a state is, in space; the origin for what has no place there.
template <class State>
Eigen::Vector3d center_of(State const&, typename State::DataTypes::Coord const& x) {
  using D = typename State::DataTypes;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  if constexpr (D::spatial <= 3 && requires { D::center(x); })
    center.template head<D::spatial>() = D::center(x).template cast<double>();
  return center;
}
template <class State>
void set_centers(std::vector<Eigen::Vector3d>& all, State const& s, typename State::VecCoord const& x) {
  all.resize(x.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = center_of(s, x[i]);
}
template <class State>
std::vector<Eigen::Vector3d> centers_of(State const& s, typename State::VecCoord const& x) {
  std::vector<Eigen::Vector3d> all;
  set_centers(all, s, x);
  return all;
}

/// All states that have the points of one, one by one, with the topologies over them, from the root on, and
/// behind these the visual models.
template <class RootScope>
class BodyOfPoints {
 public:
  struct Body {
    void const* address;  // of a topology or a visual model
    TopologyView view;
    bool editable;
    std::string path;
    std::string_view conversion{};  // by which a topology follows another
    void const* copies = nullptr;   // the topology above a visual model
  };
  std::set<void const*> states{};  // and visual models
  std::vector<Body> bodies{};
  std::set<void const*> mechanical{};  // topologies on which forces and masses act

  BodyOfPoints(RootScope const& root, void const* state) : root_(root) {
    states = same_points(root, state);
    std::vector<Body> looks;
    traverse(root_, on<role::Mapping>([&](auto& mapping, auto const& scope) {
               scope.withMapped(mapping, [&](auto&, auto& child, auto&) {
                 if constexpr (HasRole<std::decay_t<decltype(child)>, role::VisualModel>)
                   if (states.contains(&child))
                     looks.push_back({&child,
                                      {.edges = child.mesh.edges,
                                       .triangles = child.mesh.triangles,
                                       .quads = child.mesh.quads},
                                      true,
                                      scope.path(),
                                      {},
                                      scope.topologyAddress()});
               });
             }));
    traverse(root_, on<role::Topology>([this](auto& t, auto const& scope) {
               if (!states.contains(scope.pointsAddress())) return;
               constexpr bool editable = requires { t.edit(); };
               std::string_view conversion;
               if constexpr (requires { t.conversion; }) conversion = t.conversion;
               bodies.push_back({&t, t.view(), editable, scope.path(), conversion});
             }));
    bodies.insert(bodies.end(), looks.begin(), looks.end());
    traverse(root_, on<role::ForceField, role::Mass>([this](auto&, auto const& scope) {
               mechanical.insert(scope.topologyAddress());
             }));
  }

  /// Throws Error where something has a value for each point, or each element, that cannot be shared out
  /// among those that come, since `why`.
  void checkValues(std::string_view why) const {
    traverse(root_, on<AnyRole>([&](auto& c, auto const& scope) { this->check(c, scope, why); }));
  }

 private:
  RootScope const& root_;

  template <class C, class S>
  void check(C& c, S const& scope, std::string_view why) const {
    auto refuse = [&](std::string_view what) {
      throw Error(text(scope.path(), ": ", component_name<C>()), text(what, ", and ", why));
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
};

}  // namespace sinew
