// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_surface.hpp>
#include <sinew/collision/ray_hits.hpp>
#include <sinew/core/context.hpp>
#include <sinew/core/roles/collision_model.hpp>
#include <sinew/core/roles/projective_constraint.hpp>
#include <sinew/core/roles/state.hpp>
#include <sinew/core/roles/visual_model.hpp>
#include <sinew/scene/force_report.hpp>
#include <sinew/scene/path.hpp>
#include <sinew/scene/states_of.hpp>
#include <sinew/topology/border.hpp>
#include <sinew/view/hull_faces.hpp>
#include <sinew/view/seen_body.hpp>
#include <sinew/view/seen_settings.hpp>
#include <sinew/view/seen_values.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew::view {

/// Colours that people who see colours differently can tell apart (Okabe, Ito 2008), red, green, blue.
inline constexpr std::array<std::array<double, 3>, 7> palette{{{0.84, 0.37, 0.0},
                                                               {0.0, 0.45, 0.70},
                                                               {0.0, 0.62, 0.45},
                                                               {0.80, 0.47, 0.65},
                                                               {0.90, 0.62, 0.0},
                                                               {0.34, 0.71, 0.91},
                                                               {0.94, 0.89, 0.26}}};

/// A vector at a place.
struct SeenArrow {
  ArrowKind kind = ArrowKind::velocity;
  Eigen::Vector3d from{0, 0, 0}, vector{0, 0, 0};  // [m], and [m/s] or [N]
};

/// A box by which collisions are found: level 0 is around a model, the highest level around its elements.
struct SeenBox {
  Eigen::Vector3d low{0, 0, 0}, high{0, 0, 0};  // corners [m]
  int level = 0;
};

/// What colours mean.
struct Legend {
  std::string title{}, unit{};
  double low = 0, high = 1;
};

/// What a camera sees of a scene, as it is at one time: all visual models, and of states without one in
/// their node or below the surface of the elements, which a mapped state shows only where it has elements of
/// its own; and what settings ask for beside these.
struct SeenScene {
  std::vector<SeenBody> bodies{};
  std::vector<SeenArrow> arrows{};
  std::vector<SeenLine> springs{};
  std::vector<Eigen::Vector3d> constrained{};  // points that are held
  std::vector<SeenBox> boxes{};                // of collision models
  std::optional<Legend> legend{};
  SeenSettings settings{};
  Eigen::Vector3d up{0, 1, 0};  // against gravity
  double time = 0;              // [s]
  long step = 0;

  /// The corners of the smallest box around everything that is finite; equal where nothing is seen.
  std::pair<Eigen::Vector3d, Eigen::Vector3d> box() const {
    constexpr double most = std::numeric_limits<double>::infinity();
    Eigen::Vector3d low = Eigen::Vector3d::Constant(most), high = -low;
    for (SeenBody const& body : bodies) {
      auto const [least, greatest] = body.box();
      low = low.cwiseMin(least), high = high.cwiseMax(greatest);
    }
    if (!(low.array() <= high.array()).all()) low = high = Eigen::Vector3d::Zero();
    return {low, high};
  }
};

/// The surfaces of volume elements that were seen before, found once for the same elements.
class KnownBorders {
 public:
  Border const& of(TopologyView const& topology) {
    // FNV-1a of all corners
    std::uint64_t key = 14695981039346656037u;
    auto add = [&](auto const& elements) {
      for (auto const& element : elements)
        for (const Index i : element) key = (key ^ std::uint64_t(i)) * 1099511628211u;
      key = (key ^ elements.size()) * 1099511628211u;
    };
    for_each_kind(topology, [&](int kind, auto const& elements) {
      if (dimension_of_kind(kind) == 3) add(elements);
    });
    constexpr std::size_t enough = 256;  // of a body that is carved, those of long ago go
    if (known_.size() >= enough && !known_.count(key)) known_.clear();
    const auto [found, isNew] = known_.try_emplace(key);
    if (isNew) found->second = border_of(topology);
    return found->second;
  }
  /// The faces of the convex hull of points.
  std::vector<Triangle> const& ofHull(std::vector<Eigen::Vector3d> const& points) {
    std::vector<double> key;
    for (Eigen::Vector3d const& p : points) key.insert(key.end(), {p[0], p[1], p[2]});
    const auto [found, isNew] = hulls_.try_emplace(std::move(key));
    if (isNew) found->second = HullFaces(points).triangles();
    return found->second;
  }

