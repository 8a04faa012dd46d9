// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/control/coupling_limits.hpp>
#include <sinew/control/haptic_device.hpp>
#include <sinew/core/error.hpp>
#include <sinew/core/fields.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sinew {

/// What a constraint of the simulation leaves a tool: a motion u from its pose, of the centre and rotated,
/// with direction.u >= -distance.
struct ToolLimit {
  Rigid3d::Deriv direction =
      Rigid3d::Deriv::Zero();  // of a place at r from the centre and a normal n: n, r x n
  double distance = 0;         // m
};

/// The simulated tool, as the simulation tells it to the loop: pose and velocity in the scene, the time of
/// the loop at which they are true [s], and what keeps it from going on (control/tool_limits.hpp).
struct ToolState {
  static constexpr std::size_t maxLimits = 16;

  Rigid3d::Coord pose{};
  Rigid3d::Deriv velocity = Rigid3d::Deriv::Zero();
  double time = 0;
  std::array<ToolLimit, maxLimits> limits{};
  std::size_t limitCount = 0;

  /// Where there is no room, the one that is farthest goes.
  void add(ToolLimit const& limit) {
    if (limitCount < maxLimits) {
      limits[limitCount++] = limit;
      return;
    }
    auto const farthest = std::max_element(
        limits.begin(), limits.end(), [](auto const& a, auto const& b) { return a.distance < b.distance; });
    if (limit.distance < farthest->distance) *farthest = limit;
  }
  bool finite() const {
    bool all =
        Rigid3d::finite(pose) && velocity.allFinite() && std::isfinite(time) && limitCount <= maxLimits;
    for (std::size_t i = 0; all && i < limitCount; ++i)
      all = limits[i].direction.allFinite() && std::isfinite(limits[i].distance);
    return all;
  }
};

/// The device, as the loop tells it to the simulation: pose and velocity in the scene, where the tool should
/// be, the buttons, and the time of the loop at which they were read [s].
struct ToolTarget {
  Rigid3d::Coord pose{};
  Rigid3d::Deriv velocity = Rigid3d::Deriv::Zero();
  unsigned buttons = 0;
  double time = 0;

  /// The same a time later, at its velocity.
  ToolTarget ahead(double seconds) const {
    ToolTarget later = *this;
    Rigid3d::increment(later.pose, seconds * velocity);
    later.time += seconds;
    return later;
  }
};

/// One tick of a haptic loop, without threads and clocks. A virtual coupling (Colgate, Stanley and Brown
/// 1995, Issues in the haptic display of tool use; Adams and Hannaford 1999), a spring and damper between
/// device and simulated tool,
///   F = K (x_tool - x) + B (v_tool - v),  torque = K_a t + B_a (w_tool - w),  t the rotation from device to
///   tool
/// where v is the difference of the last two poses over the time between, and the tool is where its last
/// state and velocity say, as far as its limits let it go: the motion that they permit and that is nearest by
/// the energy of the coupling, by projected Gauss-Seidel in each tick. Force and torque are clamped. They
/// rise from zero, and fall to zero when the simulation has said nothing new for `staleTime`; a pose or tool
/// that is not finite counts as none. check() refuses settings beyond stable_stiffness.
struct HapticController {
  static constexpr std::string_view className = "HapticController";

  bool activate = true;
  double rate = 1000;
  double stiffness = 500, damping = 2, angularStiffness = 0.5, angularDamping = 0.005;
  double forceCoef = 1, scale = 1;
  Eigen::Vector3d positionBase{0, 0, 0};
  Quat<double> orientationBase{1, 0, 0, 0};
  double maxForce = 3, maxTorque = 0.2;
  double staleTime = 0.1, rampTime = 0.1, maxExtrapolation = 0.05, velocityFilter = 0;
  double deviceMass = 0.05, deviceDamping = 0, deviceInertia = 1e-4, deviceAngularDamping = 0;

