// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/lists.hpp>
#include <sinew/mapping/measure_driver.hpp>

#include <array>
#include <limits>
#include <string_view>
#include <vector>

namespace sinew {

/// Each point of the child is by how much a point of the parent is farther from a place than a length:
///   c = l - L,  l = |x - target|        J = u',  u = (x - target)/l        K_g = f/l (I - u u')
/// In the place itself there is no direction: J and K_g are zero there. `stabilized` has no K_g for what
/// pushes (f > 0), where it is not negative.
template <class I, class O>
struct DistanceFromTargetMapping {
  using Role = role::Mapping;
  using In = I;
  using Out = O;
  using Real = typename In::Real;
  static constexpr int N = In::spatial;
  static constexpr std::string_view className = "DistanceFromTargetMapping";

  std::vector<int> indices{};
  typename In::VecCoord targetPositions{};
  std::vector<double> restLengths{};
  GeometricStiffness geometricStiffness = GeometricStiffness::stabilized;

  static constexpr auto fields() {
    using M = DistanceFromTargetMapping;
    return field_list(
        field("indices",
              &M::indices,
              "",
              "points of the parent; a target behind the last of them measures the point of its own number",
              range::nonNegative)
            .numbersOf(Of::parentPoints),
        field("targetPositions", &M::targetPositions, "m", "a place for each").oneEach(Of::points),
        field("restLengths",
              &M::restLengths,
              "m",
              "lengths L; 0 for those that are not given",
              range::nonNegative)
            .oneEach(Of::points),
        field("geometricStiffness",
              &M::geometricStiffness,
              "",
              "geometric stiffness: what turning about the targets adds to the stiffness"));
  }

  bool none = false;  // all of the points have been removed

  static constexpr auto state() {
    return field_list(
        field("none", &DistanceFromTargetMapping::none, "", "all of the points have been removed"));
  }

  struct Measure {
    static constexpr int arity = 1;
    Vec<Real, N> target = Vec<Real, N>::Zero();
    Real length{0};
    Vec<Real, N> direction = Vec<Real, N>::Zero();
    Real inverse{0};  // 1/l

    Real value(std::array<Vec<Real, N>, 1> const& x) {
      const Vec<Real, N> d = x[0] - target;
      const Real l = d.norm();
      inverse = l > std::numeric_limits<Real>::epsilon() * target.norm() + std::numeric_limits<Real>::min()
                    ? 1 / l
                    : Real(0);
      direction = d * inverse;
      return l - length;
    }
    Vec<Real, N> slope(int) const { return direction; }
    Mat<Real, N> second(int, int) const {
      return inverse * (Mat<Real, N>::Identity() - direction * direction.transpose());
    }
  };
  MeasureDriver<In, Out, Measure> measures{};

  /// Throws Error where there is no target, an index is out of range, or a list has too many entries.
  void init(InitContext<In> const& parent, InitContext<Out> const& child, typename Out::VecCoord& positions) {
    const std::string where = text(child.where, ": ", component_name<DistanceFromTargetMapping>());
    const std::size_t n = none ? 0 : targetPositions.size();
    if (n == 0 && !none)
      throw Error(where, "there is no target; give targetPositions, a place for each point");
    if (indices.size() > n || restLengths.size() > targetPositions.size())
      throw Error(where,
                  text("there are ",
                       indices.size(),
                       " indices and ",
                       restLengths.size(),
                       " restLengths for ",
                       n,
                       " targetPositions; give at most one each"));
    // whole, so that they follow where points are removed
    for (std::size_t k = indices.size(); k < n; ++k) indices.push_back(int(k));
    restLengths.resize(targetPositions.size(), 0.0);
    check_numbers(where, "indices", indices, parent.rest.size(), "points", "the parent");
    measures.all.clear();
    for (std::size_t k = 0; k < n; ++k)
      measures.all.push_back({{Index(indices[k])}, {In::center(targetPositions[k]), Real(restLengths[k])}});
    place_child(positions, measures.all.size(), where, "targets");
  }

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
  void updateK(typename Out::VecDeriv const& f) { measures.updateK(f, geometricStiffness); }
  void addKx(typename In::VecDeriv& df, typename In::VecDeriv const& dx, double k) const {
    if (geometricStiffness != GeometricStiffness::none) measures.addKx(df, dx, k);
  }
  template <class Sink>
  void addToMatrix(MechanicalParams const& p, Sink const& sink) const {
    if (geometricStiffness != GeometricStiffness::none) measures.addToMatrix(p, sink);
  }
};

}  // namespace sinew
