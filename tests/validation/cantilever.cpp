// SPDX-License-Identifier: BSL-1.0
#include "bars.hpp"
#include "catch.hpp"
#include "record.hpp"

namespace test_cantilever {

using namespace bars;

namespace {

const HexahedronFEMForceField<Vec3d> hexahedra{.method = HexahedronMethod::nearest};
const TetrahedronFEMForceField<Vec3d> tetrahedra{.method = RotationMethod::nearest};

double hexahedra_tip(Bar const& bar) { return tip_against_theory(bar, Cells::hexahedra, hexahedra); }
double tetrahedra_tip(Bar const& bar, Cells cells) { return tip_against_theory(bar, cells, tetrahedra); }

}  // namespace

TEST_CASE("cantilevers of hexahedra and tetrahedra converge to Timoshenko's beam with order 2", "[page]") {
  // without Poisson's effect, so that the clamp holds back nothing that the beam has
  Record curve("cantilever", {"element", "h", "error"}),
      table("cantilever_table", {"element", "across", "points", "ratio"});
  auto check = [&](std::string name, auto&& tip) {
    INFO(name);
    double excess[4];  // of stiffness
    for (int i = 0; i < 4; ++i) {
      const int n = 1 << i;
      const double ratio = tip(Bar{.along = 10 * n, .across = n});
      excess[i] = 1 / ratio - 1;
      curve.row(name, 1.0 / n, excess[i]);
      table.row(name, n, (10 * n + 1) * (n + 1) * (n + 1), ratio);
    }
    // What is left at h = 0 is the slip of sections near the clamp, which the beam does not know: 1e-4 here.
    // The next term of the error is of h^4, and so smaller by h^2.
    CHECK(std::log2(excess[2] / excess[3]) == Approx(2).margin(0.05));
    CHECK(std::abs(4 * excess[3] - excess[2]) / 3 < 0.003);
    return excess[3];
  };
  CHECK(check("HexahedronFEM", hexahedra_tip) < 0.01);
  CHECK(check("TetrahedronFEM 5 a cell", [](Bar const& bar) { return tetrahedra_tip(bar, Cells::five); }) <
        0.04);
  CHECK(check("TetrahedronFEM 6 a cell", [](Bar const& bar) { return tetrahedra_tip(bar, Cells::six); }) <
        0.06);
}

TEST_CASE("all methods of rotation are the same at small load") {
  const Bar bar{.nu = 0.3, .along = 10, .across = 2};
  const double hexahedron = hexahedra_tip(bar), tetrahedron = tetrahedra_tip(bar, Cells::six);
  // one step from the undeformed body, where all have the tangent of linear elasticity
  for (const HexahedronMethod method : {HexahedronMethod::small, HexahedronMethod::large})
    CHECK(tip_against_theory(bar, Cells::hexahedra, HexahedronFEMForceField<Vec3d>{.method = method}) ==
          Approx(hexahedron).epsilon(1e-9));
  for (const RotationMethod method : {RotationMethod::small, RotationMethod::large, RotationMethod::gradient})
    CHECK(tip_against_theory(bar, Cells::six, TetrahedronFEMForceField<Vec3d>{.method = method}) ==
          Approx(tetrahedron).epsilon(1e-9));
}

TEST_CASE("hexahedra lock in bending by the shear that they cannot do without", "[page]") {
  // A known defect. In bending of curvature k the section of an element of length a leans evenly along it,
  // while its axis stays straight: a shear of k x, which costs G k^2 a^2 / 24 where bending costs E k^2 b^2 /
  // 24, with b the whole height of the bar. So the bar turns too little, by 1 / (1 + G/E (a/b)^2).
  Record curve("hexahedra_bending", {"a", "ratio", "closed form"});
  for (const double a : {0.125, 0.25, 0.5, 1.0, 2.0, 4.0})
    for (const int across : {1, 2}) {
      const Bar bar{.length = 8, .along = int(8 / a), .across = across};
      const Mesh mesh = bar.mesh(Cells::hexahedra);
      // a couple of forces y on the end; the other end is a plane of symmetry
      const double moment = 1e-4 * bar.E * bar.inertia() / bar.length;
      ConstantForceField<Vec3d> load = on_end_face(mesh, bar, {1, 0, 0});
      double couple = 0;
      for (std::size_t k = 0; k < load.indices.size(); ++k) {
        const double y = mesh.positions[std::size_t(load.indices[k])][1];
        load.forces[k][0] *= y;
        couple += load.forces[k][0] * y;
      }
      for (auto& f : load.forces) f *= moment / couple;
      auto fem = hexahedra;
      fem.youngModulus = {bar.E}, fem.poissonRatio = 0;
      auto sim = loaded(
          mesh,
          fem,
          load,
          PartialFixedConstraint<Vec3d>{.indices = points_at(mesh, 0), .fixedDirections = {1, 0, 0}},
          PartialFixedConstraint<Vec3d>{
              .indices = points_where(
                  mesh, [](Vector3d const& p) { return p[0] < 1e-9 && p[1] < 0 && std::abs(p[2]) > 0.4; }),
              .fixedDirections = {0, 1, 1}});
      const auto top = points_where(mesh, [&](Vector3d const& p) { return p[0] > 7.99 && p[1] > 0.49; });
      const double rotation = mean_way(sim, mesh, top, 0) / (bar.width / 2),
                   theory = moment * bar.length / (bar.E * bar.inertia());
      const double closed = 1 / (1 + 0.5 * a * a);
      CHECK(rotation / theory == Approx(closed).epsilon(1e-8));
      if (across == 1) curve.row(a, rotation / theory, closed);
    }
}

TEST_CASE("linear tetrahedra and hexahedra lock as Poisson's ratio nears 1/2", "[page]") {
  // A known defect: elements whose volume cannot change have no way left to bend. With a full clamp the body
  // itself differs from the beam by some percent.
  Record curve("locking", {"element", "compressibility", "ratio"});
  auto at = [&](std::string name, int across, auto&& tip) {
    std::vector<double> ratios;
    for (const double gap : {0.2, 0.1, 0.03, 0.01, 0.003, 0.001, 1e-4, 1e-5}) {
      ratios.push_back(tip(Bar{.length = 5, .nu = 0.5 - gap, .along = 5 * across, .across = across}));
      curve.row(text(name, ' ', across, " across"), gap, ratios.back());
    }
    return ratios;
  };
  auto six = [](Bar const& bar) { return tetrahedra_tip(bar, Cells::six); };
  for (const int across : {2, 4}) {
    const auto ofTetrahedra = at("TetrahedronFEM", across, six),
               ofHexahedra = at("HexahedronFEM", across, hexahedra_tip);
    for (std::size_t i = 1; i < ofTetrahedra.size(); ++i) {
      CHECK(ofTetrahedra[i] < ofTetrahedra[i - 1]);
      CHECK(ofHexahedra[i] < ofHexahedra[i - 1]);
    }
    CHECK(ofTetrahedra.front() > 0.4);
    CHECK(ofTetrahedra.back() < 0.05);
    CHECK(ofHexahedra.front() > 0.85);
    CHECK(ofHexahedra.back() < 0.9 * ofHexahedra.front());
  }
}

}  // namespace test_cantilever
