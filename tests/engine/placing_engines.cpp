// SPDX-License-Identifier: BSL-1.0
// Engines that place points and frames.
#include <sinew/engine/displacement_matrix_engine.hpp>
#include <sinew/engine/projective_transform.hpp>
#include <sinew/engine/quat_to_rigid.hpp>
#include <sinew/engine/rigid_to_quat.hpp>
#include <sinew/engine/transform_matrix_engine.hpp>
#include <sinew/engine/transform_position.hpp>
#include <sinew/engine/vertex2frame.hpp>

#include "catch.hpp"
#include "error_of.hpp"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>

namespace test_placing_engines {

using namespace sinew;
using Catch::Matchers::Contains;
using Points = std::vector<Eigen::Vector3d>;

namespace {

double apart(Points const& a, Points const& b) {
  REQUIRE(a.size() == b.size());
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).norm());
  return most;
}
Points placed(TransformPosition t) {
  t.update("scene");
  return t.outputPosition;
}
struct Written {
  std::string path;
  Written(std::string name, std::string const& content) : path(std::move(name)) {
    std::ofstream(path) << content;
  }
  ~Written() { std::remove(path.c_str()); }
};

}  // namespace

TEST_CASE("points are moved by each method") {
  using enum PositionTransform;
  const Points x{{1, 2, 3}, {-1, 0, 4}};
  CHECK(placed({.inputPosition = x, .translation = {1, 1, 1}, .method = translation}) ==
        Points{{2, 3, 4}, {0, 1, 5}});
  CHECK(apart(placed({.inputPosition = x, .rotation = {0, 0, 90}, .method = rotation}),
              {{-2, 1, 3}, {0, -1, 4}}) < 1e-14);
  CHECK(placed({.origin = {1, 0, 0}, .inputPosition = x, .scale = {2, 3, 1}, .method = scale}) ==
        Points{{1, 6, 3}, {-3, 0, 4}});
  CHECK(placed(
            {.inputPosition = x, .translation = {0, 0, 1}, .scale = {2, 2, 2}, .method = scaleTranslation}) ==
        Points{{2, 4, 7}, {-2, 0, 9}});
  CHECK(apart(placed({.inputPosition = x,
                      .translation = {0, 0, 1},
                      .rotation = {90, 0, 0},
                      .scale = {1, 1, 2},
                      .method = scaleRotationTranslation}),
              {{1, -6, 3}, {-1, -8, 1}}) < 1e-14);
  CHECK(placed({.origin = {0, 0, 1}, .inputPosition = x, .normal = {0, 0, 5}}) ==
        Points{{1, 2, 1}, {-1, 0, 1}});
  TransformPosition affinely{.inputPosition = x, .method = affine, .fixedIndices = {1}};
  affinely.matrix << 0, 1, 0, 5, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2;
  CHECK(placed(affinely) == Points{{3.5, 0.5, 1.5}, {-1, 0, 4}});
}

TEST_CASE("points move at random by no more than they shall, the same way with each run") {
  TransformPosition t{.inputPosition = Points(500, {1, 2, 3}),
                      .method = PositionTransform::random,
                      .seedValue = 3,
                      .maxRandomDisplacement = 0.25};
  const Points first = placed(t);
  double most = 0, mean = 0;
  for (auto const& x : first) {
    most = std::max(most, (x - Eigen::Vector3d(1, 2, 3)).cwiseAbs().maxCoeff());
    mean += (x[0] - 1) / 500;
  }
  CHECK(most <= 0.25);
  CHECK(most > 0.24);
  CHECK(std::abs(mean) < 0.03);  // 0.25 / sqrt(3 n), four times
  CHECK(placed(t) == first);
  t.seedValue = 4;
  CHECK(placed(t) != first);
}

TEST_CASE("transformations are read from files") {
  const Points x{{1, 2, 3}};
  auto read = [&](std::string const& name, std::string const& content) {
    const Written file(name, content);
    return placed({.inputPosition = x, .method = PositionTransform::fromFile, .filename = {file.path}});
  };
  CHECK(read("test_placing.trm", "1 0 0\n0 1 0\n-1 0 0\n0 0 1\n") == Points{{3, -1, 3}});
  CHECK(read("test_placing.xfm", "1 0 0 5\n0 1 0 6\n0 0 1 7\n0 0 0 1\n") == Points{{6, 8, 10}});
  // the translation stands from z to x, as in SOFA
  CHECK(read("test_placing.tfm",
             "# a\nTransform: Affine\nParameters: 1 0 0 0 1 0 0 0 2 30 20 10\nFixedParameters: 0\n") ==
        Points{{11, 22, 36}});
  CHECK_THAT(error_of([&] { read("test_placing.trm", "1 0 0\n0 1"); }), Contains("test_placing.trm:2"));
  CHECK_THAT(error_of([&] { read("test_placing.tfm", "Parameters: 1 2\n"); }), Contains("has 2 numbers"));
  CHECK_THAT(error_of([&] { read("test_placing.abc", "1"); }), Contains(".trm, .tfm, .xfm or .txt"));
  CHECK_THAT(error_of([&] { placed({.method = PositionTransform::fromFile}); }),
             Contains("filename is empty"));
  CHECK_THAT(error_of([&] { placed({.inputPosition = x}); }), Contains("normal is 0 0 0"));
  CHECK_THAT(error_of([&] {
               placed({.inputPosition = x, .method = PositionTransform::translation, .fixedIndices = {1}});
             }),
             Contains("fixedIndices has 1"));
}

