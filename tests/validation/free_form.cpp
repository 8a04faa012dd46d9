// SPDX-License-Identifier: BSL-1.0
#include "bars.hpp"
#include "catch.hpp"
#include "record.hpp"

#include <sinew/topology/implicit_surface.hpp>
#include <sinew/topology/isosurface_stuffing.hpp>
#include <sinew/topology/surface_mesh.hpp>

using namespace bars;

namespace {

const LiverShape liver;
Mesh liver_skin() { return surface(liver, liver.box_min(), liver.box_max(), 0.012); }

/// The cells of a grid that touch the skin or lie inside it.
SparseGridTopology cells_around(Mesh const& skin, double width, bool onlyInside = false) {
  return {.position = skin.positions,
          .triangles = skin.triangles,
          .cellWidth = width,
          .onlyInsideCells = onlyInside};
}
double volume_of(SparseGridTopology grid) {
  grid.generate("grid");
  auto const& h = grid.hexahedra[0];
  const Vector3d a = grid.points[std::size_t(h[0])], b = grid.points[std::size_t(h[6])];
  return (b - a).prod() * double(grid.hexahedra.size());
}

/// A grid of cells with a force field, which carries the skin.
template <class Force, class... More>
auto carried(Mesh const& skin, SparseGridTopology const& cells, Force const& force, More const&... more) {
  return Simulation{node<"grid">(
      to_rounding(),
      SparseLDLSolver<>{},
      cells,
      MechanicalObject<Vec3d>{},
      force,
      more...,
      node<"skin">(MechanicalObject<Vec3d>{skin.positions}, BarycentricMapping<Vec3d, Vec3d>{}))};
}

/// The outer points of the grid are moved by an affine map, the inner ones find their balance.
template <class Force>
double affine_error(Mesh const& skin, Force const& force) {
  Eigen::Matrix3d F;
  F << 1.04, 0.03, -0.02, 0.01, 0.97, 0.02, -0.02, 0.04, 1.05;
  F = Eigen::AngleAxisd(0.8, Vector3d(1, 2, -2) / 3) * F;
  const Vector3d t(0.3, -0.1, 0.2);
  auto sim = carried(skin, cells_around(skin, 0.02), force, FixedConstraint<Vec3d>{});
  sim.init();
  auto const& grid = sim.root().template get<SparseGridTopology>();
  std::vector<int> cells(grid.points.size(), 0), outer;
  for (auto const& h : grid.hexahedra)
    for (const int i : h) ++cells[std::size_t(i)];
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (cells[i] < 8) outer.push_back(int(i));
  CHECK(outer.size() + 50 < grid.points.size());
  sim.root().template get<FixedConstraint<Vec3d>>().indices = outer;
  sim.init();
  auto& x = sim.root().state().position;
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = F * grid.points[i] + t;
    // inner points start elsewhere
    if (cells[i] == 8) x[i] += 0.002 * Vector3d(std::sin(3.0 * double(i)), std::cos(5.0 * double(i)), 0.5);
  }
  sim.animate(1);
  auto const& moved = sim.template at<"skin">().state().position;
  double worst = 0;
  for (std::size_t i = 0; i < moved.size(); ++i)
    worst = std::max(worst, (moved[i] - (F * skin.positions[i] + t)).norm());
  return worst;
}

}  // namespace

TEST_CASE("the skin of a liver in a sparse grid reproduces affine motion exactly") {
  const Mesh skin = liver_skin();
  HexahedronFEMForceField<Vec3d> hexahedra{.method = HexahedronMethod::polar};
  hexahedra.youngModulus = {5000}, hexahedra.poissonRatio = 0.3;
  // Newton's residual of 1e-12 of some 10 N, over stiffnesses of 100 N/m
  CHECK(affine_error(skin, hexahedra) < 1e-11);
  // each inner point of a lattice has its neighbours in pairs on opposite sides: in balance under any affine
  // map
  CHECK(affine_error(skin, RegularGridSpringForceField<Vec3d>{.stiffness = 10, .damping = 0}) < 1e-11);
}

