// SPDX-License-Identifier: BSL-1.0
// States that are recorded and replayed, in runtime trees and scene files.
#include "scene/replay.hpp"

#include <sinew/runtime/from_typed.hpp>
#include <sinew/runtime/precompiled.hpp>

namespace test_replay {

using namespace sinew;
using files::TempFolder;
using replay::dt;
using replay::pulling;

namespace {

using Runtime = StandardSimulation;

template <class Sim>
std::string bits_of(Sim& sim) {
  std::string all;
  auto add = [&](auto const& v) {
    all.append(reinterpret_cast<char const*>(v.data()), v.size() * sizeof(v[0]));
  };
  const NoScope above;
  traverse(typename Sim::RootScope{sim.root(), above}, on<role::State>([&](auto& s, auto const&) {
             add(s.position);
             add(s.velocity);
           }));
  return all;
}
template <class Sim>
std::vector<std::string> run(Sim& sim, int steps) {
  std::vector<std::string> all{bits_of(sim)};
  for (int i = 0; i < steps; ++i) {
    sim.animate(dt);
    all.push_back(bits_of(sim));
  }
  return all;
}

ReadState<Rigid3d> keys() {
  const Quat<double> turned(Eigen::AngleAxisd(1.5, Eigen::Vector3d(1, 0, 1).normalized()));
  return {.keyTimes = {0, 0.3, 0.7},
          .keyPositions = {{{1, 0, 0}, Quat<double>(1, 0, 0, 0)},
                           {{1.2, 0.3, 0}, turned},
                           {{0.8, 0.5, 0.3}, turned}},
          .interpolation = Interpolation::cubic};
}

std::string scene_with(std::string_view tool) {
  return text(R"(<Node name="root" gravity="0 -9.81 0" dt="0.01">
  <Node name="tool">
    <MechanicalObject name="frame" template="Rigid3d" position="1 0 0  0 0 0 1"/>
    )",
              tool,
              R"(
    <Node name="tip"><MechanicalObject name="points" position="0 0.5 0"/><RigidMapping/></Node>
  </Node>
  <Node name="string">
    <EulerImplicitSolver/><CGLinearSolver iterations="50" tolerance="1e-12"/>
    <MechanicalObject name="points" position="0 0 0  0.5 0 0  1 0 0"/>
    <UniformMass vertexMass="0.1"/>
    <StiffSpringForceField springs="0 1 50 0.1 0.5  1 2 50 0.1 0.5"/>
    <FixedConstraint indices="0"/>
  </Node>
  <StiffSpringForceField object1="@tool/tip/points" object2="@string/points" springs="0 2 20 0.5 0.2"/>
</Node>)");
}
Runtime read(std::string const& path) { return start(read_scene<Standard>(path)); }
std::string error_of_scene(std::string_view tool) {
  return error_of([&] { start(parse_scene<Standard>("test.scn", scene_with(tool))); });
}
void says(std::string const& message, std::initializer_list<std::string_view> words) {
  for (std::string_view word : words) {
    INFO(message << "\n  should say: " << word);
    CHECK(message.find(word) != std::string::npos);
  }
}

}  // namespace

TEST_CASE("typed and runtime trees record and replay with the same bits") {
  TempFolder folder;
  auto record = [&](std::string_view name) {
    return pulling(keys(), WriteState<Rigid3d>{.filename = folder / name, .writeV = true});
  };
  auto typed = record("typed");
  Runtime runtime(to_runtime<Standard>(record("runtime").root()));
  typed.init(), runtime.init();
  const auto all = run(typed, 100);
  CHECK(run(runtime, 100) == all);
  typed.finish(), runtime.finish();
  CHECK(io::read_file(folder / "typed") == io::read_file(folder / "runtime"));

  auto replay = pulling(ReadState<Rigid3d>{.filename = {folder / "typed"}});
  Runtime other(to_runtime<Standard>(replay.root()));
  replay.init(), other.init();
  CHECK(run(replay, 100) == all);
  CHECK(run(other, 100) == all);
}

