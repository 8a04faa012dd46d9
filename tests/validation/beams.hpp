// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "frames.hpp"
#include "registry_scene.hpp"

#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/force/beam_fem.hpp>
#include <sinew/force/constant_force.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/sparse_ldl_solver.hpp>
#include <sinew/solver/static_solver.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/mesh_topology.hpp>

namespace beams {

using namespace sinew;
using Beam = BeamFEMForceField<Rigid3d>;
using Coord = Rigid3d::Coord;
using Deriv = Rigid3d::Deriv;
using Eigen::Vector3d;
using frames::frame;

/// n + 1 frames along x, of a beam of n elements, and its edges.
inline Rigid3d::VecCoord straight(int n, double length) {
  Rigid3d::VecCoord x;
  for (int i = 0; i <= n; ++i) x.push_back(frame({i * length / n, 0, 0}));
  return x;
}
inline std::vector<Edge> chain(int n) {
  std::vector<Edge> edges;
  for (int i = 0; i < n; ++i) edges.push_back({i, i + 1});
  return edges;
}

/// Newton's method until a correction is as small as this, of all degrees of freedom together [m].
inline StaticSolver statics(double correction) {
  return {.maxNbIterationsNewton = 60,
          .relativeInitialStoppingThreshold = 0,
          .absoluteResidualStoppingThreshold = 0,
          .relativeEstimateDifferenceThreshold = 0,
          .absoluteEstimateDifferenceThreshold = correction};
}

/// A beam over the frames x, clamped at the first, with a dead load at each frame, brought on in steps.
struct Loaded {
  Rigid3d::VecCoord x;
  std::vector<double> corrections;  // of Newton's method in the last step
};
inline Loaded load(Beam const& beam, Rigid3d::VecCoord const& x, Rigid3d::VecDeriv const& forces,
                   int steps = 1, double correction = 1e-8) {
  std::vector<int> all(x.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = int(i);
  RegistryScene sim{node<"root">(statics(correction),
                                 SparseLDLSolver<CompressedRowSparseMatrixd>{},
                                 MeshTopology{.edges = chain(int(x.size()) - 1)},
                                 MechanicalObject<Rigid3d>{.position = x},
                                 beam,
                                 ConstantForceField<Rigid3d>{.indices = all, .forces = forces},
                                 FixedConstraint<Rigid3d>{.indices = {0}})};
  sim.init();
  auto& now = sim.root().template get<ConstantForceField<Rigid3d>>().forces;
  for (int s = 1; s <= steps; ++s) {
    for (std::size_t i = 0; i < now.size(); ++i) now[i] = forces[i] * (double(s) / steps);
    sim.animate(1);
  }
  auto const& newton = sim.root().template get<StaticSolver>().newton;
  INFO("Newton's corrections " << Catch::Detail::stringify(newton.corrections));
  REQUIRE(newton.converged());
  return {sim.root().state().position, newton.corrections};
}
/// The same with a load at the last frame only.
inline Loaded tip_load(Beam const& beam, Rigid3d::VecCoord const& x, Deriv const& tip, int steps = 1,
                       double correction = 1e-8) {
  Rigid3d::VecDeriv forces(x.size(), Deriv::Zero());
  forces.back() = tip;
  return load(beam, x, forces, steps, correction);
}

}  // namespace beams
