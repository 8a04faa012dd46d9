// SPDX-License-Identifier: BSL-1.0
#include "reference_examples.hpp"

namespace cli {

namespace {

constexpr auto examples = std::to_array<ClassExample>({
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
});

}  // namespace

std::span<ClassExample const> examples_of_topological_mappings() { return examples; }

}  // namespace cli
