// SPDX-License-Identifier: BSL-1.0
// States that are recorded, and moved as recorded, in typed scenes.
#include "catch.hpp"
#include "io/files.hpp"

#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/constraint/linear_movement.hpp>
#include <sinew/control/read_state.hpp>
#include <sinew/control/step_callback.hpp>
#include <sinew/control/write_state.hpp>
#include <sinew/force/gravity.hpp>
#include <sinew/force/stiff_spring.hpp>
#include <sinew/mapping/rigid_mapping.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/mesh_topology.hpp>

using namespace sinew;
using Eigen::Vector3d;
using files::TempFolder;

namespace {

constexpr double dt = 0.01;

/// A tool without a solver, moved by `drive`, whose tip pulls at the end of a string by a spring.
template <class... Drive>
auto pulling(Drive... drive) {
  return Simulation{node<"root">(
      Gravity{{0, -9.81, 0}},
      node<"tool">(
          MechanicalObject<Rigid3d>{.position = {{{1, 0, 0}, Quat<double>(1, 0, 0, 0)}}},
          drive...,
          node<"tip">(MechanicalObject<Vec3d>{.position = {{0, 0.5, 0}}}, RigidMapping<Rigid3d, Vec3d>{})),
      node<"string">(EulerImplicitSolver{},
                     CGLinearSolver<>{.iterations = 50, .tolerance = 1e-12},
                     MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}}},
                     UniformMass<Vec3d>{.vertexMass = 0.1},
                     StiffSpringForceField<Vec3d>{{{0, 1, 50, 0.1, 0.5}, {1, 2, 50, 0.1, 0.5}}},
                     FixedConstraint<Vec3d>{.indices = {0}}),
      StiffSpringForceField<Vec3d, Between<"tool/tip", "string">>{{{0, 2, 20, 0.5, 0.2}}})};
}
ReadState<Rigid3d> keys() {
  const Quat<double> turned(Eigen::AngleAxisd(1.5, Vector3d(1, 0, 1).normalized()));
  return {.keyTimes = {0, 0.3, 0.7, 1.2},
          .keyPositions = {{{1, 0, 0}, Quat<double>(1, 0, 0, 0)},
                           {{1.2, 0.3, 0}, turned},
                           {{0.8, 0.5, 0.3}, turned},
                           {{1, 0.1, -0.2}, Quat<double>(1, 0, 0, 0)}},
          .interpolation = Interpolation::cubic};
}

template <class V>
std::string bits(V const& vector) {
  return {reinterpret_cast<char const*>(vector.data()), vector.size() * sizeof(vector[0])};
}
/// Positions and velocities of all bodies.
template <class Sim>
std::string bits_of(Sim& sim) {
  std::string all;
  auto add = [&](auto const& s) { all += bits(s.position) + bits(s.velocity); };
  add(sim.template at<"tool">().state());
  add(sim.template at<"tool/tip">().state());
  add(sim.template at<"string">().state());
  return all;
}
template <class Sim>
std::vector<std::string> run(Sim& sim, int steps) {
  std::vector<std::string> all;
  for (int i = 0; i < steps; ++i) {
    sim.animate(dt);
    all.push_back(bits_of(sim));
  }
  return all;
}

template <class F>
void says(F&& f, std::initializer_list<std::string_view> words) {
  const std::string said = files::error_of(f);
  for (std::string_view word : words) {
    INFO(said << "\n  should say: " << word);
    CHECK(said.find(word) != std::string::npos);
  }
}

}  // namespace

TEST_CASE("a tool without a solver is, after a step, where its trajectory says, and what it carries too") {
  auto sim = pulling(keys());
  sim.init();
  auto const& tool = sim.at<"tool">().state();
  for (int i = 0; i < 150; ++i) {
    sim.animate(dt);
    auto const& trajectory = sim.at<"tool">().get<ReadState<Rigid3d>>().trajectory;
    Rigid3d::VecCoord x(1);
    Rigid3d::VecDeriv v(1);
    trajectory.place(sim.time(), x);
    trajectory.move(sim.time(), true, v);
    CHECK(tool.position == x);
    CHECK(tool.velocity == v);
    const Vector3d arm = x[0].orientation * Vector3d(0, 0.5, 0);
    auto const& tip = sim.at<"tool/tip">().state();
    CHECK((tip.position[0] - (x[0].center + arm)).norm() < 1e-14);
    CHECK((tip.velocity[0] - (v[0].head<3>() + Vector3d(v[0].tail<3>()).cross(arm))).norm() < 1e-13);
  }
  // at rest at the end
  CHECK(tool.position[0].center == Vector3d(1, 0.1, -0.2));
  CHECK(tool.velocity[0].norm() == 0);
}

