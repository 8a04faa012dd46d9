// SPDX-License-Identifier: BSL-1.0
#include <sinew/engine/transform_engine.hpp>

#include "catch.hpp"
#include "error_of.hpp"

namespace test_transform_engine {

using namespace sinew;

namespace {

static_assert(Engine<TransformEngine<Vec3d>> && Engine<TransformEngine<Vec3f>> &&
              Engine<TransformEngine<Rigid3d>>);

bool contains(std::string_view whole, std::string_view part) { return whole.find(part) != whole.npos; }

}  // namespace

TEST_CASE("TransformEngine sizes, turns and moves points, and undoes it") {
  TransformEngine<Vec3d> engine{
      .inputPosition = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 2, 3}},
      .translation = {5, 6, 7},
      .rotation = {90, 0, 0},
      .quaternion = {0, 0, std::sqrt(0.5), std::sqrt(0.5)},  // a quarter turn about z
      .scale = {1, 2, 3}};
  engine.update("t");
  REQUIRE(engine.outputPosition.size() == 4);
  CHECK(engine.outputPosition[0].isApprox(Eigen::Vector3d(5, 7, 7)));
  CHECK(engine.outputPosition[1].isApprox(Eigen::Vector3d(5, 6, 9)));
  CHECK(engine.outputPosition[2].isApprox(Eigen::Vector3d(8, 6, 7)));
  CHECK(engine.outputPosition[3].isApprox(Eigen::Vector3d(5 + 9, 6 + 1, 7 + 4)));

  TransformEngine<Vec3d> back = engine;
  back.inputPosition = engine.outputPosition;
  back.inverse = true;
  back.update("t");
  for (std::size_t i = 0; i < 4; ++i)
    CHECK((back.outputPosition[i] - engine.inputPosition[i]).norm() < 1e-14);
  // a quaternion of any length is a rotation
  engine.quaternion *= 7;
  const auto before = engine.outputPosition;
  engine.update("t");
  for (std::size_t i = 0; i < 4; ++i) CHECK(engine.outputPosition[i].isApprox(before[i]));
}

TEST_CASE("TransformEngine turns rigid bodies with their orientation") {
  Rigid3d::Coord body{.center = {1, 0, 0}};
  body.orientation = Quat<double>(rotation_of_degrees({90, 0, 0}));
  TransformEngine<Rigid3d> engine{.inputPosition = {body}, .translation = {0, 0, 1}, .rotation = {0, 0, 90}};
  engine.update("t");
  auto const& out = engine.outputPosition[0];
  CHECK(out.center.isApprox(Eigen::Vector3d(0, 1, 1)));
  // its y axis stood along z, and stays; its x axis is now along y
  CHECK((out.orientation * Eigen::Vector3d(0, 1, 0)).isApprox(Eigen::Vector3d(0, 0, 1)));
  CHECK((out.orientation * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(0, 1, 0)));
  TransformEngine<Rigid3d> back = engine;
  back.inputPosition = engine.outputPosition;
  back.inverse = true;
  back.update("t");
  CHECK((back.outputPosition[0].center - body.center).norm() < 1e-15);
  CHECK(back.outputPosition[0].orientation.angularDistance(body.orientation) < 1e-7);
}

TEST_CASE("TransformEngine says what is wrong") {
  auto said = [](TransformEngine<Vec3f> engine) { return error_of([&] { engine.update("/root"); }); };
  CHECK(said({}).empty());
  CHECK(said({.inputPosition = {{1, 2, 3}}, .scale = {1, 0, 1}}).empty());
  CHECK(contains(said({.scale = {1, 0, 1}, .inverse = true}), "cannot be undone"));
  CHECK(contains(said({.quaternion = {0, 0, 0, 0}}), "/root: TransformEngine<Vec3f>: quaternion is zero"));
  CHECK(contains(said({.rotation = {0, std::nan(""), 0}}), "rotation is nan degrees"));
  CHECK(contains(said({.inputPosition = {{1, INFINITY, 3}}}), "input_position[0] is inf m"));
}

}  // namespace test_transform_engine
