// SPDX-License-Identifier: BSL-1.0
#include <sinew/topology/quality.hpp>
#include <sinew/topology/regular_grid.hpp>
#include <sinew/topology/surface_mesh.hpp>

#include <cmath>
#include <limits>

#include "catch.hpp"
#include "mesh_checks.hpp"

namespace test_surface_mesh {

using namespace sinew;
using Eigen::Vector3d;

namespace {

const double pi = std::acos(-1.0);

template <class Shape>
double farthest(Shape const& shape, Mesh const& mesh) {
  double distance = 0;
  for (Vector3d const& x : mesh.positions) distance = std::max(distance, std::abs(shape(x)));
  return distance;
}

}  // namespace

TEST_CASE("the skin of a liver is closed, smooth, outwards, on the surface") {
  const LiverShape liver;
  for (const double h : {0.03, 0.02, 0.01, 0.006}) {
    const Mesh mesh = surface(liver, LiverShape::box_min(), LiverShape::box_max(), h);
    const SurfaceQuality q = surface_quality(mesh);
    CHECK(q.closed);
    CHECK(q.manifold);
    CHECK(q.eulerCharacteristic == 2);
    CHECK(q.minAngle > 25);
    CHECK(q.maxAngle < 125);
    CHECK(q.volume == Approx(0.0014).epsilon(0.07));
    CHECK(farthest(liver, mesh) < 1e-6 * h);
    CHECK(mesh.tetrahedra.empty());
    CHECK(edges_of(mesh.triangles).size() * 2 == mesh.triangles.size() * 3);
    std::vector<bool> used(mesh.positions.size(), false);
    for (Triangle const& t : mesh.triangles)
      for (const Index i : t) used[std::size_t(i)] = true;
    CHECK(std::find(used.begin(), used.end(), false) == used.end());
  }
}

TEST_CASE("area and volume of a sphere's skin converge with order 2") {
  double lastArea = 0, lastVolume = 0;
  for (const double h : {0.3, 0.15, 0.075}) {
    const Mesh mesh = surface(SphereShape{}, {-1, -1, -1}, {1, 1, 1}, h);
    const SurfaceQuality q = surface_quality(mesh);
    const double area = 4 * pi - q.area, volume = 4 * pi / 3 - q.volume;
    if (lastArea > 0) {
      CHECK(std::log2(lastArea / area) == Approx(2).margin(0.2));
      CHECK(std::log2(lastVolume / volume) == Approx(2).margin(0.2));
    }
    lastArea = area, lastVolume = volume;
    CHECK(farthest(SphereShape{}, mesh) < 1e-6 * h);
  }
  CHECK(lastVolume < 0.01);
}

TEST_CASE("a torus has Euler characteristic 0, two balls give the larger one") {
  auto torus = [](Vector3d const& p) { return std::hypot(std::hypot(p[0], p[1]) - 1, p[2]) - 0.4; };
  const Mesh ring = surface(torus, {-1.5, -1.5, -0.5}, {1.5, 1.5, 0.5}, 0.15);
  CHECK(surface_quality(ring).manifold);
  CHECK(surface_quality(ring).eulerCharacteristic == 0);
  CHECK(surface_quality(ring).volume == Approx(2 * pi * pi * 0.16).epsilon(0.02));
  const SmoothUnion pair{SphereShape{{-1.5, 0, 0}, 0.6}, SphereShape{{1.5, 0, 0}, 1}, 0.0};
  CHECK(surface_quality(surface(pair, {-3, -1, -1}, {3, 1, 1}, 0.15)).volume ==
        Approx(4 * pi / 3).epsilon(0.02));
  // a shell has two skins
  const SmoothSubtraction shell{SphereShape{{0, 0, 0}, 1}, SphereShape{{0, 0, 0}, 0.5}, 0.0};
  const SurfaceQuality q = surface_quality(surface(shell, {-1, -1, -1}, {1, 1, 1}, 0.1));
  CHECK((q.manifold && q.eulerCharacteristic == 4));
  CHECK(q.volume == Approx(4 * pi / 3 * 0.875).epsilon(0.02));
}

TEST_CASE("details below the spacing do not open or pinch the skin") {
  auto noise = [](Vector3d const& p) {
    return std::sin(20 * p[0] + 3 * std::sin(14 * p[1])) + std::sin(18 * p[1] + 2 * std::sin(12 * p[2])) +
           std::sin(20 * p[2] + 2 * std::sin(16 * p[0] + 2)) + 2 * std::max(0.0, 4 * p.norm() - 3.2);
  };
  const SurfaceQuality q = surface_quality(surface(noise, {-1.7, -1.7, -1.7}, {1.7, 1.7, 1.7}, 0.13));
  CHECK(q.manifold);
  CHECK(q.minAngle > 10);
}

TEST_CASE("the boundary surface of a volume mesh keeps only its own points") {
  const Mesh grid = regular_grid_tetrahedra(4, 4, 4, {0, 0, 0}, {1, 1, 1});
  const Mesh skin = boundary_surface(grid);
  CHECK(skin.positions.size() == 64 - 8);
  CHECK(skin.triangles.size() == 6 * 9 * 2);
  const SurfaceQuality q = surface_quality(skin);
  CHECK((q.manifold && q.eulerCharacteristic == 2));
  CHECK(q.area == Approx(6));
  CHECK(q.volume == Approx(1));
}

TEST_CASE("surface refuses what it cannot mesh") {
  const Vector3d lo(-1, -1, -1), hi(1, 1, 1);
  CHECK(contains(error_of([&] { surface(SphereShape{}, lo, hi, 0); }), "surface: the spacing is 0"));
  CHECK(contains(error_of([&] { surface(SphereShape{}, hi, lo, 0.1); }), "is empty"));
  CHECK(contains(error_of([&] { surface(SphereShape{{9, 9, 9}, 1}, lo, hi, 0.1); }), "nothing of the shape"));
  CHECK(contains(error_of([&] { surface(SphereShape{{0, 0, 0}, 2}, lo, hi, 0.1); }), "leaves the box"));
  auto bad = [](Vector3d const& p) {
    return p[0] > 0.5 ? std::numeric_limits<double>::quiet_NaN() : p.norm() - 0.9;
  };
  CHECK(contains(error_of([&] { surface(bad, lo, hi, 0.1); }), "gives nan"));
}

}  // namespace test_surface_mesh
