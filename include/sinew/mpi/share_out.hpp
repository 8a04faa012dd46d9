// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/follow.hpp>
#include <sinew/mpi/distribution.hpp>
#include <sinew/scene/scope.hpp>
#include <sinew/scene/states_of.hpp>
#include <sinew/scene/topology_edit.hpp>
#include <sinew/version.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew::mpi {

/// Classes of which each rank can have a part. A component of a user's own says that it can by `static
/// constexpr bool distributed = true`: what it has of points and elements follows by its fields
/// (core/follow.hpp), and what it does at a point needs the elements at that point only.
inline constexpr std::array<std::string_view, 10> distributed_classes{"MechanicalObject",
                                                                      "MeshTopology",
                                                                      "TetrahedronTopology",
                                                                      "UniformMass",
                                                                      "DiagonalMass",
                                                                      "TetrahedronFEMForceField",
                                                                      "FixedConstraint",
                                                                      "EulerImplicitSolver",
                                                                      "EulerExplicitSolver",
                                                                      "PetscLinearSolver"};

template <class C>
constexpr bool is_distributed() {
  if constexpr (requires { C::distributed; })
    return C::distributed;
  else if constexpr (HasRole<C, role::Context> || HasRole<C, role::Engine>)
    return true;  // a value for all points, or data that are there before the scene starts
  else if constexpr (requires { requires C::matrixFree; })
    return C::className == std::string_view("CGLinearSolver");
  else
    return std::find(distributed_classes.begin(), distributed_classes.end(), C::className) !=
           distributed_classes.end();
}

/// Throws Error with all components that are not distributed yet.
template <class RootScope>
void refuse_undistributed(RootScope const& root) {
  std::vector<std::string> all;
  traverse(root, on<AnyRole>([&](auto const& c, auto const& scope) {
             using C = std::decay_t<decltype(c)>;
             if constexpr (!is_distributed<C>()) all.push_back(text(scope.path(), ": ", component_name<C>()));
           }));
  if (all.empty()) return;
  std::string list;
  for (auto const& name : all) list += text("\n  ", name);
  throw Error(root.path(),
              text("not distributed yet ",
                   all.size() == 1 ? "is this component" : "are these components",
                   ", so that the scene runs without --mpi only; leave them out, or run it in one process:",
                   list));
}

/// Shares out a scene that is initialised: each rank keeps its part of each state, of the topologies over it,
/// and of what refers to their points and elements. Returns the addresses of what has to be initialised
/// again.
template <class RootScope>
class ShareOut {
 public:
  ShareOut(RootScope const& root, Distribution& to) : root_(root), to_(to) {}

  std::vector<void const*> apply() {
    traverse(root_, on<role::State>([&](auto& s, auto const& scope) { plan(s, scope); }));
    if (states_.empty())
      throw Error(root_.path(),
                  "the scene has no points that could be shared out among ranks; run it in one process");
    traverse(root_, on<AnyRole>([&](auto& c, auto const& scope) { follow(c, scope); }));
    for (auto& [address, state] : states_) to_.add(Halo(std::move(state.part), to_.ranks().rank()));
    std::vector<void const*> touched;
    traverse(root_, on<AnyRole>([&](auto& c, auto const&) { touched.push_back(&c); }));
    return touched;
  }

 private:
  struct State {
    Part part;
    std::vector<void const*> topologies;
  };
  RootScope const& root_;
  Distribution& to_;
  std::vector<std::pair<void const*, State>> states_{};  // in their order in the scene

  State const* find(void const* address) const {
    for (auto const& [at, state] : states_)
      if (at == address) return &state;
    return nullptr;
  }
  static TopologyChange const& none() {
    static const TopologyChange nothing{};
    return nothing;
  }
  TopologyChange const& ofTopology(void const* address) const {
    for (auto const& [at, state] : states_)
      for (std::size_t t = 0; t < state.topologies.size(); ++t)
        if (state.topologies[t] == address) return state.part.topologies[t];
    return none();
  }

