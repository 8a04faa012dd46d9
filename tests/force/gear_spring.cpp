// SPDX-License-Identifier: BSL-1.0
// Gears: forces from their energy, ratios and turns, bearings in a body and in the world, words of scene
// files.
#include "equilibrium.hpp"
#include "frames.hpp"

#include <sinew/force/gear_spring.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/runtime/value_text.hpp>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

namespace test_gear_spring {

using namespace sinew;
using Gears = GearSpringForceField<Rigid3d>;
using Eigen::Vector3d;
using frames::frame;

namespace {

const double pi = std::acos(-1.0);

/// A carrier, and gears 1 and 2 in it, which turn about its z.
GearSpring pair_of(double ratio) {
  return {.firstParent = 0,
          .first = 1,
          .secondParent = 0,
          .second = 2,
          .freeAxis = {2, 2},
          .stiffnessTranslation = 300,
          .stiffnessRotation = {40, 200},
          .damping = 0,
          .ratio = ratio};
}
const Rigid3d::VecCoord atOrigin(3, frame({0, 0, 0}));

Rigid3d::Coord moved(Rigid3d::Coord x, Rigid3d::Deriv const& by, double size) {
  Rigid3d::increment(x, Rigid3d::Deriv(size * by));
  return x;
}

}  // namespace

TEST_CASE("turned gears push each other by how far their teeth are apart") {
  for (const double ratio : {2.0, -1.5}) {
    auto gears = one::ready(Gears{.springs = {pair_of(ratio)}}, atOrigin);
    const double a = 0.3, b = -0.4, slip = ratio * a + b;
    const Rigid3d::VecCoord x{frame({0, 0, 0}), frame({0, 0, 0}, {0, 0, a}), frame({0, 0, 0}, {0, 0, b})};
    const auto f = one::force(gears, x);
    // as in SOFA for a ratio above 0
    const double first = -40 * slip * ratio / std::abs(ratio), second = -40 * slip / std::abs(ratio);
    CHECK(f[1].tail<3>().isApprox(Vector3d(0, 0, first)));
    CHECK(f[2].tail<3>().isApprox(Vector3d(0, 0, second)));
    CHECK(f[0].tail<3>().isApprox(Vector3d(0, 0, -first - second)));
    CHECK(potential_energy(gears, x) == Approx(40 / std::abs(ratio) / 2 * slip * slip));
    // and nothing where they have turned as their ratio says
    const auto none = one::force(
        gears, {frame({0, 0, 0}), frame({0, 0, 0}, {0, 0, a}), frame({0, 0, 0}, {0, 0, -ratio * a})});
    for (auto const& each : none) CHECK(each.norm() < 1e-13);
  }
}

TEST_CASE("bearings hold places and axes, and leave turns about the axes free") {
  GearSpring spring = pair_of(1);
  spring.stiffnessRotation[0] = 0;
  auto gears = one::ready(Gears{.springs = {spring}}, atOrigin);
  auto f = one::force(gears, {frame({0, 0, 0}), frame({0.1, 0, 0}, {0, 0, 2}), frame({0, 0, 0})});
  CHECK(f[1].head<3>().isApprox(Vector3d(-30, 0, 0)));
  CHECK(f[0] == -f[1]);
  CHECK(f[1].tail<3>().norm() < 1e-13);
  // a tilt by phi about x
  f = one::force(gears, {frame({0, 0, 0}), frame({0, 0, 0}), frame({0, 0, 0}, {0.7, 0, 0})});
  CHECK(f[2].tail<3>().isApprox(Vector3d(-200 * 0.7, 0, 0)));
  CHECK(f[0] == -f[2]);
  // damping of both
  spring.damping = 5;
  auto damped = one::ready(Gears{.springs = {spring}}, atOrigin);
  Rigid3d::VecDeriv v(3, Rigid3d::Deriv::Zero());
  v[1] = Rigid3d::Deriv::Ones();
  f = one::force(damped, atOrigin, v);
  CHECK(f[1].isApprox(-5 * v[1]));
  CHECK(f[0].isApprox(5 * v[1]));
  CHECK(one::product(damped, v, 0, 2)[1].isApprox(-10 * v[1]));
}

TEST_CASE("angles of gears count on from turn to turn, and are remembered and forgotten") {
  auto gears = one::ready(Gears{.springs = {pair_of(2)}}, atOrigin);
  Rigid3d::VecCoord x = atOrigin;
  double largest = 0;
  for (int n = 0; n <= 100; ++n) {
    const double a = 0.2 * n;
    x[1] = frame({0, 0, 0}, {0, 0, a}), x[2] = frame({0, 0, 0}, {0, 0, -2 * a});
    for (auto const& each : one::force(gears, x)) largest = std::max(largest, each.norm());
  }
  CHECK(largest < 1e-11);
  CHECK(gears.angles[0] == Approx(20));
  CHECK(gears.angles[1] == Approx(-40));
  // made anew it knows them
  gears.init(InitContext<Rigid3d>{"body", atOrigin, {}});
  for (auto const& each : one::force(gears, x)) CHECK(each.norm() < 1e-11);
  gears.reset();
  one::force(gears, x);
  CHECK(gears.angles[0] == Approx(std::remainder(20, 2 * pi)));
  CHECK(gears.angles[1] == Approx(std::remainder(-40, 2 * pi)));
}

TEST_CASE("forces of gears are those of their energy, and the tangent is symmetric and their derivative") {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  auto random = [&](double size) {
    Rigid3d::Deriv d;
    for (int i = 0; i < 6; ++i) d[i] = size * uniform(engine);
    return d;
  };
  GearSpring free = pair_of(-1.5), world = pair_of(0.7);
  world.firstParent = 1, world.secondParent = 1;  // the first gear bears the second
  auto gears = one::ready(Gears{.springs = {free, world}},
                          {frame({0, 0, 0}), frame({0.5, 0.2, 0}, {0.2, 0, 0}), frame({0, 1, 0})});
  Rigid3d::VecCoord x;
  for (int i = 0; i < 3; ++i) x.push_back(moved(frame({0, 0, 0}), random(0.6), 1));
  const auto f = one::force(gears, x);
  const Eigen::MatrixXd k = one::stiffness(gears, 3);
  CHECK((k - k.transpose()).norm() < 1e-9 * k.norm());
  // central differences: h^2 of third derivatives, and rounding over h
  const double h = 1e-5;
  for (int trial = 0; trial < 6; ++trial) {
    Rigid3d::VecDeriv d{random(1), random(1), random(1)};
    Rigid3d::VecCoord forth, back;
    double work = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      forth.push_back(moved(x[i], d[i], h)), back.push_back(moved(x[i], d[i], -h));
      work += f[i].dot(d[i]);
    }
    CHECK(-(potential_energy(gears, forth) - potential_energy(gears, back)) / (2 * h) ==
          Approx(work).epsilon(1e-6));
    // along a line of rotation vectors the second derivative of E is d' K d: torques times d do not rotate
    const double second =
        (potential_energy(gears, forth) - 2 * potential_energy(gears, x) + potential_energy(gears, back)) /
        (h * h);
    one::force(gears, x);
    const auto df = one::product(gears, d, 1, 0);
    double product = 0;
    for (std::size_t i = 0; i < 3; ++i) product += df[i].dot(d[i]);
    CHECK(-second == Approx(product).epsilon(1e-3));
  }
  // between bodies alone they sum to nothing, and so do their torques
  auto inner = one::ready(Gears{.springs = {free}}, atOrigin);
  Vector3d sum = Vector3d::Zero(), torque = Vector3d::Zero();
  const auto g = one::force(inner, x);
  for (std::size_t i = 0; i < 3; ++i) {
    sum += g[i].head<3>();
    torque += g[i].tail<3>() + x[i].center.cross(g[i].head<3>());
  }
  CHECK(sum.norm() < 1e-11);
  CHECK(torque.norm() < 1e-11);
}

