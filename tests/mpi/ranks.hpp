// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/mechanics.hpp>
#include <sinew/mpi/petsc_linear_solver.hpp>
#include <sinew/mpi/simulation.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <string>

/// Of this program, without MPI and PETSc (main.cpp).
extern long allocationsHere;

/// Scenes and comparisons of tests that mpirun starts with 1, 2, 3 or 4 ranks; each of them runs all tests.
namespace ranks_test {

using namespace sinew;

struct World {
  int rank = 0, size = 1;
  World() {
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
  }
};

/// A cantilever of tetrahedra whose stiffness grows along it.
template <class Ode, class Linear, class... More>
auto bar(Ode ode, Linear linear, More... more) {
  const Mesh mesh = regular_grid_tetrahedra(7, 3, 3, {0, 0, 0}, {3, 1, 1});
  std::vector<int> fixed;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (mesh.positions[i][0] < 1e-9) fixed.push_back(int(i));
  std::vector<double> young;
  for (auto const& t : mesh.tetrahedra) young.push_back(1e5 * (1 + mesh.positions[std::size_t(t[0])][0]));
  return node<"root">(Gravity{{0, -9.81, 0}},
                      ode,
                      linear,
                      MeshTopology{.tetrahedra = mesh.tetrahedra},
                      MechanicalObject<Vec3d>{mesh.positions},
                      DiagonalMass<Vec3d>{.massDensity = 1000},
                      TetrahedronFEMForceField<Vec3d>{.youngModulus = young, .poissonRatio = 0.4},
                      FixedConstraint<Vec3d>{.indices = fixed},
                      more...);
}

using Positions = std::vector<Eigen::Vector3d>;
inline double distance(Positions const& a, Positions const& b) {
  double sum = a.size() == b.size() ? 0 : INFINITY;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) sum += (a[i] - b[i]).squaredNorm();
  return std::sqrt(sum);
}
inline double length(Positions const& a) { return distance(a, Positions(a.size(), Eigen::Vector3d::Zero())); }

template <class Node>
Positions velocities_in_one(Node scene, int steps, double dt) {
  Simulation sim{std::move(scene)};
  sim.init();
  for (int i = 0; i < steps; ++i) sim.animate(dt);
  return sim.root().state().velocity;
}
template <class Node>
Positions velocities(Node scene, int steps, double dt) {
  mpi::DistributedSimulation sim{std::move(scene), std::make_shared<mpi::Communicator>()};
  sim.init();
  for (int i = 0; i < steps; ++i) sim.animate(dt);
  return sim.everywhere(sim.root().state(), vec_id::velocity);
}

template <class F>
std::string error_of(F&& f) {
  try {
    f();
  } catch (Error const& error) {
    return error.what();
  }
  return "nothing was said";
}
inline bool says(std::string const& message, std::initializer_list<std::string> words) {
  for (auto const& word : words)
    if (message.find(word) == std::string::npos) return false;
  return true;
}

}  // namespace ranks_test
