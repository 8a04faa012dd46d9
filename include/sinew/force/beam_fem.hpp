// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/core/lists.hpp>
#include <sinew/force/beam_law.hpp>
#include <sinew/topology/beam_section.hpp>

#include <vector>

namespace sinew {

/// Elastic beams along the edges of the topology, or those of `listSegment`: straight between frames, which
/// may stand in any way to the beam. The sides of a rectangular cross-section are along the second and third
/// axes of the frames at rest.
template <class D>
struct BeamFEMForceField {
  static_assert(D::rigid && D::spatial == 3, "Sinew: BeamFEMForceField is for frames in space (Rigid3d).");
  using Role = role::ForceField;
  using DataTypes = D;
  using Real = typename D::Real;
  static constexpr std::string_view className = "BeamFEMForceField";

  double poissonRatio = 0.45, youngModulus = 5000;
  double radius = 0.1, radiusInner = 0;
  std::vector<int> listSegment{};
  CrossSectionShape crossSectionShape = CrossSectionShape::circular;
  double lengthY = 1, lengthZ = 1;
  bool shearStressComputation = false;

  static constexpr auto fields() {
    using F = BeamFEMForceField;
    return field_list(
        field("poissonRatio",
              &F::poissonRatio,
              "",
              "lateral contraction per strain",
              Range{.low = -1, .high = 0.5, .openLow = true}),
        field("youngModulus", &F::youngModulus, "Pa", "stiffness of the material", range::positive),
        field("radius", &F::radius, "m", "of a circular cross-section", range::positive),
        field("radiusInner",
              &F::radiusInner,
              "m",
              "of the hole in a circular cross-section",
              range::nonNegative),
        field("listSegment",
              &F::listSegment,
              "",
              "the edges of the topology that are beams; all when not given",
              range::nonNegative)
            .numbersOf(Of::edges),
        field("crossSectionShape",
              &F::crossSectionShape,
              "",
              "circular: with radius; rectangular: with lengths"),
        field("lengthY",
              &F::lengthY,
              "m",
              "side of a rectangular cross-section along y of the frames",
              range::positive),
        field("lengthZ",
              &F::lengthZ,
              "m",
              "side of a rectangular cross-section along z of the frames",
              range::positive),
        field("shearStressComputation",
              &F::shearStressComputation,
              "",
              "Timoshenko's beam, which yields to shear; Euler and Bernoulli's, as in SOFA, when not")
            .also("useShearStressComputation"));
  }

  // the symmetric part
  static constexpr ForceProperties properties() { return {.exactTangent = false}; }

  bool none = false;  // all of listSegment have been removed

  static constexpr auto state() {
    return field_list(
        field("none", &BeamFEMForceField::none, "", "all beams of listSegment have been removed"));
  }

  using Driver = ElementDriver<BeamFEM, D>;
  Driver driver{};

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<BeamFEMForceField>());
    const BeamSection section =
        beam_section(where, crossSectionShape, radius, radiusInner, lengthY, lengthZ, poissonRatio);
    auto const& edges = context.topology.edges;
    if (edges.empty() && !context.topology.grows)
      throw Error(
          where,
          "the topology has no edge; give the node a topology with edges (in MeshTopology: edges or lines)");
    detail::check_indices(where, "edge", edges, context.rest.size());
    std::vector<Edge> beams(edges.begin(), edges.end());
    if (!listSegment.empty() || none) {
      check_numbers(where, "listSegment", listSegment, edges.size(), "edges", "the topology");
      beams.clear();
      for (const int i : listSegment) beams.push_back(edges[std::size_t(i)]);
    }
    std::vector<typename Driver::Rest> rest;
    for (std::size_t e = 0; e < beams.size(); ++e) {
      typename D::Coord x[2];
      for (std::size_t k = 0; k < 2; ++k) x[k] = context.rest[std::size_t(beams[e][k])];
      if (!((x[1].center - x[0].center).norm() > 0))
        throw Error(where,
                    text("the beam from frame ",
                         beams[e][0],
                         " to frame ",
                         beams[e][1],
                         " has no length; move or merge its frames"));
      rest.push_back(BeamFEM<D>::restOf(x, section, youngModulus, poissonRatio, shearStressComputation));
    }
    driver.init(beams, rest);
  }
};

}  // namespace sinew
