// SPDX-License-Identifier: BSL-1.0
// Elements that come while a scene runs.
#include <sinew/mechanics.hpp>
#include <sinew/topology/border.hpp>
#include <sinew/topology/regular_grid_topology.hpp>

#include "catch.hpp"
#include "error_of.hpp"

namespace test_element_addition {

using namespace sinew;
using Catch::Matchers::Contains;

namespace {

// a block of 2 x 2 x 2 cells, six tetrahedra each
struct Block {
  std::vector<Eigen::Vector3d> points{};
  std::vector<Tetrahedron> all{};

  Block() {
    RegularGridTopology grid{.n = {3, 3, 3}, .min = {0, 0, 0}, .max = {2, 2, 2}};
    grid.generate("grid");
    points = grid.position;
    all = hexahedra_to_tetrahedra(grid.hexahedra);
  }
  std::vector<Tetrahedron> first(std::size_t n) const {
    return {all.begin(), all.begin() + std::ptrdiff_t(n)};
  }
  std::vector<Tetrahedron> behind(std::size_t n) const {
    return {all.begin() + std::ptrdiff_t(n), all.end()};
  }
};

auto scene(Block const& block, std::vector<Tetrahedron> const& tetrahedra) {
  const std::vector<Triangle> skin = border_of(tetrahedra, {}).triangles;
  return Simulation{node<"root">(
      Gravity{{0, 0, -1}},
      EulerImplicitSolver{},
      CGLinearSolver<>{.iterations = 300, .tolerance = 1e-15, .threshold = 1e-30},
      node<"body">(
          MeshTopology{.tetrahedra = tetrahedra},
          MechanicalObject<Vec3d>{.position = block.points},
          DiagonalMass<Vec3d>{.massDensity = 3},
          TetrahedronFEMForceField<Vec3d>{.youngModulus = {100}, .poissonRatio = 0.3},
          FixedConstraint<Vec3d>{.indices = {0, 1, 2}},
          node<"skin">(MeshTopology{.triangles = skin}, SurfacePressureForceField<Vec3d>{.pressure = 2}),
          node<"look">(VisualModel{Mesh{.positions = block.points, .triangles = skin}},
                       IdentityMapping<Vec3d, Vec3f>{})))};
}

template <class List>
std::vector<typename List::value_type> sorted(List list) {
  for (auto& e : list) e = sorted_corners(e);
  std::sort(list.begin(), list.end());
  return list;
}
double total(DiagonalMass<Vec3d> const& mass) {
  double sum = 0;
  for (const double m : mass.lumped.mass) sum += m;
  return sum;
}

}  // namespace

TEST_CASE("a body that gets its last elements at rest goes on as one that had them from the start") {
  const Block block;
  const std::size_t n = block.all.size() - 3;
  auto whole = scene(block, block.all), grown = scene(block, block.first(n));
  whole.init(), grown.init();
  const TopologyChange change = grown.addElements("body", {.tetrahedra = block.behind(n)});
  CHECK(change.of(ElementKind::tetrahedron).kept.size() == n);
  CHECK(change.of(ElementKind::tetrahedron).come.size() == 3);
  auto& a = whole.at<"body">();
  auto& b = grown.at<"body">();
  CHECK(b.get<MeshTopology>().tetrahedra == block.all);
  CHECK(total(b.get<DiagonalMass<Vec3d>>()) == Approx(3 * 8));
  CHECK(b.get<DiagonalMass<Vec3d>>().lumped.mass == a.get<DiagonalMass<Vec3d>>().lumped.mass);
  auto const& skin = grown.at<"body/skin">().get<MeshTopology>().triangles;
  CHECK(sorted(skin) == sorted(whole.at<"body/skin">().get<MeshTopology>().triangles));
  CHECK(grown.at<"body/look">().visual().mesh.triangles.size() == skin.size());
  for (int i = 0; i < 30; ++i) whole.animate(0.02), grown.animate(0.02);
  // faces of the skin stand in another order: rounding
  double furthest = 0;
  for (std::size_t i = 0; i < block.points.size(); ++i)
    furthest = std::max(furthest, (a.state().position[i] - b.state().position[i]).norm());
  CHECK(furthest < 1e-9);
  CHECK((a.state().position[26] - block.points[26]).norm() > 0.01);
}

TEST_CASE("what is there moves on as it did when elements come, and a copy is a way back") {
  const Block block;
  const std::size_t n = block.all.size() - 2;
  auto sim = scene(block, block.first(n));
  sim.init();
  for (int i = 0; i < 5; ++i) sim.animate(0.02);
  auto before = sim;
  auto const x = sim.at<"body">().state().position, v = sim.at<"body">().state().velocity;
  sim.addElements("body", {.tetrahedra = block.behind(n)});
  CHECK(sim.at<"body">().state().position == x);
  CHECK(sim.at<"body">().state().velocity == v);
  CHECK(sim.at<"body">().state().restPosition == block.points);
  sim.animate(0.02);
  auto other = before;
  other.addElements("body", {.tetrahedra = block.behind(n)});
  other.animate(0.02);
  CHECK(other.at<"body">().state().position == sim.at<"body">().state().position);
  CHECK(before.at<"body">().get<MeshTopology>().tetrahedra == block.first(n));
  // and they may go again
  other.removeElements("body", {.tetrahedra = {Index(n), Index(n) + 1}});
  CHECK(other.at<"body">().get<MeshTopology>().tetrahedra == block.first(n));
  CHECK(total(other.at<"body">().get<DiagonalMass<Vec3d>>()) ==
        Approx(total(before.at<"body">().get<DiagonalMass<Vec3d>>())));
}

TEST_CASE("a triangle is parted at a point in it: area, mass, momentum and materials stay") {
  const std::vector<Eigen::Vector3d> points{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {2, 3, 1}};
  Simulation sim{node<"root">(
      Gravity{{0, 0, -1}},
      EulerImplicitSolver{},
      CGLinearSolver<>{.iterations = 300, .tolerance = 1e-15, .threshold = 1e-30},
      node<"sheet">(MeshTopology{.triangles = {{0, 1, 2}, {1, 3, 2}}},
                    MechanicalObject<Vec3d>{.position = points,
                                            .velocity = {{1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {1, 1, 1}}},
                    DiagonalMass<Vec3d>{.massDensity = 5},
                    TriangleFEMForceField<Vec3d>{.youngModulus = {100, 200}, .poissonRatio = {0.2, 0.3}},
                    FixedConstraint<Vec3d>{.indices = {0, 1, 2}},
                    node<"edges">(MeshTopology{.edges = {{0, 1}, {1, 3}, {3, 2}, {2, 0}}})))};
  sim.init();
  auto& sheet = sim.at<"sheet">();
  auto momentum = [&] {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < sheet.state().size(); ++i)
      sum += sheet.get<DiagonalMass<Vec3d>>().lumped.mass[i] * sheet.state().velocity[i];
    return sum;
  };
  // momentum of free points: the projection of constraints has no say here
  sheet.state().velocity = {{1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {1, 1, 1}};
  const Eigen::Vector3d was = momentum();
  const double mass = total(sheet.get<DiagonalMass<Vec3d>>());
  AddedElements parts{.points = {{0, 1, 0.25, 2, 0.5}}, .triangles = {{0, 1, 4}, {1, 2, 4}, {2, 0, 4}}};
  parts.ancestors[1] = {0, 0, 0};
  sim.addElements("sheet", parts);
  sheet.state().velocity[0] = {1, 0, 0}, sheet.state().velocity[1] = {0, 2, 0};
  sheet.state().velocity[2] = {0, 0, 3}, sheet.state().velocity[4] = {0.25, 0.5, 1.5};
  sim.removeElements("sheet", {.triangles = {0}});
  auto const& state = sheet.state();
  CHECK((state.restPosition[4] - Eigen::Vector3d(0.5, 1.5, 0)).norm() < 1e-15);
  CHECK(sheet.get<TriangleFEMForceField<Vec3d>>().youngModulus == std::vector<double>{200, 100, 100, 100});
  CHECK(sheet.get<FixedConstraint<Vec3d>>().indices == std::vector<int>{0, 1, 2, 4});
  CHECK(total(sheet.get<DiagonalMass<Vec3d>>()) == Approx(mass).epsilon(1e-14));
  sheet.state().velocity[0] = {1, 0, 0}, sheet.state().velocity[1] = {0, 2, 0};
  sheet.state().velocity[2] = {0, 0, 3}, sheet.state().velocity[4] = {0.25, 0.5, 1.5};
  CHECK((momentum() - was).norm() < 1e-13);
  // the border is what it was
  CHECK(sim.at<"sheet/edges">().get<MeshTopology>().edges.size() == 4);
  sim.animate(0.01);
}

TEST_CASE(
    "a point has the place, rest place and velocity between its own; UniformMass keeps what a point weighs") {
  Simulation sim{node<"root">(EulerExplicitSolver{},
                              MeshTopology{.triangles = {{0, 1, 2}}},
                              MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}},
                                                      .velocity = {{1, 0, 0}, {0, 2, 0}, {0, 0, 3}},
                                                      .restPosition = {{0, 0, 1}, {2, 0, 1}, {0, 2, 1}}},
                              UniformMass<Vec3d>{.totalMass = 6})};
  sim.init();
  sim.addElements("", {.points = {{0, 1, 0.25, 2, 0.5}, {0, 1, 0.5}}});
  auto const& s = sim.root().state();
  REQUIRE(s.size() == 5);
  CHECK(s.position[3] == Eigen::Vector3d(1, 2, 0));
  CHECK(s.restPosition[3] == Eigen::Vector3d(0.5, 1, 1));
  CHECK(s.velocity[3] == Eigen::Vector3d(0.25, 0.5, 1.5));
  CHECK(s.position[4] == Eigen::Vector3d(2, 0, 0));
  CHECK(*sim.root().get<UniformMass<Vec3d>>().vertexMass == 2);
  sim.animate(0.5);
  CHECK(s.position[3] == Eigen::Vector3d(1.125, 2.25, 0.75));
}

