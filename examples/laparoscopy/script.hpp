// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>
#include <sinew/scene/picking.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace examples {

/// What the tool does, again and again: it pushes the liver, slides over the intestines, pushes a loop of
/// them against the liver, grasps the left lobe of the liver, lifts it, and lets go. Its tip moves; its shaft
/// goes through a fixed hole in the wall.
struct LaparoscopyScript {
  static constexpr double period = 20;                                       // [s]
  static constexpr double grasps = 15.4 / period, releases = 18.3 / period;  // parts of the period
  /// What to look at, and when, in parts of the period.
  struct Moment {
    double part;
    char const* title;
  };
  static constexpr std::array<Moment, 3> moments{{{4 / period, "pushing the liver"},
                                                  {13.4 / period, "between two loops"},
                                                  {17.8 / period, "lifting the left lobe"}}};
  double length = period;

  struct Movement {
    std::vector<double> times;
    sinew::Rigid3d::VecCoord positions;
  };
  /// Of the frame of the tool, its z axis from the tip to the hole, in a script of that length.
  static Movement trajectory(double length);

  /// Springs between the jaws and the liver, while they are closed: held places in the frame of the tool.
  struct Held {
    int attachment;
    Eigen::Vector3d place;
  };
  std::vector<Held> held{};
  int graspsDone = 0;
  bool closed = false;

  /// Before a step of dt.
  template <class Sim>
  void act(Sim& sim, double dt) {
    const double part = std::fmod(sim.time() + dt / 2, length) / length;
    const bool close = part >= grasps && part < releases;
    auto const& tool = sim.template at<"tool">().state();
    const auto pose = tool.position[0];
    if (close && !closed) {
      // from within the shaft, to what is in front of the jaws: one place in the middle, 4 and 8 around it
      std::vector<sinew::Pick> picks;
      for (int ring = 0; ring < 3; ++ring)
        for (int i = 0; i < std::max(1, 4 * ring); ++i) {
          const double angle = std::numbers::pi * i / (2 * std::max(1, ring)), r = 0.005 * ring;
          const Eigen::Vector3d inTool(r * std::cos(angle), r * std::sin(angle), 0.03);
          const auto pick = sim.pick(
              pose.center + pose.orientation * inTool, pose.orientation * Eigen::Vector3d(0, 0, -1), 0.05);
          if (pick && pick->simulated) picks.push_back(*pick);
        }
      for (auto const& pick : picks)
        held.push_back({sim.attach(pick, {.stiffness = 300.0 / double(picks.size()), .damping = 0.5}),
                        pose.orientation.conjugate() * (pick.point - pose.center)});
      graspsDone += held.empty() ? 0 : 1;
    }
    if (!close)
      for (Held const& h : held) sim.release(h.attachment);
    if (!close) held.clear();
    closed = close;
    for (Held const& h : held) sim.pull(h.attachment, pose.center + pose.orientation * h.place);
  }
};

}  // namespace examples
