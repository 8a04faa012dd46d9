// SPDX-License-Identifier: BSL-1.0
// The convex solver as a component: what it says, refuses and leaves, against Gauss-Seidel on the compliance.
#include "error_of.hpp"
#include "lagrangian/contact_scenes.hpp"

#include <sinew/topology/regular_grid.hpp>

#include <limits>

namespace test_convex_constraint_solver {

using namespace sinew;
using Eigen::Vector3d;

namespace {

constexpr double dt = 0.01;

const ConvexConstraintSolver convex{
    .tolerance = 1e-11, .momentumTolerance = 1e-11, .maxUpdates = 500, .stopsUnsolved = true};
const BlockGaussSeidelConstraintSolver gaussSeidel{.maxIterations = 50000, .tolerance = 1e-13};

RigidMass<double, 3> ball(double mass, double radius) {
  return {mass, 0.4 * mass * radius * radius * Eigen::Matrix3d::Identity()};
}
template <FixedString Name>
auto rigid_ball(Vector3d const& place, Vector3d const& velocity) {
  Rigid3d::Deriv v;
  v << velocity, 0, 0, 0;
  return node<Name>(
      EulerExplicitSolver{},
      MechanicalObject<Rigid3d>{.position = {{place, Eigen::Quaterniond::Identity()}}, .velocity = {v}},
      UniformMass<Rigid3d>{.vertexMass = ball(1, 0.2)},
      SphereCollisionModel<Rigid3d>{.radius = 0.2});
}
// an elastic block of 0.4 x 0.4 x 0.2 m and 2 kg from the height 0.01 m on
template <class Ode, class... Linear>
auto soft_block(Ode ode, Linear... linear) {
  const Mesh mesh = regular_grid_tetrahedra(5, 5, 3, {-0.2, -0.2, 0.01}, {0.2, 0.2, 0.21});
  return node<"block">(ode,
                       linear...,
                       TetrahedronTopology{mesh.tetrahedra},
                       MechanicalObject<Vec3d>{mesh.positions},
                       UniformMass<Vec3d>{.totalMass = 2},
                       TetrahedronFEMForceField<Vec3d>{.youngModulus = {2e4}, .poissonRatio = 0.3},
                       PointCollisionModel<Vec3d>{},
                       TriangleCollisionModel<Vec3d>{});
}

// two balls fall onto a soft block on a floor; a third is joined to one of them by a ball joint
template <class Solver>
auto several(Solver solver, double mu) {
  auto sim = RegistryScene{node<"root">(
      FreeMotionAnimationLoop{},
      solver,
      DefaultPipeline{},
      BruteForceBroadPhase{},
      BVHNarrowPhase{},
      near_by(),
      DefaultContactManager{.response = "FrictionContactConstraint", .responseParams = text("mu=", mu)},
      Gravity{{0, 0, -g}},
      BilateralLagrangianConstraint<Vec3d, Between<"b/pin", "c/pin">>{.first_point = {0},
                                                                      .second_point = {0}},
      fixed_floor(),
      soft_block(EulerImplicitSolver{.rayleighStiffness = 0.01}, SparseLDLSolver<>{}),
      rigid_ball<"a">({-0.23, 0.03, 0.43}, {0.5, 0, -0.5}),
      node<"b">(
          EulerExplicitSolver{},
          MechanicalObject<Rigid3d>{.position = {{{0.22, -0.01, 0.43}, Eigen::Quaterniond::Identity()}}},
          UniformMass<Rigid3d>{.vertexMass = ball(1, 0.2)},
          SphereCollisionModel<Rigid3d>{.radius = 0.2},
          node<"pin">(MechanicalObject<Vec3d>{.position = {{0.3, 0, 0}}}, RigidMapping<Rigid3d, Vec3d>{})),
      node<"c">(EulerImplicitSolver{},
                CGLinearSolver<>{.iterations = 50, .tolerance = 1e-15, .threshold = 0},
                MechanicalObject<Rigid3d>{.position = {{{0.82, 0, 0.43}, Eigen::Quaterniond::Identity()}}},
                UniformMass<Rigid3d>{.vertexMass = ball(0.5, 0.2)},
                node<"pin">(MechanicalObject<Vec3d>{.position = {{-0.3, 0.01, 0}}},
                            RigidMapping<Rigid3d, Vec3d>{})))};
  sim.init();
  return sim;
}

}  // namespace

TEST_CASE("bodies of several solvers, with contacts and a joint, go as Gauss-Seidel on W has it", "[long]") {
  for (const double mu : {0., 0.4}) {
    INFO(mu);
    auto one = several(convex, mu);
    auto other = several(gaussSeidel, mu);
    int contacts = 0;
    double differs = 0, residual = 0, apart = 0;
    for (int i = 0; i < 40; ++i) {
      // both from the same state, so that differences do not grow from step to step
      auto each = [&](auto&& f) {
        f(other.template at<"block">().state(), one.template at<"block">().state());
        f(other.template at<"a">().state(), one.template at<"a">().state());
        f(other.template at<"b">().state(), one.template at<"b">().state());
        f(other.template at<"c">().state(), one.template at<"c">().state());
      };
      each([](auto& to, auto const& from) { to.position = from.position, to.velocity = from.velocity; });
      one.animate(dt);
      other.animate(dt);
      contacts = std::max(contacts, int(one.root().template get<DefaultContactManager>().contacts.size()));
      each([&](auto const& a, auto const& b) {
        for (std::size_t k = 0; k < a.velocity.size(); ++k)
          differs = std::max(differs, (a.velocity[k] - b.velocity[k]).norm());
      });
      // its multipliers in the problem on W
      ConstraintProblem problem = other.root().template get<FreeMotionAnimationLoop>().motion.problem;
      problem.multipliers = one.root().template get<FreeMotionAnimationLoop>().motion.problem.multipliers;
      residual = std::max(residual, problem.residual());
      apart =
          (one.template at<"b/pin">().state().position[0] - one.template at<"c/pin">().state().position[0])
              .norm();
    }
    CHECK(contacts > 25);
    // 1e-11 m by an estimate of W, of which W is up to some ten times
    CHECK(residual < 1e-9);
    // with friction the motion of a step is not determined where several contacts share a load
    CHECK(differs < (mu == 0 ? 1e-7 : 1e-3));
    // rows are of the start of a step, at which bodies turn by 1e-2
    CHECK(apart < 1e-3);
  }
}

TEST_CASE("what the convex solver says of a step: how far it came, and with how many iterations") {
  auto sim = constrained_scene_by(
      ConvexConstraintSolver{}, near_by(), 0.5, fixed_floor(), rigid_ball<"a">({0, 0, 0.21}, {1, 0, 0}));
  sim.init();
  auto const& result = sim.root().get<ConvexConstraintSolver>().result;
  sim.animate(dt);
  CHECK(result.converged);
  CHECK(result.residual <= 1e-6);
  CHECK(result.momentum <= 1e-6);
  CHECK(result.updates > 0);
  CHECK(result.newtonIterations > 0);
  CHECK(result.conjugateGradients >= result.newtonIterations);
  CHECK(result.lineSearches >= result.newtonIterations);
  // it starts from the multipliers of the last step: what goes on needs fewer updates
  const int first = result.updates;
  for (int i = 0; i < 5; ++i) sim.animate(dt);
  CHECK(result.converged);
  CHECK(result.updates <= first);
  // a step without contact has nothing to solve, and leaves the last result
  auto up = constrained_scene_by(
      ConvexConstraintSolver{}, near_by(), 0.5, fixed_floor(), rigid_ball<"a">({0, 0, 3}, {0, 0, 0}));
  up.init();
  up.animate(dt);
  CHECK(up.root().get<ConvexConstraintSolver>().result.converged);
  CHECK(up.root().get<ConvexConstraintSolver>().result.updates == 0);
}

TEST_CASE("what slides on as before starts from the motion of the last step, and takes few iterations") {
  // down a slope of 45 degrees, where friction of 0.5 lets it slide
  auto slides = [](bool forgets) {
    auto sim =
        constrained_scene_by(ConvexConstraintSolver{.tolerance = 1e-8, .momentumTolerance = 1e-8},
                             near_by(),
                             0.5,
                             fixed_floor(),
                             soft_block(EulerImplicitSolver{.rayleighStiffness = 0.1}, SparseLDLSolver<>{}));
    sim.root().template get<Gravity>().gravity = {g, 0, -g};
    sim.init();
    auto& solver = sim.root().template get<ConvexConstraintSolver>();
    for (int i = 0; i < 100; ++i) {
      if (forgets) solver.lastMotion.clear();
      sim.animate(dt);
      CHECK(solver.result.converged);
    }
    auto const& v = sim.template at<"block">().state().velocity;
    double mean = 0;
    for (auto const& one : v) mean += one[0] / double(v.size());
    return std::pair(solver.result.conjugateGradients, mean);
  };
  const auto [few, slid] = slides(false);
  const auto [many, alsoSlid] = slides(true);
  CHECK(many > 20);
  CHECK(few < many / 2);
  // 10 (sin - mu cos) / cos of the slope for 1 s; 1e-8 m a step of 0.01 s are 1e-4 m/s in 100 steps
  CHECK(slid == Approx(5).margin(5e-4));
  CHECK(alsoSlid == Approx(5).margin(5e-4));
}

TEST_CASE("settings of the convex solver out of their range are refused at init, with their names") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  auto says = [](ConvexConstraintSolver const& solver) {
    return error_of([&] { constrained_scene_by(solver, near_by(), 0.5, fixed_floor()).init(); });
  };
  CHECK(says({}).empty());
  auto refuses = [&](ConvexConstraintSolver const& solver, std::string const& field) {
    CHECK_THAT(says(solver), Catch::Contains("/root: ConvexConstraintSolver") && Catch::Contains(field));
  };
  refuses({.tolerance = 0}, "tolerance");
  refuses({.tolerance = nan}, "tolerance");
  refuses({.momentumTolerance = -1}, "momentumTolerance");
  refuses({.maxUpdates = 0}, "maxUpdates");
  refuses({.maxIterations = 0}, "maxIterations");
}

