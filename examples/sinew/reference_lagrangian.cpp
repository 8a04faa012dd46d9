// SPDX-License-Identifier: BSL-1.0
#include "reference_examples.hpp"

namespace cli {

namespace {

constexpr auto examples = std::to_array<ClassExample>({
    {"FreeMotionAnimationLoop", "", multipliers, ""},
    {"FixedLagrangianConstraint", "", multipliers, ""},
    {"BilateralLagrangianConstraint", R"(
<Node name="root" gravity="0 -9.81 0">
  <FreeMotionAnimationLoop/>
  <BlockGaussSeidelConstraintSolver maxIterations="1000" tolerance="1e-8"/>
  <BilateralLagrangianConstraint object1="@arm" object2="@weight" first_point="2" second_point="0"/>
  <Node name="arm">
    <EulerImplicitSolver/>
    <SparseLDLSolver/>
    <MechanicalObject position="0 0 0  0.5 0 0  1 0 0"/>
    <UniformMass vertexMass="0.1"/>
    <StiffSpringForceField spring="0 1 100 0.1 0.5  1 2 100 0.1 0.5"/>
    <FixedConstraint indices="0"/>
  </Node>
  <Node name="weight">
    <EulerExplicitSolver/>
    <MechanicalObject position="1 0 0"/>
    <UniformMass vertexMass="0.1"/>
  </Node>
</Node>)"},
    {"SlidingLagrangianConstraint",
     R"(
<FixedConstraint indices="0 2"/>
<SlidingLagrangianConstraint sliding_point="1" axis_1="0" axis_2="2"/>)",
     R"(
<Node name="root" gravity="0 -9.81 0">
  <FreeMotionAnimationLoop/>
  <BlockGaussSeidelConstraintSolver maxIterations="1000" tolerance="1e-8"/>
  <Node name="bead">
    <EulerImplicitSolver/>
    <SparseLDLSolver/>
    <MechanicalObject position="0 0 0  0.5 -0.1 0  1 -0.2 0"/>
    <UniformMass vertexMass="0.1"/>
    <HERE/>
  </Node>
</Node>)",
     "HERE"},
    {"UnilateralLagrangianConstraint",
     R"(
<UnilateralLagrangianConstraint first_point="0" second_point="1" normal="0 1 0" contactDistance="0.05" mu="0.5"/>)",
     R"(
<Node name="root" gravity="0 -9.81 0">
  <FreeMotionAnimationLoop/>
  <BlockGaussSeidelConstraintSolver maxIterations="1000" tolerance="1e-8"/>
  <Node name="points">
    <EulerImplicitSolver/>
    <SparseLDLSolver/>
    <MechanicalObject position="0 0 0  0 0.1 0"/>
    <UniformMass vertexMass="0.1"/>
    <FixedConstraint indices="0"/>
    <HERE/>
  </Node>
</Node>)",
     "HERE"},
    {"AugmentedLagrangianConstraint",
     R"(
<AugmentedLagrangianConstraint first_point="0" second_point="1" normal="0 1 0" contactDistance="0.05" mu="0.5"/>)",
     R"(
<Node name="root" gravity="0 -9.81 0">
  <FreeMotionAnimationLoop/>
  <BlockGaussSeidelConstraintSolver maxIterations="1000" tolerance="1e-8"/>
  <Node name="points">
    <EulerImplicitSolver/>
    <SparseLDLSolver/>
    <MechanicalObject position="0 0 0  0 0.1 0"/>
    <UniformMass vertexMass="0.1"/>
    <FixedConstraint indices="0"/>
    <HERE/>
  </Node>
</Node>)",
     "HERE"},
    {"UniformLagrangianConstraint", R"(
<Node name="root" gravity="0 -9.81 0">
  <FreeMotionAnimationLoop/>
  <BlockGaussSeidelConstraintSolver maxIterations="1000" tolerance="1e-8"/>
  <Node name="rope">
    <EulerImplicitSolver/>
    <SparseLDLSolver/>
    <MechanicalObject position="0 0 0  0.5 0 0  1 0 0"/>
    <UniformMass vertexMass="0.1"/>
    <FixedLagrangianConstraint indices="0"/>
    <Node name="lengths">
      <MeshTopology edges="0 1  1 2"/>
      <MechanicalObject template="Vec1d"/>
      <DistanceMapping/>
      <UniformLagrangianConstraint constrainToRestPos="true"/>
    </Node>
  </Node>
</Node>)"},
    {"StopperLagrangianConstraint", R"(
<Node name="root">
  <FreeMotionAnimationLoop/>
  <BlockGaussSeidelConstraintSolver maxIterations="1000" tolerance="1e-8"/>
  <Node name="hinge">
    <EulerImplicitSolver/>
    <SparseLDLSolver template="CompressedRowSparseMatrixd"/>
    <MechanicalObject template="Vec1d" position="0" velocity="2"/>
    <UniformMass vertexMass="0.1"/>
    <StopperLagrangianConstraint index="0" min="-0.5" max="0.5"/>
  </Node>
</Node>)"},
    {"BlockGaussSeidelConstraintSolver", "", friction, ""},
    {"LCPConstraintSolver", R"(<LCPConstraintSolver mu="0.5" tolerance="1e-8"/>)"},
    {"ConvexConstraintSolver", R"(<ConvexConstraintSolver tolerance="1e-7"/>)"},
    {"PreconditionedConjugateResidual",
     R"(<PreconditionedConjugateResidual tolerance="1e-8"/>)",
     multipliers,
     "BlockGaussSeidelConstraintSolver"},
    {"UncoupledConstraintCorrection",
     R"(<UncoupledConstraintCorrection/>)",
     friction,
     "SparseLDLSolver",
     Place::beside},
});

}  // namespace

std::span<ClassExample const> examples_of_lagrangian() { return examples; }

}  // namespace cli
