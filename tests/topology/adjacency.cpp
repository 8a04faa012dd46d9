// SPDX-License-Identifier: BSL-1.0
#include <sinew/topology/adjacency.hpp>

#include <Eigen/Geometry>

#include "catch.hpp"
#include "mesh_checks.hpp"

namespace test_adjacency {

using namespace sinew;

TEST_CASE("edges of elements come once, sorted") {
  const std::vector<Edge> square{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {2, 3}};
  CHECK(edges_of(std::vector<Triangle>{{2, 1, 0}, {0, 2, 3}}) == square);
  CHECK(edges_of_quads({{3, 2, 1, 0}}) == std::vector<Edge>{{0, 1}, {0, 3}, {1, 2}, {2, 3}});
  CHECK(edges_of(std::vector<Tetrahedron>{{7, 1, 5, 3}}) ==
        std::vector<Edge>{{1, 3}, {1, 5}, {1, 7}, {3, 5}, {3, 7}, {5, 7}});
  // two tetrahedra at a face: 6 + 3 edges
  CHECK(edges_of(std::vector<Tetrahedron>{{0, 1, 2, 3}, {1, 2, 3, 4}}).size() == 9);
  const auto cell = edges_of(std::vector<Hexahedron>{{0, 1, 3, 2, 4, 5, 7, 6}});  // numbered as binary zyx
  CHECK(cell.size() == 12);
  for (auto const& [i, j] : cell) CHECK(((j - i) == 1 || (j - i) == 2 || (j - i) == 4));
  CHECK(edges_of(std::vector<Pyramid>{{0, 1, 2, 3, 4}}).size() == 8);
  CHECK(edges_of(std::vector<Prism>{{0, 1, 2, 3, 4, 5}}) ==
        std::vector<Edge>{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}});
  CHECK(edges_of(std::vector<Triangle>{}).empty());
  // a huge index costs no memory
  CHECK(edges_of(std::vector<Triangle>{{0, 2147483647, 5}}).back() == Edge{5, 2147483647});
}

TEST_CASE("the boundary of tetrahedra looks outwards") {
  const std::vector<Eigen::Vector3d> x{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  // the second one is positively oriented too: det((1, -1, 0)...) checked by the normals below
  const std::vector<Tetrahedron> two{{0, 1, 2, 3}, {1, 4, 2, 3}};
  const auto faces = boundary_triangles(two);
  CHECK(faces.size() == 6);
  CHECK(std::is_sorted(faces.begin(), faces.end(), [](Triangle a, Triangle b) {
    std::sort(a.begin(), a.end()), std::sort(b.begin(), b.end());
    return a < b;
  }));
  double volume = 0;
  for (auto const& [a, b, c] : faces) {
    CHECK((a < b && a < c));
    CHECK_FALSE((a == 1 && std::min(b, c) == 2 && std::max(b, c) == 3));  // the common face
    const Eigen::Vector3d n =
        (x[std::size_t(b)] - x[std::size_t(a)]).cross(x[std::size_t(c)] - x[std::size_t(a)]);
    CHECK(n.dot(x[std::size_t(a)] - Eigen::Vector3d(0.4, 0.4, 0.4)) > 0);
    volume += x[std::size_t(a)].dot(x[std::size_t(b)].cross(x[std::size_t(c)])) / 6;
  }
  CHECK(volume == Approx(1 / 6.0 + 1 / 3.0));
  CHECK(boundary_triangles({}).empty());
  CHECK(boundary_triangles({{0, 1, 2, 3}}) ==
        std::vector<Triangle>{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
}

TEST_CASE("elements and points around a point") {
  const std::vector<Edge> path{{0, 1}, {1, 2}, {0, 3}};
  const Adjacency near = neighbours(path, 5);
  CHECK(near.size() == 5);
  CHECK(near.offsets == std::vector<std::size_t>{0, 2, 4, 5, 6, 6});
  CHECK(near.targets == std::vector<Index>{1, 3, 0, 2, 1, 0});
  CHECK(near[4].empty());
  CHECK(near[1][1] == 2);
  const Adjacency around = elements_around(std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}}, 4);
  CHECK(around.targets == std::vector<Index>{0, 0, 1, 0, 1, 1});
  CHECK(neighbours({}, 0).size() == 0);
}

TEST_CASE("unused points are dropped, the others keep their order") {
  Mesh mesh;
  for (int i = 0; i < 6; ++i) mesh.positions.push_back({double(i), 0, 0});
  mesh.triangles = {{5, 1, 3}};
  mesh.edges = {{3, 4}};
  remove_unused_points(mesh);
  CHECK(mesh.positions == std::vector<Eigen::Vector3d>{{1, 0, 0}, {3, 0, 0}, {4, 0, 0}, {5, 0, 0}});
  CHECK(mesh.triangles.front() == Triangle{3, 0, 1});
  CHECK(mesh.edges.front() == Edge{1, 2});
}

TEST_CASE("adjacency refuses bad elements") {
  CHECK(contains(error_of([] { edges_of(std::vector<Triangle>{{0, 1, 2}, {0, -1, 2}}); }), "triangle 1"));
  CHECK(contains(error_of([] { edges_of(std::vector<Tetrahedron>{{0, 1, 2, 1}}); }), "point 1 twice"));
  CHECK(contains(error_of([] { boundary_triangles({{0, 1, 2, 3}, {4, 5, 6, 5}}); }), "tetrahedron 1"));
  CHECK(contains(error_of([] { boundary_triangles({{0, -7, 2, 3}}); }), "-7"));
  CHECK(contains(error_of([] {
                   boundary_triangles({{0, 1, 2, 3}, {0, 2, 1, 4}, {0, 1, 2, 5}});
                 }),
                 "face of points 0, 1, 2 belongs to 3"));
  CHECK(contains(error_of([] { neighbours({{0, 3}}, 3); }), "there are 3 points"));
  CHECK(contains(error_of([] {
                   Mesh mesh;
                   mesh.edges = {{0, 1}};
                   remove_unused_points(mesh);
                 }),
                 "edge 0"));
}

}  // namespace test_adjacency
