// SPDX-License-Identifier: BSL-1.0
// Fluids of particles: kernels by quadrature and differences, forces against sums over all pairs, momentum,
// energy.
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/control/threads.hpp>
#include <sinew/force/sph_fluid.hpp>
#include <sinew/mechanics.hpp>

#include <random>
#include <set>

namespace test_sph_fluid {

using namespace sinew;

namespace {

std::vector<Eigen::Vector3d> scattered(int n, double width, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0, width);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < n; ++i) points.push_back({place(random), place(random), 0.3 * place(random)});
  return points;
}

template <class D>
typename D::VecDeriv forces(SPHFluidForceField<D> fluid, typename D::VecCoord const& x,
                            typename D::VecDeriv const& v) {
  fluid.init(InitContext<D>{"test", x, {}});
  typename D::VecDeriv f(x.size(), D::Deriv::Zero());
  fluid.addForce({}, f, x, v);
  return f;
}

/// The sums as they stand in the documentation of the component, over all pairs.
template <template <class> class Kernels>
std::vector<Eigen::Vector3d> by_all_pairs(SPHFluidForceField<Vec3d> const& c,
                                          std::vector<Eigen::Vector3d> const& x,
                                          std::vector<Eigen::Vector3d> const& v) {
  const Kernels<double> kernels(c.radius);
  const std::size_t n = x.size();
  std::vector<double> rho(n), p(n), curvature(n);
  std::vector<Eigen::Vector3d> f(n, Eigen::Vector3d::Zero()), normal = f;
  auto pairs = [&](std::size_t i, auto&& act) {
    for (std::size_t j = 0; j < n; ++j)
      if (const Eigen::Vector3d d = x[i] - x[j]; j != i && d.norm() < c.radius)
        act(j, d, std::max(1e-9, d.norm() / c.radius));
  };
  for (std::size_t i = 0; i < n; ++i) {
    rho[i] = c.mass * kernels.density(0.);
    pairs(i, [&](std::size_t, auto const&, double q) { rho[i] += c.mass * kernels.density(q); });
    p[i] = c.pressureType == 0 ? 0 : c.pressure * (rho[i] - c.density);
  }
  for (std::size_t i = 0; i < n; ++i)
    pairs(i, [&](std::size_t j, Eigen::Vector3d const& d, double q) {
      const double more = c.mass / rho[j] - c.mass / rho[i];
      normal[i] += more * kernels.densitySlope(q) * d;
      curvature[i] += more * kernels.densityLaplacian(q);
    });
  std::vector<Eigen::Vector3d> outwards(n, Eigen::Vector3d::Zero());  // of Akinci et al.
  for (std::size_t i = 0; i < n; ++i)
    pairs(i, [&](std::size_t j, Eigen::Vector3d const& d, double q) {
      outwards[i] += c.radius * c.mass / rho[j] * kernels.densitySlope(q) * d;
    });
  // c V^2 of SphTension
  const double strength = 8 * c.surfaceTension / (std::acos(-1.) * std::pow(c.radius, 5) * 21 / 440) *
                          std::pow(c.mass / c.density, 2);
  for (std::size_t i = 0; i < n; ++i) {
    pairs(i, [&](std::size_t j, Eigen::Vector3d const& d, double q) {
      if (c.surfaceTension > 0 && c.surfaceTensionType == 3) {
        const double g = 64 * std::pow(q * (1 - q), 3);
        f[i] -= 2 * c.density / (rho[i] + rho[j]) * strength *
                ((q < 0.5 ? 2 * g - 1 : g) * d / (q * c.radius) + (outwards[i] - outwards[j]) / 20);
      }
      double pushes = -c.mass * c.mass * (p[i] / (rho[i] * rho[i]) + p[j] / (rho[j] * rho[j]));
      const double near = std::min(0., (v[i] - v[j]).dot(d));
      if (c.viscosityType == 2)
        pushes += near * c.viscosity * c.radius * c.mass /
                  ((q * q + 0.01 * c.radius * c.radius) * (rho[i] + rho[j]) / 2);
      f[i] += pushes * kernels.pressureSlope(q) * d;
      if (c.viscosityType == 1)
        f[i] +=
            c.mass * c.mass * c.viscosity / (rho[i] * rho[j]) * kernels.viscosityLaplacian(q) * (v[j] - v[i]);
      if (c.surfaceTension > 0 && c.surfaceTensionType == 2)
        f[i] -= c.surfaceTension * c.mass * kernels.density(q) * d;
    });
    if (c.surfaceTension > 0 && c.surfaceTensionType == 1 && normal[i].norm() > 1e-6)
      f[i] -= c.mass * c.surfaceTension * curvature[i] * normal[i].normalized();
  }
  return f;
}

}  // namespace

