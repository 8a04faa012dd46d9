// SPDX-License-Identifier: BSL-1.0
// Implicit viscosity of incompressible fluids of particles: waves decay as those of the continuum, what turns
// as a whole goes on, what is very thick becomes rigid, walls bear what they take.
#include "catch.hpp"
#include "error_of.hpp"
#include "fluid_tank.hpp"

#include <sinew/control/threads.hpp>
#include <sinew/force/fluid_boundary.hpp>
#include <sinew/force/sph_kernels.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/solver/dfsph.hpp>

#include <Eigen/Dense>
#include <numbers>

namespace test_dfsph_viscosity {

using namespace sinew;
using tank::Points;

namespace {

DFSPHFlow flow_of(double d, Points const& x, Points const& v, std::size_t boundary = 0) {
  DFSPHFlow flow;
  flow.radius = 2 * d;
  flow.calibrate(d);
  flow.volumes.assign(x.size() - boundary, d * d * d);
  flow.positions = x;
  flow.velocities = v;
  flow.impulses.assign(boundary, Eigen::Vector3d::Zero());
  flow.place("test");
  return flow;
}
Eigen::Vector3d angular(Points const& x, Points const& v) {
  Eigen::Vector3d sum(0, 0, 0);
  for (std::size_t i = 0; i < x.size(); ++i) sum += x[i].cross(v[i]);
  return sum;
}

}  // namespace

TEST_CASE("waves across a fluid decay by nu k^2 from where its viscosity acts, with the second order of d") {
  // v_x = sin k y: in a step v / (1 + h nu k^2), for particles whose neighbours' neighbours are all there; a
  // short step, in which what happens at the border does not come there
  const double length = 1, k = 2 * std::numbers::pi / length, nu = 0.3;
  std::array<double, 2> errors{};
  for (std::size_t level = 0; level < 2; ++level) {
    const int n = level == 0 ? 10 : 20;
    const double d = length / n, h = 1e-6;
    const Points x = tank::block(d, 10, 3 * n, 10);
    Points v;
    for (auto const& p : x) v.push_back({std::sin(k * p[1]), 0, 0});
    DFSPHFlow flow = flow_of(d, x, v);
    DFSPHFlow::Iteration iteration{.most = 100, .tolerance = 1e-12};
    flow.solveViscosity(h, nu, iteration);
    for (std::size_t i = 0; i < x.size(); ++i) {
      bool inside = true;
      for (const int c : {0, 2}) inside = inside && x[i][c] > 3 * d && x[i][c] < 7 * d;
      if (!inside || std::abs(v[i][0]) < 0.5 || x[i][1] < length || x[i][1] > 2 * length) continue;
      const double decay = (flow.velocities[i][0] / v[i][0] - 1) / h;
      errors[level] = std::max(errors[level], std::abs(decay / (-nu * k * k) - 1));
    }
  }
  CHECK(errors[0] < 0.1);  // (k d)^2 / 4
  CHECK(errors[0] / errors[1] == Approx(4).margin(0.4));
}

TEST_CASE("viscosity keeps momentum and angular momentum, and does nothing to what moves as a whole") {
  const double d = 0.1;
  Points x = tank::block(d, 6, 5, 4), v;
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] += 0.01 * Eigen::Vector3d(std::sin(double(i)), std::cos(3. * double(i)), std::sin(2. * double(i)));
  const Eigen::Vector3d turn(1, -2, 0.5), move(3, 0, 1);
  for (auto const& p : x) v.push_back(turn.cross(p) + move);
  DFSPHFlow flow = flow_of(d, x, v);
  DFSPHFlow::Iteration iteration{.tolerance = 1e-10};
  flow.solveViscosity(0.01, 100, iteration);
  for (std::size_t i = 0; i < x.size(); ++i) CHECK((flow.velocities[i] - v[i]).norm() < 1e-11);

