// SPDX-License-Identifier: BSL-1.0
// Bodies large enough to be shared by threads, and what says that two of them are equal bit by bit.
#pragma once

#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/context/gravity.hpp>
#include <sinew/control/threads.hpp>
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/regular_grid.hpp>
#include <sinew/topology/tetrahedron_topology.hpp>

#include <catch.hpp>

#include <cstring>
#include <vector>

namespace threaded {

using namespace sinew;

/// 3,380 points and 15,552 tetrahedra, of which many points are shared by parts
inline Mesh block() { return regular_grid_tetrahedra(13, 13, 20, {0, 0, 0}, {1, 1.1, 2}); }

template <class D>
typename D::VecCoord points(Mesh const& mesh) {
  typename D::VecCoord all;
  for (auto const& p : mesh.positions) all.push_back(p.template cast<typename D::Real>());
  return all;
}

template <class D, class Matrix>
auto fem(Mesh const& mesh, int threads) {
  return Simulation{node<"root">(Threads{.count = threads},
                                 Gravity{},
                                 EulerImplicitSolver{.rayleighStiffness = 0.01},
                                 CGLinearSolver<Matrix>{.iterations = 3, .tolerance = 0},
                                 TetrahedronTopology{mesh.tetrahedra},
                                 MechanicalObject<D>{points<D>(mesh)},
                                 UniformMass<D>{.totalMass = 1},
                                 TetrahedronFEMForceField<D>{},
                                 FixedConstraint<D>{.indices = {0, 1, 14}})};
}

/// Positions and velocities, as bytes.
template <class Sim>
std::vector<unsigned char> bits(Sim& sim) {
  auto const& state = sim.root().state();
  std::vector<unsigned char> all;
  auto add = [&](auto const& list) {
    const std::size_t end = all.size(), size = list.size() * sizeof list[0];
    all.resize(end + size);
    std::memcpy(all.data() + end, list.data(), size);
  };
  add(state.position);
  add(state.velocity);
  return all;
}
template <class Sim>
void run(Sim& sim, int steps) {
  for (int i = 0; i < steps; ++i) sim.animate(0.01);
}

/// make(threads) has the same bits after some steps, whatever `threads` is.
template <class Make>
void same_bits(Make&& make) {
  std::vector<unsigned char> first;
  for (const int threads : {1, 2, 3, 8}) {
    auto sim = make(threads);
    sim.init();
    run(sim, 3);
    const auto now = bits(sim);
    if (first.empty()) first = now;
    INFO(threads << " threads");
    CHECK(now == first);
  }
}

}  // namespace threaded
