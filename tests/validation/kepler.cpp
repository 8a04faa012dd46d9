// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "record.hpp"

#include <sinew/sinew.hpp>
#include <sinew/solver/central_difference.hpp>
#include <sinew/solver/sparse_ldl_solver.hpp>
#include <sinew/solver/variational_symplectic.hpp>

#include <numbers>

namespace test_kepler {

using namespace sinew;

namespace {

/// A force of this test's own: the pull of the Sun at the origin on points of mass 1.
///   E = -k/r [J],   f = -k x/r^3 [N],   df/dx = -k (I/r^3 - 3 x x'/r^5)
struct CentralForce {
  using Role = role::ForceField;
  using DataTypes = Vec2d;
  static constexpr std::string_view className = "CentralForce";

  double strength = 1;

  static constexpr auto fields() {
    return field_list(
        field("strength", &CentralForce::strength, "N m^2", "force at a distance of 1 m", range::positive));
  }
  static constexpr ForceProperties properties() { return {.internal = false}; }

  std::vector<Eigen::Matrix2d> stiffness{};

  void init(InitContext<Vec2d> const& context) { stiffness.resize(context.rest.size()); }
  void addForce(MechanicalParams const&, Vec2d::VecDeriv& f, Vec2d::VecCoord const& x,
                Vec2d::VecDeriv const&) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double r = x[i].norm(), pull = strength / (r * r * r);
      f[i] -= pull * x[i];
      stiffness[i] = 3 * pull / (r * r) * x[i] * x[i].transpose() - pull * Eigen::Matrix2d::Identity();
    }
  }
  void addDForce(MechanicalParams const& p, Vec2d::VecDeriv& df, Vec2d::VecDeriv const& dx) const {
    for (std::size_t i = 0; i < dx.size(); ++i) df[i] += p.k * stiffness[i] * dx[i];
  }
  double potentialEnergy(Vec2d::VecCoord const& x) const {
    double energy = 0;
    for (auto const& p : x) energy -= strength / p.norm();
    return energy;
  }
  template <class Sink>
  void addToMatrix(MechanicalParams const& p, Sink const& sink) const {
    for (std::size_t i = 0; i < stiffness.size(); ++i)
      sink.add(int(i), int(i), Eigen::Matrix2d(p.k * stiffness[i]));
  }
};

// half the long axis is 1 and k = 1, so that a year is 2 pi; it starts far out, where it is slow
constexpr double year = 2 * std::numbers::pi, eccentricity = 0.3;

Eigen::Vector2d pull_at(Eigen::Vector2d const& x) { return -x / std::pow(x.norm(), 3); }

/// Energy, angular momentum, and the angle of the long axis: the direction of Laplace's vector.
struct Orbit {
  double energy, momentum, rotation;
};

template <class Solver>
class Planet {
 public:
  Planet(Solver const& solver, int stepsAYear)
      : h(year / stepsAYear),
        // central differences have the velocity of half a step before
        lag(std::is_same_v<Solver, CentralDifferenceSolver> ? h / 2 : 0),
        sim(scene(solver, lag)) {}

  void run(int steps) {
    for (int i = 0; i < steps; ++i) sim.animate(h);
  }
  Eigen::Vector2d position() { return sim.root().state().position[0]; }
  Orbit orbit() {
    const Eigen::Vector2d x = position(), v = sim.root().state().velocity[0] + lag * pull_at(x);
    const double momentum = x[0] * v[1] - x[1] * v[0];
    const Eigen::Vector2d laplace = momentum * Eigen::Vector2d(v[1], -v[0]) - x.normalized();
    return {v.squaredNorm() / 2 - 1 / x.norm(), momentum, std::atan2(-laplace[1], -laplace[0])};
  }
  /// The largest error of energy in a year.
  double yearsError() {
    double worst = 0;
    for (int i = 0; i < int(std::lround(year / h)); ++i) {
      run(1);
      worst = std::max(worst, std::abs(orbit().energy / -0.5 - 1));
    }
    return worst;
  }

 private:
  double h, lag;
  static auto scene(Solver const& solver, double lag) {
    const Eigen::Vector2d x(1 + eccentricity, 0), v(0, std::sqrt((1 - eccentricity) / (1 + eccentricity)));
    Simulation sim{node<"sun">(solver,
                               SparseLDLSolver<CompressedRowSparseMatrixd>{},
                               MechanicalObject<Vec2d>{.position = {x}, .velocity = {v - lag * pull_at(x)}},
                               UniformMass<Vec2d>{.vertexMass = 1},
                               CentralForce{})};
    sim.init();
    return sim;
  }
  decltype(scene(std::declval<Solver>(), 0.0)) sim;
};