TEST_CASE("points in cells have the neighbours that a search of all pairs finds, whole and in shares") {
  for (const double width : {0.05, 0.3, 3.}) {
    auto points = scattered(400, 2, 7);
    points.push_back(points[3]);          // in one place
    points.push_back({-500, 0.1, 1000});  // far away
    PointCells cells;
    cells.sort(points, width, "test");
    for (const int shares : {1, 3}) {
      std::set<std::pair<int, int>> found;
      std::size_t places = 0;
      for (int share = 0; share < shares; ++share)
        cells.forEachCell({.index = share, .count = shares}, [&](auto const& cell, auto const& around) {
          places += std::size_t(cell.second - cell.first);
          for (int i = cell.first; i < cell.second; ++i)
            for (auto const& [begin, end] : around)
              for (int j = begin; j < end; ++j) {
                const int a = cells.order()[std::size_t(i)], b = cells.order()[std::size_t(j)];
                if ((points[std::size_t(a)] - points[std::size_t(b)]).norm() < width)
                  CHECK(found.insert({a, b}).second);  // once
              }
        });
      CHECK(places == points.size());
      std::size_t expected = 0;
      for (auto const& a : points)
        for (auto const& b : points) expected += (a - b).norm() < width;
      CHECK(found.size() == expected);
    }
  }
}

TEST_CASE("each particle has the pairs that a search of all finds, in the first loop and later ones",
          "[long]") {
  auto check = [](auto particles, std::vector<Eigen::Vector3d> const& x, double radius) {
    using Particles = decltype(particles);
    particles.sort(x, radius, "test");
    particles.weight(2) = 3;
    // of pairs that are as far apart as the radius rounding decides
    bool clear = true;
    for (auto const& a : x)
      for (auto const& b : x) clear = clear && std::abs((a - b).norm() - radius) > 1e-12;
    REQUIRE(clear);
    for (int loop = 0; loop < 2; ++loop) {
      std::size_t count = 0;
      particles.forEach({}, [&](int i, auto const& each) {
        auto const& a = x[std::size_t(particles.order()[std::size_t(i)])];
        std::set<int> found;
        each([&](typename Particles::Pairs const& p) {
          for (int l = 0; l < Particles::width; ++l) {
            if (!(bits_of(p.acts) >> l & 1)) continue;
            const int j = p.places[l];
            const Eigen::Vector3d d = a - x[std::size_t(particles.order()[std::size_t(j)])];
            if (!found.insert(j).second) FAIL("twice");
            for (int c = 0; c < 3; ++c)
              if (double(lane(p.d[std::size_t(c)], l)) != d[c]) FAIL("another difference");
            if (std::abs(double(lane(p.q, l)) - std::max(1e-9, d.norm() / radius)) > 1e-15) FAIL("q");
            if (lane(p.weight, l) != (j == 2 ? 3 : 1)) FAIL("weight");
          }
        });
        count += found.size();
      });
      std::size_t expected = 0;
      for (auto const& a : x)
        for (auto const& b : x) expected += (a - b).norm() < radius;
      CHECK(count == expected);
    }
  };
  // lists of some, of more than are kept, and more around than one search has room for; from far away, where
  // single precision is coarse
  for (const double radius : {0.1, 0.4, 0.9, 3.})
    for (const double far : {0., 1e4}) {
      auto x = scattered(1300, 1, 17);
      x.push_back({far, 0, 0});
      check(SortedParticles<double, native_width<double>>{}, x, radius);
      check(SortedParticles<double, 1>{}, x, radius);
    }
}

