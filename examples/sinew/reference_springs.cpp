// SPDX-License-Identifier: BSL-1.0
#include "reference_examples.hpp"

namespace cli {

namespace {

constexpr auto examples = std::to_array<ClassExample>({
    {"AngularSpringForceField", R"(
<Node name="shaft">
  <EulerImplicitSolver/>
  <SparseLDLSolver template="CompressedRowSparseMatrixd"/>
  <MechanicalObject template="Rigid3d" position="0 0 0  0 0 0 1   0.2 0 0  0 0 0 1   0.4 0 0  0 0 0 1"
                    velocity="0 0 0  10 0 0   0 0 0  0 0 0   0 0 0  0 0 0"/>
  <UniformMass vertexMass="1 1  0.02 0 0  0 0.01 0  0 0 0.01"/>
  <AngularSpringForceField indices="0 1 2" angularStiffness="5"/>
</Node>)"},
    {"FastTriangularBendingSprings",
     R"(<FastTriangularBendingSprings bendingStiffness="0.02"/>)",
     sheet,
     "TriangleFEMForceField",
     Place::beside},
    {"FrameSpringForceField", R"(
<Node name="links" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <SparseLDLSolver template="CompressedRowSparseMatrixd"/>
  <MechanicalObject template="Rigid3d" position="0.5 0 0  0 0 0 1   1.5 0 0  0 0 0 1"/>
  <UniformMass vertexMass="1 1  0.01 0 0  0 0.1 0  0 0 0.1"/>
  <FixedConstraint indices="0"/>
  <FrameSpringForceField spring="BEGIN_SPRING 0 1 KS_T 20000 KS_R 200 KD 1 VEC1 0.5 0 0 VEC2 -0.5 0 0 END_SPRING"/>
</Node>)"},
    {"GearSpringForceField", R"(
<Node name="gears" gravity="0 0 0">
  <EulerImplicitSolver/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <MechanicalObject template="Rigid3d" position="0 0 0  0 0 0 1   3 0 0  0 0 0 1" velocity="0 0 0  0 0 2   0 0 0  0 0 0"/>
  <UniformMass vertexMass="1 1  0.1 0 0  0 0.1 0  0 0 0.1"/>
  <GearSpringForceField spring="BEGIN_SPRING 0 0 1 1 AXIS 2 2 KS_T 1000 KS_R 100 1000 KD 0.001 RATIO 0.5 END_SPRING"/>
</Node>)"},
    {"JointSpringForceField", R"(
<Node name="links" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <MechanicalObject template="Rigid3d" position="0.5 0 0  0 0 0 1   1.5 0 0  0 0 0 1"/>
  <UniformMass vertexMass="1 1  0.01 0 0  0 0.1 0  0 0 0.1"/>
  <FixedConstraint indices="0"/>
  <Node name="hinge">
    <MechanicalObject template="Rigid3d" position="0.5 0 0  0 0 0 1   -0.5 0 0  0 0 0 1"/>
    <RigidMapping rigidIndexPerPoint="0 1"/>
    <JointSpringForceField spring="BEGIN_SPRING 0 1 FREE_AXIS 0 0 0 0 0 1 KS_T 0 20000 KS_R 0 2000 R_LIM_Z -0.5 0.5 KD 0.1 END_SPRING"/>
  </Node>
</Node>)"},
    {"MeshSpringForceField", R"(<MeshSpringForceField stiffness="2000" damping="1"/>)"},
    {"PolynomialSpringsForceField",
     R"(
<PolynomialSpringsForceField firstObjectPoints="0 1" secondObjectPoints="1 2"
                             polynomialDegree="3" polynomialStiffness="5 0 400"/>)",
     chain,
     "StiffSpringForceField"},
    {"PolynomialRestShapeSpringsForceField",
     R"(
<PolynomialRestShapeSpringsForceField points="0" polynomialStiffness="20 0 500" polynomialDegree="3" initialLength="0.5"
                                      smoothShift="-20"/>)",
     chain,
     "FixedConstraint"},
    {"QuadBendingSprings",
     R"(
<MeshSpringForceField stiffness="50" damping="0.1"/>
<QuadBendingSprings stiffness="20" damping="0.05"/>)",
     sheet,
     "TriangleFEMForceField"},
    {"QuadularBendingSprings",
     R"(
<MeshSpringForceField stiffness="50" damping="0.1"/>
<QuadularBendingSprings stiffness="20" damping="0.05"/>)",
     sheet,
     "TriangleFEMForceField"},
    {"RegularGridSpringForceField", R"(<RegularGridSpringForceField stiffness="200" damping="1"/>)"},
    {"RepulsiveSpringForceField",
     R"(<RepulsiveSpringForceField springsIndices1="0" springsIndices2="2" stiffness="40" damping="0.2" lengths="0.9"/>)",
     chain,
     "StiffSpringForceField",
     Place::beside},
    {"RestShapeSpringsForceField",
     R"(<RestShapeSpringsForceField points="0" stiffness="200"/>)",
     chain,
     "FixedConstraint"},
    {"StiffSpringForceField", R"(
<Node name="root" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <SparseLDLSolver/>
  <Node name="upper">
    <MechanicalObject name="points" position="0 1 0"/>
    <UniformMass vertexMass="0.1"/>
    <FixedConstraint indices="0"/>
  </Node>
  <Node name="chain">
    <MechanicalObject name="points" position="0 0.5 0  0.5 0.5 0"/>
    <UniformMass vertexMass="0.1"/>
    <StiffSpringForceField spring="0 1 100 0.1 0.5"/>
  </Node>
  <StiffSpringForceField object1="@upper/points" object2="@chain/points" spring="0 0 100 0.1 0.5"/>
</Node>)"},
    {"TriangleBendingSprings",
     R"(
<MeshSpringForceField stiffness="50" damping="0.1"/>
<TriangleBendingSprings stiffness="20" damping="0.05"/>)",
     sheet,
     "TriangleFEMForceField"},
    {"TriangularBendingSprings",
     R"(
<MeshSpringForceField stiffness="50" damping="0.1"/>
<TriangularBendingSprings stiffness="20" damping="0.05"/>)",
     sheet,
     "TriangleFEMForceField"},
    {"TriangularBiquadraticSpringsForceField",
     R"(
<TriangularBiquadraticSpringsForceField youngModulus="50" poissonRatio="0.3"/>)",
     sheet,
     "TriangleFEMForceField"},
    {"TriangularQuadraticSpringsForceField",
     R"(
<TriangularQuadraticSpringsForceField youngModulus="50" poissonRatio="0.3"/>)",
     sheet,
     "TriangleFEMForceField"},
    {"VectorSpringForceField",
     R"(<VectorSpringForceField springs="0 1 100 1 auto  1 2 100 1 auto"/>)",
     chain,
     "StiffSpringForceField"},
});

}  // namespace

std::span<ClassExample const> examples_of_springs() { return examples; }

}  // namespace cli
