// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/mass/hexahedron_composite_fem_mass.hpp>
#include <sinew/mass/mesh_matrix_mass.hpp>
#include <sinew/topology/regular_grid.hpp>
#include <sinew/topology/sparse_grid_multiple_topology.hpp>
#include <sinew/topology/sparse_grid_ramification_topology.hpp>
#include <sinew/topology/sparse_grid_topology.hpp>

#include <cmath>

namespace test_hexahedron_composite_fem_mass {

using namespace sinew;
using Eigen::Vector3d;

namespace {

using Mass = HexahedronCompositeFEMMass<Vec3d>;

bool contains(std::string const& all, std::string_view part) { return all.find(part) != all.npos; }

/// An octahedron of diameter 2 around the origin.
template <class Grid>
Grid octahedron(int n, int levels) {
  Grid grid;
  grid.n = {n, n, n};
  grid.nbVirtualFinerLevels = levels;
  for (int axis = 0; axis < 3; ++axis)
    for (const double s : {1.0, -1.0}) grid.position.push_back(s * Vector3d::Unit(axis));
  grid.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  grid.generate("body");
  return grid;
}

/// The volume of the finest cells, each as it is filled.
double filled(TopologyView const& t, std::size_t levels) {
  auto const& level = t.levels[levels - 1];
  auto const& h = t.hexahedra[0];
  auto at = [&](std::size_t k) { return t.positions[std::size_t(h[k])]; };
  const double cell = std::abs((at(1) - at(0)).dot((at(3) - at(0)).cross(at(4) - at(0))));
  double sum = 0;
  for (const double f : level.massFill) sum += f * cell * std::pow(0.125, double(levels));
  return sum;
}

double total(Mass mass, TopologyView const& topology) {
  const Vec3d::VecCoord rest(topology.positions.begin(), topology.positions.end());
  mass.init(InitContext<Vec3d>{"body", rest, topology});
  // of all points moved by one, by both forms of the mass
  const Vec3d::VecDeriv ones(rest.size(), Vector3d::Ones());
  Vec3d::VecDeriv f(rest.size(), Vector3d::Zero());
  mass.addMDx(f, rest, ones, 1);
  Vector3d sum = Vector3d::Zero();
  for (auto const& fi : f) sum += fi;
  CHECK(sum[1] == Approx(sum[0]).epsilon(1e-12));
  CHECK(mass.lumped.totalMass(rest.size()) == Approx(sum[0]).epsilon(1e-12));
  CHECK(mass.kineticEnergy(rest, ones) == Approx(1.5 * sum[0]).epsilon(1e-12));
  return sum[0];
}

}  // namespace

TEST_CASE("composite hexahedra have the mass of their cells") {
  auto check = [](auto const& grid) {
    for (const int levels : {1, 2})
      for (const CellInterpolation interpolation :
           {CellInterpolation::condensed, CellInterpolation::trilinear})
        for (const bool lumping : {false, true}) {
          CAPTURE(levels, int(interpolation), lumping);
          CHECK(total(Mass{.nbVirtualFinerLevels = levels,
                           .poissonRatio = 0.3,
                           .interpolation = interpolation,
                           .massDensity = 3,
                           .lumping = lumping},
                      grid.view()) == Approx(3 * filled(grid.view(), std::size_t(levels))).epsilon(1e-12));
        }
    // levels of cells agree in the volume that they fill, where none is split
    CHECK(filled(grid.view(), 1) == Approx(filled(grid.view(), 2)).epsilon(1e-12));
  };
  check(octahedron<SparseGridTopology>(3, 2));
  check(octahedron<SparseGridRamificationTopology>(3, 2));
  // the octahedron has 4/3, and the cells, of which those on the surface count half, come near
  CHECK(filled(octahedron<SparseGridTopology>(4, 3).view(), 3) == Approx(4 / 3.).epsilon(0.05));
}

TEST_CASE("without finer levels the mass is the consistent one of hexahedra") {
  Mesh mesh = regular_grid(3, 2, 2, {0, 0, 0}, {2, 1, 1});
  mesh.positions[7] += Vector3d(0.1, 0.2, -0.1);
  const TopologyView topology{.hexahedra = mesh.hexahedra};
  Mass mass{.massDensity = 5};
  MeshMatrixMass<Vec3d> expected{.massDensity = {5}};
  const InitContext<Vec3d> context{"body", mesh.positions, topology};
  mass.init(context);
  expected.init(context);
  for (std::size_t k = 0; k < expected.consistent.matrix.values.size(); ++k)
    CHECK(mass.consistent.matrix.values[k] == Approx(expected.consistent.matrix.values[k]).epsilon(1e-12));
}

TEST_CASE("bad composite masses are refused") {
  auto said = [](Mass mass, TopologyView const& topology) -> std::string {
    const Vec3d::VecCoord rest(topology.positions.begin(), topology.positions.end());
    try {
      check_fields(mass, "body");
      mass.init(InitContext<Vec3d>{"body", rest, topology});
    } catch (Error const& e) {
      return e.what();
    }
    return "";
  };
  const auto grid = octahedron<SparseGridTopology>(3, 1);
  CHECK(contains(said({}, {}), "body: HexahedronCompositeFEMMass<Vec3d>"));
  CHECK(contains(said({}, {}), "no hexahedron"));
  CHECK(contains(said({.nbVirtualFinerLevels = 2}, grid.view()), "the grid has 1 finer levels"));
  CHECK(contains(said({.massDensity = 0}, grid.view()), "massDensity is 0"));
  CHECK(contains(said({.massDensity = std::nan("")}, grid.view()), "massDensity is nan"));
}

}  // namespace test_hexahedron_composite_fem_mass
