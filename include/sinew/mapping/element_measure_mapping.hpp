// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/mapping/measure_driver.hpp>
#include <sinew/mapping/measured_elements.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// What the mappings that measure a kind of elements have in common; the Kind says which elements, what it
/// measures of one, and what scene files and messages call all this.
template <class I, class O, class Kind>
struct ElementMeasureMapping {
  using Role = role::Mapping;
  using In = I;
  using Out = O;
  static constexpr std::string_view className = Kind::className;
  static constexpr bool overParent = true;

  GeometricStiffness geometricStiffness = GeometricStiffness::stabilized;

  static constexpr auto fields() {
    return field_list(
        field("geometricStiffness", &ElementMeasureMapping::geometricStiffness, "", Kind::stiffnessWords));
  }

  MeasureDriver<In, Out, typename Kind::template Measure<In>> measures{};

  /// Throws Error where there are no such elements, or a child has another number of points.
  void init(InitContext<In> const& parent, InitContext<Out> const& child, typename Out::VecCoord& positions) {
    const std::string where = text(child.where, ": ", component_name<ElementMeasureMapping>());
    measures.all.clear();
    for (auto const& element :
         detail::measured_elements(parent, child, where, Kind::noun, Kind::plural, Kind::elements))
      measures.all.push_back({element, {}});
    place_child(positions, measures.all.size(), where, Kind::plural);
  }

  std::vector<bool> pointsThatStay(TopologyView const&, TopologyChange const& change) const {
    return change.of(Kind::element).stays();
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