TEST_CASE("kernels have the integral 1, and slopes and Laplacians are those of differences") {
  auto check = [](auto const& kernels, double h) {
    const int n = 20000;
    double integral = 0;
    for (int k = 0; k < n; ++k) {  // midpoints: error 1/n^2
      const double q = (k + 0.5) / n, r = q * h;
      integral += 4 * std::acos(-1.) * r * r * kernels.density(q) * h / n;
    }
    CHECK(integral == Approx(1).epsilon(1e-6));
    const double e = 1e-5;
    for (const double q : {0.1, 0.3, 0.49, 0.6, 0.9}) {
      const double r = q * h;
      const double slope = (kernels.density(q + e) - kernels.density(q - e)) / (2 * e * h);
      CHECK(kernels.densitySlope(q) * r == Approx(slope).epsilon(1e-6));
      const double second =
          (kernels.density(q + e) - 2 * kernels.density(q) + kernels.density(q - e)) / (e * e * h * h);
      CHECK(kernels.densityLaplacian(q) == Approx(second + 2 / r * slope).epsilon(1e-4).margin(1e-4));
    }
    CHECK(kernels.density(1.) == Approx(0).margin(1e-15));
  };
  check(MuellerKernels<double>(0.7), 0.7);
  check(CubicKernels<double>(1.6), 1.6);
  // Mueller's steep kernel, 15 / (pi h^3) (1 - q)^3, and the Laplacian of the one for viscosity, 45 / (pi
  // h^6) (h - r)
  const double h = 0.7, pi = std::acos(-1.);
  const MuellerKernels<double> mueller(h);
  for (const double q : {0.2, 0.8}) {
    CHECK(mueller.pressureSlope(q) * q * h == Approx(-45 / (pi * h * h * h * h) * (1 - q) * (1 - q)));
    CHECK(mueller.viscosityLaplacian(q) == Approx(45 / (pi * std::pow(h, 5)) * (1 - q)));
  }
}

TEST_CASE("forces of all kinds are the sums over all pairs, in lanes, in scalars and in single precision") {
  auto x = scattered(300, 2, 3), v = scattered(300, 1, 4);
  x.push_back(x[5]);  // two in one place do not push each other
  v.push_back({1, 0, 0});
  for (const int kernel : {0, 1})
    for (const int viscosity : {0, 1, 2})
      for (const int tension : {0, 1, 2, 3}) {
        CAPTURE(kernel, viscosity, tension);
        auto set = [&](auto fluid) {
          fluid.radius = 0.4, fluid.mass = 0.2, fluid.pressure = 3, fluid.density = 5;
          fluid.viscosity = viscosity == 0 ? 0 : 0.7;
          fluid.surfaceTension = tension == 0 ? -1 : 0.5;
          fluid.kernelType = kernel, fluid.viscosityType = std::max(1, viscosity),
          fluid.surfaceTensionType = std::max(1, tension);
          return fluid;
        };
        const auto fluid = set(SPHFluidForceField<Vec3d>{});
        const auto expected =
            kernel == 1 ? by_all_pairs<CubicKernels>(fluid, x, v) : by_all_pairs<MuellerKernels>(fluid, x, v);
        const auto f = forces<Vec3d>(fluid, x, v);
        const auto plain = forces<WithLanes<Vec3d, 1>>(set(SPHFluidForceField<WithLanes<Vec3d, 1>>{}), x, v);
        double largest = 0;
        for (auto const& one : expected) largest = std::max(largest, one.norm());
        Eigen::Vector3d total(0, 0, 0);
        for (std::size_t i = 0; i < x.size(); ++i) {
          REQUIRE((f[i] - expected[i]).norm() < 1e-11 * largest);
          REQUIRE((plain[i] - expected[i]).norm() < 1e-11 * largest);
          total += f[i];
        }
        if (tension != 1) CHECK(total.norm() < 1e-12 * largest * double(x.size()));
        std::vector<Eigen::Vector3f> xf, vf;
        for (std::size_t i = 0; i < x.size(); ++i)
          xf.push_back(x[i].cast<float>()), vf.push_back(v[i].cast<float>());
        const auto single = forces<Vec3f>(set(SPHFluidForceField<Vec3f>{}), xf, vf);
        if (tension != 1)  // a curvature over the length of a normal has no bound for rounding
          for (std::size_t i = 0; i < x.size(); ++i)
            REQUIRE((single[i].cast<double>() - expected[i]).norm() < 1e-3 * largest);
      }
}

