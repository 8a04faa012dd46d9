// SPDX-License-Identifier: BSL-1.0
#pragma once

// A cylinder along z that stands on rollers and is pulled at its top, as SOFA's tests have it.

#include "bars.hpp"
#include "registry_scene.hpp"

#include <sinew/topology/hexahedra.hpp>

#include <numbers>

namespace cylinder {

using namespace bars;

constexpr double length = 2, radius = 0.5;

inline Mesh tetrahedra() { return cylinder_tetrahedra(2, 0, length, radius, 3, 6); }
/// A grid of which each square section is rounded, x sqrt(1 - y^2/2), y sqrt(1 - x^2/2), and those inside
/// lean.
inline Mesh hexahedra() {
  Mesh mesh = regular_grid(5, 5, 7, {-1, -1, 0}, {1, 1, length});
  for (auto& p : mesh.positions)
    p = {radius * p[0] * std::sqrt(1 - p[1] * p[1] / 2),
         radius * p[1] * std::sqrt(1 - p[0] * p[0] / 2),
         p[2] +
             0.5 * p[0] * (1 - p[0] * p[0]) * (1 - p[1] * p[1]) * std::sin(std::numbers::pi * p[2] / length)};
  return mesh;
}

/// An even dead load of 1 Pa on the top: each face gives its points the integrals of their shape functions.
inline ConstantForceField<Vec3d> pull(Mesh const& mesh) {
  ConstantForceField<Vec3d> load;
  auto add = [&](int point, double area) {
    load.indices.push_back(point);
    load.forces.push_back(Vector3d(0, 0, area));
  };
  auto at = [&](int i) { return mesh.positions[std::size_t(i)]; };
  auto onTop = [&](auto const& face) {
    return std::all_of(face.begin(), face.end(), [&](int i) { return at(i)[2] > length - 1e-9; });
  };
  for (auto const& t : boundary_triangles(mesh.tetrahedra))
    if (onTop(t))
      for (const int i : t) add(i, (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).norm() / 6);
  for (auto const& h : mesh.hexahedra)
    if (const Quad q{h[4], h[5], h[6], h[7]}; onTop(q))
      for (const double u : {0.5 - std::sqrt(1.0 / 12), 0.5 + std::sqrt(1.0 / 12)})
        for (const double v : {0.5 - std::sqrt(1.0 / 12), 0.5 + std::sqrt(1.0 / 12)}) {
          const MultilinearShape<2> shape({u, v});
          Eigen::Matrix<double, 2, 4> corners;
          for (int k = 0; k < 4; ++k) corners.col(k) = at(q[std::size_t(k)]).head<2>();
          const double area = (corners * shape.derivatives).determinant() / 4;
          for (int k = 0; k < 4; ++k) add(q[std::size_t(k)], area * shape.weights[k]);
        }
  return load;
}

struct Stretches {
  double axial, lateral;
};

/// The cylinder in equilibrium under a nominal stress p, reached in even steps.
template <class Force>
Stretches pulled(Mesh const& mesh, Force const& force, double p, int steps = 1) {
  StaticSolver solver = to_rounding(40);
  solver.maxNbIterationsLineSearch = 8;
  const ConstantForceField<Vec3d> unit = pull(mesh);
  const int center = nearest_point(mesh, {0, 0, 0}), side = nearest_point(mesh, {radius, 0, 0});
  using Held = PartialFixedConstraint<Vec3d>;
  const Held base{.indices = points_where(mesh, [](Vector3d const& x) { return x[2] < 1e-9; }),
                  .fixedDirections = {0, 0, 1}};
  RegistryScene sim{node<"root">(solver,
                                 SparseLDLSolver<>{},
                                 MeshTopology{.tetrahedra = mesh.tetrahedra, .hexahedra = mesh.hexahedra},
                                 MechanicalObject<Vec3d>{mesh.positions},
                                 force,
                                 unit,
                                 base,
                                 Held{.indices = {center}, .fixedDirections = {1, 1, 0}},
                                 Held{.indices = {side}, .fixedDirections = {0, 1, 0}})};
  sim.init();
  auto& load = sim.root().template get<ConstantForceField<Vec3d>>();
  for (int step = 1; step <= steps; ++step) {
    for (std::size_t i = 0; i < unit.forces.size(); ++i) load.forces[i] = p * step / steps * unit.forces[i];
    sim.animate(1);
  }
  auto const& x = sim.root().state().position;
  // between points on opposite sides: unbalanced torques of `large` may bend the cylinder aside
  const int top = nearest_point(mesh, {0, 0, length}), right = nearest_point(mesh, {radius, 0, length / 2}),
            left = nearest_point(mesh, {-radius, 0, length / 2});
  auto across = [&](Vec3d::VecCoord const& at) {
    return at[std::size_t(right)][0] - at[std::size_t(left)][0];
  };
  return {x[std::size_t(top)][2] / length, across(x) / across(mesh.positions)};
}

}  // namespace cylinder