  static constexpr auto fields() {
    using F = HapticController;
    using namespace range;
    return field_list(
        field("activate", &F::activate, "", "the device feels a force"),
        field("rate", &F::rate, "Hz", "ticks a second", {.low = 0, .high = 1e5, .openLow = true}),
        field("stiffness", &F::stiffness, "N/m", "of the coupling", nonNegative),
        field("damping", &F::damping, "N s/m", "of the coupling", nonNegative),
        field("angularStiffness", &F::angularStiffness, "N m/rad", "of the coupling", nonNegative),
        field("angularDamping", &F::angularDamping, "N m s/rad", "of the coupling", nonNegative),
        field("forceCoef", &F::forceCoef, "", "multiplies force and torque", nonNegative).also("forceScale"),
        field("scale", &F::scale, "", "multiplies the positions of the device", positive),
        field("positionBase", &F::positionBase, "m", "origin of the device in the scene"),
        field("orientationBase", &F::orientationBase, "", "axes of the device in the scene"),
        field("maxForce", &F::maxForce, "N", "largest force", nonNegative).also("maxInputForceFeedback"),
        field("maxTorque", &F::maxTorque, "N m", "largest torque", nonNegative),
        field("staleTime", &F::staleTime, "s", "how long the last state of the tool is believed", positive),
        field("rampTime", &F::rampTime, "s", "in which the force rises and falls", nonNegative),
        field("maxExtrapolation", &F::maxExtrapolation, "s", "how far the tool goes on alone", nonNegative),
        field("velocityFilter",
              &F::velocityFilter,
              "s",
              "time constant of a low pass on the device's velocity",
              nonNegative),
        field("deviceMass", &F::deviceMass, "kg", "apparent mass of the device's handle", positive),
        field("deviceDamping", &F::deviceDamping, "N s/m", "of the device's joints", nonNegative),
        field("deviceInertia", &F::deviceInertia, "kg m^2", "apparent inertia of the handle", positive),
        field("deviceAngularDamping",
              &F::deviceAngularDamping,
              "N m s/rad",
              "of the device's joints",
              nonNegative));
  }

  double period() const { return 1 / rate; }
  /// Largest `stiffness` with these settings that check() allows, and that is passive whatever the hand does.
  double stableStiffness() const {
    return stable_stiffness({deviceMass, deviceDamping}, felt(damping), period()) / felt(1);
  }
  double passiveStiffness() const {
    return passive_stiffness(deviceDamping, felt(damping), period()) / felt(1);
  }
  double stableAngularStiffness() const {
    return stable_stiffness({deviceInertia, deviceAngularDamping}, forceCoef * angularDamping, period()) /
           forceCoef;
  }

  /// Throws Error where a setting is out of its range, or the loop would not be stable.
  void check(std::string_view where = {}) {
    check_fields(*this, where);
    if (!(orientationBase.norm() > 0.5 && orientationBase.norm() < 2))
      throw Error(where, text(className, ": orientationBase is no unit quaternion; correct it"));
    orientationBase.normalize();
    auto bounded = [&](std::string_view name, double value, std::string_view dampingName, double limit) {
      if (value <= limit) return;
      throw Error(where,
                  text(className,
                       ": ",
                       name,
                       " is ",
                       value,
                       ", but at ",
                       rate,
                       " Hz, with this ",
                       dampingName,
                       " and this mass of the device, the loop is stable up to ",
                       limit,
                       " only; lower it, raise the rate, or change ",
                       dampingName));
    };
    if (forceCoef > 0) {
      bounded("stiffness", stiffness, "damping", stableStiffness());
      if (angularStiffness > 0 || angularDamping > 0)
        bounded("angularStiffness", angularStiffness, "angularDamping", stableAngularStiffness());
    }
  }

  // from tick to tick
  ToolTarget reading{};     // the last good pose of the device
  bool hasReading = false;  // that of this tick is good
  ToolState tool{};
  bool hasTool = false;
  double arrival = 0;  // when the loop had the last state of the tool
  double gain = 0;     // of the ramp, 0 to 1
  long badPoses = 0, badTools = 0, staleTicks = 0;

  /// Before the first tick.
  void restart() {
    reading = {}, tool = {};
    hasReading = hasTool = false;
    arrival = gain = 0;
    badPoses = badTools = staleTicks = 0;
  }

