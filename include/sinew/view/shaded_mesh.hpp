// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/view/seen_scene.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace sinew::view {

/// What a graphics card draws of a body: corners of triangles with their normals, three for each, ends of
/// lines, and points.
struct ShadedMesh {
  std::vector<Eigen::Vector3f> corners{}, normals{};
  std::vector<Eigen::Vector3f> lines{};   // two ends for each
  std::vector<Eigen::Vector3f> points{};  // where there are neither
};

namespace detail {

// The normal of each corner: of the faces at its point, by their areas, those that meet its own at less than
// 40 degrees, so that round surfaces look round and edges stay sharp.
inline void add_faces(std::vector<Eigen::Vector3d> const& points, std::vector<Triangle> const& faces,
                      ShadedMesh& mesh) {
  const double limit = std::cos(40 * std::numbers::pi / 180);
  std::vector<Eigen::Vector3d> areas;  // twice, along the normal
  std::vector<std::vector<int>> at(points.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    auto const& [a, b, c] = faces[f];
    Eigen::Vector3d const& origin = points[std::size_t(a)];
    areas.push_back((points[std::size_t(b)] - origin).cross(points[std::size_t(c)] - origin));
    for (const Index i : faces[f]) at[std::size_t(i)].push_back(int(f));
  }
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Eigen::Vector3d own = areas[f].normalized();
    if (!areas[f].allFinite()) continue;
    for (const Index i : faces[f]) {
      Eigen::Vector3d normal = Eigen::Vector3d::Zero();
      for (const int g : at[std::size_t(i)]) {
        const double length = areas[std::size_t(g)].norm();
        if (length > 0 && areas[std::size_t(g)].dot(own) > limit * length) normal += areas[std::size_t(g)];
      }
      mesh.corners.push_back(points[std::size_t(i)].cast<float>());
      mesh.normals.push_back((normal.norm() > 0 ? normal.normalized() : own).cast<float>());
    }
  }
}

}  // namespace detail

/// A body for drawing, with the edges of its elements where it is no visual model.
inline ShadedMesh shaded_mesh(SeenBody const& body) {
  ShadedMesh mesh;
  std::vector<Triangle> faces = body.triangles;
  for (auto const& [a, b, c, d] : body.quads)
    faces.insert(faces.end(), {Triangle{a, b, c}, Triangle{a, c, d}});
  detail::add_faces(body.points, faces, mesh);

  std::vector<Edge> edges = body.edges;
  auto outline = [&](auto const& face) {
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Index i = face[k], j = face[(k + 1) % face.size()];
      edges.push_back(i < j ? Edge{i, j} : Edge{j, i});
    }
  };
  if (!body.visual) {
    for (auto const& t : body.triangles) outline(t);
    for (auto const& q : body.quads) outline(q);
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (Edge const& e : edges)
    for (const Index i : e) mesh.lines.push_back(body.points[std::size_t(i)].cast<float>());
  if (faces.empty() && edges.empty())
    for (auto const& p : body.points) mesh.points.push_back(p.cast<float>());
  return mesh;
}

}  // namespace sinew::view
