// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/control/haptic_device.hpp>
#include <sinew/core/error.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace sinew {

/// A simulated device that replays a recorded trajectory: straight lines and constant rotations between
/// samples, the buttons of the sample before. Outside the times it stands at the first or last sample, or
/// starts again with `repeat`.
class TrajectoryDevice {
 public:
  struct Sample {
    double time;  // s
    DeviceState state;
  };
  Wrench felt{};  // the last one written

  /// Throws Error where there is no sample, where times do not increase, and where a number is not finite.
  explicit TrajectoryDevice(std::vector<Sample> samples, bool repeat = false)
      : samples_(std::move(samples)), repeat_(repeat) {
    if (samples_.empty()) throw Error("TrajectoryDevice", "there is no sample; give at least one");
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      auto const& [time, state] = samples_[i];
      if (!std::isfinite(time) || !Rigid3d::finite(state.pose) || !(state.pose.orientation.norm() > 0.5))
        throw Error("TrajectoryDevice",
                    text("sample ", i, " is not finite, or its orientation no unit quaternion; correct it"));
      if (i > 0 && !(time > samples_[i - 1].time))
        throw Error("TrajectoryDevice",
                    text("sample ",
                         i,
                         " is at ",
                         time,
                         " s, not after the one before it at ",
                         samples_[i - 1].time,
                         " s; sort the samples"));
    }
  }

  DeviceState read(double time) const {
    const double first = samples_.front().time, last = samples_.back().time;
    if (repeat_ && last > first) time = first + std::fmod(std::max(time - first, 0.0), last - first);
    const auto after = std::upper_bound(
        samples_.begin(), samples_.end(), time, [](double t, Sample const& s) { return t < s.time; });
    if (after == samples_.begin()) return samples_.front().state;
    if (after == samples_.end()) return samples_.back().state;
    Sample const& before = *(after - 1);
    DeviceState state = before.state;
    const double part = (time - before.time) / (after->time - before.time);
    Rigid3d::increment(state.pose, part * Rigid3d::difference(before.state.pose, after->state.pose));
    return state;
  }
  void write(Wrench const& wrench) { felt = wrench; }

 private:
  std::vector<Sample> samples_;
  bool repeat_;
};

}  // namespace sinew
