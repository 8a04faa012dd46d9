// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/topology/rod_beams.hpp>

#include <vector>

namespace sinew {

/// The shape of a wire at rest: its sections one behind the other, from the handle to the tip, divided into
/// beams. Its outputs are what a scene needs of it: the beams, for a WireBeamInterpolation; the frames at
/// rest, the first at the origin with its x along the wire; edges from frame to frame; and for collisions
/// points along the wire, for an AdaptiveBeamMapping, with edges from each to the next.
template <class D>
struct WireRestShape {
  using Role = role::Engine;
  using DataTypes = D;
  static_assert(D::rigid && D::spatial == 3, "Sinew: WireRestShape is for frames in space (Rigid3d).");
  static constexpr std::string_view className = "WireRestShape";

  std::vector<RodSection> wireMaterials{};

  static constexpr auto fields() {
    return field_list(
        field("wireMaterials",
              &WireRestShape::wireMaterials,
              "",
              "sections from the handle to the tip, those of RodStraightSection and RodSpireSection"));
  }

  // after update
  std::vector<RodBeam> beams{};
  typename D::VecCoord frames{};
  std::vector<Edge> edges{}, collisionEdges{};
  std::vector<Eigen::Vector3d> collisionPoints{};
  std::vector<double> keyPoints{};

  static constexpr auto outputs() {
    using S = WireRestShape;
    return field_list(
        field("beams", &S::beams, "", "from frame to frame"),
        field("frames", &S::frames, "m", "their ends at rest").also("position"),
        field("edges", &S::edges, "", "from each frame to the next"),
        field("collisionPoints", &S::collisionPoints, "m", "how far along the wire, 0, 0, for each point"),
        field("collisionEdges", &S::collisionEdges, "", "from each of these to the next"),
        field("keyPoints", &S::keyPoints, "m", "where sections begin and end along the wire"));
  }

  /// Throws Error where there is no section, or one that cannot be.
  void update(std::string_view where) {
    check_fields(*this, where);
    std::vector<RodBeam> made = rod_beams(text(where, ": ", component_name<WireRestShape>()), wireMaterials);
    beams.swap(made);
    frames.assign(1, D::zero());
    edges.clear(), collisionEdges.clear(), collisionPoints.clear();
    for (RodBeam const& b : beams) {
      auto const last = frames.back();
      auto next = last;
      next.center += last.orientation * b.chord.template cast<typename D::Real>();
      next.orientation = last.orientation * b.turn().template cast<typename D::Real>();
      edges.push_back({int(frames.size()) - 1, int(frames.size())});
      frames.push_back(next);
    }
    keyPoints.assign(1, 0.0);
    collisionPoints.emplace_back(0, 0, 0);
    for (RodSection const& s : wireMaterials) {
      for (int k = 1; k <= s.nbEdgesCollis; ++k) {
        collisionEdges.push_back({int(collisionPoints.size()) - 1, int(collisionPoints.size())});
        collisionPoints.emplace_back(keyPoints.back() + s.length * k / s.nbEdgesCollis, 0, 0);
      }
      keyPoints.push_back(keyPoints.back() + s.length);
    }
  }
};

}  // namespace sinew
