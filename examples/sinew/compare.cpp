// SPDX-License-Identifier: BSL-1.0
#include "distance.hpp"
#include "json.hpp"
#include "side.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace cli {

using sinew::text;

namespace {

// what is known of one side at the end
struct Measured {
  std::string label;
  bool recorded;
  double dt;
  long steps;
  double kinetic = std::nan(""), potential = std::nan("");  // [J]
  std::vector<double> stepTimes{};                          // [s], one a round

  double stepTime() const { return median(stepTimes); }

  static double median(std::vector<double> values) {
    if (values.empty()) return std::nan("");
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return n % 2 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
  }
};

struct Report {
  Comparison distances{};
  Measured a, b;
  int rounds;
  double lastTime;

  // of the time of a step
  double ratio() const {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < std::min(a.stepTimes.size(), b.stepTimes.size()); ++i)
      ratios.push_back(b.stepTimes[i] / a.stepTimes[i]);
    return Measured::median(ratios);
  }
};

std::string label(SceneOptions const& options) {
  std::string words = options.path;
  for (auto const& [path, value] : options.set) words += text(' ', path, '=', value);
  return words;
}

/// The times at which positions are compared: those of a record, or every so many of the longer steps.
std::vector<double> times_of(CompareOptions const& options, Side& a, Side& b) {
  std::vector<double> times;
  if (a.recorded() || b.recorded()) {
    auto const& frames = (a.recorded() ? a : b).frames();
    auto const& [limit, seconds, given] = options.duration;
    for (auto const& frame : frames)
      if (!given || (seconds > 0 ? frame.time - frames[0].time <= seconds * (1 + 1e-9)
                                 : frame.step - frames[0].step <= limit))
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

Measured measure(SceneOptions const& options, Side& side) {
  Measured m{label(options), side.recorded(), side.recorded() ? std::nan("") : side.dt(), side.steps()};
  if (Scene* scene = side.scene())
    m.kinetic = scene->simulation.kineticEnergy(), m.potential = scene->simulation.potentialEnergy();
  return m;
}

void stop_if_interrupted() {
  if (was_interrupted()) throw Failure{interrupted, {"interrupted; nothing is compared"}};
}

void print_json(Report const& report) {
  std::vector<Json> bodies;
  for (auto const& [path, d] : report.distances.bodies) {
    Json body;
    body.set("path", path).set("points", d.points);
    if (d.problem.empty())
      body.set("rms", d.rms()).set("max", d.largest).set("maxAt", d.largestAt).set("rmsAtEnd", d.lastRms);
    else
      body.set("problem", d.problem);
    bodies.push_back(body);
  }
  auto side = [](Measured const& m) {
    return Json()
        .set("scene", m.label)
        .set("record", m.recorded)
        .set("dt", m.dt)
        .set("steps", m.steps)
        .set("secondsPerStep", m.stepTime())
        .set("kineticEnergy", m.kinetic)
        .set("potentialEnergy", m.potential);
  };
  Json json;
  json.set("a", side(report.a))
      .set("b", side(report.b))
      .set("frames", report.distances.frames)
      .set("time", report.lastTime)
      .set("rounds", report.rounds)
      .set("stepTimeRatio", report.ratio())
      .set("bodies", bodies)
      .set("onlyA", report.distances.onlyA)
      .set("onlyB", report.distances.onlyB);
  std::printf("%s\n", json.text().c_str());
}

void print_distances(Comparison const& distances) {
  std::printf("\n%-28s %8s %12s %12s %10s %12s\n",
              "distance of positions [m]",
              "points",
              "RMS",
              "largest",
              "at [s]",
              "RMS at end");
  for (auto const& [path, d] : distances.bodies)
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
  for (auto const& path : distances.onlyA) std::printf("%-28s only in a\n", path.c_str());
  for (auto const& path : distances.onlyB) std::printf("%-28s only in b\n", path.c_str());
}

void print_table(Report const& report) {
  auto const& [distances, a, b, rounds, lastTime] = report;
  auto describe = [](char const* name, Measured const& m) {
    if (m.recorded)
      std::printf("%s: %s, a record\n", name, m.label.c_str());
    else
      std::printf("%s: %s, %ld steps of %g s\n", name, m.label.c_str(), m.steps, m.dt);
  };
  describe("a", a);
  describe("b", b);
  print_distances(distances);

  auto row = [](char const* name, double va, double vb, double ratio = std::nan("")) {
    std::printf("%-28s", name);
    for (const double v : {va, vb})
      if (std::isfinite(v))
        std::printf(" %14.6g", v);
      else
        std::printf(" %14s", "-");
    if (std::isfinite(ratio)) std::printf("   b/a %.3f", ratio);
    std::printf("\n");
  };
  const double ratio = report.ratio();
  std::printf("\n%-28s %14s %14s\n", "at the end", "a", "b");
  row("kinetic energy [J]", a.kinetic, b.kinetic);
  row("energy of force fields [J]", a.potential, b.potential);
  row("time a step [us]", a.stepTime() * 1e6, b.stepTime() * 1e6, ratio);
  row("time a second [ms]", a.stepTime() / a.dt * 1e3, b.stepTime() / b.dt * 1e3, ratio * a.dt / b.dt);
  std::printf("compared at %zu times; times of a step are medians of %d rounds in which both take turns\n",
              distances.frames,
              rounds);
}

}  // namespace

int compare(CompareOptions const& options) try {
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
  const int rounds = a.recorded() && b.recorded() ? 0 : options.rounds;
  examples::Progress progress(long(times.size()) + 2 * rounds);
  long done = 0;
  auto advanced = [&] {
    if (words) progress.at(++done);
    stop_if_interrupted();
  };

  // side by side, for the distance
  catch_interrupt();
  Comparison distances;
  for (const double time : times) {
    a.advance(time);
    b.advance(time);
    if (!was_interrupted()) distances.add(a.frame(time), b.frame(time));
    advanced();
  }
  Report report{std::move(distances), measure(options.a, a), measure(options.b, b), rounds, times.back()};

  // one after the other, for the time
  for (int round = 0; round < rounds; ++round)
    for (Side* side : {round % 2 ? &b : &a, round % 2 ? &a : &b}) {
      if (side->scene()) {
        side->again();
        side->advance(times.back());
        (side == &a ? report.a : report.b).stepTimes.push_back(side->secondsPerStep());
      }
      advanced();
    }

  if (options.output == Output::json)
    print_json(report);
  else if (words)
    print_table(report);
  return ok;
} catch (Failure const& failure) {
  if (options.output == Output::json)
    std::printf("%s\n", Json().set("errors", failure.messages).text().c_str());
  throw;
}

}  // namespace cli
