// SPDX-License-Identifier: BSL-1.0
#include <sinew/collision/surface_elements.hpp>
#include <sinew/topology/regular_grid.hpp>

#include "catch.hpp"
#include "quadratic_mesh.hpp"

#include <Eigen/Geometry>

namespace test_surface_elements {

using namespace sinew;

namespace {

// of what the triangles enclose: positive where all have their outside outside
double volume_in(std::vector<PrimitiveCorners> const& triangles, std::vector<Eigen::Vector3d> const& x) {
  double volume = 0;
  for (auto const& t : triangles)
    volume += x[std::size_t(t[0])].dot(x[std::size_t(t[1])].cross(x[std::size_t(t[2])])) / 6;
  return volume;
}

}  // namespace

TEST_CASE("the surface of hexahedra and tetrahedra looks outwards, whichever way their corners go round") {
  const Mesh grid = regular_grid(3, 3, 2, {0, 0, 0}, {2, 3, 1});
  std::vector<Hexahedron> hexahedra = grid.hexahedra;
  REQUIRE(hexahedra.size() == 4);
  const auto right = triangles_of({.hexahedra = hexahedra}, grid.positions);
  CHECK(volume_in(right, grid.positions) == Approx(6).epsilon(1e-14));
  for (const std::size_t e : {0u, 3u})
    std::rotate(hexahedra[e].begin(), hexahedra[e].begin() + 4, hexahedra[e].end());
  const auto turned = triangles_of({.hexahedra = hexahedra}, grid.positions);
  CHECK(turned.size() == right.size());
  CHECK(volume_in(turned, grid.positions) == Approx(6).epsilon(1e-14));
  // without positions they are taken as they are
  CHECK(volume_in(triangles_of({.hexahedra = hexahedra}), grid.positions) < 5);

  const std::vector<Eigen::Vector3d> corners{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  for (const Tetrahedron& t : {Tetrahedron{0, 1, 2, 3}, Tetrahedron{0, 2, 1, 3}, Tetrahedron{3, 1, 2, 0}}) {
    const std::vector<Tetrahedron> one{t};
    CHECK(volume_in(triangles_of({.tetrahedra = one}, corners), corners) == Approx(1).epsilon(1e-14));
  }
}

TEST_CASE("prisms and pyramids have a surface together with what is beside them") {
  // a cube of a prism and a pyramid with a tetrahedron, which fill the other half: edges of the cube are 1
  const std::vector<Eigen::Vector3d> x{
      {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  for (const bool turned : {false, true}) {
    std::vector<Prism> prisms{{0, 1, 2, 4, 5, 6}};
    std::vector<Pyramid> pyramids{{0, 4, 6, 2, 3}};
    std::vector<Tetrahedron> tetrahedra{{4, 6, 7, 3}};
    if (turned) std::rotate(prisms[0].begin(), prisms[0].begin() + 3, prisms[0].end());
    if (turned) std::swap(pyramids[0][1], pyramids[0][3]), std::swap(tetrahedra[0][0], tetrahedra[0][1]);
    const auto surface = triangles_of({.tetrahedra = tetrahedra, .pyramids = pyramids, .prisms = prisms}, x);
    CHECK(surface.size() == 12);
    CHECK(volume_in(surface, x) == Approx(1).epsilon(1e-14));
  }
}

TEST_CASE("a quad whose halves are triangles of the topology, as those of grids are, counts once") {
  const std::vector<Triangle> halves{{0, 1, 4}, {0, 4, 3}};
  const std::vector<Quad> quads{{0, 1, 4, 3}, {1, 2, 5, 4}};
  CHECK(triangles_of({.triangles = halves, .quads = quads}).size() == 4);
  CHECK(lines_of({.triangles = halves, .quads = quads}).size() == 9);
}

TEST_CASE("the surface of elements of second order has all nodes of their faces") {
  auto check = [](auto element, std::size_t triangles) {
    using Element = decltype(element);
    Mesh mesh = one::quadratic_box<Element>(2, 1, 1, {0, 0, 0}, {2, 1, 1});
    for (const bool turned : {false, true}) {
      if (turned) {
        for (auto& e : mesh.quadraticTetrahedra) turn_inside_out(e);
        for (auto& e : mesh.quadraticHexahedra) turn_inside_out(e);
        for (auto& e : mesh.triquadraticHexahedra) turn_inside_out(e);
      }
      const auto surface = triangles_of({.quadraticTetrahedra = mesh.quadraticTetrahedra,
                                         .quadraticHexahedra = mesh.quadraticHexahedra,
                                         .triquadraticHexahedra = mesh.triquadraticHexahedra},
                                        mesh.positions);
      CHECK(surface.size() == triangles);
      CHECK(volume_in(surface, mesh.positions) == Approx(2).epsilon(1e-14));
    }
  };
  // ten sides of cells: of two faces of tetrahedra each, of four triangles and a quad, of four quads
  check(QuadraticTetrahedron{}, 10 * 2 * 4);
  check(QuadraticHexahedron{}, 10 * 6);
  check(TriquadraticHexahedron{}, 10 * 8);
}

}  // namespace test_surface_elements
