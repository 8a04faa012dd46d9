// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/mechanics.hpp>

#include <map>

namespace examples {

/// A unit sphere: an octahedron whose faces are divided `levels` times, 4^(levels + 1) + 2 vertices.
inline sinew::Mesh sphere(int levels) {
  using namespace sinew;
  Mesh mesh;
  mesh.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<Edge, Index> middles;
    auto middle = [&](Index a, Index b) {
      const auto [found, isNew] =
          middles.try_emplace(Edge{std::min(a, b), std::max(a, b)}, Index(mesh.positions.size()));
      if (isNew)
        mesh.positions.push_back(
            (mesh.positions[std::size_t(a)] + mesh.positions[std::size_t(b)]).normalized());
      return found->second;
    };
    std::vector<Triangle> finer;
    for (auto const& [a, b, c] : mesh.triangles) {
      const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = finer;
  }
  return mesh;
}

/// Four control points, one finite element, and a round skin of 4,098 vertices that follows them.
inline auto one_tetrahedron() {
  using namespace sinew;
  Mesh skin = sphere(5);
  for (auto& p : skin.positions) p = 0.3 * p + Eigen::Vector3d(0.25, 0.25, 0.25);
  return Simulation{node<"root">(
      Gravity{{0, -9.81, 0}},
      EulerImplicitSolver{.rayleighStiffness = 0.01, .rayleighMass = 0.1},
      CGLinearSolver<>{.iterations = 25, .tolerance = 1e-9},
      node<"tetrahedron">(TetrahedronTopology{{{0, 1, 2, 3}}},
                          MechanicalObject<Vec3d>{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                          UniformMass<Vec3d>{.totalMass = 1},
                          TetrahedronFEMForceField<Vec3d>{.youngModulus = {500}, .poissonRatio = 0.3},
                          FixedConstraint<Vec3d>{.indices = {0}},
                          node<"skin">(VisualModel{skin}, BarycentricMapping<Vec3d, Vec3f>{})))};
}

}  // namespace examples
