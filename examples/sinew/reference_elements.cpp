// SPDX-License-Identifier: BSL-1.0
#include "reference_examples.hpp"

namespace cli {

namespace {

constexpr auto examples = std::to_array<ClassExample>({
    {"AdaptiveBeamForceField", "", rod, ""},
    {"BeamFEMForceField", "", beams, ""},
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
    {"QuadBendingFEMForceField",
     R"(
<QuadBendingFEMForceField youngModulus="5000" poissonRatio="0.3" thickness="0.01"/>)",
     sheet,
     "TriangleFEMForceField"},
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
    {"TriangleFEMForceField", "", sheet, ""},
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
});

}  // namespace

std::span<ClassExample const> examples_of_elements() { return examples; }

}  // namespace cli
