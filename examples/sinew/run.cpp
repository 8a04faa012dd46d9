// SPDX-License-Identifier: BSL-1.0
#include "forces.hpp"
#include "frames.hpp"
#include "json.hpp"
#include "pictures.hpp"

#include "support/progress.hpp"

#include <sinew/io/output_file.hpp>
#include <sinew/runtime/record.hpp>
#include <sinew/scene/profile_report.hpp>

#include <sys/stat.h>

#include <cmath>
#include <cstdio>
#include <optional>

namespace cli {

namespace {

// what a run writes while it goes
class Outputs {
 public:
  Outputs(RunOptions const& options, Scene& scene) : options_(options), scene_(scene) {
    writing([&] {
      if (!options.vtk.empty()) {
        sinew::io::make_folders(options.vtk);
        pictures_.emplace(options.vtk, scene.simulation.root());
      }
      if (!options.png.empty() || !options.film.empty() || !options.gltf.empty())
        frames_.emplace(options, scene, 1 / (scene.dt * double(options.every)));
      if (!options.record.empty()) record_.emplace(options.record);
      if (!options.forces.empty()) forces_.emplace(options.forces);
      if (!options.save.empty()) mayWrite(options.save);
      if (!options.trace.empty()) mayWrite(options.trace);
    });
    scene.simulation.keepForces(!options.forces.empty() || (frames_ && frames_->needForces()));
    if (!options.profile && options.trace.empty()) return;
    // 13 MB; as a file 50 MB
    profile_.emplace(options.trace.empty() ? 0 : 1u << 19);
    scene.simulation.root().profileWith(&*profile_);
  }
  void add() {
    auto& simulation = scene_.simulation;
    writing([&] {
      if (pictures_) pictures_->add(simulation);
      if (frames_) frames_->add(simulation);
      if (record_) record_->add(sinew::capture(simulation.root(), simulation.step(), simulation.time()));
    });
  }
  /// What every step leaves.
  void addStep() {
    writing([&] {
      if (forces_) forces_->add(scene_.simulation);
      if (options_.saveEvery > 0 && scene_.simulation.step() % options_.saveEvery == 0)
        sinew::save_scene(scene_.simulation, scene_.dt, options_.save);
    });
  }
  /// Where the time has gone; null where nobody has asked.
  sinew::Profile const* profile() const { return profile_ ? &*profile_ : nullptr; }
  /// Completes all files and says which they are.
  std::vector<std::string> finish(bool good) {
    std::vector<std::string> files;
    writing([&] {
      if (pictures_) files = pictures_->paths();
      if (frames_)
        for (auto& file : frames_->finish()) files.push_back(std::move(file));
      if (record_) record_->finish(), files.push_back(options_.record);
      if (forces_) forces_->finish(), files.push_back(options_.forces);
      scene_.simulation.finish();
      addRecorded(scene_.simulation.root(), files);
      // what diverged is nothing to go on from
      if (good && !options_.save.empty()) {
        sinew::save_scene(scene_.simulation, scene_.dt, options_.save);
        files.push_back(options_.save);
      }
      if (!options_.trace.empty()) {
        sinew::io::write_file(options_.trace, sinew::profile_trace(*profile_, options_.scene.path));
        files.push_back(options_.trace);
      }
    });
    return files;
  }

 private:
  RunOptions const& options_;
  Scene& scene_;
  std::optional<Pictures> pictures_{};
  std::optional<Frames> frames_{};
  std::optional<sinew::RecordWriter> record_{};
  std::optional<ForcesFile> forces_{};
  std::optional<sinew::Profile> profile_{};

  // what components of the scene have written
  template <class Node>
  static void addRecorded(Node const& node, std::vector<std::string>& files) {
    for (auto const& entry : node.components())
      entry.component.template visit<sinew::role::StepCallback>([&](auto const& c) {
        if constexpr (requires { c.writer->frames(); })
          if (c.writer && c.writer->frames() > 0) files.push_back(c.filename);
      });
    for (auto const& child : node.children()) addRecorded(*child, files);
  }