 private:
  std::map<std::uint64_t, Border> known_{};
  std::map<std::vector<double>, std::vector<Triangle>> hulls_{};  // hulls do not change while a scene runs
};

namespace detail {

template <class T>
std::vector<T> listed(std::span<T const> elements) {
  return {elements.begin(), elements.end()};
}
inline void show_elements(TopologyView const& topology, KnownBorders& borders, SeenBody& body) {
  if (dimension_of(topology) == 3) {
    Border const& border = borders.of(topology);
    body.triangles = border.triangles;
    body.quads = border.quads;
    return;
  }
  body.triangles = listed(topology.triangles);
  body.quads = listed(topology.quads);
  if (body.triangles.empty() && body.quads.empty()) body.edges = listed(topology.edges);
}
template <class State>
Eigen::Vector3d seen_place(State const& state, std::size_t i) {
  using D = typename State::DataTypes;
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  x.head<D::spatial>() = D::center(state.position[i]).template cast<double>();
  return x;
}

// what is within a radius of a segment: a ball, or halves of one at both ends and a tube between them; the
// ball is an octahedron, each of whose faces is divided in 16
inline void add_capsule(Eigen::Vector3d const& start, Eigen::Vector3d const& end, double radius,
                        SeenBody& body) {
  constexpr int n = 4;
  const bool hasTube = start != end;
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
  if (hasTube)
    frame = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), end - start).toRotationMatrix();
  for (int face = 0; face < 8; ++face) {
    const Eigen::Vector3d x(face & 1 ? -1 : 1, 0, 0), y(0, face & 2 ? -1 : 1, 0), z(0, 0, face & 4 ? -1 : 1);
    const bool turned = (face & 1) ^ (face >> 1 & 1) ^ (face >> 2 & 1);
    const auto first = Index(body.points.size());
    auto at = [&](int i, int j) { return first + Index(i * (i + 1) / 2 + j); };
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= i; ++j)
        body.points.push_back(
            (face & 4 ? start : end) +
            radius * (frame * (double(n - i) * x + double(i - j) * y + double(j) * z).normalized()));
    auto add = [&](Index a, Index b, Index c) {
      if (turned) std::swap(b, c);
      body.triangles.push_back({a, b, c});
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i; ++j) {
        add(at(i, j), at(i + 1, j), at(i + 1, j + 1));
        if (j < i) add(at(i, j), at(i + 1, j + 1), at(i, j + 1));
      }
    if (!hasTube || face & 4) continue;
    const auto ring = Index(body.points.size());
    for (int i = 0; i <= n; ++i)
      for (auto const& p : {start, end})
        body.points.push_back(p + radius * (frame * (double(n - i) * x + double(i) * y).normalized()));
    for (Index i = ring; i < ring + 2 * n; i += 2) {
      add(i, i + 2, i + 3);
      add(i, i + 3, i + 1);
    }
  }
}