TEST_CASE("triangles and edges of quads follow, and faces of hexahedra") {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 12; ++i) points.push_back({double(i % 3), double(i / 3 % 2), double(i / 6)});
  Simulation sim{node<"root">(
      EulerExplicitSolver{},
      node<"sheet">(MeshTopology{.quads = {{0, 1, 4, 3}}},
                    MechanicalObject<Vec3d>{.position = points},
                    UniformMass<Vec3d>{},
                    node<"halves">(MeshTopology{.triangles = {{1, 4, 0}, {3, 0, 4}}},
                                   node<"rim">(MeshTopology{.edges = {{0, 1}, {1, 4}, {4, 3}, {3, 0}}}))),
      node<"solid">(MeshTopology{.hexahedra = {{0, 1, 4, 3, 6, 7, 10, 9}}},
                    MechanicalObject<Vec3d>{.position = points},
                    UniformMass<Vec3d>{},
                    node<"faces">(MeshTopology{
                        .quads = border_of({}, std::vector<Hexahedron>{{0, 1, 4, 3, 6, 7, 10, 9}}).quads})))};
  sim.init();
  sim.addElements("sheet", {.quads = {{1, 2, 5, 4}}});
  CHECK(sim.at<"sheet/halves">().get<MeshTopology>().triangles ==
        std::vector<Triangle>{{1, 4, 0}, {3, 0, 4}, {2, 5, 1}, {4, 1, 5}});
  CHECK(sorted(sim.at<"sheet/halves/rim">().get<MeshTopology>().edges) ==
        std::vector<Edge>{{0, 1}, {0, 3}, {1, 2}, {2, 5}, {3, 4}, {4, 5}});
  sim.addElements("solid", {.hexahedra = {{1, 2, 5, 4, 7, 8, 11, 10}}});
  CHECK(sim.at<"solid/faces">().get<MeshTopology>().quads.size() == 10);
  sim.animate(0.1);
}

