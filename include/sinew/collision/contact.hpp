// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_surface.hpp>
#include <sinew/collision/contact_key.hpp>
#include <sinew/core/fields.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <concepts>
#include <span>
#include <string_view>
#include <vector>

namespace sinew {

/// A place on a surface: on the primitive over up to three vertices, with their weights; on a rigid also away
/// from its centre.
struct ContactSide {
  int surface = -1, element = -1;
  std::array<int, 3> vertices{-1, -1, -1};  // those of weight 0 are left out
  std::array<double, 3> weights{0, 0, 0};
  Eigen::Vector3d lever{0, 0, 0};  // from the centre of the rigid, in its axes
  Feature feature{};               // of a hull; what touches of a simplex, its vertices say

  static constexpr auto fields() {
    using S = ContactSide;
    return field_list(field("surface", &S::surface, "", "model, in the order of the scene"),
                      field("element", &S::element, "", "primitive of it"),
                      field("vertices", &S::vertices, "", "its vertices, -1 behind the last"),
                      field("weights", &S::weights, "", "of the vertices"),
                      field("lever", &S::lever, "m", "from the centre of a rigid, in its axes"),
                      field("feature", &S::feature, "", "of a hull"));
  }
  SINEW_HD int corners() const { return 3 - int(vertices[1] < 0) - int(vertices[2] < 0); }
};

/// What friction, or sticking, remembers of a contact from step to step.
struct FrictionState {
  /// At the end of the last step: apart, nothing holds the two together; sticks, the slip is held against;
  /// slides, the force is on the cone of Coulomb.
  enum class Mode { apart, sticks, slides };
  Mode mode = Mode::apart;
  int impact = 0;                 // steps for which an impact still goes on
  Eigen::Vector3d slip{0, 0, 0};  // displacement since it sticks [m]

  /// Neither in its first step nor in an impact.
  bool isSteady() const { return mode != Mode::apart && impact == 0; }
  static constexpr auto fields() {
    using S = FrictionState;
    return field_list(field("mode", &S::mode, "", "at the end of the last step"),
                      field("impact", &S::impact, "", "steps for which an impact still goes on"),
                      field("slip", &S::slip, "m", "displacement since it sticks"));
  }
};
constexpr std::array<std::string_view, 3> enum_names(FrictionState::Mode) {
  return {"apart", "sticks", "slides"};
}

/// How the two places of a contact move against each other over a step without multipliers, as u = p_b - p_a.
struct ContactMotion {
  Eigen::Vector3d start{0, 0, 0}, free{0, 0, 0};  // at the start of the step, and at its end [m]
  Eigen::Vector3d rate{0, 0, 0};                  // at its end [m/s]
  double dt = 0;
};

/// Two places near each other. All is measured along u = p_b - p_a.
struct Contact {
  ContactSide a{}, b{};
  Eigen::Vector3d normal{0, 0, 0};  // from a to b, of length 1
  double thickness = 0;             // radii of the two: the surfaces are n.u - thickness apart
  double limit = 0;                 // the response acts below this distance
  double distance = 0;              // at detection

  // of the two models together
  double stiffness = 0, friction = 0, damping = 0;
  int response = 0;       // place among the responses of the manager
  int solver = -1;        // the ODE solver that sees it as part of its system
  bool loose = false;     // between two solvers: for both a force that stays as it is during the step
  bool implicit = false;  // the solver takes what the force will be at the end of the step
  double fall = 0;        // at which gravity may bring the two together [m/s^2]

  // memory of the response
  FrictionState frictionState{};
  bool pushed = false;  // in the last step

  // on b, over the last step: impulse over dt, with what an implicit solver adds to it; where a solver has
  // the forces of several times in a step, that at its end [N]
  Eigen::Vector3d force{0, 0, 0};

  // since detection
  Eigen::Vector3d start{0, 0, 0};  // u at detection
  // from the response, at the last evaluation: the unit vector in which it slides; force on b, and -dF/du,
  // -dF/du', both symmetric
  Eigen::Vector3d sliding{0, 0, 0};
  Eigen::Vector3d evaluated{0, 0, 0};
  Eigen::Matrix3d stiffnessMatrix = Eigen::Matrix3d::Zero(), dampingMatrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d marked{0, 0, 0};  // `force` at a time to which a solver may go back