  Points other = v;
  for (std::size_t i = 0; i < x.size(); ++i)
    other[i] += Eigen::Vector3d(x[i][1], std::sin(9 * x[i][2]), x[i][0] * x[i][1]);
  for (const double strength : {1e-3, 1., 1e6}) {
    flow = flow_of(d, x, other);
    iteration = {.most = 1000, .tolerance = 1e-10};
    flow.solveViscosity(0.01, strength, iteration);
    CHECK(iteration.error <= iteration.tolerance);
    // what the residual leaves: of the first one, some h nu / d^2 of each velocity
    const double left = 1e-10 * (1 + 0.01 * strength / (d * d)) * double(x.size());
    CHECK((tank::sum(flow.velocities) - tank::sum(other)).norm() < left);
    CHECK((angular(x, flow.velocities) - angular(x, other)).norm() < left);
    if (strength < 1e6) continue;
    // rigid: the linear and angular momentum there was
    Eigen::Vector3d centre = tank::sum(x) / double(x.size()), mean = tank::sum(other) / double(x.size());
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
    Eigen::Vector3d spin = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Eigen::Vector3d r = x[i] - centre;
      inertia += r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose();
      spin += r.cross(other[i]);
    }
    const Eigen::Vector3d rate = inertia.inverse() * spin;
    for (std::size_t i = 0; i < x.size(); ++i)
      CHECK((flow.velocities[i] - mean - rate.cross(x[i] - centre)).norm() < 1e-4);  // strain ~ d^2 / (h nu)
  }
}

TEST_CASE("XSPH damps waves by what the kernel leaves of them, and keeps momentum") {
  // On a lattice inside, v_x = sin k y keeps 1 - e (1 - w), w = sum_j V W_j cos k y_j over the neighbours and
  // itself.
  const double d = 0.1, e = 0.6, k = 2 * std::numbers::pi / (10 * d);
  Points x = tank::block(d, 9, 30, 9), v;
  for (auto const& p : x) v.push_back({std::sin(k * p[1]), 0, 2});
  DFSPHFlow flow = flow_of(d, x, v);
  const WendlandKernel<double> kernel(flow.radius, flow.factor);
  double left = 0;
  for (int a = -2; a <= 2; ++a)
    for (int b = -2; b <= 2; ++b)
      for (int c = -2; c <= 2; ++c) {
        const double q = std::sqrt(double(a * a + b * b + c * c)) * d / flow.radius;
        if (q < 1) left += d * d * d * kernel.density(q) * std::cos(k * b * d);
      }
  CHECK(left > 0.5);
  CHECK(left < 0.99);
  flow.smooth(e);
  std::size_t inside = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if ((x[i].array() < 2.2 * d).any() || x[i][0] > 6.8 * d || x[i][1] > 27.8 * d || x[i][2] > 6.8 * d)
      continue;
    ++inside;
    CHECK((flow.velocities[i] - Eigen::Vector3d(v[i][0] * (1 - e * (1 - left)), 0, 2)).norm() < 1e-12);
  }
  CHECK(inside > 200);
  // scattered, and with particles of a boundary, which it does not feel
  const Points fluid = tank::block(d, 5, 5, 5);
  x = fluid;
  v.clear();
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double t = double(i);
    x[i] += 0.02 * Eigen::Vector3d(std::sin(t), std::cos(3 * t), std::sin(2 * t));
    v.push_back({std::sin(5 * t), std::cos(7 * t), std::sin(11 * t)});
  }
  for (auto const& p : tank::block(d, 5, 1, 5, {0, -d, 0})) x.push_back(p), v.push_back({9, 9, 9});
  flow = flow_of(d, x, v, 25);
  auto energy = [&] {
    double sum = 0;
    for (std::size_t i = 0; i < fluid.size(); ++i) sum += flow.velocities[i].squaredNorm();
    return sum;
  };
  const Eigen::Vector3d before = tank::sum(flow.velocities);
  const double whole = energy();
  flow.smooth(1);
  CHECK((tank::sum(flow.velocities) - before).norm() < 1e-12);
  CHECK(energy() < 0.5 * whole);
  for (std::size_t i = fluid.size(); i < x.size(); ++i) CHECK(flow.velocities[i] == v[i]);
}

TEST_CASE("walls take from a fluid what it loses, and hold what is thick") {
  const double d = 0.1;
  Points x = tank::block(d, 5, 5, 5);
  const std::size_t fluid = x.size();
  for (auto const& p : tank::walls(d, 5, 7, 5)) x.push_back(p);
  Points v(x.size(), Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < fluid; ++i) v[i] = {1, 0, 0.3};
  double last = 10;
  for (const double nu : {0.01, 1., 1e4}) {
    DFSPHFlow flow = flow_of(d, x, v, x.size() - fluid);
    DFSPHFlow::Iteration iteration{.most = 1000, .tolerance = 1e-12};
    flow.solveViscosity(0.01, nu, iteration);
    Eigen::Vector3d lost = Eigen::Vector3d::Zero();
    double fastest = 0;
    for (std::size_t i = 0; i < fluid; ++i) {
      lost += d * d * d * (v[i] - flow.velocities[i]);
      fastest = std::max(fastest, flow.velocities[i].norm());
    }
    CHECK((tank::sum(flow.impulses) - lost).norm() < 1e-12);
    CHECK(fastest < last);
    last = fastest;
  }
  CHECK(last < 0.01);
}

