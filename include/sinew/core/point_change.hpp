// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/context.hpp>
#include <sinew/core/renumbering.hpp>

#include <cstddef>
#include <vector>

namespace sinew {

/// Points of a state that go and come before a step. What stays keeps its order, and what comes is behind it.
/// Allocates nothing for as many points as reserve() was told of.
template <class D>
struct PointChange {
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;

  std::vector<bool> stays{};       // of the points there are
  std::vector<Coord> positions{};  // of those that come
  std::vector<Deriv> velocities{};
  Renumbering points{};  // of the points there were, after renumber()
  std::size_t gone = 0;

  void reserve(std::size_t most) {
    stays.reserve(most);
    positions.reserve(most);
    velocities.reserve(most);
    points.kept.reserve(most);
    points.now.reserve(most);
  }

  /// So many points, all of which stay so far.
  void begin(std::size_t size) {
    stays.assign(size, true);
    positions.clear();
    velocities.clear();
    gone = 0;
  }
  /// Takes a point away; false where it was gone already.
  bool remove(std::size_t point) {
    if (!stays[point]) return false;
    stays[point] = false;
    ++gone;
    return true;
  }
  void add(Coord const& position, Deriv const& velocity) {
    positions.push_back(position);
    velocities.push_back(velocity);
  }
  void renumber() { points.set(stays); }

  bool changes() const { return gone > 0 || !positions.empty(); }
  /// How many points there will be.
  std::size_t size() const { return stays.size() - gone + positions.size(); }
};

/// A component, whatever its role, before whose steps points of its state go and come:
///   changePoints(ahead, positions, change)   marks what goes and adds what comes, before any solver works.
/// What it counts of them it counts in acceptPoints(), if it has that, which is called when all components
/// have said what changes: where one throws Error, nothing has. One that adds points says by `capacity` how
/// many its state may have, and throws Error above that.
template <class C>
concept ChangesPoints =
    requires(C c, StepAhead const ahead, typename C::DataTypes::VecCoord const x,
             PointChange<typename C::DataTypes> change) { c.changePoints(ahead, x, change); };

/// A component that may act on a state whose points go and come:
///   followPoints(points, n)   the points there were are renumbered, and now there are n.
/// Init calls it with the capacity of the state and then with its number of points, so that what is sized
/// here has room; a reset calls it with an empty renumbering. Other components are refused on such a state.
template <class C>
concept FollowsPoints = requires(C c, Renumbering const points, std::size_t n) { c.followPoints(points, n); };

}  // namespace sinew
