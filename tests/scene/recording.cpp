// SPDX-License-Identifier: BSL-1.0
// States that are recorded, in typed scenes.
#include "replay.hpp"

namespace test_recording {

using namespace replay;

TEST_CASE("bodies in the plane are recorded without gaps between their numbers") {
  TempFolder folder;
  Rigid2d::VecCoord x(2);
  x[0].center = {1, 2}, x[0].orientation = 0.5, x[1].center = {3, 4}, x[1].orientation = -7;
  for (const auto format : {StateFormat::text, StateFormat::binary}) {
    auto sim = Simulation{node<"root">(
        MechanicalObject<Rigid2d>{.position = x},
        WriteState<Rigid2d>{
            .filename = folder / "f", .writeX0 = true, .writeV = true, .time = {0}, .format = format})};
    sim.init();
    sim.animate(dt);
    sim.finish();
    if (format == StateFormat::text)
      CHECK(io::read_file(folder / "f") ==
            "T= 0\n  X0= 1 2 0.5 3 4 -7\n  X= 1 2 0.5 3 4 -7\n  V= 0 0 0 0 0 0\n");
    auto replay = Simulation{node<"root">(MechanicalObject<Rigid2d>{.position = Rigid2d::VecCoord(2)},
                                          ReadState<Rigid2d>{.filename = {folder / "f"}})};
    replay.init();
    CHECK(replay.root().state().position == x);
  }
}

TEST_CASE("a record has the start and every step, or the times that are asked for") {
  TempFolder folder;
  auto times = [&](WriteState<Rigid3d> writer, int steps) {
    writer.filename = folder / "f";
    auto sim = pulling(keys(), writer);
    sim.init();
    for (int i = 0; i < steps; ++i) sim.animate(dt);
    sim.finish();
    auto frames = io::read_state_file<double>(folder / "f", io::state_layout<Rigid3d>(1));
    CHECK(frames.positions.size() == 7 * frames.times.size());
    return frames.times;
  };
  auto near = [](std::vector<double> const& a, std::vector<double> const& b) {
    CHECK(a.size() == b.size());
    for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) CHECK(a[k] == Approx(b[k]).margin(1e-12));
  };
  near(times({}, 3), {0, 0.01, 0.02, 0.03});
  near(times({.time = {0}}, 5), {0});
  near(times({.time = {0.02, 0.05}}, 8), {0.02, 0.05});
  near(times({.period = 0.03}, 10), {0, 0.03, 0.06, 0.09});
  near(times({.time = {0.02}, .period = 0.05}, 14), {0.02, 0.07, 0.12});
  near(times({.time = {0.015}}, 5), {0.02});  // in the first step that reaches it
  near(times({.period = 1e-300}, 3), {0, 0.01, 0.02, 0.03});
  near(times({.time = {0.002, 0.003, 0.004}}, 3), {0.01});
}

TEST_CASE("a record ends when the kinetic energy rests") {
  // a damped spring: the energy sinks below 1e-3 J in a few tenths of a second
  TempFolder folder;
  auto sim = Simulation{node<"root">(
      EulerImplicitSolver{.rayleighMass = 10},
      CGLinearSolver<>{},
      MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}}, .velocity = {{1, 0, 0}, {-1, 0, 0}}},
      UniformMass<Vec3d>{.vertexMass = 1},
      StiffSpringForceField<Vec3d>{{{0, 1, 10, 1, 1}}},
      WriteState<Vec3d>{.filename = folder / "f", .stopAt = 1e-3, .keperiod = 0.05})};
  sim.init();
  for (int i = 0; i < 300; ++i) sim.animate(dt);
  sim.finish();
  const auto frames = io::read_state_file<double>(folder / "f", io::state_layout<Vec3d>(2));
  CHECK(frames.times.back() > 0.2);
  CHECK(frames.times.back() < 1.5);
}

TEST_CASE("a reset starts the record anew, and a copy may go on where the scene was") {
  TempFolder folder;
  auto read = [&] { return io::read_state_file<double>(folder / "f", io::state_layout<Rigid3d>(1)); };
  auto sim = pulling(keys(), WriteState<Rigid3d>{.filename = folder / "f", .writeV = true});
  sim.init();
  const auto all = run(sim, 40);
  sim.reset();
  run(sim, 10);
  sim.finish();
  CHECK(read().times.size() == 11);
  // undo: what was recorded after the copy was made goes
  sim.reset();
  run(sim, 20);
  auto copy = sim;
  run(sim, 7);
  sim = copy;
  CHECK(run(sim, 20).back() == all.back());
  sim.finish();
  CHECK(read().times.size() == 41);
  // but not both in turns
  run(copy, 1);
  says([&] { run(sim, 1); }, {"/root/tool: WriteState<Rigid3d>", "another copy of this scene"});
}

