// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/mechanics.hpp>

namespace test_distance_multi_mapping {

using namespace sinew;

using Mapping = DistanceMultiMapping<Vec3d, Vec1d>;
using OfPaths = DistanceMultiMapping<Vec3d, Vec1d, Parents<"../a", "../b">>;

auto body(double y) {
  return MechanicalObject<Vec3d>{.position = {{0, y, 0}, {1, y, 0.2}}, .velocity = {{1, 0, 0}, {0, 0, -1}}};
}
// springs between two bodies, and one inside the first
template <class Linear, class... Joint>
auto scene(Linear linear, Joint... joint) {
  return node<"root">(Gravity{{0, -10, 0}},
                      EulerImplicitSolver{},
                      linear,
                      node<"a">(body(0), UniformMass<Vec3d>{.vertexMass = 1}),
                      node<"b">(body(1), UniformMass<Vec3d>{.vertexMass = 2}),
                      node<"joint">(joint...));
}
template <class Linear>
auto measured(Linear linear, GeometricStiffness stiffness) {
  return scene(linear,
               MeshTopology{.edges = {{0, 2}, {1, 3}, {0, 1}, {3, 0}}},
               MechanicalObject<Vec1d>{},
               OfPaths{.indexPairs = {{0, 0}, {0, 1}, {1, 0}, {1, 1}},
                       .restLengths = {0.8, 1.2, 0.9, 1.3},
                       .geometricStiffness = stiffness},
               RestShapeSpringsForceField<Vec1d>{
                   .stiffness = {300}, .externalRestShape = Vec1d::VecCoord(4, Vec1d::Coord::Zero())});
}

TEST_CASE("distances between bodies with springs are springs between them") {
  // K = k u u' + k (l - L)/l (I - u u') in both
  auto springs = scene(
      SparseLDLSolver<>{},
      MechanicalObject<Vec3d>{},
      SubsetMultiMapping<Vec3d, Vec3d, Parents<"../a", "../b">>{
          .indexPairs = {{0, 0}, {0, 1}, {1, 0}, {1, 1}}},
      StiffSpringForceField<Vec3d>{
          .springs = {{0, 2, 300, 0, 0.8}, {1, 3, 300, 0, 1.2}, {0, 1, 300, 0, 0.9}, {3, 0, 300, 0, 1.3}}});
  Simulation expected{springs};
  Simulation direct{measured(SparseLDLSolver<>{}, GeometricStiffness::exact)};
  Simulation iterated{
      measured(CGLinearSolver<>{.iterations = 500, .tolerance = 1e-14}, GeometricStiffness::exact)};
  expected.init();
  direct.init();
  iterated.init();
  for (int i = 0; i < 20; ++i) {
    expected.animate(0.005);
    direct.animate(0.005);
    iterated.animate(0.005);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK((direct.at<"a">().state().position[i] - expected.at<"a">().state().position[i]).norm() < 1e-11);
    CHECK((direct.at<"b">().state().velocity[i] - expected.at<"b">().state().velocity[i]).norm() < 1e-9);
    CHECK((iterated.at<"b">().state().position[i] - direct.at<"b">().state().position[i]).norm() < 1e-9);
  }
  // l - L of the edge between the bodies
  auto const &a = direct.at<"a">().state().position, &b = direct.at<"b">().state().position;
  CHECK(direct.at<"joint">().state().position[1][0] == Approx((b[1] - a[1]).norm() - 1.2).epsilon(1e-12));
}

TEST_CASE("momentum goes from one body to the other") {
  Simulation sim{measured(SparseLDLSolver<>{}, GeometricStiffness::stabilized)};
  sim.init();
  for (int i = 0; i < 10; ++i) sim.animate(0.01);
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  for (auto const& v : sim.at<"a">().state().velocity) p += v;
  for (auto const& v : sim.at<"b">().state().velocity) p += 2 * v;
  CHECK((p - (3 * Eigen::Vector3d(1, 0, -1) + 6 * 0.1 * Eigen::Vector3d(0, -10, 0))).norm() < 1e-10);
}

TEST_CASE("distances at rest, and between centres of rigid bodies") {
  using Rigid = DistanceMultiMapping<Rigid3d, Vec1d>;
  Rigid3d::VecCoord a(1), b(2);
  b[1].center = {3, 4, 0};
  auto rests = [&](Rigid mapping) {
    mapping.indexPairs = {{0, 0}, {1, 1}};
    Vec1d::VecCoord child;
    const std::vector<Edge> edges{{0, 1}};
    mapping.init({{"a", a, {}}, {"b", b, {}}}, {"child", child, {.edges = edges}}, child);
    REQUIRE(child.size() == 1);
    mapping.part(0).apply(child, a);
    mapping.part(1).apply(child, b);
    return child[0][0];
  };
  CHECK(rests({}) == 0);
  CHECK(rests({.computeDistance = true}) == Approx(5));
  CHECK(rests({.restLengths = {2}}) == Approx(3));
}

TEST_CASE("what does not fit a DistanceMultiMapping is named") {
  const Vec3d::VecCoord a(2, Eigen::Vector3d::Zero()), b(1, Eigen::Vector3d::UnitX());
  auto with = [&](std::vector<Edge> edges, Mapping mapping, std::size_t children = 0) {
    return error_of([=, &a, &b]() mutable {
      Vec1d::VecCoord child(children, Vec1d::Coord::Zero());
      mapping.init({{"/a", a, {}}, {"/b", b, {}}}, {"child", child, {.edges = edges}}, child);
    });
  };
  const std::vector<std::array<int, 2>> pairs{{0, 0}, {1, 0}};
  CHECK_THAT(with({{0, 1}}, {.indexPairs = {{0, 0}, {2, 0}}}),
             Catch::Contains("child: DistanceMultiMapping<Vec3d, Vec1d") &&
                 Catch::Contains("indexPairs[1] names parent 2, but there are 2"));
  CHECK_THAT(with({{0, 1}}, {.indexPairs = {{0, 0}, {1, 1}}}),
             Catch::Contains("indexPairs[1] names point 1 of /b, which has 1 points"));
  CHECK_THAT(with({}, {.indexPairs = pairs}), Catch::Contains("there are no edges"));
  CHECK_THAT(with({{0, 2}}, {.indexPairs = pairs}),
             Catch::Contains("edge 0 has point 2, but indexPairs has 2 entries"));
  CHECK_THAT(with({{0, 1}}, {.indexPairs = pairs, .restLengths = {1, 2}}),
             Catch::Contains("restLengths has 2 entries for 1 edges"));
  CHECK_THAT(with({{0, 1}}, {.indexPairs = pairs}, 3), Catch::Contains("the child has 3 points for 1 edges"));
}

TEST_CASE("a point of an edge cannot go") {
  const Vec3d::VecCoord a(2, Eigen::Vector3d::Zero()), b(1, Eigen::Vector3d::UnitX());
  Vec1d::VecCoord child;
  const std::vector<Edge> edges{{0, 1}};
  Mapping mapping{.indexPairs = {{0, 1}, {1, 0}}};
  mapping.init({{"/a", a, {}}, {"/b", b, {}}}, {"child", child, {.edges = edges}}, child);
  const Renumbering none, first = Renumbering::of({false, true}), second = Renumbering::of({true, false});
  mapping.follow(none, {&first, &none});
  CHECK(mapping.indexPairs[0] == std::array<int, 2>{0, 0});
  mapping.indexPairs[0] = {0, 1};
  CHECK_THAT(error_of([&] {
               mapping.follow(none, {&second, &none});
             }),
             Catch::Contains("point 1 of its parent 0 is to go"));
}

}  // namespace test_distance_multi_mapping
