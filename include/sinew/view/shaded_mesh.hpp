// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/view/colour_map.hpp>
#include <sinew/view/seen_scene.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

namespace sinew::view {

/// Places with colours: two ends for each line, or points.
struct ColouredPlaces {
  std::vector<Eigen::Vector3f> at{}, colours{};

  void add(Eigen::Vector3d const& place, Eigen::Vector3d const& colour) {
    at.push_back(place.cast<float>());
    colours.push_back(colour.cast<float>());
  }
  void clear() {
    at.clear();
    colours.clear();
  }
};

/// What a graphics card draws of a body: corners of triangles with normals and colours, three for each, lines
/// and points.
struct ShadedMesh {
  std::vector<Eigen::Vector3f> corners{}, normals{}, colours{};
  ColouredPlaces lines{}, points{};

  void addCorner(Eigen::Vector3d const& place, Eigen::Vector3d const& normal, Eigen::Vector3d const& colour) {
    corners.push_back(place.cast<float>());
    normals.push_back(normal.cast<float>());
    colours.push_back(colour.cast<float>());
  }
};

namespace detail {

// The normal of each corner: of the faces at its point, by their areas, those that meet its own at less than
// 40 degrees, so that round surfaces look round and edges stay sharp.
template <class ColourOf>
void add_faces(std::vector<Eigen::Vector3d> const& points, std::vector<Triangle> const& faces,
               ColourOf&& colourOf, ShadedMesh& mesh) {
  const double limit = std::cos(40 * std::numbers::pi / 180);
  std::vector<Eigen::Vector3d> areas(faces.size());  // twice, along the normal
  std::vector<double> lengths(faces.size());
  std::vector<int> first(points.size() + 1), around(3 * faces.size());  // the faces at each point
  for (std::size_t f = 0; f < faces.size(); ++f) {
    auto const& [a, b, c] = faces[f];
    Eigen::Vector3d const& origin = points[std::size_t(a)];
    areas[f] = (points[std::size_t(b)] - origin).cross(points[std::size_t(c)] - origin);
    lengths[f] = areas[f].norm();
    for (const Index i : faces[f]) ++first[std::size_t(i) + 1];
  }
  for (std::size_t i = 0; i < points.size(); ++i) first[i + 1] += first[i];
  std::vector<int> next(first.begin(), first.end() - 1);
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (const Index i : faces[f]) around[std::size_t(next[std::size_t(i)]++)] = int(f);
  mesh.corners.reserve(3 * faces.size());
  mesh.normals.reserve(3 * faces.size());
  mesh.colours.reserve(3 * faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (!std::isfinite(lengths[f])) continue;
    const Eigen::Vector3d own = lengths[f] > 0 ? Eigen::Vector3d(areas[f] / lengths[f]) : areas[f];
    for (const Index i : faces[f]) {
      Eigen::Vector3d normal = Eigen::Vector3d::Zero();
      for (int k = first[std::size_t(i)]; k < first[std::size_t(i) + 1]; ++k) {
        const auto g = std::size_t(around[std::size_t(k)]);
        if (lengths[g] > 0 && areas[g].dot(own) > limit * lengths[g]) normal += areas[g];
      }
      const double length = normal.norm();
      mesh.addCorner(points[std::size_t(i)],
                     length > 0 ? Eigen::Vector3d(normal / length) : own,
                     colourOf(std::size_t(i)));
    }
  }
}

}  // namespace detail

/// A body for drawing, with the edges of its elements where it is no visual model. Where it has values, a
/// legend says what their colours are.
inline ShadedMesh shaded_mesh(SeenBody const& body, std::optional<Legend> const& legend = {},
                              SeenSettings const& settings = {}) {
  ShadedMesh mesh;
  std::vector<Triangle> faces = body.triangles;
  for (auto const& [a, b, c, d] : body.quads)
    faces.insert(faces.end(), {Triangle{a, b, c}, Triangle{a, c, d}});
  const bool valued = legend && body.values.size() == body.points.size();
  const double span = legend && legend->high > legend->low ? legend->high - legend->low : 1;
  auto colourOf = [&](std::size_t i) -> Eigen::Vector3d {
    return valued ? colour_of_value((body.values[i] - legend->low) / span) : body.colour;
  };
  const bool collision = body.kind == SeenBody::Kind::collision, asLines = settings.wireframe || collision;
  if (!asLines) detail::add_faces(body.points, faces, colourOf, mesh);
  if (settings.normals && !asLines) {
    const auto [low, high] = SeenScene{.bodies = {body}}.box();
    const float length = float((high - low).norm() / 30);
    for (std::size_t i = 0; i < mesh.corners.size(); ++i)
      for (const float along : {0.f, length}) {
        mesh.lines.at.push_back(mesh.corners[i] + along * mesh.normals[i]);
        mesh.lines.colours.push_back({0.2f, 0.2f, 0.2f});
      }
  }

  std::vector<Edge> edges = body.edges;
  auto outline = [&](auto const& face) {
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Index i = face[k], j = face[(k + 1) % face.size()];
      edges.push_back(i < j ? Edge{i, j} : Edge{j, i});
    }
  };
  if (body.kind == SeenBody::Kind::state || asLines) {
    for (auto const& t : body.triangles) outline(t);
    for (auto const& q : body.quads) outline(q);
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  const double dark = mesh.corners.empty() ? 1 : 0.4;
  for (Edge const& e : edges)
    for (const Index i : e) mesh.lines.add(body.points[std::size_t(i)], dark * colourOf(std::size_t(i)));
  if (faces.empty() && edges.empty())
    for (std::size_t i = 0; i < body.points.size(); ++i) mesh.points.add(body.points[i], colourOf(i));
  return mesh;
}

}  // namespace sinew::view
