// SPDX-License-Identifier: BSL-1.0
#include "sweep_plan.hpp"

#include "csv.hpp"

#include "support/progress.hpp"

#include <sinew/io/state_file.hpp>
#include <sinew/runtime/xml_document.hpp>
#include <sinew/version.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <thread>

namespace cli {

using sinew::text;

namespace {

// what is measured of each run, beside what --measure asks for
const std::vector<std::string> always{"steps",
                                      "time",
                                      "converged",
                                      "warnings",
                                      "kineticEnergy",
                                      "potentialEnergy",
                                      "largestDisplacement",
                                      "seconds"};

std::string one_line(std::vector<std::string> const& messages) {
  std::string all;
  for (auto const& message : messages) all += text(all.empty() ? "" : "; ", message);
  std::replace_if(
      all.begin(), all.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
  return all;
}

std::string digest(std::string_view bytes) {
  char words[17];
  std::snprintf(words,
                sizeof words,
                "%016llx",
                static_cast<unsigned long long>(sinew::io::state_file::checksum(bytes)));
  return words;
}

void add_files(sinew::XmlElement const& element, std::set<sinew::XmlFile const*>& seen, std::string& to) {
  if (element.file && seen.insert(element.file.get()).second) to += text(digest(element.file->content), '\n');
  for (auto const& child : element.children) add_files(child, seen, to);
}

// a word of a shell
std::string shell_word(std::string_view word) {
  if (word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-+/:=,@%") ==
      word.npos)
    return std::string(word);
  std::string quoted = "'";
  for (const char c : word)
    if (c == '\'')
      quoted += "'\\''";
    else
      quoted += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  return quoted + '\'';
}

}  // namespace

SweepPlan::SweepPlan(SweepOptions const& asked)
    : options(asked), combinations(asked.set, asked.table), output(asked.file) {
  for (auto const& words : options.measure) measures_.emplace_back(words);
  for (auto const& path : combinations.paths())
    if (options.scene.dt > 0 && path.ends_with(".dt") && path.find('/') == path.npos)
      throw Failure{badUsage,
                    {text("--dt holds for all runs, and ", path, " for each its own; leave one out")}};
  if (output.empty()) {
    std::string name = options.scene.path.substr(options.scene.path.rfind('/') + 1);
    name = name.substr(0, name.rfind('.'));
    output = options.parts > 1 ? text(name, ".sweep.", options.part, "of", options.parts, ".csv")
                               : text(name, ".sweep.csv");
  }
  header.runs = combinations.size();
  header.command = command();
}

int SweepPlan::jobs() const {
  if (options.jobs > 0) return options.jobs;
  if (options.worker >= 0) return 1;
  const int cores = std::max(1, int(std::thread::hardware_concurrency()));
  return std::max(1, cores / std::max(1, options.threads));
}

std::vector<std::size_t> SweepPlan::ofPart() const {
  std::vector<std::size_t> runs;
  for (std::size_t run = std::size_t(options.part - 1); run < combinations.size();
       run += std::size_t(options.parts))
    runs.push_back(run);
  return runs;
}

std::string SweepPlan::probe() const {
  try {
    return probe(std::size_t(0));
  } catch (Failure const& failure) {
    blameAttribute(failure);
    try {
      // the values of the first run may be wrong, and those of others right
      return probe(std::nullopt);
    } catch (Failure const&) {
      throw failure;
    }
  }
}

void SweepPlan::know(std::vector<std::string> const& lines) {
  header.key = lines.at(0);
  auto& columns = header.columns;
  columns = {"run"};
  auto add = [&](auto begin, auto end) { columns.insert(columns.end(), begin, end); };
  add(combinations.paths().begin(), combinations.paths().end());
  add(always.begin(), always.end());
  add(lines.begin() + 1, lines.end());
  columns.emplace_back("error");
}

std::string SweepPlan::run(std::size_t run) const {
  std::vector<std::string> measured(measuredColumns());
  const std::string error = simulate(run, measured);
  return line(run, measured, error);
}

std::string SweepPlan::failed(std::size_t run, std::string const& error) const {
  return line(run, std::vector<std::string>(measuredColumns()), one_line({error}));
}

std::string SweepPlan::line(std::size_t run, std::vector<std::string> const& measured,
                            std::string const& error) const {
  std::string all = text(run + 1);
  for (auto const& value : combinations.values(run)) all += text(',', csv_field(value));
  for (auto const& value : measured) all += text(',', csv_field(value));
  return all + text(',', csv_field(error));
}

// without what does not change the table
std::string SweepPlan::command() const {
  std::string all = text("sinew sweep ", shell_word(options.scene.path));
  auto add = [&](std::string_view option, std::string_view value) {
    all += text(' ', option);
    if (!value.empty()) all += text(' ', shell_word(value));
  };
  for (auto const& [path, values] : options.set) add("--set", text(path, '=', values));
  if (!options.table.empty()) add("--table", options.table);
  for (auto const& data : options.scene.data) add("--data", data);
  addResults(add);
  return all;
}

// f(option, value) for those of which the results depend, beside the combinations
template <class F>
void SweepPlan::addResults(F&& f) const {
  auto number = [](double value) {
    std::string words;
    sinew::io::append_number(words, value);
    return words;
  };
  if (options.duration.time > 0)
    f("--time", number(options.duration.time));
  else
    f("--steps", std::to_string(options.duration.steps));
  if (options.scene.dt > 0) f("--dt", number(options.scene.dt));
  for (auto const& m : measures_) f("--measure", m.words);
  if (options.scene.lenient) f("--lenient", "");
}

SceneOptions SweepPlan::sceneOf(std::optional<std::size_t> run) const {
  SceneOptions scene = options.scene;
  scene.processes = jobs() * options.beside;
  if (!run) return scene;
  const auto values = combinations.values(*run);
  for (std::size_t i = 0; i < values.size(); ++i) scene.set.emplace_back(combinations.paths()[i], values[i]);
  return scene;
}

// an attribute that no component has is no matter of one run
void SweepPlan::blameAttribute(Failure const& failure) const {
  for (auto const& message : failure.messages)
    for (auto const& path : combinations.paths()) {
      const std::string attribute = path.substr(path.rfind('.') + 1);
      if (message.find(text("has no attribute '", attribute, '\'')) != message.npos)
        throw Failure{badUsage, {text("--set ", path, ": ", message)}};
    }
  if (failure.status == badUsage) throw failure;
}

std::string SweepPlan::probe(std::optional<std::size_t> run) const {
  const SceneOptions asked = sceneOf(run);
  auto source = read(asked);
  giveFiles(source.root, std::nullopt);
  const std::vector<std::string> files = source.files;
  Scene scene = start(std::move(source), asked);
  if (options.output == Output::words) print_notes(scene.ignored, scene.warnings);
  auto& simulation = scene.simulation;
  const auto frame = sinew::capture(simulation.root(), simulation.step(), simulation.time());
  Cells cells;
  for (auto const& m : measures_) {
    if (cells.empty()) simulation.updateVisual();
    add_measured(cells, m, scene, frame);
  }
  std::string lines = key(files) + '\n';
  std::set<std::string_view> names;
  for (auto const& cell : cells)
    if (names.insert(cell.first).second) lines += cell.first + '\n';
  return lines;
}

// of the content of all files, and of what is asked for
std::string SweepPlan::key(std::vector<std::string> const& files) const {
  std::string all = text("sinew " SINEW_VERSION "\n", combinations.words());
  addResults([&](std::string_view option, std::string_view value) { all += text(option, ' ', value, '\n'); });
  std::set<sinew::XmlFile const*> seen;
  const sinew::XmlElement root = sinew::XmlReader(options.scene.data).read(options.scene.path);
  add_files(root, seen, all);
  for (auto const& file : files) all += text(digest(sinew::io::read_file(file)), '\n');
  return digest(all);
}

// Components that write files have them in a folder of the run; where there is none, nowhere.
void SweepPlan::giveFiles(Node& node, std::optional<std::size_t> run) const {
  for (auto& entry : node.components())
    entry.component.visit<sinew::role::StepCallback>([&](auto& c) {
      if constexpr (requires { c.writer->frames(), c.filename; }) {
        if (c.filename.empty() || c.filename.starts_with("/dev/")) return;
        if (c.filename.starts_with('/'))
          throw Failure{
              badScene,
              {text(entry.origin.empty() ? options.scene.path : entry.origin,
                    ": ",
                    entry.component.name(),
                    ": filename is ",
                    c.filename,
                    ", and all runs would write it; give a relative name, which each has in a folder "
                    "of its own")}};
        c.filename = run ? text(folderOf(*run), '/', c.filename) : "/dev/null";
        if (run) writing([&] { sinew::io::make_folders(c.filename.substr(0, c.filename.rfind('/'))); });
      }
    });
  for (auto const& child : node.children()) giveFiles(*child, run);
}

// "pendulum.sweep.files/000012"
std::string SweepPlan::folderOf(std::size_t run) const {
  char number[24];
  std::snprintf(number, sizeof number, "%06zu", run + 1);
  const std::string stem = output.ends_with(".csv") ? output.substr(0, output.size() - 4) : output;
  return text(stem, ".files/", static_cast<char const*>(number));
}

std::string SweepPlan::simulate(std::size_t run, std::vector<std::string>& measured) const {
  try {
    const SceneOptions asked = sceneOf(run);
    auto source = read(asked);
    giveFiles(source.root, run);
    if (options.threads > 0) use_threads(source.root, options.threads);
    Scene scene = start(std::move(source), asked);
    return simulate(scene, measured);
  } catch (Failure const& failure) {
    return one_line(failure.messages);
  } catch (std::bad_alloc const&) {
    return "there is not enough memory; give fewer --jobs, or raise --max-memory";
  } catch (std::exception const& error) {
    return one_line({error.what()});
  }
}

std::string SweepPlan::simulate(Scene& scene, std::vector<std::string>& measured) const {
  auto& simulation = scene.simulation;
  const long steps = steps_of(options.duration, scene.dt);
  const auto start = sinew::capture(simulation.root(), simulation.step(), simulation.time());
  simulation.keepForces(std::any_of(measures_.begin(), measures_.end(), needs_forces));
  examples::Stopwatch stepping;
  std::string error;
  long done = 0;
  stepping.start();
  try {
    for (; done < steps; ++done) scene.animate();
  } catch (Failure const& failure) {
    error = one_line(failure.messages);
  }
  stepping.stop();
  measured[0] = std::to_string(done);
  measured[1] = cell_of(simulation.time());
  measured[2] = error.empty() && converged(scene) ? "1" : "0";
  measured[3] = std::to_string(long(simulation.warnings().list().size()) + simulation.warnings().leftOut());
  measured[7] = cell_of(stepping.seconds());
  if (error.empty()) {
    const double kinetic = simulation.kineticEnergy();
    if (!std::isfinite(kinetic)) {
      measured[2] = "0";
      error =
          text(scene.path,
               ": the kinetic energy is not a finite number: the simulation diverged; take a smaller dt, an "
               "implicit solver or smaller forces");
    } else {
      measured[4] = cell_of(kinetic);
      measured[5] = cell_of(simulation.potentialEnergy());
      const auto now = sinew::capture(simulation.root(), simulation.step(), simulation.time());
      measured[6] = cell_of(largest_displacement(start, now, ""));
      error = addMeasures(scene, start, measured);
    }
  }
  writing([&] { simulation.finish(); });
  return error;
}

std::string SweepPlan::addMeasures(Scene& scene, sinew::RecordedFrame const& start,
                                   std::vector<std::string>& measured) const {
  if (measures_.empty()) return {};
  scene.simulation.updateVisual();
  std::string error;
  Cells cells;
  for (auto const& m : measures_) {
    try {
      add_measured(cells, m, scene, start);
    } catch (Failure const& failure) {
      error = one_line(failure.messages);
    }
  }
  // a list may be shorter in one run; columns are found by their names
  const std::size_t first = combinations.paths().size() + 1;
  for (auto const& [name, value] : cells) {
    const auto column =
        std::find(header.columns.begin() + std::ptrdiff_t(first), header.columns.end() - 1, name);
    if (column + 1 == header.columns.end())
      error = text("--measure: ", name, " is not there in the first run, and the table has no column for it");
    else
      measured[std::size_t(column - header.columns.begin()) - first] = value;
  }
  return error;
}

}  // namespace cli
