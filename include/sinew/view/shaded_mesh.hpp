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
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>
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
  std::vector<Eigen::Vector3f> texcoords{};                  // x and y of each corner, or none
  std::vector<unsigned> triangles{};                         // three corners for each
  std::vector<unsigned> casters{};                           // those that throw shadows
  double longest = std::numeric_limits<double>::infinity();  // no edge of a triangle is longer [m]
  Eigen::Vector3d low{0, 0, 0}, high{0, 0, 0};               // corners of the box around all points
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
  /// A corner that there is.
  unsigned addAgain(unsigned corner) {
    for (auto* list : {&corners, &normals, &colours}) {
      const Eigen::Vector3f same = (*list)[corner];
      list->push_back(same);
    }
    return unsigned(corners.size() - 1);
  }
};

namespace detail {

/// The faces of a body with the normal of each corner: of the faces at its point, by their areas, those that
/// meet its own at less than 40 degrees, so that round surfaces look round and edges stay sharp. Corners at
/// one point with one normal are one. Corner i is at point i; those behind are more of points at edges.
/// Behind `count` faces stand those that lie beyond the border of the body, which only normals see; their own
/// points are behind all others.
template <class ColourOf>
class SmoothFaces {
 public:
  SmoothFaces(std::vector<Eigen::Vector3d> const& points, std::vector<Triangle> const& faces,
              std::size_t count, ColourOf const& colourOf, ShadedMesh& mesh)
      : points_(points), faces_(faces), colourOf_(colourOf), mesh_(mesh), seen_(points.size()) {
    if (count < faces.size()) {
      seen_ = 0;
      for (std::size_t f = 0; f < count; ++f)
        for (const Index i : faces[f]) seen_ = std::max(seen_, std::size_t(i) + 1);
    }
    measure();
    findEdges();
    addPoints();
    mesh.triangles.reserve(3 * count);
    for (std::size_t f = 0; f < count; ++f)
      if (std::isfinite(lengths_[f]))
        for (const Index i : faces[f])
          mesh.triangles.push_back(atEdge_[std::size_t(i)] ? cornerOf(f, std::size_t(i)) : unsigned(i));
  }
  /// Of a list with one entry for each face those of the faces that became triangles.
  std::vector<Triangle> of(std::vector<Triangle> const& all) const {
    std::vector<Triangle> some;
    for (std::size_t f = 0; f < all.size(); ++f)
      if (std::isfinite(lengths_[f])) some.push_back(all[f]);
    return some;
  }

 private:
  static constexpr unsigned none = ~0u;
  std::vector<Eigen::Vector3d> const& points_;
  std::vector<Triangle> const& faces_;
  ColourOf const& colourOf_;
  ShadedMesh& mesh_;
  std::size_t seen_;                      // points of faces that are seen
  std::vector<Eigen::Vector3d> areas_{};  // of faces, twice, along the normal
  std::vector<double> lengths_{};
  std::vector<Eigen::Vector3d> normals_{};     // of points: of the sum of the areas there
  std::vector<char> atEdge_{};                 // a point that has more than one normal
  std::vector<int> first_{}, around_{};        // the faces at each such point
  std::vector<unsigned> cornerAt_{}, next_{};  // a corner at each of them, and the next one at the same point

