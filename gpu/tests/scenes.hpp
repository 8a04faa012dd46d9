// SPDX-License-Identifier: BSL-1.0
#pragma once

// Scenes over any DataTypes, and how they went over the processor's: computed in files of their own, without
// Thrust, once for all backends.

#include <sinew/context/gravity.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/state/mechanical_object.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gpu_test {

using namespace sinew;

/// The states of a scene that has one, in the node "body".
struct OneBody {
  template <class Sim, class F>
  static void each(Sim& sim, F&& f) {
    f(sim.template at<"body">().state());
  }
};

/// Where the states of a scene have come to.
struct Course {
  std::vector<double> position{}, velocity{};
  double moved = 0;   // largest way of a point [m]
  double energy = 0;  // kinetic and potential [J]

  bool operator==(Course const&) const = default;
};

/// Centres of all points of a scene. `Scene` has make<D>(), its dt and steps, and each(sim, f) for its
/// states.
template <class Scene, class Sim>
std::vector<double> places(Sim& sim) {
  std::vector<double> all;
  Scene::each(sim, [&](auto const& state) {
    using D = typename std::decay_t<decltype(state)>::DataTypes;
    for (auto const& x : state.position) {
      const auto center = D::center(x);
      for (int c = 0; c < D::spatial; ++c) all.push_back(double(center[c]));
      if constexpr (D::rigid)
        for (int c = 0; c < 4; ++c) all.push_back(double(x.orientation.coeffs()[c]));
    }
  });
  return all;
}

/// Runs a scene; with `watch`, calls it after its first three steps and after its last.
template <class Scene, class D, class Watch>
Course run(Watch&& watch) {
  auto sim = Scene::template make<D>();
  sim.init();
  Course course;
  const std::vector<double> start = places<Scene>(sim);
  for (int step = 0; step < Scene::steps; ++step) {
    if (step == 3) watch();
    sim.animate(Scene::dt);
  }
  watch();
  course.position = places<Scene>(sim);
  Scene::each(sim, [&](auto const& state) {
    for (auto const& v : state.velocity)
      for (int c = 0; c < int(v.size()); ++c) course.velocity.push_back(double(v[c]));
  });
  for (std::size_t i = 0; i < start.size(); ++i)
    course.moved = std::max(course.moved, std::abs(course.position[i] - start[i]));
  course.energy = sim.kineticEnergy() + sim.potentialEnergy();
  return course;
}

/// The course of a scene over the processor's DataTypes H. Instantiated in host_scenes_*.cpp.
template <class Scene, class H>
Course on_host();

}  // namespace gpu_test
