// SPDX-License-Identifier: BSL-1.0
#include "reference_examples.hpp"

namespace cli {

namespace {

constexpr auto examples = std::to_array<ClassExample>({
    {"GenerateGrid", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <GenerateGrid name="made" max="0.4 0.1 0.1" resolution="4 2 2"/>
  <MeshTopology position="@made.position" hexahedra="@made.hexahedra"/>
  <MechanicalObject/>
  <UniformMass totalMass="1"/>
  <HexahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>
  <FixedConstraint indices="0 5 10 15 20 25 30 35 40"/>
</Node>)"},
    {"GenerateCylinder", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <GenerateCylinder name="made" radius="0.1" height="0.4" resHeight="5"/>
  <MeshTopology position="@made.position" tetrahedra="@made.tetrahedra"/>
  <MechanicalObject/>
  <UniformMass totalMass="1"/>
  <TetrahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>
  <FixedConstraint indices="0 1 2"/>
</Node>)"},
    {"GenerateSphere", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <GenerateSphere name="made" radius="0.1" tessellationDegree="3"/>
  <MeshTopology position="@made.position" tetrahedra="@made.tetrahedra"/>
  <MechanicalObject/>
  <UniformMass totalMass="1"/>
  <TetrahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>
  <FixedConstraint indices="1 2 3"/>
</Node>)"},
    {"MeshTetraStuffing", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <MeshSTLLoader name="cube" filename="data/cube.stl" scale3d="0.4 0.2 0.2"/>
  <MeshTetraStuffing name="made" size="0.08" inputPoints="@cube.position" inputTriangles="@cube.triangles" snapPoints="1"
                     splitTetrahedra="1"/>
  <MeshTopology position="@made.outputPoints" tetrahedra="@made.outputTetrahedra"/>
  <MechanicalObject/>
  <UniformMass totalMass="1"/>
  <TetrahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>
  <FixedConstraint indices="0 1 2"/>
</Node>)"},
    {"ExtrudeQuadsAndGenerateHexas", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <GridMeshCreator name="grid" resolution="5 3" trianglePattern="0" scale3d="0.4 0.2 1"/>
  <ExtrudeQuadsAndGenerateHexas name="made" surfaceVertices="@grid.position" surfaceQuads="@grid.quads" thicknessOut="0.1"
                                numberOfSlices="2" flipNormals="1"/>
  <MeshTopology position="@made.extrudedVertices" hexahedra="@made.extrudedHexas"/>
  <MechanicalObject/>
  <UniformMass totalMass="1"/>
  <HexahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>
  <FixedConstraint indices="0 1 2"/>
</Node>)"},
    {"ExtrudeSurface", R"(
<Node name="skin" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <GridMeshCreator name="grid" resolution="5 3"/>
  <ExtrudeSurface name="made" surfaceVertices="@grid.position" triangles="@grid.triangles" surfaceTriangles="0-15"
                  heightFactor="0.1"/>
  <MeshTopology position="@made.extrusionVertices" triangles="@made.extrusionTriangles"/>
  <MechanicalObject/>
  <UniformMass totalMass="0.1"/>
  <MeshSpringForceField stiffness="200" damping="0.5"/>
  <FixedConstraint indices="0 1"/>
</Node>)"},
    {"ExtrudeEdgesAndGenerateQuads", R"(
<Node name="skin" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <StringMeshCreator name="line" resolution="5"/>
  <ExtrudeEdgesAndGenerateQuads name="made" curveVertices="@line.position" curveEdges="@line.edges"
                                extrudeDirection="0 0 1" numberOfSections="3"/>
  <MeshTopology position="@made.extrudedVertices" quads="@made.extrudedQuads"/>
  <MechanicalObject/>
  <UniformMass totalMass="0.1"/>
  <MeshSpringForceField stiffness="200" damping="0.5"/>
  <FixedConstraint indices="0 1"/>
</Node>)"},
    {"Spiral", R"(
<Node name="skin" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <GridMeshCreator name="grid" resolution="21 3" scale3d="2 0.2 1" translation="0.2 0 0" rotation="90 0 0"/>
  <Spiral name="made" rest_position="@grid.position"/>
  <MeshTopology position="@made.position" triangles="@grid.triangles"/>
  <MechanicalObject/>
  <UniformMass totalMass="0.1"/>
  <MeshSpringForceField stiffness="200" damping="0.5"/>
  <FixedConstraint indices="0 1"/>
</Node>)"},
    {"RandomPointDistributionInSurface", R"(
<Node name="cloud" gravity="0 -9.81 0">
  <EulerExplicitSolver/>
  <GenerateSphere name="ball" radius="0.5" tessellationDegree="3"/>
  <RandomPointDistributionInSurface name="grains" vertices="@ball.output_TrianglesPosition" triangles="@ball.triangles"
                                    numberOfInPoints="20"/>
  <MechanicalObject position="@grains.inPoints"/>
  <UniformMass vertexMass="0.01"/>
</Node>)"},
    {"MeshOffLoader", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <MeshOffLoader name="mesh" filename="data/tent.off"/>
  <MeshTopology src="@mesh"/>
  <MechanicalObject src="@mesh"/>
  <UniformMass totalMass="0.1"/>
  <MeshSpringForceField stiffness="200" damping="0.5"/>
  <FixedConstraint indices="0 1"/>
</Node>)"},
    {"MeshPLYLoader", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <MeshPLYLoader name="mesh" filename="data/roof.ply"/>
  <MeshTopology src="@mesh"/>
  <MechanicalObject src="@mesh"/>
  <UniformMass totalMass="0.1"/>
  <MeshSpringForceField stiffness="200" damping="0.5"/>
  <FixedConstraint indices="0 1"/>
</Node>)"},
    {"GIDMeshLoader", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <GIDMeshLoader name="mesh" filename="data/wedge.gidmsh"/>
  <MeshTopology src="@mesh"/>
  <MechanicalObject src="@mesh"/>
  <UniformMass totalMass="1"/>
  <TetrahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>
  <FixedConstraint indices="0 1 2"/>
</Node>)"},
    {"MeshTrianLoader", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <MeshTrianLoader name="mesh" filename="data/sail.trian"/>
  <MeshTopology src="@mesh"/>
  <MechanicalObject src="@mesh"/>
  <UniformMass totalMass="0.1"/>
  <MeshSpringForceField stiffness="200" damping="0.5"/>
  <FixedConstraint indices="0 1"/>
</Node>)"},
    {"VoxelGridLoader", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <VoxelGridLoader name="mesh" filename="data/letter.raw" resolution="4 4 2" voxelSize="0.1 0.1 0.1" bgValue="0"/>
  <MeshTopology src="@mesh"/>
  <MechanicalObject src="@mesh"/>
  <UniformMass totalMass="1"/>
  <HexahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>
  <FixedConstraint indices="0 1 2"/>
</Node>)"},
    {"BeamInterpolation", "", rod, ""},
    {"RodSpireSection", R"(
<Node name="wire">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <SparseLDLSolver template="CompressedRowSparseMatrixd"/>
  <RodSpireSection name="piece" length="0.3" youngModulus="1e9" massDensity="6000" radius="0.0005" nbBeams="24"
                   spireDiameter="0.04" spireHeight="0.01"/>
  <WireRestShape name="shape" wireMaterials="@piece.section"/>
  <MechanicalObject template="Rigid3d" position="@shape.frames"/>
  <AdaptiveBeamForceField interpolation="@shape.beams"/>
  <AdaptiveBeamMass interpolation="@shape.beams"/>
  <FixedConstraint indices="0"/>
</Node>)"},
    {"RodStraightSection", R"(
<Node name="wire">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <SparseLDLSolver template="CompressedRowSparseMatrixd"/>
  <RodStraightSection name="piece" length="0.1" youngModulus="1e9" massDensity="6000" radius="0.0005" nbBeams="5"/>
  <WireRestShape name="shape" wireMaterials="@piece.section"/>
  <MechanicalObject template="Rigid3d" position="@shape.frames"/>
  <AdaptiveBeamForceField interpolation="@shape.beams"/>
  <AdaptiveBeamMass interpolation="@shape.beams"/>
  <FixedConstraint indices="0"/>
</Node>)"},
    {"WireBeamInterpolation", "", guideWire, ""},
    {"WireRestShape", "", guideWire, ""},
    {"GenerateRigidMass", R"(
<Node name="brick" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <CGLinearSolver iterations="50" tolerance="1e-8"/>
  <MeshSTLLoader name="cube" filename="data/cube.stl" scale3d="1 0.5 0.25"/>
  <GenerateRigidMass name="inside" density="1000" position="@cube.position" triangles="@cube.triangles"/>
  <MechanicalObject template="Rigid3d" position="0 1 0  0 0 0 1" velocity="0 0 0  0 5 1"/>
  <UniformMass vertexMass="@inside.rigidMass"/>
</Node>)"},
    {"GridMeshCreator",
     R"(
<GridMeshCreator name="grid" resolution="6 6" trianglePattern="1"/>
<MeshTopology src="@grid"/>
<MechanicalObject src="@grid"/>)",
     R"(
<Node name="sheet" gravity="0 0 -9.81">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <HERE/>
  <UniformMass totalMass="0.2"/>
  <TriangleFEMForceField youngModulus="5000" poissonRatio="0.3" thickness="0.01"/>
  <FixedConstraint indices="0 5"/>
</Node>)",
     "HERE"},
    {"StringMeshCreator", R"(
<Node name="string" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <SparseLDLSolver/>
  <StringMeshCreator name="line" resolution="10"/>
  <MeshTopology src="@line"/>
  <MechanicalObject src="@line"/>
  <UniformMass totalMass="0.1"/>
  <MeshSpringForceField stiffness="100" damping="0.1"/>
  <FixedConstraint indices="0"/>
</Node>)"},
    {"MeshGmshLoader", R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <MeshGmshLoader name="beam" filename="data/beam.msh"/>
  <MeshTopology src="@beam"/>
  <MechanicalObject src="@beam"/>
  <DiagonalMass massDensity="1"/>
  <TetrahedronFEMForceField youngModulus="3000" poissonRatio="0.3"/>
  <FixedConstraint indices="0 1 2"/>
</Node>)"},
    {"MeshVTKLoader", R"(
<Node name="tower" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <MeshVTKLoader name="mesh" filename="data/tower.vtk"/>
  <MeshTopology src="@mesh"/>
  <MechanicalObject src="@mesh"/>
  <UniformMass totalMass="1"/>
  <HexahedronFEMForceField youngModulus="500" poissonRatio="0.3"/>
  <FixedConstraint indices="0 1 2 3"/>
</Node>)"},
    {"MeshOBJLoader",
     R"(
<Node name="skin">
  <MeshOBJLoader name="surface" filename="data/ball.obj" scale="0.05" translation="0.2 0.05 0.05"/>
  <VisualModel src="@surface"/>
  <BarycentricMapping/>
</Node>)",
     softBody,
     "FixedConstraint",
     Place::beside},
    {"MeshSTLLoader",
     R"(
<Node name="skin">
  <MeshSTLLoader name="surface" filename="data/cube.stl" scale3d="0.4 0.1 0.1"/>
  <VisualModel src="@surface"/>
  <BarycentricMapping/>
</Node>)",
     softBody,
     "FixedConstraint",
     Place::beside},
    {"SphereLoader", R"(
<Node name="root" gravity="0 -9.81 0">
  <DefaultPipeline/>
  <BruteForceBroadPhase/>
  <BVHNarrowPhase/>
  <MinProximityIntersection alarmDistance="0.1" contactDistance="0.02"/>
  <DefaultContactManager/>
  <Node name="balls">
    <EulerImplicitSolver/>
    <CGLinearSolver iterations="50" tolerance="1e-8"/>
    <SphereLoader name="spheres" filename="data/beam.sph"/>
    <MechanicalObject position="@spheres.position"/>
    <UniformMass vertexMass="0.1"/>
    <SphereCollisionModel listRadius="@spheres.listRadius" selfCollision="true"/>
  </Node>
</Node>)"},
});

}  // namespace

std::span<ClassExample const> examples_of_sources() { return examples; }

}  // namespace cli
