// SPDX-License-Identifier: BSL-1.0
#include "one_component.hpp"

#include <sinew/core/follow.hpp>
#include <sinew/force/element_pressure.hpp>

namespace test_element_pressure {

using namespace sinew;
using Eigen::Vector3d;
using one::force;
using one::ready;
using one::refuses;

namespace {

const Vec3d::VecCoord corners{{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}, {2, 0, 1}, {2, 3, 1}};
const std::vector<Triangle> triangles{{0, 1, 2}, {0, 2, 3}, {1, 4, 5}};
const std::vector<Quad> quads{{0, 1, 2, 3}, {1, 2, 5, 4}};
const std::vector<Edge> edges{{0, 1}, {1, 2}, {2, 3}};
const TopologyView all{.edges = edges, .triangles = triangles, .quads = quads};
const Vector3d p(1, -2, 4);

void check(Vec3d::VecDeriv const& f, std::vector<double> const& shares) {
  for (std::size_t i = 0; i < f.size(); ++i) CHECK((f[i] - shares[i] * p).norm() < 1e-13);
}

}  // namespace

TEST_CASE("the load of an element at rest is shared by its points") {
  // triangles of 3, 3 and 1.5 square metres; quads of 6 and 3; edges of 2, 3 and 2 metres
  auto t =
      ready(TrianglePressureForceField<Vec3d>{.pressure = p, .pressedElements = {0, 1, 2}}, corners, all);
  check(force(t, corners), {2, 1.5, 2, 1, 0.5, 0.5});
  auto q = ready(QuadPressureForceField<Vec3d>{.pressure = p, .pressedElements = {0, 1}}, corners, all);
  check(force(q, corners), {1.5, 2.25, 2.25, 1.5, 0.75, 0.75});
  auto e = ready(EdgePressureForceField<Vec3d>{.pressure = p, .pressedElements = {0, 1, 2}}, corners, all);
  check(force(e, corners), {1, 2.5, 2.5, 1, 0, 0});
  // it stays when the body moves, and does work
  Vec3d::VecCoord moved = corners;
  for (auto& x : moved) x = 3 * x + Vector3d(0, 0, 2);
  check(force(t, moved), {2, 1.5, 2, 1, 0.5, 0.5});
  double work = 0;
  for (std::size_t i = 0; i < moved.size(); ++i) work += force(t, moved)[i].dot(moved[i] - corners[i]);
  CHECK(potential_energy(t, moved) == Approx(-work));
  CHECK(potential_energy(t, corners) == 0);
}

TEST_CASE("loads are on the elements that are numbered, and on those between two planes") {
  auto some =
      ready(TrianglePressureForceField<Vec3d>{.pressure = p, .pressedElements = {1, 1}}, corners, all);
  check(force(some, corners), {1, 0, 1, 1, 0, 0});
  auto plane =
      ready(TrianglePressureForceField<Vec3d>{.pressure = p, .normal = {2, 0, 0}, .dmin = 3.9, .dmax = 4.1},
            corners,
            all);
  check(force(plane, corners), {0, 0.5, 0, 0, 0.5, 0.5});
  auto both = ready(
      TrianglePressureForceField<Vec3d>{
          .pressure = p, .pressedElements = {1}, .normal = {2, 0, 0}, .dmin = 3.9, .dmax = 4.1},
      corners,
      all);
  check(force(both, corners), {1, 0.5, 1, 1, 0.5, 0.5});
  // edges are the sides of the surface where there are none: here in lexicographic order, 0-1 first
  auto sides = ready(EdgePressureForceField<Vec3d>{.pressure = p, .pressedElements = {0}},
                     corners,
                     {.triangles = triangles});
  check(force(sides, corners), {1, 1, 0, 0, 0, 0});
  auto around = ready(EdgePressureForceField<Vec3d>{.pressure = p, .pressedElements = {0, 1, 2, 3}},
                      corners,
                      {.quads = std::span(quads).first(1)});
  check(force(around, corners), {2.5, 2.5, 2.5, 2.5, 0, 0});
}

TEST_CASE("a selection that is empty bears no load, and neither does one that is not given") {
  auto nothing = ready(TrianglePressureForceField<Vec3d>{.pressure = p}, corners, all);
  check(force(nothing, corners), {0, 0, 0, 0, 0, 0});
  CHECK(nothing.loads.empty());
}

TEST_CASE("loads go with the elements that are removed, and do not turn to all") {
  TrianglePressureForceField<Vec3d> load{.pressure = p, .pressedElements = {2}};
  TopologyChange change;
  change.elements[std::size_t(ElementKind::triangle)] = Renumbering::of({true, true, false});
  follow_fields(load, {{}, {}, {}, change});
  CHECK(load.none);
  load.init(InitContext<Vec3d>{"there", corners, {.triangles = std::span(triangles).first(2)}});
  CHECK(load.loads.empty());

  EdgePressureForceField<Vec3d> edge{.pressure = p, .pressedElements = {0, 2}};
  change.elements[std::size_t(ElementKind::edge)] = Renumbering::of({false, true, true});
  follow_fields(edge, {{}, {}, {}, change});
  CHECK(edge.pressedElements == std::vector<int>{1});
}

TEST_CASE("edges are given by their points, and go with them") {
  using E = EdgePressureForceField<Vec3d>;
  // of 3 and 2 metres, the second in no topology
  auto load = ready(E{.pressure = p, .edges = {{1, 2}, {0, 1}}}, corners, {});
  check(force(load, corners), {1, 2.5, 1.5, 0, 0, 0});
  auto both = ready(E{.pressure = p, .pressedElements = {2}, .edges = {{1, 2}}}, corners, all);
  check(force(both, corners), {0, 1.5, 2.5, 1, 0, 0});
  const Renumbering points = Renumbering::of({false, true, true, true, true, true});
  follow_fields(load, {points, points, {}, {}});
  CHECK(load.edges == std::vector<Edge>{{0, 1}});
  CHECK_FALSE(load.none);
  const Renumbering rest = Renumbering::of({true, false, true, true, true});
  follow_fields(load, {rest, rest, {}, {}});
  CHECK(load.none);
  refuses(E{.edges = {{0, 6}}}, corners, {}, {"edge 0 refers to point 6", "6 points"});
}

TEST_CASE("a load across edges turns with them, at a right angle with the binormal") {
  using E = EdgePressureForceField<Vec3d>;
  const std::vector<Edge> side{{1, 2}};  // 3 metres at rest
  auto load = ready(E{.edges = side, .intensity = -10, .binormal = {0, 0, 2}}, corners, {});
  // e_z x e_y = -e_x: 30 N along x, half of them on each end
  auto f = force(load, corners);
  CHECK((f[1] - Vector3d(15, 0, 0)).norm() < 1e-13);
  CHECK((f[2] - Vector3d(15, 0, 0)).norm() < 1e-13);
  CHECK(f[0].norm() + f[3].norm() == 0);
  // the edge turned into x, and twice as long: the same force, along -y
  Vec3d::VecCoord turned = corners;
  turned[2] = turned[1] + Vector3d(6, 0, 0);
  CHECK((force(load, turned)[1] - Vector3d(0, -15, 0)).norm() < 1e-13);
  // along the binormal there is no direction across
  turned[2] = turned[1] + Vector3d(0, 0, 1);
  CHECK(force(load, turned)[1].norm() == 0);
  CHECK_FALSE(load.properties().conservative);
  // a pressure goes before
  auto pressed = ready(E{.pressure = p, .edges = side, .intensity = -10, .binormal = {0, 0, 2}}, corners, {});
  check(force(pressed, corners), {0, 1.5, 1.5, 0, 0, 0});
  refuses(E{.intensity = 1}, corners, all, {"EdgePressureForceField<Vec3d>", "give binormal"});
}

TEST_CASE("loads on what is not there are refused") {
  using T = TrianglePressureForceField<Vec3d>;
  refuses(T{}, corners, {}, {"the topology has no triangle"});
  refuses(T{.pressedElements = {3}}, corners, all, {"triangleList has 3, but the topology has 3"});
  refuses(T{.pressedElements = {-1}}, corners, all, {"triangleList[0] is -1"});
  refuses(T{.pressure = {0, one::notANumber, 0}}, corners, all, {"pressure"});
  refuses(T{.dmin = 2, .dmax = 1}, corners, all, {"dmin is 2"});
  refuses(QuadPressureForceField<Vec3d>{}, corners, {.triangles = triangles}, {"the topology has no quad"});
  const std::vector<Edge> wrong{{0, 9}};
  refuses(EdgePressureForceField<Vec3d>{}, corners, {.edges = wrong}, {"edge 0 refers to point 9"});
}

}  // namespace test_element_pressure
