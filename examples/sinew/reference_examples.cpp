// SPDX-License-Identifier: BSL-1.0
#include "reference.hpp"

#include <algorithm>

namespace cli {

using sinew::text;

namespace {

// Whole scenes, each a body as users compose it. A component takes the place of the element that stands for
// its role, or stands beside it.
constexpr std::string_view softBody = R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <SparseLDLSolver/>
  <RegularGridTopology n="5 3 3" max="0.4 0.1 0.1"/>
  <MechanicalObject/>
  <UniformMass totalMass="4"/>
  <TetrahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>
  <FixedConstraint indices="0 5 10 15 20 25 30 35 40"/>
</Node>)";
constexpr std::string_view sheet = R"(
<Node name="sheet" gravity="0 0 -9.81">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <RegularGridTopology n="5 5 1" max="1 1 0"/>
  <MechanicalObject/>
  <UniformMass totalMass="0.2"/>
  <TriangleFEMForceField youngModulus="5000" poissonRatio="0.3" thickness="0.01"/>
  <FixedConstraint indices="20 24"/>
</Node>)";
constexpr std::string_view chain = R"(
<Node name="chain" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <SparseLDLSolver/>
  <MechanicalObject position="0 0 0  0.5 0 0  1 0 0"/>
  <UniformMass vertexMass="0.1"/>
  <StiffSpringForceField spring="0 1 100 0.1 0.5  1 2 100 0.1 0.5"/>
  <FixedConstraint indices="0"/>
</Node>)";
constexpr std::string_view beams = R"(
<Node name="hose" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <SparseLDLSolver template="CompressedRowSparseMatrixd"/>
  <RegularGridTopology n="6 1 1" max="1 0 0"/>
  <MechanicalObject template="Rigid3d"/>
  <BeamMass massDensity="1100" radius="0.01"/>
  <BeamFEMForceField youngModulus="1e7" poissonRatio="0.45" radius="0.01"/>
  <FixedConstraint indices="0"/>
</Node>)";
constexpr std::string_view rod = R"(
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
constexpr std::string_view guideWire = R"(
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
constexpr std::string_view jelly = R"(
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
constexpr std::string_view composite = R"(
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
constexpr std::string_view carrier = R"(
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
constexpr std::string_view waterWithSurface = R"(
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
constexpr std::string_view waterInTank = R"(
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
constexpr std::string_view boxInPool = R"(
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
constexpr std::string_view namedBlock = R"(
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
constexpr std::string_view contact = R"(
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
constexpr std::string_view multipliers = R"(
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
constexpr std::string_view friction = R"(
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
constexpr std::string_view parts = R"(
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

/// f(line) for each line of a text but the empty one at its beginning.
template <class F>
void each_line(std::string_view all, F&& f) {
  while (!all.empty()) {
    const std::size_t end = std::min(all.find('\n'), all.size());
    if (end > 0) f(all.substr(0, end));
    all.remove_prefix(std::min(end + 1, all.size()));
  }
}

enum class Place { instead, beside };

/// What a component of a role looks like where its class says nothing else.
struct RoleExample {
  sinew::RoleKind role;
  std::string_view scene, standIn;
  Place place = Place::instead;
};
constexpr auto roleExamples = std::to_array<RoleExample>(
    {{sinew::RoleKind::topology, softBody, "RegularGridTopology"},
     {sinew::RoleKind::mass, softBody, "UniformMass"},
     {sinew::RoleKind::forceField, softBody, "TetrahedronFEMForceField"},
     {sinew::RoleKind::projectiveConstraint, softBody, "FixedConstraint"},
     {sinew::RoleKind::mapping, carrier, "BarycentricMapping"},
     {sinew::RoleKind::odeSolver, softBody, "EulerImplicitSolver"},
     {sinew::RoleKind::linearSolver, softBody, "SparseLDLSolver"},
     {sinew::RoleKind::engine, softBody, "FixedConstraint"},
     {sinew::RoleKind::collisionPipeline, contact, "DefaultPipeline"},
     {sinew::RoleKind::broadPhase, contact, "BruteForceBroadPhase"},
     {sinew::RoleKind::narrowPhase, contact, "BVHNarrowPhase"},
     {sinew::RoleKind::intersection, contact, "MinProximityIntersection"},
     {sinew::RoleKind::contactManager, contact, "DefaultContactManager"},
     {sinew::RoleKind::collisionModel, contact, "SphereCollisionModel"},
     {sinew::RoleKind::stepDivision, parts, "MultiStepAnimationLoop"},
     {sinew::RoleKind::animationLoop, friction, "FreeMotionAnimationLoop"},
     {sinew::RoleKind::lagrangianConstraint, multipliers, "FixedLagrangianConstraint"},
     {sinew::RoleKind::constraintSolver, friction, "BlockGaussSeidelConstraintSolver"},
     {sinew::RoleKind::constraintCorrection, friction, "SparseLDLSolver", Place::beside}});

