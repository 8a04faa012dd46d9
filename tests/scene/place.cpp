// SPDX-License-Identifier: BSL-1.0
// A typed scene with a place for what comes and goes.
#include "catch.hpp"

#include <sinew/registry.hpp>
#include <sinew/runtime/runtime.hpp>

namespace test_place {

using namespace sinew;

namespace {

struct Instruments
    : Registry<MechanicalObject<Vec3d>, MechanicalObject<Rigid3d>, UniformMass<Vec3d>, UniformMass<Rigid3d>,
               StiffSpringForceField<Vec3d>, RigidMapping<Rigid3d, Vec3d>, IdentityMapping<Vec3d, Vec3d>,
               ConstantForceField<Vec3d>> {};

template <class Linear>
auto simulator(Linear linear) {
  return Simulation{node<"root">(Gravity{{0, 0, 0}},
                                 EulerImplicitSolver{},
                                 linear,
                                 node<"organ">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}}},
                                               UniformMass<Vec3d>{},
                                               StiffSpringForceField<Vec3d>{{{.first = 0, .second = 1}}},
                                               RuntimePlace<"tools", Instruments>{}))};
}

// something mapped onto the typed state, that pulls at its second point
RuntimeNode<Instruments> hook() {
  RuntimeNode<Instruments> node("hook");
  node.add(MechanicalObject<Vec3d>{});
  node.add(IdentityMapping<Vec3d, Vec3d>{});
  node.add(ConstantForceField<Vec3d>{.indices = {1}, .forces = {{2, 0, 0}}});
  node.add(
      StiffSpringForceField<Vec3d>{.springs = {{.first = 0, .second = 1, .stiffness = 30, .length = 1}}});
  return node;
}

// the same composed by the compiler
template <class Linear>
auto fixed_simulator(Linear linear) {
  return Simulation{node<"root">(
      Gravity{{0, 0, 0}},
      EulerImplicitSolver{},
      linear,
      node<"organ">(
          MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}}},
          UniformMass<Vec3d>{},
          StiffSpringForceField<Vec3d>{{{.first = 0, .second = 1}}},
          node<"tools">(node<"hook">(
              MechanicalObject<Vec3d>{},
              IdentityMapping<Vec3d, Vec3d>{},
              ConstantForceField<Vec3d>{.indices = {1}, .forces = {{2, 0, 0}}},
              StiffSpringForceField<Vec3d>{{{.first = 0, .second = 1, .stiffness = 30, .length = 1}}}))))};
}

template <class Linear>
void compare(Linear linear) {
  auto sim = simulator(linear);
  sim.init();
  sim.change([](auto& root) { root.template child<"organ">().template child<"tools">().addChild(hook()); });
  auto fixed = fixed_simulator(linear);
  fixed.init();
  for (int i = 0; i < 100; ++i) sim.animate(0.01), fixed.animate(0.01);
  CHECK(sim.template at<"organ">().state().position == fixed.template at<"organ">().state().position);
  CHECK(sim.template at<"organ">().state().position[1].x() > 1.01);
  CHECK(
      sim.template at<"organ/tools">().find_node("hook")->template get<MechanicalObject<Vec3d>>()->position ==
      fixed.template at<"organ/tools/hook">().state().position);
}

}  // namespace

TEST_CASE("what hangs in the place of a typed scene acts as if it had been compiled in") {
  compare(CGLinearSolver<>{});
}

TEST_CASE("so it does in an assembled system, through a mapping onto the typed state") {
  compare(CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{});
}

TEST_CASE("a place is empty at first, and refuses what does not fit") {
  auto sim = simulator(CGLinearSolver<>{});
  sim.init();
  sim.animate(0.01);
  const auto before = sim.at<"organ">().state().position;
  CHECK_THROWS_WITH(
      sim.change([](auto& root) {
        root.template child<"organ">().template child<"tools">().addChild("bad").add(UniformMass<Rigid3d>{});
      }),
      Catch::Contains("has other DataTypes than the state on which it acts (Rigid3d on Vec3d)"));
  CHECK(sim.at<"organ">().state().position == before);
  CHECK(sim.at<"organ/tools">().children().empty());
  sim.animate(0.01);
}

}  // namespace test_place