TEST_CASE("a sparse grid is heavier than its body by a layer of cells") {
  // a known property: cells on the surface count whole. Half a cell beyond it on average, and with
  // onlyInsideCells as much too few.
  const Mesh skin = liver_skin();
  double volume = 0;
  for (auto const& t : skin.triangles)
    volume += skin.positions[std::size_t(t[0])].dot(
                  skin.positions[std::size_t(t[1])].cross(skin.positions[std::size_t(t[2])])) /
              6;
  Record curve("free_form_volume", {"cells", "width", "ratio"});
  double touched[3], inside[3];
  for (int i = 0; i < 3; ++i) {
    const double width = 0.02 / (1 << i);
    touched[i] = volume_of(cells_around(skin, width)) / volume;
    inside[i] = volume_of(cells_around(skin, width, true)) / volume;
    curve.row("all that touch", width * 1000, touched[i]);
    curve.row("inside only", width * 1000, inside[i]);
    CHECK(touched[i] > 1);
    CHECK(inside[i] < 1);
  }
  // order 1
  CHECK(std::log2((touched[1] - 1) / (touched[2] - 1)) == Approx(1).margin(0.25));
  CHECK(std::log2((1 - inside[1]) / (1 - inside[2])) == Approx(1).margin(0.25));
}

TEST_CASE("a liver in a grid of hexahedra sags as one of tetrahedra does") {
  // held on its left, small strains; how far the skin sinks on average
  const Mesh skin = liver_skin();
  const double E = 1e6, nu = 0.3, density = 1000, left = liver.box_min()[0] + 0.05;
  auto sink = [&](auto& sim) {
    sim.init();
    sim.animate(1);
    auto const& moved = sim.template at<"skin">().state().position;
    double sum = 0;
    for (std::size_t i = 0; i < moved.size(); ++i) sum += skin.positions[i][1] - moved[i][1];
    return sum / double(moved.size());
  };
  auto held = [&](std::vector<Vector3d> const& points) {
    FixedConstraint<Vec3d> fixed{.indices = {}};
    for (std::size_t i = 0; i < points.size(); ++i)
      if (points[i][0] < left + 1e-9) fixed.indices.push_back(int(i));
    return fixed;
  };
  const Mesh volume = tetrahedralize_count(liver, liver.box_min(), liver.box_max(), 12000);
  TetrahedronFEMForceField<Vec3d> tetrahedra{.method = RotationMethod::small};
  tetrahedra.youngModulus = {E}, tetrahedra.poissonRatio = nu;
  Simulation reference{node<"body">(
      Gravity{{0, -9.81, 0}},
      to_rounding(1),
      SparseLDLSolver<>{},
      TetrahedronTopology{volume.tetrahedra},
      MechanicalObject<Vec3d>{volume.positions},
      DiagonalMass<Vec3d>{.massDensity = {density}},
      tetrahedra,
      held(volume.positions),
      node<"skin">(MechanicalObject<Vec3d>{skin.positions}, BarycentricMapping<Vec3d, Vec3d>{}))};
  const double expected = sink(reference);

  Record table("free_form", {"width", "cells", "ratio"});
  for (const double width : {0.03, 0.02, 0.01}) {
    SparseGridTopology grid = cells_around(skin, width);
    // a plane of the grid where the tetrahedra are held
    grid.min = Vector3d(left - std::ceil(0.06 / width) * width, -0.08, -0.08);
    grid.max = Vector3d(0.13, 0.08, 0.08);
    grid.generate("grid");
    HexahedronFEMForceField<Vec3d> hexahedra{.method = HexahedronMethod::small};
    hexahedra.youngModulus = {E}, hexahedra.poissonRatio = nu;
    auto sim = carried(skin,
                       grid,
                       hexahedra,
                       Gravity{{0, -9.81, 0}},
                       DiagonalMass<Vec3d>{.massDensity = {density}},
                       held(grid.points));
    const double ratio = sink(sim) / expected;
    table.row(width * 1000, int(grid.hexahedra.size()), ratio);
    // stiffer by the cells that the surface cuts, as a staircase of them comes to lie
    CHECK(ratio == Approx(0.9).margin(0.1));
  }
}
