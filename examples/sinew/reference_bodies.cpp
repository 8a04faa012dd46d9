// SPDX-License-Identifier: BSL-1.0
#include "reference_examples.hpp"

namespace cli {

namespace {

constexpr auto examples = std::to_array<ClassExample>({
    {"Gravity", R"(
<Node name="root" gravity="0 -9.81 0">
  <EulerExplicitSolver/>
  <Node name="earth">
    <MechanicalObject position="0 1 0"/>
    <UniformMass vertexMass="1"/>
  </Node>
  <Node name="moon">
    <Gravity gravity="0 -1.62 0"/>
    <MechanicalObject position="1 1 0"/>
    <UniformMass vertexMass="1"/>
  </Node>
</Node>)"},
    {"Threads", R"(<Threads count="4"/>)", softBody, "EulerImplicitSolver", Place::beside},
    {"RegularGridTopology", "", softBody, ""},
    {"CubeTopology", R"(
<Node name="box" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <CubeTopology nx="4" ny="4" nz="4" max="0.2 0.2 0.2"/>
  <MechanicalObject/>
  <UniformMass totalMass="0.5"/>
  <MeshSpringForceField stiffness="500" damping="1"/>
  <FixedConstraint indices="0 1 2 3"/>
</Node>)"},
    {"CylinderGridTopology", R"(<CylinderGridTopology n="5 5 9" radius="0.05" length="0.4" axis="1 0 0"/>)"},
    {"SphereGridTopology", R"(<SphereGridTopology n="5 5 5" center="0.2 0.05 0.05" radius="0.2"/>)"},
    {"MeshTopology", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <SparseLDLSolver/>
  <MeshTopology tetrahedra="0 1 2 3  1 2 3 4"/>
  <MechanicalObject position="0 0 0  1 0 0  0.5 0 0.9  0.5 -0.8 0.3  0.5 -1 1.2"/>
  <DiagonalMass massDensity="10"/>
  <TetrahedronFEMForceField youngModulus="2000" poissonRatio="0.3"/>
  <FixedConstraint indices="0 1 2"/>
</Node>)"},
    {"TetrahedronTopology", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <SparseLDLSolver/>
  <TetrahedronTopology tetrahedra="0 1 2 3  1 2 3 4"/>
  <MechanicalObject position="0 0 0  1 0 0  0.5 0 0.9  0.5 -0.8 0.3  0.5 -1 1.2"/>
  <DiagonalMass massDensity="10"/>
  <TetrahedronFEMForceField youngModulus="2000" poissonRatio="0.3"/>
  <FixedConstraint indices="0 1 2"/>
</Node>)"},
    {"SparseGridTopology", R"(
<Node name="organ" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <SparseGridTopology n="8 4 6" fileTopology="data/organ.obj"/>
  <MechanicalObject/>
  <UniformMass totalMass="0.7"/>
  <HexahedronFEMForceField youngModulus="5000" poissonRatio="0.3"/>
  <FixedConstraint indices="0 1 2"/>
  <Node name="skin">
    <MeshOBJLoader name="surface" filename="data/organ.obj"/>
    <VisualModel src="@surface"/>
    <BarycentricMapping/>
  </Node>
</Node>)"},
    {"SparseGridMultipleTopology", R"(
<Node name="organ" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <SparseGridMultipleTopology n="6 6 6" nbVirtualFinerLevels="2" finestConnectivity="false" stiffnessCoefs="1 20"
                              fileTopologies="data/ball.obj data/organ.obj"/>
  <MechanicalObject/>
  <UniformMass totalMass="0.7"/>
  <HexahedronFEMForceField youngModulus="5000" poissonRatio="0.3"/>
  <FixedConstraint indices="0 1 2"/>
  <Node name="skin">
    <MeshOBJLoader name="surface" filename="data/organ.obj"/>
    <VisualModel src="@surface"/>
    <BarycentricMapping/>
  </Node>
</Node>)"},
    {"SparseGridRamificationTopology", R"(
<Node name="organ" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <SparseGridRamificationTopology n="5 3 4" fileTopology="data/organ.obj" nbVirtualFinerLevels="2"
                                  finestConnectivity="false"/>
  <MechanicalObject/>
  <UniformMass totalMass="0.7"/>
  <HexahedronFEMForceField youngModulus="5000" poissonRatio="0.3"/>
  <FixedConstraint indices="0 1 2"/>
  <Node name="skin">
    <MeshOBJLoader name="surface" filename="data/organ.obj"/>
    <VisualModel src="@surface"/>
    <BarycentricMapping/>
  </Node>
</Node>)"},
    {"MechanicalObject", R"(
<Node name="root" gravity="0 -9.81 0">
  <EulerExplicitSolver/>
  <Node name="points">
    <MechanicalObject position="0 0 0  1 0 0" velocity="0 1 0  0 2 0"/>
    <UniformMass vertexMass="0.1"/>
  </Node>
  <Node name="frame">
    <MechanicalObject template="Rigid3d" position="2 0 0  0 0 0 1" velocity="0 0 0  0 0 3"/>
    <UniformMass vertexMass="1 1  0.1 0 0  0 0.1 0  0 0 0.1"/>
  </Node>
</Node>)"},
    {"VisualModel",
     R"(
<VisualModel position="0 0 0  0.4 0 0  0.4 0.1 0  0 0.1 0" quads="0 3 2 1"/>
<BarycentricMapping/>)",
     R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <SparseLDLSolver/>
  <RegularGridTopology n="5 3 3" max="0.4 0.1 0.1"/>
  <MechanicalObject/>
  <UniformMass totalMass="4"/>
  <TetrahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>
  <FixedConstraint indices="0 5 10 15 20 25 30 35 40"/>
  <Node name="skin">
    <HERE/>
  </Node>
</Node>)",
     "HERE"},
    {"AdaptiveBeamMass", "", rod, ""},
    {"BeamMass", "", beams, ""},
    {"DiagonalMass", R"(<DiagonalMass massDensity="1000"/>)"},
    {"HexahedronCompositeFEMMass", "", composite, ""},
    {"MeshMatrixMass", R"(<MeshMatrixMass massDensity="1000"/>)"},
    {"UniformMass", "", softBody, ""},
});

}  // namespace

std::span<ClassExample const> examples_of_bodies() { return examples; }

}  // namespace cli
