// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// A cylinder along z, made without a file: tetrahedra that fill it, and triangles over its side, with
/// `openSurface` off over its ends, too. Each layer has its centre, then rings from the inside on.
struct GenerateCylinder {
  using Role = role::Engine;
  static constexpr std::string_view className = "GenerateCylinder";

  double radius = 0.2, height = 1;
  Eigen::Vector3d origin{0, 0, 0};
  bool openSurface = true;
  int resCircumferential = 6, resRadial = 3, resHeight = 5;

  static constexpr auto fields() {
    using E = GenerateCylinder;
    return field_list(
        field("radius", &E::radius, "m", "of the cylinder", range::positive),
        field("height", &E::height, "m", "of the cylinder", range::positive),
        field("origin", &E::origin, "m", "centre of the lower end"),
        field("openSurface", &E::openSurface, "", "whether the triangles leave the ends open"),
        field("resCircumferential", &E::resCircumferential, "", "points of a ring", range::atLeast(3)),
        field("resRadial", &E::resRadial, "", "rings of a layer", range::atLeast(1)),
        field("resHeight", &E::resHeight, "", "layers of points", range::atLeast(2)));
  }

  // after update
  std::vector<Eigen::Vector3d> position{}, surfacePosition{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<Triangle> triangles{};

  static constexpr auto outputs() {
    using E = GenerateCylinder;
    return field_list(field("output_TetrahedraPosition", &E::position, "m", "points of the tetrahedra")
                          .also("output_position position"),
                      field("output_TrianglesPosition", &E::surfacePosition, "m", "points of the triangles"),
                      field("tetrahedra", &E::tetrahedra, "", "over output_TetrahedraPosition"),
                      field("triangles", &E::triangles, "", "over output_TrianglesPosition"));
  }

  /// Throws Error for a field out of its range, and for more than 2^24 points.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <cmath>
#include <numbers>

namespace sinew {

SINEW_ONCE void GenerateCylinder::update(std::string_view where) {
  check_fields(*this, where);
  const int around = resCircumferential, rings = resRadial, layers = resHeight;
  if ((double(around) * rings + 1) * layers > 16777216)
    throw Error(text(where, ": ", className),
                text("the resolution makes ",
                     (double(around) * rings + 1) * layers,
                     " points, more than 2^24; make it coarser"));
  auto at = [&](double r, int k, int layer) -> Eigen::Vector3d {
    const double angle = 2 * std::numbers::pi * k / around;
    return origin + Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), layer * height / (layers - 1));
  };
  position.clear(), surfacePosition.clear(), tetrahedra.clear(), triangles.clear();

  for (int layer = 0; layer < layers; ++layer) {
    position.push_back(at(0, 0, layer));
    for (int ring = 1; ring <= rings; ++ring)
      for (int k = 0; k < around; ++k) position.push_back(at(ring * radius / rings, k, layer));
  }
  const Index below = around * rings + 1;  // from a layer to the one under it
  for (int layer = 1; layer < layers; ++layer) {
    Index c = layer * below;
    for (int k = 1, before = around; k <= around; before = k++) {
      const Index p[6] = {c, c + before, c + k, c - below, c + before - below, c + k - below};
      tetrahedra.push_back({p[1], p[0], p[2], p[3]});
      tetrahedra.push_back({p[1], p[2], p[4], p[3]});
      tetrahedra.push_back({p[3], p[4], p[5], p[2]});
    }
    for (int ring = 1; ring < rings; ++ring, c += around)
      for (int k = 1, before = around; k <= around; before = k++) {
        Index h[8] = {c + k, c + before, c + k + around, c + before + around};
        for (int i = 0; i < 4; ++i) h[4 + i] = h[i] - below;
        tetrahedra.push_back({h[0], h[5], h[4], h[7]});
        tetrahedra.push_back({h[0], h[1], h[5], h[3]});
        tetrahedra.push_back({h[5], h[0], h[3], h[7]});
        tetrahedra.push_back({h[0], h[3], h[7], h[2]});
        tetrahedra.push_back({h[7], h[0], h[2], h[4]});
        tetrahedra.push_back({h[6], h[7], h[2], h[4]});
      }
  }

  for (int layer = 0; layer < layers; ++layer)
    for (int k = 0; k < around; ++k) surfacePosition.push_back(at(radius, k, layer));
  for (int layer = 1; layer < layers; ++layer)
    for (int k = 0; k < around; ++k) {
      const Index next = (k + 1) % around, high = layer * around, low = high - around;
      triangles.push_back({high + k, low + k, low + next});
      triangles.push_back({high + k, low + next, high + next});
    }
  if (openSurface) return;
  for (int end = 0; end < 2; ++end) {
    const Index centre = Index(surfacePosition.size()), outer = end * (layers - 1) * around;
    auto add = [&](Index a, Index b, Index c) {
      triangles.push_back(end == 1 ? Triangle{a, b, c} : Triangle{a, c, b});
    };
    surfacePosition.push_back(at(0, 0, end * (layers - 1)));
    for (int ring = 1; ring < rings; ++ring)
      for (int k = 0; k < around; ++k)
        surfacePosition.push_back(at(ring * radius / rings, k, end * (layers - 1)));
    auto ringStart = [&](int ring) { return ring == rings ? outer : centre + 1 + (ring - 1) * around; };
    for (int k = 0; k < around; ++k) add(centre, ringStart(1) + k, ringStart(1) + (k + 1) % around);
    for (int ring = 1; ring < rings; ++ring)
      for (int k = 0; k < around; ++k) {
        const Index next = (k + 1) % around, in = ringStart(ring), out = ringStart(ring + 1);
        add(in + k, out + k, out + next);
        add(in + k, out + next, in + next);
      }
  }
}

}  // namespace sinew
#endif
