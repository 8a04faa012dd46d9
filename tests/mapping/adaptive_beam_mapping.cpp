// SPDX-License-Identifier: BSL-1.0
#include "frames.hpp"

#include <sinew/engine/beam_interpolation.hpp>
#include <sinew/engine/rod_spire_section.hpp>
#include <sinew/engine/rod_straight_section.hpp>
#include <sinew/engine/wire_beam_interpolation.hpp>
#include <sinew/engine/wire_rest_shape.hpp>
#include <sinew/mapping/adaptive_beam_mapping.hpp>

#include <numbers>

namespace test_adaptive_beam_mapping {

using namespace sinew;
using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using frames::frame;
using one::says;
using std::numbers::pi;

namespace {

using Mapping = AdaptiveBeamMapping<Rigid3d, Vec3d>;
using Frames = Rigid3d::VecCoord;
using Points = Vec3d::VecCoord;

WireRestShape<Rigid3d> arc(int n, double length, double diameter) {
  WireRestShape<Rigid3d> shape{
      .wireMaterials = {{.length = length, .radius = 0.01, .nbBeams = n, .spireDiameter = diameter}}};
  shape.update("wire");
  return shape;
}
Mapping ready(Mapping mapping, Frames const& parent, Points& child) {
  check_fields(mapping, "child");
  const Points given = child;
  mapping.init(InitContext<Rigid3d>{"parent", parent, {}}, InitContext<Vec3d>{"child", given, {}}, child);
  return mapping;
}

}  // namespace

// Hermite's cubic through the ends of an arc of the angle a misses it by a^4 / 384 of its radius and less.
TEST_CASE("points along a rod that is an arc are on the arc, with an error of order 4") {
  double last = 0;
  for (const int n : {4, 8}) {
    const auto shape = arc(n, pi, 2);
    std::vector<Vector3d> along;
    for (int i = 0; i <= 40; ++i) along.emplace_back(pi * i / 40, 0, 0);
    Points out;
    auto mapping = ready({.interpolation = shape.beams, .points = along}, shape.frames, out);
    REQUIRE(out.size() == along.size());
    mapping.apply(out, shape.frames);
    double error = 0;
    for (std::size_t i = 0; i < out.size(); ++i) {
      const double a = along[i][0];
      error = std::max(error, (out[i] - Vector3d(std::sin(a), 0, std::cos(a) - 1)).norm());
    }
    INFO(n << " " << error);
    CHECK(error < std::pow(pi / n, 4) / 100);
    if (last > 0) CHECK(last / error > 12);
    last = error;
  }
}

TEST_CASE("points across a rod turn with it, and twist makes nothing thinner") {
  const Frames rest{frame({0, 0, 0}), frame({2, 0, 0})};
  RodBeam beam;
  beam.length = 2, beam.chord = {2, 0, 0};
  Points out{{1, 0.3, 0}, {2, 0, 0.1}};
  auto mapping = ready({.interpolation = {beam}}, rest, out);
  mapping.apply(out, {frame({0, 0, 0}), frame({2, 0, 0}, Quaterniond(AngleAxisd(2, Vector3d::UnitX())))});
  CHECK((out[0] - Vector3d(1, 0.3 * std::cos(1), 0.3 * std::sin(1))).norm() < 1e-14);
  CHECK((out[1] - Vector3d(2, -0.1 * std::sin(2), 0.1 * std::cos(2))).norm() < 1e-14);
  // the same, as parts of beams
  Points parts{{0.5, 0.3, 0}};
  auto other = ready({.interpolation = {beam}, .useCurvAbs = false}, rest, parts);
  other.apply(parts, rest);
  CHECK((parts[0] - Vector3d(1, 0.3, 0)).norm() < 1e-14);
  Points each;
  auto sampled = ready({.interpolation = {beam}, .nbPointsPerBeam = 4}, rest, each);
  sampled.apply(each, rest);
  REQUIRE(each.size() == 5);
  CHECK((each[1] - Vector3d(0.5, 0, 0)).norm() < 1e-14);
  CHECK((each[4] - Vector3d(2, 0, 0)).norm() < 1e-14);
}

TEST_CASE("the Jacobian of points along a rod is their derivative, and forces keep momentum through it") {
  const auto shape = arc(3, 2, 1.5);
  Points out;
  auto mapping = ready(
      {.interpolation = shape.beams, .points = {{0, 0.1, 0}, {0.3, 0, 0.2}, {1.1, -0.1, 0.3}, {2, 0, 0}}},
      shape.frames,
      out);
  Rigid3d::VecDeriv v(4);
  for (std::size_t i = 0; i < 4; ++i)
    for (int c = 0; c < 6; ++c) v[i][c] = std::sin(1 + 3 * int(i) + 5 * c * c);
  Frames x = shape.frames;
  for (std::size_t i = 0; i < 4; ++i) Rigid3d::increment(x[i], Rigid3d::Deriv(0.2 * v[3 - i]));
  const double h = 1e-5;
  Frames plus = x, minus = x;
  for (std::size_t i = 0; i < 4; ++i)
    Rigid3d::increment(plus[i], Rigid3d::Deriv(h * v[i])),
        Rigid3d::increment(minus[i], Rigid3d::Deriv(-h * v[i]));
  Points ahead(4), back(4), rate(4), f(4);
  mapping.apply(ahead, plus);
  mapping.apply(back, minus);
  mapping.apply(out, x);
  mapping.applyJ(rate, v);
  Rigid3d::VecDeriv up(4, Rigid3d::Deriv::Zero());
  for (std::size_t i = 0; i < 4; ++i) f[i] = Vector3d(std::cos(double(i)), 1, -double(i));
  mapping.applyJT(up, f);
  Vector3d force(0, 0, 0), torque(0, 0, 0);
  double power = 0, mapped = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    // truncation h^2, rounding 1e-16 / h
    CHECK((rate[i] - (ahead[i] - back[i]) / (2 * h)).norm() < 1e-9);
    force += up[i].head<3>() - f[i];
    torque += x[i].center.cross(up[i].head<3>()) + up[i].tail<3>() - out[i].cross(f[i]);
    power += up[i].dot(v[i]), mapped += f[i].dot(rate[i]);
  }
  CHECK(force.norm() < 1e-14);
  CHECK(torque.norm() < 1e-13);
  CHECK(power == Approx(mapped));
}

