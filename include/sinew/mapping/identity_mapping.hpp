// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/mapping/mapped_loops.hpp>
#include <sinew/mapping/point_copy.hpp>

namespace sinew {

/// Each point of the child is the same point of the parent, in another precision perhaps, or the centre of
/// the same rigid body. An empty child takes the size of its parent.
template <class I, class O>
struct IdentityMapping {
  using Role = role::Mapping;
  using In = I;
  using Out = O;
  static constexpr bool samePoints = true;  // point i of the child goes with point i of the parent
  using Copy = PointCopy<In, Out>;
  static_assert(
      Copy::possible,
      "IdentityMapping joins states of the same kind, or points to the rigid bodies of their space");
  static constexpr std::string_view className = "IdentityMapping";

  static constexpr auto fields() { return field_list(); }

  MappedLoops<In, Out> loops{};

  void init(InitContext<In> const& parent, InitContext<Out> const& child, typename Out::VecCoord& positions) {
    if (positions.empty()) positions.resize(parent.rest.size());
    if (positions.size() != parent.rest.size())
      throw Error(text(child.where, ": ", component_name<IdentityMapping>()),
                  text("the child has ",
                       positions.size(),
                       " points and its parent ",
                       parent.rest.size(),
                       "; give the child as many, or none"));
    loops.init(parent.rest.size(), positions.size());
  }

  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) const {
    loops.apply(out, in, typename Copy::Position{});
  }
  void ask(typename Out::VecCoord const& out, typename In::VecCoord const& in) const {
    loops.ask(out, in, typename Copy::Position{});
  }
  void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
    loops.apply(out, in, typename Copy::Velocity{});
  }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
    loops.applyJT(in, out, typename Copy::Force{});
  }
  template <class F>
  void forEachJacobianBlock(int point, F&& f) const {
    f(point, typename Copy::Jacobian(Copy::Jacobian::Identity()));
  }
};

}  // namespace sinew
