// SPDX-License-Identifier: BSL-1.0
#include "json.hpp"
#include "scene.hpp"

#include "support/progress.hpp"

#include <sinew/runtime/record.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>

namespace cli {

using sinew::text;

namespace {

double median(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

bool is_record(std::string const& path) {
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
      if (frames_->empty()) throw Failure{badScene, {text(options.path, ": the record has no frame")}};
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
                    {text(path(),
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
        for (auto& message : failure.messages) message = text(label_, ": ", message);
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
    throw Failure{badUsage, {text(path(), ": the record has no frame at ", at, " s; give another --every")}};
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

/// Distance between the positions of one body in both, over points and times [m].
struct Distance {
  std::size_t points = 0, count = 0;
  double sum = 0;  // of squares
  double largest = 0, largestAt = 0, lastRms = 0;
  std::string problem{};  // why it is not compared

  double rms() const { return count > 0 ? std::sqrt(sum / double(count)) : 0; }

  void add(sinew::RecordedState const& a, sinew::RecordedState const& b, double time) {
    if (!problem.empty()) return;
    const auto la = *sinew::record_layout(a.dataTypes), lb = *sinew::record_layout(b.dataTypes);
    if (a.points != b.points || la.place != lb.place) {
      problem = text(a.points, " points over ", a.dataTypes, " and ", b.points, " over ", b.dataTypes);
      return;
    }
    points = a.points;
    double now = 0;
    for (std::size_t p = 0; p < points; ++p) {
      double squares = 0;
      for (std::size_t i = 0; i < la.place; ++i) {
        const double d = a.positions[p * la.position + i] - b.positions[p * lb.position + i];
        squares += d * d;
      }
      now += squares;
      if (std::sqrt(squares) > largest) largest = std::sqrt(squares), largestAt = time;
    }
    sum += now;
    count += points;
    lastRms = points > 0 ? std::sqrt(now / double(points)) : 0;
  }
};

struct Comparison {
  std::map<std::string, Distance> bodies{};
  std::vector<std::string> onlyA{}, onlyB{};
  std::size_t frames = 0;

  void add(sinew::RecordedFrame const& a, sinew::RecordedFrame const& b) {
    auto missing = [](auto const& state, auto const& other) {
      return std::none_of(
          other.states.begin(), other.states.end(), [&](auto const& o) { return o.path == state.path; });
    };
    if (frames++ == 0) {
      for (auto const& s : a.states)
        if (missing(s, b)) onlyA.push_back(s.path);
      for (auto const& s : b.states)
        if (missing(s, a)) onlyB.push_back(s.path);
    }
    for (auto const& s : a.states)
      for (auto const& o : b.states)
        if (s.path == o.path) bodies[s.path].add(s, o, a.time);
  }
};

/// The times at which positions are compared: those of a record, or every so many of the longer steps.
std::vector<double> times_of(CompareOptions const& options, Side& a, Side& b) {
  std::vector<double> times;
  if (a.recorded() || b.recorded()) {
    for (auto const& frame : (a.recorded() ? a : b).frames())
      if (options.duration.time == 0 || frame.time <= options.duration.time * (1 + 1e-9))
        times.push_back(frame.time);
    return times;
  }
  if (std::abs(a.time() - b.time()) > 1e-9)
    throw Failure{
        badUsage,
        {text(
            a.path(), " starts at ", a.time(), " s, ", b.path(), " at ", b.time(), " s; they do not meet")}};
  const double dt = std::max(a.dt(), b.dt());
  const long steps = steps_of(options.duration, dt), every = std::min(options.every, std::max(steps, 1L));
  if (steps / every > 10000000)
    throw Failure{badUsage, {text(steps / every, " comparisons are too many; give --every")}};
  for (long i = 0; i <= steps; i += every) times.push_back(a.time() + double(i) * dt);
  return times;
}

struct Energies {
  double kinetic = std::nan(""), potential = std::nan("");
};
Energies energies_of(Side& side) {
  if (side.recorded()) return {};
  auto& simulation = side.scene()->simulation;
  return {simulation.kineticEnergy(), simulation.potentialEnergy()};
}

std::string digits(double value) {
  char words[40];
  std::snprintf(words, sizeof words, "%.6g", value);
  return words;
}

std::string label(SceneOptions const& options) {
  std::string words = options.path;
  for (auto const& [path, value] : options.set) words += text(' ', path, '=', value);
  return words;
}

}  // namespace

int compare(CompareOptions const& options) {
  Side a("a", options.a), b("b", options.b);
  const std::vector<double> times = times_of(options, a, b);
  const bool words = options.output == Output::words;
  if (words) {
    const Scene *first = a.scene(), *second = b.scene();
    if (first) print_notes(first->ignored, first->warnings);
    const bool same =
        first && second && first->ignored == second->ignored && first->warnings == second->warnings;
    if (second && !same) print_notes(second->ignored, second->warnings);
  }

  Comparison comparison;
  Energies energyA, energyB;
  std::vector<double> perStepA, perStepB, ratios;
  const bool bothTimed = !a.recorded() && !b.recorded();
  const int rounds = a.recorded() && b.recorded() ? 1 : options.rounds;
  examples::Progress progress(std::max<long>(1, long(times.size()) * rounds));
  catch_interrupt();
  for (int round = 0; round < rounds && !was_interrupted(); ++round) {
    if (round > 0) a.again(), b.again();
    for (std::size_t i = 0; i < times.size() && !was_interrupted(); ++i) {
      // they take turns, so that what else the machine does meets both
      Side& first = (i + std::size_t(round)) % 2 ? b : a;
      first.advance(times[i]);
      (&first == &a ? b : a).advance(times[i]);
      if (round == 0 && !was_interrupted()) comparison.add(a.frame(times[i]), b.frame(times[i]));
      if (words) progress.at(long(times.size()) * round + long(i) + 1);
    }
    if (was_interrupted()) break;
    if (round == 0) energyA = energies_of(a), energyB = energies_of(b);
    perStepA.push_back(a.secondsPerStep());
    perStepB.push_back(b.secondsPerStep());
    ratios.push_back(b.secondsPerStep() / a.secondsPerStep());
  }
  if (was_interrupted()) throw Failure{interrupted, {"interrupted; nothing is compared"}};

  const double stepA = median(perStepA), stepB = median(perStepB), ratio = median(ratios);
  if (options.output == Output::json) {
    std::vector<Json> bodies;
    for (auto const& [path, d] : comparison.bodies) {
      Json body;
      body.set("path", path).set("points", d.points);
      if (d.problem.empty())
        body.set("rms", d.rms()).set("max", d.largest).set("maxAt", d.largestAt).set("rmsAtEnd", d.lastRms);
      else
        body.set("problem", d.problem);
      bodies.push_back(body);
    }
    auto side = [](SceneOptions const& o, Side& s, Energies const& e, double step) {
      Json json;
      json.set("scene", label(o))
          .set("record", s.recorded())
          .set("dt", s.recorded() ? std::nan("") : s.dt())
          .set("steps", s.steps())
          .set("secondsPerStep", step)
          .set("kineticEnergy", e.kinetic)
          .set("potentialEnergy", e.potential);
      return json;
    };
    Json json;
    json.set("a", side(options.a, a, energyA, stepA))
        .set("b", side(options.b, b, energyB, stepB))
        .set("frames", comparison.frames)
        .set("time", times.empty() ? std::nan("") : times.back())
        .set("rounds", rounds)
        .set("stepTimeRatio", ratio)
        .set("bodies", bodies)
        .set("onlyA", comparison.onlyA)
        .set("onlyB", comparison.onlyB);
    std::printf("%s\n", json.text().c_str());
    return ok;
  }
  if (!words) return ok;

  auto describe = [](char const* name, SceneOptions const& o, Side& s) {
    if (s.recorded())
      std::printf("%s: %s, a record\n", name, label(o).c_str());
    else
      std::printf("%s: %s, %ld steps of %g s\n", name, label(o).c_str(), s.steps(), s.dt());
  };
  describe("a", options.a, a);
  describe("b", options.b, b);
  std::printf("\n%-28s %8s %12s %12s %10s %12s\n",
              "distance of positions [m]",
              "points",
              "RMS",
              "largest",
              "at [s]",
              "RMS at end");
  for (auto const& [path, d] : comparison.bodies)
    if (d.problem.empty())
      std::printf("%-28s %8zu %12.4g %12.4g %10.4g %12.4g\n",
                  path.c_str(),
                  d.points,
                  d.rms(),
                  d.largest,
                  d.largestAt,
                  d.lastRms);
    else
      std::printf("%-28s not compared: %s\n", path.c_str(), d.problem.c_str());
  for (auto const& path : comparison.onlyA) std::printf("%-28s only in a\n", path.c_str());
  for (auto const& path : comparison.onlyB) std::printf("%-28s only in b\n", path.c_str());
  auto row = [](char const* name, double va, double vb, char const* extra = "") {
    auto number = [](double v) { return std::isfinite(v) ? digits(v) : std::string("-"); };
    std::printf("%-28s %14s %14s%s\n", name, number(va).c_str(), number(vb).c_str(), extra);
  };
  std::printf("\n%-28s %14s %14s\n", "at the end", "a", "b");
  row("kinetic energy [J]", energyA.kinetic, energyB.kinetic);
  row("energy of force fields [J]", energyA.potential, energyB.potential);
  auto cost = [&](char const* name, double costA, double costB) {
    std::string extra;
    if (bothTimed && std::isfinite(ratio)) {
      char words_[40];
      std::snprintf(words_, sizeof words_, "   b/a %.3f", ratio * (costB / stepB) / (costA / stepA));
      extra = words_;
    }
    row(name, costA, costB, extra.c_str());
  };
  cost("time a step [us]", stepA * 1e6, stepB * 1e6);
  cost("time a second [ms]", stepA / a.dt() * 1e3, stepB / b.dt() * 1e3);
  std::printf("compared at %zu times; a step is the median of %d rounds in which both take turns\n",
              comparison.frames,
              rounds);
  return ok;
}

}  // namespace cli
