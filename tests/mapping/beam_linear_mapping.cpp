// SPDX-License-Identifier: BSL-1.0
#include "frames.hpp"

#include <sinew/mapping/beam_linear_mapping.hpp>

#include <numbers>

namespace test_beam_linear_mapping {

using namespace sinew;
using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using frames::frame;
using one::says;
using std::numbers::pi;

namespace {

using Mapping = BeamLinearMapping<Rigid3d, Vec3d>;
using Frames = Rigid3d::VecCoord;
using Points = Vec3d::VecCoord;

Mapping ready(Mapping mapping, Frames const& parent, Points& child, std::vector<Edge> const& edges = {}) {
  check_fields(mapping, "child");
  TopologyView topology;
  topology.edges = edges;
  const Points given = child;
  mapping.init(
      InitContext<Rigid3d>{"parent", parent, topology}, InitContext<Vec3d>{"child", given, {}}, child);
  return mapping;
}
const Frames line{frame({0, 0, 0}), frame({1, 0, 0}), frame({3, 0, 0})};

}  // namespace

TEST_CASE("a skin stands at rest where it was given, whatever the frames, and moves with them as a whole") {
  Frames parent{frame({0, 0, 0}, Quaterniond(0.3, 0.5, -0.4, 0.7).normalized()),
                frame({0.7, 0.2, 0}, Quaterniond(-0.6, 0.2, 0.5, 0.1).normalized()),
                frame({1, 1, 0.5}, Quaterniond(0.1, 0.9, 0.2, -0.3).normalized())};
  const Points given{{0.1, 0.3, 0}, {0.8, 0.5, 0.5}, {-1, -1, 0}, {2, 2, 2}, {0.35, 0.1, -0.2}};
  for (const std::vector<Edge>& edges : {std::vector<Edge>{}, {{2, 1}, {0, 1}}, {{0, 2}}}) {
    Points out = given;
    auto mapping = ready({.localCoord = false}, parent, out, edges);
    mapping.apply(out, parent);
    for (std::size_t i = 0; i < out.size(); ++i) CHECK((out[i] - given[i]).norm() < 1e-14);
    const Quaterniond rotation = Quaterniond(0.2, -0.5, 0.6, 0.7).normalized();
    Frames moved = parent;
    for (auto& f : moved)
      f = frame(rotation * f.center + Vector3d(1, 2, 3), Quaterniond(rotation * f.orientation));
    moved[1].orientation.coeffs() *= -1;  // the same orientation
    mapping.apply(out, moved);
    for (std::size_t i = 0; i < out.size(); ++i)
      CHECK((out[i] - rotation * given[i] - Vector3d(1, 2, 3)).norm() < 1e-14);
  }
}

TEST_CASE("points follow the beam that is nearest to them") {
  Points out{{0.4, 0.1, 0}, {2.5, 0, 1}, {-1, 0, 0}, {9, 0, 0}};
  auto mapping = ready({.localCoord = false}, line, out);
  CHECK(mapping.carried.carriers[0].frames == std::array{0, 1});
  CHECK(mapping.carried.carriers[0].place == Approx(0.4));
  CHECK(mapping.carried.carriers[1].frames == std::array{1, 2});
  CHECK(mapping.carried.carriers[1].place == Approx(0.75));
  // beyond the ends they are carried by the last frame alone
  CHECK(mapping.carried.carriers[2].place == 0);
  CHECK(mapping.carried.carriers[3].place == 1);
  Frames moved = line;
  moved[2] = frame({3, 1, 0}, Quaterniond(AngleAxisd(pi / 2, Vector3d::UnitZ())));
  mapping.apply(out, moved);
  CHECK((out[0] - Vector3d(0.4, 0.1, 0)).norm() < 1e-14);
  CHECK((out[3] - Vector3d(3, 7, 0)).norm() < 1e-14);
  // the edges of a topology choose the beams
  Points across{{0.4, 0.1, 0}};
  CHECK(ready({.localCoord = false}, line, across, {{0, 2}}).carried.carriers[0].frames == std::array{0, 2});
}

// A beam bent into an arc by the angle a, of radius r = L/a: the middle line comes out with an error of order
// a^4, and sections are turned by their part of the angle, exactly.
TEST_CASE("a skin around a bent beam is bent with it") {
  const double width = 0.2;
  double last = 0;
  for (const double a : {0.4, 0.2, 0.1}) {
    const double r = 1 / a;
    Points out;
    for (const double t : {0.25, 0.5, 0.75})
      for (const double side : {-width, 0.0, width}) out.push_back({t, side, 0.1});
    auto mapping = ready({.localCoord = false}, {frame({0, 0, 0}), frame({1, 0, 0})}, out);
    mapping.apply(
        out,
        {frame({0, 0, 0}),
         frame({r * std::sin(a), r * (1 - std::cos(a)), 0}, Quaterniond(AngleAxisd(a, Vector3d::UnitZ())))});
    double error = 0;
    for (std::size_t i = 0; i < out.size(); ++i) {
      const double angle = a * (0.25 * double(i / 3 + 1)), side = width * (double(i % 3) - 1);
      const Vector3d exact((r - side) * std::sin(angle), r - (r - side) * std::cos(angle), 0.1);
      error = std::max(error, (out[i] - exact).norm());
      // halfway the section is where the mean of the two rotations is: nothing is lost
      if (i % 3 != 1) CHECK((out[i] - out[i - i % 3 + 1]).norm() == Approx(width).epsilon(1e-12));
    }
    INFO("angle " << a << " error " << error);
    CHECK(error < 0.05 * a * a * a);
    if (last != 0) CHECK(last / error > 7);
    last = error;
  }
}

TEST_CASE("twist turns a skin without thinning it") {
  Points out{{0.5, 0.3, 0}};
  auto mapping = ready({.localCoord = false}, {frame({0, 0, 0}), frame({1, 0, 0})}, out);
  mapping.apply(out, {frame({0, 0, 0}), frame({1, 0, 0}, Quaterniond(AngleAxisd(2, Vector3d::UnitX())))});
  CHECK((out[0] - Vector3d(0.5, 0.3 * std::cos(1), 0.3 * std::sin(1))).norm() < 1e-14);
}

TEST_CASE("local coordinates count beams and parts of their length") {
  Points out{{1.25, 0.1, -0.2}, {0.5, 0, 0}, {-0.5, 0, 0}, {2.5, 0, 0}};
  auto mapping = ready({}, line, out);
  mapping.apply(out, line);
  const Points there{{1.5, 0.2, -0.4}, {0.5, 0, 0}, {-0.5, 0, 0}, {4, 0, 0}};
  for (std::size_t i = 0; i < out.size(); ++i) CHECK((out[i] - there[i]).norm() < 1e-14);
}

TEST_CASE("beams that carry nothing are refused") {
  Points out{{0, 0, 0}};
  says(
      [&] {
        ready({.localCoord = false}, {frame({0, 0, 0})}, out);
      },
      {"child", "BeamLinearMapping<Rigid3d, Vec3d>", "parent has no beam", "two frames"});
  says([&] { ready({.localCoord = false}, line, out, {{0, 3}}); }, {"edge 0 refers to point 3", "3 points"});
  says([&] { ready({.localCoord = false}, {frame({0, 0, 0}), frame({0, 0, 0})}, out); }, {"have no length"});
}

}  // namespace test_beam_linear_mapping
