// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/mapping/measure_driver.hpp>

#include <array>
#include <string_view>
#include <vector>

namespace sinew {

/// Each point of the child is the distance of a point of the parent from a plane, negative behind it:
///   c = n.(x - p),  J = n',  n the normal of length 1
template <class I, class O>
struct DistanceToPlaneMapping {
  using Role = role::Mapping;
  using In = I;
  using Out = O;
  using Real = typename In::Real;
  static constexpr int N = In::spatial;
  static constexpr std::string_view className = "DistanceToPlaneMapping";

  Vec<double, N> planeNormal = Vec<double, N>::Zero(), planePoint = Vec<double, N>::Zero();

  static constexpr auto fields() {
    using M = DistanceToPlaneMapping;
    return field_list(field("planeNormal", &M::planeNormal, "", "normal of the plane, of any length"),
                      field("planePoint", &M::planePoint, "m", "a point of the plane"));
  }

  struct Measure {
    static constexpr int arity = 1;
    Vec<Real, N> normal = Vec<Real, N>::Zero(), point = Vec<Real, N>::Zero();

    Real value(std::array<Vec<Real, N>, 1> const& x) const { return normal.dot(x[0] - point); }
    Vec<Real, N> slope(int) const { return normal; }
  };
  MeasureDriver<In, Out, Measure> measures{};

  /// Throws Error where the normal is zero, or a child has another number of points.
  void init(InitContext<In> const& parent, InitContext<Out> const& child, typename Out::VecCoord& positions) {
    const std::string where = text(child.where, ": ", component_name<DistanceToPlaneMapping>());
    if (!(planeNormal.norm() > 0))
      throw Error(where, "planeNormal is zero; give the normal of the plane, such as 0 1 0");
    const Measure plane{planeNormal.normalized().template cast<Real>(), planePoint.template cast<Real>()};
    measures.all.clear();
    for (std::size_t i = 0; i < parent.rest.size(); ++i) measures.all.push_back({{Index(i)}, plane});
    place_child(positions, measures.all.size(), where, "points of the parent");
  }

  std::vector<bool> pointsThatStay(Renumbering const& parent) const { return parent.stays(); }

  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) { measures.apply(out, in); }
  void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
    measures.applyJ(out, in);
  }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
    measures.applyJT(in, out);
  }
  template <class F>
  void forEachJacobianBlock(int point, F&& f) const {
    measures.forEachJacobianBlock(point, f);
  }
};

}  // namespace sinew
