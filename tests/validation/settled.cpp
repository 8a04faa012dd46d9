// SPDX-License-Identifier: BSL-1.0
#include "bars.hpp"
#include "catch.hpp"
#include "record.hpp"
#include "registry_scene.hpp"

namespace test_settled {

using namespace bars;

namespace {

const Bar bar{.length = 4, .E = 1e5, .nu = 0.3, .along = 8, .across = 2};

/// The bar bent far by its weight, under a solver: it ends at rest after `steps` steps.
template <class Solver, class Force>
auto bent(Solver solver, Force fem, Cells cells, int steps, double dt) {
  const Mesh mesh = bar.mesh(cells);
  fem.youngModulus = {bar.E}, fem.poissonRatio = bar.nu;
  RegistryScene sim{node<"root">(Gravity{{0, -9.81, 0}},
                                 solver,
                                 SparseLDLSolver<>{},
                                 MeshTopology{.tetrahedra = mesh.tetrahedra, .hexahedra = mesh.hexahedra},
                                 MechanicalObject<Vec3d>{mesh.positions},
                                 DiagonalMass<Vec3d>{.massDensity = {30}},
                                 fem,
                                 FixedConstraint<Vec3d>{.indices = points_at(mesh, 0)})};
  sim.init();
  for (int i = 0; i < steps; ++i) sim.animate(dt);
  return sim;
}

}  // namespace

TEST_CASE("what StaticSolver finds is what dynamics settle to", "[page]") {
  Record table("settled", {"element", "sag", "difference", "iterations"});
  auto check = [&](std::string name, auto fem, Cells cells) {
    INFO(name);
    auto still = bent(to_rounding(100), fem, cells, 1, 1);
    // long steps of implicit Euler with damping lose all motion
    auto moved = bent(EulerImplicitSolver{.rayleighMass = 2}, fem, cells, 400, 0.1);
    auto const &a = still.root().state().position, &b = moved.root().state().position;
    double difference = 0, speed = 0, sag = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      difference = std::max(difference, (a[i] - b[i]).norm());
      speed = std::max(speed, moved.root().state().velocity[i].norm());
      sag = std::max(sag, (a[i] - bar.mesh(cells).positions[i]).norm());
    }
    CHECK(still.root().template get<StaticSolver>().newton.converged());
    CHECK(sag > 0.3);  // far from linear
    CHECK(speed < 1e-9);
    CHECK(difference < 1e-8);
    table.row(
        name, sag, difference, int(still.root().template get<StaticSolver>().newton.corrections.size()));
  };
  check("HexahedronFEM nearest",
        HexahedronFEMForceField<Vec3d>{.method = HexahedronMethod::nearest},
        Cells::hexahedra);
  check("HexahedronFEM large",
        HexahedronFEMForceField<Vec3d>{.method = HexahedronMethod::large},
        Cells::hexahedra);
  check("TetrahedronFEM nearest",
        TetrahedronFEMForceField<Vec3d>{.method = RotationMethod::nearest},
        Cells::five);
  check(
      "TetrahedronFEM large", TetrahedronFEMForceField<Vec3d>{.method = RotationMethod::large}, Cells::five);
}

}  // namespace test_settled
