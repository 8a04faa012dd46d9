// SPDX-License-Identifier: BSL-1.0
#include <sinew/topology/adjacency.hpp>
#include <sinew/topology/quality.hpp>
#include <sinew/topology/regular_grid.hpp>
#include <sinew/topology/subdivision.hpp>

#include "catch.hpp"
#include "mesh_checks.hpp"

#include <Eigen/LU>
#include <set>

namespace test_subdivision {

using namespace sinew;

namespace {

Eigen::Vector3d at(Mesh const& mesh, Index i) { return mesh.positions[std::size_t(i)]; }

/// Smallest and total volume of the hexahedra, with two Gauss points a direction, exact for trilinear cells.
std::pair<double, double> volumes(Mesh const& mesh) {
  double minimum = 1e9, sum = 0;
  for (auto const& h : mesh.hexahedra) {
    double volume = 0;
    for (int g = 0; g < 8; ++g) {
      const double s = std::sqrt(1. / 12);
      const MultilinearShape<3> shape(
          Eigen::Vector3d(g & 1 ? 0.5 + s : 0.5 - s, g & 2 ? 0.5 + s : 0.5 - s, g & 4 ? 0.5 + s : 0.5 - s));
      Eigen::Matrix3d j = Eigen::Matrix3d::Zero();
      for (int k = 0; k < 8; ++k) j += at(mesh, h[std::size_t(k)]) * shape.derivatives.row(k);
      volume += j.determinant() / 8;
    }
    minimum = std::min(minimum, volume);
    sum += volume;
  }
  return {minimum, sum};
}

void bend(Mesh& mesh) {
  for (auto& p : mesh.positions)
    p += 0.1 * Eigen::Vector3d(std::sin(3 * p[1] + p[2]), p[0] * p[2] * p[1], std::cos(2 * p[0] - p[1]));
}

/// The lengths of a tetrahedron's edges, in order, over the longest: the same for the same shape.
std::array<long, 6> shape_of(Mesh const& mesh, Tetrahedron const& t) {
  std::vector<double> lengths;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) lengths.push_back((at(mesh, t[i]) - at(mesh, t[j])).norm());
  std::sort(lengths.begin(), lengths.end());
  std::array<long, 6> shape{};
  for (std::size_t k = 0; k < 6; ++k) shape[k] = std::lround(1e6 * lengths[k] / lengths.back());
  return shape;
}

}  // namespace

TEST_CASE("tetrahedra in eight: the same body, matching, each an eighth") {
  Mesh mesh = regular_grid_tetrahedra(4, 3, 3, {0, 0, 0}, {3, 2, 2});
  bend(mesh);
  const auto before = quality(mesh);
  const Mesh fine = subdivide(mesh);
  const auto after = quality(fine);
  CHECK(fine.tetrahedra.size() == 8 * mesh.tetrahedra.size());
  CHECK(fine.positions.size() == mesh.positions.size() + edges_of(mesh.tetrahedra).size());
  CHECK(std::equal(mesh.positions.begin(), mesh.positions.end(), fine.positions.begin()));
  CHECK(is_conforming(fine));
  CHECK(after.volume == Approx(before.volume).epsilon(1e-13));
  CHECK(after.minVolume == Approx(before.minVolume / 8));
  // the parts of each, which stand where it stood, are its eighths
  for (std::size_t e = 0; e < fine.tetrahedra.size(); ++e) {
    auto volume = [](Mesh const& m, Tetrahedron const& t) {
      return tetrahedron_volume(at(m, t[0]), at(m, t[1]), at(m, t[2]), at(m, t[3]));
    };
    CHECK(volume(fine, fine.tetrahedra[e]) == Approx(volume(mesh, mesh.tetrahedra[e / 8]) / 8));
  }
  // the surface is that of before, in four parts each
  CHECK(boundary_triangles(fine.tetrahedra).size() == 4 * boundary_triangles(mesh.tetrahedra).size());
  const Mesh finer = subdivide(mesh, 2);
  CHECK(is_conforming(finer));
  CHECK(std::equal(fine.positions.begin(), fine.positions.end(), finer.positions.begin()));
  CHECK(quality(finer).volume == Approx(before.volume).epsilon(1e-13));
  CHECK(subdivide(mesh, 0) == mesh);
}

TEST_CASE("tetrahedra never get worse than after the first subdivisions: three shapes in all") {
  // a slim one, in general position
  const Mesh one{.positions = {{0, 0, 0}, {1, 0.1, 0}, {0.2, 1.3, 0.1}, {0.3, 0.4, 0.6}},
                 .tetrahedra = {{0, 1, 2, 3}}};
  std::set<std::array<long, 6>> shapes{shape_of(one, one.tetrahedra[0])};
  double second = 0;
  for (int level = 1; level <= 5; ++level) {
    const Mesh fine = subdivide(one, level);
    for (auto const& t : fine.tetrahedra) shapes.insert(shape_of(fine, t));
    CHECK(shapes.size() <= 3);
    const auto q = quality(fine);
    CHECK(q.minVolume == Approx(q.volume / std::pow(8, level)));
    if (level == 2) second = q.minDihedral;
    if (level > 2) CHECK(q.minDihedral == Approx(second));
  }
  CHECK(shapes.size() == 3);
  // Kuhn's tetrahedra of a grid stay of one shape
  const Mesh grid = subdivide(regular_grid_tetrahedra(2, 2, 2, {0, 0, 0}, {1, 1, 1}), 3);
  std::set<std::array<long, 6>> kuhn;
  for (auto const& t : grid.tetrahedra) kuhn.insert(shape_of(grid, t));
  CHECK(kuhn.size() == 1);
}

