// SPDX-License-Identifier: BSL-1.0
// The same scene for many values of a parameter, in threads: how far cantilevers of several stiffnesses sink.
#include <sinew/mechanics.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <cstdio>
#include <future>
#include <vector>

using namespace sinew;

/// How far the end of a beam sinks under its weight, in equilibrium [m]; `youngModulus` [Pa].
double sag(Mesh const& beam, std::vector<int> const& held, double youngModulus) {
  Simulation sim{
      node<"beam">(Gravity{{0, -9.81, 0}},
                   StaticSolver{.maxNbIterationsNewton = 20},
                   SparseLDLSolver<>{},
                   MeshTopology{.hexahedra = beam.hexahedra},
                   MechanicalObject<Vec3d>{beam.positions},
                   UniformMass<Vec3d>{.totalMass = 1},
                   HexahedronFEMForceField<Vec3d>{.youngModulus = {youngModulus}, .poissonRatio = 0.3},
                   FixedConstraint<Vec3d>{.indices = held})};
  sim.init();
  sim.animate(1);
  return beam.positions.back().y() - sim.root().state().position.back().y();
}

int main() {
  const Mesh beam = regular_grid(21, 5, 5, {0, 0, 0}, {1, 0.1, 0.1});
  std::vector<int> held;
  for (std::size_t i = 0; i < beam.positions.size(); ++i)
    if (beam.positions[i].x() == 0) held.push_back(int(i));

  // each thread has a simulation of its own: nothing is shared but what nobody changes
  std::vector<std::future<double>> sags;
  const std::vector<double> youngModuli{1e6, 2e6, 4e6, 8e6};
  for (const double e : youngModuli) sags.push_back(std::async(std::launch::async, sag, beam, held, e));
  std::puts("Young's modulus [Pa]   sag [m]");
  for (std::size_t i = 0; i < sags.size(); ++i) std::printf("%20.3g %9.5f\n", youngModuli[i], sags[i].get());
}
