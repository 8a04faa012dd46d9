// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/mesh.hpp>
#include <sinew/core/surface_looks.hpp>
#include <sinew/view/seen_settings.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace sinew::view {

/// What is seen of a node, or of those of its faces that are of one material: surfaces, or where there are
/// none lines, or points.
struct SeenBody {
  enum class Kind { state, visual, collision };
  std::string path{};
  Kind kind = Kind::state;
  bool visible = true;
  std::vector<Eigen::Vector3d> points{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  std::vector<Edge> edges{};
  std::vector<Triangle> beyond{};  // of a surface of which this is a part: faces of others that meet its own
  std::vector<double> values{};    // of the quantity that colours show, one a point; or none
  Eigen::Vector3d colour{0.5, 0.5, 0.5};  // red, green, blue from 0 to 1
  double opacity = 1;                     // what is behind shows through where it is less
  SurfaceLooks inTexture{};               // texcoords of the corners of all triangles and quads; or none
  std::shared_ptr<SeenTexture const> texture{};  // times the colour; only where there are texcoords
  bool ofMaterial = false;                       // whether the colour is that of a material
  // of what is mirrored: the colour, and the exponent of Blinn's model
  Eigen::Vector3d specular = plainSpecular;
  double shininess = plainShininess;

  static inline const Eigen::Vector3d plainSpecular{0.12, 0.12, 0.12};
  static constexpr double plainShininess = 40;

  /// The corners of the smallest box around all points that are finite; where there is none, the lower one is
  /// above the higher one.
  std::pair<Eigen::Vector3d, Eigen::Vector3d> box() const {
    constexpr double most = std::numeric_limits<double>::infinity();
    Eigen::Vector3d low = Eigen::Vector3d::Constant(most), high = -low;
    for (Eigen::Vector3d const& p : points)
      if (p.allFinite()) low = low.cwiseMin(p), high = high.cwiseMax(p);
    return {low, high};
  }
};

namespace detail {

// Those faces of a body that `is` says, and their points; behind these the points of other faces that meet
// them, so that normals do not end where the part does. Faces are counted through all triangles, then quads.
template <class Is>
SeenBody part_of(SeenBody const& body, Is&& is) {
  SeenBody part{.path = body.path, .kind = body.kind};
  std::vector<Index> now(body.points.size(), -1);
  auto renumbered = [&](auto face) {
    for (Index& i : face) {
      Index& number = now[std::size_t(i)];
      if (number < 0) {
        number = Index(part.points.size());
        part.points.push_back(body.points[std::size_t(i)]);
        if (!body.values.empty()) part.values.push_back(body.values[std::size_t(i)]);
      }
      i = number;
    }
    return face;
  };
  auto take = [&](auto const& faces, auto const& corners, std::size_t first, auto& to, auto& cornersTo) {
    for (std::size_t f = 0; f < faces.size(); ++f) {
      if (!is(first + f)) continue;
      to.push_back(renumbered(faces[f]));
      if (!corners.empty()) cornersTo.push_back(corners[f]);
    }
  };
  take(body.triangles, body.inTexture.triangles, 0, part.triangles, part.inTexture.triangles);
  take(body.quads, body.inTexture.quads, body.triangles.size(), part.quads, part.inTexture.quads);
  if (!part.inTexture.triangles.empty() || !part.inTexture.quads.empty())
    part.inTexture.texcoords = body.inTexture.texcoords;
  const std::vector<Index> own = now;
  auto meet = [&](Triangle const& t) {
    if (std::any_of(t.begin(), t.end(), [&](Index i) { return own[std::size_t(i)] >= 0; }))
      part.beyond.push_back(renumbered(t));
  };
  for (std::size_t f = 0; f < body.triangles.size(); ++f)
    if (!is(f)) meet(body.triangles[f]);
  for (std::size_t f = 0; f < body.quads.size(); ++f) {
    auto const& [a, b, c, d] = body.quads[f];
    if (!is(body.triangles.size() + f)) meet({a, b, c}), meet({a, c, d});
  }
  return part;
}

inline void set_material(SeenBody& body, SeenMaterial const& material) {
  body.colour = material.colour;
  body.opacity = material.opacity;
  body.texture = material.texture;
  body.specular = material.specular;
  body.shininess = material.shininess;
}

}  // namespace detail

/// A visual model as one body, or as one for each material of its faces that there is.
inline std::vector<SeenBody> bodies_by_material(SeenBody body, SurfaceLooks looks,
                                                std::vector<SeenMaterial> const& materials) {
  // where each material of the faces is; -1: nowhere
  std::vector<int> place;
  bool any = false;
  for (std::string const& name : looks.materials) {
    const auto found = std::find_if(materials.begin(), materials.end(), [&](SeenMaterial const& m) {
      return m.library == looks.library && m.name == name;
    });
    place.push_back(found == materials.end() ? -1 : int(found - materials.begin()));
    any = any || place.back() >= 0;
  }
  const std::vector<Index> ofFaces = std::move(looks.faceMaterials);
  body.inTexture = {.texcoords = std::move(looks.texcoords),
                    .triangles = std::move(looks.triangles),
                    .quads = std::move(looks.quads)};
  std::vector<SeenBody> all;
  if (any && ofFaces.size() == body.triangles.size() + body.quads.size()) {
    auto placeOf = [&](std::size_t f) { return ofFaces[f] < 0 ? -1 : place[std::size_t(ofFaces[f])]; };
    for (int m = -1; m < int(materials.size()); ++m) {
      SeenBody part = detail::part_of(body, [&](std::size_t f) { return placeOf(f) == m; });
      if (part.points.empty()) continue;
      if (m >= 0) detail::set_material(part, materials[std::size_t(m)]);
      part.ofMaterial = m >= 0;
      all.push_back(std::move(part));
    }
  }
  if (all.empty()) all.push_back(std::move(body));
  return all;
}

}  // namespace sinew::view
