// SPDX-License-Identifier: BSL-1.0
#include "equilibrium.hpp"
#include "registry_scene.hpp"
#include "validation/beams.hpp"
#include "validation/record.hpp"

#include <sinew/mass/beam_mass.hpp>
#include <sinew/solver/runge_kutta4.hpp>

#include <Eigen/Eigenvalues>
#include <numbers>

namespace test_beams_vibration {

using namespace beams;
using std::numbers::pi;

namespace {

// 1 m long, 2.5 mm x 4 mm
const double E = 2e9, nu = 0.25, density = 1000, Ly = 2.5e-3, Lz = 4e-3;
const Beam beam{.poissonRatio = nu,
                .youngModulus = E,
                .crossSectionShape = CrossSectionShape::rectangular,
                .lengthY = Ly,
                .lengthZ = Lz,
                .shearStressComputation = false};
const BeamMass<Rigid3d> mass{.massDensity = density,
                             .crossSectionShape = CrossSectionShape::rectangular,
                             .lengthY = Ly,
                             .lengthZ = Lz};

/// Angular frequencies, in rising order, of a beam of n elements without its held degrees of freedom, 6 i + c
/// of coordinate c of frame i; of those that `seen` chooses.
template <class Seen>
std::vector<double> frequencies(int n, std::vector<int> const& held, Seen const& seen) {
  const auto edges = chain(n);
  const auto x = straight(n, 1);
  TopologyView topology;
  topology.edges = edges;
  Beam elastic = one::ready(beam, x, topology);
  const auto inert = one::ready(mass, x, topology);
  one::force(elastic, x);
  const Eigen::MatrixXd k = one::stiffness(elastic, x.size());
  std::vector<int> free;
  for (int i = 0; i < int(k.rows()); ++i)
    if (std::find(held.begin(), held.end(), i) == held.end() && seen(i % 6)) free.push_back(i);
  const long m = long(free.size());
  Eigen::MatrixXd stiff(m, m), heavy(m, m);
  for (long j = 0; j < m; ++j) {
    Rigid3d::VecDeriv dx(x.size(), Deriv::Zero()), f = dx;
    dx[std::size_t(free[std::size_t(j)] / 6)][free[std::size_t(j)] % 6] = 1;
    inert.addMDx(f, x, dx, 1);
    for (long i = 0; i < m; ++i) {
      stiff(i, j) = -k(free[std::size_t(i)], free[std::size_t(j)]);
      heavy(i, j) = f[std::size_t(free[std::size_t(i)] / 6)][free[std::size_t(i)] % 6];
    }
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      stiff, heavy, Eigen::EigenvaluesOnly);
  std::vector<double> w;
  for (const double l : solver.eigenvalues()) w.push_back(std::sqrt(std::max(l, 0.0)));
  return w;
}

const std::vector<int> clamped{0, 1, 2, 3, 4, 5};
/// The frequencies from number `first` on against the exact ones: with 32 elements within `maximum`, and with
/// half as many 2^order times as far. Held are the dofs `start` of the first frame and `end` of the last.
template <class Seen>
void check(std::vector<int> const& start, std::vector<int> const& end, Seen const& seen, std::size_t first,
           std::vector<double> const& exact, double maximum, double order) {
  auto found = [&](int n) {
    std::vector<int> held = start;
    for (const int c : end) held.push_back(6 * n + c);
    return frequencies(n, held, seen);
  };
  const auto coarse = found(16), fine = found(32);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double e = coarse[first + i] / exact[i] - 1, f = fine[first + i] / exact[i] - 1;
    INFO("frequency " << i << " errors " << e << " " << f << " ratio " << e / f);
    CHECK(std::abs(f) < maximum);
    CHECK(e / f == Approx(std::pow(2, order)).epsilon(0.1));
  }
}

}  // namespace

// w = sqrt(EI / r A) k^2. The rotary inertia of the sections adds I k^2 / A to the mass, 1e-4 of it at most;
// with simple supports it is in the closed form (Rayleigh), as the errors are smaller there.
TEST_CASE("a beam swings at the frequencies of the closed forms") {
  const BeamSection s = rectangular_section(Ly, Lz, nu);
  for (const bool y : {true, false}) {
    INFO("along " << (y ? "y" : "z"));
    const double I = y ? s.aboutZ : s.aboutY, line = density * s.area;
    auto bending = [&](std::vector<int> const& start,
                       std::vector<int> const& end,
                       std::size_t first,
                       std::vector<double>
                           k,
                       double rotary,
                       double maximum,
                       double order) {
      for (double& b : k) b = b * b * std::sqrt(E * I / (line + rotary * density * I * b * b));
      const auto seen = [y](int c) { return y ? c == 1 || c == 5 : c == 2 || c == 4; };
      check(start, end, seen, first, k, maximum, order);
    };
    bending(clamped, {}, 0, {1.87510407, 4.69409113, 7.85475744}, 0, 3e-3, 2);
    bending({0, 1, 2, 3}, {1, 2}, 0, {pi, 2 * pi, 3 * pi}, 1, 1e-5, 4);
    bending({}, {}, 2, {4.73004074, 7.85320462, 10.9956079}, 0, 8e-3, 2);
  }
  // stretch and twist are waves of their speeds: w = k c, k = pi/2, 3 pi/2
  const double stretch = std::sqrt(E / density),
               twist = std::sqrt(E / (2 * (1 + nu)) * s.torsion / (density * (s.aboutY + s.aboutZ)));
  const std::vector<double> k{pi / 2, 3 * pi / 2};
  check(
      clamped, {}, [](int c) { return c == 0; }, 0, {k[0] * stretch, k[1] * stretch}, 1e-3, 2);
  check(
      clamped, {}, [](int c) { return c == 3; }, 0, {k[0] * twist, k[1] * twist}, 1e-3, 2);
}