TEST_CASE("a gear that is driven turns another one at their ratio, through many turns") {
  // torque 1 on the first of two gears of inertia 2, of which the second turns r times as fast: the
  // acceleration is 1/(2 + 2 r^2), the angle after the time t that times t^2/2
  for (const double ratio : {2.0, -0.5}) {
    GearSpring spring = pair_of(ratio);
    spring.firstParent = 0, spring.first = 0, spring.secondParent = 1, spring.second = 1;
    spring.stiffnessTranslation = 1e4, spring.stiffnessRotation = {1e5, 1e4};
    Simulation sim{node<"root">(
        EulerImplicitSolver{},
        CGLinearSolver<>{.iterations = 100, .tolerance = 1e-12},
        MechanicalObject<Rigid3d>{.position = {frame({0, 0, 0}), frame({2, 0, 0})}},
        UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{1, 2 * Eigen::Matrix3d::Identity()}},
        Gears{.springs = {spring}},
        ConstantForceField<Rigid3d>{.indices = {0},
                                    .forces = {(Rigid3d::Deriv() << 0, 0, 0, 0, 0, 1).finished()}})};
    sim.init();
    const double t = 20;
    for (int n = 0; n < 2000; ++n) sim.animate(0.01);
    auto const& angles = sim.root().template get<Gears>().angles;
    const double wanted = t * t / 2 / (2 + 2 * ratio * ratio);
    // implicit Euler is late by a step: t h/2 of t^2/2
    CHECK(angles[0] == Approx(wanted).epsilon(1e-3));
    CHECK(angles[1] == Approx(-ratio * wanted).epsilon(1e-3));
  }
}

