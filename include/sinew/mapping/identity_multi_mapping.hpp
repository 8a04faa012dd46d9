// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/ends.hpp>
#include <sinew/mapping/point_copy.hpp>

#include <vector>

namespace sinew {

/// All points of several parents, one parent after the other, in one child. The parents stand before the node
/// of the mapping in the tree; they are named by paths from it (`P` = Parents<"../a", "../b/c">), or at run
/// time (`P` = LinkedParents).
template <class I, class O, class P = LinkedParents>
struct IdentityMultiMapping {
  using Role = role::Mapping;
  using In = I;
  using Out = O;
  using Parents = P;
  template <class Other>
  using WithParents = IdentityMultiMapping<I, O, Other>;
  using Copy = PointCopy<In, Out>;
  static_assert(Copy::possible, "IdentityMultiMapping joins points to points or rigid bodies of their space");
  static constexpr std::string_view className = "IdentityMultiMapping";

  [[no_unique_address]] P parents{};

  static constexpr auto fields() { return field_list(); }

  /// What concerns one of the parents.
  struct PointsOfParent {
    std::size_t first = 0, count = 0;  // of the points of the child those that are of this parent
    std::size_t all = 0;               // points of the child

    void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) const {
      for (std::size_t i = 0; i < count; ++i) Copy::position(out[first + i], in[i]);
    }
    void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
      for (std::size_t i = 0; i < count; ++i) Copy::velocity(out[first + i], in[i]);
    }
    void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
      for (std::size_t i = 0; i < count; ++i) Copy::force(in[i], out[first + i]);
    }
    template <class F>
    void forEachJacobianBlock(int point, F&& f) const {
      if (const std::size_t p = std::size_t(point); p >= first && p < first + count)
        f(int(p - first), typename Copy::Jacobian(Copy::Jacobian::Identity()));
    }

    std::vector<bool> pointsThatStay(Renumbering const& parent) const {
      std::vector<bool> stays(all, true);
      for (std::size_t i = 0; i < count; ++i) stays[first + i] = parent.stays(int(i));
      return stays;
    }
  };
  std::vector<PointsOfParent> parts{};  // one a parent
  PointsOfParent& part(std::size_t parent) { return parts[parent]; }
  PointsOfParent const& part(std::size_t parent) const { return parts[parent]; }

  /// Points go with those of the parents.
  void follow(Renumbering const&, std::vector<Renumbering const*> const&) {}

  void init(std::vector<InitContext<In>> const& above, InitContext<Out> const& child,
            typename Out::VecCoord& positions) {
    parts.clear();
    std::size_t all = 0;
    for (auto const& parent : above) {
      parts.push_back({all, parent.rest.size()});
      all += parent.rest.size();
    }
    for (auto& part : parts) part.all = all;
    if (positions.empty()) positions.resize(all);
    if (positions.size() != all)
      throw Error(text(child.where, ": ", component_name<IdentityMultiMapping>()),
                  text("the child has ",
                       positions.size(),
                       " points, and its parents together ",
                       all,
                       "; give the child as many, or none"));
  }
};

}  // namespace sinew
