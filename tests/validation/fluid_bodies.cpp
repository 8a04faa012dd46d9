// SPDX-License-Identifier: BSL-1.0
// Fluids of particles against closed forms: drops under surface tension (Rayleigh 1879), a sphere that sinks
// (Stokes 1851, with walls after Faxen 1922).
#include "catch.hpp"
#include "fluid_tank.hpp"

#include <sinew/force/fluid_boundary.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/solver/dfsph.hpp>

namespace test_fluid_bodies {

using namespace sinew;
using tank::Points;

namespace {

constexpr double pi = 3.14159265358979323846;

Points ball(double d, double radius) {
  Points x;
  const int n = int(radius / d) + 1;
  for (auto const& p : tank::block(d, 2 * n, 2 * n, 2 * n, Eigen::Vector3d::Constant(-n * d)))
    if (p.norm() < radius) x.push_back(p);
  return x;
}

constexpr double distance = 0.125, cohesionRadius = 4 * distance, pressureRadius = 2 * distance;

template <class F>
double integral(double from, double to, F&& f) {  // midpoints: error 1/n^2
  const int n = 400;
  double sum = 0;
  for (int k = 0; k < n; ++k) sum += f(from + (k + 0.5) * (to - from) / n);
  return sum * (to - from) / n;
}
/// The surface tension of particles of the number density n that pull each other by s(r) = factor m W r
/// (Kirkwood, Buff 1949, for a plane surface and particles anywhere),
///   pi/8 n^2 int s r^4 dr,
/// less what the pressure against it, between pairs within its own radius, pushes along the surface. At the
/// depth z it bears P(z) = pi n^2 int s r^2 (z - z^3 / 3 r^2) dr, 2 r / 3 in the brackets from z = r on, and
/// by forces F(r) with 2 pi/3 n^2 int F r^3 dr = 1 it takes
///   pi/2 n^2 int dz P(z) int_z F r^3 (z/r - z^3/r^3) dr.
double tension_of(double factor, double density) {
  const double n = 1 / std::pow(distance, 3), mass = density / n;
  const CubicKernels<double> cohesion(cohesionRadius);
  const WendlandKernel<double> pressure(pressureRadius);
  auto pull = [&](double r) { return factor * mass * cohesion.density(r / cohesionRadius) * r; };
  auto push = [&](double r) { return -pressure.densitySlope(r / pressureRadius) * r; };
  const double unit =
      2 * pi / 3 * n * n * integral(0, pressureRadius, [&](double r) { return push(r) * r * r * r; });
  auto borne = [&](double z) {
    return pi * n * n * integral(0, cohesionRadius, [&](double r) {
             return pull(r) * r * r * (z < r ? z - z * z * z / (3 * r * r) : 2 * r / 3);
           });
  };
  const double taken = pi / 2 * n * n / unit * integral(0, pressureRadius, [&](double z) {
                         return borne(z) * integral(z, pressureRadius, [&](double r) {
                                  return push(r) * r * r * r * (z / r - std::pow(z / r, 3));
                                });
                       });
  return pi / 8 * n * n * integral(0, cohesionRadius, [&](double r) { return pull(r) * std::pow(r, 4); }) -
         taken;
}

/// What a drop of a radius does that is pulled long at first: its period, behind the first three moments of
/// being round, in which its lattice gives way, and how long and how flat it was until then.
struct Swing {
  double period = 0, longest = 0, flattest = 0;
};
Swing swing_of_drop(double radius, double tension) {
  const double d = distance, rho = 1, mass = rho * d * d * d;
  const double rate = std::sqrt(tension / std::pow(radius, 3));  // of 1 / s, by dimensions
  const Points x = ball(d, radius);
  Points v;
  for (auto const& p : x) v.push_back(0.3 * rate * Eigen::Vector3d(-p[0] / 2, -p[1] / 2, p[2]));
  Simulation sim{node<"drop">(DFSPHSolver{.radius = pressureRadius, .density = rho},
                              MechanicalObject<Vec3d>{.position = x, .velocity = v},
                              UniformMass<Vec3d>{.vertexMass = mass},
                              SPHFluidForceField<Vec3d>{.radius = cohesionRadius,
                                                        .mass = mass,
                                                        .density = rho,
                                                        .viscosity = 0,
                                                        .surfaceTension = tension,
                                                        .kernelType = 1,
                                                        .pressureType = 0,
                                                        .viscosityType = 0,
                                                        .surfaceTensionType = 2})};
  sim.init();
  Swing swing;
  std::vector<double> round;
  double last = 0;
  const double dt = 0.02 / rate;
  while (round.size() < 5 && sim.time() < 15 / rate) {
    sim.animate(dt);
    double along = 0, across = 0;
    for (auto const& p : sim.root().state().position) {
      along += p[2] * p[2];
      across += (p[0] * p[0] + p[1] * p[1]) / 2;
    }
    const double now = std::sqrt(along / across) - 1;
    if (last != 0 && (now > 0) != (last > 0)) round.push_back(sim.time() - dt * now / (now - last));
    if (round.size() < 3) {
      swing.longest = std::max(swing.longest, now);
      swing.flattest = std::min(swing.flattest, now);
    }
    last = now;
  }
  if (round.size() > 3) swing.period = 2 * (round.back() - round[2]) / double(round.size() - 3);
  return swing;
}

}  // namespace

TEST_CASE("a drop under surface tension swings with Rayleigh's period, and becomes round", "[long]") {
  // omega^2 = 8 sigma / (rho R^3) of the mode between a longer and a flatter drop. Cohesion reaches half as
  // far as the radius, which the plane surface of sigma leaves out, and its particles are six to eight
  // across a radius.
  const double sigma = tension_of(1, 1);
  CHECK(sigma == Approx(0.198).epsilon(1e-3));  // times factor and density, for these radii
  const Swing one = swing_of_drop(1, 1), smaller = swing_of_drop(0.8, 1);
  CAPTURE(sigma, one.period, one.longest, one.flattest, smaller.period);
  CHECK(one.period == Approx(2 * pi / std::sqrt(8 * sigma)).epsilon(0.15));
  CHECK(smaller.period == Approx(2 * pi * std::sqrt(std::pow(0.8, 3) / (8 * sigma))).epsilon(0.15));
  for (Swing const& swing : {one, smaller}) {
    CHECK(swing.longest > 0.05);
    CHECK(swing.flattest < 0);
    CHECK(-swing.flattest < 0.7 * swing.longest);  // each swing is smaller than that before
  }
}

TEST_CASE("the tension of Akinci et al. makes a cube of water round, and keeps it whole") {
  // How far it reaches along its diagonals over how far along its axes: sqrt(3) of a cube, 1 of a ball.
  const double d = 0.1, rho = 1000, mass = rho * d * d * d;
  const int n = 8;
  const Points x = tank::block(d, n, n, n, Eigen::Vector3d::Constant(-n * d / 2));
  Simulation sim{node<"drop">(DFSPHSolver{.radius = 2 * d, .density = rho, .xsph = 0.05},
                              MechanicalObject<Vec3d>{.position = x},
                              UniformMass<Vec3d>{.vertexMass = mass},
                              SPHFluidForceField<Vec3d>{.radius = 2 * d,
                                                        .mass = mass,
                                                        .density = rho,
                                                        .surfaceTension = 500,
                                                        .kernelType = 1,
                                                        .pressureType = 0,
                                                        .viscosityType = 0,
                                                        .surfaceTensionType = 3})};
  sim.init();
  auto reach = [&](auto&& along) {
    double sum = 0;
    const auto directions = along();
    for (Eigen::Vector3d const& u : directions) {
      double most = 0;
      for (auto const& p : sim.root().state().position) most = std::max(most, p.dot(u));
      sum += most / double(directions.size());
    }
    return sum;
  };
  auto corners = [&] {
    return reach([] {
      Points u;
      for (int k = 0; k < 8; ++k)
        u.push_back(Eigen::Vector3d(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1).normalized());
      return u;
    });
  };
  auto faces = [&] {
    return reach([] {
      Points u;
      for (int k = 0; k < 3; ++k)
        for (const int sign : {-1, 1}) u.push_back(sign * Eigen::Vector3d::Unit(k));
      return u;
    });
  };
  CHECK(corners() / faces() == Approx(std::sqrt(3.)));
  for (int k = 0; k < 300; ++k) sim.animate(0.005);
  CHECK(corners() / faces() == Approx(1).margin(0.1));
  CHECK(tank::sum(sim.root().state().velocity).norm() < 1e-10);
  // a ball of its volume
  const double ball = std::cbrt(3 / (4 * pi)) * n * d;
  CHECK(faces() == Approx(ball).margin(d));
}

TEST_CASE("a sphere sinks through a thick fluid with Stokes' velocity, held back by walls", "[long]") {
  // v = (m - rho V) g / (6 pi mu a K), K = 1 / (1 - 2.104 l + 2.09 l^3 - 0.95 l^5) in a tube of the radius
  // a / l. A square tube is as narrow as a round one of about 1.1 times half its side (1.903 l to first
  // order: Happel, Brenner 1983, 7-4). The fluid stands still where boundary particles are, and is displaced
  // half a distance farther out.
  const double d = 0.05, rho = 1000, g = 9.81, mu = 500;
  const int n = 18, high = 20;
  const double a = 3 * d;
  Points shell;
  const int points = int(4 * pi * 3 * 3);
  for (int k = 0; k < points; ++k) {  // even on a sphere, by the golden angle
    const double z = 1 - (2 * k + 1.) / points, turn = k * pi * (3 - std::sqrt(5.));
    shell.push_back(
        a * Eigen::Vector3d(std::sqrt(1 - z * z) * std::cos(turn), z, std::sqrt(1 - z * z) * std::sin(turn)));
  }
  const Eigen::Vector3d middle(n * d / 2, high * d * 0.6, n * d / 2);
  Points x;
  for (auto const& p : tank::block(d, n, high, n))
    if ((p - middle).norm() > a + 0.8 * d) x.push_back(p);
  const double volume = 4 * pi / 3 * std::pow(a + d / 2, 3), mass = 3 * rho * volume;
  Rigid3d::Coord start = Rigid3d::zero();
  start.center = middle;
  Simulation sim{node<"root">(
      Gravity{{0, -g, 0}},
      node<"water">(DFSPHSolver{.radius = 2 * d, .density = rho, .viscosity = mu},
                    MechanicalObject<Vec3d>{.position = x},
                    UniformMass<Vec3d>{.vertexMass = rho * d * d * d}),
      node<"walls">(MechanicalObject<Vec3d>{.position = tank::walls(d, n, high + 4, n)},
                    FluidBoundary<Vec3d>{}),
      node<"ball">(
          EulerExplicitSolver{},
          MechanicalObject<Rigid3d>{.position = {start}},
          UniformMass<Rigid3d>{
              .vertexMass = Rigid3d::MassType{.mass = mass,
                                              .inertia = Eigen::Matrix3d::Identity() * 0.4 * mass * a * a}},
          node<"surface">(MechanicalObject<Vec3d>{.position = shell},
                          RigidMapping<Rigid3d, Vec3d>{},
                          FluidBoundary<Vec3d>{})))};
  sim.init();
  const double l = a / ((n + 1) * d / 2) * 1.903 / 2.104;
  const double k = 1 / (1 - 2.104 * l + 2.09 * l * l * l - 0.95 * std::pow(l, 5));
  const double expected = (mass - rho * volume) * g / (6 * pi * mu * a * k);
  double mean = 0;
  const int steps = 160, counted = 140;
  for (int i = 0; i < steps; ++i) {
    sim.animate(0.002);
    const double v = -sim.at<"ball">().state().velocity[0][1];
    if (i >= steps - counted) mean += v / counted;
  }
  CAPTURE(mean, expected, k);
  CHECK(mean == Approx(expected).epsilon(0.2));  // seven particles across
}

}  // namespace test_fluid_bodies
