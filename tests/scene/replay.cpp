// SPDX-License-Identifier: BSL-1.0
// States that are moved as recorded, or as given at keys, in typed scenes.
#include "replay.hpp"

#include "reset.hpp"

namespace test_replay {

using namespace replay;

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

TEST_CASE("tools that are led, and movements that are prescribed, start again") {
  comes_back(pulling(keys()), {1, 35, 130}, 130);
  comes_back(pulling(EulerImplicitSolver{},
                     CGLinearSolver<>{},
                     UniformMass<Rigid3d>{},
                     LinearMovementConstraint<Rigid3d>{
                         .indices = {0},
                         .keyTimes = {0, 0.2},
                         .movements = {Rigid3d::Deriv::Zero(), Rigid3d::Deriv::Constant(0.5)}}),
             {1, 15, 40},
             40);
}

}  // namespace test_replay