TEST_CASE("a step that the convex solver cannot solve is an Error with its residual, or goes on") {
  auto make = [](bool stops) {
    auto sim = constrained_scene_by(
        ConvexConstraintSolver{.maxUpdates = 1, .maxIterations = 3, .stopsUnsolved = stops},
        near_by(),
        0.5,
        fixed_floor(),
        soft_block(EulerImplicitSolver{}, SparseLDLSolver<>{}));
    sim.init();
    return sim;
  };
  auto stops = make(true), goes = make(false);
  CHECK_THAT(error_of([&] { stops.animate(dt); }),
             Catch::Contains("/root: ConvexConstraintSolver") && Catch::Contains("not solved after 3") &&
                 Catch::Contains("residual is") && Catch::Contains("maxUpdates"));
  for (int i = 0; i < 20; ++i) goes.animate(dt);
  auto const& result = goes.root().get<ConvexConstraintSolver>().result;
  CHECK_FALSE(result.converged);
  CHECK(result.residual > 1e-6);
  for (auto const& x : goes.at<"block">().state().position) CHECK(x.allFinite());
}

TEST_CASE("what the convex solver has no system for is refused with the component to take instead") {
  // points on a line have no blocks of three
  RegistryScene line{
      node<"root">(FreeMotionAnimationLoop{},
                   ConvexConstraintSolver{},
                   node<"cart">(EulerExplicitSolver{},
                                MechanicalObject<Vec1d>{.position = {Vec1d::Coord(0.)}},
                                UniformMass<Vec1d>{.totalMass = 1},
                                StopperLagrangianConstraint<Vec1d>{.index = 0, .min = -1, .max = 1}))};
  line.init();
  CHECK_THAT(error_of([&] { line.animate(dt); }),
             Catch::Contains("/root/cart") && Catch::Contains("MechanicalObject<Vec1d>") &&
                 Catch::Contains("BlockGaussSeidelConstraintSolver"));
}