// the primitives of a collision model where its state is now
template <class Model, class State>
void show_collision(Model const& model, State const& state, KnownBorders& borders, SeenBody& body) {
  CollisionSurface const& surface = model.surface;
  if (surface.shape == Shape::hull) {  // its corners where it has faces; flat ones by all of their points
    using D = typename State::DataTypes;
    if constexpr (D::rigid && D::spatial == 3)
      for (std::size_t e = 0; e < surface.size(); ++e) {
        auto const& x = state.position[std::size_t(surface.elements[e][0])];
        auto const& points = surface.hullOf(int(e)).points();
        auto place = [&](Eigen::Vector3d const& p) -> Eigen::Vector3d {
          return x.center.template cast<double>() + x.orientation.template cast<double>() * p;
        };
        if (const double radius = surface.radiusOf(int(e)); radius > 0) {
          add_capsule(place(points.front()), place(points.back()), radius, body);
          continue;
        }
        const auto first = Index(body.points.size());
        for (auto const& p : points) body.points.push_back(place(p));
        for (auto const& [a, b, c] : borders.ofHull(points))
          body.triangles.push_back({first + a, first + b, first + c});
      }
    return;
  }
  if (!surface.radius.empty()) {
    for (std::size_t e = 0; e < surface.size() && e < surface.radius.size(); ++e) {
      auto const& ends = surface.elements[e];
      const auto i = std::size_t(ends[0]), j = std::size_t(ends[1] < 0 ? ends[0] : ends[1]);
      if (std::max(i, j) < state.size())
        add_capsule(seen_place(state, i), seen_place(state, j), surface.radius[e], body);
    }
    return;
  }
  for (std::size_t i = 0; i < state.size(); ++i) body.points.push_back(seen_place(state, i));
  for (auto const& [a, b, c] : surface.elements)
    if (c >= 0)
      body.triangles.push_back({a, b, c});
    else if (b >= 0)
      body.edges.push_back({a, b});
  if (surface.shape == Shape::point) {
    std::vector<Eigen::Vector3d> own;
    for (auto const& element : surface.elements) own.push_back(body.points[std::size_t(element[0])]);
    body.points = std::move(own);
  }
}

// The boxes of a model as they were in the last search: the outermost one, those of the tree in it, and those
// of the elements.
inline void show_boxes(CollisionSurface const& surface, SeenScene& seen) {
  std::optional<int> const& wanted = seen.settings.boxLevel;
  auto add = [&](auto const& box, int level) {
    if (box.empty() || !box.min.allFinite() || !box.max.allFinite() || (wanted && *wanted != level)) return;
    seen.boxes.push_back({box.min.template cast<double>(), box.max.template cast<double>(), level});
  };
  int deepest = 0;
  add(surface.box, 0);
  surface.tree.each_box([&](auto const& box, int level) {
    if (level > 0) add(box, level);
    deepest = std::max(deepest, level);
  });
  if (surface.boxes.size() > 1)
    for (AxisBox const& box : surface.boxes) add(box, deepest + 1);
}

template <class Simulation>
void show_arrows(Simulation& simulation, SeenScene& seen) {
  SeenSettings const& wanted = seen.settings;
  auto add = [&](ArrowKind kind, Eigen::Vector3d const& from, Eigen::Vector3d const& vector) {
    if (from.allFinite() && vector.allFinite() && !vector.isZero(0))
      seen.arrows.push_back({kind, from, vector});
  };
  if (wanted.shows(ArrowKind::velocity) || wanted.shows(ArrowKind::force))
    simulation.template visit<role::State>([&](auto const& state, auto const& scope) {
      using D = typename std::decay_t<decltype(state)>::DataTypes;
      if (scope.mapped()) return;
      for (std::size_t i = 0; i < state.size(); ++i) {
        auto linear = [](auto const& v) {
          Eigen::Vector3d w = Eigen::Vector3d::Zero();
          w.head<D::spatial>() = v.template head<D::spatial>().template cast<double>();
          return w;
        };
        if (wanted.shows(ArrowKind::velocity))
          add(ArrowKind::velocity, seen_place(state, i), linear(state.velocity[i]));
        if (wanted.shows(ArrowKind::force) && state.applied.size() == state.size() &&
            state.reaction.size() == state.size())
          add(ArrowKind::force,
              seen_place(state, i),
              linear(typename D::Deriv(state.applied[i] + state.reaction[i])));
      }
    });
  if (wanted.shows(ArrowKind::reaction) || wanted.shows(ArrowKind::contact) ||
      wanted.shows(ArrowKind::attachment))
    for (ForceOnBody const& f : simulation.forces()) {
      const ArrowKind kind = f.kind == ForceKind::contact      ? ArrowKind::contact
                             : f.kind == ForceKind::attachment ? ArrowKind::attachment
                             : f.kind == ForceKind::reaction   ? ArrowKind::reaction
                                                               : ArrowKind::force;
      if (kind != ArrowKind::force && wanted.shows(kind)) add(kind, f.point, f.wrench.force);
    }
}

