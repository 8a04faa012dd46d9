// SPDX-License-Identifier: BSL-1.0
// Contacts with what stands in the fused step, against the steps of Simulation and closed forms.
#include "error_of.hpp"
#include "scenes_found.hpp"

#include "catch.hpp"

#include <sinew/gpu/fused/simulation.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

namespace test_fused_contact {

using namespace gpu_test;

namespace {

constexpr double dt = 0.01, g = BlockOnPlane::g, mass = BlockOnPlane::mass;

using Linear = CGLinearSolver<>;
template <class D>
auto points_on(BlockOnFloor const& scene) {
  return scene.make<D, Linear>(PointCollisionModel<D>{});
}
template <class D>
auto spheres_on(BlockOnFloor const& scene) {
  return scene.make<D, Linear>(SphereCollisionModel<D>{.radius = 0.004});
}
template <class D>
auto held_on(BlockOnFloor const& scene) {
  const Mesh m = BlockOnPlane{}.mesh();
  return scene.make<D, Linear>(
      PointCollisionModel<D>{},
      FixedConstraint<D>{.indices = BlockOnPlane::points(m, [](auto const& x) { return x[0] < 1e-9; })},
      PartialFixedConstraint<D>{.indices = BlockOnPlane::points(m, [](auto const& x) { return x[1] > 0.99; }),
                                .fixedDirections = {true, false, false}});
}

// A block on a square floor, or on several that are a millimetre apart, on which gravity is turned by a
// slope.
template <class D>
auto block_on_plane(BlockOnPlane const& b, int floors = 1) {
  const Mesh m = b.mesh();
  MeshTopology floor;
  for (int k = 0; k < floors; ++k) {
    const double z = -0.01 - 0.001 * k;
    const int i = 4 * k;
    floor.triangles.push_back({i, i + 1, i + 2});
    floor.triangles.push_back({i, i + 2, i + 3});
    for (auto const& [x, y] : {std::pair{-50., -50.3}, {50., -50.3}, {50., 50.}, {-50., 50.}})
      floor.position.push_back({x, y, z});
  }
  Simulation sim{
      node<"root">(FreeMotionAnimationLoop{},
                   b.solver(),
                   b.gravity(),
                   DefaultPipeline{},
                   BruteForceBroadPhase{},
                   BVHNarrowPhase{},
                   MinProximityIntersection{.alarmDistance = 0.02, .contactDistance = 0.01},
                   DefaultContactManager{.response = "FrictionContactConstraint",
                                         .responseParams = "mu=" + std::to_string(b.mu)},
                   node<"floor">(floor,
                                 MechanicalObject<Vec3d>{},
                                 TriangleCollisionModel<Vec3d>{.moving = false, .simulated = false}),
                   node<"body">(b.ode(),
                                b.linear(),
                                MeshTopology{.position = m.positions, .tetrahedra = m.tetrahedra},
                                MechanicalObject<D>{},
                                UniformMass<D>{.totalMass = b.mass},
                                b.material<D>(),
                                PointCollisionModel<D>{}))};
  sim.init();
  return sim;
}

template <class Sim>
auto const& state_of(Sim& sim) {
  return std::as_const(sim.template at<"body">().state());
}
template <class X, class Y>
double largest_difference(X const& x, Y const& y) {
  double far = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double d = (x[i].template cast<double>() - y[i].template cast<double>()).norm();
    far = d <= far ? far : d;  // a NaN stays
  }
  return far;
}
template <class Sim>
auto& contacts_of(Sim& sim) {
  return sim.root().template first<role::ContactManager>().contacts;
}
template <class State>
Eigen::Vector3d momentum_of(State const& state) {
  Eigen::Vector3d sum(0, 0, 0);
  for (std::size_t i = 0; i < state.size(); ++i)
    sum += mass / double(state.size()) * state.velocity[i].template cast<double>();
  return sum;
}

// the fused steps of a scene, all in two launches, go as on the host
template <class Fused, class Host>
void goes_as(Fused sim, Host host, int steps, double far, int blocks = 0) {
  sim.init();
  host.init();
  gpu::FusedSimulation fused(sim, 1, blocks);
  const auto start = state_of(host).position;
  for (int i = 0; i < steps; ++i) host.animate(dt);
  fused.animate(dt, steps / 2);
  fused.animate(dt, steps - steps / 2);
  fused.finish();
  fused.store(0, sim);
  CHECK(fused.unsolved(0) == 0);
  CHECK(largest_difference(state_of(host).position, start) > 0.01);
  CHECK(largest_difference(state_of(sim).position, state_of(host).position) < far);
  CHECK(largest_difference(state_of(sim).velocity, state_of(host).velocity) < far / dt);
}

}  // namespace

