// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scene.hpp"

#include "support/progress.hpp"

#include <sinew/runtime/record.hpp>

#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

namespace cli {

inline bool is_record(std::string const& path) {
  std::FILE* const file = std::fopen(path.c_str(), "rb");
  if (!file) return false;
  char head[12] = {};
  const bool whole = std::fread(head, 1, sizeof head, file) == sizeof head;
  std::fclose(file);
  return whole && std::string_view(head, sizeof head) == "sinew record";
}

/// One of the two that are compared: a scene, or a record of one.
class Side {
 public:
  Side(std::string label, SceneOptions const& options) : label_(std::move(label)), options_(options) {
    if (is_record(options.path)) {
      try {
        frames_ = sinew::read_record(options.path);
      } catch (sinew::Error const& error) {
        throw Failure{badScene, {error.what()}};
      }
      if (frames_->empty()) throw Failure{badScene, {sinew::text(options.path, ": the record has no frame")}};
      return;
    }
    auto read_ = read(options);
    fresh_ = std::make_unique<sinew::ReadScene<sinew::Standard>>(read_);
    scene_.emplace(start(std::move(read_), options));
    start_ = time();
  }

  bool recorded() const { return frames_.has_value(); }
  std::vector<sinew::RecordedFrame> const& frames() const { return *frames_; }
  double dt() const { return scene_ ? scene_->dt : 0; }
  double time() const { return scene_ ? scene_->simulation.time() : frames_->front().time; }
  std::string const& path() const { return options_.path; }
  Scene* scene() { return scene_ ? &*scene_ : nullptr; }  // null: a record

  /// Back to the start.
  void again() {
    if (scene_) scene_.emplace(start(*fresh_, options_));
    stepping_ = {};
    steps_ = 0;
  }
  /// Simulates until a time, which has to be that of a step.
  void advance(double until) {
    if (!scene_) return;
    const double exact = (until - start_) / dt();
    const long steps = std::lround(exact) - steps_;
    if (steps < 0 || std::abs(exact - double(steps_ + steps)) > 1e-6 * std::max(1.0, exact))
      throw Failure{badUsage,
                    {sinew::text(path(),
                                 ": no step of ",
                                 dt(),
                                 " s ends at ",
                                 until,
                                 " s; give both the same --dt, "
                                 "or an --every that makes their times meet")}};
    stepping_.start();
    for (long i = 0; i < steps && !was_interrupted(); ++i) {
      try {
        scene_->animate();
      } catch (Failure& failure) {
        for (auto& message : failure.messages) message = sinew::text(label_, ": ", message);
        throw;
      }
    }
    stepping_.stop();
    steps_ += steps;
  }
  sinew::RecordedFrame frame(double at) {
    if (scene_) return sinew::capture(scene_->simulation.root(), scene_->simulation.step(), at);
    for (auto const& frame : *frames_)
      if (std::abs(frame.time - at) <= 1e-9 * std::max(1.0, std::abs(at))) return frame;
    throw Failure{badUsage,
                  {sinew::text(path(), ": the record has no frame at ", at, " s; give another --every")}};
  }
  double secondsPerStep() const { return steps_ > 0 ? stepping_.seconds() / double(steps_) : std::nan(""); }
  long steps() const { return steps_; }

 private:
  std::string label_;
  SceneOptions options_;
  std::unique_ptr<sinew::ReadScene<sinew::Standard>> fresh_{};
  std::optional<Scene> scene_{};
  std::optional<std::vector<sinew::RecordedFrame>> frames_{};
  examples::Stopwatch stepping_{};
  double start_ = 0;
  long steps_ = 0;
};

}  // namespace cli