TEST_CASE("a wire is made of sections, from the handle to the tip") {
  RodStraightSection straight{
      .length = 3, .youngModulus = 7, .radius = 0.1, .nbBeams = 2, .nbEdgesCollis = 3};
  RodSpireSection tip{.length = pi / 2,
                      .radius = 0.1,
                      .nbBeams = 3,
                      .nbEdgesCollis = 2,
                      .spireDiameter = 2,
                      .spireHeight = 0};
  straight.update("wire");
  tip.update("wire");
  WireRestShape<Rigid3d> shape{.wireMaterials = straight.section};
  shape.wireMaterials.push_back(tip.section[0]);
  shape.update("wire");
  REQUIRE(shape.beams.size() == 5);
  REQUIRE(shape.frames.size() == 6);
  CHECK(shape.keyPoints == std::vector<double>{0, 3, 3 + pi / 2});
  CHECK(shape.collisionPoints.size() == 6);
  CHECK(shape.collisionPoints[2][0] == Approx(2));
  CHECK(shape.collisionEdges.size() == 5);
  CHECK((shape.frames[2].center - Vector3d(3, 0, 0)).norm() < 1e-14);
  // a quarter of a circle of radius 1, towards -z
  CHECK((shape.frames[5].center - Vector3d(4, 0, -1)).norm() < 1e-14);
  CHECK((shape.frames[5].orientation * Vector3d::UnitX() - Vector3d(0, 0, -1)).norm() < 1e-14);
  CHECK(shape.beams[0].youngModulus == 7);
  WireBeamInterpolation<Rigid3d> wire{.wireRestShape = shape.beams};
  wire.update("wire");
  CHECK(wire.beams.size() == 5);
}