TEST_CASE("statics: a block that is pressed on a floor lies with its weight, by either kind of solvers") {
  // an equilibrium is found from any start: the floor alone holds the block, but for shifts along it
  auto pressed = [](auto solver) {
    const Mesh mesh = regular_grid_tetrahedra(4, 4, 3, {-0.15, -0.15, 0.005}, {0.15, 0.15, 0.205});
    std::vector<int> top;
    for (int i = 32; i < 48; ++i) top.push_back(i);
    auto sim = constrained_scene_by(solver,
                                    near_by(),
                                    0.3,
                                    fixed_floor(),
                                    static_block(mesh, PartialFixedConstraint<Vec3d>{.indices = top}));
    sim.init();
    for (int i = 0; i < 3; ++i) sim.animate(dt);
    const double force = force_on(sim.root().template get<DefaultContactManager>(), "/root/block")[2];
    std::vector<Vector3d> x = sim.template at<"block">().state().position;
    for (auto const& p : x) CHECK(p[2] > 0.01 - 1e-8);
    return std::pair(force, x);
  };
  const auto one = pressed(convex), other = pressed(gaussSeidel);
  // 1e5 N/m^2 pressed by 5 mm of 20 cm over 0.09 m^2: some 200 N
  CHECK(one.first > 100);
  CHECK(one.first == Approx(other.first).epsilon(1e-6));
  for (std::size_t i = 0; i < one.second.size(); ++i) CHECK((one.second[i] - other.second[i]).norm() < 1e-7);
}

