// SPDX-License-Identifier: BSL-1.0
// Springs to picked places: equilibrium, motion, what they refuse.
#include <sinew/mapping/rigid_mapping.hpp>
#include <sinew/scene/mouse_interactor.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/solver/sparse_ldl_solver.hpp>

#include "collision/contact_scene.hpp"

namespace test_mouse_interactor {

using namespace sinew;
using Point = Eigen::Vector3d;

namespace {

constexpr MinProximityIntersection near{.alarmDistance = 0.2, .contactDistance = 0.1};

template <class Ode, class Linear>
auto ball(Ode ode, Linear linear, double gravity) {
  return contact_scene(near,
                       gravity,
                       node<"ball">(ode,
                                    linear,
                                    MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {5, 0, 0}}},
                                    UniformMass<Vec3d>{.vertexMass = 2},
                                    SphereCollisionModel<Vec3d>{.radius = 0.5}));
}
auto ball(double gravity) { return ball(EulerImplicitSolver{}, CGLinearSolver<>{}, gravity); }

// a plate of two triangles mapped from a rigid body
template <class Linear>
auto plate(Linear linear) {
  MeshTopology topology;
  topology.triangles = {{0, 1, 2}, {0, 2, 3}};
  return contact_scene(
      near,
      0,
      node<"body">(
          EulerImplicitSolver{},
          linear,
          MechanicalObject<Rigid3d>{.position = {Rigid3d::Coord{}}},
          UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{2}},
          node<"plate">(topology,
                        MechanicalObject<Vec3d>{.position = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}},
                        RigidMapping<Rigid3d, Vec3d>{},
                        TriangleCollisionModel<Vec3d>{})));
}

}  // namespace

TEMPLATE_TEST_CASE("a held ball hangs where the spring carries its weight", "", CGLinearSolver<>,
                   SparseLDLSolver<CompressedRowSparseMatrixMat3x3d>) {
  auto sim = ball(EulerImplicitSolver{}, TestType{}, 10);
  sim.init();
  const auto hit = sim.pick({0, 0, 3}, {0, 0, -1});
  REQUIRE(hit);
  CHECK((hit->point - Point(0, 0, 0.5)).norm() < 1e-12);
  const int spring = sim.attach(*hit, {.stiffness = 400, .damping = 40});
  sim.pull(spring, {0.2, 0, 0.5});
  for (int i = 0; i < 2000; ++i) sim.animate(0.01);
  // k d = m g below the target, from the top of the ball
  auto const& x = sim.template at<"ball">().state().position;
  CHECK((x[0] - Point(0.2, 0, -20 / 400.0)).norm() < 1e-9);
  CHECK((sim.attachment(spring)->contact.force - Point(0, 0, 20)).norm() < 1e-6);
  CHECK(x[1][2] < -1000);  // the other falls
}

TEST_CASE("under an explicit solver too, and the force is k (target - p) + c (target' - p')") {
  auto sim = ball(EulerExplicitSolver{}, CGLinearSolver<>{}, 10);
  sim.init();
  const int spring = sim.attach(*sim.pick({0, 0, 3}, {0, 0, -1}), {.stiffness = 400, .damping = 40});
  sim.pull(spring, {0, 0.1, 0.5}, {0, 0, 0.3});
  auto const& state = sim.at<"ball">().state();
  for (int i = 0; i < 100; ++i) {
    const Point x = state.position[0], v = state.velocity[0];
    sim.animate(0.001);
    const Point force = 400 * (Point(0, 0.1, 0) - x) + 40 * (Point(0, 0, 0.3) - v);
    REQUIRE((sim.attachment(spring)->contact.force - force).norm() < 1e-10);
    // and it is this force that changes the momentum
    REQUIRE((2 * (state.velocity[0] - v) / 0.001 - force - Point(0, 0, -20)).norm() < 1e-8);
  }
}

TEST_CASE("an implicit step takes the force at its end") {
  auto sim = ball(0);
  sim.init();
  const int spring = sim.attach(*sim.pick({0, 0, 3}, {0, 0, -1}), {.stiffness = 1e6, .damping = 3});
  sim.pull(spring, {0.1, 0, 0.5});
  sim.animate(0.01);
  // (m + c h + k h^2) v = k h d
  const double v = 1e6 * 0.01 * 0.1 / (2 + 3 * 0.01 + 1e6 * 1e-4);
  CHECK(sim.at<"ball">().state().velocity[0][0] == Approx(v).epsilon(1e-9));
}

