// SPDX-License-Identifier: BSL-1.0
// Tubes around frames: circles, their turning with the frames, peaks, and the faces between them.
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/engine/edge2quad_topological_mapping.hpp>
#include <sinew/mapping/tubular_mapping.hpp>

#include <cmath>

namespace test_tubular_mapping {

using namespace sinew;
using Tube = TubularMapping<Rigid3d, Vec3d>;

namespace {

Rigid3d::VecCoord frames(int n) {
  Rigid3d::VecCoord x(std::size_t(n), Rigid3d::zero());
  for (int i = 0; i < n; ++i) x[std::size_t(i)].center = {2. * i, 0, 0};
  return x;
}
Vec3d::VecCoord mapped(Tube tube, Rigid3d::VecCoord const& x, Vec3d::VecCoord child = {}) {
  check_fields(tube, "child");
  tube.init({"parent", x, {}}, {"child", child, {}}, child);
  tube.apply(child, x);
  return child;
}
bool contains(std::string const& all, std::string_view part) { return all.find(part) != all.npos; }

}  // namespace

TEST_CASE("a tube has a circle of points around each frame, which turns with it") {
  auto x = frames(3);
  x[2].orientation = Eigen::AngleAxisd(std::acos(-1.0) / 2, Eigen::Vector3d::UnitZ());
  const auto points = mapped({.nbPointsOnEachCircle = 4, .radius = 0.5}, x);
  REQUIRE(points.size() == 12);
  CHECK(points[0].isApprox(Eigen::Vector3d(0, 0.5, 0)));
  CHECK(points[5].isApprox(Eigen::Vector3d(2, 0, 0.5)));
  CHECK(points[6].isApprox(Eigen::Vector3d(2, -0.5, 0)));
  // y of the turned frame is -x of the world
  CHECK(points[8].isApprox(Eigen::Vector3d(4 - 0.5, 0, 0)));
  CHECK(points[9].isApprox(Eigen::Vector3d(4, 0, 0.5)));
}

TEST_CASE("a peak falls to nothing over the first frames, or the last") {
  auto radius = [](Vec3d::VecCoord const& points, std::size_t frame) {
    return points[4 * frame].tail<2>().norm();
  };
  auto points = mapped({.nbPointsOnEachCircle = 4, .radius = 0.5, .peak = 2}, frames(5));
  for (std::size_t i = 0; i < 5; ++i) CHECK(radius(points, i) == Approx(std::min(0.25 * double(i), 0.5)));
  points = mapped({.nbPointsOnEachCircle = 4, .radius = 0.5, .peak = -2}, frames(5));
  for (std::size_t i = 0; i < 5; ++i) CHECK(radius(points, i) == Approx(std::min(0.25 * double(4 - i), 0.5)));
}

TEST_CASE("forces on a tube are those and their torques on its frames") {
  auto x = frames(2);
  Tube tube{.nbPointsOnEachCircle = 4, .radius = 0.5};
  Vec3d::VecCoord child;
  tube.init({"parent", x, {}}, {"child", child, {}}, child);
  tube.apply(child, x);
  Vec3d::VecDeriv f(8, Eigen::Vector3d::Zero());
  f[4] = {0, 0, 3};  // at y = 0.5 of frame 1
  Rigid3d::VecDeriv on(2, Rigid3d::Deriv::Zero());
  tube.applyJT(on, f);
  CHECK(on[0].norm() == 0);
  CHECK(on[1].head<3>() == Eigen::Vector3d(0, 0, 3));
  CHECK(on[1].tail<3>().isApprox(Eigen::Vector3d(1.5, 0, 0)));
}

TEST_CASE("edges become quads between circles, seen from outside unless they are flipped") {
  Edge2QuadTopologicalMapping made{.position = {{0, 0, 0}, {2, 0, 0}, {4, 0, 0}},
                                   .edges = {{0, 1}, {1, 2}},
                                   .nbPointsOnEachCircle = 4,
                                   .radius = 0.5};
  made.update("test");
  REQUIRE(made.circles.size() == 12);
  REQUIRE(made.quads.size() == 8);
  CHECK(made.circles[5].isApprox(Eigen::Vector3d(2, 0, 0.5)));
  auto outwards = [&](Quad const& q) {
    auto at = [&](std::size_t k) { return made.circles[std::size_t(q[k])]; };
    const Eigen::Vector3d normal = (at(1) - at(0)).cross(at(2) - at(0)),
                          middle = (at(0) + at(1) + at(2) + at(3)) / 4;
    return normal.dot(Eigen::Vector3d(0, middle[1], middle[2])) > 0;
  };
  // SOFA's order: from the first circle to the second, then on around it
  CHECK(made.quads[3] == Quad{3, 7, 4, 0});
  const bool side = outwards(made.quads[0]);
  for (auto const& q : made.quads) CHECK(outwards(q) == side);
  made.flipNormals = true;
  made.update("test");
  for (auto const& q : made.quads) CHECK(outwards(q) != side);
  made.edgeList = {1};
  made.update("test");
  CHECK(made.quads.size() == 4);
  made.radiusFocal = 2;
  made.focalAxis = {0, 0, 3};
  made.update("test");
  CHECK(made.circles[1].isApprox(Eigen::Vector3d(0, 0, 2)));
  CHECK(made.circles[0].isApprox(Eigen::Vector3d(0, 0.5, 0)));
}

TEST_CASE("tubes say what is wrong") {
  auto refusal = [](Tube const& tube, Vec3d::VecCoord const& child) {
    return error_of([&] { mapped(tube, frames(2), child); });
  };
  CHECK(contains(refusal({.radius = 1}, {}),
                 "child: TubularMapping<Rigid3d, Vec3d>: nbPointsOnEachCircle is 0"));
  CHECK(contains(refusal({.nbPointsOnEachCircle = 3}, {}), "radius 0 m"));
  CHECK(contains(refusal({.nbPointsOnEachCircle = 3, .radius = 1}, Vec3d::VecCoord(5)),
                 "the child has 5 points"));
  Edge2QuadTopologicalMapping edges{.position = {{0, 0, 0}}, .edges = {{0, 1}}, .nbPointsOnEachCircle = 3};
  auto said = [&] { return error_of([&] { edges.update("test"); }); };
  CHECK(contains(said(), "edge 0 refers to point 1"));
  edges.position.clear();  // those of a state: as many as edges have
  CHECK(said().empty());
  CHECK(edges.circles.size() == 6);
  edges.edgeList = {1};
  CHECK(contains(said(), "edgeList"));
  edges.edgeList.clear();
  edges.radiusFocal = 1, edges.focalAxis = {1, 0, 0};
  CHECK(contains(said(), "focalAxis is along x"));
  edges.nbPointsOnEachCircle = 0;
  CHECK(contains(said(), "nbPointsOnEachCircle is 0"));
}

}  // namespace test_tubular_mapping