/// What stands in the scene for a class: `scene` and `standIn` are those of its role where they are empty; a
/// scene without a stand-in is shown as it is.
struct ClassExample {
  std::string_view name, xml{}, scene{}, standIn{};
  Place place = Place::instead;
};
constexpr auto classExamples = std::to_array<ClassExample>({
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

    {"AngularSpringForceField", R"(
<Node name="shaft">
  <EulerImplicitSolver/>
  <SparseLDLSolver template="CompressedRowSparseMatrixd"/>
  <MechanicalObject template="Rigid3d" position="0 0 0  0 0 0 1   0.2 0 0  0 0 0 1   0.4 0 0  0 0 0 1"
                    velocity="0 0 0  10 0 0   0 0 0  0 0 0   0 0 0  0 0 0"/>
  <UniformMass vertexMass="1 1  0.02 0 0  0 0.01 0  0 0 0.01"/>
  <AngularSpringForceField indices="0 1 2" angularStiffness="5"/>
</Node>)"},
    {"AdaptiveBeamForceField", "", rod, ""},
    {"BeamFEMForceField", "", beams, ""},
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
    {"HexahedronFEMForceField", R"(<HexahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>)"},
    {"HexahedronCompositeFEMForceField", "", composite, ""},
    {"PrismFEMForceField",
     R"(<PrismFEMForceField youngModulus="5000" poissonRatio="0.3"/>)",
     R"(
<Node name="wedge" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <SparseLDLSolver/>
  <MeshTopology prisms="0 1 2  3 4 5  3 4 5  6 7 8"/>
  <MechanicalObject position="0 0 0  0.1 0 0  0 0.1 0   0 0 0.1  0.1 0 0.1  0 0.1 0.1   0 0 0.2  0.1 0 0.2  0 0.1 0.2"/>
  <MeshMatrixMass massDensity="1000"/>
  <FixedConstraint indices="0 1 2"/>
  <HERE/>
</Node>)",
     "HERE"},
    {"PyramidFEMForceField",
     R"(<PyramidFEMForceField youngModulus="5000" poissonRatio="0.3"/>)",
     R"(
<Node name="cube" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <SparseLDLSolver/>
  <MeshTopology pyramids="0 1 2 3 8  7 6 5 4 8  0 4 5 1 8  1 5 6 2 8  2 6 7 3 8  3 7 4 0 8"/>
  <MechanicalObject position="0 0 0  0.1 0 0  0.1 0.1 0  0 0.1 0   0 0 0.1  0.1 0 0.1  0.1 0.1 0.1  0 0.1 0.1   0.05 0.05 0.05"/>
  <MeshMatrixMass massDensity="1000"/>
  <FixedConstraint indices="2 3 6 7"/>
  <HERE/>
</Node>)",
     "HERE"},
    {"QuadraticTetrahedronFEMForceField",
     R"(<QuadraticTetrahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>)",
     R"(
<Node name="wedge" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <SparseLDLSolver/>
  <MeshTopology quadraticTetrahedra="0 1 2 3 4 5 6 7 8 9"/>
  <MechanicalObject position="0 0 0  0.1 0 0  0 0.1 0  0 0 0.1  0.05 0 0
                              0.05 0.05 0  0 0.05 0  0 0 0.05  0.05 0 0.05  0 0.05 0.05"/>
  <MeshMatrixMass massDensity="1000"/>
  <FixedConstraint indices="0 1 2 4 5 6"/>
  <HERE/>
</Node>)",
     "HERE"},
    {"QuadraticHexahedronFEMForceField",
     R"(<QuadraticHexahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>)",
     R"(
<Node name="cube" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <SparseLDLSolver/>
  <MeshTopology quadraticHexahedra="0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19"/>
  <MechanicalObject position="0 0 0  0.1 0 0  0.1 0.1 0  0 0.1 0  0 0 0.1
                              0.1 0 0.1  0.1 0.1 0.1  0 0.1 0.1  0.05 0 0  0.1 0.05 0
                              0.05 0.1 0  0 0.05 0  0.05 0 0.1  0.1 0.05 0.1  0.05 0.1 0.1
                              0 0.05 0.1  0 0 0.05  0.1 0 0.05  0.1 0.1 0.05  0 0.1 0.05"/>
  <DiagonalMass massDensity="1000"/>
  <FixedConstraint indices="0 1 2 3 8 9 10 11"/>
  <HERE/>
</Node>)",
     "HERE"},
    {"TriquadraticHexahedronFEMForceField",
     R"(<TriquadraticHexahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>)",
     R"(
<Node name="cube" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <SparseLDLSolver/>
  <MeshTopology triquadraticHexahedra="0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26"/>
  <MechanicalObject position="0 0 0  0.1 0 0  0.1 0.1 0  0 0.1 0  0 0 0.1
                              0.1 0 0.1  0.1 0.1 0.1  0 0.1 0.1  0.05 0 0  0.1 0.05 0
                              0.05 0.1 0  0 0.05 0  0.05 0 0.1  0.1 0.05 0.1  0.05 0.1 0.1
                              0 0.05 0.1  0 0 0.05  0.1 0 0.05  0.1 0.1 0.05  0 0.1 0.05
                              0 0.05 0.05  0.1 0.05 0.05  0.05 0 0.05  0.05 0.1 0.05  0.05 0.05 0
                              0.05 0.05 0.1  0.05 0.05 0.05"/>
  <MeshMatrixMass massDensity="1000"/>
  <FixedConstraint indices="0 1 2 3 8 9 10 11 24"/>
  <HERE/>
</Node>)",
     "HERE"},
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
    {"LinearForceField",
     R"(<LinearForceField points="4 9" times="0 0.5 1" forces="0 0 0  0 0 3  0 0 0"/>)",
     softBody,
     "TetrahedronFEMForceField",
     Place::beside},
    {"MeshSpringForceField", R"(<MeshSpringForceField stiffness="2000" damping="1"/>)"},
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
    {"QuadBendingFEMForceField",
     R"(
<QuadBendingFEMForceField youngModulus="5000" poissonRatio="0.3" thickness="0.01"/>)",
     sheet,
     "TriangleFEMForceField"},
    {"QuadPressureForceField",
     R"(<QuadPressureForceField pressure="0 0 2" quadList="0 1 2 3"/>)",
     sheet,
     "TriangleFEMForceField",
     Place::beside},
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
    {"SPHFluidForceField", waterWithSurface},
    {"SPHFluidSurfaceMapping", waterWithSurface},
    {"ParticlesRepulsionForceField", R"(
<Node name="grains" gravity="0 -10 0">
  <EulerImplicitSolver rayleighMass="0.1"/>
  <CGLinearSolver iterations="25" tolerance="1e-9"/>
  <RegularGridTopology n="3 6 3" min="-0.1 0 -0.1" max="0.1 0.5 0.1" computeHexaList="false" computeQuadList="false"
                       computeTriangleList="false" computeEdgeList="false"/>
  <MechanicalObject/>
  <UniformMass vertexMass="0.01"/>
  <ParticlesRepulsionForceField distance="0.1" stiffness="100"/>
  <PlaneForceField normal="0 1 0" d="0" stiffness="100"/>
</Node>)"},
    {"DFSPHSolver", R"(
<Node name="water" gravity="0 -9.81 0">
  <DFSPHSolver radius="0.1" density="1000"/>
  <RegularGridTopology n="4 4 4" min="0.025 0.025 0.025" max="0.175 0.175 0.175" computeHexaList="false"
                       computeQuadList="false" computeTriangleList="false" computeEdgeList="false"/>
  <MechanicalObject/>
  <UniformMass vertexMass="0.125"/>
  <PlaneForceField normal="0 1 0" d="0.025" stiffness="500"/>
</Node>)"},
    {"Fluid2D", R"(
<Node name="pool" gravity="0 -9.81 0">
  <Fluid2D nx="42" ny="22" cellwidth="0.05" height="10" dir="0.3 1"/>
</Node>)"},
    {"Fluid3D", R"(
<Node name="pool" gravity="0 -9.81 0">
  <Fluid3D nx="22" ny="14" nz="12" cellwidth="0.1" height="6" dir="0.3 1 0"/>
</Node>)"},
    {"FluidBoundary", waterInTank},
    {"ImmersedSolid", boxInPool},
    {"SurfaceSampling", waterInTank},
    {"SphereForceField",
     R"(<SphereForceField center="0.4 -0.15 0.05" radius="0.1" stiffness="500"/>)",
     softBody,
     "TetrahedronFEMForceField",
     Place::beside},
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
    {"SurfacePressureForceField",
     R"(<SurfacePressureForceField pressure="2"/>)",
     sheet,
     "TriangleFEMForceField",
     Place::beside},
    {"TetrahedronDiffusionFEMForceField", R"(
<Node name="body" gravity="0 0 0">
  <GenerateGrid name="grid" min="0 0 0" max="0.4 0.1 0.1" resolution="5 3 3"/>
  <MeshTopology position="@grid.output_position" tetrahedra="@grid.tetrahedra"/>
  <MechanicalObject/>
  <BoxROI name="hot" box="-0.01 -0.01 -0.01  0.01 0.11 0.11"/>
  <ValuesFromPositions name="start" position="@grid.output_position" inputValues="80 20" direction="1 0 0"/>
  <Node name="temperature">
    <EulerImplicitSolver firstOrder="true"/>
    <CGLinearSolver iterations="100" tolerance="1e-8"/>
    <MechanicalObject template="Vec1d" position="@../start.values"/>
    <MeshMatrixMass massDensity="3.6e6"/>
    <TetrahedronDiffusionFEMForceField constantDiffusionCoefficient="0.5"/>
    <FixedConstraint indices="@../hot.indices"/>
  </Node>
</Node>)"},
    {"TetrahedronReactionFEMForceField", R"(
<Node name="body" gravity="0 0 0">
  <GenerateGrid name="grid" min="0 0 0" max="0.4 0.1 0.1" resolution="9 3 3"/>
  <MeshTopology position="@grid.output_position" tetrahedra="@grid.tetrahedra"/>
  <MechanicalObject/>
  <ValuesFromPositions name="start" position="@grid.output_position" inputValues="1 0" direction="1 0 0"/>
  <Node name="growth">
    <EulerImplicitSolver firstOrder="true"/>
    <CGLinearSolver iterations="100" tolerance="1e-8"/>
    <MechanicalObject template="Vec1d" position="@../start.values"/>
    <DiagonalMass massDensity="1"/>
    <TetrahedronDiffusionFEMForceField constantDiffusionCoefficient="0.001"/>
    <TetrahedronReactionFEMForceField reaction="FisherKPP" ParameterSet="2"/>
  </Node>
</Node>)"},
    {"TetrahedronFEMForceField", "", softBody, ""},
    {"TetrahedronHyperelasticityFEMForceField", R"(
<TetrahedronHyperelasticityFEMForceField materialName="NeoHookean" ParameterSet="20000 30000"/>)"},
    {"TetrahedronViscoelasticityFEMForceField", R"(
<TetrahedronViscoelasticityFEMForceField materialName="SLSMaxwellFirstOrder" ParameterSet="20000 10000 0.1 30000"/>)"},
    {"TorsionForceField",
     R"(<TorsionForceField indices="20 21 22 23" torque="0.5" axis="0 1 0" origin="0 0 0"/>)",
     sheet,
     "TriangleFEMForceField",
     Place::beside},
    {"TriangleBendingSprings",
     R"(
<MeshSpringForceField stiffness="50" damping="0.1"/>
<TriangleBendingSprings stiffness="20" damping="0.05"/>)",
     sheet,
     "TriangleFEMForceField"},
    {"TriangleFEMForceField", "", sheet, ""},
    {"TrianglePressureForceField",
     R"(<TrianglePressureForceField pressure="0 0 2" triangleList="0 1 2 3"/>)",
     sheet,
     "TriangleFEMForceField",
     Place::beside},
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
    {"TriangularTensorMassForceField",
     R"(
<TriangularTensorMassForceField youngModulus="50" poissonRatio="0.3"/>)",
     sheet,
     "TriangleFEMForceField"},
    {"TriangularShellForceField", R"(
<Node name="sheet" gravity="0 0 -9.81">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <SparseLDLSolver template="CompressedRowSparseMatrixd"/>
  <RegularGridTopology n="6 4 1" max="1 0.5 0"/>
  <MechanicalObject template="Rigid3d"/>
  <UniformMass vertexMass="0.1 1  2e-4 0 0  0 2e-4 0  0 0 4e-4"/>
  <TriangularShellForceField youngModulus="1e7" poissonRatio="0.3" thickness="0.01"/>
  <FixedConstraint indices="0 6 12 18"/>
</Node>)"},
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
    {"VectorSpringForceField",
     R"(<VectorSpringForceField springs="0 1 100 1 auto  1 2 100 1 auto"/>)",
     chain,
     "StiffSpringForceField"},
    {"VirtualCoupling", R"(
<Node name="tool">
  <EulerImplicitSolver/>
  <SparseLDLSolver template="CompressedRowSparseMatrixd"/>
  <MechanicalObject template="Rigid3d" position="0 0.15 0  0 0 0 1"/>
  <UniformMass vertexMass="0.05 1  0.002 0 0  0 0.002 0  0 0 0.002"/>
  <VirtualCoupling stiffness="100" damping="2" angularStiffness="0.5" target="0.03 0.18 0  0 0.5 0 0.866025"/>
</Node>)"},

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

    {"BDFOdeSolver", R"(<BDFOdeSolver order="2"/>)"},
    {"NewmarkImplicitSolver", R"(<NewmarkImplicitSolver gamma="0.5" beta="0.25"/>)"},
    {"EulerImplicitSolver", "", softBody, ""},
    {"StaticSolver", R"(<StaticSolver newton_iterations="20"/>)"},
    {"DampVelocitySolver",
     R"(<DampVelocitySolver rate="0.5"/>)",
     softBody,
     "EulerImplicitSolver",
     Place::beside},
    {"EulerExplicitSolver", R"(<EulerExplicitSolver/>)", chain, "EulerImplicitSolver"},
    {"CentralDifferenceSolver",
     R"(<CentralDifferenceSolver rayleighMass="0.1"/>)",
     chain,
     "EulerImplicitSolver"},
    {"RungeKutta2Solver", R"(<RungeKutta2Solver/>)", chain, "EulerImplicitSolver"},
    {"RungeKutta4Solver", R"(<RungeKutta4Solver/>)", chain, "EulerImplicitSolver"},
    {"RungeKutta45Solver", R"(<RungeKutta45Solver tolerance="1e-6"/>)", chain, "EulerImplicitSolver"},

    {"CGLinearSolver", R"(
<CGLinearSolver template="CompressedRowSparseMatrixMat3x3d" iterations="100" tolerance="1e-8"/>)"},
    {"MinResLinearSolver", R"(<MinResLinearSolver iterations="100" tolerance="1e-8"/>)"},
    {"ShewchukPCGLinearSolver", R"(
<ShewchukPCGLinearSolver template="CompressedRowSparseMatrixMat3x3d" iterations="100" tolerance="1e-8"
                         precondition="incompleteCholesky"/>)"},
    {"MultigridLinearSolver", R"(<MultigridLinearSolver tolerance="1e-8" refresh="5" warp="true"/>)"},
    {"SparseLDLSolver", "", softBody, ""},

    {"WriteState",
     R"(<WriteState filename="body.state" writeV="true" period="0.1"/>)",
     softBody,
     "FixedConstraint",
     Place::beside},

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
    {"RandomPointDistributionInSurface", R"(
<Node name="cloud" gravity="0 -9.81 0">
  <EulerExplicitSolver/>
  <GenerateSphere name="ball" radius="0.5" tessellationDegree="3"/>
  <RandomPointDistributionInSurface name="grains" vertices="@ball.output_TrianglesPosition" triangles="@ball.triangles"
                                    numberOfInPoints="20"/>
  <MechanicalObject position="@grains.inPoints"/>
  <UniformMass vertexMass="0.01"/>
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
    {"Hexa2TetraTopologicalMapping",
     R"(
<Node name="volume">
  <TetrahedronTopology name="container"/>
  <Hexa2TetraTopologicalMapping input="@../grid" output="@container"/>
  <TetrahedronFEMForceField youngModulus="20000" poissonRatio="0.3"/>
</Node>)",
     R"(
<Node name="beam" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <SparseLDLSolver/>
  <RegularGridTopology name="grid" n="5 3 3" max="0.4 0.1 0.1"/>
  <MechanicalObject/>
  <UniformMass totalMass="4"/>
  <FixedConstraint indices="0 5 10 15 20 25 30 35 40"/>
  <HERE/>
</Node>)",
     "HERE"},
    {"Hexa2PrismTopologicalMapping",
     R"(
<Node name="volume">
  <MeshTopology name="container"/>
  <Hexa2PrismTopologicalMapping input="@../grid" output="@container"/>
  <PrismFEMForceField youngModulus="20000" poissonRatio="0.3"/>
</Node>)",
     R"(