TEST_CASE("hexahedra in eight: a grid is the grid twice as fine, a bent one keeps its volume") {
  const Mesh grid = regular_grid(3, 4, 2, {0, 0, 0}, {2, 3, 1});
  const Mesh fine = subdivide(grid), same = regular_grid(5, 7, 3, {0, 0, 0}, {2, 3, 1});
  REQUIRE(fine.positions.size() == same.positions.size());
  CHECK(fine.hexahedra.size() == same.hexahedra.size());
  auto sorted = [](Mesh const& m) {
    std::set<std::vector<double>> cells;
    for (auto const& h : m.hexahedra) {
      std::vector<double> cell;
      for (const Index i : h)
        for (int c = 0; c < 3; ++c) cell.push_back(at(m, i)[c]);
      cells.insert(cell);
    }
    return cells;
  };
  CHECK(sorted(fine) == sorted(same));

  Mesh bent = grid;
  bend(bent);
  const auto [minimum, volume] = volumes(bent);
  const auto [finest, total] = volumes(subdivide(bent, 2));
  CHECK(total == Approx(volume).epsilon(1e-13));
  CHECK(finest > 0);
  CHECK(finest < minimum / 8);
}

TEST_CASE("surfaces and lines share their points with each other and with volumes") {
  Mesh mesh = regular_grid(3, 3, 3, {0, 0, 0}, {1, 1, 1});
  mesh.tetrahedra = hexahedra_to_tetrahedra(mesh.hexahedra);
  mesh.triangles = boundary_triangles(mesh.tetrahedra);
  for (auto const& h : mesh.hexahedra)
    for (auto const& f : hexahedronFaces) mesh.quads.push_back({h[f[0]], h[f[1]], h[f[2]], h[f[3]]});
  mesh.edges = edges_of(mesh.hexahedra);
  bend(mesh);
  const Mesh fine = subdivide(mesh);
  // points, edges of the tetrahedra, of which the cubes have some and share the middles of the diagonals of
  // faces and of cells at other places: faces and cells have their own
  const std::size_t faces = 3 * 3 * 4, cells = 8;
  CHECK(fine.positions.size() == 27 + edges_of(mesh.tetrahedra).size() + faces + cells);
  CHECK(fine.edges.size() == 2 * mesh.edges.size());
  CHECK(fine.quads.size() == 4 * mesh.quads.size());
  CHECK(fine.triangles.size() == 4 * mesh.triangles.size());

  const auto before = surface_quality(mesh), after = surface_quality(fine);
  CHECK(after.closed);
  CHECK(after.manifold);
  CHECK(after.area == Approx(before.area).epsilon(1e-13));
  CHECK(after.volume == Approx(before.volume).epsilon(1e-13));
  CHECK(after.minAngle == Approx(before.minAngle));
  auto length = [](Mesh const& m) {
    double sum = 0;
    for (auto const& [a, b] : m.edges) sum += (at(m, a) - at(m, b)).norm();
    return sum;
  };
  CHECK(length(fine) == Approx(length(mesh)).epsilon(1e-13));
  // faces of the fine cells: each quad is one of them, from the side of its cell
  std::set<Quad> sides;
  for (auto const& h : fine.hexahedra)
    for (auto const& f : hexahedronFaces) {
      Quad side{h[f[0]], h[f[1]], h[f[2]], h[f[3]]};
      std::rotate(side.begin(), std::min_element(side.begin(), side.end()), side.end());
      sides.insert(side);
    }
  for (Quad side : fine.quads) {
    std::rotate(side.begin(), std::min_element(side.begin(), side.end()), side.end());
    CHECK(sides.count(side) == 1);
  }
}

TEST_CASE("meshes that cannot be subdivided are refused") {
  CHECK(contains(error_of([] {
                   subdivide({.positions = {{0, 0, 0}}, .edges = {{0, 1}}});
                 }),
                 "edge 0 refers to point 1"));
  CHECK(contains(error_of([] {
                   subdivide({.positions = {{0, 0, 0}}, .edges = {{0, 0}}});
                 }),
                 "uses point 0 twice"));
  CHECK(contains(error_of([] { subdivide({}, -1); }), "-1 levels"));
  CHECK(contains(error_of([] {
                   subdivide(regular_grid(2, 2, 2, {0, 0, 0}, {1, 1, 1}), 30);
                 }),
                 "more than 2^28 points"));
}

}  // namespace test_subdivision
