// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/control/haptic_device.hpp>
#include <sinew/core/error.hpp>
#include <sinew/core/fields.hpp>

namespace sinew {

/// A simulated device in a simulated hand: a handle of mass m with the damping b of its joints, which the
/// hand's grip, a spring and damper, draws to where the person wants it to be, and which feels the force F of
/// the loop, constant from one write to the next read.
///   m x'' = F - b x' - k (x - x_t) - c (x' - x_t')                                              [N]
/// The motion between two reads is exact for a target that moves straight on; rotations likewise, exact about
/// one axis. A stiffness and damping of 0 is a device without a hand. target(time) is a Rigid3d::Coord.
template <class Target>
struct HandDevice {
  static constexpr std::string_view className = "HandDevice";

  Target target;
  double mass = 0.1, stiffness = 300, damping = 5, deviceDamping = 0;
  double inertia = 1e-4, angularStiffness = 1, angularDamping = 0.01, deviceAngularDamping = 0;

  static constexpr auto fields() {
    using F = HandDevice;
    return field_list(
        field("mass", &F::mass, "kg", "of the handle and the hand, as felt at the handle", range::positive),
        field("stiffness", &F::stiffness, "N/m", "of the grip", range::nonNegative),
        field("damping", &F::damping, "N s/m", "of the grip", range::nonNegative),
        field("deviceDamping", &F::deviceDamping, "N s/m", "of the joints", range::nonNegative),
        field("inertia", &F::inertia, "kg m^2", "about each axis", range::positive),
        field("angularStiffness", &F::angularStiffness, "N m/rad", "of the grip", range::nonNegative),
        field("angularDamping", &F::angularDamping, "N m s/rad", "of the grip", range::nonNegative),
        field("deviceAngularDamping",
              &F::deviceAngularDamping,
              "N m s/rad",
              "of the joints",
              range::nonNegative));
  }

  Rigid3d::Coord pose{};
  Rigid3d::Deriv velocity = Rigid3d::Deriv::Zero();
  unsigned buttons = 0;
  Wrench felt{};    // the last one written
  double work = 0;  // done by the loop on the handle so far [J]

  DeviceState read(double time) {
    if (!started) start(time);
    if (time > now) advance(time);
    return {pose, buttons};
  }
  void write(Wrench const& wrench) { felt = wrench; }

  /// Of motion and of the grip [J].
  double energy() const {
    const Rigid3d::Deriv d = Rigid3d::difference(aim, pose);
    return 0.5 * (mass * velocity.head<3>().squaredNorm() + inertia * velocity.tail<3>().squaredNorm() +
                  stiffness * d.head<3>().squaredNorm() + angularStiffness * d.tail<3>().squaredNorm());
  }

  // y = offset from the target, u = y', g = acceleration from outside:  (y, u, g)' = A (y, u, g)
  bool started = false;
  double now = 0, step = 0;
  Rigid3d::Coord aim{};
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity(), angular = linear;  // exp(A step)

  /// Stands where the target is, unless a pose was given.
  void start(double time) {
    check_fields(*this, "HandDevice");
    started = true;
    now = time;
    aim = target(time);
    if (pose == Rigid3d::Coord{}) pose = aim;
  }

  void advance(double time) {
    const double dt = time - now;
    if (std::abs(dt - step) > 1e-12) {
      step = dt;
      linear = propagator(stiffness / mass, (damping + deviceDamping) / mass, dt);
      angular = propagator(angularStiffness / inertia, (angularDamping + deviceAngularDamping) / inertia, dt);
    }
    const Rigid3d::Coord next = target(time);
    const Rigid3d::Deriv aimVelocity = Rigid3d::difference(aim, next) / dt;
    const Rigid3d::Deriv y = Rigid3d::difference(aim, pose), u = velocity - aimVelocity;
    Rigid3d::Deriv offset;
    for (int c = 0; c < 6; ++c) {
      const double pull = (c < 3 ? felt.force[c] - deviceDamping * aimVelocity[c]
                                 : felt.torque[c - 3] - deviceAngularDamping * aimVelocity[c]) /
                          (c < 3 ? mass : inertia);
      Eigen::Matrix3d const& m = c < 3 ? linear : angular;
      offset[c] = m(0, 0) * y[c] + m(0, 1) * u[c] + m(0, 2) * pull;
      velocity[c] = m(1, 0) * y[c] + m(1, 1) * u[c] + m(1, 2) * pull + aimVelocity[c];
    }
    const Rigid3d::Coord before = pose;
    pose = next;
    Rigid3d::increment(pose, offset);
    const Rigid3d::Deriv moved = Rigid3d::difference(before, pose);
    work += felt.force.dot(moved.head<3>()) + felt.torque.dot(moved.tail<3>());
    aim = next;
    now = time;
  }

  // exp(A t), A = [0 1 0; -k -c 1; 0 0 0], by its series at t / 2^n, squared n times
  static Eigen::Matrix3d propagator(double k, double c, double t) {
    int halvings = 0;
    while (t * (1 + k * t + c) > 0.25 && halvings < 60) t /= 2, ++halvings;
    Eigen::Matrix3d a = Eigen::Matrix3d::Zero(), sum = Eigen::Matrix3d::Identity(), term = sum;
    a(0, 1) = t, a(1, 0) = -k * t, a(1, 1) = -c * t, a(1, 2) = t;
    for (int i = 1; i < 24; ++i) {
      term = a * term / double(i);
      sum += term;
    }
    for (int i = 0; i < halvings; ++i) sum = sum * sum;
    return sum;
  }
};
template <class Target>
HandDevice(Target) -> HandDevice<Target>;

}  // namespace sinew
