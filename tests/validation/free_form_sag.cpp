// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "free_form.hpp"
#include "record.hpp"
#include "registry_scene.hpp"

#include <sinew/topology/isosurface_stuffing.hpp>

namespace test_free_form_sag {

using namespace free_form;

TEST_CASE("a liver in a grid of hexahedra sags as one of tetrahedra does", "[page]") {
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
  RegistryScene reference{node<"body">(
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

}  // namespace test_free_form_sag
