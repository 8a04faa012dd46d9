// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace cli {

enum class Place { instead, beside };

/// What stands in the scene for a class: `scene` and `standIn` are those of its role where they are empty; a
/// scene without a stand-in is shown as it is.
struct ClassExample {
  std::string_view name, xml{}, scene{}, standIn{};
  Place place = Place::instead;
};

// contexts, topologies, states, visual models and masses
std::span<ClassExample const> examples_of_bodies();
// forces of elements
std::span<ClassExample const> examples_of_elements();
// springs
std::span<ClassExample const> examples_of_springs();
// forces on points and surfaces
std::span<ClassExample const> examples_of_loads();
// fluids
std::span<ClassExample const> examples_of_fluids();
// projective constraints, and what they follow
std::span<ClassExample const> examples_of_constraints();
// mappings
std::span<ClassExample const> examples_of_mappings();
// solvers in time and linear solvers
std::span<ClassExample const> examples_of_solvers();
// engines that select points and elements, and compute values
std::span<ClassExample const> examples_of_selections();
// engines that load and generate meshes
std::span<ClassExample const> examples_of_sources();
// engines that change points and meshes
std::span<ClassExample const> examples_of_meshes();
// topological mappings
std::span<ClassExample const> examples_of_topological_mappings();
// collision models and stages, and what changes topologies
std::span<ClassExample const> examples_of_collision();
// constraints by multipliers and what solves them
std::span<ClassExample const> examples_of_lagrangian();

// Whole scenes, each a body as users compose it. A component takes the place of the element that stands for
// its role, or stands beside it.
inline constexpr std::string_view softBody = R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <SparseLDLSolver/>
  <RegularGridTopology n="5 3 3" max="0.4 0.1 0.1"/>
  <MechanicalObject/>
  <UniformMass totalMass="4"/>
  <TetrahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>
  <FixedConstraint indices="0 5 10 15 20 25 30 35 40"/>
</Node>)";
inline constexpr std::string_view sheet = R"(
<Node name="sheet" gravity="0 0 -9.81">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <RegularGridTopology n="5 5 1" max="1 1 0"/>
  <MechanicalObject/>
  <UniformMass totalMass="0.2"/>
  <TriangleFEMForceField youngModulus="5000" poissonRatio="0.3" thickness="0.01"/>
  <FixedConstraint indices="20 24"/>
</Node>)";
inline constexpr std::string_view chain = R"(
<Node name="chain" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <SparseLDLSolver/>
  <MechanicalObject position="0 0 0  0.5 0 0  1 0 0"/>
  <UniformMass vertexMass="0.1"/>
  <StiffSpringForceField spring="0 1 100 0.1 0.5  1 2 100 0.1 0.5"/>
  <FixedConstraint indices="0"/>
</Node>)";
inline constexpr std::string_view beams = R"(
<Node name="hose" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <SparseLDLSolver template="CompressedRowSparseMatrixd"/>
  <RegularGridTopology n="6 1 1" max="1 0 0"/>
  <MechanicalObject template="Rigid3d"/>
  <BeamMass massDensity="1100" radius="0.01"/>
  <BeamFEMForceField youngModulus="1e7" poissonRatio="0.45" radius="0.01"/>
  <FixedConstraint indices="0"/>
</Node>)";
inline constexpr std::string_view rod = R"(
<Node name="rod" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <SparseLDLSolver template="CompressedRowSparseMatrixd"/>
  <RegularGridTopology n="6 1 1" max="1 0 0"/>
  <MechanicalObject template="Rigid3d"/>
  <BeamInterpolation name="beams" radius="0.01" defaultYoungModulus="1e7"/>
  <AdaptiveBeamForceField interpolation="@beams.beams"/>
  <AdaptiveBeamMass interpolation="@beams.beams" massDensity="1100"/>
  <FixedConstraint indices="0"/>
  <Node name="line">
    <MechanicalObject/>
    <AdaptiveBeamMapping interpolation="@../beams.beams" points="0 0 0  0.25 0 0  0.5 0 0  0.75 0 0  1 0 0"/>
  </Node>
</Node>)";
inline constexpr std::string_view guideWire = R"(
<Node name="wire">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <SparseLDLSolver template="CompressedRowSparseMatrixd"/>
  <RodStraightSection name="shaft" length="0.1" youngModulus="1e9" massDensity="6000" radius="0.0005" nbBeams="5"/>
  <RodSpireSection name="tip" length="0.04" youngModulus="1e9" massDensity="6000" radius="0.0005" nbBeams="4"
                   spireDiameter="0.04" spireHeight="0"/>
  <WireRestShape name="shape" wireMaterials="@shaft @tip"/>
  <WireBeamInterpolation name="beams" wireRestShape="@shape.beams"/>
  <MechanicalObject template="Rigid3d" position="@shape.frames"/>
  <AdaptiveBeamForceField interpolation="@beams.beams"/>
  <AdaptiveBeamMass interpolation="@beams.beams"/>
  <InterventionalRadiologyController instruments="@beams.beams" startingPos="0 0 0  0 0 0 1" speed="0.05"/>
