// SPDX-License-Identifier: BSL-1.0
#include "one_component.hpp"

#include <sinew/force/ellipsoid_force_field.hpp>
#include <sinew/force/interaction_ellipsoid_force_field.hpp>

namespace test_interaction_ellipsoid_force_field {

using namespace sinew;
using Interaction = InteractionEllipsoidForceField<Vec3d>;
using Ellipsoid = EllipsoidForceField<Vec3d>;

namespace {

Rigid3d::Coord body() {
  return {.center = {1, -2, 3},
          .orientation = Eigen::Quaterniond(Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -1).normalized()))};
}
const Eigen::Vector3d center(0.5, 0, 0.2), radii(2, 3, 4);

}  // namespace

TEST_CASE("an ellipsoid on a body pushes as one at rest does, in the axes of the body") {
  const double stiffness = GENERATE(10., -10.);
  const bool inverted = GENERATE(false, true);
  auto fixed = one::ready(
      Ellipsoid{.center = center, .vradius = radii, .stiffness = stiffness, .damping = 0.5}, {{0, 0, 0}});
  Rigid3d::Coord place = body();
  if (inverted) {
    place.orientation = body().orientation.conjugate();
    place.center = -(place.orientation * body().center);
  }
  auto moving = one::ready(Interaction{.center = {center},
                                       .vradius = {radii},
                                       .stiffness = stiffness,
                                       .damping = 0.5,
                                       .frames = {Rigid3d::Coord{}, place},
                                       .bodyIndex = 1,
                                       .bodyInverted = inverted},
                           {{0, 0, 0}});
  for (Eigen::Vector3d const& d : {Eigen::Vector3d(1, 1, -1), Eigen::Vector3d(3, -4, 2)}) {
    const Eigen::Vector3d v(1, 2, 3), x = body().center + body().orientation * d;
    const Eigen::Vector3d f = one::force(moving, {x}, {body().orientation * v})[0];
    CHECK((f - body().orientation * one::force(fixed, {d}, {v})[0]).norm() < 1e-13);
    CHECK((one::product(moving, {body().orientation * v}, 2, 3)[0] -
           body().orientation * one::product(fixed, {v}, 2, 3)[0])
              .norm() < 1e-12);
  }
}

TEST_CASE("of several ellipsoids the one acts in which a point is deepest") {
  auto both = one::ready(
      Interaction{.center = {{0, 0, 0}, {3, 0, 0}}, .vradius = {{2, 2, 2}}, .stiffness = 10, .damping = 0},
      {{0, 0, 0}});
  // 1 of 2 from the first centre, 2 of 2 from the second; then the other way round
  CHECK((one::force(both, {{1, 0, 0}})[0] - Eigen::Vector3d(5, 0, 0) * 2 / 2).norm() < 1e-13);
  CHECK((one::force(both, {{2, 0, 0}})[0] - Eigen::Vector3d(-5, 0, 0)).norm() < 1e-13);
  CHECK(one::force(both, {{6, 0, 0}})[0].norm() == 0);
}

TEST_CASE("an ellipsoid on a body says what is wrong") {
  one::refuses(Interaction{.vradius = {{1, 0, 1}}}, {{0, 0, 0}}, {}, {"vradius", "0"});
  one::refuses(Interaction{.vradius = {}}, {{0, 0, 0}}, {}, {"there is no ellipsoid"});
  one::refuses(
      Interaction{.bodyIndex = 1}, {{0, 0, 0}}, {}, {"object2_dof_index is 1", "there are 1 bodies"});
  one::refuses(Interaction{.forcesOnBody = true}, {{0, 0, 0}}, {}, {"object2_forces is 1"});
}

}  // namespace test_interaction_ellipsoid_force_field