TEST_CASE("gears of two states are those of one") {
  const Rigid3d::VecCoord a{frame({0, 0, 0}), frame({0.1, 0, 0}, {0.1, 0, 0.5})},
      b{frame({3, 0, 0}), frame({3, 0.2, 0}, {0, 0.2, -0.3})};
  Rigid3d::VecCoord all = a;
  all.insert(all.end(), b.begin(), b.end());
  GearSpring spring = pair_of(0.7), across = spring;
  spring.secondParent = 2, spring.second = 3;
  across.secondParent = 0, across.second = 1;
  auto gears = one::ready(Gears{.springs = {spring}}, all);
  using Between = GearSpringForceField<Rigid3d, sinew::Between<"a", "b">>;
  Between between{.springs = {across}};
  between.init({"a", a, {}}, {"b", b, {}});
  const Rigid3d::Deriv none = Rigid3d::Deriv::Zero();
  const Rigid3d::VecDeriv rest(2, none);
  Rigid3d::VecDeriv f0 = rest, f1 = rest, df0 = rest, df1 = rest;
  add_force(between, {}, f0, f1, a, b, rest, rest);
  const auto f = one::force(gears, all);
  CHECK(f0 == Rigid3d::VecDeriv{f[0], f[1]});
  CHECK(f1 == Rigid3d::VecDeriv{f[2], f[3]});
  CHECK(potential_energy(between, a, b) == potential_energy(gears, all));
  Rigid3d::VecDeriv dx(4, none);
  for (std::size_t i = 0; i < 4; ++i)
    for (int c = 0; c < 6; ++c) dx[i][c] = std::sin(double(i) + 3.0 * c);
  add_dforce(between, {.b = 2, .k = 3}, df0, df1, {dx[0], dx[1]}, {dx[2], dx[3]});
  const auto df = one::product(gears, dx, 3, 2);
  CHECK(df0 == Rigid3d::VecDeriv{df[0], df[1]});
  CHECK(df1 == Rigid3d::VecDeriv{df[2], df[3]});
}

TEST_CASE("gears are read as SOFA writes them, and checked") {
  std::vector<GearSpring> springs;
  read_value(
      "BEGIN_SPRING 4 0 6 2 AXIS 1 2 KS_T 2000000 KS_R 3 4 KD 1 RATIO -1.5385 END_SPRING\n"
      "BEGIN_SPRING 0 1 2 3 END_SPRING",
      springs);
  REQUIRE(springs.size() == 2);
  CHECK(springs[0].firstParent == 4);
  CHECK(springs[0].first == 0);
  CHECK(springs[0].secondParent == 6);
  CHECK(springs[0].second == 2);
  CHECK(springs[0].freeAxis == std::array{1, 2});
  CHECK(springs[0].stiffnessTranslation == 2e6);
  CHECK(springs[0].stiffnessRotation == std::array{3.0, 4.0});
  CHECK(springs[0].damping == 1);
  CHECK(springs[0].ratio == -1.5385);
  CHECK(springs[1].second == 3);
  const std::string written = write_value(springs);
  std::vector<GearSpring> again;
  read_value(written, again);
  CHECK(write_value(again) == written);
  one::says([&] { read_value("BEGIN_SPRING 0 1 2 3 KZ 3 END_SPRING", springs); },
            {"'KZ' is not one of AXIS"});

  auto refuses = [](GearSpring const& spring, std::initializer_list<std::string_view> words) {
    one::refuses(Gears{.springs = {spring}}, atOrigin, {}, words);
  };
  GearSpring bad = pair_of(0);
  refuses(bad, {"body", "GearSpringForceField<Rigid3d>", "springs[0] has a ratio of 0", "other than 0"});
  bad = pair_of(one::notANumber);
  refuses(bad, {"ratio", "nan"});
  bad = pair_of(1), bad.second = 7;
  refuses(bad, {"springs[0] refers to point 7", "3 points"});
  bad = pair_of(1), bad.second = 1;
  refuses(bad, {"joins gear 1 to itself"});
  bad = pair_of(1), bad.freeAxis = {0, 3};
  refuses(bad, {"freeAxis", "3", "at most 2"});
  bad = pair_of(1), bad.damping = -1;
  refuses(bad, {"damping", "-1"});
}

}  // namespace test_gear_spring
