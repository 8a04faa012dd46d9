// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>
#include <sinew/core/wrench.hpp>

#include <concepts>

namespace sinew {

/// What a haptic device tells: where its handle is, in its own axes [m], and which buttons are pressed, one
/// bit each.
struct DeviceState {
  Rigid3d::Coord pose{};
  unsigned buttons = 0;
};

/// A haptic device. It is told the force and the torque on the hand, in its own axes. Both functions are
/// called by the thread of the loop, read before write, once a tick; they must return well within a period.
/// `time` [s] is that of the loop: a simulated device is there at that time, a real one needs no clock. An
/// exception ends the loop with a force of zero. A device of three degrees of freedom leaves the orientation
/// as it is and ignores the torque.
template <class D>
concept HapticDevice = requires(D device, double time, Wrench const& wrench) {
  { device.read(time) } -> std::convertible_to<DeviceState>;
  device.write(wrench);
};

}  // namespace sinew
