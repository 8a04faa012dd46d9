// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/runtime/runtime.hpp>

using namespace sinew;

using Few =
    Registry<Gravity, EulerExplicitSolver, EulerImplicitSolver, CGLinearSolver<>, MechanicalObject<Vec3d>,
             UniformMass<Vec3d>, StiffSpringForceField<Vec3d>, StiffSpringForceField<Vec3d, Linked>,
             FixedConstraint<Vec3d>, MechanicalObject<Rigid3d>, UniformMass<Rigid3d>,
             RigidMapping<Rigid3d, Vec3d>, CGLinearSolver<CompressedRowSparseMatrixMat3x3d>>;

TEST_CASE("a runtime tree") {
  RuntimeNode<Few> root;
  root.add(Gravity{});
  root.add(EulerImplicitSolver{});
  root.add(CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{});
  auto& body = root.addChild("body");
  body.add(MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}}});
  body.add(UniformMass<Vec3d>{});
  body.add(StiffSpringForceField<Vec3d>{.springs = {{.first = 0, .second = 1}}});
  body.add(FixedConstraint<Vec3d>{.indices = {0}});
  Simulation sim{std::move(root)};
  sim.init();
  sim.animate(0.01);
  CHECK(sim.root().find_node("body")->get<MechanicalObject<Vec3d>>()->position[1].y() < 0);
}
