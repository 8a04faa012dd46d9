// SPDX-License-Identifier: BSL-1.0
#include "one_component.hpp"

#include <sinew/core/follow.hpp>
#include <sinew/force/constant_force.hpp>
#include <sinew/force/diagonal_velocity_damping.hpp>
#include <sinew/force/linear_force_field.hpp>
#include <sinew/force/plane_force_field.hpp>
#include <sinew/force/rest_shape_springs.hpp>
#include <sinew/force/sphere_force_field.hpp>
#include <sinew/force/uniform_velocity_damping.hpp>

#include <cmath>
#include <numbers>

namespace test_point_forces {

using namespace sinew;
using Eigen::Vector3d;
using one::force;
using one::product;
using one::ready;
using one::refuses;

namespace {

const Vec3d::VecCoord four{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

bool near(Vector3d const& a, Vector3d const& b) { return (a - b).norm() < 1e-14 * (1 + b.norm()); }

}  // namespace

TEST_CASE("rest shape springs pull points back to rest") {
  using Springs = RestShapeSpringsForceField<Vec3d>;
  Vec3d::VecCoord moved = four;
  for (auto& x : moved) x += Vector3d(1, 2, 3);
  auto all = ready(Springs{}, four);
  for (auto const& f : force(all, moved)) CHECK(near(f, {-100, -200, -300}));
  CHECK(potential_energy(all, moved) == Approx(4 * 50 * 14));
  auto some = ready(Springs{.points = {2, 0}, .stiffness = {10, 20}}, four);
  const auto f = force(some, moved);
  CHECK(near(f[2], {-10, -20, -30}));
  CHECK(near(f[0], {-20, -40, -60}));
  CHECK(f[1].norm() + f[3].norm() == 0);

  refuses(Springs{.points = {4}},
          four,
          {},
          {"body", "RestShapeSpringsForceField<Vec3d>", "points has 4", "4 points"});
  refuses(Springs{.points = {-1}}, four, {}, {"points[0] is -1"});
  refuses(Springs{.stiffness = {1, 2, 3}}, four, {}, {"stiffness has 3 values for 4 points"});
  refuses(Springs{.stiffness = {}}, four, {}, {"stiffness has 0 values"});
  refuses(Springs{.stiffness = {-1}}, four, {}, {"stiffness[0] is -1 N/m", "at least 0"});
}

TEST_CASE("rest shape springs hold points at places given, and in the directions that are active") {
  using Springs = RestShapeSpringsForceField<Vec3d>;
  const Vec3d::VecCoord places{{5, 0, 0}, {0, 6, 0}, {0, 0, 7}, {1, 1, 1}};
  auto all = ready(Springs{.stiffness = {2}, .externalRestShape = places}, four);
  auto f = force(all, four);
  for (std::size_t i = 0; i < 4; ++i) CHECK(near(f[i], 2 * (places[i] - four[i])));
  auto some = ready(
      Springs{.points = {2, 0}, .stiffness = {2}, .externalRestShape = places, .externalPoints = {3, 1}},
      four);
  f = force(some, four);
  CHECK(near(f[2], 2 * (places[3] - four[2])));
  CHECK(near(f[0], 2 * (places[1] - four[0])));
  CHECK(f[1].norm() + f[3].norm() == 0);
  // places stay with their points when one of these goes
  const Renumbering points = Renumbering::of({true, false, true, true});
  follow_fields(all, {points, points, {}, {}});
  CHECK(all.externalPoints == std::vector<int>{0, 2, 3});

  Vec3d::VecCoord moved = four;
  for (auto& x : moved) x += Vector3d(1, 2, 3);
  auto along = ready(Springs{.stiffness = {10}, .activeDirections = {true, false, true}}, four);
  for (auto const& force : force(along, moved)) CHECK(near(force, {-10, 0, -30}));
  CHECK(potential_energy(along, moved) == Approx(4 * 5 * 10));
  CHECK(near(product(along, moved, 1, 0)[3], -10 * moved[3].cwiseProduct(Vector3d(1, 0, 1))));

  refuses(
      Springs{.externalRestShape = {{0, 0, 0}}}, four, {}, {"external_rest_shape has 1 places for 4 points"});
  refuses(Springs{.points = {1}, .externalRestShape = places, .externalPoints = {0, 1}},
          four,
          {},
          {"external_points has 2 places for 1 points"});
  refuses(Springs{.points = {1}, .externalRestShape = places, .externalPoints = {4}},
          four,
          {},
          {"external_points has 4", "4 places"});
  refuses(Springs{.externalPoints = {0, 1, 2, 3}}, four, {}, {"external_rest_shape, which is not given"});
  refuses(
      Springs{.activeDirections = {true, true}}, four, {}, {"activeDirections has 2 flags for 3 directions"});
}

TEST_CASE("rest shape springs turn rigid bodies back about the axes that are active") {
  using Springs = RestShapeSpringsForceField<Rigid3d>;
  Rigid3d::VecCoord rest(1), x(1);
  x[0].orientation = Eigen::AngleAxisd(0.5, Vector3d(1, 2, 2) / 3);
  x[0].center = {1, 2, 3};
  // SOFA's flags are those of a position, with a fourth for its quaternion
  for (std::vector<bool> flags : {std::vector<bool>{1, 0, 1, 1, 0, 1}, {1, 0, 1, 1, 0, 1, 1}}) {
    auto springs = ready(Springs{.stiffness = {3}, .angularStiffness = {6}, .activeDirections = flags}, rest);
    const auto f = force(springs, x);
    CHECK((f[0].head<3>() - Vector3d(-3, 0, -9)).norm() < 1e-14);
    CHECK((f[0].tail<3>() - Vector3d(-1, 0, -2)).norm() < 1e-14);
    CHECK_FALSE(springs.properties().conservative);
    // at rest the tangent is the derivative
    force(springs, rest);
    Rigid3d::VecDeriv w(1);
    w[0] << 1, 2, 3, 4, 5, 6;
    Rigid3d::Deriv expected;
    expected << -3, 0, -9, -24, 0, -36;
    CHECK((product(springs, w, 1, 0)[0] - expected).norm() < 1e-13);
  }
}

TEST_CASE("rest shape springs turn rigid bodies back") {
  using Springs = RestShapeSpringsForceField<Rigid3d>;
  Rigid3d::VecCoord rest(1), x(1);
  rest[0].orientation = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 2) / 3);
  x[0] = rest[0];
  const Vector3d rotation = 2.5 * Vector3d(2, -1, 2) / 3;
  Rigid3d::Deriv d;
  d << Vector3d(1, 0, 0), rotation;
  Rigid3d::increment(x[0], d);
  auto springs = ready(Springs{.stiffness = {3}, .angularStiffness = {5}}, rest);
  const auto f = force(springs, x);
  CHECK((f[0].head<3>() - Vector3d(-3, 0, 0)).norm() < 1e-14);
  CHECK((f[0].tail<3>() + 5 * rotation).norm() < 1e-13);
  CHECK(potential_energy(springs, x) == Approx(1.5 + 2.5 * 2.5 * 2.5));
  // the derivative along the axis of the turn is the full stiffness; across it, |t|/2 cot(|t|/2) of it
  Rigid3d::VecDeriv w(1, Rigid3d::Deriv::Zero());
  w[0].tail<3>() = rotation.normalized();
  CHECK((product(springs, w, 1, 0)[0].tail<3>() + 5 * rotation.normalized()).norm() < 1e-13);
  const Vector3d across = Vector3d(1, 2, 0).normalized();
  w[0].tail<3>() = across;
  CHECK((product(springs, w, 1, 0)[0].tail<3>() + 5 * 1.25 / std::tan(1.25) * across).norm() < 1e-13);