TEST_CASE("between two cylinders, of which the inner one turns, a thick fluid has Couette's profile") {
  // u = A r + B / r, the velocities of the cylinders at their radii; where the viscosity is all, it is there
  // at once, and free ends above and below change nothing
  const double inner = 0.5, outer = 1, B = inner * inner * outer * outer / (outer * outer - inner * inner),
               A = -B / (outer * outer);  // the inner one turns by 1/s
  std::array<double, 2> errors{};
  for (std::size_t level = 0; level < 2; ++level) {
    const double d = 0.1 / double(1 << level);
    Points x, v;
    // rings at a distance d, the walls last
    auto ring = [&](double radius) {
      const int around = int(std::round(2 * std::numbers::pi * radius / d));
      for (int z = 0; z < 6; ++z)
        for (int k = 0; k < around; ++k) {
          const double angle = 2 * std::numbers::pi * k / around;
          x.push_back({radius * std::cos(angle), radius * std::sin(angle), d * (z + 0.5)});
        }
    };
    const int between = int(std::round((outer - inner) / d));
    for (int k = 1; k < between; ++k) ring(inner + k * d);
    const std::size_t fluid = x.size();
    ring(inner);
    ring(outer);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const bool turns = i >= fluid && x[i].head<2>().norm() < 0.75;
      v.push_back(turns ? Eigen::Vector3d(-x[i][1], x[i][0], 0) : Eigen::Vector3d::Zero().eval());
    }
    DFSPHFlow flow = flow_of(d, x, v, x.size() - fluid);
    DFSPHFlow::Iteration iteration{.most = 2000, .tolerance = 1e-9};
    flow.solveViscosity(1, 1e6, iteration);
    CHECK(iteration.error <= iteration.tolerance);
    double sum = 0;
    for (std::size_t i = 0; i < fluid; ++i) {
      const double r = x[i].head<2>().norm();
      const Eigen::Vector3d expected = (A + B / (r * r)) * Eigen::Vector3d(-x[i][1], x[i][0], 0);
      sum += (flow.velocities[i] - expected).squaredNorm();
    }
    errors[level] = std::sqrt(sum / double(fluid)) / inner;
  }
  // In a radius of two distances sums over directions are not those of the continuum: a part of some percent
  // stays on finer rings.
  CHECK(errors[0] < 0.03);
  CHECK(errors[1] < errors[0]);
}

TEST_CASE("a thick fluid in a scene: long steps, the same bits by threads, forces that balance", "[long]") {
  const double d = 0.05, mass = 1000 * d * d * d;
  auto run = [&](int threads, double viscosity) {
    Points v;
    const Points x = tank::block(d, 14, 12, 14);
    for (auto const& p : x) v.push_back({p[1], -0.2, 0});
    Simulation sim{node<"root">(Threads{.count = threads},
                                Gravity{{0, -10, 0}},
                                node<"honey">(DFSPHSolver{.radius = 2 * d, .viscosity = viscosity},
                                              MechanicalObject<Vec3d>{.position = x, .velocity = v},
                                              UniformMass<Vec3d>{.vertexMass = mass}))};
    sim.init();
    const Eigen::Vector3d before = tank::sum(v);
    for (int i = 0; i < 10; ++i) sim.animate(0.01);
    auto const& state = sim.template at<"honey">().state();
    const Eigen::Vector3d fallen = double(x.size()) * Eigen::Vector3d(0, -10 * 0.1, 0);
    CHECK((tank::sum(state.velocity) - before - fallen).norm() < 1e-9 * double(x.size()));
    return state.position;
  };
  // h nu / d^2 = 400: explicit viscosity is stable up to some 0.1
  const auto one = run(1, 1e5), two = run(2, 1e5);
  CHECK(one == two);
  for (auto const& p : one) REQUIRE(p.allFinite());
  Simulation wrong{node<"root">(DFSPHSolver{.radius = 2 * d, .viscosity = -1},
                                MechanicalObject<Vec3d>{.position = tank::block(d, 3, 3, 3)},
                                UniformMass<Vec3d>{.vertexMass = mass})};
  CHECK_THAT(error_of([&] { wrong.init(); }), Catch::Contains("DFSPHSolver") && Catch::Contains("viscosity"));
}

}  // namespace test_dfsph_viscosity
