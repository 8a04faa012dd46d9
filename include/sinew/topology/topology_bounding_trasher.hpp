// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

#include <array>
#include <string>
#include <string_view>

namespace sinew {

/// Removes the elements of the topology of its node that have left a box: those of the highest dimension of
/// which a point is outside at the begin of a step, with all that refers to them.
template <class D>
struct TopologyBoundingTrasher {
  using Role = role::TopologicalChange;
  using DataTypes = D;
  static constexpr std::string_view className = "TopologyBoundingTrasher";

  std::array<double, 6> box{-1000, -1000, -1000, 1000, 1000, 1000};

  static constexpr auto fields() {
    return field_list(field("box",
                            &TopologyBoundingTrasher::box,
                            "m",
                            "least x, y and z, then greatest, between which elements stay"));
  }

  void prepare(std::string const& where, TopologyView const& topology) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (!(box[k] < box[k + 3]))
        throw Error(where,
                    text("the box is from ",
                         box[k],
                         " to ",
                         box[k + 3],
                         " m along ",
                         "xyz"[k],
                         ", and holds nothing; give the lower end first"));
    if (dimension_of(topology) == 0)
      throw Error(where, "the topology of its node has no elements that could be removed; give it some");
  }

  bool findRemoved(TopologyView const& topology, typename D::VecCoord const& x, double,
                   ElementNumbers& elements) const {
    auto find = [&](auto const& list, std::vector<Index>& gone) {
      for (std::size_t e = 0; e < list.size(); ++e)
        for (const Index i : list[e])
          if (isOutside(x[std::size_t(i)])) {
            gone.push_back(Index(e));
            break;
          }
    };
    for_each_highest(topology, [&](int kind, auto const& list) { find(list, elements.of(kind)); });
    for (auto const* list : elements.lists())
      if (!list->empty()) return true;
    return false;
  }
  void elementsRemoved() {}

 private:
  template <class Coord>
  bool isOutside(Coord const& x) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (x[int(k)] < box[k] || x[int(k)] > box[k + 3]) return true;
    return false;
  }
};

}  // namespace sinew