TEST_CASE("what pulls at a body during a step is where the tool is at the end of it") {
  // f = k (x_tool - x_body) from rest at the same place, and explicit: after the first step v = dt/m k d with
  // the displacement d of the tool in that step; where the tool was at its beginning, v = 0
  for (const bool atBegin : {false, true}) {
    auto sim = Simulation{node<"root">(
        node<"tool">(
            MechanicalObject<Vec1d>{.position = {Vec1d::Coord(0)}},
            ReadState<Vec1d>{
                .keyTimes = {0, 1}, .keyPositions = {Vec1d::Coord(0), Vec1d::Coord(3)}, .atBegin = atBegin}),
        node<"body">(EulerExplicitSolver{},
                     MechanicalObject<Vec1d>{.position = {Vec1d::Coord(0)}},
                     UniformMass<Vec1d>{.vertexMass = 2}),
        StiffSpringForceField<Vec1d, Between<"tool", "body">>{{{0, 0, 10, 0, 0}}})};
    sim.init();
    sim.animate(dt);
    CHECK(sim.at<"body">().state().velocity[0][0] == Approx(atBegin ? 0 : dt / 2 * 10 * 3 * dt));
    CHECK(sim.at<"tool">().state().position[0][0] == Approx(atBegin ? 0 : 3 * dt));
  }
}

TEST_CASE("a replay has the bits of the run that was recorded") {
  TempFolder folder;
  for (const auto format : {StateFormat::text, StateFormat::binary}) {
    const std::string path = folder / (format == StateFormat::text ? "tool.state" : "tool.bin");
    auto recorded = pulling(keys(), WriteState<Rigid3d>{.filename = path, .writeV = true, .format = format});
    recorded.init();
    const auto first = run(recorded, 150);
    recorded.finish();

    auto replayed = pulling(ReadState<Rigid3d>{.filename = {path}});
    replayed.init();
    CHECK(run(replayed, 150) == first);
    // again, from the start
    replayed.reset();
    CHECK(run(replayed, 150) == first);
    CHECK(first.back() != first.front());
  }
}

TEST_CASE("a body that was simulated is replayed with the timing of its run") {
  // what is loose sees the body at the beginning of the step: atBegin gives the same bits
  TempFolder folder;
  const std::string path = folder / "body.state";
  auto scene = [&](auto... mover) {
    return Simulation{node<"root">(
        node<"mover">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}}, .velocity = {{1, 2, 0}}}, mover...),
        node<"body">(EulerImplicitSolver{},
                     CGLinearSolver<>{},
                     MechanicalObject<Vec3d>{.position = {{0, 1, 0}}},
                     UniformMass<Vec3d>{.vertexMass = 2}),
        StiffSpringForceField<Vec3d, Between<"mover", "body">>{{{0, 0, 10, 0.1, 0.7}}})};
  };
  auto run = scene(EulerExplicitSolver{},
                   UniformMass<Vec3d>{.vertexMass = 1},
                   WriteState<Vec3d>{.filename = path, .writeV = true});
  auto replay = scene(ReadState<Vec3d>{.filename = {path}, .atBegin = true});
  std::vector<std::string> first, second;
  run.init();
  for (int i = 0; i < 100; ++i) {
    run.animate(dt);
    first.push_back(bits(run.at<"body">().state().position));
  }
  run.finish();
  replay.init();
  for (int i = 0; i < 100; ++i) {
    replay.animate(dt);
    second.push_back(bits(replay.at<"body">().state().position));
  }
  CHECK(first == second);
}

