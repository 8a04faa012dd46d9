// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "catch.hpp"
#include "registry_scene.hpp"

#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/constraint/partial_fixed.hpp>
#include <sinew/force/constant_force.hpp>
#include <sinew/force/triangular_shell.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/sparse_ldl_solver.hpp>
#include <sinew/solver/static_solver.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/mesh_topology.hpp>

#include <numbers>

namespace shells {

using namespace sinew;
using std::numbers::pi;
using Shell = TriangularShellForceField<Rigid3d>;
using Coord = Rigid3d::Coord;
using Deriv = Rigid3d::Deriv;
using Eigen::Vector3d;

inline Deriv wrench(Vector3d const& force, Vector3d const& torque = Vector3d::Zero()) {
  Deriv f;
  f << force, torque;
  return f;
}

/// Frames and the triangles between them.
struct Sheet {
  Rigid3d::VecCoord x;
  std::vector<Triangle> triangles;

  int add(Vector3d const& center, Eigen::Quaterniond const& rotation = Eigen::Quaterniond::Identity()) {
    x.emplace_back();
    x.back().center = center;
    x.back().orientation = rotation;
    return int(x.size()) - 1;
  }
  /// The frames that a condition on their centres chooses.
  template <class Condition>
  std::vector<int> where(Condition const& condition) const {
    std::vector<int> chosen;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (condition(x[i].center)) chosen.push_back(int(i));
    return chosen;
  }
  /// A force on each area, brought to the corners of the triangles.
  Rigid3d::VecDeriv spread(Vector3d const& load) const {
    Rigid3d::VecDeriv f(x.size(), Deriv::Zero());
    for (Triangle const& t : triangles) {
      auto at = [&](int k) -> Vector3d const& { return x[std::size_t(t[std::size_t(k)])].center; };
      const double area = (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
      for (const int i : t) f[std::size_t(i)].head<3>() += area / 3 * load;
    }
    return f;
  }
};

/// (nx + 1) x (ny + 1) frames, x fastest, over [0, a] x [0, b], placed by a map of the two coordinates; two
/// triangles a cell, whose diagonals alternate.
template <class Place>
Sheet grid(int nx, int ny, double a, double b, Place const& place) {
  Sheet sheet;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) sheet.add(place(a * i / nx, b * j / ny));
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int p = j * (nx + 1) + i, q = p + 1, r = q + nx + 1, s = p + nx + 1;
      if ((i + j) % 2) {
        sheet.triangles.push_back({p, q, r});
        sheet.triangles.push_back({p, r, s});
      } else {
        sheet.triangles.push_back({p, q, s});
        sheet.triangles.push_back({q, r, s});
      }
    }
  return sheet;
}
inline Sheet flat(int nx, int ny, double a, double b) {
  return grid(nx, ny, a, b, [](double x, double y) { return Vector3d(x, y, 0); });
}
/// A disc of n rings of triangles; ring i has 6 i frames.
inline Sheet disc(int n, double radius) {
  Sheet sheet;
  sheet.add({0, 0, 0});
  auto number = [](int ring, int i) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1) + i % (6 * ring); };
  for (int ring = 1; ring <= n; ++ring)
    for (int i = 0; i < 6 * ring; ++i) {
      const double angle = 2 * pi * i / (6 * ring), r = radius * ring / n;
      sheet.add({r * std::cos(angle), r * std::sin(angle), 0});
    }
  for (int ring = 1; ring <= n; ++ring)
    for (int side = 0; side < 6; ++side)
      for (int i = 0; i < ring; ++i) {
        const int out = side * ring + i, in = side * (ring - 1) + i;
        sheet.triangles.push_back({number(ring - 1, in), number(ring, out), number(ring, out + 1)});
        if (i + 1 < ring)
          sheet.triangles.push_back({number(ring - 1, in), number(ring, out + 1), number(ring - 1, in + 1)});
      }
  return sheet;
}

/// Frames whose directions (0, 1, 2: places, 3, 4, 5: turns) are held.
struct Held {
  std::vector<int> frames{};
  std::array<int, 6> directions{};
};
inline constexpr std::array<int, 6> all{1, 1, 1, 1, 1, 1}, places{1, 1, 1};

struct Settled {
  Rigid3d::VecCoord x;
  std::vector<double> corrections;  // of Newton's method in the last step
};
/// The equilibrium under dead loads that are brought on in steps, from positions at the start.
inline Settled settle(Shell const& shell, Sheet const& sheet, Rigid3d::VecCoord const& start,
                      std::array<Held, 3> const& held, Rigid3d::VecDeriv const& loads, int steps = 1,
                      double correction = 1e-8) {
  std::vector<int> everywhere(sheet.x.size());
  for (std::size_t i = 0; i < everywhere.size(); ++i) everywhere[i] = int(i);
  auto hold = [](Held const& h) {
    return PartialFixedConstraint<Rigid3d>{.indices = h.frames, .fixedDirections = h.directions};
  };
  RegistryScene sim{node<"root">(StaticSolver{.maxNbIterationsNewton = 60,
                                              .relativeInitialStoppingThreshold = 0,
                                              .absoluteResidualStoppingThreshold = 0,
                                              .relativeEstimateDifferenceThreshold = 0,
                                              .absoluteEstimateDifferenceThreshold = correction},
                                 SparseLDLSolver<CompressedRowSparseMatrixd>{},
                                 MeshTopology{.triangles = sheet.triangles},
                                 MechanicalObject<Rigid3d>{.position = start, .restPosition = sheet.x},
                                 shell,
                                 ConstantForceField<Rigid3d>{.indices = everywhere, .forces = loads},
                                 hold(held[0]),
                                 hold(held[1]),
                                 hold(held[2]))};
  sim.init();
  auto& now = sim.root().template get<ConstantForceField<Rigid3d>>().forces;
  for (int s = 1; s <= steps; ++s) {
    for (std::size_t i = 0; i < now.size(); ++i) now[i] = loads[i] * (double(s) / steps);
    sim.animate(1);
  }
  auto const& newton = sim.root().template get<StaticSolver>().newton;
  INFO("Newton's corrections " << Catch::Detail::stringify(newton.corrections));
  REQUIRE(newton.converged());
  return {sim.root().state().position, newton.corrections};
}
inline Settled settle(Shell const& shell, Sheet const& sheet, std::array<Held, 3> const& held,
                      Rigid3d::VecDeriv const& loads, int steps = 1, double correction = 1e-8) {
  return settle(shell, sheet, sheet.x, held, loads, steps, correction);
}

}  // namespace shells
