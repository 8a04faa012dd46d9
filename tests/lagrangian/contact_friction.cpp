// SPDX-License-Identifier: BSL-1.0
// Contacts by multipliers with friction: bodies on slopes and floors, against closed forms.
#include "lagrangian/contact_scenes.hpp"

namespace test_contact_friction {

using namespace sinew;

namespace {

constexpr double dt = 0.01, mass = 2;

RigidMass<double, 3> cube() { return {mass, mass / 6 * Eigen::Matrix3d::Identity()}; }
RigidMass<double, 3> ball(double radius) {
  return {mass, 0.4 * mass * radius * radius * Eigen::Matrix3d::Identity()};
}

const BlockGaussSeidelConstraintSolver gaussSeidel{.maxIterations = 20000, .tolerance = 1e-13};
const ConvexConstraintSolver convex{.tolerance = 1e-12, .momentumTolerance = 1e-12, .maxUpdates = 500};

// a cube of 1 m on four spheres, on a slope; it touches
template <class Solver, class Ode, class... Linear>
auto block(Solver solver, double mu, double angle, double speed, Ode ode, Linear... linear) {
  std::vector<Eigen::Vector3d> feet;
  for (auto [x, y] : {std::pair{-0.4, -0.4}, {0.4, -0.4}, {0.4, 0.4}, {-0.4, 0.4}})
    feet.push_back({x, y, -0.4});
  const auto start = on_slope(angle, {0, 0, 0.51});
  Eigen::Matrix<double, 6, 1> v;
  v << speed * (start.orientation * Eigen::Vector3d::UnitX()), 0, 0, 0;
  return constrained_scene_by(solver,
                              near_by(),
                              mu,
                              fixed_floor(angle),
                              node<"block">(ode,
                                            linear...,
                                            MechanicalObject<Rigid3d>{.position = {start}, .velocity = {v}},
                                            UniformMass<Rigid3d>{.vertexMass = cube()},
                                            node<"feet">(MechanicalObject<Vec3d>{.position = feet},
                                                         RigidMapping<Rigid3d, Vec3d>{},
                                                         SphereCollisionModel<Vec3d>{.radius = 0.1})));
}

}  // namespace

TEST_CASE("a block on a slope sticks below the angle of friction, and slides as it should above") {
  const double mu = 0.5, critical = std::atan(mu);
  auto run = [&](auto solver, double angle, auto... solvers) {
    auto sim = block(solver, mu, angle, 0, solvers...);
    sim.init();
    auto const& body = sim.template at<"block">().state();
    const Eigen::Vector3d start = body.position[0].center,
                          up = body.position[0].orientation * Eigen::Vector3d::UnitX();
    for (int i = 0; i < 100; ++i) sim.animate(dt);
    // at rest, or from rest by g (sin a - mu cos a) all the time: v = a t and s = a t (t + dt) / 2
    const double a = std::max(0.0, g * (std::sin(angle) - mu * std::cos(angle))), t = 100 * dt;
    CHECK((body.velocity[0].template head<3>() + a * t * up).norm() < 1e-8);
    CHECK((body.position[0].center - start + a * t * (t + dt) / 2 * up).norm() < 1e-8);
    CHECK(body.velocity[0].template tail<3>().norm() < 1e-8);
    // what friction and floor hold against
    auto& contacts = sim.root().template get<DefaultContactManager>();
    const Eigen::Vector3d force = force_on(contacts, "/root/block/feet");
    CHECK((force - mass * (Eigen::Vector3d(0, 0, g) - a * up)).norm() < 1e-7);
  };
  for (const double angle : {0.0, critical - 1e-4, critical + 1e-4, critical + 0.2}) {
    INFO(angle);
    run(gaussSeidel, angle, EulerExplicitSolver{});
    run(gaussSeidel, angle, EulerImplicitSolver{}, CGLinearSolver<>{.tolerance = 1e-14});
    run(convex, angle, EulerExplicitSolver{});
  }
}

TEST_CASE("a block that slides stops where friction has its energy") {
  const double mu = 0.3, v0 = 3;
  auto run = [&](auto solver) {
    auto sim = block(solver, mu, 0, v0, EulerExplicitSolver{});
    sim.init();
    auto const& body = sim.template at<"block">().state();
    for (int i = 0; i < 200; ++i) sim.animate(dt);
    // each step moves by the velocity at its end
    CHECK(body.position[0].center[0] == Approx(v0 * v0 / (2 * mu * g) - v0 * dt / 2).epsilon(1e-7));
    CHECK(body.velocity[0].norm() < 1e-8);
  };
  run(gaussSeidel);
  run(convex);
}

TEST_CASE("a ball rolls down a slope without slip, and slips where friction is too little") {
  const double angle = 0.4, radius = 0.5;
  auto run = [&](double mu, double acceleration, double spin) {
    auto sim = constrained_scene(
        near_by(),
        mu,
        fixed_floor(angle),
        node<"ball">(EulerExplicitSolver{},
                     MechanicalObject<Rigid3d>{.position = {on_slope(angle, {0, 0, radius + 0.01})}},
                     UniformMass<Rigid3d>{.vertexMass = ball(radius)},
                     SphereCollisionModel<Rigid3d>{.radius = radius}));
    sim.init();
    for (int i = 0; i < 100; ++i) sim.animate(dt);
    auto const& v = sim.template at<"ball">().state().velocity[0];
    CHECK(v.head<3>().norm() == Approx(acceleration).epsilon(1e-6));
    CHECK(v.tail<3>().norm() == Approx(spin).epsilon(1e-6));
  };
  // a = g sin a / (1 + I / m r^2), to which friction has to be 2/7 tan a
  const double a = g * std::sin(angle) / 1.4;
  run(0.5, a, a / radius);
  // m r^2 2/5 w' = mu m g cos a r
  const double mu = 0.5 * 2.0 / 7 * std::tan(angle);
  run(mu, g * (std::sin(angle) - mu * std::cos(angle)), 2.5 * mu * g * std::cos(angle) / radius);
}

// With more friction than 4/3 the rod of that angle has no force with which its end could slide on (Painleve
// 1895): the end is held at once, by an impulse, and the rod turns over it.
TEST_CASE(
    "Painleve's rod slides, or is caught at its end and turns over it, and comes to rest on the floor") {
  const double angle = std::atan(2.), radius = 0.02, half = 1, speed = 3;
  const Eigen::Vector3d along(std::cos(angle), 0, std::sin(angle));
  auto run = [&](auto solver, double mu) {
    Rigid3d::Coord start;
    start.center = half * along + Eigen::Vector3d(0, 0, radius + 0.01);
    Eigen::Matrix<double, 6, 1> v;
    v << -speed, 0, 0, 0, 0, 0;  // its lower end before it
    auto sim = constrained_scene_by(
        solver,
        near_by(),
        mu,
        fixed_floor(),
        node<"rod">(EulerExplicitSolver{},
                    MechanicalObject<Rigid3d>{.position = {start}, .velocity = {v}},
                    UniformMass<Rigid3d>{
                        .vertexMass = RigidMass<double, 3>{mass, mass / 3 * Eigen::Matrix3d::Identity()}},
                    node<"ends">(MechanicalObject<Vec3d>{.position = {-half * along, half * along}},
                                 RigidMapping<Rigid3d, Vec3d>{},
                                 SphereCollisionModel<Vec3d>{.radius = radius})));
    sim.init();
    auto const& rod = sim.template at<"rod">().state();
    auto const& ends = sim.template at<"rod/ends">().state();
    auto energy = [&] {
      auto const& u = rod.velocity[0];
      return mass * (u.template head<3>().squaredNorm() / 2 + u.template tail<3>().squaredNorm() / 6 +
                     g * rod.position[0].center[2]);
    };
    const double atStart = energy();
    double lowest = 1, most = 0;
    bool caught = false;
    for (int i = 0; i < 4000; ++i) {
      sim.animate(dt / 10);
      for (auto const& p : ends.position) lowest = std::min(lowest, p[2] - radius);
      most = std::max(most, energy());
      // but for what a step turns, and how much the sphere rolls in it
      if (i == 4) caught = ends.velocity[0].norm() < 0.01 * speed;
    }
    CHECK(most <= atStart * (1 + 1e-9));
    CHECK(lowest > -1e-3);
    CHECK(rod.velocity[0].norm() < 1e-6);
    CHECK(rod.position[0].center[2] == Approx(radius + 0.01).margin(1e-4));
    return caught;
  };
  for (const double mu : {0.3, 1.5, 10.}) {
    CAPTURE(mu);
    CHECK(run(gaussSeidel, mu) == (mu > 4. / 3));
    CHECK(run(convex, mu) == (mu > 4. / 3));
  }
}

TEST_CASE("without a loop that solves them, contacts by multipliers are refused with what to do") {
  RegistryScene sim{node<"root">(DefaultPipeline{},
                                 BruteForceBroadPhase{},
                                 BVHNarrowPhase{},
                                 near_by(),
                                 DefaultContactManager{.response = "FrictionContact"},
                                 fixed_floor())};
  CHECK_THROWS_WITH(sim.init(), Catch::Contains("FreeMotionAnimationLoop") && Catch::Contains("/root"));
}

TEST_CASE("a coefficient of friction that is none is refused") {
  for (const std::string mu : {"-0.1", "nan", "", "0.5x", "inf"}) {
    INFO(mu);
    RegistryScene sim{node<"root">(
        FreeMotionAnimationLoop{},
        BlockGaussSeidelConstraintSolver{},
        DefaultPipeline{},
        BruteForceBroadPhase{},
        BVHNarrowPhase{},
        near_by(),
        DefaultContactManager{.response = "FrictionContactConstraint", .responseParams = "mu=" + mu},
        fixed_floor())};
    CHECK_THROWS_WITH(sim.init(), Catch::Contains("coefficient of friction"));
  }
}

}  // namespace test_contact_friction