TEST_CASE("beams along edges are as long as the cubic between their frames") {
  const double a = 0.4;
  BeamInterpolation<Rigid3d> beams{
      .position = {frame({0, 0, 0}),
                   frame({std::sin(a), 0, std::cos(a) - 1}, Quaterniond(AngleAxisd(a, Vector3d::UnitY())))},
      .radius = {0.1}};
  beams.update("rod");
  REQUIRE(beams.beams.size() == 1);
  // the arc, which the cubic misses by less than a^4 / 384
  CHECK(beams.beams[0].length == Approx(a).epsilon(1e-4));
  CHECK(beams.beams[0].chord == Vector3d(beams.beams[0].length, 0, 0));
  beams.straight = false;
  beams.update("rod");
  CHECK(beams.beams[0].chord.norm() == Approx(2 * std::sin(a / 2)));
  CHECK(AngleAxisd(beams.beams[0].turn()).angle() == Approx(a));
}

TEST_CASE("points along a rod, and wires, that cannot be are refused") {
  const auto shape = arc(3, 2, 1.5);
  Points out{{0, 0, 0}};
  auto init = [&](Mapping const& m, Frames const& frames) { return [&, m] { ready(m, frames, out); }; };
  says(init({}, shape.frames), {"child", "AdaptiveBeamMapping<Rigid3d, Vec3d>", "no beams", "interpolation"});
  const Frames two{frame({0, 0, 0}), frame({1, 0, 0})};
  says(init({.interpolation = shape.beams}, two), {"child", "3 beams for 1 edges"});
  says(init({.interpolation = shape.beams, .points = {{2.1, 0, 0}}}, shape.frames),
       {"point 0 is at 2.1 m along a rod of 2 m"});
  says(init({.interpolation = shape.beams, .points = {{-1, 0, 0}}, .useCurvAbs = false}, shape.frames),
       {"point 0 is at -1 beams", "3 beams"});
  says(init({.interpolation = shape.beams, .points = {{0, 0, 0}, {1, 0, 0}}}, shape.frames),
       {"2 points along the rod", "the child has 1"});
  says(init({.interpolation = shape.beams, .points = {{one::notANumber, 0, 0}}}, shape.frames),
       {"points[0] is nan"});
  says([] { RodStraightSection{.length = -1}.update("wire"); }, {"length is -1 m"});
  says([] { RodStraightSection{.radius = 1, .innerRadius = 2}.update("wire"); },
       {"RodStraightSection", "radiusInner is 2 m"});
  says([] { RodSpireSection{.nbBeams = 0}.update("wire"); }, {"nbBeams is 0"});
  says([] { WireRestShape<Rigid3d>{}.update("wire"); }, {"WireRestShape<Rigid3d>", "no section"});
  says([] { WireBeamInterpolation<Rigid3d>{}.update("wire"); }, {"no beams", "WireRestShape"});
  says(
      [] {
        BeamInterpolation<Rigid3d>{.position = {frame({0, 0, 0})}}.update("rod");
      },
      {"no beam", "two frames"});
  says(
      [&] {
        BeamInterpolation<Rigid3d>{.position = two, .radius = {1, 2}}.update("rod");
      },
      {"radius has 2"});
  says([&] { BeamInterpolation<Rigid3d>{.position = {two[0], two[0]}}.update("rod"); }, {"no length"});
  says(
      [&] {
        BeamInterpolation<Rigid3d>{.position = two, .edges = {{0, 4}}}.update("rod");
      },
      {"edge 0 refers to point 4"});
}

}  // namespace test_adaptive_beam_mapping
