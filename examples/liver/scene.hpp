// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/mechanics.hpp>

#include "options.hpp"

namespace examples {

/// A corotational liver that hangs from a few fixed points, with a smooth skin.
inline auto liver_scene(LiverBody const& body, LiverOptions const& options) {
  using namespace sinew;
  return Simulation{node<"root">(
      Gravity{{0, -9.81, 0}},
      EulerImplicitSolver{.rayleighStiffness = 0.1, .rayleighMass = 0.1},
      CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{.iterations = options.iterations, .tolerance = 1e-9},
      node<"liver">(TetrahedronTopology{body.volume.tetrahedra},
                    MechanicalObject<Vec3d>{body.volume.positions},
                    DiagonalMass<Vec3d>{.massDensity = options.density},
                    TetrahedronFEMForceField<Vec3d>{.youngModulus = {options.youngModulus},
                                                    .poissonRatio = options.poissonRatio},
                    FixedConstraint<Vec3d>{.indices = options.fixed},
                    node<"skin">(VisualModel{body.skin}, BarycentricMapping<Vec3d, Vec3f>{})))};
}

}  // namespace examples
