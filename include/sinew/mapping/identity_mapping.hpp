// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

namespace sinew {

/// Each point of the child is the same point of the parent, in another precision perhaps, or the centre of
/// the same rigid body. An empty child takes the size of its parent.
template <class I, class O>
struct IdentityMapping {
  using Role = role::Mapping;
  using In = I;
  using Out = O;
  static constexpr bool samePoints = true;  // point i of the child goes with point i of the parent
  static constexpr bool centers = In::rigid && !Out::rigid;
  static_assert(
      centers ? In::spatial == Out::size : In::size == Out::size && In::rigid == Out::rigid,
      "IdentityMapping joins states of the same kind, or points to the rigid bodies of their space");
  static constexpr std::string_view className = "IdentityMapping";

  static constexpr auto fields() { return field_list(); }

  void init(InitContext<In> const& parent, InitContext<Out> const& child,
            typename Out::VecCoord& positions) const {
    if (positions.empty()) positions.resize(parent.rest.size());
    if (positions.size() != parent.rest.size())
      throw Error(text(child.where, ": ", component_name<IdentityMapping>()),
                  text("the child has ",
                       positions.size(),
                       " points and its parent ",
                       parent.rest.size(),
                       "; give the child as many, or none"));
  }

  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) const {
    for (std::size_t i = 0; i < in.size(); ++i) {
      if constexpr (centers) {
        out[i] = in[i].center.template cast<typename Out::Real>();
      } else if constexpr (In::rigid) {
        out[i].center = in[i].center.template cast<typename Out::Real>();
        if constexpr (In::spatial == 3)
          out[i].orientation.coeffs() = in[i].orientation.coeffs().template cast<typename Out::Real>();
        else
          out[i].orientation = typename Out::Real(in[i].orientation);
      } else {
        out[i] = in[i].template cast<typename Out::Real>();
      }
    }
  }
  void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
    for (std::size_t i = 0; i < in.size(); ++i)
      out[i] = in[i].template head<Out::size>().template cast<typename Out::Real>();
  }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
    for (std::size_t i = 0; i < in.size(); ++i)
      in[i].template head<Out::size>() += out[i].template cast<typename In::Real>();
  }
  template <class F>
  void forEachJacobianBlock(int point, F&& f) const {
    using J = Mat<typename Out::Real, Out::size, In::size>;
    f(point, J(J::Identity()));
  }
};

}  // namespace sinew
