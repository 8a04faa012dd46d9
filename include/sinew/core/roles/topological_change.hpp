// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/context.hpp>
#include <sinew/core/renumbering.hpp>
#include <sinew/core/role.hpp>

#include <concepts>
#include <string>
#include <vector>

namespace sinew {

/// One change of a topology while a scene runs: one of these is given.
struct TopologicalOrder {
  ElementNumbers gone{};
  std::vector<Vec<double, 6>>
      box{};  // elements in one of these go too: the lower corner, and the upper one [m]
  AddedElements added{};
  std::vector<Eigen::Vector3d> incision{};  // a path on the surface [m]

  bool removes() const {
    bool any = !gone.points.empty();
    for (auto const* list : gone.lists()) any = any || !list->empty();
    return any;
  }
};

// Which elements of the topology of its node, or of the nearest above, go while a scene runs. The shortest:
//
//   /// The last tetrahedron goes at a time.
//   struct LastGoes {
//     using Role = role::TopologicalChange;
//     static constexpr std::string_view className = "LastGoes";
//     static constexpr auto fields() { return field_list(); }
//
//     bool gone = false;
//
//     void prepare(std::string const&, TopologyView const&) {}
//     bool findRemoved(TopologyView const& topology, double time, ElementNumbers& elements) {
//       if (gone || time < 1) return false;
//       elements.tetrahedra = {Index(topology.tetrahedra.size() - 1)};
//       return true;
//     }
//     void elementsRemoved() { gone = true; }
//   };

/// prepare(where, topology) checks it at init, with "/path: Class" for messages.
template <class C>
concept PreparesRemoval =
    requires(C c, std::string const where, TopologyView const topology) { c.prepare(where, topology); };
/// findRemoved(topology, time, elements), before a step that begins at a time [s], lists elements that go, and
/// returns whether it has done so; over DataTypes with the positions of the state of the node,
/// findRemoved(topology, positions, time, elements). The elements are taken out, with all that refers to them;
/// elementsRemoved() says so, and it is asked again.
template <class C>
concept FindsRemovedElements =
    requires(C c, TopologyView const topology, ElementNumbers elements) {
      { c.findRemoved(topology, 0., elements) } -> std::same_as<bool>;
      c.elementsRemoved();
    } || requires(C c, TopologyView const topology, typename C::DataTypes::VecCoord const x,
                  ElementNumbers elements) {
      { c.findRemoved(topology, x, 0., elements) } -> std::same_as<bool>;
      c.elementsRemoved();
    };

/// One that does more than to remove: findChange(topology, points, time, order) fills one change over so many
/// points and returns whether there is one; changeMade() says that it was made, and it is asked again.
template <class C>
concept FindsChanges = requires(C c, TopologyView const topology, TopologicalOrder order) {
  { c.findChange(topology, std::size_t(0), 0., order) } -> std::same_as<bool>;
  c.changeMade();
};

/// One that tears elements by their stresses: looks(topology) says before a step whether it does, and makes
/// `stress`, zero for each tetrahedron, or each triangle where there are none; force fields add theirs
/// (GivesStress). overloaded() then says whether an element tears; tear(topology, positions, held) where, if
/// it does, as a BladeStroke, where `held` are points that constraints hold. changeMade(changes) says what
/// came of it.
template <class C>
concept TearsElements = requires(C c, TopologyView const topology, std::vector<Eigen::Vector3d> const x,
                                 std::vector<bool> const held) {
  typename C::DataTypes;
  { c.looks(topology) } -> std::same_as<bool>;
  { c.stress } -> std::same_as<std::vector<Eigen::Matrix3d>&>;
  { c.overloaded() } -> std::same_as<bool>;
  c.tear(topology, x, held);
  c.changeMade(true);
};

template <class C>
concept ChangesTopology = HasRole<C, role::TopologicalChange> && PreparesRemoval<C> &&
                          (FindsRemovedElements<C> || FindsChanges<C> || TearsElements<C>);

// Hooks, what it may have beside these:

/// mayAdd(where), before all else, whether elements may come: the topology, and those that follow it, may be
/// without elements then.
template <class C>
concept MayAddElements = requires(C c, std::string const where) {
  { c.mayAdd(where) } -> std::same_as<bool>;
};

/// followElements(change), where elements of its topology have gone, whoever took them.
template <class C>
concept FollowsElements = requires(C c, TopologyChange const change) { c.followElements(change); };
/// notice(), words for what it has noticed in findRemoved(); empty where there is nothing.
template <class C>
concept NoticesChange = requires(C const c) {
  { c.notice() } -> std::convertible_to<std::string_view>;
};

template <>
struct Promise<role::TopologicalChange> : NoPromise {
  template <class C>
  static constexpr bool kept = ChangesTopology<C>;
  template <class C>
  struct Broken {
    static constexpr bool prepares = PreparesRemoval<C>,
                          finds = FindsRemovedElements<C> || FindsChanges<C> || TearsElements<C>;
    static_assert(prepares,
                  "Sinew: a component with role::TopologicalChange has no 'void prepare(std::string const& "
                  "where, TopologyView const& topology)', which checks it.");
    static_assert(
        finds,
        "Sinew: a component with role::TopologicalChange has no 'bool findRemoved(TopologyView const& "
        "topology, double time, ElementNumbers& elements)', which lists what goes, or no 'void "
        "elementsRemoved()', which is told that it has gone; nor findChange and changeMade; nor what tears "
        "elements (TearsElements).");
  };
};

}  // namespace sinew
