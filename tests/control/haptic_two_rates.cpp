// SPDX-License-Identifier: BSL-1.0
// Both sides of the coupling at their two rates, without threads: ticks of 1 ms, steps of 10 ms whose result
// is there 5 ms after they began.
#include "catch.hpp"
#include "control/two_rates.hpp"

#include <sinew/control/hand_device.hpp>
#include <sinew/control/haptic_controller.hpp>
#include <sinew/force/rest_shape_springs.hpp>
#include <sinew/force/virtual_coupling.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/solver/sparse_ldl_solver.hpp>
#include <sinew/state/mechanical_object.hpp>

namespace test_haptic_two_rates {

using namespace sinew;

namespace {

/// A tool of 0.05 kg on a coupling, and on springs to where it starts.
auto tool(double wall) {
  const RigidMass<double, 3> mass{0.05, 1e-4 * Eigen::Matrix3d::Identity()};
  return Simulation{node<"root">(
      EulerImplicitSolver{},
      SparseLDLSolver<CompressedRowSparseMatrixd>{},
      MechanicalObject<Rigid3d>{.position = {{}}},
      UniformMass<Rigid3d>{.vertexMass = mass},
      RestShapeSpringsForceField<Rigid3d>{.stiffness = {wall}, .angularStiffness = {wall / 1000}},
      VirtualCoupling<Rigid3d>{})};
}

Rigid3d::Deriv six(double a, double b) {
  Rigid3d::Deriv v;
  v << a, 0, 0, 0, 0, b;
  return v;
}

/// Runs for a time; each(time, wrench) after each tick.
template <class Hand, class Each>
void run(Hand& hand, HapticController c, double wall, double dt, double seconds, Each&& each) {
  auto sim = tool(wall);
  at_two_rates(
      sim,
      sim.root().template get<VirtualCoupling<Rigid3d>>(),
      hand,
      c,
      dt,
      seconds,
      [](auto& scene) {
        auto const& s = scene.root().state();
        return ToolState{s.position[0], s.velocity[0]};
      },
      [&](double time, Wrench const&) { each(time, hand.felt); });
}

Rigid3d::Coord origin(double) { return {}; }

/// Of a device that nobody holds, after a push, early and late.
std::array<double, 2> energies(double stiffness, double dt, double wall) {
  HapticController c{.stiffness = stiffness, .angularStiffness = 1e-3 * stiffness};
  HandDevice hand{&origin};
  hand.mass = c.deviceMass, hand.inertia = c.deviceInertia;
  hand.stiffness = hand.damping = hand.angularStiffness = hand.angularDamping = 0;
  hand.velocity = six(0.01, 0.1);
  std::array<double, 2> maximum{0, 0};
  run(hand, c, wall, dt, 60, [&](double time, Wrench const&) {
    // beside the motion of the device as a whole, which a free tool goes along with
    const double energy = hand.energy();
    if (time < 1) maximum[0] = std::max(maximum[0], energy);
    if (time > 59) maximum[1] = std::max(maximum[1], energy);
  });
  return maximum;
}

}  // namespace

TEST_CASE("at two rates, a device that nobody holds comes to rest on a tool that is held, or floats with it",
          "[long]") {
  for (const double dt : {0.005, 0.01, 0.02})
    for (const double wall : {20., 300., 1e5}) {
      // K h^2 = 2 m, the rule of docs/haptics.md, and no stiffer than one rate alone allows
      const double stiffness = std::min(2 * 0.05 / (dt * dt), 3500.);
      const auto [early, late] = energies(stiffness, dt, wall);
      INFO(dt << " " << wall);
      CHECK(late < 1e-6 * early);
    }
  const auto [early, late] = energies(500, 0.01, 0);
  CHECK(late <= early);
  // K h^2 = 20 m: the step is too long for the stiffness, and the loop would shake
  CHECK(energies(2500, 0.02, 20)[1] > 1e6 * early);
}

TEST_CASE("a tool that is free follows the hand at constant velocity: no force is left") {
  HandDevice hand{[](double time) {
    Rigid3d::Coord pose;
    Rigid3d::increment(pose, time * six(0.1, 0.7));
    return pose;
  }};
  double force = 0, torque = 0;
  run(hand, {}, 0, 0.01, 10, [&](double time, Wrench const& w) {
    if (time < 9) return;
    force = std::max(force, w.force.norm());
    torque = std::max(torque, w.torque.norm());
  });
  // without prediction, the lag of 10 to 15 ms would be felt as K v tau = 0.5 N
  CHECK(force < 1e-8);
  CHECK(torque < 1e-8);
}

TEST_CASE("a hand that presses on an elastic wall rests where hand, coupling and wall balance") {
  HandDevice hand{[](double) {
    Rigid3d::Coord pose;
    Rigid3d::increment(pose, six(0.02, 0.3));
    return pose;
  }};
  hand.pose.center = {1e-12, 0, 0};  // starts at the tool
  const double K = 500, k = 300, wall = 800;
  double largest = 0, last = 0;
  Wrench end;
  run(hand, {.stiffness = K}, wall, 0.01, 20, [&](double, Wrench const& w) {
    largest = std::max(largest, std::abs(w.force[0] - last));
    last = w.force[0];
    end = w;
  });
  // springs in a row: 1 / k_all = 1 / k_h + 1 / K + 1 / k_w
  CHECK(end.force[0] == Approx(-0.02 / (1 / k + 1 / K + 1 / wall)).epsilon(1e-8));
  CHECK(end.torque[2] == Approx(-0.3 / (1 / 1. + 1 / 0.5 + 1 / 0.8)).epsilon(1e-8));
  // the press sets in with the full 6 N of the grip on 0.1 kg; a step of the simulation changes the velocity
  // of the tool by at most what the hand gains in 10 ms, 0.6 m/s, and the force by B times that
  CHECK(largest < 2 * 0.6);
}

}  // namespace test_haptic_two_rates
