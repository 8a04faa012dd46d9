// SPDX-License-Identifier: BSL-1.0
// Articulated bodies in scenes: pendulums against closed forms, and a body with an arm that flies freely.
#include "catch.hpp"

#include <sinew/context/gravity.hpp>
#include <sinew/mapping/articulated_system_mapping.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace test_articulated_system_mapping {

using namespace sinew;

constexpr double pi = 3.14159265358979323846, g = 9.81, mass = 0.8, inertia = 0.1;

// rods of length 2 on hinges about z, one below the other, from angles at rest
auto pendulum(std::vector<double> const& start) {
  ArticulatedSystemMapping<Vec1d, Rigid3d> mapping;
  Vec1d::VecCoord angles;
  for (int i = 0; i < int(start.size()); ++i) {
    mapping.centers.push_back({i, i + 1, {0, i == 0 ? 0. : -1., 0}, {0, 1, 0}});
    mapping.articulations.push_back({i, i, true, false, {0, 0, 1}});
    angles.push_back(Vec1d::Coord::Constant(start[std::size_t(i)]));
  }
  RigidMass<double, 3> rod;
  rod.mass = mass;
  rod.inertia = inertia * Eigen::Matrix3d::Identity();
  Simulation sim{node<"root">(
      Gravity{{0, -g, 0}},
      EulerExplicitSolver{},
      CGLinearSolver<>{.iterations = 20, .tolerance = 1e-14},
      node<"angles">(
          MechanicalObject<Vec1d>{.position = angles},
          node<"bodies">(MechanicalObject<Rigid3d>{}, UniformMass<Rigid3d>{.vertexMass = rod}, mapping)))};
  sim.init();
  return sim;
}
template <class Sim>
double angle(Sim& sim, std::size_t i) {
  return sim.template at<"angles">().state().position[i][0];
}

TEST_CASE("a physical pendulum has the period of its inertia, also far from the vertical") {
  for (const double start : {0.01, 2.0}) {
    auto sim = pendulum({start});
    const double h = 1e-3;
    double before = start, time = 0;
    while (before > 0) {
      before = angle(sim, 0);
      sim.animate(h);
      time += h;
      const double now = angle(sim, 0);
      if (now <= 0) {
        time -= h * now / (now - before);  // where it passes the vertical: a quarter of the period
        break;
      }
    }
    // T = 2 pi / w / agm(1, cos(start/2)), w^2 = m g l / (I + m l^2), l = 1
    double a = 1, b = std::cos(start / 2);
    for (int i = 0; i < 6; ++i) {
      const double mean = (a + b) / 2;
      b = std::sqrt(a * b);
      a = mean;
    }
    const double period = 2 * pi * std::sqrt((inertia + mass) / (mass * g)) / a;
    // v and x of a symplectic step are half a step apart
    CHECK(4 * time == Approx(period).margin(2 * h + period * 1e-4));
  }
}

// the Lagrangian's accelerations of angles from the vertical, s = q0, t = q0 + q1
Eigen::Vector4d slope(Eigen::Vector4d const& y) {
  const double s = y[0], t = y[1], rs = y[2], rt = y[3], c = 2 * mass * std::cos(s - t),
               d = 2 * mass * std::sin(s - t);
  Eigen::Matrix2d L;
  L << 5 * mass + inertia, c, c, mass + inertia;
  const Eigen::Vector2d right(-d * rt * rt - 3 * mass * g * std::sin(s),
                              d * rs * rs - mass * g * std::sin(t));
  Eigen::Vector4d out;
  out << rs, rt, L.inverse() * right;
  return out;
}

TEST_CASE("a double pendulum follows the equations of Lagrange, with its energy") {
  Eigen::Vector4d y(1.2, 2.0, 0, 0);
  const double duration = 1.5;
  for (int i = 0; i < 3000; ++i) {
    const double k = duration / 3000;
    const Eigen::Vector4d k1 = slope(y), k2 = slope(y + k / 2 * k1), k3 = slope(y + k / 2 * k2),
                          k4 = slope(y + k * k3);
    y += k / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  CHECK(std::abs(y[2]) + std::abs(y[3]) > 1);  // it is fast
  auto run = [&](int steps) {
    auto sim = pendulum({1.2, 0.8});
    auto energy = [&] {
      double sum = sim.kineticEnergy();
      for (std::size_t i = 1; i < 3; ++i)
        sum += mass * g * sim.template at<"angles/bodies">().state().position[i].center[1];
      return sum;
    };
    const double start = energy();
    double drift = 0;
    for (int i = 0; i < steps; ++i) {
      sim.animate(duration / steps);
      drift = std::max(drift, std::abs(energy() - start));
    }
    return std::array{std::hypot(angle(sim, 0) - y[0], angle(sim, 0) + angle(sim, 1) - y[1]), drift};
  };
  const auto coarse = run(1500), fine = run(3000);
  // a method of order 1: half the step, half the error
  CHECK(fine[0] < 0.02);
  CHECK(coarse[0] / fine[0] == Approx(2).margin(0.3));
  CHECK(fine[1] < 0.01 * 3 * mass * g);
  CHECK(coarse[1] / fine[1] == Approx(2).margin(0.4));
}

TEST_CASE("a body with an arm that flies freely keeps its momentum") {
  using Rooted = ArticulatedSystemMapping<Vec1d, Rigid3d, Rigid3d, Parents<"..", "../../base">>;
  auto change = [&](int steps) {
    Rooted mapping;
    mapping.centers = {{0, 1, {0.5, 0, 0}, {-0.5, 0, 0}}, {1, 2, {0.5, 0, 0}, {-0.5, 0, 0}}};
    mapping.articulations = {{0, 0, true, false, {0, 0, 1}}, {1, 1, true, false, {0, 1, 1}}};
    Simulation sim{node<"root">(
        Gravity{{0, 0, 0}},
        EulerExplicitSolver{},
        CGLinearSolver<>{.iterations = 40, .tolerance = 1e-14},
        node<"base">(MechanicalObject<Rigid3d>{
            .position = {{}}, .velocity = {(Rigid3d::Deriv() << 0.2, -0.3, 0.5, 0.4, 1, -0.6).finished()}}),
        node<"angles">(
            MechanicalObject<Vec1d>{.position = {Vec1d::Coord::Constant(0.5), Vec1d::Coord::Constant(-0.8)},
                                    .velocity = {Vec1d::Coord::Constant(2), Vec1d::Coord::Constant(-1)}},
            node<"bodies">(MechanicalObject<Rigid3d>{},
                           UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{.mass = 2}},
                           mapping)))};
    sim.init();
    auto momentum = [&] {
      Rigid3d::Deriv sum = Rigid3d::Deriv::Zero();
      auto const& s = sim.template at<"angles/bodies">().state();
      for (std::size_t b = 0; b < s.size(); ++b) {
        const Eigen::Vector3d p = 2 * s.velocity[b].template head<3>();
        sum.template head<3>() += p;
        sum.template tail<3>() += s.position[b].center.cross(p) + s.velocity[b].template tail<3>();
      }
      return sum;
    };
    const Rigid3d::Deriv start = momentum();
    for (int i = 0; i < steps; ++i) sim.animate(1. / steps);
    return (momentum() - start).norm() / start.norm();
  };
  const double coarse = change(500), fine = change(1000);
  CHECK(fine < 2e-3);
  CHECK(coarse / fine == Approx(2).margin(0.4));
}

}  // namespace test_articulated_system_mapping