TEST_CASE("a body goes with the target, and what is let go goes on freely") {
  auto sim = ball(0);
  sim.init();
  const int spring = sim.attach(*sim.pick({0, 0, 3}, {0, 0, -1}), {.stiffness = 4000, .damping = 400});
  auto const& state = sim.at<"ball">().state();
  const Point way(0.5, 0.2, 0);  // m/s
  for (int i = 0; i < 500; ++i) {
    sim.pull(spring, Point(0, 0, 0.5) + (sim.time() + 0.01) * way, way);
    sim.animate(0.01);
  }
  CHECK((state.position[0] - sim.time() * way).norm() < 1e-6);
  CHECK((state.velocity[0] - way).norm() < 1e-6);
  CHECK(sim.release(spring));
  CHECK(!sim.release(spring));
  CHECK(!sim.pull(spring, {0, 0, 0}));
  CHECK(!sim.attachment(spring));
  const Point x = state.position[0], v = state.velocity[0];
  for (int i = 0; i < 100; ++i) sim.animate(0.01);
  CHECK((state.velocity[0] - v).norm() < 1e-12);
  CHECK((state.position[0] - x - v).norm() < 1e-9);
}

TEMPLATE_TEST_CASE("a corner of a plate on a rigid body is pulled through the mapping", "", CGLinearSolver<>,
                   SparseLDLSolver<CompressedRowSparseMatrixMat3x3d>) {
  auto sim = plate(TestType{});
  sim.init();
  const auto hit = sim.pick({0.9, 0.8, 3}, {0, 0, -1});
  REQUIRE(hit);
  const int spring = sim.attach(*hit, {.stiffness = 100});
  sim.pull(spring, {0.9, 0.8, 0.1});
  auto const& body = sim.template at<"body">().state();
  sim.animate(0.001);
  // in the first step the force is k d but for O(h^2): linear momentum F h, angular r x F h
  const Point f(0, 0, 10);
  CHECK((2 * body.velocity[0].template head<3>() - 0.001 * f).norm() < 1e-5);
  CHECK((body.velocity[0].template tail<3>() - 0.001 * Point(0.9, 0.8, 0).cross(f)).norm() < 1e-4);
  // and so on: each step takes the force at its end
  for (int i = 0; i < 100; ++i) {
    const double p = 2 * body.velocity[0][2];
    sim.animate(0.001);
    auto const& corner = sim.template at<"body/plate">().state().position;
    double z = 0;
    for (std::size_t c = 0; c < 3; ++c)
      z += hit->place.weights[c] * corner[std::size_t(hit->place.vertices[c])][2];
    REQUIRE((2 * body.velocity[0][2] - p) / 0.001 == Approx(100 * (0.1 - z)).margin(2e-3));
  }
  CHECK(sim.release(spring));
}

TEST_CASE("a sphere on a rigid is held at its skin, and turns") {
  auto sim = contact_scene(near,
                           0,
                           node<"body">(EulerImplicitSolver{},
                                        CGLinearSolver<>{},
                                        MechanicalObject<Rigid3d>{.position = {Rigid3d::Coord{}}},
                                        UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{2}},
                                        SphereCollisionModel<Rigid3d>{.radius = 1}));
  sim.init();
  const auto hit = sim.pick({0, 0, 3}, {0, 0, -1});
  REQUIRE(hit);
  CHECK((hit->place.lever - Point(0, 0, 1)).norm() < 1e-12);
  const int spring = sim.attach(*hit, {.stiffness = 50, .damping = 20});
  sim.pull(spring, {0.5, 0, 1});
  for (int i = 0; i < 20; ++i) sim.animate(0.01);
  CHECK(sim.at<"body">().state().velocity[0][4] > 0);  // about y
  for (int i = 0; i < 20000; ++i) sim.animate(0.01);
  // the held point comes to rest at the target
  auto const& x = sim.at<"body">().state().position[0];
  const Point held = x.center + x.orientation * Point(0, 0, 1);
  CHECK((held - Point(0.5, 0, 1)).norm() < 1e-4);  // it swings about it, ever less
}

