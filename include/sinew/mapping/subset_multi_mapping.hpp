// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/ends.hpp>
#include <sinew/mapping/child_points.hpp>
#include <sinew/mapping/index_pairs.hpp>
#include <sinew/mapping/point_copy.hpp>

#include <array>
#include <vector>

namespace sinew {

/// Points of several parents in one child: point i is point indexPairs[i][1] of parent indexPairs[i][0], or
/// the centre of that rigid body. The parents stand before the node of the mapping in the tree; they are
/// named by paths from it (`P` = Parents<"../a", "../b/c">), or at run time (`P` = LinkedParents).
template <class I, class O, class P = LinkedParents>
struct SubsetMultiMapping {
  using Role = role::Mapping;
  using In = I;
  using Out = O;
  using Parents = P;
  template <class Other>
  using WithParents = SubsetMultiMapping<I, O, Other>;
  using Copy = PointCopy<In, Out>;
  static_assert(Copy::possible, "SubsetMultiMapping joins points to points or rigid bodies of their space");
  static constexpr std::string_view className = "SubsetMultiMapping";

  std::vector<std::array<int, 2>> indexPairs{};
  [[no_unique_address]] P parents{};

  static constexpr auto fields() {
    return field_list(field("indexPairs",
                            &SubsetMultiMapping::indexPairs,
                            "",
                            "of each point: its parent, from 0, and its point of that",
                            range::nonNegative));
  }

  /// What concerns one of the parents.
  struct PointsOfParent {
    std::vector<int> points{};  // of this parent, for each point of the child; -1: it is of another

    void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) const {
      forEach([&](std::size_t i, std::size_t above) { Copy::position(out[i], in[above]); });
    }
    void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
      forEach([&](std::size_t i, std::size_t above) { Copy::velocity(out[i], in[above]); });
    }
    void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
      forEach([&](std::size_t i, std::size_t above) { Copy::force(in[above], out[i]); });
    }
    template <class F>
    void forEachJacobianBlock(int point, F&& f) const {
      if (const int above = points[std::size_t(point)]; above >= 0)
        f(above, typename Copy::Jacobian(Copy::Jacobian::Identity()));
    }

    std::vector<bool> pointsThatStay(Renumbering const& parent) const {
      std::vector<bool> stays;
      for (const int above : points) stays.push_back(above < 0 || parent.stays(above));
      return stays;
    }

   private:
    template <class F>
    void forEach(F&& f) const {
      for (std::size_t i = 0; i < points.size(); ++i)
        if (points[i] >= 0) f(i, std::size_t(points[i]));
    }
  };
  std::vector<PointsOfParent> parts{};  // one a parent
  PointsOfParent& part(std::size_t parent) { return parts[parent]; }
  PointsOfParent const& part(std::size_t parent) const { return parts[parent]; }

  /// Points go with those of the parents.
  void follow(Renumbering const& child, std::vector<Renumbering const*> const& above) {
    child.filter(indexPairs);
    for (auto& [parent, point] : indexPairs) above[std::size_t(parent)]->renumber(point);
  }

  void init(std::vector<InitContext<In>> const& above, InitContext<Out> const& child,
            typename Out::VecCoord& positions) {
    const std::string where = text(child.where, ": ", component_name<SubsetMultiMapping>());
    check_index_pairs(where, indexPairs, above);
    parts.assign(above.size(), {std::vector<int>(indexPairs.size(), -1)});
    for (std::size_t i = 0; i < indexPairs.size(); ++i)
      parts[std::size_t(indexPairs[i][0])].points[i] = indexPairs[i][1];
    place_child(positions, indexPairs.size(), where, "indexPairs");
  }
};

}  // namespace sinew