  // finds out before a long run, not after it
  static void mayWrite(std::string const& path) {
    struct stat info;
    const std::string folder = path.substr(0, path.rfind('/') + 1);
    if (::stat(path.c_str(), &info) == 0 && S_ISDIR(info.st_mode))
      throw sinew::Error(path, "is a folder; name a file in it");
    if (::stat(folder.empty() ? "." : folder.c_str(), &info) != 0)
      throw sinew::Error(path,
                         sinew::text("cannot be written: there is no folder ", folder, "; create it first"));
    // a file is replaced by another one of its folder, a device is written to
    const bool device = ::stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode);
    if (::access(device ? path.c_str() : folder.empty() ? "." : folder.c_str(), W_OK) != 0)
      throw sinew::Error(path, "cannot be written: it is not allowed here; choose another file or folder");
  }
};

// what the steps of a scene warn of
class RunWarnings {
 public:
  explicit RunWarnings(Scene const& scene) : scene_(scene) {}
  /// Those that are new, as they come.
  void printNew() {
    auto const& list = warnings().list();
    for (; printed_ < list.size(); ++printed_) {
      if (isatty(2)) std::fprintf(stderr, "\n");
      std::fprintf(stderr, "warning: %s\n", located(scene_.path, list[printed_].text()).c_str());
    }
  }
  /// How often those were so that came again.
  void printCounts() const {
    for (auto const& w : warnings().list())
      if (w.count > 1) std::fprintf(stderr, "warning: %s\n", located(scene_.path, w.summary()).c_str());
    if (warnings().leftOut() > 0) std::fprintf(stderr, "warning: %s\n", leftOut().c_str());
  }
  /// Each once, with its count.
  std::vector<std::string> all() const {
    std::vector<std::string> lines;
    for (auto const& w : warnings().list())
      lines.push_back(
          located(scene_.path,
                  w.count == 1 ? w.text()
                               : sinew::text(w.text(), " (in ", w.count, " steps, to step ", w.last, ")")));
    if (warnings().leftOut() > 0) lines.push_back(leftOut());
    return lines;
  }

 private:
  Scene const& scene_;
  std::size_t printed_ = 0;

  sinew::StepWarnings const& warnings() const { return scene_.simulation.warnings(); }
  std::string leftOut() const {
    return sinew::text(scene_.path, ": ", warnings().leftOut(), " warnings more of other places");
  }
};

// the lines of a profile
std::vector<Json> profile_json(sinew::Profile const& profile) {
  std::vector<Json> all;
  for (auto const& line : sinew::profile_lines(profile)) {
    Json json;
    json.set("depth", line.depth).set(line.isPhase ? "phase" : "component", line.name);
    if (!line.isPhase) json.set("class", line.className);
    all.push_back(json.set("calls", line.calls).set("seconds", line.seconds).set("own", line.own));
  }
  return all;
}

// what a run comes to, as --json prints it; of a scene that was refused the errors alone
struct Summary {
  std::string scene{};
  Count size{};
  double dt = std::nan("");
  long steps = 0;
  double time = std::nan(""), seconds = time, kinetic = time, potential = time;
  std::vector<std::string> ignored{}, warnings{}, files{}, errors{};
  bool interrupted = false;

  Json json() const {
    const double rate = steps > 0 ? double(steps) / seconds : std::nan("");
    return Json()
        .set("scene", scene)
        .set("nodes", size.nodes)
        .set("components", size.components)
        .set("degreesOfFreedom", size.degreesOfFreedom)
        .set("dt", dt)
        .set("steps", steps)
        .set("time", time)
        .set("seconds", seconds)
        .set("stepsPerSecond", rate)
        .set("realTimeFactor", rate * dt)
        .set("kineticEnergy", kinetic)
        .set("potentialEnergy", potential)
        .set("ignored", ignored)
        .set("warnings", warnings)
        .set("files", files)
        .set("interrupted", interrupted)
        .set("errors", errors);
  }
};

Scene started(RunOptions const& options) {
  try {
    auto source = read(options.scene);
    if (options.threads > 0) use_threads(source.root, options.threads);
    return start(std::move(source), options.scene);
  } catch (Failure const& failure) {
    if (options.output == Output::json)
      std::printf("%s\n",
                  Summary{.scene = options.scene.path, .errors = failure.messages}.json().text().c_str());
    throw;
  }
}

}  // namespace