  // of a response by multipliers, in this step: its first equation, and how many it has
  int row = -1, rows = 0;
  bool isNew = false;  // there was none of these vertices in the last step
  int place = -1;      // among what a device has found for its model in this step
  ContactMotion motion{};

  static constexpr auto fields() {
    using C = Contact;
    return field_list(field("a", &C::a, "", "first side"),
                      field("b", &C::b, "", "second side"),
                      field("normal", &C::normal, "", "from a to b"),
                      field("thickness", &C::thickness, "m", "radii of the two"),
                      field("limit", &C::limit, "m", "distance below which the response acts"),
                      field("distance", &C::distance, "m", "at detection"),
                      field("stiffness", &C::stiffness, "N/m", "of the two together"),
                      field("friction", &C::friction, "", "coefficient"),
                      field("damping", &C::damping, "N s/m", "along the normal"),
                      field("response", &C::response, "", "place among the responses"),
                      field("frictionState", &C::frictionState, "", "what friction remembers"),
                      field("pushed", &C::pushed, "", "it pushed in the last step"),
                      field("force", &C::force, "N", "on b, over the last step"),
                      field("start", &C::start, "m", "displacement at detection"),
                      field("sliding", &C::sliding, "", "direction in which it slides"));
  }

  ContactKey key() const {
    ContactKey k{{a.surface, b.surface}, {a.vertices, b.vertices}, {a.feature, b.feature}};
    for (auto& vertices : k.vertices) std::sort(vertices.begin(), vertices.end());
    return k;
  }
};

/// Whether it is on a triangle that has an inside.
inline bool is_of_one_sided_face(ContactSide const& side, CollisionSurface const& s) {
  return side.corners() == 3 && !s.settings.bothSide;
}
/// p of a side, and its velocity.
inline Eigen::Vector3d position_of(ContactSide const& side, CollisionSurface const& s) {
  Eigen::Vector3d p(0, 0, 0);
  for (std::size_t c = 0; c < 3 && side.vertices[c] >= 0; ++c)
    p += side.weights[c] * s.position[std::size_t(side.vertices[c])];
  if (s.rigid) p += s.orientation[std::size_t(side.vertices[0])] * side.lever;
  return p;
}
inline Eigen::Vector3d lever_of(ContactSide const& side, CollisionSurface const& s) {
  return s.orientation[std::size_t(side.vertices[0])] * side.lever;
}
/// A rate of a side from those of the vertices: velocity and angular velocity, or dx and its angular part.
inline Eigen::Vector3d rate_of(ContactSide const& side, CollisionSurface const& s,
                               std::vector<Eigen::Vector3d> const& linear,
                               std::vector<Eigen::Vector3d> const& angular) {
  Eigen::Vector3d v(0, 0, 0);
  for (std::size_t c = 0; c < 3 && side.vertices[c] >= 0; ++c)
    v += side.weights[c] * linear[std::size_t(side.vertices[c])];
  if (s.rigid) v += angular[std::size_t(side.vertices[0])].cross(lever_of(side, s));
  return v;
}
/// Brings a force at a side to the vertices.
inline void add_force(ContactSide const& side, CollisionSurface& s, Eigen::Vector3d const& f) {
  for (std::size_t c = 0; c < 3 && side.vertices[c] >= 0; ++c)
    s.force[std::size_t(side.vertices[c])] += side.weights[c] * f;
  if (s.rigid) s.torque[std::size_t(side.vertices[0])] += lever_of(side, s).cross(f);
}

/// A response to contacts by a force: evaluate(contact, u, u') sets evaluated, stiffnessMatrix and
/// dampingMatrix for the relative displacement u and velocity u'; settle(contact, u) what it remembers for
/// the next step.
template <class R>
concept ContactLaw = requires(R const r, Contact c, Eigen::Vector3d u) {
  { R::className } -> std::convertible_to<std::string_view>;
  r.evaluate(c, u, u);
  r.settle(c, u);
};
/// A response to contacts that changes a component C of a touched state:
/// touch(component, points) with the touched points of that state.
template <class R, class C>
concept TouchResponse = requires(R const r, C c, std::span<int const> points) { r.touch(c, points); };

}  // namespace sinew
