// SPDX-License-Identifier: BSL-1.0
// Elements that are refined while a scene runs.
#include <sinew/mechanics.hpp>
#include <sinew/topology/border.hpp>
#include <sinew/topology/cut_pattern.hpp>
#include <sinew/topology/regular_grid.hpp>

#include "catch.hpp"
#include "error_of.hpp"

#include <Eigen/Geometry>
#include <set>

namespace test_element_refinement {

using namespace sinew;
using Catch::Matchers::Contains;
using Eigen::Vector3d;

namespace {

auto scene(Mesh const& block) {
  const std::vector<Triangle> skin = border_of(block.tetrahedra, {}).triangles;
  return Simulation{node<"root">(
      EulerImplicitSolver{},
      CGLinearSolver<>{.iterations = 500, .tolerance = 1e-15, .threshold = 1e-30},
      node<"body">(MeshTopology{.tetrahedra = block.tetrahedra},
                   MechanicalObject<Vec3d>{.position = block.positions},
                   DiagonalMass<Vec3d>{.massDensity = 3},
                   TetrahedronFEMForceField<Vec3d>{
                       .youngModulus = {100}, .poissonRatio = 0.3, .method = RotationMethod::small},
                   FixedConstraint<Vec3d>{.indices = {0, 1, 2}},
                   node<"skin">(MeshTopology{.triangles = skin}),
                   node<"look">(VisualModel{Mesh{.positions = block.positions, .triangles = skin}},
                                IdentityMapping<Vec3d, Vec3f>{})))};
}

double volume(std::vector<Tetrahedron> const& elements, std::vector<Vector3d> const& x) {
  double sum = 0;
  for (Tetrahedron const& t : elements) {
    auto side = [&](std::size_t k) { return Vector3d(x[std::size_t(t[k])] - x[std::size_t(t[0])]); };
    const double part = side(1).dot(side(2).cross(side(3))) / 6;
    CHECK(part > 0);
    sum += part;
  }
  return sum;
}
double quality(Tetrahedron const& t, std::vector<Vector3d> const& x) {
  std::array<Vector3d, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) corners[k] = x[std::size_t(t[k])];
  return simplex_quality(corners);
}
double total(DiagonalMass<Vec3d> const& mass) {
  double sum = 0;
  for (const double m : mass.lumped.mass) sum += m;
  return sum;
}
template <class Sim>
Vector3d momentum(Sim& sim) {
  auto& body = sim.template at<"body">();
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < body.state().size(); ++i)
    sum += body.template get<DiagonalMass<Vec3d>>().lumped.mass[i] * body.state().velocity[i];
  return sum;
}
// faces with one element, as often as there are: a crack would be two of them in one place
std::size_t border_faces(std::vector<Tetrahedron> const& elements) {
  return border_of(elements, {}).triangles.size();
}
Mesh block_of(int n) { return regular_grid_tetrahedra(n, n, n, {0, 0, 0}, {1, 1.1, 1.3}); }

}  // namespace