  void measure() {
    areas_.resize(faces_.size());
    lengths_.resize(faces_.size());
    normals_.assign(points_.size(), Eigen::Vector3d::Zero());
    double longest = 0;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      auto const [a, b, c] = faces_[f];
      Eigen::Vector3d const& origin = points_[std::size_t(a)];
      const Eigen::Vector3d ab = points_[std::size_t(b)] - origin, ac = points_[std::size_t(c)] - origin,
                            area = ab.cross(ac);
      areas_[f] = area;
      lengths_[f] = area.norm();
      longest = std::max({longest, ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm()});
      for (const Index i : {a, b, c}) normals_[std::size_t(i)] += area;
    }
    mesh_.longest = std::sqrt(longest);
    for (Eigen::Vector3d& n : normals_)
      if (const double length = n.norm(); length > 0) n /= length;
  }
  // faces that all meet their mean at less than 20 degrees have one normal there
  void findEdges() {
    static const double half = std::cos(20 * std::numbers::pi / 180);
    atEdge_.assign(points_.size(), false);
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (const Index i : faces_[f])
        if (!(areas_[f].dot(normals_[std::size_t(i)]) >= half * lengths_[f])) atEdge_[std::size_t(i)] = true;
    if (std::find(atEdge_.begin(), atEdge_.end(), true) == atEdge_.end()) return;
    first_.assign(points_.size() + 1, 0);
    auto each = [&](auto&& act) {
      for (std::size_t f = 0; f < faces_.size(); ++f)
        for (const Index i : faces_[f])
          if (atEdge_[std::size_t(i)]) act(int(f), std::size_t(i));
    };
    each([&](int, std::size_t i) { ++first_[i + 1]; });
    for (std::size_t i = 0; i < points_.size(); ++i) first_[i + 1] += first_[i];
    around_.resize(std::size_t(first_.back()));
    std::vector<int> next(first_.begin(), first_.end() - 1);
    each([&](int f, std::size_t i) { around_[std::size_t(next[i]++)] = f; });
    cornerAt_.assign(points_.size(), none);
    next_.assign(seen_, none);
  }
  void addPoints() {
    mesh_.corners.reserve(seen_);
    mesh_.normals.reserve(seen_);
    mesh_.colours.reserve(seen_);
    for (std::size_t i = 0; i < seen_; ++i) mesh_.add(points_[i], normals_[i], colourOf_(i));
  }
  unsigned cornerOf(std::size_t face, std::size_t i) {
    static const double limit = std::cos(40 * std::numbers::pi / 180);
    const Eigen::Vector3d own =
        lengths_[face] > 0 ? Eigen::Vector3d(areas_[face] / lengths_[face]) : areas_[face];
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (int k = first_[i]; k < first_[i + 1]; ++k)
      if (const auto f = std::size_t(around_[std::size_t(k)]);
          lengths_[f] > 0 && areas_[f].dot(own) > limit * lengths_[f])
        normal += areas_[f];
    const double length = normal.norm();
    normal = length > 0 ? Eigen::Vector3d(normal / length) : own;
    for (unsigned c = cornerAt_[i]; c != none; c = next_[c])
      if (mesh_.normals[c] == normal.cast<float>()) return c;
    const unsigned before = cornerAt_[i];
    if (before == none) {
      mesh_.normals[i] = normal.cast<float>();
      return cornerAt_[i] = unsigned(i);
    }
    next_.push_back(before);
    return cornerAt_[i] = mesh_.add(points_[i], normal, colourOf_(i));
  }
};

/// Corners of triangles that are at several places of a texture become several; `numbers` are those of the
/// texcoords at each corner of each triangle.
inline void add_texcoords(std::vector<Eigen::Vector2d> const& texcoords, std::vector<Triangle> const& numbers,
                          ShadedMesh& mesh) {
  constexpr unsigned none = ~0u;
  constexpr Index unset = -2;
  std::vector<Index> numberOf(mesh.corners.size(), unset);
  std::vector<unsigned> next(mesh.corners.size(), none);  // the same corner at another place
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const Index wanted = numbers[k / 3][k % 3];
    unsigned c = mesh.triangles[k];
    if (numberOf[c] == unset) numberOf[c] = wanted;
    while (numberOf[c] != wanted && next[c] != none) c = next[c];
    if (numberOf[c] != wanted) {
      const unsigned added = mesh.addAgain(c);
      next[c] = added;
      numberOf.push_back(wanted);
      next.push_back(none);
      c = added;
    }
    mesh.triangles[k] = c;
  }
  mesh.texcoords.reserve(mesh.corners.size());
  for (const Index i : numberOf) {
    const Eigen::Vector2d at = i < 0 ? Eigen::Vector2d(0, 0) : texcoords[std::size_t(i)];
    mesh.texcoords.push_back({float(at[0]), float(at[1]), 0});
  }
}

}  // namespace detail

/// The mesh of a body that is seen again and again, with the edges of its elements where it is no visual
/// model. Where the body has values, a legend says what their colours are.
class ShadedBody {
 public:
  /// Of the last update; empty before the first.
  ShadedMesh const& mesh() const { return mesh_; }
  /// Brings the mesh up to date. False: it is that of the last time. In shadows the points that were in one
  /// cell of a grid when the elements were seen first are one [m].
  bool update(SeenBody const& body, std::optional<Legend> const& legend = {},
              SeenSettings const& settings = {}, double shadowCell = 0) {
    const bool valued = legend && body.values.size() == body.points.size();
    const Look look{.asLines = settings.wireframe || body.kind == SeenBody::Kind::collision,
                    .outlined = body.kind == SeenBody::Kind::state,
                    .normals = settings.normals,
                    .textured = body.texture && !valued,
                    .range = valued ? std::optional(std::pair(legend->low, legend->high)) : std::nullopt,
                    .colour = body.colour};
    const bool sameElements = look_ && look.asLines == look_->asLines && look.outlined == look_->outlined &&
                              body.triangles == seen_.triangles && body.quads == seen_.quads &&
                              body.edges == seen_.edges && body.beyond == seen_.beyond &&
                              body.inTexture == seen_.inTexture;
    if (sameElements && look == *look_ && body.points == seen_.points && body.values == seen_.values)
      return false;
    seen_ = body;
    look_ = look;
    if (!sameElements) {
      listElements();
      listCasters(shadowCell);
    }
    shade();
    return true;
  }