TEST_CASE("a scene file records, and another one replays from a file beside it") {
  TempFolder folder;
  const std::string record =
      folder.write("record.scn",
                   scene_with(text(R"(<ReadState keyTimes="0 0.3 0.7" interpolation="cubic"
                         keyPositions="1 0 0  0 0 0 1   1.2 0.3 0  0.6 0 0 0.8   0.8 0.5 0.3  0 0 0 1"/>
                      <WriteState filename=")",
                                   folder / "tool.state",
                                   R"(" writeX="1" writeV="true" writeF="0"/>)")));
  const std::string replay = folder.write(
      "replay.scn", scene_with(R"(<ReadState template="Rigid3d" filename="tool.state" printLog="0"/>)"));
  std::vector<std::string> all;
  {
    auto sim = read(record);
    all = run(sim, 90);
    // the end of the simulation completes the file
  }
  auto again = read(replay);
  CHECK(run(again, 90) == all);
}

TEST_CASE("a checkpoint goes on recording and replaying, with the bits of a whole run") {
  TempFolder folder;
  const std::string path = folder / "f", out = text("<WriteState writeV=\"1\" filename=\"", path, "\"/>");
  const std::string driven = R"(<ReadState keyTimes="0 0.3 0.7" interpolation="cubic"
      keyPositions="1 0 0  0 0 0 1   1.2 0.3 0  0.6 0 0 0.8   0.8 0.5 0.3  0 0 0 1"/>)";
  for (const bool period : {false, true}) {
    const std::string scene =
        scene_with(driven + (period ? files::replaced(out, "/>", " period=\"0.03\"/>") : out));
    std::vector<std::string> all;
    std::string file;
    {
      auto whole = start(parse_scene<Standard>("test.scn", scene));
      all = run(whole, 60);
      whole.finish();
      file = io::read_file(path);
    }
    std::string saved;
    {
      auto first = start(parse_scene<Standard>("test.scn", scene));
      run(first, 25);
      saved = scene_text(first, dt);
    }
    CHECK(saved.find(period ? "recorded=\"9\"" : "recorded=\"26\"") != saved.npos);
    auto second = start(parse_scene<Standard>("saved.scn", saved));
    CHECK(second.time() > 0.24);
    const auto rest = run(second, 35);
    CHECK(rest.front() == all[25]);
    CHECK(rest.back() == all.back());
    second.finish();
    CHECK(io::read_file(path) == file);
  }
}

TEST_CASE("a checkpoint of points on a prescribed way starts where they were") {
  const std::string scene = R"(<Node name="root" gravity="0 -9.81 0" dt="0.01">
    <EulerImplicitSolver/><CGLinearSolver iterations="50" tolerance="1e-12"/>
    <MechanicalObject position="0 0 0  0.5 0 0"/><UniformMass vertexMass="0.1"/>
    <StiffSpringForceField springs="0 1 50 0.1 0.5"/>
    <LinearMovementConstraint indices="0" keyTimes="0 1" movements="0 0 0  0 3 0"/>
  </Node>)";
  auto whole = start(parse_scene<Standard>("test.scn", scene));
  const auto all = run(whole, 60);
  auto first = start(parse_scene<Standard>("test.scn", scene));
  run(first, 25);
  auto second = start(parse_scene<Standard>("saved.scn", scene_text(first, dt)));
  const auto rest = run(second, 35);
  CHECK(rest.front() == all[25]);
  CHECK(rest.back() == all.back());
}

