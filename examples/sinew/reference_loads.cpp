// SPDX-License-Identifier: BSL-1.0
#include "reference_examples.hpp"

namespace cli {

namespace {

constexpr auto examples = std::to_array<ClassExample>({
    {"ConstantForceField",
     R"(<ConstantForceField indices="4 9" totalForce="0 0 5"/>)",
     softBody,
     "TetrahedronFEMForceField",
     Place::beside},
    {"EdgePressureForceField",
     R"(<EdgePressureForceField pressure="0 0 2" edgeIndices="0 1 2 3"/>)",
     sheet,
     "TriangleFEMForceField",
     Place::beside},
    {"EllipsoidForceField",
     R"(<EllipsoidForceField center="0.5 0.5 -0.3" vradius="0.4 0.3 0.2" stiffness="20" damping="1"/>)",
     sheet,
     "TriangleFEMForceField",
     Place::beside},
    {"LinearForceField",
     R"(<LinearForceField points="4 9" times="0 0.5 1" forces="0 0 0  0 0 3  0 0 0"/>)",
     softBody,
     "TetrahedronFEMForceField",
     Place::beside},
    {"OscillatingTorsionPressureForceField",
     R"(
<OscillatingTorsionPressureForceField moment="0.5" axis="0 0 1" center="0.5 0.5 0" frequency="2" penalty="5"
                                      triangleList="8 9 10 11"/>)",
     sheet,
     "TriangleFEMForceField",
     Place::beside},
    {"PlaneForceField",
     R"(<PlaneForceField normal="0 1 0" d="-0.05" stiffness="500" damping="5"/>)",
     softBody,
     "TetrahedronFEMForceField",
     Place::beside},
    {"QuadPressureForceField",
     R"(<QuadPressureForceField pressure="0 0 2" quadList="0 1 2 3"/>)",
     sheet,
     "TriangleFEMForceField",
     Place::beside},
    {"SphereForceField",
     R"(<SphereForceField center="0.4 -0.15 0.05" radius="0.1" stiffness="500"/>)",
     softBody,
     "TetrahedronFEMForceField",
     Place::beside},
    {"SurfacePressureForceField",
     R"(<SurfacePressureForceField pressure="2"/>)",
     sheet,
     "TriangleFEMForceField",
     Place::beside},
    {"TorsionForceField",
     R"(<TorsionForceField indices="20 21 22 23" torque="0.5" axis="0 1 0" origin="0 0 0"/>)",
     sheet,
     "TriangleFEMForceField",
     Place::beside},
    {"TrianglePressureForceField",
     R"(<TrianglePressureForceField pressure="0 0 2" triangleList="0 1 2 3"/>)",
     sheet,
     "TriangleFEMForceField",
     Place::beside},
    {"ConicalForceField",
     R"(<ConicalForceField coneCenter="-0.1 0 0.05" coneHeight="1 0 0" coneAngle="20" stiffness="500"/>)",
     softBody,
     "TetrahedronFEMForceField",
     Place::beside},
    {"DiagonalVelocityDampingForceField",
     R"(<DiagonalVelocityDampingForceField dampingCoefficient="0.05 0 0.05"/>)",
     chain,
     "StiffSpringForceField",
     Place::beside},
    {"TaitSurfacePressureForceField", R"(
<Node name="ball" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="200" tolerance="1e-8"/>
  <MeshOBJLoader name="ball" filename="data/ball.obj"/>
  <MeshTopology triangles="@ball.triangles"/>
  <MechanicalObject position="@ball.position"/>
  <UniformMass totalMass="0.2"/>
  <MeshSpringForceField stiffness="50" damping="0.5"/>
  <TaitSurfacePressureForceField B="1e4" gamma="5" injectedVolume="0.1" maxInjectionRate="0.2"/>
  <FixedConstraint indices="0"/>
</Node>)"},
    {"UniformVelocityDampingForceField",
     R"(<UniformVelocityDampingForceField dampingCoefficient="0.05"/>)",
     chain,
     "StiffSpringForceField",
     Place::beside},
    {"VirtualCoupling", R"(
<Node name="tool">
  <EulerImplicitSolver/>
  <SparseLDLSolver template="CompressedRowSparseMatrixd"/>
  <MechanicalObject template="Rigid3d" position="0 0.15 0  0 0 0 1"/>
  <UniformMass vertexMass="0.05 1  0.002 0 0  0 0.002 0  0 0 0.002"/>
  <VirtualCoupling stiffness="100" damping="2" angularStiffness="0.5" target="0.03 0.18 0  0 0.5 0 0.866025"/>
</Node>)"},
    {"InteractionEllipsoidForceField", R"(
<Node name="root" gravity="0 -9.81 0">
  <Node name="obstacle">
    <EulerExplicitSolver/>
    <MechanicalObject template="Rigid3" position="0 -1 0  0 0 0 1" velocity="0 0 0  0 0 1"/>
    <UniformMass vertexMass="1"/>
    <PartialFixedConstraint indices="0" fixedDirections="1 1 1 0 0 0"/>
  </Node>
  <Node name="body">
    <EulerImplicitSolver/>
    <SparseLDLSolver/>
    <MechanicalObject position="-0.3 -0.8 0  0.3 -0.8 0"/>
    <UniformMass vertexMass="0.1"/>
    <InteractionEllipsoidForceField object2="@../obstacle" object2_forces="0" vradius="0.6 0.4 0.5" stiffness="50" damping="1"/>
  </Node>
</Node>)"},
});

}  // namespace

std::span<ClassExample const> examples_of_loads() { return examples; }

}  // namespace cli