  using Plane = RestShapeSpringsForceField<Rigid2d>;
  auto flat = ready(Plane{}, Rigid2d::VecCoord(1));
  Rigid2d::VecCoord angle(1);
  angle[0].orientation = 0.5;
  CHECK(force(flat, angle)[0][2] == Approx(-50));
  refuses(Springs{.angularStiffness = {1, 2}}, rest, {}, {"angularStiffness has 2 values for 1 points"});
}

TEST_CASE("a plane pushes points behind it") {
  using Plane = PlaneForceField<Vec3d>;
  const Vec3d::VecCoord x{{3, -0.1, 2}, {3, 0.1, 2}};
  const Vec3d::VecDeriv v{{1, 2, 0}, {1, 2, 0}};
  auto plane = ready(Plane{.stiffness = 100, .damping = 5}, x);
  // depth 0.1: 10 N up, and 0.5 N s/m of damping
  CHECK(near(force(plane, x, v)[0], {-0.5, 10 - 1, 0}));
  CHECK(force(plane, x, v)[1].norm() == 0);
  CHECK(potential_energy(plane, x) == Approx(0.5 * 100 * 0.01));
  CHECK(near(product(plane, {{1, 1, 1}, {1, 1, 1}}, 1, 0)[0], {0, -100, 0}));
  CHECK(near(product(plane, {{1, 1, 1}, {1, 1, 1}}, 0, 1)[0], {-0.5, -0.5, -0.5}));
  CHECK(product(plane, {{1, 1, 1}, {1, 1, 1}}, 1, 1)[1].norm() == 0);

  auto drawn = ready(Plane{.stiffness = 100, .damping = 5, .bilateral = true}, x);
  CHECK(near(force(drawn, x, v)[1], {-0.5, -10 - 1, 0}));

  // 10 N cut to 4: no stiffness is left, and the energy grows by 4 J a metre from where 4 N are reached
  auto weak = ready(Plane{.stiffness = 100, .damping = 0, .maxForce = 4}, x);
  CHECK(near(force(weak, x)[0], {0, 4, 0}));
  CHECK(product(weak, {{1, 1, 1}, {1, 1, 1}}, 1, 1)[0].norm() == 0);
  CHECK(potential_energy(weak, x) == Approx(0.5 * 100 * 0.04 * 0.04 + 4 * 0.06));

  // another plane: 3x + 4z = 25 at the distance 5, moved while the scene runs
  Plane moving{.normal = {0.6, 0, 0.8}, .d = 5, .stiffness = 10, .damping = 0};
  moving = ready(moving, x);
  CHECK(near(force(moving, x)[0], 10 * (5 - 3.4) * Vector3d(0.6, 0, 0.8)));
  moving.d = 6;
  CHECK(near(force(moving, x)[0], 10 * (6 - 3.4) * Vector3d(0.6, 0, 0.8)));

  Rigid3d::VecCoord body(1);
  body[0].center = {0, -1, 0};
  auto floor = ready(PlaneForceField<Rigid3d>{}, body);
  CHECK((force(floor, body)[0] - (Rigid3d::Deriv() << 0, 500, 0, 0, 0, 0).finished()).norm() == 0);

  refuses(Plane{.normal = {0, 0, 0}}, x, {}, {"PlaneForceField<Vec3d>", "normal is zero"});
  refuses(Plane{.d = one::notANumber}, x, {}, {"d is nan"});
  refuses(Plane{.stiffness = -1}, x, {}, {"stiffness is -1"});
  refuses(Plane{.maxForce = -1}, x, {}, {"maxForce is -1"});
}

