// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// In which tetrahedron of a mesh, or which triangle where it has none, each of some points is, and with
/// which coordinates: x = a + u (b - a) + v (c - a) + w (d - a). A point that is in none has the element
/// whose mean is nearest; a triangle has a point within 0.01 of the length of its normal.
struct MeshBarycentricMapperEngine {
  using Role = role::Engine;
  static constexpr std::string_view className = "MeshBarycentricMapperEngine";

  std::vector<Eigen::Vector3d> inputPositions{}, mappedPointPositions{};
  std::vector<Triangle> triangles{};
  std::vector<Tetrahedron> tetrahedra{};
  bool computeLinearInterpolation = false;

  static constexpr auto fields() {
    using E = MeshBarycentricMapperEngine;
    return field_list(
        field("inputPositions", &E::inputPositions, "m", "points of the mesh"),
        field("mappedPointPositions", &E::mappedPointPositions, "m", "points that are looked for"),
        field("triangles", &E::triangles, "", "of the mesh", range::nonNegative),
        field("tetrahedra", &E::tetrahedra, "", "of the mesh", range::nonNegative),
        field("computeLinearInterpolation",
              &E::computeLinearInterpolation,
              "",
              "whether points and weights are listed, too"));
  }

  // after update
  std::vector<Eigen::Vector3d> barycentricPositions{};
  std::vector<int> tableElements{};
  std::vector<std::vector<int>> linearInterpolationIndices{};
  std::vector<std::vector<double>> linearInterpolationValues{};

  static constexpr auto outputs() {
    using E = MeshBarycentricMapperEngine;
    return field_list(field("barycentricPositions",
                            &E::barycentricPositions,
                            "",
                            "u v w of each point; w is 0 in a triangle"),
                      field("tableElements", &E::tableElements, "", "the element of each point"),
                      field("linearInterpolationIndices",
                            &E::linearInterpolationIndices,
                            "",
                            "of each point: the corners of its element"),
                      field("linearInterpolationValues",
                            &E::linearInterpolationValues,
                            "",
                            "and their weights, which are 1 together"));
  }

  /// Throws Error where there is no element, one is flat, or refers to a missing point; the outputs then
  /// stay.
  void update(std::string_view where);

 private:
  template <class Elements>
  void locate(std::string const& at, std::string_view kind, Elements const& elements);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew {

template <class Elements>
void MeshBarycentricMapperEngine::locate(std::string const& at, std::string_view kind,
                                         Elements const& elements) {
  constexpr bool volumes = std::tuple_size_v<typename Elements::value_type> == 4;
  detail::check_indices(at, kind, elements, inputPositions.size());
  auto x = [&](Index i) -> Eigen::Vector3d const& { return inputPositions[std::size_t(i)]; };
  std::vector<Eigen::Matrix3d> inverses;
  std::vector<Eigen::Vector3d> means;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    auto const& c = elements[e];
    Eigen::Matrix3d sides;
    sides.col(0) = x(c[1]) - x(c[0]);
    sides.col(1) = x(c[2]) - x(c[0]);
    if constexpr (volumes)
      sides.col(2) = x(c[3]) - x(c[0]);
    else
      sides.col(2) = sides.col(0).cross(sides.col(1));
    if (!(std::abs(sides.determinant()) >
          1e-14 * sides.col(0).norm() * sides.col(1).norm() * sides.col(2).norm()))
      throw Error(at, text(kind, ' ', e, " is flat; move or merge its points"));
    inverses.push_back(sides.inverse());
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Index i : c) mean += x(i) / double(c.size());
    means.push_back(mean);
  }
  barycentricPositions.clear(), tableElements.clear();
  linearInterpolationIndices.clear(), linearInterpolationValues.clear();
  for (auto const& p : mappedPointPositions) {
    Eigen::Vector3d found = Eigen::Vector3d::Zero();
    std::size_t element = 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t e = 0; e < elements.size(); ++e) {
      const Eigen::Vector3d v = inverses[e] * (p - x(elements[e][0]));
      // negative inside, where the deepest element counts
      double d = volumes ? std::max({-v[0], -v[1], -v[2], v.sum() - 1})
                         : std::max({-v[0], -v[1], std::abs(v[2]) - 0.01, v[0] + v[1] - 1});
      if (d > 0) d = (p - means[e]).squaredNorm();
      if (d < nearest) nearest = d, element = e, found = v;
    }
    if (!volumes) found[2] = 0;
    barycentricPositions.push_back(found);
    tableElements.push_back(int(element));
    if (!computeLinearInterpolation) continue;
    auto const& c = elements[element];
    linearInterpolationIndices.emplace_back(c.begin(), c.end());
    auto& weights = linearInterpolationValues.emplace_back();
    weights.push_back(1 - found.sum());
    for (std::size_t k = 1; k < c.size(); ++k) weights.push_back(found[Eigen::Index(k) - 1]);
  }
}

SINEW_ONCE void MeshBarycentricMapperEngine::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  if (!tetrahedra.empty())
    locate(at, "tetrahedron", tetrahedra);
  else if (!triangles.empty())
    locate(at, "triangle", triangles);
  else
    throw Error(at, "there is neither a tetrahedron nor a triangle; put it below a topology that has some");
}

}  // namespace sinew
#endif