 private:
  // what the mesh depends on beside the body
  struct Look {
    bool asLines, outlined, normals, textured;
    std::optional<std::pair<double, double>> range;
    Eigen::Vector3d colour;
    bool operator==(Look const&) const = default;
  };
  SeenBody seen_{};
  std::optional<Look> look_{};
  std::vector<Triangle> faces_{}, inTexture_{};
  std::size_t own_ = 0;  // of the faces; the others lie beyond the border
  std::vector<Edge> edges_{};
  std::vector<unsigned> casters_{};
  ShadedMesh mesh_{};

  // each edge once
  void listElements() {
    auto triangulated = [](std::vector<Triangle> triangles, std::vector<Quad> const& quads) {
      for (auto const& [a, b, c, d] : quads)
        triangles.insert(triangles.end(), {Triangle{a, b, c}, Triangle{a, c, d}});
      return triangles;
    };
    faces_ = triangulated(seen_.triangles, seen_.quads);
    own_ = faces_.size();
    faces_.insert(faces_.end(), seen_.beyond.begin(), seen_.beyond.end());
    inTexture_ = triangulated(seen_.inTexture.triangles, seen_.inTexture.quads);
    edges_ = seen_.edges;
    auto outline = [&](auto const& face) {
      for (std::size_t k = 0; k < face.size(); ++k) {
        const Index i = face[k], j = face[(k + 1) % face.size()];
        edges_.push_back(i < j ? Edge{i, j} : Edge{j, i});
      }
    };
    if (look_->outlined || look_->asLines) {
      for (auto const& t : seen_.triangles) outline(t);
      for (auto const& q : seen_.quads) outline(q);
    }
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
  }
  // The faces between points of which those in one cell are one; points that are too far away for a cell, or
  // nowhere, are joined with none.
  void listCasters(double cell) {
    std::vector<unsigned> known(seen_.points.size());
    std::map<std::array<int, 3>, unsigned> cells;
    constexpr double most = 1e9;
    for (std::size_t i = 0; i < known.size(); ++i) {
      known[i] = unsigned(i);
      if (!(cell > 0)) continue;
      const Eigen::Array3d at = (seen_.points[i] / cell).array().floor();
      if ((at.abs() < most).all())
        known[i] = cells.try_emplace({int(at[0]), int(at[1]), int(at[2])}, known[i]).first->second;
    }
    casters_.clear();
    for (std::size_t f = 0; f < own_; ++f) {
      auto const& [a, b, c] = faces_[f];
      const unsigned i = known[std::size_t(a)], j = known[std::size_t(b)], k = known[std::size_t(c)];
      if (i != j && j != k && k != i) casters_.insert(casters_.end(), {i, j, k});
    }
  }
  void shade() {
    mesh_ = {};
    auto const [low, high] = look_->range.value_or(std::pair(0., 1.));
    const double least = low, span = high > low ? high - low : 1;
    auto colourOf = [&](std::size_t i) -> Eigen::Vector3d {
      return look_->range ? colour_of_value((seen_.values[i] - least) / span) : look_->colour;
    };
    const bool shaded = !look_->asLines && !faces_.empty();
    if (shaded) {
      detail::SmoothFaces faces(seen_.points, faces_, own_, colourOf, mesh_);
      if (look_->textured && inTexture_.size() == own_)
        detail::add_texcoords(seen_.inTexture.texcoords, faces.of(inTexture_), mesh_);
      mesh_.casters = casters_;
    }
    std::tie(mesh_.low, mesh_.high) = seen_.box();
    if (shaded && look_->normals) {
      const float length = float((mesh_.high - mesh_.low).norm() / 30);
      for (std::size_t i = 0; i < mesh_.corners.size(); ++i)
        for (const float along : {0.f, length}) {
          mesh_.lines.at.push_back(mesh_.corners[i] + along * mesh_.normals[i]);
          mesh_.lines.colours.push_back({0.2f, 0.2f, 0.2f});
        }
    }
    const double dark = shaded ? 0.4 : 1;
    for (Edge const& e : edges_)
      for (const Index i : e) mesh_.lines.add(seen_.points[std::size_t(i)], dark * colourOf(std::size_t(i)));
    if (faces_.empty() && edges_.empty())
      for (std::size_t i = 0; i < seen_.points.size(); ++i) mesh_.points.add(seen_.points[i], colourOf(i));
  }
};

/// The mesh of a body that is seen once.
inline ShadedMesh shaded_mesh(SeenBody const& body, std::optional<Legend> const& legend = {},
                              SeenSettings const& settings = {}) {
  ShadedBody shaded;
  shaded.update(body, legend, settings);
  return shaded.mesh();
}

}  // namespace sinew::view