<Node name="beam" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <SparseLDLSolver/>
  <RegularGridTopology name="grid" n="5 3 3" max="0.4 0.1 0.1"/>
  <MechanicalObject/>
  <UniformMass totalMass="4"/>
  <FixedConstraint indices="0 5 10 15 20 25 30 35 40"/>
  <HERE/>
</Node>)",
     "HERE"},
    {"Tetra2TriangleTopologicalMapping",
     R"(
<TetrahedronFEMForceField youngModulus="2000" poissonRatio="0.3"/>
<Node name="surface">
  <MeshTopology name="container"/>
  <Tetra2TriangleTopologicalMapping input="@../volume" output="@container"/>
  <SurfacePressureForceField pressure="5"/>
</Node>)",
     R"(
<Node name="body" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <SparseLDLSolver/>
  <TetrahedronTopology name="volume" tetrahedra="0 1 2 3  1 2 3 4"/>
  <MechanicalObject position="0 0 0  1 0 0  0.5 0 0.9  0.5 -0.8 0.3  0.5 -1 1.2"/>
  <UniformMass totalMass="0.5"/>
  <FixedConstraint indices="0 1 2"/>
  <HERE/>
</Node>)",
     "HERE"},
    {"Hexa2QuadTopologicalMapping",
     R"(
<Node name="surface">
  <MeshTopology name="container"/>
  <Hexa2QuadTopologicalMapping input="@../grid" output="@container"/>
  <SurfacePressureForceField pressure="50"/>
</Node>)",
     R"(
