// SPDX-License-Identifier: BSL-1.0
#include "reference_examples.hpp"

namespace cli {

namespace {

constexpr auto examples = std::to_array<ClassExample>({
    {"BoxROI", R"(
<BoxROI name="end" box="-0.01 -1 -1  0.01 1 1"/>
<FixedConstraint indices="@end.indices"/>)"},
    {"SphereROI", R"(
<SphereROI name="end" centers="0 0.05 0.05" radii="0.08"/>
<FixedConstraint indices="@end.indices"/>)"},
    {"PlaneROI", R"(
<PlaneROI name="end" plane="0 -1 -1  0 1 -1  0 1 1  0.1"/>
<FixedConstraint indices="@end.indices"/>)"},
    {"PairBoxROI", R"(
<PairBoxROI name="shell" inclusiveBox="-1 -1 -1  1 1 1" includedBox="0.05 0.01 0.01  0.35 0.09 0.09"/>
<FixedConstraint indices="@shell.indices"/>)"},
    {"PointsFromIndices", R"(
<Node name="root" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <SparseLDLSolver/>
  <Node name="body">
    <RegularGridTopology name="grid" n="5 3 3" max="0.4 0.1 0.1"/>
    <MechanicalObject/>
    <UniformMass totalMass="4"/>
    <TetrahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>
    <FixedConstraint indices="0 5 10 15 20 25 30 35 40"/>
  </Node>
  <Node name="markers">
    <PointsFromIndices name="ends" position="@../body/grid.position" indices="4 9 14"/>
    <MechanicalObject position="@ends.indices_position"/>
    <UniformMass totalMass="0.1"/>
  </Node>
</Node>)"},
    {"SubsetTopology", R"(
<Node name="root" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <SparseLDLSolver/>
  <RegularGridTopology name="grid" n="5 3 3" max="0.4 0.1 0.1"/>
  <SubsetTopology name="part" template="Vec3d" box="-0.01 -1 -1  0.21 1 1" localIndices="1" rest_position="@grid.position"
                  hexahedra="@grid.hexahedra"/>
  <Node name="body">
    <MeshTopology position="@../part.pointsInROI" hexahedra="@../part.hexahedraInROI"/>
    <MechanicalObject/>
    <UniformMass totalMass="2"/>
    <HexahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>
    <FixedConstraint indices="0 5 10"/>
  </Node>
</Node>)"},
    {"MeshBoundaryROI",
     R"(
<MeshBoundaryROI name="rim"/>
<FixedConstraint indices="@rim.indices"/>)",
     sheet,
     "FixedConstraint"},
    {"MeshROI", R"(
<MeshSTLLoader name="cube" filename="data/cube.stl" scale3d="0.1 1 1" translation="-0.05 -0.5 -0.5"/>
<MeshROI name="end" ROIposition="@cube.position" ROItriangles="@cube.triangles"/>
<FixedConstraint indices="@end.indices"/>)"},
    {"ProximityROI", R"(
<ProximityROI name="end" centers="0 0.05 0.05" radii="0.2" N="9"/>
<FixedConstraint indices="@end.indices"/>)"},
    {"ComplementaryROI", R"(
<BoxROI name="free" box="0.05 -1 -1  1 1 1"/>
<ComplementaryROI name="end" position="@free.position" nbSet="1" setIndices1="@free.indices"/>
<FixedConstraint indices="@end.indices"/>)"},
    {"MergeSets", R"(
<BoxROI name="low" box="-0.01 -1 -1  0.01 0.06 1"/>
<BoxROI name="high" box="-0.01 0.04 -1  0.01 1 1"/>
<MergeSets name="end" in1="@low.indices" in2="@high.indices"/>
<FixedConstraint indices="@end.out"/>)"},
    {"MergeVectors", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <RegularGridTopology n="5 3 3" max="0.4 0.1 0.1"/>
  <MechanicalObject/>
  <MergeVectors name="modulus" nbInputs="2" input1="50000" input2=""/>
  <UniformMass totalMass="1"/>
  <TetrahedronFEMForceField youngModulus="@modulus.output" poissonRatio="0.3"/>
  <FixedConstraint indices="0 5 10 15 20 25 30 35 40"/>
</Node>)"},
    {"MergeROIs", R"(
<BoxROI name="low" box="-0.01 -1 -1  0.01 0.06 1"/>
<BoxROI name="high" box="-0.01 0.04 -1  0.01 1 1"/>
<MergeROIs name="both" nbROIs="2" indices1="@low.indices" indices2="@high.indices"/>
<SelectLabelROI name="which" labels="@both.roiIndices" selectLabels="5"/>
<FixedConstraint indices="@which.indices"/>)"},
    {"SelectLabelROI", R"(
<SelectLabelROI name="end" labels="[1] [] [2] [3] [] [1 2]" selectLabels="1"/>
<FixedConstraint indices="@end.indices"/>)"},
    {"MeshSampler", R"(
<MeshSampler name="few" number="3" position="@RegularGridTopology.position"/>
<FixedConstraint indices="@few.outputIndices"/>)"},
    {"IndicesFromValues", R"(
<IndicesFromValues name="corners" template="Vec3d" values="0 0 0  0 0.1 0" global="@RegularGridTopology.position"/>
<FixedConstraint indices="@corners.indices"/>)"},
    {"MapIndices", R"(
<MapIndices name="end" in="2 1 0" indices="0 5 10" transpose="1"/>
<FixedConstraint indices="@end.out"/>)"},
    {"ValuesFromPositions", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <GenerateGrid name="block" max="0.4 0.1 0.1" resolution="4 2 2"/>
  <MeshTopology position="@block.position" tetrahedra="@block.tetrahedra"/>
  <MechanicalObject/>
  <ValuesFromPositions name="stiffer" inputValues="20000 80000" direction="1 0 0"/>
  <UniformMass totalMass="1"/>
  <TetrahedronFEMForceField youngModulus="@stiffer.tetrahedronValues" poissonRatio="0.3"/>
  <FixedConstraint indices="0 5 10 15 20 25 30 35 40"/>
</Node>)"},
    {"AverageCoord", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <GenerateGrid name="block" max="0.4 0.1 0.1" resolution="4 2 2"/>
  <MeshTopology position="@block.position" tetrahedra="@block.tetrahedra"/>
  <MechanicalObject/>
  <AverageCoord name="middle"/>
  <SphereForceField center="@middle.average" radius="0.01"/>
  <UniformMass totalMass="1"/>
  <TetrahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>
  <FixedConstraint indices="0 5 10 15 20 25 30 35 40"/>
</Node>)"},
    {"ValuesFromIndices", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <RegularGridTopology n="5 3 3" max="0.4 0.1 0.1"/>
  <MechanicalObject/>
  <ValuesFromIndices name="modulus" in="10000 50000 90000" indices="1"/>
  <UniformMass totalMass="1"/>
  <TetrahedronFEMForceField youngModulus="@modulus.out" poissonRatio="0.3"/>
  <FixedConstraint indices="0 5 10 15 20 25 30 35 40"/>
</Node>)"},
    {"DifferenceEngine", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <RegularGridTopology n="5 3 3" max="0.4 0.1 0.1"/>
  <MechanicalObject/>
  <DifferenceEngine name="modulus" input="60000" substractor="10000"/>
  <UniformMass totalMass="1"/>
  <TetrahedronFEMForceField youngModulus="@modulus.output" poissonRatio="0.3"/>
  <FixedConstraint indices="0 5 10 15 20 25 30 35 40"/>
</Node>)"},
    {"NormEngine", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <RegularGridTopology n="5 3 3" max="0.4 0.1 0.1"/>
  <MechanicalObject/>
  <NormEngine name="modulus" input="30000 40000 0"/>
  <UniformMass totalMass="1"/>
  <TetrahedronFEMForceField youngModulus="@modulus.output" poissonRatio="0.3"/>
  <FixedConstraint indices="0 5 10 15 20 25 30 35 40"/>
</Node>)"},
    {"SumEngine", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <RegularGridTopology n="5 3 3" max="0.4 0.1 0.1"/>
  <MechanicalObject/>
  <SumEngine name="modulus" input="20000 30000"/>
  <UniformMass totalMass="1"/>
  <TetrahedronFEMForceField youngModulus="@modulus.output" poissonRatio="0.3"/>
  <FixedConstraint indices="0 5 10 15 20 25 30 35 40"/>
</Node>)"},
    {"MathOp", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <RegularGridTopology n="5 3 3" max="0.4 0.1 0.1"/>
  <MechanicalObject/>
  <MathOp name="modulus" nbInputs="2" op="*" input1="25000" input2="2"/>
  <UniformMass totalMass="1"/>
  <TetrahedronFEMForceField youngModulus="@modulus.output" poissonRatio="0.3"/>
  <FixedConstraint indices="0 5 10 15 20 25 30 35 40"/>
</Node>)"},
    {"Indices2ValuesMapper", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <RegularGridTopology n="5 3 3" max="0.4 0.1 0.1"/>
  <MechanicalObject/>
  <Indices2ValuesMapper name="modulus" inputValues="2" indices="1 2" values="20000 50000"/>
  <UniformMass totalMass="1"/>
  <TetrahedronFEMForceField youngModulus="@modulus.outputValues" poissonRatio="0.3"/>
  <FixedConstraint indices="0 5 10 15 20 25 30 35 40"/>
</Node>)"},
    {"ROIValueMapper", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <RegularGridTopology n="5 3 3" max="0.4 0.1 0.1"/>
  <MechanicalObject/>
  <ROIValueMapper name="modulus" nbROIs="1" indices1="0" value1="50000"/>
  <UniformMass totalMass="1"/>
  <TetrahedronFEMForceField youngModulus="@modulus.outputValues" poissonRatio="0.3"/>
  <FixedConstraint indices="0 5 10 15 20 25 30 35 40"/>
</Node>)"},
    {"HausdorffDistance", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <GenerateGrid name="block" max="0.4 0.1 0.1" resolution="4 2 2"/>
  <MeshTopology position="@block.position" tetrahedra="@block.tetrahedra"/>
  <MechanicalObject/>
  <HausdorffDistance name="reach" points1="@block.position" points2="0 0 0"/>
  <UniformMass totalMass="@reach.max"/>
  <TetrahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>
  <FixedConstraint indices="0 5 10 15 20 25 30 35 40"/>
</Node>)"},
    {"VolumeFromVolumetricElements", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <GenerateGrid name="block" max="0.4 0.1 0.1" resolution="4 2 2"/>
  <MeshTopology position="@block.position" tetrahedra="@block.tetrahedra"/>
  <MechanicalObject/>
  <VolumeFromVolumetricElements name="content"/>
  <UniformMass totalMass="@content.volume"/>
  <TetrahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>
  <FixedConstraint indices="0 5 10 15 20 25 30 35 40"/>
</Node>)"},
    {"IndexValueMapper", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <GenerateGrid name="block" max="0.4 0.1 0.1" resolution="4 2 2"/>
  <MeshTopology position="@block.position" tetrahedra="@block.tetrahedra"/>
  <MechanicalObject/>
  <UniformMass totalMass="1"/>
  <BoxROI name="half" box="-1 -1 -1  0.21 1 1"/>
  <BoxROI name="rest" box="0.19 -1 -1  1 1 1"/>
  <IndexValueMapper name="stiff" indices="@half.tetrahedronIndices" value="90000"/>
  <IndexValueMapper name="both" inputValues="@stiff.outputValues" indices="@rest.tetrahedronIndices" value="30000"/>
  <TetrahedronFEMForceField youngModulus="@both.outputValues" poissonRatio="0.3"/>
  <FixedConstraint indices="0 5 10 15 20 25 30 35 40"/>
</Node>)"},
    {"NearestPointROI", R"(
<Node name="root" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <SparseLDLSolver/>
  <Node name="hooks">
    <MechanicalObject name="points" position="0 1 0  0.5 1 0"/>
    <UniformMass vertexMass="0.1"/>
    <FixedConstraint indices="0 1"/>
  </Node>
  <Node name="drops">
    <MechanicalObject name="points" position="0.5 0.8 0  0 0.8 0"/>
    <UniformMass vertexMass="0.1"/>
  </Node>
  <NearestPointROI name="near" position1="@hooks/points.rest_position" position2="@drops/points.rest_position"
                   radius="0.4"/>
  <StiffSpringForceField object1="@hooks/points" object2="@drops/points" springsIndices1="@near.indices1"
                         springsIndices2="@near.indices2" lengths="@near.distances" stiffness="50" damping="0.1"/>
</Node>)"},
});

}  // namespace

std::span<ClassExample const> examples_of_selections() { return examples; }

}  // namespace cli