  /// The pose of the device at a time [s].
  void observe(double time, DeviceState const& device) {
    const double norm = device.pose.orientation.norm();
    if (!Rigid3d::finite(device.pose) || !(norm > 0.5 && norm < 2)) {
      hasReading = false;
      ++badPoses;
      return;
    }
    const Rigid3d::Coord pose{orientationBase * (scale * device.pose.center) + positionBase,
                              orientationBase * device.pose.orientation.normalized()};
    if (hasReading) {
      // a tick that comes soon after a late one does not magnify the steps of the device's encoders
      const double dt = std::max(time - reading.time, period());
      const Rigid3d::Deriv v = Rigid3d::difference(reading.pose, pose) / dt;
      reading.velocity = reading.velocity + (v - reading.velocity) * (dt / (dt + velocityFilter));
    } else {
      reading.velocity = Rigid3d::Deriv::Zero();
    }
    reading.pose = pose;
    reading.buttons = device.buttons;
    reading.time = time;
    hasReading = true;
  }

  /// A new state of the tool, at a time [s].
  void accept(double time, ToolState const& state) {
    if (!state.finite()) {
      ++badTools;
      return;
    }
    tool = state;
    arrival = time;
    hasTool = true;
  }

  /// What the device feels at a time [s].
  Wrench wrench(double time) {
    const bool stale = !hasTool || time - arrival > staleTime;
    staleTicks += stale;
    const double change = rampTime > 0 ? std::min(1.0, period() / rampTime) : 1.0;
    gain = std::clamp(gain + (stale || !activate ? -change : change), 0.0, 1.0);
    if (!hasReading) gain = 0;  // where the device is not known, there is no safe force
    if (gain == 0) return {};
    Rigid3d::Coord place = tool.pose;
    Rigid3d::Deriv way = std::clamp(time - tool.time, -maxExtrapolation, maxExtrapolation) * tool.velocity,
                   motion = tool.velocity;
    if (tool.limitCount > 0) keepWithinLimits(way, motion);
    Rigid3d::increment(place, way);
    const Rigid3d::Deriv d = Rigid3d::difference(reading.pose, place), v = motion - reading.velocity;
    const Eigen::Vector3d force = d.head<3>() * stiffness + v.head<3>() * damping;
    const Eigen::Vector3d torque = d.tail<3>() * angularStiffness + v.tail<3>() * angularDamping;
    const Quat<double> toDevice = orientationBase.conjugate();
    return {toDevice * (gain * clamped(forceCoef * force, maxForce)),
            toDevice * (gain * clamped(forceCoef * torque, maxTorque))};
  }

 private:
  // The nearest way that all limits permit, and of velocities the nearest that leads on from there.
  void keepWithinLimits(Rigid3d::Deriv& way, Rigid3d::Deriv& motion) const {
    std::array<double, ToolState::maxLimits> pushed{}, held{};
    project(way, pushed, [&](std::size_t i) { return tool.limits[i].distance; });
    project(motion, held, [&](std::size_t i) {
      return pushed[i] > 0 ? 0 : std::numeric_limits<double>::infinity();
    });
  }
  template <class Distance>
  void project(Rigid3d::Deriv& u, std::array<double, ToolState::maxLimits>& f, Distance&& distance) const {
    Rigid3d::Deriv inverse;
    for (int c = 0; c < 6; ++c) {
      const double k = c < 3 ? stiffness : angularStiffness;
      inverse[c] = k > 0 ? 1 / k : 0;
    }
    for (int sweep = 0; sweep < 30; ++sweep) {
      double change = 0;
      for (std::size_t i = 0; i < tool.limitCount; ++i) {
        auto const& n = tool.limits[i].direction;
        const double answer = n.dot(inverse.cwiseProduct(n)), room = distance(i);
        if (!(answer > 0) || !std::isfinite(room)) continue;
        const double next = std::max(0.0, f[i] - (n.dot(u) + room) / answer);
        u += (next - f[i]) * inverse.cwiseProduct(n);
        change = std::max(change, std::abs(next - f[i]) * answer);
        f[i] = next;
      }
      if (change < 1e-9) return;
    }
  }
  // of the scene, as the hand feels it
  double felt(double value) const { return forceCoef * scale * value; }
  static Eigen::Vector3d clamped(Eigen::Vector3d const& v, double maximum) {
    const double norm = v.norm();
    return norm > maximum ? Eigen::Vector3d(v * (maximum / norm)) : v;
  }
};

}  // namespace sinew