TEST_CASE("a scene that changes goes on recording and replaying") {
  TempFolder folder;
  auto typed = pulling(keys(), WriteState<Rigid3d>{.filename = folder / "f", .writeV = true});
  Runtime sim(to_runtime<Standard>(typed.root()));
  sim.init();
  run(sim, 10);
  sim.change([](RuntimeNode<Standard>& root) {
    root.addChild("more").add(MechanicalObject<Vec3d>{.position = {{5, 0, 0}}});
  });
  run(sim, 10);
  // a record that begins in the middle has no frame of the start, and takes nothing from an older file
  folder.write("g", "T= 0\n  X= 7 7 7\n");
  sim.change([&](RuntimeNode<Standard>& root) {
    root.find_node("more")->add(WriteState<Vec3d>{.filename = folder / "g"});
  });
  run(sim, 5);
  sim.finish();
  auto frames = io::read_state_file<double>(folder / "f", io::state_layout<Rigid3d>(1));
  CHECK(frames.times.size() == 26);
  frames = io::read_state_file<double>(folder / "g", io::state_layout<Vec3d>(1));
  REQUIRE(frames.times.size() == 5);
  CHECK(frames.times[0] == Approx(0.21));
  // a change that fails leaves the record as it is
  says(error_of([&] {
         sim.change([&](RuntimeNode<Standard>& root) {
           root.find_node("more")->add(WriteState<Vec3d>{.filename = folder / "none/g"});
         });
       }),
       {"/root/more: WriteState<Vec3d>", "there is no folder"});
  run(sim, 5);
  sim.finish();
  CHECK(io::read_state_file<double>(folder / "f", io::state_layout<Rigid3d>(1)).times.size() == 31);
}

TEST_CASE("what is wrong with ReadState and WriteState in a scene file is said with its place") {
  TempFolder folder;
  const std::string vec = folder.write("vec.state", "T= 0\n  X= 0 0 0\n");
  says(error_of_scene("<ReadState filename=\"nowhere.state\"/>"),
       {"test.scn:4:", "there is no file 'nowhere.state'"});
  says(error_of_scene("<ReadState/>"),
       {"test.scn:4:", "/root/tool: ReadState<Rigid3d>", "neither a file nor keys"});
  says(error_of_scene(text("<ReadState filename=\"", vec, "\"/>")),
       {"test.scn:4:", vec + ":2", "X= has 3 numbers"});
  says(error_of_scene("<ReadState template=\"Vec3d\" keyTimes=\"0\"/>"),
       {"test.scn:4:", "has the template Vec3d", "Rigid3d"});
  says(error_of_scene("<ReadState keyTimes=\"0\" keyPositions=\"0 0 0 0 0\"/>"),
       {"test.scn:4:", "keyPositions"});
  says(error_of_scene("<ReadState keyTimes=\"0\" interpolation=\"cubik\"/>"), {"did you mean 'cubic'"});
  says(error_of_scene("<ReadState keytimes=\"0\"/>"), {"did you mean 'keyTimes'"});
  says(error_of_scene("<WriteState/>"), {"test.scn:4:", "filename is empty"});
  says(error_of_scene("<Node name=\"n\"><MechanicalObject position=\"0 0 0\"/><RigidMapping/>"
                      "<ReadState keyTimes=\"0\" keyPositions=\"0 0 0\"/></Node>"),
       {"ReadState<Vec3d>", "acts on a mapped state"});
  auto lonely = [](std::string_view what) {
    return error_of(
        [&] { start(parse_scene<Standard>("test.scn", text("<Node name=\"root\">", what, "</Node>"))); });
  };
  says(lonely("<WriteState filename=\"f\"/>"), {"test.scn:1:", "has no state to act on"});
  says(lonely("<ReadState filename=\"f\"/>"), {"has no state to act on"});
  RuntimeNode<Standard> root;
  root.add(MechanicalObject<Rigid3d>{.position = {{}}});
  root.add(WriteState<Vec3d>{.filename = folder / "f"});
  Runtime sim(std::move(root));
  says(error_of([&] { sim.init(); }), {"other DataTypes than the state on which it acts (Vec3d on Rigid3d)"});
}

}  // namespace test_replay
