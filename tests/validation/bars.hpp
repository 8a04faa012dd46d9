// SPDX-License-Identifier: BSL-1.0
#pragma once

// Straight bars of a square section, from the origin along x, and the sums of beam theory.

#include "registry_scene.hpp"

#include <sinew/sinew.hpp>
#include <sinew/solver/sparse_ldl_solver.hpp>
#include <sinew/solver/static_solver.hpp>
#include <sinew/topology/adjacency.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace bars {

using namespace sinew;
using Eigen::Vector3d;

/// Elements of a bar: hexahedra, or the cells of the same grid in 5 or 6 tetrahedra.
enum class Cells { hexahedra, five, six };

struct Bar {
  double length = 10, width = 1;  // [m]
  double E = 1e6, nu = 0;         // [Pa]
  int along = 10, across = 1;     // cells
  int deep = 0;                   // cells along z; 0 for as many as across

  double area() const { return width * width; }
  double inertia() const { return std::pow(width, 4) / 12; }
  double shearModulus() const { return E / (2 * (1 + nu)); }
  /// Tip of a cantilever under a force at its end, Euler and Bernoulli.
  double euler(double force) const { return force * std::pow(length, 3) / (3 * E * inertia()); }
  /// The same of Timoshenko, with the shear coefficient of a rectangle (Cowper 1966).
  double timoshenko(double force) const {
    const double kappa = 10 * (1 + nu) / (12 + 11 * nu);
    return euler(force) + force * length / (kappa * shearModulus() * area());
  }

  Mesh mesh(Cells cells) const {
    const Vector3d lo(0, -width / 2, -width / 2), hi(length, width / 2, width / 2);
    const int n = along + 1, m = across + 1, d = deep > 0 ? deep + 1 : m;
    return cells == Cells::hexahedra ? regular_grid(n, m, d, lo, hi)
                                     : regular_grid_tetrahedra(n, m, d, lo, hi, cells == Cells::five ? 5 : 6);
  }
};

template <class Where>
std::vector<int> points_where(Mesh const& mesh, Where&& where) {
  std::vector<int> points;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (where(mesh.positions[i])) points.push_back(int(i));
  return points;
}
inline std::vector<int> points_at(Mesh const& mesh, double x) {
  return points_where(mesh, [x](Vector3d const& p) { return std::abs(p[0] - x) < 1e-9; });
}
inline int nearest_point(Mesh const& mesh, Vector3d const& place) {
  std::size_t best = 0;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if ((mesh.positions[i] - place).norm() < (mesh.positions[best] - place).norm()) best = i;
  return int(best);
}

/// Newton's method to rounding.
inline StaticSolver to_rounding(int iterations = 30) {
  return {.maxNbIterationsNewton = iterations,
          .relativeInitialStoppingThreshold = 1e-12,
          .absoluteResidualStoppingThreshold = 0,
          .relativeEstimateDifferenceThreshold = 1e-14,
          .absoluteEstimateDifferenceThreshold = 0};
}

/// The linear answer to a load: one iteration of Newton's method, with L D L'.
template <class Force, class... Held>
auto loaded(Mesh const& mesh, Force const& fem, ConstantForceField<Vec3d> const& load, Held const&... held) {
  RegistryScene sim{node<"root">(to_rounding(1),
                                 SparseLDLSolver<>{},
                                 MeshTopology{.tetrahedra = mesh.tetrahedra, .hexahedra = mesh.hexahedra},
                                 MechanicalObject<Vec3d>{mesh.positions},
                                 fem,
                                 load,
                                 held...)};
  sim.init();
  sim.animate(1);
  return sim;
}

/// Mean of a coordinate of the way of some points.
template <class Sim>
double mean_way(Sim& sim, Mesh const& mesh, std::vector<int> const& points, int coordinate) {
  double sum = 0;
  for (const int i : points)
    sum +=
        sim.root().state().position[std::size_t(i)][coordinate] - mesh.positions[std::size_t(i)][coordinate];
  return sum / double(points.size());
}

/// An even load on the end face of a grid of cubic cells: each square gives its points a quarter.
inline ConstantForceField<Vec3d> on_end_face(Mesh const& mesh, Bar const& bar, Vector3d const& total) {
  ConstantForceField<Vec3d> load{.indices = points_at(mesh, bar.length)};
  const double cell = bar.width / bar.across;
  for (const int i : load.indices) {
    double share = 1;
    for (const int c : {1, 2}) {
      const double edge = bar.width / 2 - std::abs(mesh.positions[std::size_t(i)][c]);
      share *= (edge < 0.5 * cell ? 0.5 : 1) / bar.across;
    }
    load.forces.push_back(share * total);
  }
  return load;
}

/// Tip of the cantilever under an even shear load, against Timoshenko's.
template <class Force>
double tip_against_theory(Bar const& bar, Cells cells, Force fem) {
  fem.youngModulus = {bar.E};
  fem.poissonRatio = bar.nu;
  const Mesh mesh = bar.mesh(cells);
  const double force = 1e-4 * bar.length / bar.timoshenko(1);
  auto sim = loaded(mesh,
                    fem,
                    on_end_face(mesh, bar, {0, -force, 0}),
                    FixedConstraint<Vec3d>{.indices = points_at(mesh, 0)});
  return -mean_way(sim, mesh, points_at(mesh, bar.length), 1) / bar.timoshenko(force);
}

}  // namespace bars