TEST_CASE("all elements of a body in motion are refined: volume, mass, momentum and energy stay") {
  const Mesh block = block_of(3);
  auto sim = scene(block);
  sim.init();
  auto& body = sim.at<"body">();
  // a motion without strain: what lies between points moves with them
  const Vector3d spin(0.3, -0.2, 0.5), speed(1, 2, 3);
  body.get<FixedConstraint<Vec3d>>().indices.clear();
  sim.init();
  for (std::size_t i = 0; i < body.state().size(); ++i)
    body.state().velocity[i] = speed + spin.cross(body.state().position[i]);
  const Vector3d before = momentum(sim);
  const double mass = total(body.get<DiagonalMass<Vec3d>>());
  const TopologyChange change = sim.refineElements("body");
  auto const& elements = body.get<MeshTopology>().tetrahedra;
  CHECK(elements.size() == 8 * block.tetrahedra.size());
  CHECK(change.of(ElementKind::tetrahedron).kept.empty());
  CHECK(change.of(ElementKind::tetrahedron).come.size() == elements.size());
  CHECK(change.points.kept.size() == block.positions.size());
  CHECK(body.state().size() == change.points.size());
  CHECK(volume(elements, body.state().restPosition) == Approx(1.43).epsilon(1e-13));
  CHECK(total(body.get<DiagonalMass<Vec3d>>()) == Approx(mass).epsilon(1e-13));
  CHECK((momentum(sim) - before).norm() < 1e-13 * before.norm());
  CHECK(sim.potentialEnergy() == Approx(0).margin(1e-12));
  for (std::size_t i = 0; i < body.state().size(); ++i)
    CHECK((body.state().velocity[i] - speed - spin.cross(body.state().position[i])).norm() < 1e-14);
  CHECK(border_faces(elements) == 4 * border_of(block.tetrahedra, {}).triangles.size());
  CHECK(sim.at<"body/skin">().get<MeshTopology>().triangles.size() == border_faces(elements));
  CHECK(sim.at<"body/look">().visual().mesh.triangles.size() == border_faces(elements));
  // bisection: no part is worse than a fixed part of the element of which it is, since there are finitely
  // many shapes; those of the longest edges first keep a third
  double worst = 1, coarse = 1;
  for (Tetrahedron const& t : elements) worst = std::min(worst, quality(t, body.state().restPosition));
  for (Tetrahedron const& t : block.tetrahedra) coarse = std::min(coarse, quality(t, block.positions));
  CHECK(worst > coarse / 3);
  sim.animate(0.01);
  CHECK((momentum(sim) - before).norm() < 1e-11 * before.norm());
}

TEST_CASE("the strain energy of a body that is deformed evenly stays when it is refined") {
  const Mesh block = block_of(3);
  auto sim = scene(block);
  sim.init();
  auto& body = sim.at<"body">();
  Eigen::Matrix3d stretch;
  stretch << 1.02, 0.01, 0, 0.01, 0.98, 0.005, 0, 0.005, 1.01;
  for (auto& x : body.state().position) x = stretch * x;
  const double energy = sim.potentialEnergy();
  REQUIRE(energy > 1e-3);
  sim.refineElements("body", {.tetrahedra = {0, 5, 17}});
  CHECK(sim.potentialEnergy() == Approx(energy).epsilon(1e-12));
  sim.refineElements("body");
  CHECK(sim.potentialEnergy() == Approx(energy).epsilon(1e-12));
}

TEST_CASE("neighbours of elements that are refined match them, again and again, at random") {
  const Mesh block = block_of(3);
  auto sim = scene(block);
  sim.init();
  auto& body = sim.at<"body">();
  unsigned random = 7;
  auto next = [&](std::size_t n) {
    return Index((random = random * 1664525u + 1013904223u) >> 8) % Index(n);
  };
  for (int round = 0; round < 6; ++round) {
    ElementNumbers some;
    for (int k = 0; k < 3; ++k) some.tetrahedra.push_back(next(body.get<MeshTopology>().tetrahedra.size()));
    const auto was = body.get<MeshTopology>().tetrahedra;
    const TopologyChange change = sim.refineElements("body", some);
    auto const& now = body.get<MeshTopology>().tetrahedra;
    auto const& r = change.of(ElementKind::tetrahedron);
    REQUIRE(now.size() == r.size());
    for (std::size_t i = 0; i < r.kept.size(); ++i) CHECK(now[i] == was[std::size_t(r.kept[i])]);
    // each part lies in the element of which it is: their volumes add up to its own
    std::vector<double> left(was.size());
    auto const& x = body.state().restPosition;
    for (std::size_t i = 0; i < r.come.size(); ++i)
      left[std::size_t(r.come[i].a)] += volume({now[r.kept.size() + i]}, x);
    for (std::size_t e = 0; e < was.size(); ++e)
      if (!r.stays(Index(e))) CHECK(left[e] == Approx(volume({was[e]}, x)).epsilon(1e-12));
    CHECK(volume(now, x) == Approx(1.43).epsilon(1e-12));
    // the border lies in the faces of the block, and nowhere else: no crack
    for (Triangle const& f : border_of(now, {}).triangles) {
      bool outside = false;
      for (int c = 0; c < 3; ++c)
        for (const double at : {0.0, c == 0 ? 1.0 : c == 1 ? 1.1 : 1.3}) {
          bool on = true;
          for (const Index p : f) on = on && std::abs(x[std::size_t(p)][c] - at) < 1e-12;
          outside = outside || on;
        }
      CHECK(outside);
    }
    sim.animate(0.01);
  }
  CHECK(body.get<MeshTopology>().tetrahedra.size() > 4 * block.tetrahedra.size() / 3);
}