TEST_CASE("a sphere pushes points out") {
  using Sphere = SphereForceField<Vec3d>;
  const Vec3d::VecCoord x{{1, 3, 0}, {1, 1, 3}, {1, 1, 0}};
  const Vec3d::VecDeriv v(3, Vector3d(1, 0, 0));
  auto sphere = ready(Sphere{.center = {1, 1, 0}, .radius = 2.5, .stiffness = 100, .damping = 5}, x);
  const auto f = force(sphere, x, v);
  CHECK(near(f[0], {-2.5, 50, 0}));
  CHECK(f[1].norm() == 0);
  CHECK(near(f[2], {-12.5, 0, 0}));  // in the centre: no direction, only damping
  CHECK(potential_energy(sphere, x) == Approx(0.5 * 100 * (0.25 + 6.25)));
  // k along the radius; across it the force turns with the direction: k h/l
  const auto df = product(sphere, {{1, 1, 1}, {1, 1, 1}, {0, 0, 0}}, 1, 0);
  CHECK(near(df[0], {25, -100, 25}));
  CHECK(df[1].norm() == 0);
  auto drawn = ready(Sphere{.center = {1, 1, 0}, .radius = 2.5, .stiffness = 100, .bilateral = true}, x);
  CHECK(near(force(drawn, x)[1], {0, 0, -50}));

  refuses(Sphere{.radius = 0}, x, {}, {"SphereForceField<Vec3d>", "radius is 0", "greater than 0"});
  refuses(Sphere{.center = {0, one::notANumber, 0}}, x, {}, {"center is nan"});
  refuses(Sphere{.damping = -1}, x, {}, {"damping is -1"});
}