<Node name="beam" gravity="0 -9.81 0">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <SparseLDLSolver/>
  <RegularGridTopology name="grid" n="5 3 3" max="0.4 0.1 0.1"/>
  <MechanicalObject/>
  <UniformMass totalMass="4"/>
  <HexahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>
  <FixedConstraint indices="0 5 10 15 20 25 30 35 40"/>
  <HERE/>
</Node>)",
     "HERE"},
    {"Quad2TriangleTopologicalMapping",
     R"(
<Node name="triangles">
  <MeshTopology name="container"/>
  <Quad2TriangleTopologicalMapping input="@../grid" output="@container"/>
  <TriangleFEMForceField youngModulus="5000" poissonRatio="0.3" thickness="0.01"/>
</Node>)",
     R"(
<Node name="sheet" gravity="0 0 -9.81">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <RegularGridTopology name="grid" n="5 5 1" max="1 1 0"/>
  <MechanicalObject/>
  <UniformMass totalMass="0.2"/>
  <FixedConstraint indices="20 24"/>
  <HERE/>
</Node>)",
     "HERE"},
    {"Edge2QuadTopologicalMapping",
     R"(
<Node name="skin">
  <MeshTopology name="faces"/>
  <Edge2QuadTopologicalMapping nbPointsOnEachCircle="8" radius="0.01" output="@faces"/>
  <MechanicalObject/>
  <TubularMapping nbPointsOnEachCircle="8" radius="0.01"/>
</Node>)",
     beams,
     "FixedConstraint",
     Place::beside},
    {"Mesh2PointTopologicalMapping",
     R"(
<Node name="middles">
  <MeshTopology name="points"/>
  <Mesh2PointTopologicalMapping hexaBaryCoords="0.5 0.5 0.5" input="@../grid" output="@points"/>
  <MechanicalObject/>
  <BarycentricMapping/>
  <ConstantForceField totalForce="0 0 -1"/>
</Node>)",
     namedBlock,
     "HERE"},
    {"SimpleTesselatedTetraTopologicalMapping",
     R"(
<Node name="fine">
  <MeshTopology name="small"/>
  <SimpleTesselatedTetraTopologicalMapping input="@../cut/large" output="@small"/>
  <MechanicalObject/>
  <BarycentricMapping/>
  <ConstantForceField totalForce="0 0 -1"/>
</Node>)",
     namedBlock,
     "HERE"},
    {"Triangle2EdgeTopologicalMapping",
     R"(
<Node name="border">
  <MeshTopology name="container"/>
  <Triangle2EdgeTopologicalMapping input="@../grid" output="@container"/>
  <MeshSpringForceField stiffness="100" damping="1"/>
</Node>)",
     R"(