TEST_CASE("what cannot come is refused, and the scene is what it was") {
  const Block block;
  const std::size_t n = block.all.size() - 3;
  auto sim = scene(block, block.first(n));
  CHECK_THROWS_AS(sim.addElements("body", {}), Error);  // before init
  sim.init();
  sim.animate(0.02);
  auto refused = [&](std::string_view path, AddedElements const& added) {
    auto const x = sim.at<"body">().state().position;
    const std::string message = error_of([&] { sim.addElements(path, added); });
    CHECK(sim.at<"body">().state().position == x);
    CHECK(sim.at<"body">().get<MeshTopology>().tetrahedra == block.first(n));
    return message;
  };
  Tetrahedron turned = block.all[n];
  std::swap(turned[0], turned[1]);
  CHECK_THAT(refused("body", {.tetrahedra = {turned}}), Contains("inside out"));
  CHECK_THAT(refused("body", {.tetrahedra = {block.all[0]}}), Contains("is there already"));
  CHECK_THAT(refused("body", {.tetrahedra = {block.all[n], block.all[n]}}), Contains("is there already"));
  CHECK_THAT(refused("body", {.tetrahedra = {{0, 1, 2, 1}}}), Contains("has a point twice"));
  CHECK_THAT(refused("body", {.tetrahedra = {{0, 1, 2, 27}}}), Contains("has point 27, but there are 27"));
  CHECK_THAT(refused("body", {.tetrahedra = {{0, 1, 2, -1}}}), Contains("has point -1"));
  CHECK_THAT(refused("body", {.points = {{0, 30, 0.5}}}), Contains("beside point 30"));
  CHECK_THAT(refused("body", {.points = {{0, 1, std::nan("")}}}),
             Contains("no finite number") || Contains("not a finite number"));
  AddedElements ofNone{.tetrahedra = {block.all[n]}};
  ofNone.ancestors[3] = {1000};
  CHECK_THAT(refused("body", ofNone), Contains("the ancestor 1000 is no tetrahedron"));
  ofNone.ancestors[3] = {1, 2};
  CHECK_THAT(refused("body", ofNone), Contains("2 ancestors for 1"));
  CHECK_THAT(refused("body/skin", {.tetrahedra = {block.all[n]}}), Contains("higher dimension"));
  CHECK_THAT(refused("nobody", {}), Contains("no topology at this path"));
  // flat: three corners in a row of the grid
  CHECK_THAT(refused("body", {.tetrahedra = {{0, 1, 3, 4}}}), Contains("has no volume"));
  CHECK(!sim.addElements("body", {}).changes());
  sim.animate(0.02);

  // a value for each element, and none for what comes
  auto materials = scene(block, block.first(n));
  auto& force = materials.root().child<"body">().get<TetrahedronFEMForceField<Vec3d>>();
  force.youngModulus.assign(n, 50);
  materials.init();
  CHECK_THAT(error_of([&] { materials.addElements("body", {.tetrahedra = block.behind(n)}); }),
             Contains("youngModulus has a value for each element"));
  AddedElements parts{.tetrahedra = block.behind(n)};
  parts.ancestors[3] = {0, 1, 2};
  materials.addElements("body", parts);
  CHECK(materials.at<"body">().get<TetrahedronFEMForceField<Vec3d>>().youngModulus.size() == n + 3);
}

}  // namespace test_element_addition
