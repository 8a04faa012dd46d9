// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"
#include "registry_scene.hpp"

#include <sinew/lagrangian.hpp>
#include <sinew/mechanics.hpp>

#include <cmath>

namespace test_fixed_lagrangian_constraint {

using namespace sinew;

namespace {

constexpr double dt = 0.01;
const BlockGaussSeidelConstraintSolver gaussSeidel{
    .maxIterations = 10000, .tolerance = 1e-14, .computeConstraintForces = true};

template <class D, class... C>
auto scene(bool velocityFirst, MechanicalObject<D> state, C... components) {
  return RegistryScene{
      node<"root">(FreeMotionAnimationLoop{.solveVelocityConstraintFirst = velocityFirst},
                   gaussSeidel,
                   node<"body">(EulerImplicitSolver{}, SparseLDLSolver<>{}, state, components...))};
}

}  // namespace

TEST_CASE("a rigid body off its rest pose is brought there, and held against forces and torques") {
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  for (const bool velocityFirst : {false, true}) {
    RigidCoord3<double> rest, start;
    Vector6 by, v, load;
    by << 0.1, -0.2, 0.3, 0.2, 0.1, -0.3;
    v << 1, 2, 3, -2, 1, 3;
    load << 1, 2, 3, 4, 5, 6;
    Rigid3d::increment(rest, 3 * by);
    start = rest;
    Rigid3d::increment(start, by);
    auto sim = scene<Rigid3d>(
        velocityFirst,
        {.position = {rest, start}, .velocity = {v, v}, .restPosition = {rest, rest}},
        UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{2, Eigen::Vector3d(1, 2, 2.5).asDiagonal()}},
        ConstantForceField<Rigid3d>{.indices = {1}, .force = {load}},
        FixedLagrangianConstraint<Rigid3d>{.indices = {1}});
    sim.init();
    sim.keepForces(true);
    auto body = sim.template at<"body">();
    for (int i = 0; i < 1000; ++i) {
      sim.animate(dt);
      if (i >= 6) CHECK(Rigid3d::difference(rest, body.state().position[1]).norm() < 1e-10);
    }
    CHECK(body.state().velocity[1].norm() < 1e-8);
    CHECK(Rigid3d::difference(rest, body.state().position[0]).norm() > 0.1);
    auto const& f = body.template get<FixedLagrangianConstraint<Rigid3d>>().multipliers;
    REQUIRE(f.size() == 6);
    for (int c = 0; c < 6; ++c) CHECK(f[std::size_t(c)] == Approx(-load[c]));
    auto const& all = sim.root().template get<BlockGaussSeidelConstraintSolver>().constraintForces;
    CHECK(all == f);
    CHECK((body.state().reaction[1] + load).norm() < 1e-8);
    CHECK(body.state().reaction[0].norm() < 1e-12);
  }
}

TEST_CASE("points in one, two and six dimensions stay at rest, all of them if wanted") {
  auto run = []<class D>(D, bool velocityFirst, bool all) {
    typename D::VecCoord x(3, D::zero());
    typename D::VecDeriv v(3, D::Deriv::Ones());
    for (std::size_t i = 0; i < 3; ++i)
      for (int c = 0; c < D::size; ++c) x[i][c] = double(i) + 0.1 * c;
    auto sim = scene<D>(velocityFirst,
                        {.position = x, .velocity = v},
                        UniformMass<D>{.vertexMass = 2},
                        FixedLagrangianConstraint<D>{.indices = {2}, .fixAll = all});
    sim.init();
    auto body = sim.template at<"body">();
    sim.animate(dt);
    auto const& f = body.template get<FixedLagrangianConstraint<D>>().multipliers;
    REQUIRE(f.size() == std::size_t(all ? 3 * D::size : D::size));
    for (const double one : f) CHECK(one == Approx(-2 / dt));  // it takes the momentum of the start
    for (int i = 0; i < 1000; ++i) sim.animate(dt);
    for (std::size_t i = 0; i < 3; ++i) {
      const bool held = all || i == 2;
      const auto moved = (body.state().position[i] - x[i]).eval();
      CHECK((held ? moved : (moved - 1001 * dt * v[i]).eval()).norm() < 1e-10);
    }
  };
  for (const bool velocityFirst : {false, true})
    for (const bool all : {false, true}) {
      run(Vec1d{}, velocityFirst, all);
      run(Vec2d{}, velocityFirst, all);
      run(Vec6d{}, velocityFirst, all);
    }
}

TEST_CASE("points that are not there, or that cannot move, are refused, and none is none") {
  auto says = [](FixedLagrangianConstraint<Vec3d> constraint, auto... more) {
    return error_of([&] {
      auto sim = scene<Vec3d>(false,
                              {.position = {{0, 0, 0}, {1, 0, 0}}},
                              UniformMass<Vec3d>{.vertexMass = 1},
                              more...,
                              constraint);
      sim.init();
      sim.animate(dt);
    });
  };
  CHECK_THAT(says({.indices = {2}}), Catch::Contains("indices has 2"));
  CHECK_THAT(says({.indices = {-1}}), Catch::Contains("indices"));
  CHECK_THAT(says({.indices = {1}}, FixedConstraint<Vec3d>{.indices = {1}}),
             Catch::Contains("FixedLagrangianConstraint"));
  CHECK(says({.indices = {0}}, FixedConstraint<Vec3d>{.indices = {1}}).empty());
  CHECK(says({}).empty());
  CHECK(says({.indices = {0}}, FixedLagrangianConstraint<Vec3d>{.indices = {0}}).empty());  // twice
}

TEST_CASE(
    "constraints and corrections of one state follow when elements are removed, as the free points do") {
  // two tetrahedra at a face whose points are held; the first point goes with the first of them
  RegistryScene sim{node<"root">(
      Gravity{{0, 0, -10}},
      FreeMotionAnimationLoop{},
      gaussSeidel,
      node<"body">(
          EulerExplicitSolver{},
          TetrahedronTopology{{{1, 2, 3, 0}, {1, 3, 2, 4}}},
          MechanicalObject<Vec3d>{.position = {{0, 0, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, -1}}},
          UniformMass<Vec3d>{.vertexMass = 1},
          FixedLagrangianConstraint<Vec3d>{.indices = {1, 2, 3}},
          UncoupledConstraintCorrection<Vec3d>{.compliance = {1, 2, 3, 4, 5}}))};
  sim.init();
  sim.animate(dt);
  sim.removeElements("body", {.tetrahedra = {0}});
  auto body = sim.at<"body">();
  CHECK(body.get<FixedLagrangianConstraint<Vec3d>>().indices == std::vector<int>{0, 1, 2});
  CHECK(body.get<UncoupledConstraintCorrection<Vec3d>>().compliance == std::vector<double>{2, 3, 4, 5});
  for (int i = 0; i < 10; ++i) sim.animate(dt);
  auto const& x = body.state().position;
  REQUIRE(x.size() == 4);
  for (std::size_t i = 0; i < 3; ++i) CHECK(x[i][2] == Approx(0).margin(1e-12));
  CHECK(body.state().velocity[3][2] == Approx(-10 * 11 * dt));
}

}  // namespace test_fixed_lagrangian_constraint