// Each of the steps is solved to 1e-12 m by both, in another order; as a velocity that goes on to the end,
// which makes 40^2 / 2 of them.
TEST_CASE("the fused step of a block that slides over triangles is that of the Simulation", "[long]") {
  const BlockOnFloor floor;
  // of a copy: chosen, one block, a cluster, all of a GPU; on the host they are all one thread
  for (const int blocks : {0, 1, 4, 1000}) {
    INFO("blocks " << blocks);
    goes_as(points_on<CudaVec3d>(floor), points_on<Vec3d>(floor), 40, 1e-9, blocks);
  }
}
TEST_CASE("the fused step of spheres on triangles without friction is that of the Simulation") {
  const BlockOnFloor floor{.mu = 0};
  goes_as(spheres_on<CudaVec3d>(floor), spheres_on<Vec3d>(floor), 40, 1e-9);
}
TEST_CASE("the fused step of points that are held and touch is that of the Simulation") {
  const BlockOnFloor floor{.slope = 0.5};
  goes_as(held_on<CudaVec3d>(floor), held_on<Vec3d>(floor), 40, 1e-9);
}
TEST_CASE("the fused step of contacts in float is that of the Simulation") {
  const BlockOnFloor floor;
  auto sim = points_on<CudaVec3f>(floor);
  auto exact = points_on<Vec3d>(floor);
  sim.init();
  exact.init();
  for (int i = 0; i < 40; ++i) exact.animate(dt);
  gpu::FusedSimulation fused(sim);
  fused.animate(dt, 40);
  fused.finish();
  fused.store(0, sim);
  // positions of a metre are rounded by 6e-8 m in each of 40 steps; as a velocity that goes on to the end,
  // that makes 40^2 / 2 of it
  CHECK(largest_difference(state_of(sim).position, state_of(exact).position) < 5e-5);
}

TEST_CASE("the fused step finds the contacts of the host, with their forces") {
  const BlockOnFloor floor;
  auto sim = points_on<CudaVec3d>(floor);
  auto host = points_on<Vec3d>(floor);
  sim.init();
  host.init();
  gpu::FusedSimulation fused(sim);
  for (int step = 0; step < 40; ++step) {
    host.animate(dt);
    fused.animate(dt);
    CAPTURE(step);
    auto found = fused.contacts(0);
    auto const& expected = contacts_of(host);
    REQUIRE(found.size() == expected.size());
    // the floor is the first model, and of the body one vertex touches
    for (Contact const& c : expected) {
      const auto is = std::find_if(found.begin(), found.end(), [&](auto const& of) {
        return of.first == c.b.vertices[0] && of.second.found.vertices == c.a.vertices;
      });
      REQUIRE(is != found.end());
      gpu::FusedContact const& same = is->second;
      CHECK((same.normal - c.normal).norm() < 1e-9);
      CHECK((same.force - c.force).norm() < 1e-4);  // of 500 N
      CHECK(same.found.distance == Approx(c.distance).margin(1e-10));
    }
  }
}

TEST_CASE("fused steps with contacts make the same bits in one launch and in many") {
  auto one = points_on<CudaVec3d>({}), many = points_on<CudaVec3d>({});
  one.init();
  many.init();
  gpu::FusedSimulation whole(one), split(many);
  whole.animate(dt, 30);
  for (int i = 0; i < 30; ++i) split.animate(dt);
  whole.store(0, one);
  split.store(0, many);
  CHECK(state_of(one).position == state_of(many).position);
  // and on with the Simulation's own step, to the tolerance
  auto host = points_on<Vec3d>({});
  host.init();
  for (int i = 0; i < 31; ++i) host.animate(dt);
  one.animate(dt);
  CHECK(largest_difference(state_of(one).position, state_of(host).position) < 1e-9);
}

TEST_CASE("contacts of a fused step balance momentum") {
  // h (m g + sum of forces) is what momentum gains: internal forces and Rayleigh damping of the stiffness
  // have no sum
  const BlockOnPlane b{.slope = 0.3};
  auto sim = block_on_plane<CudaVec3d>(b);
  gpu::FusedSimulation fused(sim);
  Eigen::Vector3d before(0, 0, 0), total(0, 0, 0);
  for (int step = 0; step < 40; ++step) {
    fused.animate(dt);
    fused.store(0, sim);
    Eigen::Vector3d force = mass * b.gravity().gravity, friction(0, 0, 0);
    for (auto const& [vertex, c] : fused.contacts(0)) {
      force += c.force;
      total += dt * c.force;
      // inside the cone of friction
      const double normal = c.normal.dot(c.force);
      CHECK(normal > -1e-6);
      CHECK((c.force - normal * c.normal).norm() <= b.mu * normal + 1e-6);
    }
    const Eigen::Vector3d after = momentum_of(state_of(sim));
    CAPTURE(step, force.transpose());
    CHECK((after - before - dt * force).norm() < 1e-9 * mass * g * dt * (step + 1));
    before = after;
  }
  CHECK(total[2] > 0.5 * mass * g * 40 * dt * std::cos(b.slope));  // they bear
}

