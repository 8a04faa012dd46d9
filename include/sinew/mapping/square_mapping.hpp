// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/mapping/measure_driver.hpp>

#include <array>
#include <string_view>
#include <vector>

namespace sinew {

/// Each point of the child is the square of one of the parent, numbers both:
///   c = x^2        J = 2 x        K_g = 2 f
/// `stabilized` has no K_g for what pushes (f > 0).
template <class I, class O>
struct SquareMapping {
  using Role = role::Mapping;
  using In = I;
  using Out = O;
  using Real = typename In::Real;
  static constexpr int N = In::spatial;
  static_assert(!In::rigid && In::size == 1, "Sinew: SquareMapping maps Vec1 to Vec1");
  static constexpr std::string_view className = "SquareMapping";

  GeometricStiffness geometricStiffness = GeometricStiffness::exact;

  static constexpr auto fields() {
    using M = SquareMapping;
    return field_list(field("geometricStiffness",
                            &M::geometricStiffness,
                            "",
                            "geometric stiffness: what the change of the slope adds to the stiffness"));
  }

  struct Measure {
    static constexpr int arity = 1;
    Vec<Real, 1> x = Vec<Real, 1>::Zero();

    Real value(std::array<Vec<Real, 1>, 1> const& at) {
      x = at[0];
      return x[0] * x[0];
    }
    Vec<Real, 1> slope(int) const { return 2 * x; }
    Mat<Real, 1> second(int, int) const { return Mat<Real, 1>(Real(2)); }
  };
  MeasureDriver<In, Out, Measure> measures{};

  void init(InitContext<In> const& parent, InitContext<Out> const& child, typename Out::VecCoord& positions) {
    measures.all.clear();
    for (std::size_t i = 0; i < parent.rest.size(); ++i) measures.all.push_back({{Index(i)}, {}});
    place_child(positions,
                measures.all.size(),
                text(child.where, ": ", component_name<SquareMapping>()),
                "points of the parent");
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
