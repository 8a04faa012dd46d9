// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// Point i of the child is point indices[i] of the parent.
template <class I, class O>
struct SubsetMapping {
  using Role = role::Mapping;
  using In = I;
  using Out = O;
  static_assert(!In::rigid && !Out::rigid && In::size == Out::size,
                "SubsetMapping joins points of as many coordinates");
  static constexpr std::string_view className = "SubsetMapping";

  std::vector<int> indices{};

  static constexpr auto fields() {
    return field_list(field("indices",
                            &SubsetMapping::indices,
                            "",
                            "point of the parent that each point of the child is",
                            range::nonNegative));
  }

  void init(InitContext<In> const& parent, InitContext<Out> const& child,
            typename Out::VecCoord& positions) const {
    const std::string where = text(child.where, ": ", component_name<SubsetMapping>());
    for (const int i : indices)
      if (std::size_t(i) >= parent.rest.size())
        throw Error(where,
                    text("indices has ",
                         i,
                         ", but the parent has ",
                         parent.rest.size(),
                         " points, numbered from 0; correct the index"));
    if (positions.empty()) positions.resize(indices.size());
    if (positions.size() != indices.size())
      throw Error(where,
                  text("the child has ",
                       positions.size(),
                       " points for ",
                       indices.size(),
                       " indices; give the child as many, or none"));
  }

  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) const { gather(out, in); }
  void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const { gather(out, in); }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
    for (std::size_t i = 0; i < indices.size(); ++i)
      in[std::size_t(indices[i])] += out[i].template cast<typename In::Real>();
  }
  template <class F>
  void forEachJacobianBlock(int point, F&& f) const {
    f(indices[std::size_t(point)],
      Mat<typename Out::Real, Out::size>(Mat<typename Out::Real, Out::size>::Identity()));
  }

 private:
  void gather(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
    for (std::size_t i = 0; i < indices.size(); ++i)
      out[i] = in[std::size_t(indices[i])].template cast<typename Out::Real>();
  }
};

}  // namespace sinew
