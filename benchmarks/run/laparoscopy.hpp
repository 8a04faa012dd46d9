// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laparoscopy/scene.hpp"

#include <ctime>

namespace bench {

/// Processor time of this program, of its one thread [s]: what else runs does not count.
inline double now() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

struct Shares {
  double detection = 0, response = 0;  // [s]
};

/// A contact manager that knows how long the steps spend in detection, which it begins and ends, and in the
/// forces of contacts.
struct TimedManager : sinew::DefaultContactManager {
  Shares shares{};
  double begin = 0;

  template <class Surfaces>
  void settle(Surfaces const& all) {
    begin = now();
    sinew::DefaultContactManager::settle(all);
  }
  void manage(double dt) {
    sinew::DefaultContactManager::manage(dt);
    shares.detection += now() - begin;
  }
  template <class Chosen>
  void addForces(Chosen&& chosen) {
    const auto start = now();
    sinew::DefaultContactManager::addForces(chosen);
    shares.response += now() - start;
  }
  template <class Chosen>
  void addDForces(double k, double b, Chosen&& chosen) {
    const auto start = now();
    sinew::DefaultContactManager::addDForces(k, b, chosen);
    shares.response += now() - start;
  }
};

/// Time of the first steps of the script, of 0.02 s.
struct Laparoscopy {
  double seconds = 0;
  Shares shares{};
};
template <class Organs>
Laparoscopy time_laparoscopy(examples::LaparoscopyBodies const& bodies, long steps) {
  const double dt = 0.02;
  auto sim =
      examples::laparoscopy_scene<Organs, TimedManager, sinew::CompressedRowSparseMatrixMat3x3d>(bodies);
  sim.init();
  examples::LaparoscopyScript script;
  const long warm = 5;
  Laparoscopy result;
  auto& manager = sim.root().template get<TimedManager>();
  double start = 0;
  for (long i = 0; i < warm + steps; ++i) {
    if (i == warm) start = now(), manager.shares = {};
    script.act(sim, dt);
    sim.animate(dt);
  }
  result.seconds = now() - start;
  result.shares = manager.shares;
  return result;
}

Laparoscopy time_fem(examples::LaparoscopyBodies const& bodies, long steps);
Laparoscopy time_grid(examples::LaparoscopyBodies const& bodies, long steps);

}  // namespace bench
