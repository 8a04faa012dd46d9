// SPDX-License-Identifier: BSL-1.0
#include "frames.hpp"
#include "registry_scene.hpp"

#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/force/angular_spring.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/runge_kutta4.hpp>
#include <sinew/state/mechanical_object.hpp>

#include <numbers>

namespace test_angular_spring {

using namespace sinew;
using Eigen::AngleAxisd;
using Eigen::Vector3d;
using one::force;
using one::ready;
using one::refuses;
using std::numbers::pi;

namespace {

using Springs = AngularSpringForceField<Rigid3d>;
using Rotation = Eigen::Vector3d;

Rigid3d::Coord body(Vector3d const& center, AngleAxisd const& rotation = AngleAxisd(0, Vector3d::UnitX())) {
  Rigid3d::Coord x;
  x.center = center;
  x.orientation = rotation;
  return x;
}
const Rigid3d::VecCoord chain{
    body({0, 0, 0}), body({1, 0, 0}, AngleAxisd(0.4, Vector3d::UnitZ())), body({2, 0, 0})};

}  // namespace

TEST_CASE("an angular spring resists the turn from one body to the next") {
  auto springs = ready(Springs{.indices = {0, 1}, .angularStiffness = {7}}, chain);
  CHECK(potential_energy(springs, chain) < 1e-30);  // relaxed at rest
  const AngleAxisd rotation(0.9, Vector3d(1, 2, -2).normalized());
  auto x = chain;
  x[1].orientation = rotation * x[1].orientation;
  CHECK(potential_energy(springs, x) == Approx(0.5 * 7 * 0.81));
  const auto f = force(springs, x);
  CHECK((f[1].tail<3>() + 7 * 0.9 * rotation.axis()).norm() < 1e-12);
  CHECK((f[0] + f[1]).norm() == 0);
  CHECK(f[2].norm() == 0);
  CHECK(f[1].head<3>().norm() == 0);
  // turning both alike, about any axis, changes nothing
  const Eigen::Quaterniond both(AngleAxisd(1.3, Vector3d(0.6, 0, 0.8)));
  for (auto& b : x) b.orientation = both * b.orientation;
  CHECK(potential_energy(springs, x) == Approx(0.5 * 7 * 0.81));
  CHECK((force(springs, x)[1].tail<3>() - both * f[1].tail<3>()).norm() < 1e-12);
  // the quaternions q and -q are one orientation
  x[0].orientation.coeffs() *= -1;
  CHECK(potential_energy(springs, x) == Approx(0.5 * 7 * 0.81));
}

TEST_CASE("each body is held by the one before it, with its own stiffness") {
  auto springs = ready(Springs{.indices = {0, 1, 2}, .angularStiffness = {1, 2, 3}}, chain);
  auto x = chain;
  x[2].orientation = AngleAxisd(0.5, Vector3d::UnitY());
  CHECK(potential_energy(springs, x) == Approx(0.5 * 3 * 0.25));
  x[1].orientation = AngleAxisd(0.1, Vector3d::UnitZ()) * x[1].orientation;
  x[2].orientation = chain[2].orientation;
  CHECK(potential_energy(springs, x) == Approx(0.5 * (2 + 3) * 0.01));
  // the first of the indices is not held: here only body 2 is, by body 1
  auto last = ready(Springs{.indices = {1, 2}, .angularStiffness = {3}}, chain);
  CHECK(potential_energy(last, x) == Approx(0.5 * 3 * 0.01));
}

TEST_CASE("the tangent is the symmetric part of the derivative of the torques, far from rest too") {
  auto springs = ready(Springs{.indices = {0, 1, 2}, .angularStiffness = {50}}, chain);
  auto x = chain;
  x[1].orientation = AngleAxisd(1.9, Vector3d(2, -1, 2).normalized());
  x[2].orientation = AngleAxisd(2.4, Vector3d(0, 0.6, 0.8));
  frames::check_tangent(springs, x, 1e-6);
}

// A body with inertia I on a spring to a fixed body turns as theta cos(w t), w^2 = k / I; two free bodies,
// against each other, with w^2 = k (1 / I0 + 1 / I1).
TEST_CASE("torsion pendulums swing at their frequency") {
  const double k = 20, theta = 0.8;
  Eigen::Matrix3d inertia = Eigen::Vector3d(2, 3, 4).asDiagonal();
  const RigidMass<double, 3> mass{1.5, inertia};
  for (int axis = 0; axis < 3; ++axis)
    for (const bool fixed : {true, false}) {
      const double w = std::sqrt(k * (fixed ? 1 : 2) / inertia(axis, axis));
      MechanicalObject<Rigid3d> state;
      state.restPosition = {body({0, 0, 0}), body({1, 0, 0})};
      state.position = state.restPosition;
      state.position[1].orientation = AngleAxisd(theta, Vector3d::Unit(axis));
      RegistryScene sim{node<"root">(
          RungeKutta4Solver{},
          state,
          UniformMass<Rigid3d>{.vertexMass = mass},
          Springs{.indices = {0, 1}, .angularStiffness = {k}},
          FixedConstraint<Rigid3d>{.indices = fixed ? std::vector<int>{0} : std::vector<int>{}})};
      sim.init();
      const double energy = sim.potentialEnergy() + sim.kineticEnergy();
      const int steps = 400;
      const double end = 2.2 * pi / w;
      for (int i = 0; i < steps; ++i) sim.animate(end / steps);
      auto const& x = sim.root().state().position;
      const Eigen::Quaterniond between = x[1].orientation * x[0].orientation.conjugate();
      const double angle = 2 * std::atan2(between.vec()[axis], between.w());
      // RK4 at w dt = 0.017: phase error (w dt)^4 / 120 a radian, 1e-8 at the end
      CHECK(angle == Approx(theta * std::cos(w * end)).margin(1e-7));
      CHECK(sim.potentialEnergy() + sim.kineticEnergy() == Approx(energy).epsilon(1e-8));
      CHECK((x[0].center.norm() < 1e-15 && (x[1].center - Vector3d(1, 0, 0)).norm() < 1e-15));
    }
}

TEST_CASE("angular springs that do not fit are refused") {
  refuses(Springs{}, chain, {}, {"body", "AngularSpringForceField<Rigid3d>", "there is no spring"});
  refuses(Springs{.indices = {1}}, chain, {}, {"there is no spring"});
  refuses(Springs{.indices = {0, 3}}, chain, {}, {"indices has 3", "3 bodies"});
  refuses(Springs{.indices = {1, 0}}, chain, {}, {"indices has 0 behind its first entry"});
  refuses(Springs{.indices = {0, -1}}, chain, {}, {"indices[1] is -1"});
  refuses(Springs{.indices = {0, 1}, .angularStiffness = {1, 2, 3}}, chain, {}, {"3 values for 2 indices"});
  refuses(Springs{.indices = {0, 1}, .angularStiffness = {}}, chain, {}, {"0 values for 2 indices"});
  refuses(
      Springs{.indices = {0, 1}, .angularStiffness = {-1}}, chain, {}, {"angularStiffness[0] is -1 N m/rad"});
  refuses(Springs{.indices = {0, 1}, .angularStiffness = {one::notANumber}},
          chain,
          {},
          {"angularStiffness[0] is nan"});
}

}  // namespace test_angular_spring
