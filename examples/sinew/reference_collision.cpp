// SPDX-License-Identifier: BSL-1.0
#include "reference_examples.hpp"

namespace cli {

namespace {

constexpr auto examples = std::to_array<ClassExample>({
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
});

}  // namespace

std::span<ClassExample const> examples_of_collision() { return examples; }

}  // namespace cli