TEST_CASE("a checkpoint goes on recording and replaying") {
  TempFolder folder;
  const std::string path = folder / "f";
  auto whole = pulling(keys(), WriteState<Rigid3d>{.filename = path, .writeV = true});
  whole.init();
  const auto all = run(whole, 60);
  auto const& state = whole.at<"tool">().state();
  // what a checkpoint holds, after 25 steps of another run
  auto begun = pulling(keys(), WriteState<Rigid3d>{.filename = path, .writeV = true});
  begun.init();
  run(begun, 25);
  auto saved =
      pulling(keys(),
              WriteState<Rigid3d>{.filename = path,
                                  .writeV = true,
                                  .recorded = begun.at<"tool">().get<WriteState<Rigid3d>>().recorded});
  auto take = [](auto& to, auto const& from) { to.position = from.position, to.velocity = from.velocity; };
  take(saved.at<"tool">().state(), begun.at<"tool">().state());
  take(saved.at<"string">().state(), begun.at<"string">().state());
  saved.at<"string">().state().restPosition = begun.at<"string">().state().restPosition;
  whole.finish();
  const std::string file = io::read_file(path);
  // the file is that of the longer run: what follows the checkpoint is recorded again
  saved.init(begun.time(), begun.step());
  CHECK(bits_of(saved) == bits_of(begun));
  const auto rest = run(saved, 35);
  CHECK(rest.back() == all.back());
  saved.finish();
  CHECK(io::read_file(path) == file);
  CHECK(state.position.size() == 1);
}

TEST_CASE("what cannot be recorded is said, with its node") {
  TempFolder folder;
  auto refused = [&](WriteState<Rigid3d> write, std::initializer_list<std::string_view> words) {
    says(
        [&] {
          auto sim = pulling(keys(), write);
          sim.init();
        },
        words);
  };
  const std::string who = "/root/tool: WriteState<Rigid3d>: ";
  refused({}, {who, "filename is empty"});
  refused({.filename = folder / "no/f"}, {who, "there is no folder"});
  refused({.filename = folder / "f", .writeX = false}, {who, "writes nothing"});
  refused({.filename = folder / "f", .time = {1, 1}}, {who, "time[1] is 1 s"});
  refused({.filename = folder / "f", .time = {-1}}, {"time[0] is -1"});
  refused({.filename = folder / "f", .period = -1}, {"period is -1"});
  CHECK(folder.count() == 0);
}

TEST_CASE("a record or a replay of a body that loses points says so") {
  TempFolder folder;
  auto scene = [](auto... more) {
    return Simulation{
        node<"root">(node<"body">(MeshTopology{.edges = {{0, 1}, {1, 2}}},
                                  MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}},
                                  more...))};
  };
  auto sim = scene(EulerExplicitSolver{}, UniformMass<Vec3d>{}, WriteState<Vec3d>{.filename = folder / "f"});
  sim.init();
  for (int i = 0; i < 5; ++i) sim.animate(dt);
  sim.removeElements("body", {.edges = {1}});
  CHECK(sim.at<"body">().state().size() == 2);
  says([&] { sim.animate(dt); }, {"/root/body: WriteState<Vec3d>", "has 2 points, and had 3"});
  // what was recorded is there
  CHECK(io::read_state_file<double>(folder / "f", io::state_layout<Vec3d>(3)).times.size() == 6);
  // from the start it may
  sim.reset();
  sim.animate(dt);
  sim.finish();
  CHECK(io::read_state_file<double>(folder / "f", io::state_layout<Vec3d>(2)).times.size() == 2);

  auto replay =
      scene(ReadState<Vec3d>{.keyTimes = {0}, .keyPositions = Vec3d::VecCoord(3, Vector3d(0, 0, 0))});
  replay.init();
  says([&] { replay.removeElements("body", {.edges = {1}}); },
       {"/root/body: ReadState<Vec3d>", "each of 2 points"});
  CHECK(replay.at<"body">().state().size() == 3);
}

TEST_CASE("a record after a reset has the bytes of the first one, forces too") {
  TempFolder folder;
  const std::string path = folder / "f";
  auto sim =
      pulling(keys(), WriteState<Rigid3d>{.filename = path, .writeX0 = true, .writeV = true, .writeF = true});
  sim.init();
  for (int i = 0; i < 10; ++i) sim.animate(dt);
  sim.finish();
  const std::string first = io::read_file(path);
  sim.reset();
  for (int i = 0; i < 10; ++i) sim.animate(dt);
  sim.finish();
  CHECK(io::read_file(path) == first);
}

}  // namespace test_recording