int run(RunOptions const& options) {
  Scene scene = started(options);
  auto& simulation = scene.simulation;
  const Count size = count(simulation.root());
  const long steps = steps_of(options.duration, scene.dt);
  const bool words = options.output == Output::words;
  if (words) {
    print_notes(scene.ignored, scene.warnings);
    std::printf("%s: %s\n", options.scene.path.c_str(), size.words().c_str());
    if (!options.duration.given)
      std::printf("%ld steps of %g s; --steps or --time simulates more\n", steps, scene.dt);
    std::fflush(stdout);
  }

  Outputs outputs(options, scene);
  RunWarnings warnings(scene);
  outputs.add();
  examples::Progress progress(std::max(steps, 1L));
  examples::Stopwatch stepping;
  std::optional<Failure> failure;
  catch_interrupt();
  long done = 0;
  while (done < steps && !was_interrupted() && !failure) {
    stepping.start();
    try {
      scene.animate();
    } catch (Failure const& f) {
      failure = f;
    }
    stepping.stop();
    if (words) warnings.printNew();
    if (failure) break;
    ++done;
    outputs.addStep();
    if (done % options.every == 0) outputs.add();
    if (words) progress.at(done);
  }
  if (words) warnings.printCounts();
  const bool stopped = done < steps && !failure;
  if (words && done < steps && isatty(2)) std::fprintf(stderr, "\n");
  double kinetic = std::nan(""), potential = kinetic;
  if (!failure) {
    kinetic = simulation.kineticEnergy(), potential = simulation.potentialEnergy();
    if (!std::isfinite(kinetic))
      failure =
          Failure{diverged,
                  {sinew::text(options.scene.path,
                               ": the kinetic energy is not a finite number: the simulation diverged; take "
                               "a smaller dt, an implicit solver or smaller forces")}};
  }
  const auto files = outputs.finish(!failure);

  const double seconds = stepping.seconds();
  const double rate = done > 0 ? double(done) / seconds : std::nan("");
  if (options.output == Output::json) {
    for (auto const& warning : warnings.all()) scene.warnings.push_back(warning);
    Json json = Summary{.scene = options.scene.path,
                        .size = size,
                        .dt = scene.dt,
                        .steps = done,
                        .time = simulation.time(),
                        .seconds = seconds,
                        .kinetic = kinetic,
                        .potential = potential,
                        .ignored = scene.ignored,
                        .warnings = scene.warnings,
                        .files = files,
                        .errors = failure ? failure->messages : std::vector<std::string>{},
                        .interrupted = stopped}
                    .json();
    if (options.profile) json.set("profile", profile_json(*outputs.profile()));
    std::printf("%s\n", json.text().c_str());
  } else if (words) {
    if (done > 0)
      std::printf("%ld steps of %g s in %.3f s: %.0f steps/s, %.3g times real time\n",
                  done,
                  scene.dt,
                  seconds,
                  rate,
                  rate * scene.dt);
    if (!failure)
      std::printf("at %g s: kinetic energy %.6g J, energy of the force fields %.6g J\n",
                  simulation.time(),
                  kinetic,
                  potential);
    if (options.profile) std::printf("\n%s\n", sinew::profile_table(*outputs.profile()).c_str());
    if (outputs.profile() && outputs.profile()->eventsLeftOut() > 0)
      std::printf("the trace has the first %zu calls; %ld later ones had no room\n",
                  outputs.profile()->eventCount(),
                  outputs.profile()->eventsLeftOut());
    for (auto const& file : files) std::printf("wrote %s\n", file.c_str());
    if (stopped) std::printf("interrupted; all files are complete\n");
  }
  if (failure) throw *failure;
  return stopped ? interrupted : ok;
}

}  // namespace cli
