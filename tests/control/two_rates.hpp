// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/control/haptic_controller.hpp>
#include <sinew/core/wrench.hpp>

#include <cmath>

/// Both sides of a coupling at their two rates, without threads: ticks of 1 ms, steps of dt whose result is
/// there half a step after they began. `tool(sim)` is that after a step, but for its time; each(time, wrench)
/// is called after each tick with the wrench of the coupling.
template <class Sim, class Coupling, class Hand, class Tool, class Each>
void at_two_rates(Sim& sim, Coupling& coupling, Hand& hand, sinew::HapticController c, double dt,
                  double seconds, Tool&& tool, Each&& each) {
  c.rampTime = 0, c.maxForce = c.maxTorque = 1e9;
  coupling.stiffness = c.stiffness, coupling.damping = c.damping;
  coupling.angularStiffness = c.angularStiffness, coupling.angularDamping = c.angularDamping;
  sim.init();
  const double T = 1e-3;
  const long perStep = std::lround(dt / T), ticks = std::lround(seconds / T);
  sinew::ToolState result;
  c.accept(0, result);
  for (long i = 0; i < ticks; ++i) {
    const double time = double(i) * T;
    c.observe(time, hand.read(time));
    if (i % perStep == 0) {
      const sinew::ToolTarget target = c.reading.ahead(dt);
      coupling.setTarget(target.pose, target.velocity);
      sim.animate(dt);
      result = tool(sim);
      result.time = time + dt;
    }
    if (i % perStep == perStep / 2) c.accept(time, result);
    const sinew::Wrench w = c.wrench(time);
    hand.write(w);
    each(time, w);
  }
}