TEST_CASE("under a solver a state is held on its trajectory, and free outside of its times") {
  TempFolder folder;
  auto scene = [](auto... drive) {
    return Simulation{node<"root">(
        EulerImplicitSolver{},
        CGLinearSolver<>{.iterations = 50, .tolerance = 1e-14},
        StiffSpringForceField<Vec3d, Between<"tool", "body">>{{{0, 0, 100, 1, 0.5}}},
        node<"tool">(
            MechanicalObject<Vec3d>{.position = {{0, 0, 0}}}, UniformMass<Vec3d>{.vertexMass = 1}, drive...),
        node<"body">(MechanicalObject<Vec3d>{.position = {{1, 0, 0}}}, UniformMass<Vec3d>{.vertexMass = 1}))};
  };
  const std::string path = folder / "tool.state";
  // moved by a constraint that is known to be right
  auto led = scene(LinearMovementConstraint<Vec3d>{.keyTimes = {0, 1}, .movements = {{0, 0, 0}, {0, 2, 0}}},
                   WriteState<Vec3d>{.filename = path, .writeV = true});
  auto keyed = scene(ReadState<Vec3d>{.keyTimes = {0, 1}, .keyPositions = {{0, 0, 0}, {0, 2, 0}}});
  led.init(), keyed.init();
  std::vector<std::string> bodies;
  for (int i = 0; i < 90; ++i) {
    led.animate(dt), keyed.animate(dt);
    bodies.push_back(bits(led.at<"body">().state().position));
    // the positions of both are the same but for rounding
    CHECK((led.at<"body">().state().position[0] - keyed.at<"body">().state().position[0]).norm() < 1e-12);
    CHECK((keyed.at<"tool">().state().position[0] - Vector3d(0, 2 * keyed.time(), 0)).norm() < 1e-14);
  }
  led.finish();
  auto replay = scene(ReadState<Vec3d>{.filename = {path}});
  replay.init();
  for (int i = 0; i < 90; ++i) {
    replay.animate(dt);
    CHECK(bits(replay.at<"body">().state().position) == bodies[std::size_t(i)]);
  }
  // and goes on freely: momentum of both is kept
  auto momentum = [&] {
    return Vector3d(replay.at<"tool">().state().velocity[0] + replay.at<"body">().state().velocity[0]);
  };
  replay.animate(dt);
  const Vector3d before = momentum();
  for (int i = 0; i < 50; ++i) replay.animate(dt);
  CHECK((momentum() - before).norm() < 1e-12);
  CHECK(before.norm() > 1);
  // a file with the time 0 alone is where a body starts
  auto placed =
      scene(ReadState<Vec3d>{.filename = {folder.write("start.state", "T= 0\n  X= 0 0.5 0\n  V= 0 0 3\n")}});
  placed.init();
  CHECK(placed.at<"tool">().state().position[0] == Vector3d(0, 0.5, 0));
  CHECK(placed.at<"tool">().state().velocity[0] == Vector3d(0, 0, 3));
  placed.animate(dt);
  CHECK(placed.at<"tool">().state().position[0].z() > 0.02);
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

TEST_CASE("what a replay cannot do is said, with its node") {
  TempFolder folder;
  auto refused = [&](ReadState<Rigid3d> read, std::initializer_list<std::string_view> words) {
    says(
        [&] {
          auto sim = pulling(read);
          sim.init();
        },
        words);
  };
  const std::string who = "/root/tool: ReadState<Rigid3d>: ";
  const Quat<double> one(1, 0, 0, 0);
  refused({}, {who, "has neither a file nor keys"});
  refused({.filename = {folder / "none"}}, {who, folder / "none", "cannot be read: No such file"});
  refused({.filename = {folder.write("empty", "")}}, {who, "is empty"});
  refused({.filename = {folder.write("points", "T= 0\n  X= 0 0 0\n")}},
          {who, "points:2", "X= has 3 numbers"});
  refused({.filename = {folder.write("nan", "T= 0\n  X= 0 0 nan 0 0 0 1\n")}},
          {who, "nan:2", "a finite number"});
  refused({.filename = {folder.write("zero", "T= 0\n  X= 0 0 0 0 0 0 0\n")}},
          {who, "the orientation of point 0 at 0 s is zero"});
  refused({.filename = {folder.write("cut", "T= 0\n  X= 0 0 0 0 0 0 1")}},
          {who, "cut:2", "cut off in frame 0"});
  refused({.filename = {folder / "points"}, .keyTimes = {0}}, {who, "a file and keys"});
  refused({.keyPositions = {{{0, 0, 0}, one}}}, {who, "keyTimes is empty"});
  refused({.keyTimes = {0, 1}, .keyPositions = {{{0, 0, 0}, one}}},
          {who, "keyPositions has 1 entries; give one for each of 1 points at each of 2 times"});
  refused({.keyTimes = {0, 1},
           .keyPositions = {{{0, 0, 0}, one}, {{0, 0, 0}, one}},
           .keyVelocities = {Rigid3d::Deriv::Zero()}},
          {who, "keyVelocities has 1 entries"});
  refused({.keyTimes = {0, 0}, .keyPositions = {{{0, 0, 0}, one}, {{0, 0, 0}, one}}},
          {who, "keyTimes[1] is 0 s"});
  refused({.keyTimes = {0}, .keyPositions = {{{0, std::nan(""), 0}, one}}}, {"keyPositions[0]", "nan"});
  // an orientation that is not quite of length 1 is made so
  auto sim =
      pulling(ReadState<Rigid3d>{.keyTimes = {0}, .keyPositions = {{{0, 0, 0}, Quat<double>(2, 0, 0, 0)}}});
  sim.init();
  CHECK(sim.at<"tool">().state().position[0].orientation.coeffs() == one.coeffs());
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

TEST_CASE("a trajectory is stretched, turned and moved") {
  auto read = keys();
  read.scalePos = 2, read.rotation = {0, 0, 90}, read.translation = {0, 0, 1};
  auto sim = pulling(read);
  sim.init();
  // (1.2, 0.3, 0) doubled, turned to (-0.6, 2.4, 0)
  for (int i = 0; i < 30; ++i) sim.animate(dt);
  auto const& x = sim.at<"tool">().state().position[0];
  CHECK((x.center - Vector3d(-0.6, 2.4, 1)).norm() < 1e-12);
  const Vector3d expected = Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitZ()) *
                            (keys().keyPositions[1].orientation * Vector3d(0, 1, 0));
  CHECK((x.orientation * Vector3d(0, 1, 0) - expected).norm() < 1e-12);
}

TEST_CASE("keys at equal times, and a time shift") {
  auto sim = Simulation{
      node<"root">(MechanicalObject<Vec1d>{.position = {Vec1d::Coord(0)}},
                   ReadState<Vec1d>{.interval = 0.5,
                                    .shift = 0.25,
                                    .keyPositions = {Vec1d::Coord(0), Vec1d::Coord(1), Vec1d::Coord(0)}})};
  sim.init();
  CHECK(sim.root().state().position[0][0] == 0.5);
  sim.animate(0.25);
  CHECK(sim.root().state().position[0][0] == 1);
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
