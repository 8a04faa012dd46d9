// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/contact.hpp>
#include <sinew/core/data_types.hpp>
#include <sinew/core/error.hpp>
#include <sinew/core/wrench.hpp>
#include <sinew/scene/collision_models.hpp>
#include <sinew/scene/scope.hpp>

#include <Eigen/Geometry>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace sinew {

/// What a force on a body is of: what touches it, what holds it by an attachment, constraints of a point of
/// its state, or all together on a rigid body.
enum class ForceKind { contact, attachment, reaction, net };
inline constexpr std::array<std::string_view, 4> enum_names(ForceKind) {
  return {"contact", "attachment", "reaction", "net"};
}

/// A force on a body over the last step: impulse over dt.
struct ForceOnBody {
  ForceKind kind;
  std::string body, other{};        // paths of their nodes; nothing where there is no other
  int index = -1;                   // element of the collision model, or point of the state
  Eigen::Vector3d point{0, 0, 0};   // where it acts [m]
  Eigen::Vector3d normal{0, 0, 0};  // of a contact: towards the body, of length 1
  Wrench wrench{};                  // on the body; the torque about `point`
};

namespace detail {

/// Force and torque of a derivative of D; there is no torque on points.
template <class D>
Wrench wrench_of(typename D::Deriv const& f) {
  Wrench w;
  w.force.template head<D::spatial>() = f.template head<D::spatial>().template cast<double>();
  if constexpr (D::rigid)
    w.torque.template tail<D::size - D::spatial>() =
        f.template tail<D::size - D::spatial>().template cast<double>();
  return w;
}
template <class D>
Eigen::Vector3d place_of(typename D::Coord const& x) {
  Eigen::Vector3d p(0, 0, 0);
  p.template head<D::spatial>() = D::center(x).template cast<double>();
  return p;
}

// the sum of what `of(i)` says of points, all where none are given, about a place
template <class State, class F>
Wrench sum_of_forces(State const& state, std::span<int const> points, Eigen::Vector3d const& about, F&& of) {
  using D = typename State::DataTypes;
  if (state.applied.size() != state.position.size())
    throw Error(component_name<State>(),
                "no forces were kept; call Simulation::keepForces(true), and animate(dt) after it");
  Wrench sum;
  auto add = [&](std::size_t i) {
    const Wrench w = of(i);
    sum.force += w.force;
    sum.torque += w.torque + (place_of<D>(state.position[i]) - about).cross(w.force);
  };
  for (const int i : points) {
    if (i < 0 || std::size_t(i) >= state.position.size())
      throw Error(component_name<State>(),
                  text("there is no point ", i, "; it has ", state.position.size(), ", numbered from 0"));
    add(std::size_t(i));
  }
  if (points.empty())
    for (std::size_t i = 0; i < state.position.size(); ++i) add(i);
  return sum;
}

}  // namespace detail

/// What constraints did to points of a state, all where none are given, over the last step; the torque about
/// a place in the world. Throws Error where forces are not kept.
template <class State>
Wrench reaction_force(State const& state, std::span<int const> points = {},
                      Eigen::Vector3d const& about = Eigen::Vector3d::Zero()) {
  using D = typename State::DataTypes;
  return detail::sum_of_forces(
      state, points, about, [&](std::size_t i) { return detail::wrench_of<D>(state.reaction[i]); });
}
/// All that acted on them, reactions included; forces between the points have no part in the sum. On a rigid
/// body that rotates the torque includes the gyroscopic one.
template <class State>
Wrench net_force(State const& state, std::span<int const> points = {},
                 Eigen::Vector3d const& about = Eigen::Vector3d::Zero()) {
  using D = typename State::DataTypes;
  return detail::sum_of_forces(state, points, about, [&](std::size_t i) {
    return detail::wrench_of<D>(typename D::Deriv(state.applied[i] + state.reaction[i]));
  });
}

/// The forces on the bodies of a scene over its last step, those of zero left out.
template <class RootScope>
struct ForceReport {
  RootScope const& root;

  std::vector<ForceOnBody> list() const {
    std::vector<ForceOnBody> all;
    traverse(root, on<role::ContactManager>([&](auto& manager, auto const& scope) {
               Surfaces surfaces;
               with_collision_scope(scope, root, [&](auto const& models) {
                 traverse(models, on<role::CollisionModel>([&](auto const& model, auto const&) {
                            surfaces.push_back(&model.surface);
                          }));
               });
               for (Contact const& c : manager.contacts) addContact(all, surfaces, c);
               for (auto const& a : manager.attachments) addAttachment(all, surfaces, a);
             }));
    traverse(root, on<role::State>([&](auto& state, auto const& scope) {
               if (!scope.mapped() && state.reaction.size() == state.position.size())
                 addState(all, state, scope.path());
             }));
    return all;
  }

 private:
  // (of the scene that is asked: those of the manager may be of one that this is a copy of)
  using Surfaces = std::vector<CollisionSurface const*>;

  static void addContact(std::vector<ForceOnBody>& all, Surfaces const& surfaces, Contact const& c) {
    if (c.force.isZero(0)) return;
    for (const bool second : {false, true}) {
      ContactSide const &side = second ? c.b : c.a, &otherSide = second ? c.a : c.b;
      CollisionSurface const& body = *surfaces[std::size_t(side.surface)];
      const double sign = second ? 1 : -1;
      all.push_back({.kind = ForceKind::contact,
                     .body = body.path,
                     .other = surfaces[std::size_t(otherSide.surface)]->path,
                     .index = side.element,
                     .point = position_of(side, body),
                     .normal = sign * c.normal,
                     .wrench = {.force = sign * c.force}});
    }
  }
  template <class Attached>
  static void addAttachment(std::vector<ForceOnBody>& all, Surfaces const& surfaces, Attached const& a) {
    ContactSide const& side = a.contact.b;
    CollisionSurface const& body = *surfaces[std::size_t(side.surface)];
    if (!a.contact.force.isZero(0))
      all.push_back({.kind = ForceKind::attachment,
                     .body = body.path,
                     .index = side.element,
                     .point = position_of(side, body) + a.offset,
                     .wrench = {.force = a.contact.force}});
  }
  template <class State>
  static void addState(std::vector<ForceOnBody>& all, State const& state, std::string const& path) {
    using D = typename State::DataTypes;
    auto add = [&](ForceKind kind, std::size_t i, typename D::Deriv const& f) {
      if (!f.isZero(0))
        all.push_back({.kind = kind,
                       .body = path,
                       .index = int(i),
                       .point = detail::place_of<D>(state.position[i]),
                       .wrench = detail::wrench_of<D>(f)});
    };
    for (std::size_t i = 0; i < state.position.size(); ++i) {
      add(ForceKind::reaction, i, state.reaction[i]);
      if constexpr (D::rigid) add(ForceKind::net, i, state.applied[i] + state.reaction[i]);
    }
  }
};

}  // namespace sinew
