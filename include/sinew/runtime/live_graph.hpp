// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/error.hpp>
#include <sinew/core/value_numbers.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace sinew {

template <class R>
struct RuntimeEntry;
template <class R>
class RuntimeNode;

/// A value of a component of a runtime tree.
struct LiveValue {
  std::string node{}, component{};  // path from the node that has the graph on: "liver/skin"; and its name
  std::string field{};              // "position"
  std::ptrdiff_t offset = 0;        // of the value in the component
  NumberAccess numbers{};
  int list = -1;  // of a list of lists, which one
};

/// A value that follows another one while the scene runs.
struct LiveLink {
  LiveValue from, to;
  int pointsTo = 0;         // of points that become frames: how many numbers a frame has, 7 or 3; else 0
  bool keepsCount = false;  // of points
  bool ofEdits = false;     // from a topology, which only edits of the scene change
  bool seen = false;        // of such a one: `numbers` are those of before the last edit

  // bound
  void const* source = nullptr;
  void* value = nullptr;
  std::vector<double> numbers{}, next{};  // what was taken last, and what is looked at

  /// What the value is to be now; false where it has these bits already.
  bool look() {
    from.numbers.get(source, from.list, next);
    if (pointsTo > 0) pad();
    return !same_bits(next, numbers);
  }

 private:
  // frames at points, which are not rotated: the numbers are spread from the last point on
  void pad() {
    const std::size_t n = next.size() / 3, each = std::size_t(pointsTo);
    if (each == 7) {
      next.resize(n * 7);
      for (std::size_t i = n; i-- > 0;) {
        const double x = next[3 * i], y = next[3 * i + 1], z = next[3 * i + 2];
        double* const frame = &next[7 * i];
        frame[0] = x, frame[1] = y, frame[2] = z, frame[3] = frame[4] = frame[5] = 0, frame[6] = 1;
      }
    } else {
      for (std::size_t i = 0; i < n; ++i) next[3 * i + 2] = 0;
    }
  }
};

/// What follows in a runtime tree while it runs: engines and components some of whose values follow others,
/// each behind those that it follows. Of the node from which its paths are.
template <class R>
struct LiveGraph {
  struct Target {
    std::string node{}, component{};
    std::vector<LiveLink> links{};
    // bound
    RuntimeNode<R>* at = nullptr;
    RuntimeEntry<R>* entry = nullptr;
    bool pending = false;  // it has a value that it has not made anything of
  };
  std::vector<Target> targets{};

  /// The links into a component; null where there are none.
  Target const* find(std::string_view node, std::string_view component) const {
    for (Target const& target : targets)
      if (target.node == node && target.component == component) return &target;
    return nullptr;
  }

  // of the top node: all from it on that have a graph, found anew where nodes were copied or moved
  std::vector<RuntimeNode<R>*> graphs{};
  bool bound = false;
};

}  // namespace sinew
