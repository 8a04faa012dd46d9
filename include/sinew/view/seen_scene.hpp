// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/ray_hits.hpp>
#include <sinew/core/context.hpp>
#include <sinew/core/roles/state.hpp>
#include <sinew/core/roles/visual_model.hpp>
#include <sinew/scene/path.hpp>
#include <sinew/topology/border.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew::view {

/// What is seen of a node: surfaces, or where there are none lines, or points.
struct SeenBody {
  std::string path{};
  bool visual = false;  // a visual model; otherwise a state, whose elements are seen
  std::vector<Eigen::Vector3d> points{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  std::vector<Edge> edges{};
};

/// What a camera sees of a scene, as it is at one time: all visual models, and of states without one in
/// their node or below the surface of the elements, which a mapped state shows only where it has elements of
/// its own.
struct SeenScene {
  std::vector<SeenBody> bodies{};
  Eigen::Vector3d up{0, 1, 0};  // against gravity
  double time = 0;              // [s]
  long step = 0;

  /// The corners of the smallest box around everything that is finite; equal where nothing is seen.
  std::pair<Eigen::Vector3d, Eigen::Vector3d> box() const {
    constexpr double most = std::numeric_limits<double>::infinity();
    Eigen::Vector3d low = Eigen::Vector3d::Constant(most), high = -low;
    for (SeenBody const& body : bodies)
      for (Eigen::Vector3d const& p : body.points)
        if (p.allFinite()) low = low.cwiseMin(p), high = high.cwiseMax(p);
    if (!(low.array() <= high.array()).all()) low = high = Eigen::Vector3d::Zero();
    return {low, high};
  }
};

namespace detail {

template <class T>
std::vector<T> listed(std::span<T const> elements) {
  return {elements.begin(), elements.end()};
}
inline void show_elements(TopologyView const& topology, SeenBody& body) {
  if (!topology.tetrahedra.empty() || !topology.hexahedra.empty()) {
    Border border = border_of(topology.tetrahedra, topology.hexahedra);
    body.triangles = std::move(border.triangles);
    body.quads = std::move(border.quads);
    return;
  }
  body.triangles = listed(topology.triangles);
  body.quads = listed(topology.quads);
  if (body.triangles.empty() && body.quads.empty()) body.edges = listed(topology.edges);
}

}  // namespace detail

/// What is seen of a simulation now. Its visual models are brought up to date.
template <class Simulation>
SeenScene seen_scene(Simulation& simulation) {
  simulation.updateVisual();
  SeenScene seen;
  seen.time = simulation.time();
  seen.step = simulation.step();
  simulation.template visit<role::VisualModel>([&](auto const& visual, auto const& scope) {
    SeenBody body{.path = scope.path(), .visual = true};
    Mesh mesh = visual.current();
    body.points = std::move(mesh.positions);
    body.triangles = std::move(mesh.triangles);
    body.quads = std::move(mesh.quads);
    if (body.triangles.empty() && body.quads.empty()) body.edges = std::move(mesh.edges);
    seen.bodies.push_back(std::move(body));
  });
  std::vector<SeenBody> states;
  simulation.template visit<role::State>([&](auto const& state, auto const& scope) {
    using D = typename std::decay_t<decltype(state)>::DataTypes;
    SeenBody body{.path = scope.path()};
    if (Eigen::Vector3d const g = scope.gravity(); g.norm() > 0) seen.up = -g.normalized();
    detail::show_elements(scope.topology(), body);
    const bool hasElements = !body.triangles.empty() || !body.quads.empty() || !body.edges.empty();
    if (scope.mapped() && !hasElements) return;
    for (std::size_t i = 0; i < state.size(); ++i) {
      Eigen::Vector3d x = Eigen::Vector3d::Zero();
      x.head<D::spatial>() = D::center(state.position[i]).template cast<double>();
      body.points.push_back(x);
    }
    states.push_back(std::move(body));
  });
  // from the deepest on: a node hides those above it
  std::stable_sort(states.begin(), states.end(), [](SeenBody const& a, SeenBody const& b) {
    return a.path.size() > b.path.size();
  });
  for (SeenBody& state : states)
    if (std::none_of(seen.bodies.begin(), seen.bodies.end(), [&](SeenBody const& other) {
          return is_below(other.path, state.path);
        }))
      seen.bodies.push_back(std::move(state));
  std::stable_sort(seen.bodies.begin(), seen.bodies.end(), [](SeenBody const& a, SeenBody const& b) {
    return a.path < b.path;
  });
  return seen;
}

/// Whether a ray meets a face of a scene; the direction has length 1.
inline bool meets(SeenScene const& scene, Eigen::Vector3d const& origin, Eigen::Vector3d const& direction) {
  for (SeenBody const& body : scene.bodies) {
    auto hit = [&](Triangle const& t) {
      auto at = [&](int k) -> Eigen::Vector3d const& { return body.points[std::size_t(t[std::size_t(k)])]; };
      return bool(ray_triangle({origin, direction}, {at(0), at(1), at(2)}, t));
    };
    for (Triangle const& t : body.triangles)
      if (hit(t)) return true;
    for (auto const& [a, b, c, d] : body.quads)
      if (hit({a, b, c}) || hit({a, c, d})) return true;
  }
  return false;
}

}  // namespace sinew::view
