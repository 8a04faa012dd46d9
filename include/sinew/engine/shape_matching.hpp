// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/topology/shape_clusters.hpp>

#include <string>
#include <vector>

namespace sinew {

/// Where the points of clusters belong by matching of shapes (Mueller, Heidelberger, Teschner, Gross 2005):
/// each cluster is moved as a rigid body, or by an affine map, as near as possible to where its points are. A
/// PositionBasedDynamicsProjectiveConstraint whose position is a link to the targetPosition takes the
/// clusters, and matches shapes in each step; targetPosition itself is that of the start.
template <class D>
struct ShapeMatching {
  using Role = role::Engine;
  using DataTypes = D;
  static_assert(!D::rigid && D::size == 3, "ShapeMatching is over points in space");
  static constexpr std::string_view className = "ShapeMatching";
  static constexpr bool ofPositions = true;
  static constexpr std::string_view law = "targetPosition";

  int iterations = 1;
  double affineRatio = 0;
  double fixedweight = 1;
  std::vector<Eigen::Vector3d> fixedPosition0{}, fixedPosition{};
  std::vector<Eigen::Vector3d> position{}, rest_position{};
  std::vector<std::vector<int>> cluster{};

  static constexpr auto fields() {
    using M = ShapeMatching;
    return field_list(
        field("iterations", &M::iterations, "", "how often shapes are matched", range::atLeast(1)),
        field("affineRatio",
              &M::affineRatio,
              "",
              "0: clusters move rigidly; 1: by an affine map; between, by a mean of both",
              range::closed(0, 1)),
        field("fixedweight",
              &M::fixedweight,
              "",
              "what a fixed point weighs, beside the mean of the points",
              range::positive),
        field("fixedPosition0",
              &M::fixedPosition0,
              "m",
              "fixed points at rest, in clusters numbered behind the points"),
        field("fixedPosition", &M::fixedPosition, "m", "where they are"),
        field("position", &M::position, "m", "where the points are"),
        field("rest_position", &M::rest_position, "m", "where they are at rest"),
        field("cluster", &M::cluster, "", "points of each cluster"));
  }

  // after update
  std::vector<Eigen::Vector3d> targetPosition{};

  static constexpr auto outputs() {
    return field_list(field("targetPosition", &ShapeMatching::targetPosition, "m", "where they belong"));
  }

  /// Throws Error where there are no clusters, or one of them is not over the points.
  void update(std::string_view where) {
    check_fields(*this, where);
    const std::string at = text(where, ": ", component_name<ShapeMatching>());
    if (cluster.empty())
      throw Error(at, "cluster is empty; link it to that of a ClusteringEngine, or name the points of some");
    if (position.size() != rest_position.size())
      throw Error(at,
                  text("position has ",
                       position.size(),
                       " points, but rest_position ",
                       rest_position.size(),
                       "; give both of the same"));
    ShapeClusters shapes;
    shapes.init(at, cluster, rest_position, {}, {fixedPosition0, fixedPosition, fixedweight}, affineRatio);
    targetPosition = position;
    shapes.match(targetPosition, iterations);
  }
};

}  // namespace sinew
