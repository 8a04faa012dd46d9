// SPDX-License-Identifier: BSL-1.0
#include "reference_examples.hpp"

namespace cli {

namespace {

constexpr auto examples = std::to_array<ClassExample>({
    {"MeshSplittingEngine", R"(
<BoxROI name="end" box="-0.01 -1 -1  0.01 1 1"/>
<MeshSplittingEngine name="parts" position="@RegularGridTopology.position" nbInputs="1" indices1="@end.indices"/>
<MapIndices name="kept" in="0 2" indices="@parts.indexPairs" transpose="1"/>
<FixedConstraint indices="@kept.out"/>)"},
    {"MeshSubsetEngine", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <GenerateGrid name="block" max="0.8 0.1 0.1" resolution="8 2 2"/>
  <BoxROI name="half" position="@block.position" box="-1 -1 -1  0.41 1 1"/>
  <MeshSubsetEngine name="part" inputPosition="@block.position" inputTetrahedra="@block.tetrahedra" indices="@half.indices"/>
  <MeshTopology position="@part.position" tetrahedra="@part.tetrahedra"/>
  <MechanicalObject/>
  <UniformMass totalMass="1"/>
  <TetrahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>
  <FixedConstraint indices="0 5 10 15 20 25 30 35 40"/>
</Node>)"},
    {"MeshBarycentricMapperEngine", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <GenerateGrid name="block" max="0.4 0.1 0.1" resolution="4 2 2"/>
  <MeshTopology position="@block.position" tetrahedra="@block.tetrahedra"/>
  <MechanicalObject/>
  <MeshBarycentricMapperEngine name="place" inputPositions="@block.position" mappedPointPositions="0.11 0.03 0.02"/>
  <BoxROI name="all" box="-1 -1 -1  1 1 1"/>
  <IndexValueMapper name="soft" indices="@all.tetrahedronIndices" value="50000"/>
  <IndexValueMapper name="stiff" inputValues="@soft.outputValues" indices="@place.tableElements" value="1e6"/>
  <UniformMass totalMass="1"/>
  <TetrahedronFEMForceField youngModulus="@stiff.outputValues" poissonRatio="0.3"/>
  <FixedConstraint indices="0 5 10 15 20 25 30 35 40"/>
</Node>)"},
    {"MeshClosingEngine", R"(
<Node name="skin" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <GenerateCylinder name="tube" radius="0.1" height="0.3"/>
  <MeshClosingEngine name="made" inputPosition="@tube.output_TrianglesPosition" inputTriangles="@tube.triangles"/>
  <MeshTopology position="@made.position" triangles="@made.triangles"/>
  <MechanicalObject/>
  <UniformMass totalMass="0.1"/>
  <MeshSpringForceField stiffness="200" damping="0.5"/>
  <FixedConstraint indices="0 1"/>
</Node>)"},
    {"NormalsFromPoints", R"(
<Node name="frames" gravity="0 -9.81 0">
  <EulerExplicitSolver/>
  <GenerateSphere name="ball"/>
  <NormalsFromPoints name="outwards" position="@ball.output_TrianglesPosition" triangles="@ball.triangles"/>
  <Vertex2Frame name="made" position="@ball.output_TrianglesPosition" normals="@outwards.normals"/>
  <MechanicalObject template="Rigid3d" position="@made.frames"/>
  <UniformMass vertexMass="0.1"/>
</Node>)"},
    {"SmoothMeshEngine", R"(
<Node name="skin" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <GenerateSphere name="ball" platonicSolid="octahedron" tessellationDegree="1"/>
  <MeshTopology name="rough" position="@ball.output_TrianglesPosition" triangles="@ball.triangles"/>
  <SmoothMeshEngine name="made" topology="@rough" input_position="@rough.position"/>
  <MeshTopology position="@made.output_position" triangles="@ball.triangles"/>
  <MechanicalObject/>
  <UniformMass totalMass="0.1"/>
  <MeshSpringForceField stiffness="200" damping="0.5"/>
  <FixedConstraint indices="0 1"/>
</Node>)"},
    {"DilateEngine", R"(
<Node name="skin" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <GenerateSphere name="ball"/>
  <DilateEngine name="made" input_position="@ball.output_TrianglesPosition" triangles="@ball.triangles" distance="0.05"/>
  <MeshTopology position="@made.output_position" triangles="@ball.triangles"/>
  <MechanicalObject/>
  <UniformMass totalMass="0.1"/>
  <MeshSpringForceField stiffness="200" damping="0.5"/>
  <FixedConstraint indices="0 1"/>
</Node>)"},
    {"VolumeFromTriangles", R"(
<Node name="skin" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <GenerateSphere name="ball"/>
  <MeshTopology position="@ball.output_TrianglesPosition" triangles="@ball.triangles"/>
  <VolumeFromTriangles name="content"/>
  <MechanicalObject/>
  <UniformMass totalMass="@content.volume"/>
  <MeshSpringForceField stiffness="200" damping="0.5"/>
  <FixedConstraint indices="0 1"/>
</Node>)"},
    {"JoinPoints", R"(
<Node name="drops" gravity="0 -9.81 0">
  <EulerExplicitSolver/>
  <JoinPoints name="drops" points="0 1 0  0.01 1 0  0.5 1 0" distance="0.05"/>
  <MechanicalObject position="@drops.mergedPoints"/>
  <UniformMass vertexMass="0.01"/>
</Node>)"},
    {"MergeMeshes", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <GenerateGrid name="left" max="0.1 0.1 0.1" resolution="1 1 1"/>
  <GenerateGrid name="right" min="0.2 0 0" max="0.3 0.1 0.1" resolution="1 1 1"/>
  <MergeMeshes name="made" nbMeshes="2" position1="@left.position" tetrahedra1="@left.tetrahedra" position2="@right.position"
               tetrahedra2="@right.tetrahedra"/>
  <MeshTopology position="@made.position" tetrahedra="@made.tetrahedra"/>
  <MechanicalObject/>
  <UniformMass totalMass="1"/>
  <TetrahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>
  <FixedConstraint indices="0 1 2 8 9 10"/>
</Node>)"},
    {"MergePoints", R"(
<Node name="drops" gravity="0 -9.81 0">
  <EulerExplicitSolver/>
  <MergePoints name="all" template="Vec3d" position1="0 1 0  0.5 1 0" position2="0 2 0"/>
  <MechanicalObject position="@all.points"/>
  <UniformMass vertexMass="0.01"/>
</Node>)"},
    {"TransformPosition", R"(
<Node name="drops" gravity="0 -9.81 0">
  <EulerExplicitSolver/>
  <TransformPosition name="lifted" method="translation" translation="0 2 0" input_position="0 0 0  1 0 0"/>
  <MechanicalObject position="@lifted.output_position"/>
  <UniformMass vertexMass="0.01"/>
</Node>)"},
    {"ProjectiveTransformEngine", R"(
<Node name="drops" gravity="0 -9.81 0">
  <EulerExplicitSolver/>
  <ProjectiveTransformEngine name="image" input_position="0 1 4  1 1 4" focal_distance="0.5"/>
  <MechanicalObject position="@image.output_position"/>
  <UniformMass vertexMass="0.01"/>
</Node>)"},
    {"TranslateTransformMatrixEngine", R"(
<Node name="skin" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <TranslateTransformMatrixEngine name="placed" translation="0 0.5 0"/>
  <MeshSTLLoader name="cube" filename="data/cube.stl" transformation="@placed.outT"/>
  <MeshTopology src="@cube"/>
  <MechanicalObject src="@cube"/>
  <UniformMass totalMass="0.1"/>
  <MeshSpringForceField stiffness="200" damping="0.5"/>
  <FixedConstraint indices="0 1"/>
</Node>)"},
    {"RotateTransformMatrixEngine", R"(
<Node name="skin" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <RotateTransformMatrixEngine name="placed" rotation="0 0 30"/>
  <MeshSTLLoader name="cube" filename="data/cube.stl" transformation="@placed.outT"/>
  <MeshTopology src="@cube"/>
  <MechanicalObject src="@cube"/>
  <UniformMass totalMass="0.1"/>
  <MeshSpringForceField stiffness="200" damping="0.5"/>
  <FixedConstraint indices="0 1"/>
</Node>)"},
    {"ScaleTransformMatrixEngine", R"(
<Node name="skin" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <ScaleTransformMatrixEngine name="placed" scale="2 1 1"/>
  <MeshSTLLoader name="cube" filename="data/cube.stl" transformation="@placed.outT"/>
  <MeshTopology src="@cube"/>
  <MechanicalObject src="@cube"/>
  <UniformMass totalMass="0.1"/>
  <MeshSpringForceField stiffness="200" damping="0.5"/>
  <FixedConstraint indices="0 1"/>
</Node>)"},
    {"InvertTransformMatrixEngine", R"(
<Node name="skin" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <RotateTransformMatrixEngine name="turned" rotation="0 0 30"/>
  <InvertTransformMatrixEngine name="back" inT="@turned.outT"/>
  <MeshSTLLoader name="cube" filename="data/cube.stl" transformation="@back.outT"/>
  <MeshTopology src="@cube"/>
  <MechanicalObject src="@cube"/>
  <UniformMass totalMass="0.1"/>
  <MeshSpringForceField stiffness="200" damping="0.5"/>
  <FixedConstraint indices="0 1"/>
</Node>)"},
    {"Vertex2Frame", R"(
<Node name="frames" gravity="0 -9.81 0">
  <EulerExplicitSolver/>
  <MeshSTLLoader name="cube" filename="data/cube.stl"/>
  <Vertex2Frame name="made" position="@cube.position" normals="@cube.normals"/>
  <MechanicalObject template="Rigid3d" position="@made.frames"/>
  <UniformMass vertexMass="0.1"/>
</Node>)"},
    {"QuatToRigidEngine", R"(
<Node name="frames" gravity="0 -9.81 0">
  <EulerExplicitSolver/>
  <QuatToRigidEngine name="made" positions="0 1 0  1 1 0" orientations="0 0 0.6 0.8"/>
  <MechanicalObject template="Rigid3d" position="@made.rigids"/>
  <UniformMass vertexMass="0.1"/>
</Node>)"},
    {"RigidToQuatEngine", R"(
<Node name="centres" gravity="0 -9.81 0">
  <EulerExplicitSolver/>
  <RigidToQuatEngine name="parts" rigids="0 1 0  0 0 0.6 0.8"/>
  <MechanicalObject position="@parts.positions"/>
  <UniformMass vertexMass="0.1"/>
</Node>)"},
    {"DisplacementMatrixEngine", R"(
<Node name="frames" gravity="0 -9.81 0">
  <EulerExplicitSolver/>
  <DisplacementMatrixEngine name="moved" x0="0 0 0  0 0 0 1" x="0 1 0  0 0 0.6 0.8"/>
  <MechanicalObject template="Rigid3d" position="@moved.x"/>
  <UniformMass vertexMass="0.1"/>
</Node>)"},
    {"MeshSubdivision", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <MeshGmshLoader name="coarse" filename="data/beam.msh"/>
  <MeshSubdivision name="fine" src="@coarse" levels="1"/>
  <MeshTopology src="@fine"/>
  <MechanicalObject src="@fine"/>
  <DiagonalMass massDensity="1"/>
  <TetrahedronFEMForceField youngModulus="3000" poissonRatio="0.3"/>
  <FixedConstraint indices="0 1 2"/>
</Node>)"},
    {"TransformEngine", R"(
<Node name="ball" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <MeshOBJLoader name="ball" filename="data/ball.obj"/>
  <TransformEngine name="placed" input_position="@ball.position" translation="6 1 0" rotation="0 0 45"
                   scale="0.5 1 0.5"/>
  <MeshTopology triangles="@ball.triangles"/>
  <MechanicalObject position="@placed.output_position"/>
  <UniformMass totalMass="1"/>
  <MeshSpringForceField stiffness="50" damping="0.5"/>
</Node>)"},
});

}  // namespace

std::span<ClassExample const> examples_of_meshes() { return examples; }

}  // namespace cli
