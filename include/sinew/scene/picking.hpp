// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/attachment.hpp>
#include <sinew/collision/ray_hits.hpp>
#include <sinew/core/error.hpp>
#include <sinew/scene/collision.hpp>
#include <sinew/scene/scope.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace sinew {

/// What a ray meets first.
struct Pick {
  std::string path{};   // of the node of the collision model
  int model = -1;       // its number among the collision models of the scene, in their order
  ContactSide place{};  // element, and the vertices with their weights
  Eigen::Vector3d point{0, 0, 0};
  double distance = 0;     // from the origin of the ray
  bool simulated = false;  // an ODE solver moves it, and forces on the model act on it
};

/// The spring by which a picked place is held.
struct AttachSettings {
  double stiffness = 1000, damping = 0;  // [N/m], [N s/m]
};

/// Rays against the collision models of a scene, and springs to the places that they meet. Behind it are
/// Simulation::pick, attach, pull and release.
template <class RootScope>
struct Picking {
  RootScope const& root;

  /// The nearest hit up to `maxDistance`: triangles and spheres where the ray meets them, lines and points
  /// where it passes within `tolerance` of them. Models that are not active are not seen.
  std::optional<Pick> pick(Eigen::Vector3d const& origin, Eigen::Vector3d const& direction,
                           double maxDistance, double tolerance) const {
    auto wrong = [](auto const&... what) { throw Error("Simulation::pick", text(what...)); };
    const double length = direction.norm();
    if (!all_finite(origin)) wrong("the origin of the ray is not finite");
    if (!(length > 0) || !std::isfinite(length))
      wrong("the direction of the ray has no length, or is not finite");
    if (!(maxDistance >= 0)) wrong("maxDistance is ", maxDistance, " m, but must be at least 0");
    if (!(tolerance >= 0) || !std::isfinite(tolerance))
      wrong("tolerance is ", tolerance, " m, but must be finite and at least 0");
    const Ray ray{origin, direction / length};
    std::optional<Pick> nearest;
    int number = 0;
    traverse(root, on<role::CollisionModel>([&](auto& model, auto const& scope) {
               using D = typename std::decay_t<decltype(model)>::DataTypes;
               auto const& state = scope.template state<D>();
               CollisionSurface& s = model.surface;
               const int mine = number++;
               if (!s.settings.active || s.size() == 0) return;
               update_vertices<D>(s, state.position, state.velocity);
               const auto found = nearestOf(ray, s, nearest ? nearest->distance : maxDistance, tolerance);
               if (!found.second || (nearest && found.second.distance >= nearest->distance)) return;
               nearest = Pick{.path = s.path, .model = mine};
               describe(*nearest, ray, s, found.first, found.second);
             }));
    return nearest;
  }

  /// Throws Error where the model has no such place (any more), or no force moves it.
  int attach(Pick const& pick, AttachSettings const& settings) const {
    auto wrong = [&](auto const&... what) {
      throw Error(text("Simulation::attach, ", pick.path.empty() ? "nothing" : pick.path), text(what...));
    };
    if (!(settings.stiffness > 0) || !std::isfinite(settings.stiffness))
      wrong("the stiffness is ", settings.stiffness, " N/m, but must be finite and greater than 0");
    if (!(settings.damping >= 0) || !std::isfinite(settings.damping))
      wrong("the damping is ", settings.damping, " N s/m, but must be finite and at least 0");
    if (pick.model < 0) wrong("nothing has been picked; pick before");
    Attachment a{.stiffness = settings.stiffness, .damping = settings.damping};
    traverse(root, on<role::ContactManager>([&](auto& manager, auto const&) {
               for (Attachment const& other : manager.attachments) a.id = std::max(a.id, other.id);
               a.id = std::max(a.id, manager.lastAttachment);
             }));
    ++a.id;
    int number = 0;
    bool known = false;
    traverse(root, on<role::CollisionModel>([&](auto& model, auto const& scope) {
               using D = typename std::decay_t<decltype(model)>::DataTypes;
               CollisionSurface& s = model.surface;
               if (number++ != pick.model || s.path != pick.path) return;
               for (int k = 0; k < pick.place.corners(); ++k) {
                 const int v = pick.place.vertices[std::size_t(k)];
                 if (v < 0 || std::size_t(v) >= s.position.size()) return;
               }
               known = true;
               if (!isSimulated(s))
                 wrong("no force moves this model: it is below no ODE solver, or simulated is false");
               auto const& state = scope.template state<D>();
               update_vertices<D>(s, state.position, state.velocity);
               a.contact.b = pick.place;
               a.target = pick.point;
               if (!s.rigid) a.offset = pick.point - position_of(pick.place, s);
               const std::pair<int, int> place = managerOf(s);
               a.contact.b.surface = place.second;
               int at = 0;
               traverse(root, on<role::ContactManager>([&](auto& manager, auto const&) {
                          if (at++ != place.first) return;
                          manager.attach(a);
                          manager.lastAttachment = a.id;
                        }));
             }));
    if (!known) wrong("this place is no longer there; pick again");
    return a.id;
  }

