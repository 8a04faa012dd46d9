// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

#include "support/progress.hpp"

#include <sinew/control/haptic_loop.hpp>

namespace {

void row(char const* what, sinew::LatencyHistogram const& h) {
  std::printf("%-34s %9.1f %9.1f %9.1f %9.1f us\n",
              what,
              h.mean() * 1e6,
              h.percentile(0.99) * 1e6,
              h.percentile(0.999) * 1e6,
              h.worst() * 1e6);
}

/// Counts by octave, with a bar of the logarithm.
void chart(char const* what, sinew::LatencyHistogram const& h) {
  std::printf("\n%s\n", what);
  for (int octave = 8; octave < 40; ++octave) {
    const double low = octave == 8 ? 0 : double(1ll << octave) * 1e-9, high = double(2ll << octave) * 1e-9;
    const auto n = h.between(low, high);
    if (n == 0) continue;
    char bar[41] = {};
    const int length = 1 + int(2 * std::log2(double(n)));
    for (int i = 0; i < std::min(length, 40); ++i) bar[i] = '#';
    std::printf("  %9.1f to %9.1f us %8ld %s\n", low * 1e6, high * 1e6, long(n), bar);
  }
}

}  // namespace

int main(int argc, char** argv) try {
  using namespace sinew;
  examples::HapticOptions options;
  int status = 0;
  if (!examples::read_options(argc, argv, options, status)) return status;
  auto sim = examples::haptic_scene(options);
  sim.init();
  HandDevice device{examples::Palpation{}};
  HapticController settings;
  settings.rate = options.rate;
  settings.deviceMass = device.mass;
  HapticLoop loop(device, settings, options.priority);
  std::printf("haptics: %zu points, %zu tetrahedra, steps of %g ms; loop at %g Hz, stable up to %.0f N/m\n",
              sim.at<"block">().state().size(),
              sim.at<"block">().get<TetrahedronTopology>().tetrahedra.size(),
              options.dt * 1e3,
              options.rate,
              settings.stableStiffness());

  const long steps = std::lround(options.seconds / options.dt);
  examples::Progress progress(std::max(steps, 1l));
  long done = 0, touching = 0;
  double pushed = 0;
  loop.start();
  loop.run(options.seconds, options.dt, [&](ToolTarget const& target) {
    progress.at(++done);
    const ToolState tool = examples::haptic_step(sim, target, options.dt);
    const double push = examples::contact_force(sim).norm();
    touching += push > 0;
    pushed = std::max(pushed, push);
    return tool;
  });
  loop.stop();

  const HapticStatistics s = loop.statistics();
  std::printf("\n%-34s %s\n", "thread", s.scheduling.c_str());
  std::printf("%-34s %9.2f Hz\n", "rate reached", s.rate());
  std::printf("%-34s %9ld of %ld (%.4f %%)\n",
              "deadlines missed",
              s.missed,
              s.ticks + s.missed,
              100 * double(s.missed) / double(s.ticks + s.missed));
  std::printf("%-34s %9ld of %ld\n", "ticks without a fresh simulation", s.staleTicks, s.ticks);
  std::printf("%-34s %9.3f N, largest jump %.3f N\n", "largest force", s.largestForce, s.largestJump);
  std::printf(
      "%-34s %9.4f N m, largest jump %.4f N m\n", "largest torque", s.largestTorque, s.largestTorqueJump);
  std::printf(
      "%-34s %9ld of %ld, largest force %.3f N\n", "steps in which the tip touches", touching, done, pushed);
  std::printf("%-34s %9ld of %ld\n\n", "steps longer than dt", s.lateSteps, long(s.step.count()));
  std::printf("%-34s %9s %9s %9s %9s\n", "", "mean", "99 %", "99.9 %", "worst");
  row("wake after the deadline", s.wakeLatency);
  row("tick", s.work);
  row("step of the simulation", s.step);
  chart("wake after the deadline", s.wakeLatency);
  chart("step of the simulation", s.step);
  return 0;
} catch (sinew::Error const& error) {
  std::fprintf(stderr, "haptics: %s\n", error.what());
  return 1;
}
