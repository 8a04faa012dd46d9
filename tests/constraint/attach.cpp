// SPDX-License-Identifier: BSL-1.0
// Two bodies whose points are attached to each other.
#include "registry_scene.hpp"

#include <sinew/sinew.hpp>
#include <sinew/topology/regular_grid.hpp>

#include "one_component.hpp"

namespace test_attach {

using namespace sinew;
using one::says;

namespace {

template <class E>
using Attach = AttachProjectiveConstraint<Vec3d, E>;
using Points = Vec3d::VecCoord;

// a bar of 4 x 2 x 2 cells; or its halves, whose faces at x = 2 are points of both
const Mesh whole = regular_grid_tetrahedra(5, 3, 3, {0, 0, 0}, {4, 2, 2});

struct Halves {
  Mesh mesh[2];
  std::vector<int> own[2];  // point of the whole that each point is
  std::vector<int> face[2];

  Halves() {
    std::vector<int> place[2];
    for (int h = 0; h < 2; ++h) place[h].assign(whole.positions.size(), -1);
    for (auto const& t : whole.tetrahedra) {
      double x = 0;
      for (const int i : t) x += whole.positions[std::size_t(i)].x() / 4;
      const int h = x > 2;
      Tetrahedron e;
      for (std::size_t k = 0; k < 4; ++k) {
        int& at = place[h][std::size_t(t[k])];
        if (at < 0) {
          at = int(own[h].size());
          own[h].push_back(t[k]);
          mesh[h].positions.push_back(whole.positions[std::size_t(t[k])]);
        }
        e[k] = at;
      }
      mesh[h].tetrahedra.push_back(e);
    }
    for (std::size_t i = 0; i < whole.positions.size(); ++i)
      if (place[0][i] >= 0 && place[1][i] >= 0)
        for (int h = 0; h < 2; ++h) face[h].push_back(place[h][i]);
  }
};

Points thrown(Points x) {
  for (auto& v : x) v = {0.3 * v.y(), -0.2 * v.x(), 0.5 * v.x() - 0.1 * v.z()};
  return x;
}

template <class... Solvers>
auto together(Solvers... solvers) {
  return RegistryScene{node<"root">(
      Gravity{{0, 0, 0}},
      solvers...,
      node<"body">(TetrahedronTopology{whole.tetrahedra},
                   MechanicalObject<Vec3d>{.position = whole.positions, .velocity = thrown(whole.positions)},
                   DiagonalMass<Vec3d>{.massDensity = 1},
                   TetrahedronFEMForceField<Vec3d>{.youngModulus = {300}, .poissonRatio = 0.3}))};
}
template <FixedString Name>
auto half(Mesh const& mesh) {
  return node<Name>(TetrahedronTopology{mesh.tetrahedra},
                    MechanicalObject<Vec3d>{.position = mesh.positions, .velocity = thrown(mesh.positions)},
                    DiagonalMass<Vec3d>{.massDensity = 1},
                    TetrahedronFEMForceField<Vec3d>{.youngModulus = {300}, .poissonRatio = 0.3});
}
template <class... Solvers>
auto attached(Halves const& halves, bool twoWay, Solvers... solvers) {
  return RegistryScene{node<"root">(
      Gravity{{0, 0, 0}},
      solvers...,
      Attach<Between<"a", "b">>{.indices1 = halves.face[0], .indices2 = halves.face[1], .twoWay = twoWay},
      half<"a">(halves.mesh[0]),
      half<"b">(halves.mesh[1]))};
}

// greatest distance between points of the halves and of the whole
template <class One, class Two>
double apart(Halves const& halves, One& one, Two& two) {
  auto const& x = one.template at<"body">().state().position;
  double worst = 0;
  auto compare = [&](int h, Points const& own) {
    for (std::size_t i = 0; i < own.size(); ++i)
      worst = std::max(worst, (own[i] - x[std::size_t(halves.own[h][i])]).norm());
  };
  compare(0, two.template at<"a">().state().position);
  compare(1, two.template at<"b">().state().position);
  return worst;
}

Eigen::Vector3d momentum(Points const& v, auto const& mass) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < v.size(); ++i) sum += mass.lumped.mass[i] * v[i];
  return sum;
}
template <class Sim>
Eigen::Vector3d momentum(Sim& sim) {
  auto of = [](auto&& node) {
    return momentum(node.state().velocity, node.template get<DiagonalMass<Vec3d>>());
  };
  return of(sim.template at<"a">()) + of(sim.template at<"b">());
}