  /// The attachment with a number; null where it has been released, or what it held is gone.
  Attachment* find(int id) const {
    Attachment* found = nullptr;
    traverse(root, on<role::ContactManager>([&](auto& manager, auto const&) {
               if (!found) found = manager.attachment(id);
             }));
    return found;
  }
  bool pull(int id, Eigen::Vector3d const& target, Eigen::Vector3d const& velocity) const {
    if (!all_finite(target) || !all_finite(velocity))
      throw Error("Simulation::pull", "the target is not finite; the attachment stays as it was");
    Attachment* a = find(id);
    if (!a) return false;
    a->target = target;
    a->velocity = velocity;
    return true;
  }
  bool release(int id) const {
    bool held = false;
    traverse(root, on<role::ContactManager>([&](auto& manager, auto const&) {
               held = (manager.attachment(id) && manager.release(id)) || held;
             }));
    return held;
  }

 private:
  static bool isSimulated(CollisionSurface const& s) { return s.settings.simulated && s.solver >= 0; }

  // the element that is hit first, the lowest of several at one distance
  static std::pair<int, RayHit> nearestOf(Ray const& ray, CollisionSurface& s, double end, double tolerance) {
    // boxes are as wide as the rounding of a ray along their sides asks for
    double scale = ray.origin.cwiseAbs().maxCoeff();
    for (auto const& p : s.position) scale = std::max(scale, p.cwiseAbs().maxCoeff());
    s.enclose(tolerance + 1e-12 * scale, 0);
    std::pair<int, RayHit> best{-1, {}};
    s.tree.ray(ray.origin, ray.direction, end, [&](int e, double until) {
      const RayHit hit = hitOf(ray, s, e, until, tolerance);
      if (!(hit.distance <= until)) return until;
      if (hit.distance < best.second.distance || e < best.first) best = {e, hit};
      return hit.distance;
    });
    return best;
  }
  template <class Surface>
  static RayHit hitOf(Ray const& ray, Surface const& s, int e, double until, double tolerance) {
    switch (s.shape) {
      case Shape::hull:
        if constexpr (detail::shapes_below<RootScope>().has(Shape::hull))
          return HullRay<Surface>::of(ray, s, e, until);
        else
          return {};
      case Shape::point:
        return ray_point(ray, s.template corner<1>(s.position, e)[0], tolerance);
      case Shape::line:
        return ray_segment(ray, s.template corner<2>(s.position, e), tolerance);
      case Shape::triangle:
        return ray_triangle(ray, s.template corner<3>(s.position, e), s.elements[std::size_t(e)]);
      case Shape::sphere:
        return ray_sphere(ray, s.template corner<1>(s.position, e)[0], s.radiusOf(e));
      case Shape::capsule:
        return ray_capsule(ray, s.template corner<2>(s.position, e), s.radiusOf(e));
    }
    return {};
  }
  static void describe(Pick& pick, Ray const& ray, CollisionSurface const& s, int element,
                       RayHit const& hit) {
    ContactSide& side = pick.place;
    side.element = element;
    int n = 0;
    for (int c = 0; c < std::max(1, s.corners()); ++c)
      if (hit.weights[std::size_t(c)] > 0) {
        side.vertices[std::size_t(n)] = s.elements[std::size_t(element)][std::size_t(c)];
        side.weights[std::size_t(n++)] = hit.weights[std::size_t(c)];
      }
    pick.simulated = isSimulated(s);
    pick.distance = hit.distance;
    pick.point = ray.at(hit.distance);
    // of a model without a surface, the place itself
    const Eigen::Vector3d place = position_of(side, s);
    if (s.shape == Shape::line || s.shape == Shape::point) pick.point = place;
    if (s.rigid) side.lever = s.orientation[std::size_t(side.vertices[0])].conjugate() * (pick.point - place);
  }
  // the number of the manager that has a model, of several the innermost one, and that of the model in it
  std::pair<int, int> managerOf(CollisionSurface const& wanted) const {
    std::pair<int, int> found{-1, -1};
    int manager = 0;
    traverse(root, on<role::ContactManager>([&](auto&, auto const& scope) {
               int number = 0;
               with_collision_scope(scope, root, [&](auto const& models) {
                 traverse(models, on<role::CollisionModel>([&](auto& model, auto const&) {
                            if (&model.surface == &wanted) found = {manager, number};
                            ++number;
                          }));
               });
               ++manager;
             }));
    return found;
  }
};

}  // namespace sinew
