// SPDX-License-Identifier: BSL-1.0
// Grids as the bodies of typed scenes.
#include <sinew/sinew.hpp>
#include <sinew/topology/mesh_topology.hpp>
#include <sinew/topology/regular_grid_topology.hpp>

#include "catch.hpp"

namespace test_grid_scene {

using namespace sinew;

namespace {

template <class Topology>
auto scene(Topology topology, std::vector<Eigen::Vector3d> const& points) {
  return Simulation{node<"root">(
      Gravity{{0, 0, -10}},
      EulerImplicitSolver{},
      CGLinearSolver<>{.iterations = 200, .tolerance = 1e-12},
      node<"body">(
          topology,
          MechanicalObject<Vec3d>{points},
          DiagonalMass<Vec3d>{.massDensity = 100},
          TetrahedronFEMForceField<Vec3d>{{1e4}, 0.3, RotationMethod::nearest},
          node<"inner">(MechanicalObject<Vec3d>{{{0.51, 0.32, 0.77}}}, BarycentricMapping<Vec3d, Vec3d>{})))};
}

}  // namespace

TEST_CASE("a body of hexahedra falls as it stands, and carries a point") {
  RegularGridTopology grid{.n = {4, 3, 5}};
  grid.generate("test");
  const MeshTopology mesh{.hexahedra = grid.hexahedra};
  auto check = [&](auto sim) {
    sim.init();
    const int steps = 20;
    for (int i = 0; i < steps; ++i) sim.animate(0.01);
    // x after n implicit steps: g dt^2 n (n + 1) / 2
    const Eigen::Vector3d fallen(0, 0, -10 * 1e-4 * steps * (steps + 1) / 2);
    auto const& x = sim.template at<"body">().state().position;
    for (std::size_t i = 0; i < x.size(); ++i) CHECK((x[i] - grid.position[i] - fallen).norm() < 1e-9);
    auto const& inner = sim.template at<"body/inner">().state().position[0];
    CHECK((inner - Eigen::Vector3d(0.51, 0.32, 0.77) - fallen).norm() < 1e-9);
  };
  check(scene(grid, grid.position));
  check(scene(mesh, grid.position));
}

}  // namespace test_grid_scene
