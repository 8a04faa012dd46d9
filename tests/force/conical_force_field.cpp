// SPDX-License-Identifier: BSL-1.0
// A cone that holds points: places nearest to points in all of its regions, in closed form.
#include "one_component.hpp"

#include <sinew/force/conical_force_field.hpp>

#include <cmath>
#include <numbers>
#include <random>

namespace test_conical_force_field {

using namespace sinew;
using Eigen::Vector3d;
using Cone = ConicalForceField<Vec3d>;

namespace {

Cone cone(double angle = 30) {
  return {
      .coneCenter = {1, 2, 3}, .coneHeight = {0, 0, 2}, .coneAngle = angle, .stiffness = 10, .damping = 0};
}
// of points given relative to the apex
Vec3d::VecDeriv forces(Cone c, Vec3d::VecCoord x, Vec3d::VecDeriv const& v = {}) {
  for (auto& p : x) p += Vector3d(1, 2, 3);
  auto ready = one::ready(c, x);
  return one::force(ready, x, v);
}

}  // namespace

TEST_CASE("a cone pushes points back to the nearest place in it") {
  const double s = std::sin(std::numbers::pi / 6), c = std::cos(std::numbers::pi / 6);
  const Vector3d side(s, 0, c), out(c, 0, -s);  // along the side and away from it
  const auto f = forces(cone(),
                        {{0.1, 0, 1},                        // inside
                         side + 0.3 * out,                   // beside
                         {0, 0, 5},                          // beyond the cap
                         2 * side + 0.3 * out + 0.1 * side,  // beyond the rim
                         {0, 0, -2},                         // behind the apex
                         {-1, 0, -1}});
  CHECK(f[0].norm() == 0);
  CHECK((f[1] + 3 * out).norm() < 1e-14);
  CHECK((f[2] - Vector3d(0, 0, -30)).norm() < 1e-14);
  CHECK((f[3] + 3 * out + side).norm() < 1e-14);
  CHECK((f[4] - Vector3d(0, 0, 20)).norm() < 1e-14);
  CHECK((f[5] - Vector3d(10, 0, 10)).norm() < 1e-14);
}

TEST_CASE("no place of a cone is nearer than the one that points are pushed to") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-4, 4), part(0, 1);
  for (const double angle : {0., 20., 60., 90.}) {
    Vec3d::VecCoord x;
    for (int i = 0; i < 40; ++i) x.push_back({place(random), place(random), place(random)});
    const auto f = forces(cone(angle), x);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Vector3d nearest = x[i] + f[i] / 10;
      // it is in the cone
      CHECK(nearest.norm() <= 2 + 1e-12);
      CHECK(nearest[2] >= std::cos(angle * std::numbers::pi / 180) * nearest.norm() - 1e-12);
      for (int k = 0; k < 200; ++k) {
        const double a = angle * std::numbers::pi / 180 * part(random), b = 7 * part(random),
                     r = 2 * part(random);
        const Vector3d other(r * std::sin(a) * std::cos(b), r * std::sin(a) * std::sin(b), r * std::cos(a));
        CHECK((x[i] - nearest).norm() <= (x[i] - other).norm() + 1e-12);
      }
    }
  }
}

TEST_CASE("a cone damps motion away from it and along its axis of push alone") {
  Cone c = cone();
  c.damping = 4;
  const auto still = forces(c, {{0, 0, 5}, {0.1, 0, 1}}),
             moving = forces(c, {{0, 0, 5}, {0.1, 0, 1}}, {{1, 0, 3}, {1, 2, 3}});
  CHECK((moving[0] - still[0] - Vector3d(0, 0, -12)).norm() < 1e-13);
  CHECK(moving[1].norm() == 0);
}

TEST_CASE("a cone without height is refused, and angles that make none") {
  Cone flat = cone();
  flat.coneHeight = {0, 0, 0};
  one::refuses(
      flat, Vec3d::VecCoord{{0, 0, 0}}, {}, {"body: ConicalForceField<Vec3d>", "coneHeight is zero"});
  one::refuses(cone(91), Vec3d::VecCoord{{0, 0, 0}}, {}, {"coneAngle is 91"});
  one::refuses(cone(-1), Vec3d::VecCoord{{0, 0, 0}}, {}, {"coneAngle is -1"});
}

}  // namespace test_conical_force_field
