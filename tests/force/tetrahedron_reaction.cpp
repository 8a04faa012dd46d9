// SPDX-License-Identifier: BSL-1.0
// Reactions on bodies: waves and action potentials against closed forms and their equations.
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/force/tetrahedron_diffusion.hpp>
#include <sinew/force/tetrahedron_reaction.hpp>
#include <sinew/mass/diagonal_mass.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/regular_grid.hpp>
#include <sinew/topology/tetrahedron_topology.hpp>

#include <cmath>

namespace test_tetrahedron_reaction {

using namespace sinew;
using Field = TetrahedronReactionFEMForceField<Vec1d>;

namespace {

/// A bar along x of n cells of size h, one cell across.
Mesh bar(int n, double h) { return regular_grid_tetrahedra(n + 1, 2, 2, {0, 0, 0}, {n * h, h, h}); }

auto scene(Mesh const& mesh, Vec1d::VecCoord const& u, Field const& reaction, double diffusion,
           double density = 1) {
  return Simulation{node<"root">(
      MechanicalObject<Vec3d>{.position = mesh.positions},
      TetrahedronTopology{mesh.tetrahedra},
      UniformMass<Vec3d>{},
      node<"u">(EulerImplicitSolver{.firstOrder = true},
                CGLinearSolver<>{.iterations = 500, .tolerance = 1e-12, .threshold = 1e-30},
                MechanicalObject<Vec1d>{.position = u},
                DiagonalMass<Vec1d>{.massDensity = density},
                TetrahedronDiffusionFEMForceField<Vec1d>{.constantDiffusionCoefficient = diffusion},
                reaction))};
}
template <class F>
Vec1d::VecCoord values(Mesh const& mesh, F&& u) {
  Vec1d::VecCoord all;
  for (auto const& p : mesh.positions) all.push_back(Vec1d::Coord(u(p[0])));
  return all;
}
/// Where the mean over the cross section passes a level from above, between two layers.
double front(Mesh const& mesh, Vec1d::VecCoord const& u, double h, double level) {
  double before = 0;
  for (int i = 0;; ++i) {
    double sum = 0;
    int count = 0;
    for (std::size_t k = 0; k < u.size(); ++k)
      if (std::abs(mesh.positions[k][0] - i * h) < 0.1 * h) sum += u[k][0], ++count;
    if (count == 0) return -1;
    const double mean = sum / count;
    if (mean < level) return (i - 1 + (before - level) / (before - mean)) * h;
    before = mean;
  }
}

}  // namespace

TEST_CASE("a front of Fisher, Kolmogorov, Petrovsky and Piskunov goes with 2 sqrt(D r)", "[long]") {
  const double D = 0.6, r = 1.5, h = 0.25, dt = 0.02, density = 3;
  const int n = 240;
  const Mesh mesh = bar(n, h);
  Field field{.parameterSet = {r}, .massDensity = density};
  auto sim = scene(mesh, values(mesh, [](double x) { return x < 1 ? 1. : 0.; }), field, density * D, density);
  sim.init();
  auto const& u = sim.at<"u">().state().position;
  auto at = [&](double t) {
    while (sim.time() < t - dt / 2) sim.animate(dt);
    return front(mesh, u, h, 0.5);
  };
  const double t1 = 10, t2 = 20, x1 = at(t1), x2 = at(t2), speed = (x2 - x1) / (t2 - t1);
  // cells and steps lead the foot e^(s t - q x) with 1/(1 - dt s) = e^(c q dt), s = r + 2 D/h^2 (cosh q h -
  // 1); the slowest of these is the front, and comes from behind by 3/(2 q) ln t (Bramson 1983)
  double slowest = 1e9, q = 0;
  for (double k = 0.5; k < 3; k += 1e-3) {
    const double s = r + 2 * D / (h * h) * (std::cosh(k * h) - 1), c = -std::log(1 - dt * s) / (dt * k);
    if (c < slowest) slowest = c, q = k;
  }
  CHECK(slowest == Approx(2 * std::sqrt(D * r)).epsilon(0.05));
  // the next term of Bramson's is of order t^(-3/2), 2 % here
  CHECK(speed == Approx(slowest - 1.5 / q * std::log(t2 / t1) / (t2 - t1)).epsilon(0.02));
}

TEST_CASE("a front between Nagumo's two values has its closed form") {
  const double D = 0.5, k = 2, a = 0.2, h = 0.125, dt = 0.01;
  const Mesh mesh = bar(160, h);
  const double width = std::sqrt(2 * D / k), c = std::sqrt(D * k / 2) * (1 - 2 * a);
  auto wave = [&](double x) { return 1 / (1 + std::exp((x - 5) / width)); };
  Field field{.reaction = Reaction::FitzHughNagumo, .parameterSet = {k, a, 0, 0}};
  auto sim = scene(mesh, values(mesh, wave), field, D);
  sim.init();
  const double duration = 10;
  for (int i = 0; i < 1000; ++i) sim.animate(dt);
  auto const& u = sim.at<"u">().state().position;
  // space: (h / width)^2 / 12 of the speed and less, time: k dt / 2
  CHECK(front(mesh, u, h, 0.5) == Approx(5 + c * duration).margin(0.015 * c * duration));
  for (std::size_t i = 0; i < u.size(); ++i)
    CHECK(u[i][0] == Approx(wave(mesh.positions[i][0] - (front(mesh, u, h, 0.5) - 5))).margin(0.01));
}

TEST_CASE("an action potential follows its equations with order 1, and lasts as Mitchell and Schaeffer say") {
  const Mesh one = bar(1, 0.3);
  const double in = 0.3e-3, out = 6e-3, open = 0.12, close = 0.15, gate = 0.13;
  Field field{.reaction = Reaction::MitchellSchaeffer, .parameterSet = {in, out, open, close, gate}};
  // until u is below the gate again [s], by steps of the scene
  auto duration = [&](double dt) {
    auto sim = scene(one, values(one, [](double) { return 0.3; }), field, 0);
    sim.init();
    auto const& u = sim.at<"u">().state().position;
    double last = u[0][0];
    while (u[0][0] > gate && sim.time() < 1) {
      last = u[0][0];
      sim.animate(dt);
    }
    return sim.time() - dt * (gate - u[0][0]) / (last - u[0][0]);
  };
  // and by the method of Runge and Kutta, of order 4
  double u = 0.3, w = 1, exact = 0;
  const double step = 1e-6;
  while (u > gate) {
    auto rate = [&](double a, double b) {
      return std::pair((b * a * a * (1 - a)) / in - a / out, a < gate ? (1 - b) / open : -b / close);
    };
    const auto [a1, b1] = rate(u, w);
    const auto [a2, b2] = rate(u + step / 2 * a1, w + step / 2 * b1);
    const auto [a3, b3] = rate(u + step / 2 * a2, w + step / 2 * b2);
    const auto [a4, b4] = rate(u + step * a3, w + step * b3);
    u += step / 6 * (a1 + 2 * a2 + 2 * a3 + a4), w += step / 6 * (b1 + 2 * b2 + 2 * b3 + b4);
    exact += step;
  }
  const double coarse = duration(1e-4) - exact, fine = duration(5e-5) - exact;
  CHECK(std::abs(coarse) < 2e-4);
  CHECK(coarse / fine == Approx(2).epsilon(0.15));
  // until w = 4 tauIn/tauOut, where the excited state ends, and a delay of the order (tauOut/tauClose)^(2/3),
  // 12 %
  const double leading = close * std::log(out / (4 * in));
  CHECK(exact > leading);
  CHECK(exact < (1 + 2 * std::pow(out / close, 2. / 3)) * leading);
}

TEST_CASE("FitzHugh and Nagumo's w goes exactly where u stays, from what is given, and starts again") {
  const Mesh one = bar(1, 1);
  Field field{.reaction = Reaction::FitzHughNagumo, .parameterSet = {0.001, 0.5, 2, 0}, .recovery = {0.25}};
  auto sim = scene(one, values(one, [](double) { return 0.; }), field, 0);
  sim.init();
  auto& reaction = sim.at<"u">().get<Field>();
  for (int i = 0; i < 10; ++i) sim.animate(0.1);
  // b = 0: w = w0 e^(-2 t), whatever u does
  for (const double w : reaction.remembered) CHECK(w == Approx(0.25 * std::exp(-2.)).epsilon(1e-13));
  sim.reset();
  CHECK(reaction.remembered == std::vector<double>(8, 0.25));
}

TEST_CASE("reactions are checked") {
  const Mesh one = bar(1, 1);
  auto refused = [&](Field const& field, std::initializer_list<std::string_view> words) {
    const std::string message = error_of([&] {
      auto sim = scene(one, values(one, [](double) { return 0.; }), field, 0);
      sim.init();
    });
    for (const auto word : words) {
      INFO(message << "\nshould have: " << word);
      CHECK(message.find(word) != std::string::npos);
    }
  };
  refused({}, {"u", "TetrahedronReactionFEMForceField", "0 values", "FisherKPP takes r"});
  refused({.parameterSet = {0}}, {"ParameterSet[0] is 0", "greater than 0"});
  refused({.parameterSet = {std::nan("")}}, {"ParameterSet[0] is nan", "finite"});
  refused({.reaction = Reaction::MitchellSchaeffer, .parameterSet = {1, 1, 1, 0, 1}},
          {"ParameterSet[3] is 0", "tauClose"});
  refused({.parameterSet = {1}, .massDensity = 0}, {"massDensity is 0"});
  refused({.parameterSet = {1}, .recovery = {1, 2}}, {"recovery has 2 values for 8 points"});
}

}  // namespace test_tetrahedron_reaction
