// SPDX-License-Identifier: BSL-1.0
// Points of several bodies in one child.
#include "registry_scene.hpp"

#include <sinew/sinew.hpp>

#include "one_component.hpp"

namespace test_subset_multi_mapping {

using namespace sinew;
using one::says;

namespace {

using Siblings = Parents<"../left", "../right/corner">;
template <class P>
using Subset = SubsetMultiMapping<Vec3d, Vec3d, P>;

const EulerImplicitSolver implicitEuler{.rayleighStiffness = 0.02};

auto left() {
  return node<"left">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {0, 1, 0}}},
                      UniformMass<Vec3d>{.vertexMass = 0.4},
                      StiffSpringForceField<Vec3d>{{{0, 1, 50, 0.1, {}}}},
                      FixedConstraint<Vec3d>{.indices = {0}});
}
auto right() {
  return node<"right">(
      MechanicalObject<Rigid3d>{.position = {Rigid3d::Coord{.center = {2, 1, 0}}},
                                .velocity = {{0, 1, 0, 0, 0, 2}}},
      UniformMass<Rigid3d>{},
      node<"corner">(MechanicalObject<Vec3d>{{{-0.5, 0, 0}, {0, 0.5, 0.2}}}, RigidMapping<Rigid3d, Vec3d>{}));
}
// springs between points of both, as interactions
template <class... Solvers>
auto interacting(Solvers... solvers) {
  return RegistryScene{node<"root">(
      solvers...,
      StiffSpringForceField<Vec3d, Between<"left", "right/corner">>{{{1, 0, 30, 0.2, 1}, {1, 1, 30, 0.2, 1}}},
      left(),
      right())};
}
// the same in a child of both
template <class... Solvers>
auto mapped(Solvers... solvers) {
  return RegistryScene{
      node<"root">(solvers...,
                   left(),
                   right(),
                   node<"joined">(MechanicalObject<Vec3d>{},
                                  Subset<Siblings>{.indexPairs = {{1, 1}, {0, 1}, {1, 0}}},
                                  StiffSpringForceField<Vec3d>{{{1, 2, 30, 0.2, 1}, {1, 0, 30, 0.2, 1}}}))};
}

template <class... Solvers>
void compare(double dt, double tolerance, Solvers... solvers) {
  auto a = interacting(solvers...);
  auto b = mapped(solvers...);
  a.init();
  b.init();
  CHECK(a.potentialEnergy() == Approx(b.potentialEnergy()).epsilon(1e-14));
  for (int i = 0; i < 100; ++i) a.animate(dt), b.animate(dt);
  auto const &l = a.template at<"left">().state().position[1],
             &m = b.template at<"left">().state().position[1];
  auto const &r = a.template at<"right">().state().position[0],
             &s = b.template at<"right">().state().position[0];
  CHECK((l - m).norm() < tolerance);
  CHECK(Rigid3d::difference(r, s).norm() < tolerance);
  CHECK((l - Eigen::Vector3d(0, 1, 0)).norm() > 0.05);
  auto const& joined = b.template at<"joined">().state();
  CHECK(joined.position[1] == m);
  CHECK(joined.position[0] == b.template at<"right/corner">().state().position[1]);
  CHECK(joined.velocity[2] == b.template at<"right/corner">().state().velocity[0]);
}

template <class L>
L exact(L linear) {
  linear.iterations = 200, linear.tolerance = 1e-15;
  return linear;
}

}  // namespace

// 100 steps of motion of order 1, each solved to 1e-15 of its right-hand side

TEST_CASE("springs in a child of two bodies are springs between them: explicit") {
  compare(0.005, 1e-12, EulerExplicitSolver{});
}
TEST_CASE("springs in a child of two bodies are springs between them: implicit, matrix-free") {
  compare(0.02, 1e-11, implicitEuler, exact(CGLinearSolver<>{}));
}
TEST_CASE("springs in a child of two bodies are springs between them: implicit, assembled") {
  compare(0.02, 1e-11, implicitEuler, exact(CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{}));
  compare(0.02, 1e-11, implicitEuler, exact(CGLinearSolver<CompressedRowSparseMatrixd>{}));
}

