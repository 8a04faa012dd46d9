// SPDX-License-Identifier: BSL-1.0
// A rigid bolt in a rigid nut: the thread of the bolt as points along a helix, that of the nut as two
// helicoids of triangles, between which the points are.
#include "lagrangian/contact_scenes.hpp"

namespace test_bolt_in_nut {

using namespace sinew;
using Eigen::Vector3d;

namespace {

constexpr double pitch = 0.05, radius = 0.02, mass = 2, inertia = 8e-4;  // m, m, kg, kg m^2
constexpr double skin = 5e-4, play = 2e-5;                               // m
const double slope = pitch / (2 * M_PI * radius);                        // tan of the lead angle

/// Both flanks of four turns of the nut, as far above and below the helix as the points keep away, and half
/// the play more. They are narrow, since the two triangles of a facet have the slopes of their rims.
MeshTopology nut(std::vector<Vector3d>& points) {
  MeshTopology flanks;
  const int facets = 96, turns = 4;
  const double away = (skin / std::cos(std::atan(slope))) + play / 2;
  for (const double side : {-1., 1.})
    for (int i = 0; i <= facets * turns; ++i) {
      const double turn = 2 * M_PI * (double(i) / facets - turns / 2.);
      const int first = int(points.size());
      for (const double r : {0.998 * radius, 1.002 * radius})
        points.push_back({r * std::cos(turn), r * std::sin(turn), pitch * turn / (2 * M_PI) + side * away});
      if (i == 0) continue;
      flanks.triangles.push_back({first - 2, first, first + 1});
      flanks.triangles.push_back({first - 2, first + 1, first - 1});
    }
  return flanks;
}

template <class Solver>
auto bolt(Solver solver, double mu, double weight, double torque) {
  std::vector<Vector3d> flanks, thread;
  MeshTopology topology = nut(flanks);
  for (int i = 0; i < 8; ++i) {  // a turn and a bit, at angles that no two facets have alike
    const double turn = 2 * M_PI * (i - 3.5) / 6.7;
    thread.push_back({radius * std::cos(turn), radius * std::sin(turn), pitch * turn / (2 * M_PI)});
  }
  const RigidMass<double, 3> body{mass, inertia * Eigen::Matrix3d::Identity()};
  Rigid3d::Deriv load;
  load << 0, 0, -weight, 0, 0, torque;
  auto sim = constrained_scene_by(
      solver,
      MinProximityIntersection{.alarmDistance = 4e-3, .contactDistance = skin},
      mu,
      node<"nut">(topology,
                  MechanicalObject<Vec3d>{.position = flanks},
                  TriangleCollisionModel<Vec3d>{.moving = false, .simulated = false, .bothSide = true}),
      // in a guide along its axis, about which it turns
      node<"bolt">(EulerExplicitSolver{},
                   MechanicalObject<Rigid3d>{.position = {{}}},
                   UniformMass<Rigid3d>{.vertexMass = body},
                   ConstantForceField<Rigid3d>{.indices = {0}, .forces = {load}},
                   PartialFixedConstraint<Rigid3d>{.indices = {0}, .fixedDirections = {1, 1, 0, 1, 1, 0}},
                   node<"thread">(MechanicalObject<Vec3d>{.position = thread},
                                  RigidMapping<Rigid3d, Vec3d>{},
                                  PointCollisionModel<Vec3d>{})));
  sim.root().template get<Gravity>().gravity.setZero();
  sim.init();
  return sim;
}

/// The angle of the bolt about its axis, turns counted, from step to step, and how far it is off the helix.
template <class Sim>
struct Run {
  double angle = 0, off = 0, last = 0;
  void go(Sim& sim, int steps, double dt) {
    for (int i = 0; i < steps; ++i) {
      sim.animate(dt);
      auto const& x = sim.template at<"bolt">().state().position[0];
      const double now = 2 * std::atan2(x.orientation.z(), x.orientation.w());
      angle += std::remainder(now - last, 2 * M_PI);
      last = now;
      off = std::max(off, std::abs(x.center[2] - pitch * angle / (2 * M_PI)));
    }
  }
};
template <class Sim>
Run<Sim> after(Sim& sim, int steps, double dt) {
  Run<Sim> run;
  run.go(sim, steps, dt);
  return run;
}

const BlockGaussSeidelConstraintSolver gaussSeidel{.maxIterations = 2000, .tolerance = 1e-9};
const ConvexConstraintSolver convex{.tolerance = 1e-10, .momentumTolerance = 1e-9};

}  // namespace

TEST_CASE("a bolt that is turned in its nut advances by its pitch in a turn, and carries its inertia along") {
  // without friction: (I + m (p / 2 pi)^2) a = torque
  const double along = pitch / (2 * M_PI), whole = inertia + mass * along * along;
  const double seconds = 1, torque = whole * 4 * M_PI / (seconds * seconds);  // a turn
  auto turns = [&](auto solver) {
    auto sim = bolt(solver, 0, 0, torque);
    const int steps = 200;
    const auto run = after(sim, steps, seconds / steps);
    INFO(run.angle << " " << run.off);
    for (auto const& w : sim.warnings().list()) UNSCOPED_INFO(w.text() << " " << w.count);
    // symplectic Euler is ahead by 1 / steps; what the play and the facets leave
    CHECK(run.angle == Approx(2 * M_PI * (1 + 1. / steps)).epsilon(2e-3));
    CHECK(run.off < play + 2e-5);
    CHECK(sim.template at<"bolt">().state().position[0].center[2] == Approx(pitch).epsilon(5e-3));
    CHECK(sim.warnings().list().empty());
  };
  turns(gaussSeidel);
  turns(convex);
}

TEST_CASE(
    "a nut holds its bolt under its weight by friction above the slope of its thread, and lets it run "
    "below",
    "[long]") {
  // With the lead angle l and the normal N of all contacts: m a = m g - N (cos l + mu sin l), and about the
  // axis I a / (r^2 tan l) = N (sin l - mu cos l).
  const double weight = mass * g, l = std::atan(slope);
  auto runs = [&](auto solver, double part) {
    const double mu = part * slope;
    auto sim = bolt(solver, mu, weight, 0);
    const int steps = 100;
    const double seconds = 0.4;
    const auto run = after(sim, steps, seconds / steps);
    INFO(part << " " << run.angle << " " << run.off);
    CHECK(run.off < play + 2e-5);
    if (part > 1) {
      CHECK(std::abs(run.angle) < 2e-3);  // the play, which it falls through at first
      return;
    }
    const double lever = inertia * (std::cos(l) + mu * std::sin(l)) /
                         (radius * radius * slope * (std::sin(l) - mu * std::cos(l)));
    const double a = weight / (mass + lever), way = a * seconds * seconds / 2 * (1 + 1. / steps);
    // the play at first, and facets whose two triangles differ in slope by 0.4 %, where the bolt hits kinks
    CHECK(run.angle == Approx(-2 * M_PI * way / pitch).epsilon(0.03));
  };
  for (const double part : {0.5, 1.1}) {
    runs(gaussSeidel, part);
    runs(convex, part);
  }
}

}  // namespace test_bolt_in_nut