<Node name="sheet" gravity="0 0 -9.81">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <RegularGridTopology name="grid" n="5 5 1" max="1 1 0"/>
  <MechanicalObject/>
  <UniformMass totalMass="0.2"/>
  <TriangleFEMForceField youngModulus="5000" poissonRatio="0.3" thickness="0.01"/>
  <FixedConstraint indices="20 24"/>
  <HERE/>
</Node>)",
     "HERE"},

    {"LocalMinDistance", R"(<LocalMinDistance alarmDistance="0.05" contactDistance="0.01"/>)"},
    {"MinProximityIntersection", "", contact, ""},
    {"ContinuousIntersection", R"(<ContinuousIntersection alarmDistance="0.05" contactDistance="0.01"/>)"},
    {"DefaultContactManager", "", friction, ""},
    {"SphereCollisionModel", "", contact, ""},
    {"PointCollisionModel", R"(<PointCollisionModel contactStiffness="20"/>)"},
    {"LineCollisionModel",
     R"(
<TriangleCollisionModel contactStiffness="20"/>
<LineCollisionModel contactStiffness="20"/>
<PointCollisionModel contactStiffness="20"/>)",
     friction,
     "PointCollisionModel"},
    {"TriangleCollisionModel",
     R"(
<TriangleCollisionModel contactStiffness="20"/>
<PointCollisionModel contactStiffness="20"/>)",
     friction,
     "PointCollisionModel"},
    {"RigidDistanceGridCollisionModel", R"(
<Node name="root" gravity="0 -9.81 0">
  <DefaultPipeline/>
  <BruteForceBroadPhase/>
  <BVHNarrowPhase/>
  <MinProximityIntersection alarmDistance="0.05" contactDistance="0.01"/>
  <DefaultContactManager/>
  <Node name="ball">
    <MechanicalObject template="Rigid3d" position="0 0 0  0 0 0 1"/>
    <RigidDistanceGridCollisionModel filename="#sphere" scale="0.5" nx="33" ny="33" nz="33"
                                     moving="false" simulated="false" contactStiffness="100"/>
  </Node>
  <Node name="drops">
    <EulerImplicitSolver/>
    <CGLinearSolver iterations="50" tolerance="1e-8"/>
    <MechanicalObject position="0 0.52 0  0.3 0.5 0.1"/>
    <UniformMass vertexMass="0.1"/>
    <PointCollisionModel contactStiffness="10" contactDamping="1"/>
  </Node>
</Node>)"},
    {"OBBCollisionModel", R"(
<Node name="root" gravity="0 -9.81 0">
  <DefaultPipeline/>
  <BruteForceBroadPhase/>
  <BVHNarrowPhase/>
  <MinProximityIntersection alarmDistance="0.05" contactDistance="0.01"/>
  <DefaultContactManager/>
  <Node name="slab">
    <MechanicalObject template="Rigid3d" position="0 -0.1 0  0 0 0 1"/>
    <OBBCollisionModel extents="1 0.1 1" moving="false" simulated="false" contactStiffness="100"/>
  </Node>
  <Node name="bricks">
    <EulerImplicitSolver/>
    <CGLinearSolver iterations="50" tolerance="1e-8"/>
    <MechanicalObject template="Rigid3d" position="0 0.22 0  0 0 0 1  0.5 0.4 0  0.1 0 0 0.995"/>
    <UniformMass vertexMass="1 1  0.01 0 0  0 0.01 0  0 0 0.01"/>
    <OBBCollisionModel extents="0.2 0.1 0.1  0.1 0.1 0.1" contactStiffness="100" contactDamping="2"/>
  </Node>
</Node>)"},
    {"CapsuleCollisionModel", R"(
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
  <Node name="rope">
    <EulerImplicitSolver/>
    <CGLinearSolver iterations="50" tolerance="1e-8"/>
    <MeshTopology edges="0 1  1 2"/>
    <MechanicalObject position="-0.2 0.2 0  0 0.3 0  0.2 0.3 0"/>
    <UniformMass vertexMass="0.1"/>
    <MeshSpringForceField stiffness="500" damping="1"/>
    <CapsuleCollisionModel listCapsuleRadii="0.02 0.04" contactStiffness="10" contactDamping="1"/>
  </Node>
</Node>)"},
    {"TetrahedronCollisionModel", R"(
<Node name="root" gravity="0 -9.81 0">
  <DefaultPipeline/>
  <BruteForceBroadPhase/>
  <BVHNarrowPhase/>
  <MinProximityIntersection alarmDistance="0.05" contactDistance="0.01"/>
  <DefaultContactManager/>
  <Node name="block">
    <EulerImplicitSolver rayleighStiffness="0.01"/>
    <CGLinearSolver iterations="50" tolerance="1e-8"/>
    <MeshTopology tetrahedra="0 1 2 3  1 4 2 3  4 5 2 3"/>
    <MechanicalObject position="0 0 0  0.4 0 0  0 0.4 0  0 0 0.4  0.4 0 0.4  0 0.4 0.4"/>
    <UniformMass totalMass="4"/>
    <TetrahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>
    <FixedConstraint indices="0 1 3 4"/>
    <TetrahedronCollisionModel contactStiffness="10"/>
  </Node>
  <Node name="ball">
    <EulerImplicitSolver/>
    <CGLinearSolver iterations="50" tolerance="1e-8"/>
    <MechanicalObject position="0.1 0.6 0.25"/>
    <UniformMass totalMass="0.1"/>
    <SphereCollisionModel radius="0.05" contactStiffness="10" contactDamping="1"/>
  </Node>
</Node>)"},
    {"RayTraceNarrowPhase", R"(
<Node name="root" gravity="0 0 0">
  <DefaultPipeline/>
  <BruteForceBroadPhase/>
  <RayTraceNarrowPhase/>
  <MinProximityIntersection alarmDistance="0.05" contactDistance="0.01"/>
  <DefaultContactManager/>
  <Node name="left">
    <EulerImplicitSolver rayleighStiffness="0.01"/>
    <CGLinearSolver iterations="50" tolerance="1e-8"/>
    <RegularGridTopology n="3 3 3" max="0.4 0.4 0.4"/>
    <MechanicalObject/>
    <UniformMass totalMass="4"/>
    <TetrahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>
    <TriangleCollisionModel contactStiffness="5"/>
  </Node>
  <Node name="right">
    <EulerImplicitSolver rayleighStiffness="0.01"/>
    <CGLinearSolver iterations="50" tolerance="1e-8"/>
    <RegularGridTopology n="3 3 3" min="0.3 0.1 0.1" max="0.7 0.5 0.5"/>
    <MechanicalObject/>
    <UniformMass totalMass="4"/>
    <TetrahedronFEMForceField youngModulus="50000" poissonRatio="0.3"/>
    <TriangleCollisionModel contactStiffness="5"/>
  </Node>
</Node>)"},
    {"SubCollisionPipeline", R"(
<Node name="root" gravity="0 -9.81 0">
  <Node name="pipeline">
    <SubCollisionPipeline collisionModels="ball floor"/>
    <BruteForceBroadPhase/>
    <BVHNarrowPhase/>
    <MinProximityIntersection alarmDistance="0.05" contactDistance="0.01"/>
    <DefaultContactManager/>
  </Node>
  <Node name="floor">
    <MeshTopology triangles="0 1 2  0 2 3"/>
    <MechanicalObject position="-1 0 1  1 0 1  1 0 -1  -1 0 -1"/>
    <TriangleCollisionModel moving="false" simulated="false" contactStiffness="100"/>
  </Node>
  <Node name="ball">
    <EulerImplicitSolver/>
    <CGLinearSolver iterations="50" tolerance="1e-8"/>
    <MechanicalObject position="0 0.3 0"/>
    <UniformMass totalMass="1"/>
    <SphereCollisionModel radius="0.1" contactStiffness="100" contactDamping="5"/>
  </Node>
</Node>)"},
    {"ConvexCollisionModel", R"(
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
  <Node name="brick">
    <EulerImplicitSolver/>
    <CGLinearSolver iterations="50" tolerance="1e-8"/>
    <MechanicalObject template="Rigid3d" position="0 0.22 0  0 0 0 1"/>
    <UniformMass vertexMass="1 1  0.01 0 0  0 0.01 0  0 0 0.01"/>
    <ConvexCollisionModel contactStiffness="100"
                          points="-0.2 -0.1 -0.1  0.2 -0.1 -0.1  0.2 0.1 -0.1  -0.2 0.1 -0.1
                                  -0.2 -0.1 0.1  0.2 -0.1 0.1  0.2 0.1 0.1  -0.2 0.1 0.1"/>
  </Node>
</Node>)"},
    {"TopologicalChangeProcessor", R"(
<Node name="sheet" gravity="0 0 -9.81">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <MeshTopology triangles="0 1 3  0 3 2  2 3 5  2 5 4"/>
  <MechanicalObject position="0 0 0  1 0 0  0 1 0  1 1 0  0 2 0  1 2 0"/>
  <UniformMass totalMass="0.6"/>
  <TriangleFEMForceField youngModulus="1000" thickness="0.01"/>
  <FixedConstraint indices="0 1"/>
  <TopologicalChangeProcessor useDataInputs="true" timeToRemove="0.5" trianglesToRemove="2 3"/>
</Node>)"},
    {"TopologyBoundingTrasher", R"(
<Node name="sheet" gravity="0 0 -9.81">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <MeshTopology triangles="0 1 3  0 3 2  2 3 5  2 5 4"/>
  <MechanicalObject position="0 0 0  1 0 0  0 1 0  1 1 0  0 2 0  1 2 0"/>
  <UniformMass totalMass="0.6"/>
  <TriangleFEMForceField youngModulus="1000" thickness="0.01"/>
  <FixedConstraint indices="0 1"/>
  <TopologyBoundingTrasher box="-1 -1 -0.5 2 3 1"/>
</Node>)"},
    {"TearingEngine", R"(
<Node name="sheet" gravity="0 0 0">
  <EulerImplicitSolver rayleighStiffness="0.01" rayleighMass="1"/>
  <CGLinearSolver iterations="100" tolerance="1e-8"/>
  <GridMeshCreator name="grid" resolution="8 8" trianglePattern="1"/>
  <MeshTopology triangles="@grid.triangles"/>
  <MechanicalObject src="@grid"/>
  <DiagonalMass massDensity="1"/>
  <TriangleFEMForceField youngModulus="1000" poissonRatio="0.3" thickness="0.01"/>
  <FixedConstraint indices="0 1 2 3 4 5 6 7"/>
  <LinearMovementConstraint indices="56 57 58 59 60 61 62 63" keyTimes="0 1" movements="0 0 0  0 1 0"/>
  <TearingEngine stressThreshold="300" fractureMaxLength="0.3" step="2"/>
</Node>)"},
    {"CuttingManager", R"(
<Node name="root" gravity="0 0 -9.81">
  <CuttingManager toolModel="@blade" bodyModel="@sheet"/>
  <Node name="sheet">
    <EulerImplicitSolver rayleighStiffness="0.05"/>
    <CGLinearSolver iterations="50" tolerance="1e-8"/>
    <GridMeshCreator name="grid" resolution="8 8" trianglePattern="1"/>
    <MeshTopology triangles="@grid.triangles"/>
    <MechanicalObject src="@grid"/>
    <DiagonalMass massDensity="1"/>
    <TriangleFEMForceField youngModulus="2000" poissonRatio="0.3" thickness="0.01"/>
    <FixedConstraint indices="0 7 56 63"/>
  </Node>
  <Node name="blade">
    <MechanicalObject position="0.5 -0.1 -1  0.5 -0.1 1"/>
    <LinearMovementConstraint indices="0 1" keyTimes="0 1" movements="0 0 0  0 1 0"/>
  </Node>
</Node>)"},
    {"CarvingManager", R"(
<Node name="root" gravity="0 0 -9.81">
  <DefaultPipeline/>
  <BruteForceBroadPhase/>
  <BVHNarrowPhase/>
  <MinProximityIntersection alarmDistance="0.1" contactDistance="0.02"/>
  <DefaultContactManager/>
  <CarvingManager active="true" carvingDistance="0.01" toolModel="@tool/ball"/>
  <Node name="sheet">
    <EulerImplicitSolver rayleighStiffness="0.05"/>
    <CGLinearSolver iterations="50" tolerance="1e-8"/>
    <GridMeshCreator name="grid" resolution="8 8"/>
    <MeshTopology src="@grid"/>
    <MechanicalObject src="@grid"/>
    <UniformMass totalMass="1"/>
    <TriangleFEMForceField youngModulus="2000" poissonRatio="0.3" thickness="0.01"/>
    <FixedConstraint indices="0 7 56 63"/>
    <TriangleCollisionModel contactStiffness="10"/>
  </Node>
  <Node name="tool">
    <MechanicalObject position="0.5 0.5 0.4"/>
    <LinearMovementConstraint indices="0" keyTimes="0 1" movements="0 0 0  0 0 -0.4"/>
    <SphereCollisionModel name="ball" radius="0.2" simulated="false"/>
  </Node>
</Node>)"},

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

