// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/force/tetrahedron_diffusion.hpp>
#include <sinew/mass/diagonal_mass.hpp>
#include <sinew/mass/mesh_matrix_mass.hpp>
#include <sinew/sinew.hpp>

#include <array>
#include <cmath>
#include <numbers>

namespace test_tetrahedron_diffusion {

using namespace sinew;

namespace {

/// A bar of length 1 along x in n cells, m across a width of w, six tetrahedra each; shaken inside where
/// asked.
struct Bar {
  std::vector<Eigen::Vector3d> points{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<int> left{}, right{};

  explicit Bar(int n, int m = 2, double w = 0.4, double shake = 0) {
    auto at = [&](int i, int j, int k) { return i + (n + 1) * (j + (m + 1) * k); };
    for (int k = 0; k <= m; ++k)
      for (int j = 0; j <= m; ++j)
        for (int i = 0; i <= n; ++i) {
          Eigen::Vector3d p(double(i) / n, w * j / m, w * k / m);
          if (i % n && j % m && k % m)
            p += shake *
                 Eigen::Vector3d(std::sin(i + 2.0 * j), std::sin(3.0 * j + k), std::sin(5.0 * k + i)) / n;
          (i == 0 ? left : right).push_back(at(i, j, k));
          if (i % n) right.pop_back();
          points.push_back(p);
        }
    for (int k = 0; k < m; ++k)
      for (int j = 0; j < m; ++j)
        for (int i = 0; i < n; ++i)
          for (auto const& path :
               {std::array{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}}) {
            std::array<int, 3> c{i, j, k};
            Tetrahedron t{at(c[0], c[1], c[2]), 0, 0, 0};
            for (std::size_t s = 0; s < 3; ++s) {
              ++c[std::size_t(path[s])];
              t[s + 1] = at(c[0], c[1], c[2]);
            }
            Eigen::Matrix3d sides;
            for (int s = 0; s < 3; ++s)
              sides.col(s) = points[std::size_t(t[std::size_t(s) + 1])] - points[std::size_t(t[0])];
            if (sides.determinant() < 0) std::swap(t[1], t[2]);
            tetrahedra.push_back(t);
          }
  }
  /// u at each point
  template <class F>
  Vec1d::VecCoord values(F&& u) const {
    Vec1d::VecCoord all;
    for (auto const& p : points) all.push_back(Vec1d::Coord(u(p)));
    return all;
  }
  template <class D>
  InitContext<D> context(typename D::VecCoord const& u) const {
    return {"heat", u, {.tetrahedra = tetrahedra}, {}, points};
  }
};

/// The temperatures in a child node of the body, as in SOFA's scene.
auto heat(Bar const& bar, Vec1d::VecCoord const& u, MeshMatrixMass<Vec1d> const& mass, double k,
          std::vector<int> const& held = {}) {
  return node<"root">(
      Gravity{{0, 0, 0}},
      MechanicalObject<Vec3d>{.position = bar.points},
      UniformMass<Vec3d>{},
      // the topology may stand below the points, and other nodes between
      node<"mesh">(TetrahedronTopology{bar.tetrahedra},
                   node<"heat">(EulerImplicitSolver{.firstOrder = true},
                                CGLinearSolver<>{.iterations = 1000, .tolerance = 1e-14, .threshold = 1e-30},
                                MechanicalObject<Vec1d>{.position = u},
                                mass,
                                FixedConstraint<Vec1d>{.indices = held},
                                node<"forces">(TetrahedronDiffusionFEMForceField<Vec1d>{
                                    .constantDiffusionCoefficient = k}))));
}

/// E / T of values: the Rayleigh quotient u'Ku / u'Mu [1/s].
double rate(Bar const& bar, Vec1d::VecCoord const& u, double k, double capacity) {
  TetrahedronDiffusionFEMForceField<Vec1d> force{.constantDiffusionCoefficient = k};
  force.init(bar.context<Vec1d>(u));
  MeshMatrixMass<Vec1d> mass{.massDensity = {capacity}};
  mass.init(bar.context<Vec1d>(u));
  return potential_energy(force, u) / mass.kineticEnergy(u, u);
}

}  // namespace

TEST_CASE("the energy of values that rise linearly is V/2 g . K g, however the body is cut") {
  const Bar bar(6, 3, 0.5, 0.2);
  const Eigen::Vector3d g(0.3, -1.2, 0.7), d(1, 2, -1);
  const auto u = bar.values([&](Eigen::Vector3d const& p) { return 2 + g.dot(p); });
  const double volume = 0.25, k = 3, r = 4;
  TetrahedronDiffusionFEMForceField<Vec1d> force{
      .constantDiffusionCoefficient = k, .anisotropyRatio = r, .transverseAnisotropyArray = {5 * d}};
  force.init(bar.context<Vec1d>(u));
  const double along = g.dot(d.normalized());
  // sums of 300 terms of rounding 1e-16
  CHECK(potential_energy(force, u) ==
        Approx(volume / 2 * k * (g.squaredNorm() + (r - 1) * along * along)).epsilon(1e-12));

  // and nothing flows into points inside: the net flow of a constant gradient is 0
  Vec1d::VecDeriv f(u.size(), Vec1d::Deriv::Zero());
  add_force(force, {}, f, u, f);
  for (std::size_t i = 0; i < u.size(); ++i) {
    auto const& p = bar.points[i];
    const bool inside =
        p[0] > 0.01 && p[0] < 0.99 && p[1] > 0.01 && p[1] < 0.49 && p[2] > 0.01 && p[2] < 0.49;
    if (inside) CHECK(std::abs(f[i][0]) < 1e-12);
  }
}

TEST_CASE("anisotropic diffusion turns with the body and its directions") {
  Bar bar(4, 2, 0.5, 0.2);
  const auto u = bar.values([](Eigen::Vector3d const& p) { return std::sin(3 * p[0] + p[1] * p[2]); });
  auto flow = [&](Eigen::Vector3d const& d) {
    TetrahedronDiffusionFEMForceField<Vec1d> force{.anisotropyRatio = 5, .transverseAnisotropyArray = {d}};
    force.init(bar.context<Vec1d>(u));
    Vec1d::VecDeriv f(u.size(), Vec1d::Deriv::Zero());
    add_force(force, {}, f, u, f);
    return f;
  };
  const Eigen::Matrix3d q = Eigen::Quaterniond(0.4, -0.3, 0.6, 0.5).normalized().toRotationMatrix();
  const Eigen::Vector3d d(1, 0.5, 0.2);
  const auto before = flow(d);
  for (auto& p : bar.points) p = (q * p).eval();
  const auto turned = flow(q * d), other = flow(d);
  double difference = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    CHECK(turned[i][0] == Approx(before[i][0]).margin(1e-13));
    difference = std::max(difference, std::abs(other[i][0] - before[i][0]));
  }
  CHECK(difference > 1e-2);  // fibres that stay are others
}

TEST_CASE("each tetrahedron may have a conductivity and a direction of its own") {
  const Bar bar(5, 2);
  const auto u = bar.values([](Eigen::Vector3d const& p) { return p[0] * p[0] + p[1]; });
  auto energy = [&](TetrahedronDiffusionFEMForceField<Vec1d> force) {
    force.init(bar.context<Vec1d>(u));
    return potential_energy(force, u);
  };
  std::vector<double> halves;
  for (auto const& t : bar.tetrahedra) halves.push_back(bar.points[std::size_t(t[0])][1] < 0.19 ? 1 : 0);
  std::vector<double> others;
  for (const double k : halves) others.push_back(1 - k);
  const double whole = energy({});
  CHECK(energy({.tetraDiffusionCoefficient = halves}) + energy({.tetraDiffusionCoefficient = others}) ==
        Approx(whole).epsilon(1e-13));
  CHECK(energy({.constantDiffusionCoefficient = 7, .tetraDiffusionCoefficient = {2}}) ==
        Approx(2 * whole).epsilon(1e-13));
  const std::vector<Eigen::Vector3d> directions(bar.tetrahedra.size(), {0, 3, 0});
  CHECK(energy({.anisotropyRatio = 2, .transverseAnisotropyArray = directions}) ==
        Approx(energy({.anisotropyRatio = 2, .transverseAnisotropyArray = {{0, 1, 0}}})).epsilon(1e-13));
}

TEST_CASE("a bar between two temperatures comes to the linear profile") {
  const Bar bar(8, 3, 0.4, 0.3);
  std::vector<int> held = bar.left;
  held.insert(held.end(), bar.right.begin(), bar.right.end());
  const auto start = bar.values([](Eigen::Vector3d const& p) {
    return p[0] < 0.01 ? 20.0 : p[0] > 0.99 ? 50.0 : 0;
  });
  Simulation sim{heat(bar, start, MeshMatrixMass<Vec1d>{.massDensity = {1.0}}, 1.0, held)};
  sim.init();
  // each step leaves of a mode 1 / (1 + pi^2 dt) = 0.09 at most: 20 of them leave 1e-20
  for (int i = 0; i < 20; ++i) sim.animate(1.0);
  auto const& u = sim.at<"mesh/heat">().state().position;
  // linear elements have the linear profile exactly, on any mesh; 50 degrees at a CG tolerance of 1e-14
  for (std::size_t i = 0; i < u.size(); ++i)
    CHECK(u[i][0] == Approx(20 + 30 * bar.points[i][0]).margin(1e-9));
}

TEST_CASE(
    "the first cosine mode decays by k pi^2 / (c L^2), with an error of the second order of the cells") {
  const double k = 0.3, c = 2, exact = k / c * std::numbers::pi * std::numbers::pi;
  double before = 0;
  for (const int n : {4, 8, 16, 32}) {
    const Bar bar(n, 1, 0.1);
    const auto u = bar.values([](Eigen::Vector3d const& p) { return std::cos(std::numbers::pi * p[0]); });
    const double error = rate(bar, u, k, c) / exact - 1;
    // (pi h)^2 / 12 of linear elements on a line
    CHECK(error == Approx(std::pow(std::numbers::pi / n, 2) / 12).epsilon(0.1));
    if (before > 0) CHECK(std::log2(before / error) == Approx(2).margin(0.1));
    before = error;
  }
}

TEST_CASE("a simulated cosine decays as its mode does") {
  const int n = 16;
  const double k = 0.5, h = 0.002, time = 0.2;
  const Bar bar(n, 1, 0.1);
  const auto u = bar.values([](Eigen::Vector3d const& p) { return std::cos(std::numbers::pi * p[0]); });
  const double decay = rate(bar, u, k, 1);
  Simulation sim{heat(bar, u, MeshMatrixMass<Vec1d>{.massDensity = {1.0}}, k)};
  sim.init();
  const int steps = int(std::lround(time / h));
  for (int i = 0; i < steps; ++i) sim.animate(h);
  const double factor = std::pow(1 + h * decay, -steps);  // of implicit Euler
  auto const& x = sim.at<"mesh/heat">().state().position;
  // the diagonals of the cells are not the same on both sides of a line, which mixes in other modes by (h
  // k)^2
  for (std::size_t i = 0; i < x.size(); ++i)
    CHECK(x[i][0] == Approx(factor * u[i][0]).margin(std::pow(std::numbers::pi / n, 2) / 8));
  CHECK(factor == Approx(std::exp(-k * std::numbers::pi * std::numbers::pi * time)).epsilon(0.01));
}

TEST_CASE("heat is conserved in a body that is insulated, and evens out") {
  const Bar bar(6, 3, 0.5, 0.3);
  const auto u = bar.values([](Eigen::Vector3d const& p) { return std::exp(3 * p[0]) + std::sin(9 * p[1]); });
  auto run = [&](MeshMatrixMass<Vec1d> const& mass) {
    auto heatOf = [&](Vec1d::VecCoord const& x) {
      auto m = mass;
      m.init(bar.context<Vec1d>(x));
      Vec1d::VecDeriv mx(x.size(), Vec1d::Deriv::Zero());
      m.addMDx(mx, x, x, 1.0);
      double sum = 0;
      for (auto const& e : mx) sum += e[0];
      return sum;
    };
    Simulation sim{heat(bar, u, mass, 0.2)};
    sim.init();
    const double start = heatOf(u);
    double energy = 1e9;
    TetrahedronDiffusionFEMForceField<Vec1d> force{};
    force.init(bar.context<Vec1d>(u));
    for (int i = 0; i < 60; ++i) {
      sim.animate(1.0);
      auto const& x = sim.at<"mesh/heat">().state().position;
      CHECK(heatOf(x) == Approx(start).epsilon(1e-11));  // the residual of CG adds up
      const double now = potential_energy(force, x);
      CHECK(now <= energy);
      energy = now;
    }
    const double mean = start / heatOf(Vec1d::VecCoord(u.size(), Vec1d::Coord(1)));
    for (auto const& x : sim.at<"mesh/heat">().state().position) CHECK(x[0] == Approx(mean).epsilon(1e-9));
    return mean;
  };
  const double consistent = run({.massDensity = {2.5}}),
               lumped = run({.massDensity = {2.5}, .lumping = true});
  // both integrate linear values exactly, so that they have the same heat
  CHECK(consistent == Approx(lumped).epsilon(1e-9));
  MeshMatrixMass<Vec1d> rows{.massDensity = {2.5}, .lumping = true};
  rows.init(bar.context<Vec1d>(u));
  DiagonalMass<Vec1d> diagonal{.massDensity = 2.5};
  diagonal.init(bar.context<Vec1d>(u));
  for (std::size_t i = 0; i < u.size(); ++i) CHECK(diagonal.lumped.at(i) == Approx(rows.lumped.at(i)));
}

TEST_CASE("a point of no element keeps its value") {
  Bar bar(3, 1);
  bar.points.push_back({5, 5, 5});
  Vec1d::VecCoord u(bar.points.size(), Vec1d::Coord(1));
  u[0][0] = 2, u.back()[0] = 9;
  Simulation sim{heat(bar, u, {.massDensity = {2.0}}, 1.0)};
  sim.init();
  for (int i = 0; i < 10; ++i) sim.animate(1.0);
  CHECK(sim.at<"mesh/heat">().state().position.back()[0] == 9);
  CHECK(sim.at<"mesh/heat">().state().position[0][0] < 1.5);
  DiagonalMass<Vec1d> lumped{.massDensity = 2.0};
  lumped.init(bar.context<Vec1d>(u));
  CHECK(lumped.lumped.at(u.size() - 1) > 0);
}

TEST_CASE("two values of a point diffuse without each other, in single precision too") {
  const Bar bar(4, 2);
  Vec2d::VecCoord two;
  for (auto const& p : bar.points) two.push_back({p[0] * p[0], p[1] - p[2]});
  TetrahedronDiffusionFEMForceField<Vec2d> both{};
  both.init(bar.context<Vec2d>(two));
  Vec2d::VecDeriv f(two.size(), Vec2d::Deriv::Zero());
  add_force(both, {}, f, two, f);
  for (int c = 0; c < 2; ++c) {
    Vec1f::VecCoord one;
    for (auto const& x : two) one.push_back(Vec1f::Coord(float(x[c])));
    TetrahedronDiffusionFEMForceField<Vec1f> single{};
    single.init(bar.context<Vec1f>(one));
    Vec1f::VecDeriv g(one.size(), Vec1f::Deriv::Zero());
    add_force(single, {}, g, one, g);
    for (std::size_t i = 0; i < one.size(); ++i) CHECK(f[i][c] == Approx(double(g[i][0])).margin(1e-5));
  }
}

TEST_CASE("bad input of TetrahedronDiffusionFEMForceField is told") {
  Bar bar(3, 1);
  const auto u = bar.values([](Eigen::Vector3d const& p) { return p[0]; });
  using F = TetrahedronDiffusionFEMForceField<Vec1d>;
  auto errorOf = [&](F force) { return error_of([&] { force.init(bar.context<Vec1d>(u)); }); };
  using Catch::Contains;
  CHECK_THAT(errorOf({.tetraDiffusionCoefficient = {1, 2}}),
             Contains("tetraDiffusionCoefficient has 2 values for 18 tetrahedra"));
  CHECK_THAT(errorOf({.anisotropyRatio = 2}), Contains("transverseAnisotropyArray has 0 values"));
  CHECK_THAT(errorOf({.anisotropyRatio = 2, .transverseAnisotropyArray = {{0, 0, 0}}}),
             Contains("direction 0 of transverseAnisotropyArray has no length"));
  CHECK(errorOf({.anisotropyRatio = 1, .transverseAnisotropyArray = {{0, 0, 0}}}).empty());
  for (const double wrong : {-1.0, std::nan("")})
    CHECK_THAT(error_of([&] { check_fields(F{.constantDiffusionCoefficient = wrong}, "heat"); }),
               Contains("constantDiffusionCoefficient"));
  CHECK_THAT(error_of([&] {
               check_fields(F{.tetraDiffusionCoefficient = {1, -1}}, "heat");
             }),
             Contains("tetraDiffusionCoefficient"));
  CHECK_THAT(error_of([&] { check_fields(F{.anisotropyRatio = 0}, "heat"); }), Contains("anisotropyRatio"));

  auto wrongBody = [&](InitContext<Vec1d> const& context) { return error_of([&] { F{}.init(context); }); };
  CHECK_THAT(wrongBody({"heat", u, {.tetrahedra = bar.tetrahedra}}), Contains("its values lie on no body"));
  CHECK_THAT(wrongBody({"heat", u, {}, {}, bar.points}), Contains("has no tetrahedron"));
  const Vec1d::VecCoord fewer(3, Vec1d::Coord(0));
  CHECK_THAT(wrongBody(bar.context<Vec1d>(fewer)),
             Contains("3 values, but the body on which they lie has 16 points"));
  CHECK_THAT(error_of([&] { MeshMatrixMass<Vec1d>{}.init(bar.context<Vec1d>(fewer)); }),
             Contains("3 values"));
  CHECK_THAT(error_of([&] { DiagonalMass<Vec1d>{.totalMass = 1.0}.init(bar.context<Vec1d>(fewer)); }),
             Contains("3 values"));
  Bar flat = bar;
  for (auto& p : flat.points) p[2] = 0;
  CHECK_THAT(wrongBody(flat.context<Vec1d>(u)), Contains("tetrahedron 0 has no volume"));
  flat = bar;
  flat.tetrahedra[1][2] = 99;
  CHECK_THAT(wrongBody(flat.context<Vec1d>(u)), Contains("99"));

  // elements of a body do not go from under its temperatures
  Simulation sim{heat(bar, u, {.massDensity = {1.0}}, 1.0)};
  sim.init();
  CHECK_THAT(error_of([&] { sim.removeElements("mesh", {.tetrahedra = {0}}); }),
             Contains("values on the points of a body"));
}

}  // namespace test_tetrahedron_diffusion