TEST_CASE("matrices are composed, and undone") {
  TranslateTransformMatrixEngine t{.value = {1, 2, 3}};
  t.update("scene");
  ScaleTransformMatrixEngine s{.inT = t.outT, .value = {2, 2, 4}};
  s.update("scene");
  RotateTransformMatrixEngine r{.inT = s.outT, .value = {0, 0, 90}};
  r.update("scene");
  // rotated first, then sized, then moved
  CHECK((r.outT * Eigen::Vector4d(1, 0, 1, 1) - Eigen::Vector4d(1, 4, 7, 1)).norm() < 1e-14);
  InvertTransformMatrixEngine i{.inT = r.outT};
  i.update("scene");
  CHECK((i.outT * r.outT - Eigen::Matrix4d::Identity()).norm() < 1e-14);
  i.inT.setZero();
  CHECK_THAT(error_of([&] { i.update("scene"); }), Contains("inT has no inverse"));
}

TEST_CASE("frames stand along normals, and along a line of points") {
  Vertex2Frame f{.position = {{1, 0, 0}, {0, 1, 0}}, .normals = {{2, 0, 0}, {0, 1, 0}}};
  f.update("scene");
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(f.frames[i].center == f.position[i]);
    CHECK((f.frames[i].orientation * Eigen::Vector3d::UnitZ() - f.normals[i].normalized()).norm() < 1e-14);
  }
  // x = y cross z
  CHECK((f.frames[0].orientation * Eigen::Vector3d::UnitX() - Eigen::Vector3d(0, 0, -1)).norm() < 1e-14);
  f.invertNormals = true, f.rotation = 2, f.rotationAngle = 90;
  f.update("scene");
  CHECK((f.frames[0].orientation * Eigen::Vector3d::UnitZ() - Eigen::Vector3d(-1, 0, 0)).norm() < 1e-14);
  CHECK((f.frames[0].orientation * Eigen::Vector3d::UnitX() - Eigen::Vector3d(0, 1, 0)).norm() < 1e-14);
  Vertex2Frame line{.position = {{0, 0, 0}, {0, 0, 2}, {0, 3, 2}}, .useNormals = false};
  line.update("scene");
  CHECK((line.frames[0].orientation * Eigen::Vector3d::UnitX() - Eigen::Vector3d(0, 0, 1)).norm() < 1e-14);
  CHECK(line.frames[2].orientation.coeffs() == line.frames[1].orientation.coeffs());
  f.normals.pop_back();
  CHECK_THAT(error_of([&] { f.update("scene"); }), Contains("1 normals for 2 points"));
  f.normals = {{0, 0, 0}, {0, 1, 0}};
  CHECK_THAT(error_of([&] { f.update("scene"); }), Contains("point 0 has a normal of 0 0 0"));
}

TEST_CASE("frames are taken apart and put together, and know how they moved") {
  const Quat<double> turned(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()));
  RigidToQuatEngine apartness{.rigids = {{{1, 2, 3}, turned}}};
  apartness.update("scene");
  CHECK((apartness.orientationsEuler[0] - Eigen::Vector3d(0.5, 0, 0)).norm() < 1e-14);
  QuatToRigidEngine together{.positions = apartness.positions, .orientations = apartness.orientations};
  together.update("scene");
  CHECK(together.rigids[0].center == Eigen::Vector3d(1, 2, 3));
  CHECK(together.rigids[0].orientation.angularDistance(turned) < 1e-7);
  together.orientations = {{0, 0, 0, 1}}, together.colinearPositions = {{5, 5, 5}};
  together.update("scene");
  CHECK(together.rigids[0].center == Eigen::Vector3d(5, 5, 3));  // on the line along z through 5 5 5
  together.orientations = {{0, 0, 0, 0}};
  CHECK_THAT(error_of([&] { together.update("scene"); }), Contains("orientation 0 is zero"));
  DisplacementMatrixEngine d{
      .x0 = {{{0, 1, 0}, Quat<double>(1, 0, 0, 0)}},
      .x = {{{2, 1, 0}, Quat<double>(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()))}}};
  d.update("scene");
  // a point 1 beyond the frame along x comes 1 beyond it along y
  CHECK((d.displacements[0] * Eigen::Vector4d(1, 1, 0, 1) - Eigen::Vector4d(2, 2, 0, 1)).norm() < 1e-14);
  d.scales = {{3, 1, 1}};
  d.update("scene");
  CHECK((d.displacements[0] * Eigen::Vector4d(1, 1, 0, 1) - Eigen::Vector4d(2, 4, 0, 1)).norm() < 1e-14);
  d.x.clear();
  CHECK_THAT(error_of([&] { d.update("scene"); }), Contains("x has 0 frames, x0 1"));
}

TEST_CASE("a camera sees points at their place in its image") {
  ProjectiveTransformEngine p{.inputPosition = {{2, 4, 8}}, .focalDistance = 2};
  p.update("scene");
  CHECK(p.outputPosition[0] == Eigen::Vector3d(0.5, 1, 2));
  p.inputPosition = {{1, 1, 0}};
  CHECK_THAT(error_of([&] { p.update("scene"); }), Contains("in the plane of the camera"));
  CHECK(p.outputPosition.size() == 1);
}

}  // namespace test_placing_engines
