// SPDX-License-Identifier: BSL-1.0
#include <sinew/topology/adjacency.hpp>
#include <sinew/topology/hexahedra.hpp>
#include <sinew/topology/quality.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <numeric>
#include <random>

#include "catch.hpp"
#include "mesh_checks.hpp"

namespace test_hexahedra {

using namespace sinew;

namespace {

// the same hexahedron, its corners listed from another one on: quarter turns about two axes reach all of them
Hexahedron turned(Hexahedron h, int x, int z) {
  for (; z > 0; --z) h = {h[1], h[2], h[3], h[0], h[5], h[6], h[7], h[4]};
  for (; x > 0; --x) h = {h[3], h[2], h[6], h[7], h[0], h[1], h[5], h[4]};
  return h;
}

}  // namespace

TEST_CASE("the hexahedra of grids are split into sixths that match") {
  for (const auto& n : {std::array<int, 3>{2, 2, 2}, {3, 2, 5}, {4, 4, 3}, {2, 6, 3}}) {
    const Eigen::Vector3d lo{-1, 0.5, 2}, hi{0.2, 1.1, 5};
    Mesh mesh = regular_grid(n[0], n[1], n[2], lo, hi);
    mesh.tetrahedra = hexahedra_to_tetrahedra(mesh.hexahedra);
    REQUIRE(mesh.tetrahedra.size() == 6 * mesh.hexahedra.size());
    CHECK(is_conforming(mesh));
    const TetrahedronQuality q = quality(mesh);
    CHECK(q.volume == Approx((hi - lo).prod()));
    CHECK(q.minVolume == Approx((hi - lo).prod() / double(mesh.tetrahedra.size())));
  }
}

TEST_CASE(
    "however points are numbered, hexahedra turned and corners moved, the parts match and are positive") {
  std::mt19937 random{7};
  for (int round = 0; round < 20; ++round) {
    Mesh mesh = regular_grid(4, 3, 4, {0, 0, 0}, {3, 2, 3});
    // by a tenth of a cell at most, which leaves every part its sign
    auto noise = [&] { return 0.2 * (double(random() >> 5) / double(1u << 27) - 0.5); };
    for (auto& p : mesh.positions) p += Eigen::Vector3d(noise(), noise(), noise());
    std::vector<Index> number(mesh.positions.size());
    std::iota(number.begin(), number.end(), 0);
    for (std::size_t i = number.size(); i > 1; --i) std::swap(number[i - 1], number[random() % i]);
    Mesh shuffled;
    shuffled.positions.resize(number.size());
    for (std::size_t i = 0; i < number.size(); ++i)
      shuffled.positions[std::size_t(number[i])] = mesh.positions[i];
    for (Hexahedron h : mesh.hexahedra) {
      for (Index& i : h) i = number[std::size_t(i)];
      shuffled.hexahedra.push_back(turned(h, int(random() % 4), int(random() % 4)));
    }
    shuffled.tetrahedra = hexahedra_to_tetrahedra(shuffled.hexahedra);
    CHECK(shuffled.tetrahedra.size() == 6 * mesh.hexahedra.size());
    CHECK(is_conforming(shuffled));
    CHECK(quality(shuffled).minVolume > 0);
    // the boundary is made of two triangles a square
    CHECK(boundary_triangles(shuffled.tetrahedra).size() == 2 * 2 * (3 * 2 + 3 * 3 + 2 * 3));
  }
}

TEST_CASE("faces of a hexahedron look outwards") {
  for (auto const& face : hexahedronFaces) {
    auto at = [&](std::size_t k) {
      auto const& c = hexahedronCorners[face[k]];
      return Eigen::Vector3d(c[0], c[1], c[2]);
    };
    const Eigen::Vector3d normal = (at(1) - at(0)).cross(at(2) - at(0));
    CHECK(normal.dot(at(0) - Eigen::Vector3d::Constant(0.5)) == Approx(0.5));
    CHECK((at(0) + at(2) - at(1) - at(3)).norm() == 0);
  }
}

TEST_CASE("trilinear shape functions interpolate linear functions and have the derivatives they claim") {
  std::mt19937 random{3};
  auto number = [&] { return double(random() >> 5) / double(1u << 27); };
  Eigen::Matrix<double, 3, 8> corners;
  for (int k = 0; k < 8; ++k)
    for (int c = 0; c < 3; ++c) corners(c, k) = hexahedronCorners[k][c];
  for (int round = 0; round < 20; ++round) {
    const Eigen::Vector3d p(number() * 2 - 0.5, number() * 2 - 0.5, number() * 2 - 0.5);
    const MultilinearShape<3> shape(p);
    CHECK(shape.weights.sum() == Approx(1));
    CHECK((corners * shape.weights - p).norm() < 1e-14);
    CHECK((corners * shape.derivatives - Eigen::Matrix3d::Identity()).norm() < 1e-14);
    for (int c = 0; c < 3; ++c) {
      // shape functions are linear along each axis: the central difference is exact to rounding, 1e-16 / 1e-3
      const Eigen::Vector3d step = 1e-3 * Eigen::Vector3d::Unit(c);
      const auto slope =
          ((MultilinearShape<3>(p + step).weights - MultilinearShape<3>(p - step).weights) / 2e-3).eval();
      CHECK((slope - shape.derivatives.col(c)).norm() < 1e-12);
    }
  }
}

}  // namespace test_hexahedra