template <class Simulation>
void show_constrained(Simulation& simulation, SeenScene& seen) {
  simulation.template visit<role::ProjectiveConstraint>([&](auto const& c, auto const& scope) {
    with_states_of(c, scope, [&](auto const& state, auto const&...) {
      auto add = [&](auto const& points) {
        for (const int i : points)
          if (i >= 0 && std::size_t(i) < state.size())
            seen.constrained.push_back(seen_place(state, std::size_t(i)));
      };
      if constexpr (requires { c.held.begin(); })
        add(c.held);
      else if constexpr (requires { c.indices.begin(); })
        add(c.indices);
      else if constexpr (requires { c.indices1.begin(); })
        add(c.indices1);
    });
  });
}

// the range of the values that are seen, where none is asked for
inline void set_legend(SeenScene& seen) {
  SeenSettings const& wanted = seen.settings;
  if (wanted.colour == Quantity::none) return;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  auto take = [&](double value) {
    if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  };
  for (SeenBody const& body : seen.bodies)
    if (body.visible) std::for_each(body.values.begin(), body.values.end(), take);
  if (wanted.colour == Quantity::stretch)
    for (SeenLine const& line : seen.springs) take(line.value);
  if (!(low <= high)) low = high = 0;
  if (wanted.range) std::tie(low, high) = *wanted.range;
  const QuantityWords words = words_of(wanted.colour);
  seen.legend = Legend{std::string(words.title), std::string(words.unit), low, high};
}

}  // namespace detail