TEST_CASE("frequencies of beams against the size of their elements, for the page", "[page]") {
  Record curve("beam_frequencies", {"mode", "h", "error"});
  const BeamSection s = rectangular_section(Ly, Lz, nu);
  const double speed = std::sqrt(E * s.aboutZ / (density * s.area)), rotary = s.aboutZ / s.area;
  auto errors = [&](std::string name,
                    std::vector<int> const& start,
                    std::vector<int> const& end,
                    auto const& seen,
                    double exact) {
    double last = 0, order = 0;
    for (const int n : {4, 8, 16, 32}) {
      std::vector<int> held = start;
      for (const int c : end) held.push_back(6 * n + c);
      const double error = std::abs(frequencies(n, held, seen)[0] / exact - 1);
      curve.row(name, 1.0 / n, error);
      order = std::log2(last / error), last = error;
    }
    return order;
  };
  const auto bending = [](int c) { return c == 1 || c == 5; };
  const double clampedMode = 1.87510407 * 1.87510407 * speed,
               simple = pi * pi * speed / std::sqrt(1 + rotary * pi * pi);
  CHECK(errors("bending, clamped at one end", clamped, {}, bending, clampedMode) == Approx(2).margin(0.05));
  CHECK(errors("bending, on simple supports", {0, 1, 2, 3}, {1, 2}, bending, simple) ==
        Approx(4).margin(0.3));
  CHECK(errors(
            "stretch", clamped, {}, [](int c) { return c == 0; }, pi / 2 * std::sqrt(E / density)) ==
        Approx(2).margin(0.05));
}

// A bent and twisted beam that flies: nothing acts on it, so that both momenta and the energy stay.
TEST_CASE("a free beam in flight keeps its momenta and its energy") {
  const int n = 6;
  MechanicalObject<Rigid3d> state;
  state.restPosition = state.position = straight(n, 1);
  for (std::size_t i = 0; i <= n; ++i) {
    const double k = double(i);
    Deriv bend, v;
    bend << 0, 0.1 * std::sin(k), 0.05 * std::cos(2 * k), 0.2 * k, 0.1, 0.3 * std::sin(k);
    Rigid3d::increment(state.position[i], bend);
    v << 1, 0.5 * k, -1, 2, -0.5 * k, 3;
    state.velocity.push_back(v);
  }
  const double radius = 0.05;
  RegistryScene sim{node<"root">(
      RungeKutta4Solver{},
      MeshTopology{.edges = chain(n)},
      state,
      BeamMass<Rigid3d>{.massDensity = density, .radius = radius},
      Beam{.poissonRatio = 0.3, .youngModulus = 1e5, .radius = radius, .shearStressComputation = true})};
  sim.init();
  auto const& s = sim.root().state();
  auto momenta = [&] {
    Rigid3d::VecDeriv p(n + 1, Deriv::Zero());
    sim.root().get<BeamMass<Rigid3d>>().addMDx(p, s.position, s.velocity, 1);
    Deriv sum = Deriv::Zero();
    for (std::size_t i = 0; i <= n; ++i) {
      sum += p[i];
      sum.tail<3>() += s.position[i].center.cross(p[i].head<3>());
    }
    return sum;
  };
  const Deriv before = momenta();
  const double elastic = sim.potentialEnergy(), all = elastic + sim.kineticEnergy();
  CHECK(elastic > 0.01 * all);
  CHECK(before[0] == Approx(density * pi * radius * radius));  // the mass of the beam at 1 m/s
  double minimum = elastic, maximum = elastic;
  for (int i = 0; i < 4000; ++i) {
    sim.animate(5e-4);
    minimum = std::min(minimum, sim.potentialEnergy()), maximum = std::max(maximum, sim.potentialEnergy());
  }
  const double lost = (sim.potentialEnergy() + sim.kineticEnergy()) / all - 1;
  const Deriv change = momenta() - before;
  INFO("elastic energy " << minimum << " to " << maximum << " of " << all << ", lost " << lost << ", momenta "
                         << change.transpose() / before.norm());
  // RK4 keeps linear momentum to rounding, the rest to its order
  CHECK(change.head<3>().norm() < 1e-11 * before.norm());
  CHECK(change.tail<3>().norm() < 1e-6 * before.norm());
  CHECK(std::abs(lost) < 1e-5);
  CHECK(maximum > 1.1 * minimum);
}

}  // namespace test_beams_vibration
