// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/core/lists.hpp>
#include <sinew/force/beam_law.hpp>
#include <sinew/topology/rod_beams.hpp>

#include <vector>

namespace sinew {

/// Elastic rods: the corotational beams of BeamFEMForceField along the edges of the topology, or where it has
/// none from frame to frame, each with the section, the material and the shape at rest that a
/// BeamInterpolation or a WireBeamInterpolation gives it. A wire that is bent at rest curls to that shape
/// where nothing holds it. With the mass of AdaptiveBeamMass this is SOFA's AdaptiveBeamForceFieldAndMass, as
/// which scene files know both.
template <class D>
struct AdaptiveBeamForceField {
  static_assert(D::rigid && D::spatial == 3,
                "Sinew: AdaptiveBeamForceField is for frames in space (Rigid3d).");
  using Role = role::ForceField;
  using DataTypes = D;
  static constexpr std::string_view className = "AdaptiveBeamForceField";

  std::vector<RodBeam> interpolation{};
  bool shearStressComputation = true;

  static constexpr auto fields() {
    using F = AdaptiveBeamForceField;
    return field_list(
        field("interpolation",
              &F::interpolation,
              "",
              "the beams, those of an interpolation: one for each edge of the topology, or from "
              "each frame to the next")
            .oneEach(Of::edges),
        field("shearStressComputation",
              &F::shearStressComputation,
              "",
              "Timoshenko's beam, which yields to shear; Euler and Bernoulli's when not")
            .also("useShearStressComputation"));
  }

  // the symmetric part; frames that stand as they do at the start are not at rest
  static constexpr ForceProperties properties() { return {.exactTangent = false}; }

  using Driver = ElementDriver<BeamFEM, D>;
  Driver driver{};

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<AdaptiveBeamForceField>());
    const std::vector<Edge> edges =
        rod_edges(where, context.topology.edges, context.rest.size(), interpolation);
    std::vector<typename Driver::Rest> rest;
    for (RodBeam const& beam : interpolation) rest.push_back(rest_of_rod<D>(beam, shearStressComputation));
    driver.init(edges, rest);
  }
};

}  // namespace sinew