const VariationalSymplecticSolver midpoint{.newtonError = 1e-13, .steps = 20};

}  // namespace

TEST_CASE("planets keep energy and angular momentum for 1,000 years under symplectic solvers", "[page]") {
  Record curve("kepler_energy", {"solver", "year", "error"}),
      table("kepler", {"solver", "years", "first", "last", "momentum", "turn"});
  auto measure = [&](std::string name, auto solver, int years = 1000) {
    // at 100 steps a year: 1e5 steps
    Planet planet(solver, 100);
    const Orbit start = planet.orbit();
    double first = 0, last = 0, momentum = 0;
    for (int y = 1; y <= years; ++y) {
      last = planet.yearsError();
      if (y == 1) first = last;
      momentum = std::max(momentum, std::abs(planet.orbit().momentum / start.momentum - 1));
      for (const double mark : {1., 2., 3., 5., 7.}) {
        const double tens = std::log10(y / mark);
        if (std::abs(tens - std::round(tens)) < 1e-12) curve.row(name, y, last);
      }
    }
    Planet other(solver, 100);
    other.run(1000);
    const double rotation = other.orbit().rotation * 180 / std::numbers::pi / 10;
    table.row(name, years, first, last, momentum, years < 100 ? "none" : text(rotation));
    return std::array{first, last, momentum};
  };
  // A symplectic method keeps an energy near the true one: what it errs swings with the year and does not
  // grow. Angular momentum is a quadratic invariant that all three keep, to the rounding of 1e5 steps.
  for (auto const& [first, last, momentum] : {measure("EulerExplicitSolver", EulerExplicitSolver{}),
                                              measure("CentralDifferenceSolver", CentralDifferenceSolver{}),
                                              measure("VariationalSymplecticSolver", midpoint)}) {
    CHECK(last < 1.2 * first);
    CHECK(momentum < 1e-9);
  }
  // the others lose or gain some each year
  const auto rk4 = measure("RungeKutta4Solver", RungeKutta4Solver{});
  CHECK(rk4[1] > 100 * rk4[0]);
  const auto rk2 = measure("RungeKutta2Solver", RungeKutta2Solver{}, 100);
  CHECK(rk2[1] > 10 * rk2[0]);
  const auto implicit = measure("EulerImplicitSolver", EulerImplicitSolver{}, 10);
  CHECK(implicit[1] > 0.5);
}

TEST_CASE("the error of a planet's energy has the order of the symplectic solver") {
  auto order = [](auto solver) {
    return std::log2(Planet(solver, 200).yearsError() / Planet(solver, 400).yearsError());
  };
  CHECK(order(EulerExplicitSolver{}) == Approx(1).margin(0.05));
  CHECK(order(CentralDifferenceSolver{}) == Approx(2).margin(0.05));
  CHECK(order(midpoint) == Approx(2).margin(0.05));
}

TEST_CASE("ellipses of symplectic solvers turn slowly, with the square of the step") {
  // a known property: the shape of the orbit is kept, its long axis and the place on it are not
  auto rotation = [](auto solver, int stepsAYear) {
    Planet planet(solver, stepsAYear);
    planet.run(10 * stepsAYear);
    return std::abs(planet.orbit().rotation);
  };
  CHECK(std::log2(rotation(CentralDifferenceSolver{}, 200) / rotation(CentralDifferenceSolver{}, 400)) ==
        Approx(2).margin(0.1));
  CHECK(std::log2(rotation(midpoint, 200) / rotation(midpoint, 400)) == Approx(2).margin(0.1));
}

TEST_CASE("orbits to look at, for the page", "[page]") {
  Record curve("kepler_orbits", {"solver", "x", "y"});
  const int steps = 60, years = Record::wanted() ? 10 : 1;
  auto draw = [&](std::string name, auto solver) {
    Planet planet(solver, steps);
    double farthest = 0;
    for (int i = 0; i <= steps * years; ++i) {
      curve.row(name, planet.position()[0], planet.position()[1]);
      farthest = std::max(farthest, planet.position().norm());
      planet.run(1);
    }
    return farthest;
  };
  CHECK(draw("VariationalSymplecticSolver", midpoint) < 1.31);
  CHECK(draw("CentralDifferenceSolver", CentralDifferenceSolver{}) < 1.31);
  CHECK(draw("EulerExplicitSolver", EulerExplicitSolver{}) < 1.4);
  draw("EulerExplicitSolver symplectic=0", EulerExplicitSolver{.symplectic = false});
  draw("EulerImplicitSolver", EulerImplicitSolver{});
}

}  // namespace test_kepler