TEST_CASE("a sheet and its edges are refined, with the material of each triangle") {
  Simulation sim{node<"root">(
      EulerImplicitSolver{},
      CGLinearSolver<>{.iterations = 300, .tolerance = 1e-15, .threshold = 1e-30},
      node<"sheet">(MeshTopology{.edges = {{0, 1}, {1, 2}, {0, 2}, {1, 3}, {2, 3}},
                                 .triangles = {{0, 1, 2}, {1, 3, 2}}},
                    MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {2, 3, 1}}},
                    DiagonalMass<Vec3d>{.massDensity = 5},
                    TriangleFEMForceField<Vec3d>{.youngModulus = {100, 200}, .poissonRatio = {0.2, 0.3}},
                    FixedConstraint<Vec3d>{.indices = {0, 1}}))};
  sim.init();
  auto& sheet = sim.at<"sheet">();
  sim.refineElements("sheet", {.triangles = {0}});
  // the diagonal is parted in the other triangle, too
  CHECK(sheet.get<MeshTopology>().triangles.size() == 6);
  CHECK(sheet.get<TriangleFEMForceField<Vec3d>>().youngModulus ==
        std::vector<double>{100, 100, 100, 100, 200, 200});
  std::set<Edge> edges, listed;
  for (Triangle const& t : sheet.get<MeshTopology>().triangles)
    for (std::size_t k = 0; k < 3; ++k) edges.insert(sorted_corners(Edge{t[k], t[(k + 1) % 3]}));
  for (Edge const& e : sheet.get<MeshTopology>().edges) listed.insert(sorted_corners(e));
  CHECK(listed == edges);
  CHECK(sheet.get<MeshTopology>().edges.size() == edges.size());
  // the middle of the edge that is held is held
  CHECK(sheet.get<FixedConstraint<Vec3d>>().indices.size() == 3);
  sim.animate(0.01);
}

TEST_CASE("what cannot be refined is refused, and the scene is what it was") {
  const Mesh block = block_of(2);
  auto sim = scene(block);
  CHECK_THROWS_AS(sim.refineElements("body"), Error);  // before init
  sim.init();
  CHECK_THAT(error_of([&] { sim.refineElements("body", {.tetrahedra = {1000}}); }),
             Contains("there is no tetrahedron 1000 to refine"));
  CHECK_THAT(error_of([&] { sim.refineElements("body", {.tetrahedra = {-1}}); }), Contains("tetrahedron -1"));
  CHECK_THAT(error_of([&] { sim.refineElements("nobody"); }), Contains("no topology at this path"));
  CHECK(sim.at<"body">().get<MeshTopology>().tetrahedra == block.tetrahedra);
  Simulation prism{node<"root">(
      EulerExplicitSolver{},
      MeshTopology{.prisms = {{0, 1, 2, 3, 4, 5}}},
      MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}},
      UniformMass<Vec3d>{})};
  prism.init();
  CHECK_THAT(
      error_of([&] { prism.refineElements(""); }),
      Contains("prism 0 would be parted, and elements of its kind are not refined while a scene runs"));
  CHECK(prism.root().state().size() == 6);
}

}  // namespace test_element_refinement
