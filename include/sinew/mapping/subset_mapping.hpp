// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/lists.hpp>
#include <sinew/mapping/child_points.hpp>
#include <sinew/mapping/mapped_loops.hpp>

#include <vector>

namespace sinew {

/// Point i of the child is point indices[i] of the parent. Where no indices are given, each point of the
/// child is the point of the parent that is nearest to its place at rest, and within `radius` of it.
template <class I, class O>
struct SubsetMapping {
  using Role = role::Mapping;
  using In = I;
  using Out = O;
  static_assert(!In::rigid && !Out::rigid && In::size == Out::size,
                "SubsetMapping joins points of as many coordinates");
  static constexpr std::string_view className = "SubsetMapping";

  std::vector<int> indices{};
  double radius = 1e-5;

  static constexpr auto fields() {
    using M = SubsetMapping;
    return field_list(field("indices",
                            &M::indices,
                            "",
                            "point of the parent that each point of the child is; the nearest, "
                            "where none is given",
                            range::nonNegative)
                          .numbersOf(Of::parentPoints),
                      field("radius",
                            &M::radius,
                            "m",
                            "how far a point of the child may be from the nearest of the parent",
                            range::positive));
  }

  SubsetLoops<In, Out> loops{};

  void init(InitContext<In> const& parent, InitContext<Out> const& child, typename Out::VecCoord& positions) {
    const std::string where = text(child.where, ": ", component_name<SubsetMapping>());
    if (indices.empty())
      for (auto const& x : positions) indices.push_back(nearest(where, parent.rest, x));
    check_numbers(where, "indices", indices, parent.rest.size(), "points", "the parent");
    place_child(positions, indices.size(), where, "indices");
    loops.init(parent.rest.size(), indices);
  }

  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) const {
    loops.apply(out, in, indices);
  }
  void ask(typename Out::VecCoord const& out, typename In::VecCoord const& in) const { loops.ask(out, in); }
  void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
    loops.apply(out, in, indices);
  }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
    loops.applyJT(in, out, indices);
  }
  template <class F>
  void forEachJacobianBlock(int point, F&& f) const {
    f(indices[std::size_t(point)],
      Mat<typename Out::Real, Out::size>(Mat<typename Out::Real, Out::size>::Identity()));
  }

 private:
  // of those as near the first
  int nearest(std::string const& where, typename In::VecCoord const& rest,
              typename Out::Coord const& x) const {
    const typename In::Coord place = x.template cast<typename In::Real>();
    double least = radius;
    int found = -1;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      const double distance = double((rest[i] - place).norm());
      if (distance < least || (found < 0 && distance == least)) least = distance, found = int(i);
    }
    if (found >= 0) return found;
    std::string words;
    for (int c = 0; c < In::size; ++c) words += text(c ? " " : "", double(x[c]));
    throw Error(where,
                text("the parent has no point within ",
                     radius,
                     " m of ",
                     words,
                     "; give indices, a greater radius, or the child places of points of its parent"));
  }
};

}  // namespace sinew
