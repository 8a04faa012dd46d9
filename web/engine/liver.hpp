// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/contact.hpp>
#include <sinew/mechanics.hpp>

#include <liver_mesh.hpp>  // as mesh.cpp writes it

#include <cstddef>
#include <vector>

namespace page {

inline constexpr double dt = 0.02;  // [s]

/// A corotational liver of 1,500 tetrahedra or so that hangs from the diaphragm, with a smooth skin, and
/// can be pulled. Not yet initialised.
inline auto liver() {
  using namespace sinew;
  Mesh volume, skin;
  for (auto const& p : mesh::positions) volume.positions.emplace_back(p[0], p[1], p[2]);
  for (auto const& t : mesh::tetrahedra) volume.tetrahedra.push_back({t[0], t[1], t[2], t[3]});
  for (auto const& p : mesh::skin) skin.positions.emplace_back(p[0], p[1], p[2]);
  for (auto const& t : mesh::triangles) skin.triangles.push_back({t[0], t[1], t[2]});
  std::vector<int> fixed;
  for (std::size_t i = 0; i < volume.positions.size(); ++i)
    if (auto const& p = volume.positions[i]; p.y() > 0.035 && p.z() < 0) fixed.push_back(int(i));
  return Simulation{
      node<"root">(Gravity{{0, -9.81, 0}},
                   DefaultPipeline{},
                   BruteForceBroadPhase{},
                   BVHNarrowPhase{},
                   MinProximityIntersection{.alarmDistance = 0.002, .contactDistance = 0.001},
                   ContactManager<PenalityContactForceField>{},
                   EulerImplicitSolver{.rayleighStiffness = 0.1, .rayleighMass = 0.1},
                   CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{.iterations = 25, .tolerance = 1e-9},
                   node<"liver">(TetrahedronTopology{volume.tetrahedra},
                                 MechanicalObject<Vec3d>{volume.positions},
                                 DiagonalMass<Vec3d>{.massDensity = 1000},
                                 TetrahedronFEMForceField<Vec3d>{.youngModulus = {3000}, .poissonRatio = 0.3},
                                 FixedConstraint<Vec3d>{.indices = fixed},
                                 TriangleCollisionModel<Vec3d>{},
                                 node<"skin">(VisualModel{skin}, BarycentricMapping<Vec3d, Vec3f>{})))};
}

}  // namespace page
