// SPDX-License-Identifier: BSL-1.0
// The scenes of the table, and how they are measured.
#pragma once

#include <sinew/sinew.hpp>

#include "paired.hpp"
#include "scenes.hpp"

#include <array>
#include <cstdlib>

namespace bench {

using namespace sinew;

/// Processor time of a step of 0.02 s, over `steps` of them.
template <class Sim>
double seconds_a_step(Sim& sim, int steps) {
  return processor_seconds([&] {
           for (int i = 0; i < steps; ++i) sim.animate(0.02);
         }) /
         steps;
}

/// Steps a second of a scene from its start, and where its point 100 is at the end, as one line.
template <class Sim>
void report(char const* kind, Sim sim, int steps) {
  sim.init();
  const double time = seconds_a_step(sim, steps);
  auto const& x = sim.root().state().position;
  auto const& probe = x[std::min<std::size_t>(100, x.size() - 1)];
  std::printf(
      "%s %.2f %.6f %.6f %.6f\n", kind, 1 / time, double(probe[0]), double(probe[1]), double(probe[2]));
  std::fflush(stdout);
}

/// The number that is the argument `text` of a program; throws Error where it is not one of at least 1.
inline int whole_number(char const* text) {
  char* end = nullptr;
  const long value = std::strtol(text, &end, 10);
  if (end == text || *end || value < 1 || value > 1000000000)
    throw Error("arguments", sinew::text("'", text, "' is not a whole number of at least 1"));
  return int(value);
}

}  // namespace bench
