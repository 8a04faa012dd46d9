// SPDX-License-Identifier: BSL-1.0
#include "reference_examples.hpp"

namespace cli {

namespace {

constexpr auto examples = std::to_array<ClassExample>({
    {"AffineMovementConstraint",
     R"(
<AffineMovementConstraint indices="4 9 14 19 24 29 34 39 44" translation="0.1 0 0" endConstraintTime="1"/>)",
     softBody,
     "FixedConstraint",
     Place::beside},
    {"InterventionalRadiologyController", "", guideWire, ""},
    {"AttachProjectiveConstraint", R"(
<Node name="root" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <SparseLDLSolver/>
  <AttachProjectiveConstraint object1="@upper" object2="@lower" indices1="1" indices2="0" twoWay="true"/>
  <Node name="upper">
    <MechanicalObject position="0 0 0  0 -0.5 0.2"/>
    <UniformMass vertexMass="0.1"/>
    <StiffSpringForceField spring="0 1 100 0.1 0.5"/>
    <FixedConstraint indices="0"/>
  </Node>
  <Node name="lower">
    <MechanicalObject position="0 -0.5 0.2  0 -1 0"/>
    <UniformMass vertexMass="0.1"/>
    <StiffSpringForceField spring="0 1 100 0.1 0.5"/>
  </Node>
</Node>)"},
    {"FixedConstraint", "", softBody, ""},
    {"FixedPlaneConstraint",
     R"(<FixedPlaneConstraint direction="1 0 0" dmin="-0.01" dmax="0.01"/>)",
     softBody,
     "FixedConstraint",
     Place::beside},
    {"FixedRotationConstraint",
     R"(<FixedRotationConstraint FixedXRotation="true"/>)",
     beams,
     "FixedConstraint",
     Place::beside},
    {"HermiteSplineConstraint",
     R"(
<HermiteSplineConstraint indices="0" X0="0 0 0" dX0="0 2 0" X1="1 0 0" dX1="0 2 0" SX0="0 0" SX1="0 0"
                         BeginTime="0" EndTime="1"/>)",
     chain,
     "FixedConstraint"},
    {"ParticleSink", R"(
<Node name="drops" gravity="0 -10 0">
  <EulerExplicitSolver symplectic="true"/>
  <MechanicalObject/>
  <UniformMass vertexMass="1"/>
  <ParticleSource center="0 0 0  1 0 0" velocity="0 -1 0" delay="0.02"/>
  <ParticleSink normal="0 1 0" d0="-3" d1="-1"/>
</Node>)"},
    {"ParticleSource", R"(
<Node name="drops" gravity="0 -10 0">
  <EulerExplicitSolver symplectic="true"/>
  <MechanicalObject/>
  <UniformMass vertexMass="1"/>
  <ParticleSource center="0 0 0  1 0 0" radius="0.1 0.1 0.1" velocity="0 -1 0" delay="0.02" stop="2" capacity="200"/>
  <PlaneForceField normal="0 1 0" d="-1"/>
</Node>)"},
    {"LinearMovementConstraint",
     R"(
<LinearMovementConstraint indices="0" keyTimes="0 0.5 1" movements="0 0 0  0.3 0.2 0  0 0.4 0"/>)",
     chain,
     "FixedConstraint"},
    {"LinearVelocityConstraint",
     R"(
<LinearVelocityConstraint indices="0" keyTimes="0 0.5 1" velocities="0 0 0  0 1 0  0 0 0"/>)",
     chain,
     "FixedConstraint"},
    {"OscillatorConstraint",
     R"(<OscillatorConstraint oscillators="0  0 0 0  0 0.1 0  6.28 0"/>)",
     chain,
     "FixedConstraint"},
    {"ParabolicConstraint",
     R"(
<ParabolicConstraint indices="0" P1="0 0 0" P2="0.5 1 0" P3="1 0 0" BeginTime="0" EndTime="0.8"/>)",
     chain,
     "FixedConstraint"},
    {"PositionBasedDynamicsProjectiveConstraint", jelly},
    {"ClusteringEngine", jelly},
    {"ShapeMatching", R"(
<Node name="root" gravity="0 -9.81 0">
  <Node name="block">
    <EulerImplicitSolver rayleighStiffness="0.01"/>
    <CGLinearSolver iterations="25" tolerance="1e-8"/>
    <RegularGridTopology n="5 3 3" max="0.4 0.1 0.1"/>
    <MechanicalObject name="dofs"/>
    <UniformMass totalMass="4"/>
    <HexahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>
    <FixedConstraint indices="0 5 10 15 20 25 30 35 40"/>
    <ClusteringEngine name="clustering" number="1"/>
    <ShapeMatching name="matching" position="@dofs.position" cluster="@clustering.cluster"/>
  </Node>
  <Node name="unbent">
    <MechanicalObject position="@../block/matching.targetPosition"/>
  </Node>
</Node>)"},
    {"PatchTestMovementProjectiveConstraint",
     R"(
<PatchTestMovementProjectiveConstraint indices="0 1 2 3 4 5 9 10 14 15 19 20 21 22 23 24" endConstraintTime="1"
                                       cornerMovements="0 0 0  0.2 0 0  0.3 0.1 0  0 0.1 0"/>)",
     sheet,
     "FixedConstraint"},
    {"PartialFixedConstraint",
     R"(<PartialFixedConstraint indices="0" fixedDirections="1 1 0"/>)",
     chain,
     "FixedConstraint"},
    {"ProjectDirectionConstraint",
     R"(<ProjectDirectionConstraint indices="0" direction="1 0 0"/>)",
     chain,
     "FixedConstraint"},
    {"ProjectToLineConstraint",
     R"(
<ProjectToLineConstraint indices="0" origin="0 0 0" direction="1 -0.2 0"/>)",
     chain,
     "FixedConstraint"},
    {"ProjectToPlaneConstraint",
     R"(
<ProjectToPlaneConstraint indices="0" origin="0 0 0" normal="0 1 0"/>)",
     chain,
     "FixedConstraint"},
    {"ProjectToPointConstraint",
     R"(<ProjectToPointConstraint indices="0" point="0 0.1 0"/>)",
     chain,
     "FixedConstraint"},
    {"ReadState", R"(
<Node name="root" gravity="0 -9.81 0">
  <Node name="hand">
    <MechanicalObject name="points" position="0 0 0"/>
    <ReadState keyTimes="0 0.5 1" keyPositions="0 0 0  0.5 0.2 0  0 0 0" loop="true"/>
  </Node>
  <Node name="weight">
    <EulerImplicitSolver/>
    <SparseLDLSolver/>
    <MechanicalObject name="points" position="0 -0.5 0"/>
    <UniformMass vertexMass="0.1"/>
  </Node>
  <StiffSpringForceField object1="@hand/points" object2="@weight/points" spring="0 0 50 0.1 0.5"/>
</Node>)"},
});

}  // namespace

std::span<ClassExample const> examples_of_constraints() { return examples; }

}  // namespace cli