TEST_CASE("the cohesion of Akinci et al. pulls across a plane as the tension says, by quadrature") {
  // pi/8 int s r^4 dr of what two volumes pull each other by (Fowler 1937), at the density at rest
  const double tension = 0.07, radius = 0.02, volume = 1e-6, density = 1000;
  const auto surface = SphTension<double>::of(tension, 0, radius, volume, density);
  const int n = 4000;
  double sum = 0;
  for (int k = 0; k < n; ++k) {  // midpoints
    const double q = (k + 0.5) / n, r = q * radius;
    sum -= surface.pull(q, 2 * density, 1., 1.).along * r / (volume * volume) * std::pow(r, 4) * radius / n;
  }
  CHECK(std::acos(-1.) / 8 * sum == Approx(tension).epsilon(1e-6));
  // adhesion is between fluid and boundary alone, from half the radius on, and largest at three quarters
  const auto wall = SphTension<double>::of(tension, 0.5, radius, volume, density);
  auto held = [&](double q, double own, double other) {
    return -wall.pull(q, 2 * density, own, other).along * q * radius;
  };
  CHECK(held(0.75, 1, 0) == Approx(0.5 / tension * held(0.5 + 1e-9, 1, 1)));
  CHECK(held(0.75, 0, 1) == held(0.75, 1, 0));
  CHECK(held(0.7, 1, 0) < held(0.75, 1, 0));
  CHECK(held(0.8, 1, 0) < held(0.75, 1, 0));
  for (const double q : {0.1, 0.5, 1.}) CHECK(held(q, 1, 0) == Approx(0).margin(1e-6 * held(0.75, 1, 0)));
  CHECK(held(0.75, 0, 0) == 0);
}

TEST_CASE("with the cubic kernel the pressure is the slope of its energy") {
  const auto x = scattered(200, 1.5, 11);
  const std::vector<Eigen::Vector3d> zero(x.size(), Eigen::Vector3d::Zero());
  SPHFluidForceField<Vec3d> fluid{
      .radius = 0.5, .mass = 0.3, .pressure = 7, .density = 20, .viscosity = 0, .kernelType = 1};
  const auto f = forces<Vec3d>(fluid, x, zero);
  const auto direction = scattered(200, 1, 12);
  auto energy = [&](double h) {
    auto moved = x;
    for (std::size_t i = 0; i < x.size(); ++i) moved[i] += h * direction[i];
    auto c = fluid;
    c.init(InitContext<Vec3d>{"test", moved, {}});
    return c.potentialEnergy(moved);
  };
  const double h = 1e-6;
  double work = 0;
  for (std::size_t i = 0; i < x.size(); ++i) work += f[i].dot(direction[i]);
  CHECK(work == Approx(-(energy(h) - energy(-h)) / (2 * h)).epsilon(1e-6));
}