</Node>)";
// a body that keeps its shape without elements
inline constexpr std::string_view jelly = R"(
<Node name="jelly" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <CGLinearSolver iterations="25" tolerance="1e-8"/>
  <RegularGridTopology n="5 3 3" max="0.4 0.1 0.1"/>
  <MechanicalObject/>
  <UniformMass totalMass="4"/>
  <PlaneForceField normal="0 1 0" d="-0.05" stiffness="500"/>
  <ClusteringEngine name="clustering" number="4" radius="0.15"/>
  <ShapeMatching name="matching" cluster="@clustering.cluster"/>
  <PositionBasedDynamicsProjectiveConstraint stiffness="0.3" position="@matching.targetPosition"/>
</Node>)";
// a soft body with a stiff one in it, in few hexahedra
inline constexpr std::string_view composite = R"(
<Node name="fruit" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <SparseGridMultipleTopology n="4 4 4" nbVirtualFinerLevels="2" finestConnectivity="false" stiffnessCoefs="1 100"
                              massCoefs="1 2" fileTopologies="data/ball.obj data/organ.obj"/>
  <MechanicalObject/>
  <HexahedronCompositeFEMForceField youngModulus="500000" poissonRatio="0.3"/>
  <HexahedronCompositeFEMMass massDensity="1000" poissonRatio="0.3"/>
  <FixedConstraint indices="0 1 2"/>
  <Node name="stone">
    <MeshOBJLoader name="surface" filename="data/organ.obj"/>
    <VisualModel src="@surface"/>
    <HexahedronCompositeFEMMapping poissonRatio="0.3"/>
  </Node>
</Node>)";
// a body that another one follows
inline constexpr std::string_view carrier = R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <SparseLDLSolver/>
  <RegularGridTopology n="5 3 3" max="0.4 0.1 0.1"/>
  <MechanicalObject/>
  <UniformMass totalMass="4"/>
  <TetrahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>
  <FixedConstraint indices="0 5 10 15 20 25 30 35 40"/>
  <Node name="inside">
    <MechanicalObject position="0.35 0.05 0.05"/>
    <BarycentricMapping/>
    <ConstantForceField force="0 0 2"/>
  </Node>
</Node>)";
inline constexpr std::string_view waterWithSurface = R"(
<Node name="water" gravity="0 -10 0">
  <EulerExplicitSolver symplectic="true"/>
  <RegularGridTopology n="5 10 5" max="2 4.5 2" computeHexaList="false" computeQuadList="false"
                       computeTriangleList="false" computeEdgeList="false"/>
  <MechanicalObject/>
  <UniformMass vertexMass="1"/>
  <SPHFluidForceField radius="0.745" density="15" pressure="1000" viscosity="10" kernelType="1" viscosityType="2"/>
  <PlaneForceField normal="0 1 0" d="-1"/>
  <Node name="surface">
    <VisualModel/>
    <SPHFluidSurfaceMapping radius="0.745" step="0.25"/>
  </Node>
</Node>)";
inline constexpr std::string_view waterInTank = R"(
<Node name="root" gravity="0 -9.81 0">
  <Node name="water">
    <DFSPHSolver radius="0.1" density="1000"/>
    <RegularGridTopology n="4 4 4" min="0.025 0.025 0.025" max="0.175 0.175 0.175" computeHexaList="false"
                         computeQuadList="false" computeTriangleList="false" computeEdgeList="false"/>
    <MechanicalObject/>
    <UniformMass vertexMass="0.125"/>
  </Node>
  <Node name="tank">
    <CubeTopology name="walls" min="-0.025 -0.025 -0.025" max="0.225 0.425 0.225"/>
    <SurfaceSampling position="@walls.position" quads="@walls.quads" spacing="0.05"/>
    <MechanicalObject/>
    <FluidBoundary/>
  </Node>
</Node>)";
inline constexpr std::string_view boxInPool = R"(
<Node name="root" gravity="0 -9.81 0">
  <Node name="pool">
    <Fluid3D nx="18" ny="18" nz="18" cellwidth="0.0625" height="10"/>
  </Node>
  <Node name="box">
    <EulerExplicitSolver/>
    <MechanicalObject template="Rigid3d" position="0 0.1 0 0 0 0 1"/>
    <UniformMass vertexMass="14 1  0.015 0 0  0 0.015 0  0 0 0.015"/>
    <Node name="surface">
      <CubeTopology min="-0.15 -0.15 -0.15" max="0.15 0.15 0.15"/>
      <MechanicalObject template="Vec3d"/>
      <RigidMapping/>
      <ImmersedSolid/>
    </Node>
  </Node>
