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

/// What a graphics card draws of a body: triangles of corners with normals and colours, lines and points.
struct ShadedMesh {
  std::vector<Eigen::Vector3f> corners{}, normals{}, colours{};
  std::vector<unsigned> triangles{};  // three corners for each
  ColouredPlaces lines{}, points{};

  /// The corner of a triangle, and of no other.
  void addCorner(Eigen::Vector3d const& place, Eigen::Vector3d const& normal, Eigen::Vector3d const& colour) {
    triangles.push_back(add(place, normal, colour));
  }
  unsigned add(Eigen::Vector3d const& place, Eigen::Vector3d const& normal, Eigen::Vector3d const& colour) {
    corners.push_back(place.cast<float>());
    normals.push_back(normal.cast<float>());
    colours.push_back(colour.cast<float>());
    return unsigned(corners.size() - 1);
  }
};

namespace detail {

/// The faces of a body with the normal of each corner: of the faces at its point, by their areas, those that
/// meet its own at less than 40 degrees, so that round surfaces look round and edges stay sharp. Corners at
/// one point with one normal are one.
template <class ColourOf>
class SmoothFaces {
 public:
  SmoothFaces(std::vector<Eigen::Vector3d> const& points, std::vector<Triangle> const& faces,
              ColourOf const& colourOf, ShadedMesh& mesh)
      : points_(points), faces_(faces), colourOf_(colourOf), mesh_(mesh) {
    measure();
    for (std::size_t i = 0; i < points.size(); ++i) joinAt(i);
    mesh.triangles.reserve(3 * faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (std::isfinite(lengths_[f]))
        for (const Index i : faces[f]) mesh.triangles.push_back(cornerOf(f, std::size_t(i)));
  }

 private:
  static constexpr unsigned none = ~0u;
  std::vector<Eigen::Vector3d> const& points_;
  std::vector<Triangle> const& faces_;
  ColourOf const& colourOf_;
  ShadedMesh& mesh_;
  std::vector<Eigen::Vector3d> areas_{};  // twice, along the normal
  std::vector<double> lengths_{};
  std::vector<int> first_{}, around_{};  // the faces at each point
  // a corner at each point, the next one at the same point, and whether there is but one
  std::vector<unsigned> cornerAt_{}, next_{};
  std::vector<bool> isOne_{};

  void measure() {
    areas_.resize(faces_.size());
    lengths_.resize(faces_.size());
    first_.assign(points_.size() + 1, 0);
    around_.resize(3 * faces_.size());
    cornerAt_.assign(points_.size(), none);
    isOne_.assign(points_.size(), false);
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      auto const& [a, b, c] = faces_[f];
      Eigen::Vector3d const& origin = points_[std::size_t(a)];
      areas_[f] = (points_[std::size_t(b)] - origin).cross(points_[std::size_t(c)] - origin);
      lengths_[f] = areas_[f].norm();
      for (const Index i : faces_[f]) ++first_[std::size_t(i) + 1];
    }
    for (std::size_t i = 0; i < points_.size(); ++i) first_[i + 1] += first_[i];
    std::vector<int> next(first_.begin(), first_.end() - 1);
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (const Index i : faces_[f]) around_[std::size_t(next[std::size_t(i)]++)] = int(f);
  }
  // The sum of the areas at a point that a condition holds for.
  template <class Condition>
  Eigen::Vector3d sumAt(std::size_t i, Condition&& holds) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int k = first_[i]; k < first_[i + 1]; ++k)
      if (const auto f = std::size_t(around_[std::size_t(k)]); lengths_[f] > 0 && holds(f)) sum += areas_[f];
    return sum;
  }
  unsigned add(std::size_t i, Eigen::Vector3d const& normal) {
    next_.push_back(cornerAt_[i]);
    return cornerAt_[i] = mesh_.add(points_[i], normal, colourOf_(i));
  }
  // faces that all meet their mean at less than 20 degrees have one corner
  void joinAt(std::size_t i) {
    static const double half = std::cos(20 * std::numbers::pi / 180);
    const Eigen::Vector3d sum = sumAt(i, [](std::size_t) { return true; });
    const double length = sum.norm();
    if (!(length > 0) || !std::isfinite(length)) return;
    for (int k = first_[i]; k < first_[i + 1]; ++k) {
      const auto f = std::size_t(around_[std::size_t(k)]);
      if (lengths_[f] > 0 && !(areas_[f].dot(sum) > half * lengths_[f] * length)) return;
    }
    add(i, sum / length);
    isOne_[i] = true;
  }
  unsigned cornerOf(std::size_t face, std::size_t i) {
    static const double limit = std::cos(40 * std::numbers::pi / 180);
    if (isOne_[i]) return cornerAt_[i];
    const Eigen::Vector3d own =
        lengths_[face] > 0 ? Eigen::Vector3d(areas_[face] / lengths_[face]) : areas_[face];
    Eigen::Vector3d normal =
        sumAt(i, [&](std::size_t f) { return areas_[f].dot(own) > limit * lengths_[f]; });
    const double length = normal.norm();
    normal = length > 0 ? Eigen::Vector3d(normal / length) : own;
    for (unsigned c = cornerAt_[i]; c != none; c = next_[c])
      if (mesh_.normals[c] == normal.cast<float>()) return c;
    return add(i, normal);
  }
};

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
  if (!asLines) detail::SmoothFaces(body.points, faces, colourOf, mesh);
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