TEST_CASE("constant forces: one each, one for all, one shared") {
  using Constant = ConstantForceField<Vec3d>;
  auto sum = [](Vec3d::VecDeriv const& f) { return Vector3d(f[0] + f[1] + f[2] + f[3]); };
  auto each = ready(Constant{.indices = {1, 3}, .forces = {{1, 0, 0}, {0, 2, 0}}}, four);
  CHECK(near(force(each, four)[3], {0, 2, 0}));
  CHECK(near(sum(force(each, four)), {1, 2, 0}));
  auto all = ready(Constant{.force = {{0, 0, 5}}}, four);
  for (auto const& f : force(all, four)) CHECK(near(f, {0, 0, 5}));
  auto shared = ready(Constant{.totalForce = {{0, 0, 8}}}, four);
  for (auto const& f : force(shared, four)) CHECK(near(f, {0, 0, 2}));
  auto some = ready(Constant{.indices = {1, 2}, .totalForce = {{0, 0, 8}}}, four);
  CHECK(near(force(some, four)[2], {0, 0, 4}));
  CHECK(near(sum(force(some, four)), {0, 0, 8}));
  // the first of forces, force and totalForce that is given
  auto first = ready(Constant{.force = {{0, 0, 5}}, .totalForce = {{0, 0, 8}}}, four);
  CHECK(near(force(first, four)[0], {0, 0, 5}));

  refuses(Constant{.indices = {1}}, four, {}, {"ConstantForceField<Vec3d>", "no force", "totalForce"});
  refuses(Constant{.indices = {1, 4}, .force = {{0, 0, 5}}}, four, {}, {"indices has 4", "4 points"});
  refuses(Constant{.forces = {{0, 0, 0}, {0, 0, 0}}}, four, {}, {"2 entries for 4 indices"});
  refuses(Constant{.totalForce = {{0, one::notANumber, 0}}}, four, {}, {"totalForce is nan"});
}

TEST_CASE("a force follows its key times") {
  using Linear = LinearForceField<Vec3d>;
  Linear linear{
      .points = {1, 2}, .force = 2, .times = {1, 3, 4}, .forces = {{1, 0, 0}, {3, 4, 0}, {0, 0, 0.5}}};
  linear = ready(linear, four);
  auto at = [&](double time) {
    const auto f = force(linear, four, {}, time);
    CHECK(f[0].norm() + f[3].norm() == 0);
    CHECK(f[1] == f[2]);
    return f[1];
  };
  CHECK(near(at(0), {0, 0, 0}));
  CHECK(near(at(1), {2, 0, 0}));
  CHECK(near(at(1.5), {3, 2, 0}));
  CHECK(near(at(3), {6, 8, 0}));
  CHECK(near(at(3.75), {1.5, 2, 0.75}));
  CHECK(near(at(4), {0, 0, 1}));
  CHECK(near(at(100), {0, 0, 1}));

  auto with = [](std::vector<double> times, Vec3d::VecDeriv forces, std::vector<int> points = {0}) {
    return Linear{.points = points, .times = times, .forces = forces};
  };
  refuses(with({}, {}), four, {}, {"LinearForceField<Vec3d>", "times is empty"});
  refuses(with({0, 1}, {{0, 0, 0}}), four, {}, {"2 times and 1 forces"});
  refuses(with({0, 2, 2}, Vec3d::VecDeriv(3, Vector3d::Zero())),
          four,
          {},
          {"times[2] is 2 s, not after times[1]"});
  refuses(with({0}, {{0, 0, 0}}, {4}), four, {}, {"points has 4"});
}

TEST_CASE("uniform damping slows all degrees of freedom") {
  using Damping = UniformVelocityDampingForceField<Rigid3d>;
  const Rigid3d::VecCoord x(2);
  Rigid3d::VecDeriv v(2);
  v[0].setLinSpaced(1, 6);
  v[1].setZero();
  for (const bool implicit : {false, true}) {
    auto damping = ready(Damping{.dampingCoefficient = 0.5, .implicit = implicit}, x);
    CHECK(force(damping, x, v)[0] == Rigid3d::Deriv(-0.5 * v[0]));
    CHECK(product(damping, v, 3, 2)[0] == Rigid3d::Deriv((implicit ? -1.0 : 0.0) * v[0]));
  }
  refuses(Damping{.dampingCoefficient = -1}, x, {}, {"UniformVelocityDampingForceField<Rigid3d>", "is -1"});
}

TEST_CASE("diagonal damping slows each degree of freedom by its own coefficient, in implicit steps, too") {
  using Damping = DiagonalVelocityDampingForceField<Vec3d>;
  auto damping = ready(Damping{.dampingCoefficient = {{1, 2, 3}, {0, 0, 4}}}, four);
  const Vec3d::VecDeriv v{{1, 1, 1}, {1, 1, 1}, {1, 2, 3}, {5, 5, 5}};
  const auto f = force(damping, four, v), df = product(damping, v, 0, 0.5);
  const Vec3d::VecDeriv expected{{-1, -2, -3}, {0, 0, -4}, {0, 0, -12}, {0, 0, -20}};
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(near(f[i], expected[i]));
    CHECK(near(df[i], 0.5 * expected[i]));
  }
  auto none = ready(Damping{}, four);
  for (auto const& one : force(none, four, v)) CHECK(one.norm() == 0);
  refuses(Damping{.dampingCoefficient = {{1, -1, 0}}}, four, {}, {"dampingCoefficient[0] is -1"});
}

}  // namespace test_point_forces