  template <class S, class At>
  void plan(S& s, At const& scope) {
    std::vector<TopologyView> views;
    std::vector<void const*> addresses;
    traverse(root_, on<role::Topology>([&](auto const& t, auto const& at) {
               if (at.pointsAddress() != static_cast<void const*>(&s)) return;
               if constexpr (!editable_topology<std::decay_t<decltype(t)>>)
                 throw Error(
                     at.path(),
                     text(component_name<std::decay_t<decltype(t)>>(),
                          " is made from a few numbers, and no rank can have a part of it; give the node a "
                          "MeshTopology with these elements"));
               views.push_back(t.view());
               addresses.push_back(&t);
             }));
    const std::string where = scope.path();
    compare(where, s, views);
    auto& ranks = to_.ranks();
    std::vector<int> parts;
    if (ranks.rank() == 0) parts = parts_of_points(where, s.size(), views, ranks.size());
    ranks.broadcast(parts, "the parts of the scene, from rank 0");
    states_.emplace_back(
        &s, State{part_of(where, std::move(parts), views, ranks.rank(), ranks.size()), std::move(addresses)});
  }

  // All ranks have the same scene, and the same version of Sinew.
  template <class S>
  void compare(std::string_view where, S const& s, std::vector<TopologyView> const& views) {
    std::uint64_t elements = 14695981039346656037u, points = elements, version = elements;  // FNV-1a
    auto add = [](std::uint64_t& sum, void const* data, std::size_t bytes) {
      for (std::size_t i = 0; i < bytes; ++i)
        sum = (sum ^ static_cast<unsigned char const*>(data)[i]) * 1099511628211u;
    };
    add(version, versionText().data(), versionText().size());
    add(points, s.position.data(), s.position.size() * sizeof s.position[0]);
    detail::for_each_element(views, [&](auto const& e) { add(elements, e.data(), e.size() * sizeof e[0]); });
    const std::vector<std::uint64_t> own{version, std::uint64_t(s.size()), points, elements};
    std::vector<std::uint64_t> first = own;
    to_.ranks().broadcast(first, "what rank 0 has of the scene");
    if (first.size() != own.size() || first[0] != own[0])
      throw Error(
          where,
          text("this is Sinew ", versionText(), ", and rank 0 runs another version; start the same on all"));
    if (first[1] != own[1])
      throw Error(
          where,
          text("there are ", own[1], " points, and on rank 0 ", first[1], "; give all ranks the same files"));
    if (first != own)
      throw Error(where, "points or elements are not those of rank 0; give all ranks the same files");
  }
  static std::string_view versionText() { return SINEW_VERSION; }

  template <class C, class S>
  void follow(C& c, S const& scope) {
    if constexpr (HasRole<C, role::State>) {
      for (std::size_t k = 0; k < states_.size(); ++k) {
        if (states_[k].first != static_cast<void const*>(&c)) continue;
        Part const& part = states_[k].second.part;
        c.follow(part.points);
        c.ghosts = part.ghostOwner.size();
        c.halo = int(k);
      }
    } else if constexpr (HasRole<C, role::Topology>) {
      if constexpr (editable_topology<C>) {
        TopologyChange const& change = ofTopology(&c);
        const ElementLists lists = c.edit();
        if (lists.positions) change.points.filter(*lists.positions);
        lists.forEach([&](int kind, auto& list) {
          change.elements[std::size_t(kind)].filter(list);
          for (auto& element : list)
            for (Index& i : element) change.points.renumber(i);
        });
      }
    } else if constexpr (ActsOnState<C> && !JoinsTwo<C>) {
      if (State const* const state = find(scope.stateAddress()))
        follow_fields(c, {state->part.points, state->part.points, {}, ofTopology(scope.topologyAddress())});
    }
  }
};

}  // namespace sinew::mpi
