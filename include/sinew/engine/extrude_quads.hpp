// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// A surface of quads thickened into hexahedra, numberOfSlices of them over each quad: its points, stretched
/// by scale, are displaced along the unit normal n of the surface before that from -thicknessIn n to
/// thicknessOut n. The points of one place follow each other.
struct ExtrudeQuadsAndGenerateHexas {
  using Role = role::Engine;
  static constexpr std::string_view className = "ExtrudeQuadsAndGenerateHexas";

  Eigen::Vector3d scale{1, 1, 1};
  double thicknessIn = 0, thicknessOut = 1;
  int numberOfSlices = 1;
  bool flipNormals = false;
  std::vector<Eigen::Vector3d> surfaceVertices{};
  std::vector<Quad> surfaceQuads{};

  static constexpr auto fields() {
    using E = ExtrudeQuadsAndGenerateHexas;
    return field_list(
        field("scale", &E::scale, "", "sizes of the surface along the axes"),
        field("thicknessIn", &E::thicknessIn, "m", "against the normals"),
        field("thicknessOut", &E::thicknessOut, "m", "along the normals"),
        field("numberOfSlices", &E::numberOfSlices, "", "hexahedra over a quad", range::closed(1, 1 << 20)),
        field("flipNormals",
              &E::flipNormals,
              "",
              "whether hexahedra begin with the quad as it is, and not reversed"),
        field("surfaceVertices", &E::surfaceVertices, "m", "points of the surface"),
        field("surfaceQuads", &E::surfaceQuads, "", "of the surface", range::nonNegative));
  }

  // after update
  std::vector<Eigen::Vector3d> extrudedVertices{};
  std::vector<Quad> extrudedSurfaceQuads{}, extrudedQuads{};
  std::vector<Hexahedron> extrudedHexas{};

  static constexpr auto outputs() {
    using E = ExtrudeQuadsAndGenerateHexas;
    return field_list(
        field("extrudedVertices", &E::extrudedVertices, "m", "of each point: its places, slice by slice"),
        field("extrudedSurfaceQuads", &E::extrudedSurfaceQuads, "", "the surface, at -thicknessIn"),
        field("extrudedQuads", &E::extrudedQuads, "", "all sides of the hexahedra"),
        field("extrudedHexas", &E::extrudedHexas, "", "the hexahedra over each quad"));
  }

  /// Throws Error where there is no quad, or one refers to a missing point; the outputs then stay.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
namespace sinew {

SINEW_ONCE void ExtrudeQuadsAndGenerateHexas::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  if (surfaceQuads.empty()) throw Error(at, "surfaceQuads is empty; link it to the quads of a surface");
  detail::check_indices(at, "quad", surfaceQuads, surfaceVertices.size());
  const int n = numberOfSlices;
  if (double(surfaceVertices.size()) * (n + 1) > 16777216)
    throw Error(at, text("numberOfSlices is ", n, ", which makes more than 2^24 points; reduce it"));

  std::vector<Eigen::Vector3d> normals(surfaceVertices.size(), Eigen::Vector3d::Zero());
  for (auto const& q : surfaceQuads) {
    auto x = [&](std::size_t k) -> Eigen::Vector3d const& { return surfaceVertices[std::size_t(q[k])]; };
    const Eigen::Vector3d normal = (x(1) - x(0)).cross(x(2) - x(0)).stableNormalized();
    for (const Index i : q) normals[std::size_t(i)] += normal;
  }
  extrudedVertices.clear(), extrudedSurfaceQuads.clear(), extrudedQuads.clear(), extrudedHexas.clear();
  const double step = (thicknessIn + thicknessOut) / n;
  for (std::size_t i = 0; i < surfaceVertices.size(); ++i) {
    const Eigen::Vector3d x = surfaceVertices[i].cwiseProduct(scale), normal = normals[i].stableNormalized();
    for (int s = 0; s <= n; ++s) extrudedVertices.push_back(x + (s * step - thicknessIn) * normal);
  }
  for (auto const& q : surfaceQuads) {
    auto point = [&](std::size_t k, int slice) { return q[k] * (n + 1) + slice; };
    auto layer = [&](int s) { return Quad{point(0, s), point(1, s), point(2, s), point(3, s)}; };
    auto reversed = [](Quad a) { return Quad{a[3], a[2], a[1], a[0]}; };
    extrudedSurfaceQuads.push_back(layer(0));
    extrudedQuads.push_back(layer(0));
    extrudedQuads.push_back(reversed(layer(n)));
    for (int s = 1; s < n; ++s) {
      extrudedQuads.push_back(layer(s));
      extrudedQuads.push_back(reversed(layer(s)));
    }
    for (int s = 0; s < n; ++s) {
      for (std::size_t k = 0; k < 4; ++k)
        extrudedQuads.push_back(
            {point(k, s), point(k, s + 1), point((k + 1) % 4, s + 1), point((k + 1) % 4, s)});
      const Quad low = flipNormals ? layer(s) : reversed(layer(s)),
                 high = flipNormals ? layer(s + 1) : reversed(layer(s + 1));
      extrudedHexas.push_back({low[0], low[1], low[2], low[3], high[0], high[1], high[2], high[3]});
    }
  }
}

}  // namespace sinew
#endif
