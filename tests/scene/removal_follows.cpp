// SPDX-License-Identifier: BSL-1.0
// What follows a removal in unusual ways, and removals that are refused.
#include "removal_row.hpp"

namespace test_removal_follows {

namespace {

using namespace removal;

auto body() {
  return Simulation{
      node<"root">(Gravity{},
                   EulerImplicitSolver{},
                   CGLinearSolver<>{},
                   node<"body">(TetrahedronTopology{tetrahedra()},
                                MechanicalObject<Vec3d>{.position = row()},
                                DiagonalMass<Vec3d>{.totalMass = 6},
                                TetrahedronFEMForceField<Vec3d>{},
                                ConstantForceField<Vec3d>{.indices = {0}, .forces = {{1, 0, 0}}},
                                RestShapeSpringsForceField<Vec3d>{.points = {0, 1}, .stiffness = {10, 20}}),
                   node<"grid">(RegularGridTopology{.n = {2, 2, 2}},
                                MechanicalObject<Vec3d>{},
                                UniformMass<Vec3d>{.totalMass = 8}))};
}

template <class Sim>
std::string refused(Sim& sim, std::string_view path, ElementNumbers const& gone) {
  auto const before = sim.template at<"body">().state().position;
  std::string message;
  try {
    sim.removeElements(path, gone);
  } catch (Error const& error) {
    message = error.what();
  }
  CHECK(sim.template at<"body">().state().position == before);
  CHECK(sim.template at<"body">().template get<TetrahedronTopology>().tetrahedra == tetrahedra());
  auto copy = sim;
  copy.animate(0.01);
  return message;
}
bool has(std::string const& message, std::string_view words) {
  return message.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("a removal that cannot be done says why, and changes nothing") {
  auto sim = body();
  CHECK_THROWS_AS(sim.removeElements("body", {.tetrahedra = {0}}), Error);  // before init
  sim.init();
  std::string m = refused(sim, "bodi", {.tetrahedra = {0}});
  CHECK(has(m, "/root/bodi"));
  CHECK(has(m, "body, grid"));
  m = refused(sim, "body", {.tetrahedra = {3}});
  CHECK(has(m, "tetrahedron 3 cannot be removed"));
  CHECK(has(m, "has 3, numbered from 0"));
  CHECK(has(refused(sim, "body", {.tetrahedra = {-1}}), "tetrahedron -1"));
  CHECK(has(refused(sim, "body", {.triangles = {0}}), "triangle 0"));
  CHECK(has(refused(sim, "body", {.tetrahedra = {0, 1, 2}}), "no element would be left"));
  CHECK(has(refused(sim, "grid", {.hexahedra = {0}}), "give the node a MeshTopology"));
}

TEST_CASE("the density of a body stays, and a force goes with the last point that it is on") {
  auto sim = body();
  sim.init();
  auto& node = sim.at<"body">();
  const double density = node.get<DiagonalMass<Vec3d>>().density;
  sim.removeElements("body", {.tetrahedra = {0}});
  CHECK(node.state().size() == 5);
  CHECK(*node.get<DiagonalMass<Vec3d>>().massDensity == density);
  CHECK(node.get<ConstantForceField<Vec3d>>().none);
  auto const& springs = node.get<RestShapeSpringsForceField<Vec3d>>();
  CHECK(!springs.none);
  CHECK(springs.points == std::vector<int>{0});
  CHECK(springs.stiffness == std::vector<double>{20});
  std::vector<Eigen::Vector3d> f(5, Eigen::Vector3d::Zero());
  node.get<ConstantForceField<Vec3d>>().addForce({}, f, node.state().position, node.state().velocity);
  for (auto const& v : f) CHECK(v.norm() == 0);
}

TEST_CASE("the same elements twice are removed once, and none changes nothing") {
  auto sim = body(), other = body();
  sim.init(), other.init();
  sim.removeElements("body", {.tetrahedra = {0, 0}});
  other.removeElements("body", {.tetrahedra = {0}});
  const auto none = other.removeElements("body", {});
  CHECK(!none.changes());
  sim.animate(0.01), other.animate(0.01);
  CHECK(sim.at<"body">().state().position == other.at<"body">().state().position);
}

TEST_CASE("what is mapped by numbers loses its points, with the elements over them") {
  const Mesh points{.positions = row()};
  Simulation sim{node<"root">(
      EulerExplicitSolver{},
      node<"body">(
          TetrahedronTopology{tetrahedra()},
          MechanicalObject<Vec3d>{.position = row()},
          UniformMass<Vec3d>{.totalMass = 6},
          node<"copy">(MechanicalObject<Vec3d>{},
                       MeshTopology{.edges = {{0, 1}, {1, 2}, {4, 5}}},
                       IdentityMapping<Vec3d, Vec3d>{},
                       MeshSpringForceField<Vec3d>{.stiffness = 10},
                       node<"ends">(MechanicalObject<Vec3d>{},
                                    SubsetMapping<Vec3d, Vec3d>{.indices = {5, 0, 3}},
                                    node<"look">(VisualModel{Mesh{.positions = {row()[5], row()[0], row()[3]},
                                                                  .edges = {{0, 1}, {0, 2}}}},
                                                 IdentityMapping<Vec3d, Vec3f>{})))))};
  sim.init();
  sim.animate(0.01);
  sim.removeElements("body", {.tetrahedra = {0}});
  auto& copy = sim.at<"body/copy">();
  CHECK(copy.state().size() == 5);
  CHECK(copy.get<MeshTopology>().edges == std::vector<Edge>{{0, 1}, {3, 4}});
  auto& ends = sim.at<"body/copy/ends">();
  CHECK(ends.get<SubsetMapping<Vec3d, Vec3d>>().indices == std::vector<int>{4, 2});
  auto& look = sim.at<"body/copy/ends/look">();
  CHECK(look.visual().position.size() == 2);
  CHECK(look.visual().mesh.edges == std::vector<Edge>{{0, 1}});
  CHECK((look.visual().position[0].cast<double>() - sim.at<"body">().state().position[4]).norm() < 1e-6);
  sim.animate(0.01);
}

TEST_CASE("springs to another body go with their ends") {
  using Springs = StiffSpringForceField<Vec3d, Between<"other", "body">>;
  Simulation sim{node<"root">(
      EulerImplicitSolver{},
      CGLinearSolver<>{},
      Springs{.springs = {{0, 0, 10}, {1, 5, 20}},
              .springsIndices1 = {0, 1},
              .springsIndices2 = {4, 0},
              .stiffness = {30, 40},
              .elongationOnly = {false, true, false, true}},
      node<"other">(MechanicalObject<Vec3d>{.position = {{0, 0, 3}, {1, 0, 3}}}, UniformMass<Vec3d>{}),
      node<"body">(TetrahedronTopology{tetrahedra()},
                   MechanicalObject<Vec3d>{.position = row()},
                   UniformMass<Vec3d>{}))};
  sim.init();
  sim.removeElements("body", {.tetrahedra = {0}});
  auto const& springs = sim.root().get<Springs>();
  REQUIRE(springs.springs.size() == 1);
  CHECK(springs.springs[0].first == 1);
  CHECK(springs.springs[0].second == 4);
  CHECK(springs.springsIndices1 == std::vector<int>{0});
  CHECK(springs.springsIndices2 == std::vector<int>{3});
  CHECK(springs.stiffness == std::vector<double>{30});
  CHECK(springs.elongationOnly == std::vector<bool>{true, false});
  sim.animate(0.01);
}

}  // namespace test_removal_follows
