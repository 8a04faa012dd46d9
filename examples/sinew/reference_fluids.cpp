// SPDX-License-Identifier: BSL-1.0
#include "reference_examples.hpp"

namespace cli {

namespace {

constexpr auto examples = std::to_array<ClassExample>({
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
});

}  // namespace

std::span<ClassExample const> examples_of_fluids() { return examples; }

}  // namespace cli
