// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>

#include <string>
#include <vector>

namespace sinew {

// What a blade cuts while a scene runs: CuttingManager is the one that there is.

/// Whether it cuts, with which points of the state of which node, and the topology of which node: paths as they
/// are given; init makes `tool` and `body` of them, from the root of the scene on, and `toolState` and
/// `bodyTopology`, which of all states and topologies of the scene they lead to.
template <class C>
concept NamesBlade = requires(C c) {
  { c.active } -> std::convertible_to<bool>;
  { c.toolModel } -> std::convertible_to<std::string const&>;
  { c.bodyModel } -> std::convertible_to<std::string const&>;
  { c.indices } -> std::convertible_to<std::vector<int> const&>;
  { c.tool } -> std::same_as<std::string&>;
  { c.body } -> std::same_as<std::string&>;
  { c.toolState } -> std::same_as<int&>;
  { c.bodyTopology } -> std::same_as<int&>;
};
/// `bladeNow` and `positionsNow` are filled with where the points of blade and body are, at init, before prepare(), and
/// before each step, in which sweep() says what is to be cut, if something is; then
/// either accept(cut), with what has been done, or refuse(message).
template <class C>
concept SweepsBlade = requires(C c, std::string const message) {
  c.prepare();
  { c.bladeNow } -> std::same_as<std::vector<Eigen::Vector3d>&>;
  { c.positionsNow } -> std::same_as<std::vector<Eigen::Vector3d>&>;
  c.sweep();
  c.refuse(message);
};

template <class C>
concept Cuts = HasRole<C, role::Cutting> && NamesBlade<C> && SweepsBlade<C>;

template <>
struct Promise<role::Cutting> : NoPromise {
  template <class C>
  static constexpr bool kept = Cuts<C>;
  template <class C>
  struct Broken {
    static constexpr bool named = NamesBlade<C>, sweeps = SweepsBlade<C>;
    static_assert(named,
                  "Sinew: a component with role::Cutting has no 'bool active', no 'std::string toolModel{}, "
                  "bodyModel{}' and 'std::vector<int> indices{}', or no 'std::string tool{}, body{}' and "
                  "'int toolState, bodyTopology', which init makes of them.");
    static_assert(
        sweeps,
        "Sinew: a component with role::Cutting has no 'prepare()', 'std::vector<Eigen::Vector3d> "
        "bladeNow, positionsNow', 'sweep()', 'accept(cut)' or 'refuse(message)', which the steps call.");
  };
};

}  // namespace sinew
