// SPDX-License-Identifier: BSL-1.0
// Sheets of triangles and springs that are cut, and memories of materials.
#include "../topology/cut_bodies.hpp"

#include <sinew/mechanics.hpp>

namespace test_cutting_surfaces {

using namespace cutting;

namespace {

/// n * n squares of 1 m, two triangles each.
Mesh sheet(int n) {
  Mesh m;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) m.positions.emplace_back(i, j, 0);
  auto at = [n](int i, int j) { return Index(i + (n + 1) * j); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      m.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      m.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  m.edges = edges_of(m.triangles);
  return m;
}
Blade along(double x, double y0, double y1) {
  return {{Point(x, y0, -1), Point(x, y0, 1)}, {Point(x, y1, -1), Point(x, y1, 1)}};
}
double area(std::vector<Point> const& x, std::vector<Triangle> const& triangles) {
  double sum = 0;
  for (auto const& t : triangles) {
    auto at = [&](std::size_t k) { return x[std::size_t(t[k])]; };
    sum += (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
  }
  return sum;
}

}  // namespace

TEST_CASE("a sheet is cut by edges, and by new ones; a partial cut is completed, and another crosses it") {
  const Mesh m = sheet(6);
  Simulation sim{
      node<"root">(EulerImplicitSolver{},
                   CGLinearSolver<>{.iterations = 200, .tolerance = 1e-12, .threshold = 1e-30},
                   node<"sheet">(MeshTopology{.triangles = m.triangles},
                                 MechanicalObject<Vec3d>{.position = m.positions},
                                 DiagonalMass<Vec3d>{.totalMass = 1},
                                 TriangleFEMForceField<Vec3d>{.youngModulus = {100}, .thickness = 0.1},
                                 FixedConstraint<Vec3d>{.indices = {0, 1, 2, 3, 4, 5, 6}}))};
  sim.init();
  auto& node = sim.at<"sheet">();
  auto check = [&](int expected) {
    auto const& triangles = node.get<MeshTopology>().triangles;
    CHECK(area(node.state().position, triangles) == Approx(36).epsilon(1e-12));
    CHECK(pieces(node.state().size(), triangles) == expected);
    CHECK(sim.potentialEnergy() < 1e-20);
    sim.animate(0.01);
    for (std::size_t i = 0; i < node.state().size(); ++i)
      CHECK((node.state().position[i] - node.state().restPosition[i]).norm() < 1e-12);
  };
  CHECK(sim.cut("sheet", along(3, -1, 3)).faces == 3);
  CHECK(node.state().size() == 49 + 3);
  check(1);
  sim.cut("sheet", along(3, 2, 7));
  CHECK(node.state().size() == 49 + 7);
  check(2);
  sim.cut("sheet", {{Point(-1, 2.4, -1), Point(-1, 2.4, 1)}, {Point(7, 2.6, -1), Point(7, 2.6, 1)}});
  check(4);
  auto const& held = node.get<FixedConstraint<Vec3d>>().indices;
  CHECK(held.size() == 8);
}

TEST_CASE("springs across a cut go, and others are with their side of it") {
  const Mesh m = sheet(4);
  std::vector<Spring> springs;
  for (auto const& e : m.edges) springs.push_back({e[0], e[1], 10, 0, {}});
  springs.push_back({0, 4, 10, 0, {}});   // above the sheet, so to say
  springs.push_back({0, 20, 10, 0, {}});  // beside the cut
  for (const double x : {2., 2.3}) {
    Simulation sim{node<"root">(EulerExplicitSolver{},
                                node<"sheet">(MeshTopology{.triangles = m.triangles},
                                              MechanicalObject<Vec3d>{.position = m.positions},
                                              DiagonalMass<Vec3d>{.totalMass = 1},
                                              StiffSpringForceField<Vec3d>{.springs = springs}))};
    sim.init();
    sim.cut("sheet", along(x, -1, 5));
    auto& node = sim.at<"sheet">();
    auto const& left = node.get<StiffSpringForceField<Vec3d>>().springs;
    CHECK(left.size() < springs.size());
    CHECK(left.size() > springs.size() / 2);
    std::vector<Edge> edges;
    for (auto const& s : left) edges.push_back({s.first, s.second});
    for (auto const& t : node.get<MeshTopology>().triangles) {
      edges.push_back({t[0], t[1]});
      edges.push_back({t[1], t[2]});
    }
    CHECK(pieces(node.state().size(), edges) == 2);
  }
}

TEST_CASE("a material remembers in the parts what it did in the whole") {
  const Body b = block(4, 2, 2);
  std::vector<Point> x;
  for (auto const& p : b.points) x.emplace_back(1.1 * p[0], p[1], p[2]);
  Simulation sim{node<"root">(EulerImplicitSolver{},
                              CGLinearSolver<>{.iterations = 200, .tolerance = 1e-12, .threshold = 1e-30},
                              node<"body">(TetrahedronTopology{b.tetrahedra},
                                           MechanicalObject<Vec3d>{.position = x, .restPosition = b.points},
                                           DiagonalMass<Vec3d>{.massDensity = 1000},
                                           TetrahedronViscoelasticityFEMForceField<Vec3d>{
                                               .materialName = ViscoelasticMaterial::MaxwellFirstOrder,
                                               .parameterSet = {1000, 0.1, 2000}},
                                           FixedConstraint<Vec3d>{.fixAll = true}))};
  sim.init();
  for (int i = 0; i < 10; ++i) sim.animate(0.01);
  auto& force = sim.at<"body">().get<TetrahedronViscoelasticityFEMForceField<Vec3d>>();
  const auto before = force.memory;
  const Cut done = sim.cut("body", Plane{2.6}.blade(-1, 3, -1, 3));
  auto const& come = done.change.of(ElementKind::tetrahedron).come;
  REQUIRE(come.size() > 8);
  REQUIRE(!before.empty());
  const std::size_t each = before.size() / b.tetrahedra.size();
  REQUIRE(force.memory.size() == each * (b.tetrahedra.size() + come.size()));
  for (std::size_t k = 0; k < come.size(); ++k)
    for (std::size_t i = 0; i < each; ++i)
      CHECK(force.memory[before.size() + k * each + i] == before[std::size_t(come[k].a) * each + i]);
  sim.animate(0.01);
}

}  // namespace test_cutting_surfaces
