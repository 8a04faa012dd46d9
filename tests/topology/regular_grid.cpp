// SPDX-License-Identifier: BSL-1.0
#include <sinew/topology/adjacency.hpp>
#include <sinew/topology/quality.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <cmath>
#include <limits>

#include "catch.hpp"
#include "mesh_checks.hpp"

namespace test_regular_grid {

using namespace sinew;

namespace {
const Eigen::Vector3d lo{-0.1, 0.2, 0.7}, hi{0.5, 0.9, 1.3};
}

TEST_CASE("regular grid of hexahedra") {
  const Mesh mesh = regular_grid(4, 3, 5, lo, hi);
  CHECK(mesh.positions.size() == 60);
  CHECK(mesh.hexahedra.size() == 24);
  CHECK(mesh.positions.front() == lo);
  CHECK(mesh.positions.back() == hi);
  CHECK(mesh.positions[1].isApprox(Eigen::Vector3d(0.1, 0.2, 0.7)));    // x runs fastest
  CHECK(mesh.positions[4].isApprox(Eigen::Vector3d(-0.1, 0.55, 0.7)));  // then y
  CHECK(mesh.hexahedra.front() == Hexahedron{0, 1, 5, 4, 12, 13, 17, 16});
  // edges: (nx - 1) ny nz + ...
  CHECK(edges_of(mesh.hexahedra).size() == 3 * 3 * 5 + 4 * 2 * 5 + 4 * 3 * 4);
  for (Hexahedron const& h : mesh.hexahedra) {
    auto x = [&](std::size_t i) { return mesh.positions[std::size_t(h[i])]; };
    CHECK((x(1) - x(0)).isApprox(x(6) - x(7)));
    CHECK((x(1) - x(0)).dot((x(3) - x(0)).cross(x(4) - x(0))) == Approx(0.2 * 0.35 * 0.15));
  }
}

TEST_CASE("coordinates of grids do not leave the box, and whole steps are whole") {
  const Mesh mesh = regular_grid(7, 2, 11, {-4, 0.1, 0}, {2, 0.3, 1.1});
  for (int i = 0; i < 7; ++i) CHECK(mesh.positions[std::size_t(i)][0] == i - 4);
  for (auto const& p : mesh.positions) CHECK((p[0] <= 2 && p[1] <= 0.3 && p[2] <= 1.1));
  CHECK(mesh.positions.back() == Eigen::Vector3d(2, 0.3, 1.1));
}

TEST_CASE("regular grid of tetrahedra fills the box") {
  for (const int perCell : {5, 6}) {
    const Mesh mesh = regular_grid_tetrahedra(4, 3, 6, lo, hi, perCell);
    CHECK(mesh.tetrahedra.size() == std::size_t(3 * 2 * 5 * perCell));
    CHECK(is_conforming(mesh));
    const TetrahedronQuality q = quality(mesh);
    CHECK(q.volume == Approx((hi - lo).prod()));
    CHECK(q.minVolume == Approx((hi - lo).prod() / 30 / 6));
    Mesh skin = mesh;
    skin.triangles = boundary_triangles(mesh.tetrahedra);
    const SurfaceQuality s = surface_quality(skin);
    CHECK(skin.triangles.size() == 2 * 2 * (3 * 2 + 3 * 5 + 2 * 5));
    CHECK(s.volume == Approx((hi - lo).prod()));
    CHECK((s.manifold && s.eulerCharacteristic == 2));
  }
}

TEST_CASE("cylinder of tetrahedra") {
  for (int axis = 0; axis < 3; ++axis)
    for (const int rings : {1, 2, 5}) {
      const double begin = -0.3, end = 1.1, radius = 0.4;
      const int layers = 7;
      const Mesh mesh = cylinder_tetrahedra(axis, begin, end, radius, rings, layers);
      CHECK(mesh.positions.size() == std::size_t((layers + 1) * (3 * rings * (rings + 1) + 1)));
      CHECK(mesh.tetrahedra.size() == std::size_t(18 * rings * rings * layers));
      CHECK(is_conforming(mesh));
      const TetrahedronQuality q = quality(mesh);
      CHECK(q.minVolume > 0);
      // inscribed prism over a regular polygon of 6 rings sides
      const double n = 6 * rings, pi = std::acos(-1.0);
      CHECK(q.volume == Approx(n / 2 * radius * radius * std::sin(2 * pi / n) * (end - begin)));

      Mesh skin = mesh;
      skin.triangles = boundary_triangles(mesh.tetrahedra);
      const SurfaceQuality s = surface_quality(skin);
      CHECK((s.manifold && s.eulerCharacteristic == 2));
      int ends = 0;
      for (Triangle const& t : skin.triangles) {  // on an end plane exactly, or all points on the radius
        int onBegin = 0, onEnd = 0;
        for (const Index i : t) {
          Eigen::Vector3d x = mesh.positions[std::size_t(i)];
          onBegin += x[axis] == begin, onEnd += x[axis] == end;
          x[axis] = 0;
          if (t[0] == i) CHECK(x.norm() <= radius * (1 + 1e-15));
        }
        ends += onBegin == 3 || onEnd == 3;
        if (onBegin == 3 || onEnd == 3) continue;
        for (const Index i : t) {
          Eigen::Vector3d x = mesh.positions[std::size_t(i)];
          x[axis] = 0;
          CHECK(x.norm() == Approx(radius).epsilon(1e-15));
        }
      }
      CHECK(ends == 2 * 6 * rings * rings);
    }
}

TEST_CASE("grids refuse sizes that make no sense") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(contains(error_of([] { regular_grid(1, 3, 3, lo, hi); }), "1 x 3 x 3"));
  CHECK(contains(error_of([] { regular_grid(3, -3, 3, lo, hi); }), "at least 2"));
  CHECK(contains(error_of([] { regular_grid(2000000000, 2000000000, 2, lo, hi); }), "2^28"));
  CHECK(contains(error_of([] { regular_grid(2, 2, 2, hi, lo); }), "is empty"));
  CHECK(contains(error_of([&] { regular_grid(2, 2, 2, {nan, 0, 0}, hi); }), "is empty"));
  CHECK(contains(error_of([] { regular_grid_tetrahedra(2, 2, 2, lo, hi, 4); }), "5 or 6"));
  CHECK(contains(error_of([] { regular_grid_tetrahedra(2, 0, 2, lo, hi); }), "regular_grid_tetrahedra: "));
  CHECK(contains(error_of([] { cylinder_tetrahedra(3, 0, 1, 1, 2, 2); }), "axis 3"));
  CHECK(contains(error_of([] { cylinder_tetrahedra(0, 1, 1, 1, 2, 2); }), "from 1 to 1"));
  CHECK(contains(error_of([&] { cylinder_tetrahedra(0, 0, 1, nan, 2, 2); }), "radius"));
  CHECK(contains(error_of([] { cylinder_tetrahedra(0, 0, 1, 1, 0, 2); }), "0 rings"));
  CHECK(contains(error_of([] { cylinder_tetrahedra(0, 0, 1, 1, 2000000000, 2000000000); }), "2^28"));
}

}  // namespace test_regular_grid