TEST_CASE("a drop that is let go keeps momentum to rounding, and its energy by the order of the solver") {
  auto run = [](double dt) {
    // 216 particles, compressed to half of their density
    std::vector<Eigen::Vector3d> x;
    for (int i = 0; i < 216; ++i) x.push_back(0.1 * Eigen::Vector3d(i % 6, i / 6 % 6, i / 36));
    Simulation sim{node<"root">(
        EulerExplicitSolver{},
        MechanicalObject<Vec3d>{.position = x},
        UniformMass<Vec3d>{.vertexMass = 1},
        SPHFluidForceField<Vec3d>{
            .radius = 0.25, .mass = 1, .pressure = 10, .density = 500, .viscosity = 0, .kernelType = 1})};
    sim.init();
    const double start = sim.potentialEnergy();
    double worst = 0;
    while (sim.time() < 0.2) {
      sim.animate(dt);
      worst = std::max(worst, std::abs(sim.kineticEnergy() + sim.potentialEnergy() - start) / start);
    }
    Eigen::Vector3d momentum(0, 0, 0);
    for (auto const& v : sim.root().state().velocity) momentum += v;
    CHECK(momentum.norm() < 1e-10);
    CHECK(sim.kineticEnergy() > 0.1 * start);
    return worst;
  };
  const double coarse = run(1e-3), fine = run(5e-4);
  CHECK(coarse < 0.02);
  CHECK(fine < 0.6 * coarse);  // symplectic Euler, of first order
}

TEST_CASE("threads share the particles among them, with the same bits") {
  const auto x = scattered(3000, 2, 21);
  auto run = [&](auto... threads) {
    Simulation sim{node<"root">(
        threads...,
        EulerExplicitSolver{},
        MechanicalObject<Vec3d>{.position = x},
        UniformMass<Vec3d>{.vertexMass = 1},
        SPHFluidForceField<Vec3d>{
            .radius = 0.2, .pressure = 1, .density = 1000, .viscosity = 0.1, .surfaceTension = 0.1})};
    sim.init();
    for (int i = 0; i < 20; ++i) sim.animate(1e-3);
    return sim.root().state().position;
  };
  const auto one = run();
  CHECK(one != x);
  CHECK(run(Threads{.count = 2}) == one);
  CHECK(run(Threads{.count = 5}) == one);
}

TEST_CASE("what cannot be is refused with what and where") {
  auto wrong = [](SPHFluidForceField<Vec3d> fluid, std::vector<Eigen::Vector3d> x) {
    Simulation sim{node<"root">(EulerExplicitSolver{},
                                MechanicalObject<Vec3d>{.position = x},
                                UniformMass<Vec3d>{.vertexMass = 1},
                                fluid)};
    return error_of([&] {
      sim.init();
      sim.animate(0.01);
    });
  };
  const std::vector<Eigen::Vector3d> two{{0, 0, 0}, {1, 0, 0}};
  CHECK_THAT(wrong({.radius = 0}, two), Catch::Contains("radius") && Catch::Contains("/root"));
  CHECK_THAT(wrong({.mass = -1}, two), Catch::Contains("mass"));
  CHECK_THAT(wrong({.density = 0}, two), Catch::Contains("density"));
  CHECK_THAT(wrong({.pressure = std::nan("")}, two), Catch::Contains("pressure"));
  CHECK_THAT(wrong({.adhesion = -1}, two), Catch::Contains("adhesion"));
  CHECK_THAT(wrong({.kernelType = 2}, two), Catch::Contains("kernelType"));
  CHECK_THAT(wrong({.surfaceTensionType = 4}, two), Catch::Contains("surfaceTensionType"));
  CHECK_THAT(wrong({.radius = 1e-3}, {{0, 0, 0}, {1e6, 0, 0}}),
             Catch::Contains("2^20 cells") && Catch::Contains("SPHFluidForceField"));
}

}  // namespace test_sph_fluid