TEST_CASE("a heap of rigid balls gains no energy and no momentum but by the floor, and comes to rest") {
  std::vector<Rigid3d::Coord> places;
  for (int i = 0; i < 30; ++i)
    places.push_back({{0.5 * (i % 3) + 0.011 * i, 0.5 * (i / 3 % 3) - 0.007 * i, 0.3 + 0.43 * double(i / 9)},
                      Eigen::Quaterniond::Identity()});
  auto sim = constrained_scene_by(
      ConvexConstraintSolver{.tolerance = 1e-8, .momentumTolerance = 1e-8, .maxUpdates = 200},
      near_by(),
      0.4,
      fixed_floor(),
      node<"balls">(EulerExplicitSolver{},
                    MechanicalObject<Rigid3d>{.position = places},
                    UniformMass<Rigid3d>{.vertexMass = ball(1, 0.2)},
                    SphereCollisionModel<Rigid3d>{.selfCollision = true, .radius = 0.2}));
  sim.init();
  auto const& s = sim.at<"balls">().state();
  auto const& manager = sim.root().get<DefaultContactManager>();
  auto energy = [&] {
    double e = 0;
    for (std::size_t i = 0; i < s.position.size(); ++i)
      e += s.velocity[i].head<3>().squaredNorm() / 2 + 0.008 * s.velocity[i].tail<3>().squaredNorm() +
           g * s.position[i].center[2];
    return e;
  };
  auto momentum = [&] {
    Vector3d p(0, 0, 0);
    for (auto const& v : s.velocity) p += v.head<3>();
    return p;
  };
  double last = energy(), grown = 0, lost = 0;
  int unsolved = 0;
  for (int i = 0; i < 200; ++i) {
    const Vector3d before = momentum();
    sim.animate(dt);
    const Vector3d change = (momentum() - before) / dt + Vector3d(0, 0, 30 * g);
    lost = std::max(lost, (change + force_on(manager, "/root/floor")).norm());
    grown = std::max(grown, energy() - last);
    last = energy();
    unsolved += !sim.root().get<ConvexConstraintSolver>().result.converged;
  }
  // of 300 N, and of some 200 J
  CHECK(lost < 1e-3);
  CHECK(grown < 1e-5);
  CHECK(unsolved == 0);
}

}  // namespace test_convex_constraint_solver
