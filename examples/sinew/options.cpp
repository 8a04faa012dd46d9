// SPDX-License-Identifier: BSL-1.0
#include "options.hpp"

#include <sinew/version.hpp>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <tuple>

namespace cli {

namespace {

constexpr char const* exitCodes =
    "Exit status: 0 all went well; 1 the scene or its data is wrong; 2 the command line is wrong;\n"
    "3 the simulation diverged; 4 a file could not be written; 130 interrupted by Ctrl-C, with all files "
    "complete.\n"
    "Mistakes in a scene are reported on standard error as file:line:column: message.";

// "path.attribute=value"
Settings settings_of(std::vector<std::string> const& words, std::string const& option) {
  Settings settings;
  for (auto const& word : words) {
    const std::size_t equals = word.find('=');
    if (equals == word.npos || word.substr(0, equals).find('.') == word.npos)
      throw CLI::ValidationError(
          option,
          "'" + word + "' is not of the form path.attribute=value, as in liver/fem.youngModulus=1000");
    settings.emplace_back(word.substr(0, equals), word.substr(equals + 1));
  }
  return settings;
}

// a number that the environment has
std::optional<long> environment_number(char const* name) {
  char const* const word = std::getenv(name);
  char* end = nullptr;
  const long value = word ? std::strtol(word, &end, 10) : 0;
  if (!word || end == word || *end) return {};
  return value;
}
// which part the job is of an array of Slurm or Grid Engine
std::pair<int, int> part_of_array() {
  struct Names {
    char const *task, *first, *last, *step, *count;
  };
  for (Names const& n : {Names{"SLURM_ARRAY_TASK_ID",
                               "SLURM_ARRAY_TASK_MIN",
                               "SLURM_ARRAY_TASK_MAX",
                               "SLURM_ARRAY_TASK_STEP",
                               "SLURM_ARRAY_TASK_COUNT"},
                         Names{"SGE_TASK_ID", "SGE_TASK_FIRST", "SGE_TASK_LAST", "SGE_TASK_STEPSIZE", ""}}) {
    const auto task = environment_number(n.task), first = environment_number(n.first),
               last = environment_number(n.last);
    if (!task || !first || !last) continue;
    const long step = std::max(1L, environment_number(n.step).value_or(1));
    const long parts = (*last - *first) / step + 1, part = (*task - *first) / step + 1;
    if (environment_number(n.count).value_or(parts) != parts || part < 1 || part > parts || parts > 9999999)
      throw CLI::ValidationError("--part",
                                 "the numbers of this job array are no range from first to last, so that it "
                                 "does not say which part job " +
                                     std::to_string(*task) + " is; give --part I/N");
    return {int(part), int(parts)};
  }
  throw CLI::ValidationError(
      "--part",
      "'array' asks Slurm or Grid Engine which job of an array this is, and there is none here; give --part "
      "I/N, as in 3/10");
}

// "3/10", or "array"
std::pair<int, int> part_of(std::string const& word) {
  if (word == "array") return part_of_array();
  int part = 0, parts = 0, end = 0;
  if (std::sscanf(word.c_str(), "%7d/%7d%n", &part, &parts, &end) != 2 || std::size_t(end) != word.size() ||
      part < 1 || part > parts)
    throw CLI::ValidationError(
        "--part", "'" + word + "' is not of the form I/N, as in 3/10: parts are numbered from 1 to N");
  return {part, parts};
}

// "1280x960"
std::pair<int, int> size_of(std::string const& word) {
  int width = 0, height = 0, end = 0;
  if (std::sscanf(word.c_str(), "%5dx%5d%n", &width, &height, &end) != 2 || std::size_t(end) != word.size() ||
      width < 1 || height < 1)
    throw CLI::ValidationError("--size", "'" + word + "' is not of the form WIDTHxHEIGHT, as in 1280x960");
  return {width, height};
}

std::string seconds(std::string const& word) {
  try {
    std::size_t end = 0;
    const double value = std::stod(word, &end);
    if (end == word.size() && std::isfinite(value) && value > 0) return {};
  } catch (std::exception const&) {
  }
  return "'" + word + "' is not a number of seconds greater than 0";
}
CLI::Validator positive_seconds() { return CLI::Validator(seconds, "SECONDS"); }
CLI::Validator at_least(long low) { return CLI::Validator(CLI::Range(low, 1000000000000L)).description("N"); }

struct SceneWords {
  std::vector<std::string> set{};
  void addTo(CLI::App& app, SceneOptions& scene, bool withDt) {
    app.add_option(
           "--set", set, "Replace a value of the scene, as in liver/fem.youngModulus=1000; repeatable")
        ->type_name("PATH.ATTRIBUTE=VALUE")
        ->allow_extra_args(false);
    addRest(app, scene, withDt);
  }
  static void addRest(CLI::App& app, SceneOptions& scene, bool withDt) {
    app.add_option("--data", scene.data, "Folder where files are looked for that the scene names; repeatable")
        ->type_name("DIR")
        ->check(CLI::ExistingDirectory.description(""))
        ->allow_extra_args(false);
    app.add_option(
           "--max-memory",
           scene.maxMemory,
           "Memory that may be used, as in 500M or 16G (default: what is free now, and 512M for a grid)")
        ->type_name("SIZE")
        ->transform(CLI::AsSizeValue(true).description(""));
    app.add_flag("--lenient", scene.lenient, "Leave out components of unknown classes, with a warning");
    if (withDt)
      app.add_option("--dt", scene.dt, "Seconds a step takes (default: dt of the scene)")
          ->type_name("SECONDS")
          ->check(positive_seconds().description(""));
  }
};

void add_duration(CLI::App& app, Duration& duration) {
  auto* steps = app.add_option("--steps", duration.steps, "How many steps to simulate (default 100)")
                    ->type_name("N")
                    ->check(at_least(0).description(""));
  auto* time = app.add_option("--time", duration.time, "How many seconds to simulate, instead of --steps")
                   ->type_name("SECONDS")
                   ->check(positive_seconds().description(""));
  steps->excludes(time);
}

void add_seen(CLI::App& app, SeenOptions& seen) {
  app.add_option("--colour,--color",
                 seen.colour,
                 "What the colours show: displacement, speed, vonMises, strainEnergy or stretch")
      ->type_name("QUANTITY");
  app.add_option(
         "--range", seen.range, "Values at both ends of the colours, as in 0:5000 (default: those there are)")
      ->type_name("LOW:HIGH");
  app.add_option("--arrows",
                 seen.arrows,
                 "Arrows, apart by commas: velocities, forces, reactions, contacts, attachments")
      ->type_name("KINDS")
      ->delimiter(',')
      ->allow_extra_args(false);
  constexpr char const* things =
      "visuals, states, collision, boxes, springs, constraints, normals, wireframe, axes, grid, legend, "
      "shadows, occlusion";
  app.add_option("--show", seen.show, std::string("What to show besides, apart by commas: ") + things)
      ->type_name("THINGS")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option(
         "--hide", seen.hide, "What of these, or which bodies by the paths of their nodes, not to show")
      ->type_name("THINGS")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option("--box-level",
                 seen.boxLevel,
                 "Of the boxes of --show boxes those of one level: 0 is around a model, 1 its halves, ...")
      ->type_name("K")
      ->check(at_least(0).description(""));
  app.add_option("--clip", seen.clip, "Plane that cuts bodies open: what is seen has X*x + Y*y + Z*z <= D")
      ->type_name("\"X Y Z D\"");
  app.add_option("--camera",
                 seen.camera,
                 "Where the camera stands, and where it looks (default: at all of the scene)")
      ->type_name("\"X Y Z  X Y Z\"");
}

void add_output(CLI::App& app, bool& quiet, bool& json) {
  auto* q = app.add_flag("--quiet", quiet, "Print errors only");
  auto* j = app.add_flag("--json", json, "Print the result as one JSON object");
  q->excludes(j);
}
Output output_of(bool quiet, bool json) {
  return json ? Output::json : quiet ? Output::quiet : Output::words;
}

}  // namespace

Options read_options(int argc, char** argv, int& status) {
  Options o;
  CLI::App app{
      "sinew simulates scenes that are written in SOFA's XML: soft tissue, springs, rigid bodies.\n"
      "Try:  sinew run scene.scn --vtk out   and open the .pvd files in 'out' with ParaView.\n"
      "'sinew COMMAND --help' explains a command."};
  app.name("sinew");
  app.set_version_flag("--version", "sinew " SINEW_VERSION);
  app.require_subcommand(1);
  app.footer(exitCodes);
  app.failure_message(CLI::FailureMessage::simple);

  SceneWords runWords, viewWords, serveWords, checkWords, bakeWords, bothWords;
  bool quiet = false, json = false, compareQuiet = false, compareJson = false;
  std::string size;

  auto* run = app.add_subcommand("run", "Simulate a scene");
  run->footer(
      "A file that --save wrote is a scene too: running it goes on from there, bit by bit.\n"
      "Example:  sinew run liver.scn --time 2 --vtk out --every 5 --set Liver/FEM.youngModulus=5000");
  run->add_option("scene", o.run.scene.path, "Scene file")->type_name("FILE")->required();
  add_duration(*run, o.run.duration);
  runWords.addTo(*run, o.run.scene, true);
  run->add_option("--vtk",
                  o.run.vtk,
                  "Folder for pictures: a .pvd series, which ParaView opens, of each visual model and of "
                  "each body without one")
      ->type_name("DIR");
  run->add_option("--png", o.run.png, "Folder for pictures as PNG files: 000000.png, 000001.png and so on")
      ->type_name("DIR");
  run->add_option("--film", o.run.film, "File for the pictures as a film (.mp4), which ffmpeg makes")
      ->type_name("FILE");
  run->add_option(
         "--gltf",
         o.run.gltf,
         "File for what is seen over time, in three dimensions (.glb), which viewers and browsers open")
      ->type_name("FILE");
  run->add_option("--size", size, "Width and height of these pictures in pixels (default 1280x960)")
      ->type_name("WxH");
  add_seen(*run, o.run.seen);
  run->add_option(
         "--record", o.run.record, "File for positions and velocities of all bodies over time, as text")
      ->type_name("FILE");
  run->add_option(
         "--forces",
         o.run.forces,
         "File for the forces of each step as a table (CSV): of contacts and attachments on both bodies, of "
         "constraints on each point that they hold, and all together on rigid bodies; pictures have them, "
         "too")
      ->type_name("FILE");
  run->add_option("--every", o.run.every, "Steps from one picture and recorded state to the next (default 1)")
      ->type_name("K")
      ->check(at_least(1).description(""));
  auto* save = run->add_option("--save", o.run.save, "File for the scene as it is at the end, to go on from")
                   ->type_name("FILE");
  run->add_option("--save-every", o.run.saveEvery, "Write that file every K steps, too")
      ->type_name("K")
      ->needs(save)
      ->check(at_least(1).description(""));
  run->add_option("--threads",
                  o.run.threads,
                  "Threads that work, instead of those that the scene asks for; the results are the same")
      ->type_name("N")
      ->check(CLI::Range(1, 256).description(""));
  run->add_flag("--mpi",
                o.run.mpi,
                "Simulate in several processes, which mpirun has started: mpirun -n 4 sinew run FILE --mpi");
  run->add_option("--patience",
                  o.run.patience,
                  "Seconds after which one of them that waits for another ends the run (default 300)")
      ->type_name("SECONDS")
      ->check(positive_seconds().description(""));
  auto* profile = run->add_flag("--profile", o.run.profile, "Print where the time of the steps goes");
  run->add_option("--trace",
                  o.run.trace,
                  "File for the times of all calls, which ui.perfetto.dev and chrome://tracing open")
      ->type_name("FILE");
  add_output(*run, quiet, json);
  profile->excludes("--quiet");

  auto* view = app.add_subcommand("view", "Show a scene in a window, run it there and pull its bodies");
  view->footer("Example:  sinew view liver.scn");
  view->add_option("scene", o.view.scene.path, "Scene file")->type_name("FILE")->required();
  viewWords.addTo(*view, o.view.scene, true);
  add_seen(*view, o.view.seen);

  auto* serve = app.add_subcommand("serve", "Show a scene in browsers, run it there and pull its bodies");
  serve->footer("Example:  sinew serve liver.scn   and open the link that it prints");
  serve->add_option("scene", o.serve.scene.path, "Scene file")->type_name("FILE")->required();
  serveWords.addTo(*serve, o.serve.scene, true);
  serve->add_option("--port", o.serve.port, "Port of the link (default 8765; 0: any that is free)")
      ->type_name("N")
      ->check(CLI::Range(0, 65535).description(""));
  serve
      ->add_option("--address",
                   o.serve.address,
                   "Address to listen at (default 127.0.0.1, this machine; 0.0.0.0 lets others in)")
      ->type_name("ADDRESS");
  serve->add_option("--clients", o.serve.clients, "Browsers that may look at a time (default 16)")
      ->type_name("N")
      ->check(CLI::Range(1, 1000).description(""));
  serve->add_option("--page", o.serve.page, "Folder of the page (default: where it was built or installed)")
      ->type_name("DIR")
      ->check(CLI::ExistingDirectory.description(""));

  auto* check = app.add_subcommand("check", "Find all mistakes in a scene, without simulating it");
  check->footer("Example:  sinew check liver.scn");
  check->add_option("scene", o.check.scene.path, "Scene file")->type_name("FILE")->required();
  checkWords.addTo(*check, o.check.scene, false);
  check->add_flag("--quiet", o.check.quiet, "Print errors only");

  auto* list = app.add_subcommand("list", "Show the components that scenes may have, or explain one");
  list->footer(
      "Examples:  sinew list   sinew list TetrahedronFEMForceField   sinew list --markdown reference");
  auto* component = list->add_option("component", o.list.component, "Class to explain, by one of its names")
                        ->type_name("NAME");
  list->add_option("--markdown", o.list.markdown, "Folder for the reference of all components, a page each")
      ->type_name("FOLDER")
      ->excludes(component);
  list->add_option("--headers", o.list.headers, "Folder of Sinew's headers, whose comments the pages have")
      ->type_name("FOLDER")
      ->capture_default_str();
  list->add_option("--scenes", o.list.scenes, "Folder of Sinew's scenes, whose data files the examples read")
      ->type_name("FOLDER")
      ->capture_default_str();

  auto* bake = app.add_subcommand("bake", "Write a scene as C++, which runs faster than its file");
  bake->footer("Example:  sinew bake liver.scn -o liver.hpp");
  bake->add_option("scene", o.bake.scene.path, "Scene file")->type_name("FILE")->required();
  bake->add_option("-o,--output", o.bake.output, "Header to write")->type_name("FILE")->required();
  bake->add_option("--name", o.bake.name, "Name of the function that makes the scene (default: scene)")
      ->type_name("NAME");
  bake->add_flag("--embed", o.bake.embed, "Put the content of data files into the header");
  bakeWords.addTo(*bake, o.bake.scene, false);

  auto* compare = app.add_subcommand("compare", "Run two scenes, or two variants of one, and compare them");
  compare->footer(
      "Bodies of the same path are compared; a file of 'sinew run --record' may stand for a scene.\n"
      "Examples:  sinew compare a.scn b.scn --time 1\n"
      "           sinew compare liver.scn --set-b Liver/FEM.method=polar\n"
      "           sinew compare liver.scn --set-b root.dt=0.001");
  compare->add_option("a", o.compare.a.path, "First scene file")->type_name("FILE")->required();
  compare->add_option("b", o.compare.b.path, "Second scene file (default: the first)")->type_name("FILE");
  add_duration(*compare, o.compare.duration);
  bothWords.addTo(*compare, o.compare.a, true);
  std::vector<std::string> setA, setB;
  compare->add_option("--set-a", setA, "The same as --set, for the first scene only")
      ->type_name("PATH.ATTRIBUTE=VALUE")
      ->allow_extra_args(false);
  compare->add_option("--set-b", setB, "The same as --set, for the second scene only")
      ->type_name("PATH.ATTRIBUTE=VALUE")
      ->allow_extra_args(false);
  compare
      ->add_option(
          "--every", o.compare.every, "Steps from one comparison of positions to the next (default 1)")
      ->type_name("K")
      ->check(at_least(1).description(""));
  compare
      ->add_option(
          "--rounds", o.compare.rounds, "How often to run both again, for the time a step takes (default 3)")
      ->type_name("N")
      ->check(CLI::Range(0, 1000).description(""));
  add_output(*compare, compareQuiet, compareJson);

  auto* sweep = app.add_subcommand("sweep", "Run a scene for many values of its attributes, into one table");
  sweep->footer(
      "Each value of one --set runs with each of the others. The same command again goes on with what is "
      "missing.\n"
      "Examples:  sinew sweep liver.scn --set Liver/FEM.youngModulus=log:1e3:1e5:9 --time 2\n"
      "           sinew sweep liver.scn --set Liver/FEM.youngModulus=1000:5000:1000 --set "
      "root.gravity='0 -9.81 0,0 0 0'\n"
      "                       --measure Liver/dofs.position[12]\n"
      "As a job array, then in one table:\n"
      "           sinew sweep liver.scn ... --part array\n"
      "           sinew sweep --merge liver.sweep.*of*.csv --output liver.csv\n"
      "On several machines, into one table:\n"
      "           mpirun -n 64 sinew sweep liver.scn ... --mpi");
  sweep->add_option("scene", o.sweep.scene.path, "Scene file")->type_name("FILE");
  std::vector<std::string> sweepSet;
  std::string part;
  sweep
      ->add_option(
          "--set",
          sweepSet,
          "Values that an attribute takes: 1:10:2 is from 1 to 10 by 2, log:1e3:1e6:4 and lin:0:1:5 so "
          "many between two ends, and others stand apart by commas, as in polar,large; repeatable")
      ->type_name("PATH.ATTRIBUTE=VALUES")
      ->allow_extra_args(false);
  sweep
      ->add_option("--table",
                   o.sweep.table,
                   "File of combinations (CSV): a line of attributes, then their values, a line for each run")
      ->type_name("FILE");
  sweep
      ->add_option("--measure",
                   o.sweep.measure,
                   "What else the table has of the end of each run: a field of a component, as in "
                   "liver/dofs.position[3], residual of a solver, or kineticEnergy, potentialEnergy, "
                   "largestDisplacement or reaction of a node; repeatable")
      ->type_name("PATH.NAME")
      ->allow_extra_args(false);
  sweep
      ->add_option("-o,--output",
                   o.sweep.file,
                   "Table that is written (CSV), or gone on with (default: SCENE.sweep.csv, in this folder)")
      ->type_name("FILE");
  add_duration(*sweep, o.sweep.duration);
  SceneWords::addRest(*sweep, o.sweep.scene, true);
  sweep
      ->add_option(
          "--jobs", o.sweep.jobs, "Processes that run at a time (default: as many as there are cores)")
      ->type_name("N")
      ->check(CLI::Range(1, 4096).description(""));
  sweep
      ->add_option("--threads",
                   o.sweep.threads,
                   "Threads of each run, instead of those that the scene asks for; the results are the same")
      ->type_name("N")
      ->check(CLI::Range(1, 256).description(""));
  sweep
      ->add_option("--part",
                   part,
                   "Run only every N-th combination, from the I-th on; 'array': as this job of an array of "
                   "Slurm or Grid Engine")
      ->type_name("I/N");
  sweep->add_flag(
      "--mpi",
      o.sweep.mpi,
      "Run on the ranks that mpirun has started, --jobs at a time on each (default 1), into one table");
  sweep->add_option("--worker", o.sweep.worker)->group("");
  sweep->add_option("--beside", o.sweep.beside)->group("");
  sweep->add_option("--merge", o.sweep.merge, "Put tables of parts together, and run nothing")
      ->type_name("FILES")
      ->expected(1, 1'000'000);
  sweep->add_option("--time-limit", o.sweep.timeLimit, "Seconds after which a run is ended, with an error")
      ->type_name("SECONDS")
      ->check(positive_seconds().description(""));
  sweep->add_flag("--retry", o.sweep.retry, "Run those again that had an error");
  bool sweepQuiet = false, sweepJson = false;
  add_output(*sweep, sweepQuiet, sweepJson);

  try {
    app.parse(argc, argv);
    o.run.scene.set = settings_of(runWords.set, "--set");
    if (!size.empty()) std::tie(o.run.width, o.run.height) = size_of(size);
    o.view.scene.set = settings_of(viewWords.set, "--set");
    o.serve.scene.set = settings_of(serveWords.set, "--set");
    o.check.scene.set = settings_of(checkWords.set, "--set");
    o.bake.scene.set = settings_of(bakeWords.set, "--set");
    CompareOptions& c = o.compare;
    const bool twoScenes = !c.b.path.empty();
    c.b.lenient = c.a.lenient;
    c.b.data = c.a.data;
    c.b.dt = c.a.dt;
    c.b.maxMemory = c.a.maxMemory;
    c.a.set = c.b.set = settings_of(bothWords.set, "--set");
    for (auto& s : settings_of(setA, "--set-a")) c.a.set.push_back(std::move(s));
    for (auto& s : settings_of(setB, "--set-b")) c.b.set.push_back(std::move(s));
    if (compare->parsed() && !twoScenes) {
      if (setA.empty() && setB.empty())
        throw CLI::ValidationError("compare", "give a second scene, or --set-a or --set-b");
      c.b.path = c.a.path;
    }
    o.sweep.set = settings_of(sweepSet, "--set");
    if (!part.empty()) std::tie(o.sweep.part, o.sweep.parts) = part_of(part);
    if (sweep->parsed() && !o.sweep.merge.empty()) {
      for (char const* option : {"scene", "--set", "--table", "--measure", "--part", "--retry", "--mpi"})
        if (sweep->count(option) > 0)
          throw CLI::ValidationError("--merge",
                                     std::string("runs nothing, and takes no ") + option + "; leave it out");
      if (o.sweep.file.empty())
        throw CLI::ValidationError("--merge", "name the table that is written: --output FILE");
    } else if (sweep->parsed()) {
      if (o.sweep.scene.path.empty()) throw CLI::RequiredError("scene");
      if (o.sweep.set.empty() && o.sweep.table.empty())
        throw CLI::ValidationError(
            "sweep", "give --set, as in --set liver/fem.youngModulus=1000:5000:1000, or --table");
    }
  } catch (CLI::ParseError const& e) {
    status = app.exit(e) == 0 ? ok : badUsage;
    return {};
  }
  o.run.output = output_of(quiet, json);
  o.compare.output = output_of(compareQuiet, compareJson);
  auto given = [](CLI::App* command) { return command->count("--steps") + command->count("--time") > 0; };
  o.run.duration.given = given(run);
  o.compare.duration.given = given(compare);
  o.sweep.output = o.sweep.worker > 0 ? Output::quiet : output_of(sweepQuiet, sweepJson);
  o.sweep.duration.given = given(sweep);
  o.command = run->parsed()     ? Command::run
              : view->parsed()  ? Command::view
              : serve->parsed() ? Command::serve
              : check->parsed() ? Command::check
              : list->parsed()  ? Command::list
              : bake->parsed()  ? Command::bake
              : sweep->parsed() ? Command::sweep
                                : Command::compare;
  return o;
}

}  // namespace cli
