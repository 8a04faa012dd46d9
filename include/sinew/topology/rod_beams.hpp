// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/fields.hpp>
#include <sinew/core/mesh.hpp>
#include <sinew/topology/beam_section.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace sinew {

/// The fields of a section, and behind them those that only some have.
template <class S, class... More>
constexpr auto rod_section_fields(More... more) {
  return field_list(
      field("length", &S::length, "m", "along the wire", range::positive),
      field("youngModulus", &S::youngModulus, "Pa", "stiffness of the material", range::positive),
      field("poissonRatio",
            &S::poissonRatio,
            "",
            "lateral contraction per strain",
            Range{.low = -1, .high = 0.5, .openLow = true}),
      field("massDensity", &S::massDensity, "kg/m^3", "mass of a volume", range::positive),
      field("radius", &S::radius, "m", "of the section", range::positive),
      field("innerRadius", &S::innerRadius, "m", "of the hole in it", range::nonNegative),
      field("nbBeams", &S::nbBeams, "", "beams of equal length", range::atLeast(1)),
      field("nbEdgesCollis", &S::nbEdgesCollis, "", "edges for collisions", range::atLeast(1)),
      more...);
}

/// A length of a wire, of one material and a round section, which is divided into equal beams. It is straight
/// at rest, or, with a spireDiameter D, a helix of that diameter which rises by the spireHeight H in a turn:
/// of curvature 2 pi^2 D / l^2 and torsion 2 pi H / l^2 for a turn of the length l^2 = H^2 + (pi D)^2. It
/// goes on from what is before it without a kink, and bends towards -z of its frames.
struct RodSection {
  double length = 1;
  double youngModulus = 5000, poissonRatio = 0.49, massDensity = 1;
  double radius = 1, innerRadius = 0;
  int nbBeams = 5, nbEdgesCollis = 20;
  double spireDiameter = 0, spireHeight = 0;

  static constexpr auto fields() {
    using S = RodSection;
    return rod_section_fields<S>(
        field("spireDiameter", &S::spireDiameter, "m", "of a helix; 0: straight", range::nonNegative),
        field("spireHeight", &S::spireHeight, "m", "rise of a helix in a turn", range::nonNegative));
  }
};

/// A component with the fields of a section as one.
template <class S>
RodSection rod_section(S const& s) {
  RodSection section{.length = s.length,
                     .youngModulus = s.youngModulus,
                     .poissonRatio = s.poissonRatio,
                     .massDensity = s.massDensity,
                     .radius = s.radius,
                     .innerRadius = s.innerRadius,
                     .nbBeams = s.nbBeams,
                     .nbEdgesCollis = s.nbEdgesCollis};
  if constexpr (requires { s.spireDiameter; })
    section.spireDiameter = s.spireDiameter, section.spireHeight = s.spireHeight;
  return section;
}

/// A beam between two frames: what it is made of, and where its second frame is at rest, seen from its first.
/// The first axes of both are along it.
struct RodBeam {
  double length = 1;                     // along the beam
  Eigen::Vector3d chord{1, 0, 0};        // of the second frame, in the axes of the first
  Eigen::Vector4d rotation{0, 0, 0, 1};  // quaternion x, y, z, w of the second in the axes of the first
  double youngModulus = 5000, poissonRatio = 0.45;
  double massDensity = 0;                                           // 0: not known
  double area = 1, aboutY = 1, aboutZ = 1, torsion = 2, shear = 1;  // BeamSection

  static constexpr auto fields() {
    using B = RodBeam;
    return field_list(
        field("length", &B::length, "m", "along the beam", range::positive),
        field("chord", &B::chord, "m", "the second frame at rest, in the axes of the first"),
        field("rotation", &B::rotation, "", "quaternion of its axes"),
        field("youngModulus", &B::youngModulus, "Pa", "stiffness of the material", range::positive),
        field("poissonRatio",
              &B::poissonRatio,
              "",
              "lateral contraction per strain",
              Range{.low = -1, .high = 0.5, .openLow = true}),
        field("massDensity", &B::massDensity, "kg/m^3", "0: not known", range::nonNegative),
        field("area", &B::area, "m^2", "of the section", range::positive),
        field("aboutY", &B::aboutY, "m^4", "second moment of z^2", range::positive),
        field("aboutZ", &B::aboutZ, "m^4", "second moment of y^2", range::positive),
        field("torsion", &B::torsion, "m^4", "Saint-Venant's constant", range::positive),
        field("shear", &B::shear, "", "part of the area that carries shear", range::positive));
  }

  BeamSection section() const {
    return {.area = area, .aboutY = aboutY, .aboutZ = aboutZ, .torsion = torsion, .shear = shear};
  }
  Eigen::Quaterniond turn() const { return Eigen::Quaterniond(rotation).normalized(); }
};

