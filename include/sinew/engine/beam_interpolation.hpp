// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/lists.hpp>
#include <sinew/topology/rod_beams.hpp>

#include <algorithm>
#include <vector>

namespace sinew {

/// The beams of a rod along edges between frames, for an AdaptiveBeamForceField, an AdaptiveBeamMass and an
/// AdaptiveBeamMapping: of one section and material, or one for each. The first axes of the frames are along
/// the rod. A beam is as long at rest as the cubic between its frames, and straight, or, without `straight`,
/// as these frames stand to each other at rest.
template <class D>
struct BeamInterpolation {
  using Role = role::Engine;
  using DataTypes = D;
  static_assert(D::rigid && D::spatial == 3, "Sinew: BeamInterpolation is for frames in space (Rigid3d).");
  static constexpr std::string_view className = "BeamInterpolation";

  typename D::VecCoord position{};
  std::vector<Edge> edges{};
  CrossSectionShape crossSectionShape = CrossSectionShape::circular;
  std::vector<double> radius{1}, innerRadius{0}, lengthY{1}, lengthZ{1};
  std::vector<double> defaultYoungModulus{1e5}, defaultPoissonRatio{0.4};
  bool straight = true;

  static constexpr auto fields() {
    using B = BeamInterpolation;
    return field_list(
        field("position", &B::position, "m", "frames at rest; those of its state").also("rest_position"),
        field("edges",
              &B::edges,
              "",
              "the beams, those of the topology; none: from each frame to the next",
              range::nonNegative),
        field("crossSectionShape",
              &B::crossSectionShape,
              "",
              "circular: with radius; rectangular: with lengths"),
        field("radius",
              &B::radius,
              "m",
              "of a circular cross-section: one, or one for each beam",
              range::positive),
        field("innerRadius", &B::innerRadius, "m", "of the hole in it", range::nonNegative),
        field("lengthY", &B::lengthY, "m", "side of a rectangular cross-section along y", range::positive),
        field("lengthZ", &B::lengthZ, "m", "side of a rectangular cross-section along z", range::positive),
        field("defaultYoungModulus",
              &B::defaultYoungModulus,
              "Pa",
              "stiffness of the material",
              range::positive)
            .also("youngModulus"),
        field("defaultPoissonRatio",
              &B::defaultPoissonRatio,
              "",
              "lateral contraction per strain",
              Range{.low = -1, .high = 0.5, .openLow = true})
            .also("poissonRatio"),
        field("straight", &B::straight, "", "beams are straight at rest; else as the frames stand"));
  }

  // after update
  std::vector<RodBeam> beams{};

  static constexpr auto outputs() {
    return field_list(field("beams", &BeamInterpolation::beams, "", "along the edges"));
  }

  /// Throws Error where there are no beams, one has no length, or lists have another number of entries.
  void update(std::string_view where) {
    check_fields(*this, where);
    const std::string at = text(where, ": ", component_name<BeamInterpolation>());
    detail::check_indices(at, "edge", edges, position.size());
    std::vector<Edge> all = edges;
    if (all.empty())
      for (int i = 0; i + 1 < int(position.size()); ++i) all.push_back({i, i + 1});
    if (all.empty()) throw Error(at, "there is no beam; give the state two frames or more");
    const std::size_t n = all.size();
    check_one_or_each(at, "radius", radius.size(), n, "beams");
    check_one_or_each(at, "innerRadius", innerRadius.size(), n, "beams");
    check_one_or_each(at, "lengthY", lengthY.size(), n, "beams");
    check_one_or_each(at, "lengthZ", lengthZ.size(), n, "beams");
    check_one_or_each(at, "defaultYoungModulus", defaultYoungModulus.size(), n, "beams");
    check_one_or_each(at, "defaultPoissonRatio", defaultPoissonRatio.size(), n, "beams");
    std::vector<RodBeam> made;
    for (std::size_t b = 0; b < n; ++b) {
      auto const &x0 = position[std::size_t(all[b][0])], &x1 = position[std::size_t(all[b][1])];
      const Eigen::Vector3d chord = (x1.center - x0.center).template cast<double>();
      if (!(chord.norm() > 0))
        throw Error(at,
                    text("the beam from frame ",
                         all[b][0],
                         " to frame ",
                         all[b][1],
                         " has no length; move its frames apart, or take a WireBeamInterpolation"));
      const Eigen::Quaterniond q0 = x0.orientation.template cast<double>(),
                               q1 = x1.orientation.template cast<double>();
      RodBeam beam;
      beam.length = chord.norm();
      // the tangents of the cubic are as long as it: three times is enough for beams that bend little
      for (int i = 0; i < 3; ++i)
        beam.length = cubicLength(chord,
                                  beam.length * (q0 * Eigen::Vector3d::UnitX()),
                                  beam.length * (q1 * Eigen::Vector3d::UnitX()));
      beam.chord = Eigen::Vector3d(beam.length, 0, 0);
      if (!straight) {
        beam.chord = q0.conjugate() * chord;
        beam.rotation = (q0.conjugate() * q1).normalized().coeffs();
      }
      beam.youngModulus = one_or_each(defaultYoungModulus, b);
      beam.poissonRatio = one_or_each(defaultPoissonRatio, b);
      const BeamSection s = beam_section(at,
                                         crossSectionShape,
                                         one_or_each(radius, b),
                                         one_or_each(innerRadius, b),
                                         one_or_each(lengthY, b),
                                         one_or_each(lengthZ, b),
                                         beam.poissonRatio);
      beam.area = s.area, beam.aboutY = s.aboutY, beam.aboutZ = s.aboutZ;
      beam.torsion = s.torsion, beam.shear = s.shear;
      made.push_back(beam);
    }
    beams.swap(made);
  }

 private:
  /// Of Hermite's cubic from 0 to `chord` with these tangents, by the rule of Simpson in 16 parts.
  static double cubicLength(Eigen::Vector3d const& chord, Eigen::Vector3d const& t0,
                            Eigen::Vector3d const& t1) {
    double sum = 0;
    for (int i = 0; i <= 32; ++i) {
      const double t = i / 32.0, weight = i == 0 || i == 32 ? 1 : i % 2 == 1 ? 4 : 2;
      sum +=
          weight * (6 * t * (1 - t) * chord + (1 - 4 * t + 3 * t * t) * t0 + (3 * t * t - 2 * t) * t1).norm();
    }
    return sum / 96;
  }
};

}  // namespace sinew
