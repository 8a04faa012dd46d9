// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>
#include <sinew/topology/border.hpp>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace sinew {

/// Which lists of faces are the whole border of a volume: 1 oriented outwards, -1 inwards, 0 they are not.
struct BorderLists {
  int triangles = 0, quads = 0;
  bool any() const { return triangles != 0 || quads != 0; }
};

/// What becomes of the border of volume elements of which some go: faces go with them, and others are laid
/// bare. All in the numbers of the points before.
class RemovedBorder {
 public:
  RemovedBorder() = default;
  RemovedBorder(TopologyView const& before, std::array<std::vector<bool>, element_kinds> const& stays);

  BorderLists listed(std::span<Triangle const> triangles, std::span<Quad const> quads) const {
    return {triangles_.listed(triangles), quads_.listed(quads)};
  }
  /// Marks what goes of the lists of a topology.
  void mark(BorderLists const& is, TopologyView const& view,
            std::array<std::vector<bool>, element_kinds>& stays) const;
  /// Takes what goes out of lists.
  void takeAway(BorderLists const& is, std::vector<Triangle>& triangles, std::vector<Quad>& quads) const;
  /// Puts what is laid bare behind lists that have followed already, in the numbers of the points now.
  void exposeFaces(BorderLists const& is, Renumbering const& points, std::vector<Triangle>* triangles,
                   std::vector<Quad>* quads) const;

 private:
  template <std::size_t N>
  struct Faces {
    using Face = std::array<Index, N>;
    std::vector<Face> before{}, keys{}, keysGone{}, bare{};

    static std::vector<Face> sortedKeys(std::span<Face const> faces) {
      std::vector<Face> all;
      all.reserve(faces.size());
      for (Face const& f : faces) all.push_back(sorted_corners(f));
      std::sort(all.begin(), all.end());
      return all;
    }
    void set(std::vector<Face> const& was, std::vector<Face> const& ofGone) {
      before = was;
      keys = sortedKeys(was);
      keysGone = sortedKeys(ofGone);
      for (Face f : ofGone)
        if (!std::binary_search(keys.begin(), keys.end(), sorted_corners(f))) {
          std::reverse(f.begin(), f.end());  // seen from what stays
          bare.push_back(f);
        }
    }
    int listed(std::span<Face const> faces) const {
      if (faces.empty() || faces.size() != keys.size() || sortedKeys(faces) != keys) return 0;
      const Face key = sorted_corners(faces[0]);
      for (Face const& f : before)
        if (sorted_corners(f) == key) {
          // the corner behind the first one, both ways round
          const std::size_t at = std::size_t(std::find(f.begin(), f.end(), faces[0][0]) - f.begin());
          return f[(at + 1) % N] == faces[0][1] ? 1 : -1;
        }
      return 0;
    }
    bool stays(Face const& f) const {
      return !std::binary_search(keysGone.begin(), keysGone.end(), sorted_corners(f));
    }
    void mark(std::span<Face const> faces, std::vector<bool>& stay) const {
      for (std::size_t f = 0; f < faces.size(); ++f)
        if (!stays(faces[f])) stay[f] = false;
    }
    void exposeFaces(int orientation, Renumbering const& points, std::vector<Face>& faces) const {
      for (Face f : bare) {
        if (orientation < 0) std::reverse(f.begin(), f.end());
        for (Index& i : f) points.renumber(i);
        faces.push_back(f);
      }
    }
  };
  Faces<3> triangles_{};
  Faces<4> quads_{};
};

}  // namespace sinew

#if SINEW_DEFINES
namespace sinew {

SINEW_ONCE RemovedBorder::RemovedBorder(TopologyView const& before,
                                        std::array<std::vector<bool>, element_kinds> const& stays) {
  const Border was = border_of(before);
  // of what goes: its faces that were border go too, and those of what it leaves are laid bare
  auto gone = [](auto const& list, std::vector<bool> const& stay) {
    std::vector<std::decay_t<decltype(list[0])>> all;
    for (std::size_t e = 0; e < list.size(); ++e)
      if (!stay[e]) all.push_back(list[e]);
    return all;
  };
  const Border ofGone = border_of(gone(before.tetrahedra, stays[3]),
                                  gone(before.hexahedra, stays[4]),
                                  gone(before.pyramids, stays[5]),
                                  gone(before.prisms, stays[6]),
                                  gone(before.quadraticTetrahedra, stays[7]),
                                  gone(before.quadraticHexahedra, stays[8]),
                                  gone(before.triquadraticHexahedra, stays[9]));
  triangles_.set(was.triangles, ofGone.triangles);
  quads_.set(was.quads, ofGone.quads);
}

SINEW_ONCE void RemovedBorder::mark(BorderLists const& is, TopologyView const& view,
                                    std::array<std::vector<bool>, element_kinds>& stays) const {
  if (is.triangles) triangles_.mark(view.triangles, stays[1]);
  if (is.quads) quads_.mark(view.quads, stays[2]);
}

SINEW_ONCE void RemovedBorder::takeAway(BorderLists const& is, std::vector<Triangle>& triangles,
                                        std::vector<Quad>& quads) const {
  if (is.triangles) std::erase_if(triangles, [this](auto const& f) { return !triangles_.stays(f); });
  if (is.quads) std::erase_if(quads, [this](auto const& f) { return !quads_.stays(f); });
}

SINEW_ONCE void RemovedBorder::exposeFaces(BorderLists const& is, Renumbering const& points,
                                           std::vector<Triangle>* triangles, std::vector<Quad>* quads) const {
  if (is.triangles) triangles_.exposeFaces(is.triangles, points, *triangles);
  if (is.quads) quads_.exposeFaces(is.quads, points, *quads);
}

}  // namespace sinew
#endif