TEST_CASE("a block on an incline in fused steps sticks and slides at the angle of friction", "[long]") {
  const double mu = 0.2, angle = std::atan(mu);
  for (const double slope : {0.99 * angle, 1.2 * angle, 2 * angle}) {
    auto sim = block_on_plane<CudaVec3d>({.cells = 2, .slope = slope, .mu = mu});
    gpu::FusedSimulation fused(sim);
    auto velocity_at = [&](double time) {
      fused.animate(dt, int(std::lround((time - fused.time()) / dt)));
      fused.finish();
      fused.store(0, sim);
      return momentum_of(state_of(sim))[0] / mass;
    };
    // when the oscillations of the start have gone, and all of it slides still
    const double before = velocity_at(1.5), after = velocity_at(2);
    const double acceleration = g * (std::sin(slope) - mu * std::cos(slope));
    CAPTURE(slope / angle, before, after, acceleration);
    CHECK(before > 0.01);
    CHECK(std::abs((after - before) / 0.5 - acceleration) < 1e-5);
    if (slope < angle) CHECK(std::abs(velocity_at(3.5)) < 1e-6);
    CHECK(fused.unsolved(0) == 0);
  }
}

TEST_CASE("copies of a scene with contacts have their own gravity and contacts", "[long]") {
  auto flat = block_on_plane<CudaVec3d>({.cells = 2, .slope = 0.1}),
       steep = block_on_plane<CudaVec3d>({.cells = 2, .slope = 0.4});
  auto flatHost = block_on_plane<Vec3d>({.cells = 2, .slope = 0.1}),
       steepHost = block_on_plane<Vec3d>({.cells = 2, .slope = 0.4});
  for (int i = 0; i < 30; ++i) flatHost.animate(dt), steepHost.animate(dt);
  gpu::FusedSimulation fused(flat, 7);
  fused.load(3, steep);
  fused.animate(dt, 30);
  fused.finish();
  auto end = block_on_plane<CudaVec3d>({.cells = 2});
  for (const int copy : {0, 2, 3, 6}) {
    fused.store(copy, end);
    auto& host = copy == 3 ? steepHost : flatHost;
    CAPTURE(copy);
    CHECK(largest_difference(state_of(end).position, state_of(host).position) < 1e-9);
    CHECK(fused.contacts(copy).size() == contacts_of(host).size());
  }
}

TEST_CASE("fused steps go on where contacts are not solved, or stop as the scene says") {
  auto sim = points_on<CudaVec3d>({});
  auto& solver = sim.root().first<role::ConstraintSolver>();
  solver.maxUpdates = 1;
  sim.init();
  gpu::FusedSimulation going(sim);
  going.animate(dt, 3);
  going.finish();
  CHECK(going.unsolved(0) == 3);
  solver.stopsUnsolved = true;
  gpu::FusedSimulation stopping(sim);
  stopping.animate(dt, 3);
  CHECK(error_of([&] { stopping.finish(); }).find("contacts were not solved to the tolerances in 3 steps") !=
        std::string::npos);
}

TEST_CASE("contacts that a fused step does not know are said") {
  const BlockOnFloor floor;
  auto sim = points_on<CudaVec3d>(floor);
  sim.init();
  gpu::FusedSimulation fused(sim);
  auto refuses = [&](auto& other, std::string const& said) {
    const std::string error = error_of([&] { gpu::FusedSimulation again(other); });
    CAPTURE(error);
    CHECK(error.find(said) != std::string::npos);
  };
  SECTION("a field of the loop") {
    sim.root().first<role::AnimationLoop>().solveVelocityConstraintFirst = true;
    refuses(sim, "solveVelocityConstraintFirst");
  }
  SECTION("a response by forces") {
    auto other = points_on<CudaVec3d>(floor);
    other.root().first<role::ContactManager>().response = "PenalityContactForceField";
    other.root().first<role::ContactManager>().responseParams = "";
    other.init();
    refuses(other, "take FrictionContactConstraint");
  }
  SECTION("the body against itself") {
    auto other = points_on<CudaVec3d>(floor);
    other.at<"body">().first<role::CollisionModel>().selfCollision = true;
    other.init();
    refuses(other, "these two may meet otherwise: /root/body and /root/body");
  }
  SECTION("a floor elsewhere for another copy") {
    auto other = points_on<CudaVec3d>(floor);
    other.init();
    other.at<"floor">().state().position[0][2] += 0.1;
    CHECK(error_of([&] { fused.load(0, other); }).find("surfaces that stand are elsewhere") !=
          std::string::npos);
  }
  SECTION("a state that is not finite") {
    sim.at<"body">().state().velocity[5][0] = std::nan("");
    fused.load(0, sim);
    fused.animate(dt, 2);
    CHECK(error_of([&] { fused.finish(); }).find("not a finite number") != std::string::npos);
  }
  SECTION("more places at once than there is room for") {
    auto other = block_on_plane<CudaVec3d>({.cells = 2}, 5);
    gpu::FusedSimulation crowded(other);
    crowded.animate(dt);
    CHECK(error_of([&] { crowded.finish(); }).find("touched more than 4 places at once") !=
          std::string::npos);
  }
}

}  // namespace test_fused_contact
