// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/topology/cube_topology.hpp>
#include <sinew/topology/surface_sampling.hpp>

namespace test_surface_sampling {

using namespace sinew;

TEST_CASE("samples of a square are those of its lattice, each once") {
  SurfaceSampling square{
      .position = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, .quads = {{0, 1, 2, 3}}, .spacing = 0.1};
  square.generate("test");
  double nearest = 1;
  for (std::size_t i = 0; i < square.samples.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      nearest = std::min(nearest, (square.samples[i] - square.samples[j]).norm());
  CHECK(nearest >= 0.05 - 1e-12);
  // no place of the square is farther from a sample than the middle of a cell of the lattice, and half more
  for (double x = 0; x <= 1; x += 0.01)
    for (double y = 0; y <= 1; y += 0.01) {
      double away = 1;
      for (auto const& s : square.samples) away = std::min(away, (s - Eigen::Vector3d(x, y, 0)).norm());
      REQUIRE(away <= 1.5 * 0.1 * std::sqrt(0.5));
    }
  CHECK(square.view().positions.size() == square.samples.size());
}

TEST_CASE("samples lie on the surface, with all of its corners") {
  CubeTopology cube{.max = {0.3, 0.2, 0.4}};
  cube.generate("test");
  SurfaceSampling surface{.position = cube.position, .quads = cube.quads, .spacing = 0.05};
  surface.generate("test");
  for (auto const& p : surface.samples) {
    const Eigen::Array3d size(0.3, 0.2, 0.4);
    CHECK((p.array() >= -1e-12 && p.array() <= size + 1e-12).all());
    CHECK((p.array().abs() < 1e-12 || (p.array() - size).abs() < 1e-12).any());
  }
  for (auto const& corner : cube.position)
    CHECK(std::count(surface.samples.begin(), surface.samples.end(), corner) == 1);
}

TEST_CASE("a surface that is none is refused") {
  auto wrong = [](SurfaceSampling s) { return error_of([&] { s.generate("/root/box"); }); };
  const std::vector<Eigen::Vector3d> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  CHECK_THAT(wrong({.position = corners}),
             Catch::Contains("/root/box: SurfaceSampling") && Catch::Contains("no triangles"));
  CHECK_THAT(wrong({.position = corners, .triangles = {{0, 1, 3}}}), Catch::Contains("the point 3"));
  // a sliver without an area
  CHECK_THAT(
      wrong({.position = {{0, 0, 0}, {1e9, 0, 0}, {2e9, 0, 0}}, .triangles = {{0, 1, 2}}, .spacing = 1e-3}),
      Catch::Contains("2^24"));
  CHECK_THAT(wrong({.position = corners, .triangles = {{0, 1, 2}}, .spacing = 1e-6}),
             Catch::Contains("2^24"));
}

}  // namespace test_surface_sampling