TEST_CASE("a child of children: the way up is the way down reversed") {
  // force on a child of points that are mapped themselves, beside the node that carries them: all of it
  // arrives
  RegistryScene sim{node<"root">(
      Gravity{{0, 0, 0}},
      EulerExplicitSolver{},
      MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}}},
      UniformMass<Vec3d>{.vertexMass = 1},
      node<"a">(MechanicalObject<Vec3d>{}, IdentityMapping<Vec3d, Vec3d>{}),
      node<"b">(MechanicalObject<Vec3d>{},
                SubsetMapping<Vec3d, Vec3d>{.indices = {1}},
                node<"c">(MechanicalObject<Vec3d>{}, IdentityMapping<Vec3d, Vec3d>{})),
      node<"d">(node<"e">(
          MechanicalObject<Vec3d>{},
          Subset<Parents<"../../a", "../../b/c", "../..">>{.indexPairs = {{0, 0}, {1, 0}, {2, 0}}},
          ConstantForceField<Vec3d>{.indices = {0, 1, 2}, .forces = {{1, 0, 0}, {0, 2, 0}, {0, 0, 4}}},
          node<"f">(MechanicalObject<Vec3d>{},
                    Subset<Parents<"..", "../../../b">>{.indexPairs = {{0, 1}, {1, 0}}},
                    ConstantForceField<Vec3d>{.indices = {0, 1}, .forces = {{8, 0, 0}, {0, 0, 16}}}))))};
  sim.init();
  CHECK(sim.at<"d/e/f">().state().position[0] == Eigen::Vector3d(1, 0, 0));
  sim.animate(1);
  CHECK(sim.root().state().velocity[0] == Eigen::Vector3d(1, 0, 4));
  CHECK(sim.root().state().velocity[1] == Eigen::Vector3d(8, 2, 16));
  CHECK(sim.at<"d/e/f">().state().velocity[1] == Eigen::Vector3d(8, 2, 16));
}

TEST_CASE("centres of rigid bodies and their frames in one child") {
  auto body = [](double x) {
    Rigid3d::Coord c{.center = {x, 0, 0}};
    Rigid3d::increment(c, (Rigid3d::Deriv() << 0, 0, 0, 0, 0, x).finished());
    return MechanicalObject<Rigid3d>{.position = {c}, .velocity = {{0, x, 0, 0, 0, 1}}};
  };
  RegistryScene sim{node<"root">(
      Gravity{{0, 0, 0}},
      EulerExplicitSolver{},
      node<"a">(body(1), UniformMass<Rigid3d>{}),
      node<"b">(body(2), UniformMass<Rigid3d>{}),
      node<"centers">(
          MechanicalObject<Vec3d>{},
          SubsetMultiMapping<Rigid3d, Vec3d, Parents<"../a", "../b">>{.indexPairs = {{1, 0}, {0, 0}}},
          ConstantForceField<Vec3d>{.indices = {0}, .forces = {{3, 0, 0}}}),
      node<"frames">(MechanicalObject<Rigid3d>{},
                     SubsetMultiMapping<Rigid3d, Rigid3d, Parents<"../a", "../b">>{.indexPairs = {{1, 0}}}))};
  sim.init();
  sim.animate(0.1);
  CHECK((sim.at<"b">().state().velocity[0].head<3>() - Eigen::Vector3d(0.3, 2, 0)).norm() < 1e-14);
  CHECK(sim.at<"centers">().state().position[1] == sim.at<"a">().state().position[0].center);
  CHECK(sim.at<"frames">().state().position[0] == sim.at<"b">().state().position[0]);
}

TEST_CASE("a surface over points of two bodies") {
  Mesh triangle;
  triangle.positions.assign(3, Eigen::Vector3d::Zero());
  triangle.triangles = {{0, 1, 2}};
  auto body = [](double x) {
    return MechanicalObject<Vec3d>{.position = {{x, 0, 0}}, .velocity = {{0, x, 0}}};
  };
  RegistryScene sim{node<"root">(Gravity{{0, 0, 0}},
                                 node<"a">(EulerExplicitSolver{}, body(1), UniformMass<Vec3d>{}),
                                 node<"b">(EulerExplicitSolver{}, body(2), UniformMass<Vec3d>{}),
                                 node<"look">(VisualModel{triangle},
                                              SubsetMultiMapping<Vec3d, Vec3f, Parents<"../a", "../b">>{
                                                  .indexPairs = {{0, 0}, {1, 0}, {0, 0}}}))};
  sim.init();
  sim.animate(0.5);
  auto const& x = sim.at<"look">().visual().position;
  CHECK(x[0] == Eigen::Vector3f(1, 0.5f, 0));
  CHECK(x[1] == Eigen::Vector3f(2, 1, 0));
}

TEST_CASE("bad indexPairs are named") {
  auto with = [](std::vector<std::array<int, 2>> pairs, MechanicalObject<Vec3d> child = {}) {
    return [=] {
      RegistryScene sim{
          node<"root">(EulerExplicitSolver{},
                       node<"a">(MechanicalObject<Vec3d>{{{0, 0, 0}, {1, 0, 0}}}, UniformMass<Vec3d>{}),
                       node<"b">(MechanicalObject<Vec3d>{{{0, 0, 0}}}, UniformMass<Vec3d>{}),
                       node<"sub">(child, Subset<Parents<"../a", "../b">>{.indexPairs = pairs}))};
      sim.init();
    };
  };
  CHECK(error_of(with({{0, 1}, {1, 0}})).empty());
  says(with({{2, 0}}), {"/root/sub", "indexPairs[0] names parent 2", "there are 2"});
  says(with({{0, 0}, {1, 1}}), {"indexPairs[1] names point 1 of /root/b", "1 points"});
  says(with({{0, -1}}), {"indexPairs[0][1] is -1", "at least 0"});
  says(with({{0, 1}}, {.position = {{0, 0, 0}, {1, 1, 1}}}), {"2 points for 1 indexPairs"});
}

}  // namespace test_subset_multi_mapping
