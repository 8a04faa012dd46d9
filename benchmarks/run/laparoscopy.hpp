// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laparoscopy/scene.hpp"

#include <chrono>

namespace bench {

using Clock = std::chrono::steady_clock;

struct Shares {
  double detection = 0, response = 0;  // [s]
};

/// A contact manager that knows how long the steps spend in detection, which it begins and ends, and in the
/// forces of contacts.
struct TimedManager : sinew::DefaultContactManager {
  Shares shares{};
  Clock::time_point begin{};

  static double since(Clock::time_point t) { return std::chrono::duration<double>(Clock::now() - t).count(); }
  template <class Surfaces>
  void settle(Surfaces const& all) {
    begin = Clock::now();
    sinew::DefaultContactManager::settle(all);
  }
  void manage(double dt) {
    sinew::DefaultContactManager::manage(dt);
    shares.detection += since(begin);
  }
  template <class Chosen>
  void addForces(Chosen&& chosen) {
    const auto start = Clock::now();
    sinew::DefaultContactManager::addForces(chosen);
    shares.response += since(start);
  }
  template <class Chosen>
  void addDForces(double k, double b, Chosen&& chosen) {
    const auto start = Clock::now();
    sinew::DefaultContactManager::addDForces(k, b, chosen);
    shares.response += since(start);
  }
};

/// Wall time of the first steps of the script, of 0.02 s.
struct Laparoscopy {
  double seconds = 0;
  Shares shares{};
};
template <class Organs>
Laparoscopy time_laparoscopy(examples::LaparoscopyBodies const& bodies, long steps) {
  const double dt = 0.02;
  auto sim = examples::laparoscopy_scene<Organs, TimedManager>(bodies);
  sim.init();
  examples::LaparoscopyScript script;
  const long warm = 5;
  Laparoscopy result;
  auto& manager = sim.root().template get<TimedManager>();
  Clock::time_point start;
  for (long i = 0; i < warm + steps; ++i) {
    if (i == warm) start = Clock::now(), manager.shares = {};
    script.act(sim, dt);
    sim.animate(dt);
  }
  result.seconds = TimedManager::since(start);
  result.shares = manager.shares;
  return result;
}

Laparoscopy time_fem(examples::LaparoscopyBodies const& bodies, long steps);
Laparoscopy time_grid(examples::LaparoscopyBodies const& bodies, long steps);

}  // namespace bench
