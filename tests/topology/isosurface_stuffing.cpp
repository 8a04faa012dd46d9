// SPDX-License-Identifier: BSL-1.0
#include <sinew/topology/isosurface_stuffing.hpp>
#include <sinew/topology/quality.hpp>

#include <cmath>
#include <limits>

#include "catch.hpp"
#include "mesh_checks.hpp"

namespace test_isosurface_stuffing {

using namespace sinew;
using Eigen::Vector3d;

namespace {

const double pi = std::acos(-1.0);

SurfaceQuality skin_quality(Mesh mesh) {
  mesh.triangles = boundary_triangles(mesh.tetrahedra);
  return surface_quality(mesh);
}

template <class Shape>
void check_mesh_of(Shape const& shape, Mesh const& mesh) {
  CHECK(is_conforming(mesh));
  const TetrahedronQuality q = quality(mesh);
  CHECK(q.minVolume > 0);
  CHECK(q.minDihedral > 10.7);
  CHECK(q.maxDihedral < 164.8);
  const SurfaceQuality s = skin_quality(mesh);
  CHECK(s.manifold);
  CHECK(s.eulerCharacteristic == 2);
  CHECK(s.volume == Approx(q.volume));
  double inside = -1;
  for (Vector3d const& x : mesh.positions) inside = std::max(inside, shape(x));
  CHECK(inside < 1e-9);  // no point outside: the points of the boundary are on the surface
}

}  // namespace

TEST_CASE("tetrahedra of smooth shapes keep the angle bounds, conform, and have one closed skin") {
  const SphereShape sphere{{0.1, 0.2, 0.3}, 1};
  for (const double h : {0.6, 0.35, 0.2, 0.11})
    check_mesh_of(sphere, tetrahedralize(sphere, {-0.9, -0.8, -0.7}, {1.1, 1.2, 1.3}, h));
  const EllipsoidShape ellipsoid{{0, 0, 0}, {1, 0.6, 0.35}};
  for (const double h : {0.3, 0.2, 0.1, 0.061})
    check_mesh_of(ellipsoid, tetrahedralize(ellipsoid, {-1, -0.7, -0.4}, {1, 0.7, 0.4}, h));
  const LiverShape liver;
  for (const double h : {0.03, 0.02, 0.014, 0.009})
    check_mesh_of(liver, tetrahedralize(liver, LiverShape::box_min(), LiverShape::box_max(), h));
}

TEST_CASE("the volume of a sphere converges with order 2") {
  double last = 0;
  for (const double h : {0.25, 0.125, 0.0625}) {
    const Mesh mesh = tetrahedralize(SphereShape{}, {-1, -1, -1}, {1, 1, 1}, h);
    const double error = 4 * pi / 3 - quality(mesh).volume;
    CHECK(error > 0);  // chords of a convex body
    if (last > 0) CHECK(std::log2(last / error) == Approx(2).margin(0.15));
    last = error;
  }
  CHECK(last < 0.0045);
  const Mesh ellipsoid =
      tetrahedralize(EllipsoidShape{{0, 0, 0}, {1, 0.6, 0.3}}, {-1, -1, -1}, {1, 1, 1}, 0.05);
  CHECK(quality(ellipsoid).volume == Approx(4 * pi / 3 * 0.18).epsilon(0.005));
}

TEST_CASE("the flat face of a block comes out flat, also through lattice points") {
  for (const double level : {0.0, 0.1, 0.25, 0.4}) {
    const BoxShape block{{-1, -1, -1}, {1, 1, level}};
    const Mesh mesh = tetrahedralize(block, {-1, -1, -1}, {1, 1, 1}, 0.25);
    double top = -1;
    for (Vector3d const& x : mesh.positions) top = std::max(top, x[2]);
    CHECK(top == Approx(level).margin(1e-9));
    CHECK(quality(mesh).volume == Approx(4 * (1 + level)).epsilon(0.02));
    CHECK(quality(mesh).minDihedral > 10.7);
  }
}

TEST_CASE("the number of tetrahedra can be asked for") {
  const LiverShape liver;
  for (const int count : {200, 600, 1800, 30000}) {
    const Mesh mesh = tetrahedralize_count(liver, LiverShape::box_min(), LiverShape::box_max(), count);
    CHECK(double(mesh.tetrahedra.size()) == Approx(count).epsilon(count < 500 ? 0.05 : 0.01));
    check_mesh_of(liver, mesh);
    const TetrahedronQuality q = quality(mesh);
    UNSCOPED_INFO("liver of " << mesh.tetrahedra.size() << " tetrahedra: " << q.minDihedral << " to "
                              << q.maxDihedral);
    CHECK(q.minDihedral > 13);
    CHECK(q.maxDihedral < 150);
  }
  CHECK(tetrahedralize_count(SphereShape{}, {-1, -1, -1}, {1, 1, 1}, 1).tetrahedra.size() == 24);
}

TEST_CASE("a million tetrahedra; the shape is evaluated about once a lattice point") {
  long evaluations = 0;
  auto ball = [&](Vector3d const& p) {
    ++evaluations;
    return p.norm() - 1;
  };
  const double h = 0.0373;
  const Mesh mesh = tetrahedralize(ball, {-1, -1, -1}, {1, 1, 1}, h);
  CHECK(mesh.tetrahedra.size() > 900000);
  const double cells = std::pow(2 / h + 3, 3);  // of the box and a rim, 2 points each
  CHECK(double(evaluations) < 2 * 2 * cells);   // and 4 times a cut edge
  CHECK(quality(mesh).minDihedral > 14);
}

TEST_CASE("the same shape gives the same mesh") {
  const LiverShape liver;
  auto mesh = [&] { return tetrahedralize(liver, LiverShape::box_min(), LiverShape::box_max(), 0.02); };
  CHECK(mesh() == mesh());
}

TEST_CASE("of several pieces the largest remains") {
  const SmoothUnion pair{SphereShape{{-1.5, 0, 0}, 0.6}, SphereShape{{1.5, 0, 0}, 1}, 0.0};
  const Mesh mesh = tetrahedralize(pair, {-3, -1, -1}, {3, 1, 1}, 0.2);
  for (Vector3d const& x : mesh.positions)
    if (x[0] < 0) FAIL("a point of the smaller ball remains");
  CHECK(quality(mesh).volume == Approx(4 * pi / 3).epsilon(0.03));
  CHECK(skin_quality(mesh).eulerCharacteristic == 2);
}

TEST_CASE("a shape full of details below the spacing still gives a conforming, closed, well-shaped mesh") {
  for (const double f : {7.0, 14.0, 21.0, 35.0}) {
    auto noise = [f](Vector3d const& p) {
      return std::sin(f * p[0] + 3 * std::sin(0.7 * f * p[1])) +
             std::sin(0.9 * f * p[1] + 2 * std::sin(0.6 * f * p[2])) +
             std::sin(f * p[2] + 2 * std::sin(0.8 * f * p[0] + 2)) + 2 * std::max(0.0, 4 * p.norm() - 3.2);
    };
    const Mesh mesh = tetrahedralize(noise, {-1.7, -1.7, -1.7}, {1.7, 1.7, 1.7}, 0.13);
    CHECK(mesh.tetrahedra.size() > 5000);
    CHECK(is_conforming(mesh));
    CHECK(quality(mesh).minVolume > 0);
    CHECK(quality(mesh).minDihedral > 10.7);
    CHECK(quality(mesh).maxDihedral < 161.7);
    CHECK(skin_quality(mesh).manifold);
  }
}

TEST_CASE("tetrahedralize refuses what it cannot mesh") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const Vector3d lo(-1, -1, -1), hi(1, 1, 1);
  const SphereShape sphere;
  for (const double h : {0.0, -1.0, nan, inf})
    CHECK(contains(error_of([&] { tetrahedralize(sphere, lo, hi, h); }), "it must be a positive length"));
  CHECK(contains(error_of([&] { tetrahedralize(sphere, lo, hi, 1e-6); }), "2^28"));
  CHECK(contains(error_of([&] { tetrahedralize(sphere, lo, hi, 1e-300); }), "2^28"));
  CHECK(contains(error_of([&] { tetrahedralize(sphere, hi, lo, 0.1); }), "is empty"));
  CHECK(contains(error_of([&] { tetrahedralize(sphere, lo, {1, 1, -1}, 0.1); }), "is empty"));
  CHECK(contains(error_of([&] { tetrahedralize(sphere, lo, {1, nan, 1}, 0.1); }), "is empty"));
  CHECK(contains(error_of([&] { tetrahedralize(sphere, lo, {1, 1, inf}, 0.1); }), "is empty"));
  CHECK(contains(error_of([&] {
                   tetrahedralize(SphereShape{{0, 0, 0}, 2}, lo, hi, 0.1);
                 }),
                 "leaves the box"));
  CHECK(contains(error_of([&] {
                   tetrahedralize(SphereShape{{5, 5, 5}, 1}, lo, hi, 0.1);
                 }),
                 "nothing of the shape"));
  CHECK(contains(error_of([&] {
                   tetrahedralize(SphereShape{{0, 0, 0}, 0.01}, lo, hi, 0.3);
                 }),
                 "nothing of the shape"));
  CHECK(contains(error_of([&] { tetrahedralize([&](Vector3d const&) { return nan; }, lo, hi, 0.1); }),
                 "gives nan at ("));
  auto hole = [&](Vector3d const& p) { return p.norm() < 0.3 ? -inf : p.norm() - 1; };
  CHECK(contains(error_of([&] { tetrahedralize(hole, lo, hi, 0.1); }), "finite number"));
  auto count = [&](auto const& shape, int n) {
    return error_of([&] { tetrahedralize_count(shape, lo, hi, n); });
  };
  CHECK(contains(count(sphere, 0), "0 tetrahedra were asked for"));
  CHECK(contains(count(sphere, -5), "at least 1"));
  CHECK(contains(count(sphere, 2147483647), "2^28"));
  CHECK(contains(count(SphereShape{{5, 5, 5}, 1}, 100), "nothing of the shape"));
  CHECK(contains(count([&](Vector3d const&) { return nan; }, 100), "gives nan"));
  CHECK(contains(error_of([&] { tetrahedralize_count(sphere, hi, lo, 100); }), "is empty"));
}

}  // namespace test_isosurface_stuffing
