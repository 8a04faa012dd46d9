// SPDX-License-Identifier: BSL-1.0
// Records of runs give back the same bits, and refuse what is no record.
#include "catch.hpp"

#include <sinew/runtime/precompiled.hpp>
#include <sinew/runtime/record.hpp>

#include <fstream>

namespace test_cli_record {

using namespace sinew;

namespace {

RuntimeNode<Standard> scene() {
  RuntimeNode<Standard> root;
  root.add(Gravity{});
  root.add(EulerExplicitSolver{});
  auto points = [](std::string name) { return RuntimeNode<Standard>(std::move(name)); };
  auto& a = root.addChild(points("with blank"));
  a.add(MechanicalObject<Vec3d>{.position = {{0.1, 1.0 / 3, 1e-310}, {-1e300, 2, 3}}});
  a.add(UniformMass<Vec3d>{.vertexMass = 1});
  auto& f = a.addChild(points("float"));
  f.add(MechanicalObject<Vec3f>{.position = {{0.1f, 1.0f / 3, 16777217.0f}},
                                .velocity = {{1e-45f, 3e38f, -0.f}}});
  f.add(UniformMass<Vec3f>{.vertexMass = 1.f});
  auto& r = root.addChild(points("rigid"));
  r.add(MechanicalObject<Rigid3d>{.position = {{{1, 2, 3}, Quat<double>(0.5, 0.5, -0.5, 0.5)}},
                                  .velocity = {Vec<double, 6>::Constant(0.7)}});
  r.add(UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{}});
  auto& p = root.addChild(points("plane"));
  p.add(MechanicalObject<Rigid2d>{.position = {{{1, 2}, 0.3}}});
  p.add(UniformMass<Rigid2d>{.vertexMass = RigidMass<double, 2>{}});
  return root;
}

std::string refused(std::string const& content) {
  try {
    parse_record("r.txt", content);
  } catch (Error const& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a record gives back the same bits, over each kind of state") {
  StandardSimulation sim(scene());
  sim.init();
  std::string content = "sinew record 1\n";
  std::vector<RecordedFrame> frames;
  for (int i = 0; i < 3; ++i) {
    frames.push_back(capture(sim.root(), sim.step(), sim.time()));
    content += record_text(frames.back());
    sim.animate(0.1);
  }
  content += "end 3\n";
  REQUIRE(frames[0].states.size() == 4);
  CHECK(frames[0].states[0].path == "/with blank");
  CHECK(frames[0].states[1].path == "/with blank/float");
  CHECK(frames[0].states[2].positions == std::vector<double>{1, 2, 3, 0.5, -0.5, 0.5, 0.5});
  CHECK(frames[0].states[3].positions == std::vector<double>{1, 2, 0.3});
  CHECK(frames[2].step == 2);
  CHECK(parse_record("r.txt", content) == frames);
}

TEST_CASE("a written record is whole or not there") {
  const std::string path = "cli_record_test.txt";
  std::remove(path.c_str());
  RecordedFrame frame{4, 0.5, {{"/a", "Vec1d", 1, {2}, {3}}}};
  auto there = [&] { return std::ifstream(path).good(); };
  {
    RecordWriter unfinished(path);
    unfinished.add(frame);
  }
  CHECK_FALSE(there());
  RecordWriter writer(path);
  writer.add(frame);
  CHECK_FALSE(there());
  writer.finish();
  CHECK(read_record(path) == std::vector{frame});
  CHECK_THROWS_AS(writer.add(frame), Error);
  std::remove(path.c_str());
  CHECK_THROWS_AS(RecordWriter("no/such/folder/r.txt"), Error);
  CHECK_THROWS_AS(RecordWriter("."), Error);
  frame.states[0].positions.clear();
  CHECK_THROWS_AS(record_text(frame), Error);
}

TEST_CASE("what is no record is refused at its line") {
  const std::string head = "sinew record 1\n", frame = head + "frame 0 time 0\n";
  CHECK(refused(head + "end 0\n").empty());
  CHECK(refused(frame + "state Vec3f 1 /a\n1 2 3 4 5 6\nend 1\n").empty());
  CHECK(refused("").starts_with("r.txt:1: "));
  CHECK(refused("sinew record 2\nend 0\n").starts_with("r.txt:1: "));
  CHECK(refused(head).find("incomplete") != std::string::npos);
  CHECK(refused(head + "state Vec3d 0 /a\nend 0\n").starts_with("r.txt:2: "));
  CHECK(refused(frame + "state Vec4d 1 /a\n").starts_with("r.txt:3: "));
  CHECK(refused(frame + "state Vec3d 1 a\n0 0 0 0 0 0\n").starts_with("r.txt:3: "));
  CHECK(refused(frame + "state Vec3d -1 /a\n").starts_with("r.txt:3: "));
  CHECK(refused(frame + "state Vec3d 1000000000 /a\n0\n").starts_with("r.txt:3: "));
  CHECK(refused(frame + "state Vec3d 1 /a\n0 0 0 0 0 x\n").starts_with("r.txt:4: "));
  CHECK(refused(frame + "state Vec3d 1 /a\n0 0 0 0 0 nan\nend 1\n").starts_with("r.txt:4: "));
  CHECK(refused(frame + "state Vec3f 1 /a\n0 0 0 0 0 1e39\nend 1\n").starts_with("r.txt:4: "));
  CHECK(refused(frame + "end 2\n").starts_with("r.txt:3: "));
  CHECK(refused(frame + "end 1\nframe").starts_with("r.txt:3: "));
}

}  // namespace test_cli_record