template <class... Solvers>
void check_as_one(double dt, double tolerance, Solvers... solvers) {
  const Halves halves;
  REQUIRE(halves.face[0].size() == 9);
  auto one = together(solvers...);
  auto two = attached(halves, true, solvers...);
  one.init();
  two.init();
  const Eigen::Vector3d before = momentum(two);
  CHECK(before.norm() > 1);
  for (int i = 0; i < 50; ++i) one.animate(dt), two.animate(dt);
  CHECK(apart(halves, one, two) < tolerance);
  CHECK((one.template at<"body">().state().position[44] - whole.positions[44]).norm() > 10 * dt);
  CHECK((momentum(two) - before).norm() < tolerance);
}

template <class L>
L exact(L linear) {
  linear.iterations = 500, linear.tolerance = 1e-14;
  return linear;
}

}  // namespace

// 50 solves, each good to 1e-14 of its right-hand side, of motion of the order 1

TEST_CASE("bodies attached both ways move as one body: implicit, matrix-free") {
  check_as_one(0.02, 1e-10, EulerImplicitSolver{.rayleighStiffness = 0.01}, exact(CGLinearSolver<>{}));
}
TEST_CASE("bodies attached both ways move as one body: implicit, assembled") {
  const EulerImplicitSolver ode{.rayleighStiffness = 0.01};
  check_as_one(0.02, 1e-10, ode, exact(CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{}));
  check_as_one(0.02, 1e-10, ode, SparseLDLSolver<CompressedRowSparseMatrixMat3x3d>{});
}
TEST_CASE("bodies attached both ways move as one body: explicit, where masses of the halves differ") {
  check_as_one(0.002, 1e-11, EulerExplicitSolver{});
  check_as_one(0.002, 1e-11, RungeKutta4Solver{});
}

TEST_CASE("one way, the second follows the first, which does not feel it") {
  const Halves halves;
  const auto ode = EulerImplicitSolver{.rayleighStiffness = 0.01};
  const auto linear = exact(CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{});
  auto two = attached(halves, false, ode, linear);
  RegistryScene alone{node<"root">(Gravity{{0, 0, 0}}, ode, linear, half<"a">(halves.mesh[0]))};
  two.init();
  alone.init();
  for (int i = 0; i < 50; ++i) two.animate(0.02), alone.animate(0.02);
  auto const &a = two.at<"a">().state(), &b = two.at<"b">().state();
  CHECK((vec::flat(a.position) - vec::flat(alone.at<"a">().state().position)).norm() < 1e-10);
  for (std::size_t k = 0; k < 9; ++k) {
    CHECK(b.position[std::size_t(halves.face[1][k])] == a.position[std::size_t(halves.face[0][k])]);
    CHECK(b.velocity[std::size_t(halves.face[1][k])] == a.velocity[std::size_t(halves.face[0][k])]);
  }
  CHECK(vec::flat(b.position).allFinite());
}

TEST_CASE("points of one body that are attached, three to one, and what a jump leaves") {
  // masses 1, 2, 3, 6: the common velocity is the mean by mass
  RegistryScene sim{node<"root">(
      Gravity{{0, 0, 0}},
      EulerExplicitSolver{},
      MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {5, 0, 0}},
                              .velocity = {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {7, 0, 0}}},
      DiagonalMass<Vec3d>{.vertexMass = {1, 2, 3, 6}},
      AttachProjectiveConstraint<Vec3d>{
          .indices1 = {0, 1, 3}, .indices2 = {1, 2, 0}, .twoWay = true, .constraintFactor = {1, 1, 0}})};
  sim.init();
  auto const& s = sim.root().state();
  for (std::size_t i = 0; i < 3; ++i) CHECK(s.velocity[i].x() == Approx(14.0 / 6).epsilon(1e-15));
  CHECK(s.velocity[3].x() == 7);
  sim.animate(0.5);
  for (std::size_t i = 0; i < 3; ++i) CHECK(s.position[i].x() == Approx(7.0 / 6).epsilon(1e-14));
}