TEST_CASE("two springs pull at once, each with its number; reset lets all go") {
  auto sim = ball(0);
  sim.init();
  const auto hit = *sim.pick({0, 0, 3}, {0, 0, -1});
  const int first = sim.attach(hit, {.stiffness = 100, .damping = 50});
  const int second = sim.attach(hit, {.stiffness = 300, .damping = 50});
  CHECK(first != second);
  sim.pull(first, {0, 0, 1.5});
  sim.pull(second, {0, 0, 0.5});
  for (int i = 0; i < 2000; ++i) sim.animate(0.01);
  CHECK(sim.at<"ball">().state().position[0][2] == Approx(100.0 / 400));
  CHECK(sim.release(first));
  for (int i = 0; i < 2000; ++i) sim.animate(0.01);
  CHECK(std::abs(sim.at<"ball">().state().position[0][2]) < 1e-9);
  sim.reset();
  CHECK(!sim.attachment(second));
  CHECK(sim.attach(hit) > second);
}

TEST_CASE("what cannot be attached is refused, and changes nothing") {
  auto sim = contact_scene(near,
                           0,
                           floor_node(100, 0),
                           node<"ball">(EulerImplicitSolver{},
                                        CGLinearSolver<>{},
                                        MechanicalObject<Vec3d>{.position = {{0, 0, 3}}},
                                        UniformMass<Vec3d>{.vertexMass = 2},
                                        SphereCollisionModel<Vec3d>{.radius = 0.5}));
  sim.init();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto hit = *sim.pick({0, 0, 6}, {0, 0, -1});
  for (const double k : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()})
    CHECK_THROWS_AS(sim.attach(hit, {.stiffness = k}), Error);
  for (const double c : {-1.0, nan}) CHECK_THROWS_AS(sim.attach(hit, {.damping = c}), Error);
  CHECK_THROWS_AS(sim.attach(Pick{}), Error);
  Pick other = hit;
  other.place.vertices[0] = 7;
  CHECK_THROWS_AS(sim.attach(other), Error);
  other = hit;
  other.path = "/root/elsewhere";
  CHECK_THROWS_AS(sim.attach(other), Error);
  CHECK_THROWS_WITH(sim.attach(*sim.pick({3, 0, 6}, {0, 0, -1})),
                    Catch::Contains("no force moves this model"));
  CHECK(sim.root().get<Contacts>().attachments.empty());
  const int spring = sim.attach(hit);
  CHECK_THROWS_AS(sim.pull(spring, {nan, 0, 0}), Error);
  CHECK_THROWS_AS(sim.pull(spring, {0, 0, 0}, {nan, 0, 0}), Error);
  CHECK(sim.attachment(spring)->target == hit.point);
  sim.animate(0.01);
  CHECK(sim.at<"ball">().state().velocity[0].norm() == 0);
}

TEST_CASE("a mouse presses, moves in the plane that it faces, and releases") {
  auto sim = ball(0);
  sim.init();
  MouseInteractor mouse{.spring = {.stiffness = 1000, .damping = 100}};
  CHECK(!mouse.press(sim, {0, 3, 3}, {0, 0, -1}));
  CHECK(!mouse.move(sim, {0, 3, 3}, {0, 0, -1}));
  CHECK(!mouse.release(sim));
  REQUIRE(mouse.press(sim, {0, 0, 3}, {0, 0, -1}));
  // 2.5 m away along the first ray: a pointer 0.2 aside per metre moves it by 0.5
  CHECK(mouse.move(sim, {0, 0, 3}, {0.2, 0, -1}));
  for (int i = 0; i < 3000; ++i) sim.animate(0.01);
  CHECK((sim.at<"ball">().state().position[0] - Point(0.5, 0, 0)).norm() < 1e-9);
  CHECK(!mouse.move(sim, {0, 0, 3}, {0, 0, 1}));
  CHECK(mouse.release(sim));
  CHECK(!mouse.release(sim));
  CHECK(sim.root().get<Contacts>().attachments.empty());
}

}  // namespace test_mouse_interactor
