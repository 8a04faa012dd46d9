// SPDX-License-Identifier: BSL-1.0
#include <sinew/topology/quality.hpp>

#include <cmath>

#include "catch.hpp"
#include "mesh_checks.hpp"

namespace test_quality {

using namespace sinew;

TEST_CASE("quality of tetrahedra known by hand") {
  Mesh regular;
  regular.positions = {{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}};
  regular.tetrahedra = {{0, 1, 2, 3}};
  TetrahedronQuality q = quality(regular);
  CHECK(q.minDihedral == Approx(std::acos(1 / 3.0) * 180 / std::acos(-1.0)));
  CHECK(q.maxDihedral == Approx(q.minDihedral));
  CHECK(std::abs(q.volume) == Approx(8 / 3.0));

  Mesh corner;
  corner.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  corner.tetrahedra = {{0, 1, 2, 3}};
  q = quality(corner);
  CHECK(q.maxDihedral == Approx(90));
  CHECK(q.minDihedral == Approx(std::acos(1 / std::sqrt(3.0)) * 180 / std::acos(-1.0)));
  CHECK(q.minVolume == Approx(1 / 6.0));
  corner.tetrahedra.push_back({1, 0, 2, 3});  // inverted
  q = quality(corner);
  CHECK(q.minVolume == Approx(-1 / 6.0));
  CHECK(q.volume == Approx(0).margin(1e-15));

  // flat: the angles are 0 and 180
  corner.positions[3] = {1, 1, 0};
  corner.tetrahedra = {{0, 1, 2, 3}};
  q = quality(corner);
  CHECK(q.minDihedral == Approx(0).margin(1e-9));
  CHECK(q.maxDihedral == Approx(180));
}

TEST_CASE("quality of surfaces known by hand") {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {9, 9, 9}};  // the last is unused
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  SurfaceQuality q = surface_quality(mesh);
  CHECK(q.minAngle == Approx(45));
  CHECK(q.maxAngle == Approx(90));
  CHECK(q.area == Approx(1.5 + std::sqrt(3.0) / 2));
  CHECK(q.volume == Approx(1 / 6.0));
  CHECK(q.eulerCharacteristic == 2);
  CHECK((q.closed && q.manifold));

  Mesh open = mesh;
  open.triangles.pop_back();
  q = surface_quality(open);
  CHECK(q.eulerCharacteristic == 1);  // a disk
  CHECK_FALSE((q.closed || q.manifold));

  Mesh flipped = mesh;
  std::swap(flipped.triangles[0][0], flipped.triangles[0][1]);
  CHECK_FALSE(surface_quality(flipped).closed);

  // two tetrahedra that touch in a point: closed, but no manifold
  Mesh touching = mesh;
  touching.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  for (Triangle const& t : mesh.triangles) {
    auto other = [](Index i) { return i == 0 ? 0 : i + 3; };
    touching.triangles.push_back({other(t[0]), other(t[2]), other(t[1])});
  }
  q = surface_quality(touching);
  CHECK(q.closed);
  CHECK_FALSE(q.manifold);
  CHECK(q.volume == Approx(2 / 6.0));
}

TEST_CASE("quality refuses meshes without elements or points") {
  CHECK(contains(error_of([] { quality(Mesh{}); }), "no tetrahedra"));
  CHECK(contains(error_of([] { surface_quality(Mesh{}); }), "no triangles"));
  Mesh mesh;
  mesh.tetrahedra = {{0, 1, 2, 3}};
  CHECK(contains(error_of([&] { quality(mesh); }), "tetrahedron 0"));
}

}  // namespace test_quality