TEST_CASE("rigid bodies: as one, and with a joint") {
  using B = Rigid3d::Coord;
  auto sim = [](bool freeRotations) {
    auto body = [](double spin) {
      return MechanicalObject<Rigid3d>{.position = {B{}}, .velocity = {{0, 0, 0, 0, 0, spin}}};
    };
    return RegistryScene{node<"root">(
        Gravity{{0, -1, 0}},
        EulerImplicitSolver{},
        SparseLDLSolver<CompressedRowSparseMatrixd>{},
        AttachProjectiveConstraint<Rigid3d, Between<"a", "b">>{
            .indices1 = {0}, .indices2 = {0}, .twoWay = true, .freeRotations = freeRotations},
        node<"a">(
            body(1), UniformMass<Rigid3d>{}, ConstantForceField<Rigid3d>{.forces = {{4, 0, 0, 0, 0, 0}}}),
        node<"b">(body(3), UniformMass<Rigid3d>{}))};
  };
  auto joined = sim(false), joint = sim(true);
  joined.init();
  joint.init();
  for (int i = 0; i < 10; ++i) joined.animate(0.1), joint.animate(0.1);
  for (auto* s : {&joined, &joint}) {
    auto const &a = s->at<"a">().state(), &b = s->at<"b">().state();
    CHECK((a.position[0].center - b.position[0].center).norm() < 1e-14);
    CHECK((a.velocity[0].head<3>() - Eigen::Vector3d(2, -1, 0)).norm() < 1e-13);
  }
  CHECK(joined.at<"a">().state().velocity[0][5] == Approx(2));
  CHECK(joined.at<"a">().state().position[0].orientation.coeffs() ==
        joined.at<"b">().state().position[0].orientation.coeffs());
  CHECK(joint.at<"a">().state().velocity[0][5] == Approx(1));
  CHECK(joint.at<"b">().state().velocity[0][5] == Approx(3));
}

TEST_CASE("bad input of attachments is named") {
  auto with = [](Attach<Between<"a", "b">> attach) {
    return [=] {
      RegistryScene sim{node<"root">(
          EulerExplicitSolver{},
          attach,
          node<"a">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}}}, UniformMass<Vec3d>{}),
          node<"b">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}}}, UniformMass<Vec3d>{}))};
      sim.init();
    };
  };
  CHECK(error_of(with({.indices1 = {1}, .indices2 = {0}})).empty());
  says(with({.indices1 = {0, 1}, .indices2 = {0}}), {"/root/a", "indices1 has 2 points and indices2 1"});
  says(with({.indices1 = {2}, .indices2 = {0}}), {"indices1 has 2", "/root/a has 2 points"});
  says(with({.indices1 = {0}, .indices2 = {1}}), {"indices2 has 1", "/root/b has 1 points"});
  says(with({.indices1 = {-1}, .indices2 = {0}}), {"indices1[0] is -1"});
  says(with({.indices1 = {0, 1}, .indices2 = {0, 0}}), {"point 0 is attached twice", "twoWay"});
  says(with({.indices1 = {0}, .indices2 = {0}, .constraintFactor = {0.5}}),
       {"constraintFactor[0] is 0.5", "1 or 0"});
  says(with({.indices1 = {0}, .indices2 = {0}, .constraintFactor = {2}}),
       {"constraintFactor[0] is 2", "at most 1"});
  says(with({.indices1 = {0}, .indices2 = {0}, .constraintFactor = {1, 1}}), {"constraintFactor 2 entries"});
  const Points two{{0, 0, 0}, {1, 0, 0}};
  one::refuses(AttachProjectiveConstraint<Vec3d>{.indices1 = {1}, .indices2 = {1}},
               two,
               {},
               {"point 1 is attached to itself"});
  one::refuses(AttachProjectiveConstraint<Vec3d>{.indices1 = {0, 1}, .indices2 = {1, 0}},
               two,
               {},
               {"point 0 is attached twice"});
}

}  // namespace test_attach
