// SPDX-License-Identifier: BSL-1.0
#include "one_component.hpp"
#include "registry_scene.hpp"

#include <sinew/force/polynomial_springs.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/runge_kutta4.hpp>
#include <sinew/state/mechanical_object.hpp>

namespace test_polynomial_springs {

using namespace sinew;
using Eigen::Vector3d;
using one::force;
using one::ready;
using one::refuses;

namespace {

using Springs = PolynomialSpringsForceField<Vec3d>;
const Vec3d::VecCoord line{{0, 0, 0}, {2, 0, 0}, {2, 0.5, 0}};

Vec3d::VecCoord stretched(double factor) {
  Vec3d::VecCoord x = line;
  for (auto& p : x) p *= factor;
  return x;
}

}  // namespace

TEST_CASE("the force is a polynomial of the strain") {
  Springs cubic{.firstObjectPoints = {0},
                .secondObjectPoints = {1},
                .polynomialStiffness = {10, -4, 3},
                .polynomialDegree = {3}};
  auto pulling = ready(cubic, line);
  cubic.compressible = true;
  auto both = ready(cubic, line);
  for (const double e : {0.0, 0.1, 0.5, 2.0, -0.1, -0.7}) {
    const double a = std::abs(e), p = 10 * a - 4 * a * a + 3 * a * a * a,
                 energy = 2 * (5 * a * a - 4. / 3 * a * a * a + 0.75 * a * a * a * a);
    const auto x = stretched(1 + e);
    CHECK((force(both, x)[0] - Vector3d(e > 0 ? p : -p, 0, 0)).norm() < 1e-13);
    CHECK(potential_energy(both, x) == Approx(energy).margin(1e-15));
    CHECK((force(pulling, x)[0] - Vector3d(e > 0 ? p : 0, 0, 0)).norm() < 1e-13);
    CHECK((force(pulling, x)[0] + force(pulling, x)[1]).norm() == 0);
    CHECK(potential_energy(pulling, x) == Approx(e > 0 ? energy : 0).margin(1e-15));
  }
  for (auto const& f : force(both, stretched(0))) CHECK(f.norm() == 0);  // in one place, without direction
}

TEST_CASE("springs share one polynomial, or have their own one after the other") {
  Springs springs{.firstObjectPoints = {0, 1},
                  .secondObjectPoints = {1, 2},
                  .polynomialStiffness = {10, 100},
                  .polynomialDegree = {2}};
  const auto x = stretched(1.5);
  auto shared = ready(springs, line);
  const double p = 10 * 0.5 + 100 * 0.25;
  CHECK((force(shared, x)[0] - Vector3d(p, 0, 0)).norm() < 1e-12);
  CHECK((force(shared, x)[2] - Vector3d(0, -p, 0)).norm() < 1e-12);
  springs.polynomialDegree = {1, 2}, springs.polynomialStiffness = {7, 10, 100};
  auto own = ready(springs, line);
  CHECK((force(own, x)[0] - Vector3d(3.5, 0, 0)).norm() < 1e-12);
  CHECK((force(own, x)[2] - Vector3d(0, -p, 0)).norm() < 1e-12);
  // lengths that are given
  springs.computeZeroLength = false, springs.zeroLength = {1, 0.75};
  auto given = ready(springs, line);
  CHECK((force(given, x)[0] - Vector3d(14, 0, 0)).norm() < 1e-12);  // strain 2
  CHECK(force(given, x)[2].norm() == 0);                            // strain 0
}

TEST_CASE("two bodies on a spring swing against each other and keep their energy") {
  using Pair = PolynomialSpringsForceField<Vec3d, Between<"a", "b">>;
  RegistryScene sim{
      node<"root">(RungeKutta4Solver{},
                   node<"a">(MechanicalObject<Vec3d>{{{0, 0, 0}}}, UniformMass<Vec3d>{.vertexMass = 1}),
                   node<"b">(MechanicalObject<Vec3d>{{{1, 0, 0}}}, UniformMass<Vec3d>{.vertexMass = 3}),
                   Pair{.firstObjectPoints = {0},
                        .secondObjectPoints = {0},
                        .polynomialStiffness = {20, 0, 40},
                        .polynomialDegree = {3},
                        .compressible = true})};
  sim.init();
  sim.at<"a">().state().velocity[0] = {-1, 0.3, 0};
  const double energy = sim.kineticEnergy();
  double maximum = 0;
  for (int i = 0; i < 500; ++i) {
    sim.animate(0.005);
    maximum = std::max(maximum, sim.potentialEnergy());
    CHECK(sim.kineticEnergy() + sim.potentialEnergy() == Approx(energy).epsilon(1e-8));
  }
  CHECK(maximum > 0.3 * energy);
  // the centre of mass goes on
  const Vector3d middle = (sim.at<"a">().state().position[0] + 3 * sim.at<"b">().state().position[0]) / 4;
  CHECK((middle - Vector3d(0.75 - 2.5 / 4, 0.3 * 2.5 / 4, 0)).norm() < 1e-12);
}

TEST_CASE("polynomial springs that do not fit are refused") {
  const Springs good{.firstObjectPoints = {0, 1}, .secondObjectPoints = {1, 2}};
  auto with = [&](auto change, std::initializer_list<std::string_view> words) {
    Springs bad = good;
    change(bad);
    refuses(bad, line, {}, words);
  };
  CHECK(error_of([&] { ready(good, line); }).empty());
  with([](auto& s) { s.secondObjectPoints = {1}; },
       {"body", "PolynomialSpringsForceField<Vec3d>", "2 firstObjectPoints and 1 secondObjectPoints"});
  with([](auto& s) { s.firstObjectPoints = s.secondObjectPoints = {}; }, {"0 firstObjectPoints"});
  with([](auto& s) { s.secondObjectPoints[1] = 3; }, {"spring 1 joins point 1 of body and point 3 of body"});
  with([](auto& s) { s.firstObjectPoints[0] = 1; }, {"joins point 1 to itself"});
  with([](auto& s) { s.firstObjectPoints[0] = -1; }, {"firstObjectPoints[0] is -1"});
  with([](auto& s) { s.polynomialDegree = {1, 1, 1}; }, {"polynomialDegree has 3 values for 2 springs"});
  with([](auto& s) { s.polynomialDegree = {0}; }, {"polynomialDegree[0] is 0"});
  with([](auto& s) { s.polynomialDegree = {9}; }, {"polynomialDegree[0] is 9", "at most 8"});
  with([](auto& s) { s.polynomialDegree = {2, 3}; }, {"polynomialStiffness has 1 coefficients", "says 5"});
  with([](auto& s) { s.polynomialStiffness = {one::notANumber}; }, {"polynomialStiffness[0] is nan"});
  with([](auto& s) { s.computeZeroLength = false; }, {"zeroLength has 0 values for 2 springs"});
  with([](auto& s) { s.zeroLength = {0}; }, {"zeroLength[0] is 0 m"});
  auto same = line;
  same[2] = same[1];
  refuses(good, same, {}, {"spring 1 has no length at rest"});
}

}  // namespace test_polynomial_springs