/// A scene with text in the place of the line with an element, or below it, as far to the right as that; as
/// it is where no element is named.
std::string placed(std::string_view scene, std::string_view standIn, std::string_view xml, Place place) {
  std::string out;
  bool found = standIn.empty();
  auto add = [&](std::string_view line) { out += text(line, '\n'); };
  each_line(scene, [&](std::string_view line) {
    const std::size_t indent = std::min(line.find_first_not_of(' '), line.size());
    const std::string_view element = line.substr(indent);
    const bool here = !found && element.starts_with(text('<', standIn)) &&
                      std::string_view(" />").find(element[standIn.size() + 1]) != std::string_view::npos;
    if (!here || place == Place::beside) add(line);
    if (!here) return;
    found = true;
    each_line(xml, [&](std::string_view below) { add(text(line.substr(0, indent), below)); });
  });
  if (!found) throw Failure{badUsage, {text("no example has an element ", standIn, " to stand beside")}};
  return out;
}

}  // namespace

std::string example_of(Entry const& entry) {
  const std::string_view name = entry.first().name;
  const std::string alone = text('<', name, "/>");
  auto same = [&](ClassExample const& e) { return e.name == name; };
  const auto of = std::find_if(classExamples.begin(), classExamples.end(), same);
  ClassExample example = of == classExamples.end() ? ClassExample{.name = name} : *of;
  if (example.scene.empty()) {
    if (example.xml.starts_with("\n<Node")) return placed(example.xml, {}, {}, Place::beside);
    for (auto const& role : roleExamples)
      if (role.role == entry.first().role)
        example = {name, example.xml, role.scene, role.standIn, role.place};
  }
  if (example.scene.empty()) return {};
  return placed(example.scene, example.standIn, example.xml.empty() ? alone : example.xml, example.place);
}

}  // namespace cli
