// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/control/haptic_device.hpp>

namespace sinew {

/// A simulated device that is where a script says, whatever it feels: script(time) is a DeviceState.
template <class Script>
struct ScriptedDevice {
  Script script;
  Wrench felt{};  // the last one written

  DeviceState read(double time) { return script(time); }
  void write(Wrench const& wrench) { felt = wrench; }
};
template <class Script>
ScriptedDevice(Script) -> ScriptedDevice<Script>;

}  // namespace sinew