/// What is seen of a simulation now. Its visual models are brought up to date. Forces and reactions are those
/// that it keeps (Simulation::keepForces). Whoever looks again and again keeps the borders.
template <class Simulation>
SeenScene seen_scene(Simulation& simulation, SeenSettings const& settings = {},
                     KnownBorders* borders = nullptr) {
  KnownBorders own;
  if (!borders) borders = &own;
  simulation.updateVisual();
  SeenScene seen;
  seen.settings = settings;
  seen.time = simulation.time();
  seen.step = simulation.step();
  const SeenValues<Simulation> values(simulation, settings.colour);
  if (settings.visualModels)
    simulation.template visit<role::VisualModel>([&](auto const& visual, auto const& scope) {
      SeenBody body{.path = scope.path(), .kind = SeenBody::Kind::visual};
      Mesh mesh = visual.current();
      body.points = std::move(mesh.positions);
      body.triangles = std::move(mesh.triangles);
      body.quads = std::move(mesh.quads);
      if (body.triangles.empty() && body.quads.empty()) body.edges = std::move(mesh.edges);
      body.values = values.of(&visual);
      SurfaceLooks looks;
      if constexpr (requires { visual.looks(); })
        if (visual.wrongLooks().empty()) looks = visual.looks();  // fields may have other values by now
      for (SeenBody& one : bodies_by_material(std::move(body), std::move(looks), settings.materials))
        seen.bodies.push_back(std::move(one));
    });
  if (settings.visualModels)
    simulation.template visit<role::BehaviorModel>([&](auto const& model, auto const& scope) {
      if (Eigen::Vector3d const g = scope.gravity(); g.norm() > 0) seen.up = -g.normalized();
      if constexpr (HasBorder<std::decay_t<decltype(model)>>) {
        Mesh mesh = model.border();
        seen.bodies.push_back({.path = scope.path(),
                               .kind = SeenBody::Kind::visual,
                               .points = std::move(mesh.positions),
                               .triangles = std::move(mesh.triangles),
                               .quads = std::move(mesh.quads),
                               .edges = std::move(mesh.edges)});
      }
    });
  std::vector<SeenBody> states;
  simulation.template visit<role::State>([&](auto const& state, auto const& scope) {
    SeenBody body{.path = scope.path()};
    if (Eigen::Vector3d const g = scope.gravity(); g.norm() > 0) seen.up = -g.normalized();
    if (!settings.states && std::any_of(seen.bodies.begin(), seen.bodies.end(), [&](SeenBody const& visual) {
          return is_below(visual.path, body.path);
        }))
      return;
    detail::show_elements(scope.topology(), *borders, body);
    const bool hasElements = !body.triangles.empty() || !body.quads.empty() || !body.edges.empty();
    if (scope.mapped() && !hasElements) return;
    for (std::size_t i = 0; i < state.size(); ++i) body.points.push_back(detail::seen_place(state, i));
    body.values = values.of(&state);
    states.push_back(std::move(body));
  });
  // from the deepest on: a node hides those above it
  std::stable_sort(states.begin(), states.end(), [](SeenBody const& a, SeenBody const& b) {
    return a.path.size() > b.path.size();
  });
  for (SeenBody& state : states)
    if (settings.states || std::none_of(seen.bodies.begin(), seen.bodies.end(), [&](SeenBody const& other) {
          return is_below(other.path, state.path);
        }))
      seen.bodies.push_back(std::move(state));
  if (settings.collisionModels)
    simulation.template visit<role::CollisionModel>([&](auto const& model, auto const& scope) {
      SeenBody body{.path = scope.path(), .kind = SeenBody::Kind::collision};
      detail::show_collision(
          model, scope.template state<typename std::decay_t<decltype(model)>::DataTypes>(), *borders, body);
      seen.bodies.push_back(std::move(body));
    });
  if (settings.boxes)
    simulation.template visit<role::CollisionModel>(
        [&](auto const& model, auto const&) { detail::show_boxes(model.surface, seen); });
  std::stable_sort(seen.bodies.begin(), seen.bodies.end(), [](SeenBody const& a, SeenBody const& b) {
    return a.path < b.path;
  });
  for (std::size_t i = 0; i < seen.bodies.size(); ++i) {
    SeenBody& body = seen.bodies[i];
    if (!body.ofMaterial) body.colour = Eigen::Vector3d(palette[i % palette.size()].data());
    if (body.kind == SeenBody::Kind::collision) body.colour = {0.25, 0.25, 0.25};
    for (BodyLook const& look : settings.looks)
      if (look.path == body.path && body.kind != SeenBody::Kind::collision) {
        body.visible = look.visible;
        if (look.texture) body.texture = look.texture;
        if (look.texture && !body.ofMaterial) body.colour.setOnes();
        if (look.colour) body.colour = *look.colour;
        if (look.opacity) body.opacity = *look.opacity;
      }
    if (body.inTexture.texcoords.empty()) body.texture.reset();
  }
  if (settings.springs || settings.colour == Quantity::stretch) seen.springs = seen_springs(simulation);
  if (settings.constraints) detail::show_constrained(simulation, seen);
  detail::show_arrows(simulation, seen);
  detail::set_legend(seen);
  return seen;
}

/// Whether a ray meets a face of a scene; the direction has length 1.
inline bool meets(SeenScene const& scene, Eigen::Vector3d const& origin, Eigen::Vector3d const& direction) {
  for (SeenBody const& body : scene.bodies) {
    if (!body.visible) continue;
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
