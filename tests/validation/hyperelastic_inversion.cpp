// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "registry_scene.hpp"

#include <sinew/force/tetrahedron_hyperelasticity.hpp>
#include <sinew/sinew.hpp>
#include <sinew/solver/sparse_ldl_solver.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace test_hyperelastic_inversion {

using namespace sinew;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

using Body = TetrahedronHyperelasticityFEMForceField<Vec3d>;
using Material = HyperelasticMaterial;

const std::vector<std::pair<Material, std::vector<double>>> materials{
    {Material::ArrudaBoyce, {100, 500}},
    {Material::StVenantKirchhoff, {100, 150}},
    {Material::NeoHookean, {100, 150}},
    {Material::MooneyRivlin, {30, 20, 500}},
    {Material::Ogden, {200, 3, 500}},
    {Material::Ogden, {120, 1.3, 40, 5, 20, -2, 500}},
    {Material::StableNeoHookean, {100, 150}}};

/// The unit cube in 40 tetrahedra.
const Mesh cube = regular_grid_tetrahedra(3, 3, 3, {0, 0, 0}, {1, 1, 1});

}  // namespace

TEST_CASE("bodies with inverted elements come back to their shape") {
  for (auto const& [material, parameters] : materials) {
    INFO(enum_names(Material{})[std::size_t(material)]);
    Body body;
    body.materialName = material;
    body.parameterSet = parameters;
    body.matrixRegularization = true;
    RegistryScene sim{node<"root">(EulerImplicitSolver{.rayleighMass = 2},
                                   SparseLDLSolver<CompressedRowSparseMatrixMat3x3d>{},
                                   TetrahedronTopology{cube.tetrahedra},
                                   MechanicalObject<Vec3d>{cube.positions},
                                   UniformMass<Vec3d>{.totalMass = 1},
                                   body)};
    sim.init();
    auto& x = sim.root().state().position;
    x[13] = {1.15, 0.6, 0.55};  // the point in the middle, pushed out through a face
    int inverted = 0;
    for (auto const& t : cube.tetrahedra) {
      Matrix3d edges;
      for (int c = 0; c < 3; ++c) edges.col(c) = x[std::size_t(t[std::size_t(c) + 1])] - x[std::size_t(t[0])];
      inverted += edges.determinant() < 0;
    }
    CHECK(inverted >= 4);
    for (int i = 0; i < 400; ++i) sim.animate(0.01);
    // velocities decay by exp(-2 t / 2) in the 4 s at least: 2e-2, lengths of up to 1 m with them
    double largest = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        largest = std::max(largest,
                           std::abs((x[i] - x[j]).norm() - (cube.positions[i] - cube.positions[j]).norm()));
    CHECK(largest < 0.02);
  }
}

}  // namespace test_hyperelastic_inversion
