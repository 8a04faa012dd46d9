// SPDX-License-Identifier: BSL-1.0
#include <sinew/topology/removal_plan.hpp>

#include "catch.hpp"

namespace test_removal_plan {

using namespace sinew;

namespace {

// two tetrahedra on both sides of triangle 1 2 3, with all their faces and edges, and a wire from point 4 to
// 5
struct TwoTetrahedra {
  std::vector<Tetrahedron> tetrahedra{{0, 1, 2, 3}, {4, 1, 3, 2}};
  std::vector<Triangle> triangles{
      {1, 2, 3}, {0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {4, 1, 2}, {4, 2, 3}, {4, 3, 1}};
  std::vector<Edge> edges{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {2, 3}, {1, 3}, {4, 1}, {4, 2}, {4, 3}, {4, 5}};

  TopologyView volumes() const { return {.tetrahedra = tetrahedra}; }
  TopologyView surfaces() const { return {.edges = edges, .triangles = triangles}; }
};

}  // namespace

TEST_CASE("faces, edges and points go with the last element that they belong to, in all topologies") {
  const TwoTetrahedra mesh;
  const auto plan = plan_element_removal(6, {mesh.volumes(), mesh.surfaces()}, 0, {.tetrahedra = {0}});
  CHECK(plan.elements[0][3] == std::vector<bool>{false, true});
  CHECK(plan.elements[1][1] == std::vector<bool>{true, false, false, false, true, true, true});
  CHECK(plan.elements[1][0] ==
        std::vector<bool>{false, false, false, true, true, true, true, true, true, true});
  CHECK(plan.points == std::vector<bool>{false, true, true, true, true, true});
  const TopologyChange change = plan.change(1);
  CHECK(change.points.now == std::vector<Index>{-1, 0, 1, 2, 3, 4});
  CHECK(change.of(ElementKind::triangle).kept == std::vector<Index>{0, 4, 5, 6});
}

TEST_CASE("elements keep their points, and no others") {
  const TwoTetrahedra mesh;
  const auto both = plan_element_removal(6, {mesh.volumes(), mesh.surfaces()}, 0, {.tetrahedra = {0, 1}});
  // point 4 loses its volume, and takes the wire with it, and that point 5
  CHECK(both.points == std::vector<bool>(6, false));
  CHECK(both.elements[1][0] == std::vector<bool>(10, false));
  const auto face = plan_element_removal(6, {mesh.volumes(), mesh.surfaces()}, 1, {.triangles = {0, 1}});
  CHECK(face.points == std::vector<bool>(6, true));
  CHECK(face.elements[1][0] == std::vector<bool>(10, true));  // the edges still are those of tetrahedra
}

TEST_CASE("points that had no element before stay") {
  const std::vector<Triangle> triangles{{0, 1, 2}, {1, 3, 2}};
  const auto plan = plan_element_removal(6, {TopologyView{.triangles = triangles}}, 0, {.triangles = {0}});
  CHECK(plan.points == std::vector<bool>{false, true, true, true, true, true});
}

TEST_CASE("faces of hexahedra, whole or halved, go with them") {
  std::vector<Hexahedron> hexahedra{{0, 1, 2, 3, 4, 5, 6, 7}};
  const std::vector<Quad> quads{{0, 1, 2, 3}};
  const std::vector<Triangle> triangles{{4, 5, 6}, {4, 6, 7}};
  hexahedra.push_back({4, 5, 6, 7, 8, 9, 10, 11});
  const TopologyView view{.triangles = triangles, .quads = quads, .hexahedra = hexahedra};
  const auto plan = plan_element_removal(12, {view}, 0, {.hexahedra = {0}});
  CHECK(plan.elements[0][2] == std::vector<bool>{false});
  CHECK(plan.elements[0][1] == std::vector<bool>{true, true});
  CHECK(plan.change(0).points.kept == std::vector<Index>{4, 5, 6, 7, 8, 9, 10, 11});
}

TEST_CASE("what lies in prisms and pyramids goes with them, and these with a hexahedron") {
  // a prism under a pyramid, in a topology with their faces; a hexahedron in another, whose half the prism is
  const std::vector<Prism> prisms{{0, 1, 2, 3, 4, 5}};
  const std::vector<Pyramid> pyramids{{0, 1, 4, 3, 6}};
  const std::vector<Quad> quads{{0, 1, 4, 3}, {1, 2, 5, 4}};
  const std::vector<Triangle> triangles{{0, 1, 6}, {0, 2, 1}};
  const TopologyView view{.triangles = triangles, .quads = quads, .pyramids = pyramids, .prisms = prisms};
  const auto plan = plan_element_removal(9, {view}, 0, {.prisms = {0}});
  CHECK(plan.elements[0][6] == std::vector<bool>{false});
  CHECK(plan.elements[0][5] == std::vector<bool>{true});
  CHECK(plan.elements[0][2] == std::vector<bool>{true, false});
  CHECK(plan.elements[0][1] == std::vector<bool>{true, false});
  CHECK(plan.change(0).points.kept == std::vector<Index>{0, 1, 3, 4, 6, 7, 8});
  const auto other = plan_element_removal(9, {view}, 0, {.pyramids = {0}});
  CHECK(other.elements[0][1] == std::vector<bool>{false, true});
  CHECK(other.points[6] == false);
  const std::vector<Hexahedron> hexahedra{{0, 1, 2, 7, 3, 4, 5, 8}};
  const auto whole =
      plan_element_removal(9, {TopologyView{.hexahedra = hexahedra}, view}, 0, {.hexahedra = {0}});
  CHECK(whole.elements[1][6] == std::vector<bool>{false});
  CHECK(whole.elements[1][5] == std::vector<bool>{true});
  CHECK(plan_point_removal({true, true, true, true, true, true, false, true, true}, {view}).elements[0][5] ==
        std::vector<bool>{false});
}

TEST_CASE("nodes and parts of faces go with an element of second order") {
  // two over a common face of the corners 1, 2 and 3
  const std::vector<QuadraticTetrahedron> tetrahedra{{0, 1, 2, 3, 4, 5, 6, 7, 8, 9},
                                                     {10, 1, 3, 2, 11, 8, 12, 13, 5, 9}};
  const std::vector<Triangle> triangles{{0, 4, 6}, {1, 5, 8}, {1, 11, 8}};
  const std::vector<Tetrahedron> corner{{0, 4, 6, 7}};
  const TopologyView view{.triangles = triangles, .quadraticTetrahedra = tetrahedra};
  const auto plan =
      plan_element_removal(14, {view, TopologyView{.tetrahedra = corner}}, 0, {.quadraticTetrahedra = {0}});
  CHECK(plan.elements[0][7] == std::vector<bool>{false, true});
  CHECK(plan.elements[0][1] == std::vector<bool>{false, true, true});
  CHECK(plan.elements[1][3] == std::vector<bool>{false});
  CHECK(plan.change(0).points.kept == std::vector<Index>{1, 2, 3, 5, 8, 9, 10, 11, 12, 13});
}

TEST_CASE("values of elements in space are one kind after the other") {
  TopologyChange change;
  change.elements[std::size_t(ElementKind::tetrahedron)] = Renumbering::of({true, false});
  change.elements[std::size_t(ElementKind::hexahedron)] = Renumbering::of({false, true});
  change.elements[std::size_t(ElementKind::prism)] = Renumbering::of({true, false, true});
  std::vector<double> values{1, 2, 3, 4, 5, 6, 7};
  change.ofDimension(3, values.size()).filter(values);
  CHECK(values == std::vector<double>{1, 4, 5, 7});
  CHECK(change.dimension() == 3);
}

TEST_CASE("elements go with their points") {
  const TwoTetrahedra mesh;
  const auto plan = plan_point_removal({true, true, true, true, true, false}, {mesh.surfaces()});
  CHECK(plan.elements[0][0] ==
        std::vector<bool>{true, true, true, true, true, true, true, true, true, false});
  CHECK(plan.elements[0][1] == std::vector<bool>(7, true));
}

}  // namespace test_removal_plan