</Node>)";
inline constexpr std::string_view namedBlock = R"(
<Node name="block" gravity="0 0 -9.81">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <SparseLDLSolver/>
  <RegularGridTopology name="grid" n="3 2 2" max="0.2 0.1 0.1"/>
  <MechanicalObject/>
  <UniformMass totalMass="2"/>
  <HexahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>
  <FixedConstraint indices="0 3 6 9"/>
  <Node name="cut">
    <MeshTopology name="large"/>
    <Hexa2TetraTopologicalMapping input="@../grid" output="@large"/>
  </Node>
  <HERE/>
</Node>)";
inline constexpr std::string_view contact = R"(
<Node name="root" gravity="0 -9.81 0">
  <DefaultPipeline/>
  <BruteForceBroadPhase/>
  <BVHNarrowPhase/>
  <MinProximityIntersection alarmDistance="0.05" contactDistance="0.01"/>
  <DefaultContactManager/>
  <Node name="floor">
    <MeshTopology triangles="0 1 2  0 2 3"/>
    <MechanicalObject position="-1 0 1  1 0 1  1 0 -1  -1 0 -1"/>
    <TriangleCollisionModel moving="false" simulated="false" contactStiffness="100"/>
  </Node>
  <Node name="balls">
    <EulerImplicitSolver/>
    <CGLinearSolver iterations="50" tolerance="1e-8"/>
    <MechanicalObject position="0 0.12 0  0.3 0.12 0"/>
    <UniformMass vertexMass="0.5"/>
    <SphereCollisionModel radius="0.1" contactStiffness="20"/>
  </Node>
</Node>)";
inline constexpr std::string_view multipliers = R"(
<Node name="root" gravity="0 -9.81 0">
  <FreeMotionAnimationLoop/>
  <BlockGaussSeidelConstraintSolver maxIterations="1000" tolerance="1e-8"/>
  <Node name="chain">
    <EulerImplicitSolver/>
    <SparseLDLSolver/>
    <MechanicalObject position="0 0 0  0.5 0 0  1 0 0"/>
    <UniformMass vertexMass="0.1"/>
    <StiffSpringForceField spring="0 1 100 0.1 0.5  1 2 100 0.1 0.5"/>
    <FixedLagrangianConstraint indices="0"/>
  </Node>
</Node>)";
inline constexpr std::string_view friction = R"(
<Node name="root" gravity="0 -9.81 0">
  <FreeMotionAnimationLoop/>
  <BlockGaussSeidelConstraintSolver maxIterations="1000" tolerance="1e-8"/>
  <DefaultPipeline/>
  <BruteForceBroadPhase/>
  <BVHNarrowPhase/>
  <MinProximityIntersection alarmDistance="0.05" contactDistance="0.01"/>
  <DefaultContactManager response="FrictionContactConstraint" responseParams="mu=0.5"/>
  <Node name="floor">
    <MeshTopology triangles="0 1 2  0 2 3"/>
    <MechanicalObject position="-1 0 1  1 0 1  1 0 -1  -1 0 -1"/>
    <TriangleCollisionModel moving="false" simulated="false"/>
  </Node>
  <Node name="block">
    <EulerImplicitSolver/>
    <SparseLDLSolver/>
    <RegularGridTopology n="3 3 3" min="-0.1 0.02 -0.1" max="0.1 0.22 0.1"/>
    <MechanicalObject/>
    <UniformMass totalMass="8"/>
    <HexahedronFEMForceField youngModulus="100000" poissonRatio="0.3"/>
    <PointCollisionModel/>
  </Node>
</Node>)";
inline constexpr std::string_view parts = R"(
<Node name="root" gravity="0 -9.81 0" dt="0.02">
  <MultiStepAnimationLoop collisionSteps="2" integrationSteps="5"/>
  <DefaultPipeline/>
  <BruteForceBroadPhase/>
  <BVHNarrowPhase/>
  <MinProximityIntersection alarmDistance="0.05" contactDistance="0.01"/>
  <DefaultContactManager/>
  <Node name="floor">
    <MeshTopology triangles="0 1 2  0 2 3"/>
    <MechanicalObject position="-1 0 1  1 0 1  1 0 -1  -1 0 -1"/>
    <TriangleCollisionModel moving="false" simulated="false" contactStiffness="500"/>
  </Node>
  <Node name="ball">
    <EulerExplicitSolver/>
    <MechanicalObject position="0 0.12 0"/>
    <UniformMass vertexMass="0.1"/>
    <SphereCollisionModel radius="0.05" contactStiffness="500"/>
  </Node>
</Node>)";

}  // namespace cli
