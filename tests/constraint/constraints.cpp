// SPDX-License-Identifier: BSL-1.0
#include "one_component.hpp"

#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/constraint/fixed_plane.hpp>
#include <sinew/constraint/partial_fixed.hpp>
#include <sinew/constraint/project_direction.hpp>
#include <sinew/constraint/project_to_line.hpp>
#include <sinew/constraint/project_to_plane.hpp>
#include <sinew/constraint/project_to_point.hpp>

namespace test_constraints {

using namespace sinew;
using Eigen::Vector3d;
using one::ready;
using one::refuses;

namespace {

const Vec3d::VecCoord four{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};

bool near(Vector3d const& a, Vector3d const& b) { return (a - b).norm() < 1e-14 * (1 + b.norm()); }

template <class C>
Vec3d::VecDeriv response(C const& c, Vector3d const& dx = {1, 2, 3}) {
  Vec3d::VecDeriv all(4, dx);
  c.projectResponse(all);
  return all;
}

}  // namespace

TEST_CASE("fixed points lose their displacement, and their velocity where that is asked for") {
  using Fixed = FixedConstraint<Vec3d>;
  auto first = ready(Fixed{}, four);  // SOFA's default: point 0
  CHECK(response(first)[0].norm() == 0);
  CHECK(response(first)[1] == Vector3d(1, 2, 3));
  auto some = ready(Fixed{.indices = {3, 1}}, four);
  CHECK(response(some)[0] == Vector3d(1, 2, 3));
  CHECK(response(some)[3].norm() == 0);
  Vec3d::VecDeriv v(4, Vector3d(1, 2, 3));
  some.projectVelocity(0, v);
  CHECK(v[3] == Vector3d(1, 2, 3));
  some.activateProjectVelocity = true;
  some.projectVelocity(0, v);
  CHECK(v[3].norm() == 0);
  CHECK(v[2] == Vector3d(1, 2, 3));
  auto all = ready(Fixed{.fixAll = true}, four);
  for (auto const& dx : response(all)) CHECK(dx.norm() == 0);
  ready(Fixed{.indices = {99}, .fixAll = true}, four);  // indices are not looked at

  refuses(Fixed{.indices = {4}}, four, {}, {"body", "FixedConstraint<Vec3d>", "indices has 4", "4 points"});
  refuses(Fixed{.indices = {0, -1}}, four, {}, {"indices[1] is -1"});
}

TEST_CASE("some coordinates of points may be fixed") {
  using Partial = PartialFixedConstraint<Vec3d>;
  auto partial = ready(Partial{.indices = {1, 2}, .fixedDirections = {1, 0, 1}}, four);
  CHECK(response(partial)[1] == Vector3d(0, 2, 0));
  CHECK(response(partial)[0] == Vector3d(1, 2, 3));
  CHECK(response(ready(Partial{}, four))[0].norm() == 0);
  CHECK(response(ready(Partial{.fixAll = true, .fixedDirections = {0, 1, 0}}, four))[3] == Vector3d(1, 0, 3));
  Vec3d::VecDeriv v(4, Vector3d(1, 2, 3));
  partial.projectVelocity(0, v);
  CHECK(v[1] == Vector3d(1, 2, 3));
  partial.activateProjectVelocity = true;
  partial.projectVelocity(0, v);
  CHECK(v[1] == Vector3d(0, 2, 0));
  refuses(Partial{.indices = {4}}, four, {}, {"PartialFixedConstraint<Vec3d>", "indices has 4"});
  refuses(Partial{.fixedDirections = {1, 2, 0}}, four, {}, {"fixedDirections[1] is 2", "at most 1"});
}

TEST_CASE("points between two planes slide along them") {
  using Planes = FixedPlaneConstraint<Vec3d>;
  // x + y between 0.5 and 1.5 of the direction's length: point 1 only; point 3 is named
  Planes planes{.direction = {1, 1, 0}, .dmin = 0.5, .dmax = 1.5, .indices = {3, 1}};
  planes = ready(planes, four);
  const auto dx = response(planes, {1, 3, 5});
  CHECK(near(dx[1], {-1, 1, 5}));
  CHECK(near(dx[3], {-1, 1, 5}));
  CHECK(dx[0] == Vector3d(1, 3, 5));
  CHECK(dx[2] == Vector3d(1, 3, 5));
  // without an interval no point is looked for
  const auto named = response(ready(Planes{.direction = {0, 0, 2}, .indices = {2}}, four));
  CHECK(named[2] == Vector3d(1, 2, 0));
  CHECK(named[0] == Vector3d(1, 2, 3));

  refuses(Planes{}, four, {}, {"FixedPlaneConstraint<Vec3d>", "direction is zero"});
  refuses(Planes{.direction = {1, 0, 0}, .dmin = 1}, four, {}, {"dmin is 1 m and dmax 0 m"});
  refuses(Planes{.direction = {1, 0, 0}, .indices = {4}}, four, {}, {"indices has 4"});
}

TEST_CASE("points are held on planes, lines and places") {
  auto placed = [](auto c) {
    Vec3d::VecCoord x(4, Vector3d(5, 6, 7));
    c.projectPosition(0, x);
    return x;
  };
  auto plane =
      ready(ProjectToPlaneConstraint<Vec3d>{.indices = {1}, .origin = {0, 0, 1}, .normal = {0, 3, 4}}, four);
  // the distance from the plane is (3 * 6 + 4 * 6) / 5 = 8.4
  CHECK(near(placed(plane)[1], Vector3d(5, 6, 7) - 8.4 * Vector3d(0, 0.6, 0.8)));
  CHECK(placed(plane)[0] == Vector3d(5, 6, 7));
  CHECK(near(response(plane, {1, 5, 0})[1], {1, 5 - 3 * 0.6, -3 * 0.8}));

  auto line = ready(
      ProjectToLineConstraint<Vec3d>{.indices = {2}, .origin = {1, 1, 1}, .direction = {0, 3, 4}}, four);
  CHECK(near(placed(line)[2], Vector3d(1, 1, 1) + 7.8 * Vector3d(0, 0.6, 0.8)));
  CHECK(near(response(line, {1, 5, 0})[2], {0, 1.8, 2.4}));

  auto rails = ready(ProjectDirectionConstraint<Vec3d>{.indices = {2, 3}, .direction = {0, 0, 2}}, four);
  CHECK(near(placed(rails)[2], {0, 2, 7}));
  CHECK(near(placed(rails)[3], {0, 0, 7}));
  CHECK(near(response(rails)[3], {0, 0, 3}));

  auto point = ready(ProjectToPointConstraint<Vec3d>{.indices = {0}, .point = {1, 2, 3}}, four);
  CHECK(placed(point)[0] == Vector3d(1, 2, 3));
  CHECK(placed(point)[1] == Vector3d(5, 6, 7));
  CHECK(response(point)[0].norm() == 0);
  CHECK(placed(ready(ProjectToPointConstraint<Vec3d>{.fixAll = true}, four))[3].norm() == 0);

  Vec3d::VecDeriv v(4, Vector3d(1, 5, 0));
  line.projectVelocity(0, v);
  CHECK(near(v[2], {0, 1.8, 2.4}));

  refuses(ProjectToPlaneConstraint<Vec3d>{}, four, {}, {"ProjectToPlaneConstraint<Vec3d>", "normal is zero"});
  refuses(
      ProjectToLineConstraint<Vec3d>{}, four, {}, {"ProjectToLineConstraint<Vec3d>", "direction is zero"});
  refuses(ProjectDirectionConstraint<Vec3d>{},
          four,
          {},
          {"ProjectDirectionConstraint<Vec3d>", "direction is zero"});
  refuses(ProjectToPointConstraint<Vec3d>{.indices = {7}}, four, {}, {"indices has 7"});
  refuses(ProjectToPlaneConstraint<Vec3d>{.indices = {4}, .normal = {1, 0, 0}}, four, {}, {"indices has 4"});
  refuses(
      ProjectToLineConstraint<Vec3d>{.direction = {1, one::notANumber, 0}}, four, {}, {"direction is nan"});
}

}  // namespace test_constraints
