// SPDX-License-Identifier: BSL-1.0
#include "reference_examples.hpp"

namespace cli {

namespace {

constexpr auto examples = std::to_array<ClassExample>({
    {"AdaptiveBeamMapping", "", rod, ""},
    {"ArticulatedSystemMapping", R"(
<Node name="pendulum" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <SparseLDLSolver template="CompressedRowSparseMatrixd"/>
  <MechanicalObject name="angles" template="Vec1" position="1.2 0.8"/>
  <Node name="rods">
    <MechanicalObject name="bodies" template="Rigid3"/>
    <UniformMass vertexMass="0.8 1  0.125 0 0  0 0.125 0  0 0 0.125"/>
    <ArticulatedSystemMapping input1="@../angles" output="@bodies"/>
  </Node>
  <ArticulatedHierarchyContainer/>
  <Node name="upper">
    <ArticulationCenter parentIndex="0" childIndex="1" posOnParent="0 0 0" posOnChild="0 1 0"/>
    <Node name="hinge"><Articulation rotation="1" rotationAxis="0 0 1" articulationIndex="0"/></Node>
  </Node>
  <Node name="lower">
    <ArticulationCenter parentIndex="1" childIndex="2" posOnParent="0 -1 0" posOnChild="0 1 0"/>
    <Node name="hinge"><Articulation rotation="1" rotationAxis="0 0 1" articulationIndex="1"/></Node>
  </Node>
</Node>)"},
    {"BarycentricMapping", "", carrier, ""},
    {"BeamLinearMapping",
     R"(
<Node name="hook">
  <MechanicalObject position="0.75 0.01 0"/>
  <BeamLinearMapping localCoord="false"/>
  <ConstantForceField force="0 0 0.5"/>
</Node>)",
     beams,
     "FixedConstraint",
     Place::beside},
    {"CenterOfMassMapping", R"(<CenterOfMassMapping/>)"},
    {"DistanceMapping", R"(
<Node name="net" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <SparseLDLSolver template="CompressedRowSparseMatrixd"/>
  <RegularGridTopology name="grid" n="5 1 5" max="1 0 1"/>
  <MechanicalObject/>
  <UniformMass totalMass="0.2"/>
  <FixedConstraint indices="0 4 20 24"/>
  <Node name="lengths">
    <MeshTopology edges="0 1  1 2  2 3  3 4"/>
    <MechanicalObject template="Vec1d"/>
    <DistanceMapping/>
    <RestShapeSpringsForceField stiffness="80"/>
  </Node>
</Node>)"},
    {"AreaMapping", R"(
<Node name="net" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <SparseLDLSolver template="CompressedRowSparseMatrixd"/>
  <RegularGridTopology name="grid" n="5 1 5" max="1 0 1"/>
  <MechanicalObject/>
  <UniformMass totalMass="0.2"/>
  <MeshSpringForceField stiffness="40" damping="0.1"/>
  <FixedConstraint indices="0 4 20 24"/>
  <Node name="areas">
    <MeshTopology triangles="0 1 6  0 6 5  3 4 9  3 9 8"/>
    <MechanicalObject template="Vec1d"/>
    <AreaMapping/>
    <RestShapeSpringsForceField stiffness="5000"/>
  </Node>
</Node>)"},
    {"SquareDistanceMapping", R"(
<Node name="net" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <SparseLDLSolver template="CompressedRowSparseMatrixd"/>
  <RegularGridTopology name="grid" n="5 1 5" max="1 0 1"/>
  <MechanicalObject/>
  <UniformMass totalMass="0.2"/>
  <FixedConstraint indices="0 4 20 24"/>
  <Node name="squares">
    <MeshTopology edges="0 1  1 2  2 3  3 4"/>
    <MechanicalObject template="Vec1d"/>
    <SquareDistanceMapping/>
    <RestShapeSpringsForceField stiffness="500"/>
  </Node>
</Node>)"},
    {"DistanceFromTargetMapping", R"(
<Node name="pendulum" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <SparseLDLSolver template="CompressedRowSparseMatrixd"/>
  <MechanicalObject position="0.5 0 0"/>
  <UniformMass totalMass="0.2"/>
  <Node name="thread">
    <MechanicalObject template="Vec1d"/>
    <DistanceFromTargetMapping indices="0" targetPositions="0 0 0" restLengths="0.5"/>
    <RestShapeSpringsForceField stiffness="200"/>
  </Node>
</Node>)"},
    {"DistanceToPlaneMapping", R"(
<Node name="ball" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <SparseLDLSolver template="CompressedRowSparseMatrixd"/>
  <MechanicalObject position="0 0.5 0"/>
  <UniformMass totalMass="0.2"/>
  <Node name="height">
    <MechanicalObject template="Vec1d"/>
    <DistanceToPlaneMapping planeNormal="0 1 0" planePoint="0 0.5 0"/>
    <RestShapeSpringsForceField stiffness="20"/>
  </Node>
</Node>)"},
    {"SquareMapping", R"(
<Node name="slider">
  <EulerImplicitSolver/>
  <SparseLDLSolver template="CompressedRowSparseMatrixd"/>
  <MechanicalObject template="Vec1d" position="1"/>
  <UniformMass totalMass="0.2"/>
  <Node name="square">
    <MechanicalObject template="Vec1d"/>
    <SquareMapping/>
    <ConstantForceField forces="-0.5"/>
  </Node>
</Node>)"},
    {"HexahedronCompositeFEMMapping", "", composite, ""},
    {"IdentityMapping",
     R"(
<Node name="skin">
  <MechanicalObject/>
  <IdentityMapping/>
  <ConstantForceField indices="44" force="0 0 2"/>
</Node>)",
     softBody,
     "FixedConstraint",
     Place::beside},
    {"RigidMapping", R"(
<Node name="tool" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <CGLinearSolver iterations="50" tolerance="1e-8"/>
  <MechanicalObject template="Rigid3d" position="0 1 0  0 0 0 1"/>
  <UniformMass vertexMass="1 1  0.1 0 0  0 0.1 0  0 0 0.1"/>
  <Node name="tips">
    <MechanicalObject position="-0.1 -0.3 0  0.1 -0.3 0"/>
    <RigidMapping/>
    <PlaneForceField normal="0 1 0" d="0.65" stiffness="200" damping="5"/>
  </Node>
</Node>)"},
    {"SkinningMapping", R"(
<Node name="bones">
  <EulerExplicitSolver/>
  <MechanicalObject template="Rigid3d" position="0 0 0  0 0 0 1   1 0 0  0 0 0 1"
                    velocity="0 0 0  0 0 0   0 0 0  2 0 0"/>
  <UniformMass vertexMass="1 1  0.1 0 0  0 0.1 0  0 0 0.1"/>
  <Node name="skin">
    <MechanicalObject position="0.5 0.2 0  0.5 0 0.2  0.5 -0.2 0"/>
    <SkinningMapping nbRef="2" method="dualQuaternion"/>
  </Node>
</Node>)"},
    {"TubularMapping",
     R"(
<Node name="skin">
  <MeshTopology name="faces"/>
  <Edge2QuadTopologicalMapping nbPointsOnEachCircle="8" radius="0.01" output="@faces"/>
  <MechanicalObject/>
  <TubularMapping nbPointsOnEachCircle="8" radius="0.01" peak="-2"/>
</Node>)",
     beams,
     "FixedConstraint",
     Place::beside},
    {"SubsetMapping",
     R"(
<Node name="corners">
  <MechanicalObject/>
  <SubsetMapping indices="4 44"/>
  <ConstantForceField force="0 0 2"/>
</Node>)",
     softBody,
     "FixedConstraint",
     Place::beside},
    {"SubsetMultiMapping", R"(
<Node name="root" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <SparseLDLSolver/>
  <Node name="upper">
    <MechanicalObject position="0 0 0  0 -0.5 0"/>
    <UniformMass vertexMass="0.1"/>
    <StiffSpringForceField spring="0 1 100 0.1 0.5"/>
    <FixedConstraint indices="0"/>
  </Node>
  <Node name="lower">
    <MechanicalObject position="0 -1 0"/>
    <UniformMass vertexMass="0.1"/>
  </Node>
  <Node name="joint">
    <MechanicalObject/>
    <SubsetMultiMapping input="@../upper @../lower" indexPairs="0 1  1 0"/>
    <StiffSpringForceField spring="0 1 50 0.2 0.5"/>
  </Node>
</Node>)"},
    {"DeformableOnRigidFrameMapping", R"(
<Node name="root" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <SparseLDLSolver template="CompressedRowSparseMatrixd"/>
  <Node name="frame">
    <MechanicalObject template="Rigid3" position="0 0 0  0 0 0 1"/>
    <UniformMass vertexMass="1"/>
    <PartialFixedConstraint indices="0" fixedDirections="1 1 1 0 0 0"/>
  </Node>
  <Node name="body">
    <MechanicalObject position="0 0 0  1 0 0"/>
    <UniformMass vertexMass="0.1"/>
    <StiffSpringForceField spring="0 1 100 0.1 1"/>
    <FixedConstraint indices="0"/>
    <Node name="world">
      <MechanicalObject/>
      <DeformableOnRigidFrameMapping input1="@.." input2="@../../frame"/>
      <ConstantForceField indices="1" force="0 2 0"/>
    </Node>
  </Node>
</Node>)"},
    {"DistanceMultiMapping", R"(
<Node name="root" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <SparseLDLSolver/>
  <Node name="upper">
    <MechanicalObject position="0 0 0  0 -0.5 0"/>
    <UniformMass vertexMass="0.1"/>
    <StiffSpringForceField spring="0 1 100 0.1 0.5"/>
    <FixedConstraint indices="0"/>
  </Node>
  <Node name="lower">
    <MechanicalObject position="0 -1 0"/>
    <UniformMass vertexMass="0.1"/>
  </Node>
  <Node name="joint">
    <MechanicalObject template="Vec1"/>
    <MeshTopology edges="0 1"/>
    <DistanceMultiMapping input="@../upper @../lower" indexPairs="0 1  1 0"/>
    <RestShapeSpringsForceField stiffness="50"/>
  </Node>
</Node>)"},
    {"IdentityMultiMapping", R"(
<Node name="root" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <SparseLDLSolver/>
  <Node name="upper">
    <MechanicalObject position="0 0 0  0 -0.5 0"/>
    <UniformMass vertexMass="0.1"/>
    <FixedConstraint indices="0"/>
  </Node>
  <Node name="lower">
    <MechanicalObject position="0 -1 0"/>
    <UniformMass vertexMass="0.1"/>
  </Node>
  <Node name="all">
    <MechanicalObject/>
    <IdentityMultiMapping input="@../upper @../lower"/>
    <StiffSpringForceField spring="0 1 100 0.1 0.5  1 2 50 0.2 0.5"/>
  </Node>
</Node>)"},
    {"VolumeMapping", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <SparseLDLSolver template="CompressedRowSparseMatrixd"/>
  <TetrahedronTopology tetrahedra="0 1 2 3  1 2 3 4"/>
  <MechanicalObject position="0 0 0  1 0 0  0.5 0 0.9  0.5 -0.8 0.3  0.5 -1 1.2"/>
  <UniformMass totalMass="0.5"/>
  <TetrahedronFEMForceField youngModulus="200" poissonRatio="0.2"/>
  <FixedConstraint indices="0 1 2"/>
  <Node name="volumes">
    <MechanicalObject template="Vec1d"/>
    <VolumeMapping/>
    <RestShapeSpringsForceField stiffness="20000"/>
  </Node>
</Node>)"},
});

}  // namespace

std::span<ClassExample const> examples_of_mappings() { return examples; }

}  // namespace cli