/// The beams of the sections, one behind the other. Throws Error for none, for one that is not in its ranges,
/// or for a ring without a wall.
std::vector<RodBeam> rod_beams(std::string_view where, std::vector<RodSection> const& sections);

/// How far the frames of beams that follow one another are along the wire: 0, l_0, l_0 + l_1...
std::vector<double> rod_abscissas(std::vector<RodBeam> const& beams);

/// Throws Error for a beam whose ends are at one place at rest.
void check_beams(std::string_view where, std::vector<RodBeam> const& beams);

/// The edges of the beams of a rod over so many frames: those of the topology, or where it has none, from
/// each frame to the next. Throws Error where there are no beams, or another number, or edges lead nowhere.
std::vector<Edge> rod_edges(std::string_view where, std::span<Edge const> edges, std::size_t frames,
                            std::vector<RodBeam> const& beams);

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/error.hpp>
#include <sinew/core/lists.hpp>
#include <sinew/core/memory_limit.hpp>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace sinew {

SINEW_ONCE std::vector<RodBeam> rod_beams(std::string_view where, std::vector<RodSection> const& sections) {
  using Eigen::AngleAxisd, Eigen::Vector3d, std::numbers::pi;
  if (sections.empty())
    throw Error(where, "the wire has no section; give it a RodStraightSection or a RodSpireSection");
  double count = 0;
  for (RodSection const& s : sections) count += s.nbBeams;
  check_memory(where, text(count, " beams"), count);
  std::vector<RodBeam> beams;
  for (RodSection const& s : sections) {
    const BeamSection section =
        beam_section(where, CrossSectionShape::circular, s.radius, s.innerRadius, 1, 1, s.poissonRatio);
    RodBeam beam;
    beam.length = s.length / s.nbBeams;
    beam.youngModulus = s.youngModulus;
    beam.poissonRatio = s.poissonRatio;
    beam.massDensity = s.massDensity;
    beam.area = section.area, beam.aboutY = section.aboutY, beam.aboutZ = section.aboutZ;
    beam.torsion = section.torsion, beam.shear = section.shear;
    beam.chord = Vector3d(beam.length, 0, 0);
    if (s.spireDiameter > 0) {
      // a screw by the angle `turn` about y, seen from a frame whose x rises by the slope of the helix
      const double around = pi * s.spireDiameter, r = s.spireDiameter / 2;
      const double turn = 2 * pi * beam.length / std::hypot(around, s.spireHeight);
      const Vector3d moved(r * std::sin(turn), s.spireHeight * turn / (2 * pi), r * (std::cos(turn) - 1));
      const Eigen::Quaterniond slope(AngleAxisd(std::atan2(s.spireHeight, around), Vector3d::UnitZ())),
          about(AngleAxisd(turn, Vector3d::UnitY()));
      beam.chord = slope.conjugate() * moved;
      beam.rotation = (slope.conjugate() * about * slope).coeffs();
      // the corotational beam measures rotations from its chord, by less than half a turn
      if (turn > pi)
        throw Error(where,
                    text("a beam of a RodSpireSection has ",
                         turn / (2 * pi),
                         " turns at rest, but may have half a turn; give it more nbBeams"));
    }
    beams.insert(beams.end(), std::size_t(s.nbBeams), beam);
  }
  return beams;
}

SINEW_ONCE std::vector<double> rod_abscissas(std::vector<RodBeam> const& beams) {
  std::vector<double> s{0};
  for (RodBeam const& beam : beams) s.push_back(s.back() + beam.length);
  return s;
}

SINEW_ONCE void check_beams(std::string_view where, std::vector<RodBeam> const& beams) {
  for (std::size_t i = 0; i < beams.size(); ++i) {
    if (!(beams[i].chord.norm() > 0) || !(beams[i].rotation.norm() > 0.5))
      throw Error(where,
                  text("the ends of beam ",
                       i,
                       " are at one place at rest, or have no rotation; correct its chord and rotation"));
  }
}

SINEW_ONCE std::vector<Edge> rod_edges(std::string_view where, std::span<Edge const> edges,
                                       std::size_t frames, std::vector<RodBeam> const& beams) {
  if (beams.empty())
    throw Error(where,
                "there are no beams; give interpolation those of a BeamInterpolation or a "
                "WireBeamInterpolation");
  std::vector<Edge> all(edges.begin(), edges.end());
  detail::check_indices(where, "edge", all, frames);
  if (all.empty())
    for (int i = 0; i + 1 < int(frames); ++i) all.push_back({i, i + 1});
  if (all.size() != beams.size())
    throw Error(where,
                text("interpolation has ",
                     beams.size(),
                     " beams for ",
                     all.size(),
                     " edges; give the node ",
                     beams.size() + 1,
                     " frames in a row, or an edge for each beam"));
  check_beams(where, beams);
  return all;
}

}  // namespace sinew
#endif
