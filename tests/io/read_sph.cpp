// SPDX-License-Identifier: BSL-1.0
#include <sinew/io/read_sph.hpp>

#include "files.hpp"

namespace test_read_sph {

using namespace sinew;
using files::check_says;

namespace {

std::string error_in(std::string_view content) {
  return error_of([&] { io::parse_sph("f.sph", content); });
}

}  // namespace

TEST_CASE("read_sph reads centres and radii") {
  const files::TempFolder folder;
  const auto spheres = io::read_sph(folder.write(
      "a.sph",
      "sph 1.0\n#nums 2\n\n# xmin=\"-5\"\nnums 2\nsphe 1 -4 1.25 0 0.85\r\nsphe 7 1 2 3 1e-1 # small\n"));
  CHECK(spheres.centers == std::vector<Eigen::Vector3d>{{-4, 1.25, 0}, {1, 2, 3}});
  CHECK(spheres.radii == std::vector<double>{0.85, 0.1});
}

TEST_CASE("read_sph names the line of an error") {
  check_says(error_in("obj 1.0\n"), "f.sph:1", "expected sph");
  check_says(error_in("sph 1.0\n# none\n"), "f.sph:2", "there are no spheres");
  check_says(error_in("sph 1.0\nsphe 1 0 0 0 1\ncube 1 2 3\n"), "f.sph:3", "found \"cube\"");
  check_says(error_in("sph 1.0\nsphe 1 0 0 0 0\n"), "f.sph:2", "the radius is 0");
  check_says(error_in("sph 1.0\nsphe 1 0 0 0 -1\n"), "f.sph:2", "the radius is -1");
  check_says(error_in("sph 1.0\nsphe 1 0 nan 0 1\n"), "f.sph:2", "not a finite number");
  check_says(
      error_in("sph 1.0\nsphe 1 0 0 0\nsphe 2 0 0 0 1"), "f.sph:3", "expected a radius, found \"sphe\"");
  check_says(error_in("sph 1.0\nsphe 1 0 0 0"), "f.sph:2", "the data end where a radius");
  check_says(error_in("sph 1.0\nsphe a 0 0 0 1"), "f.sph:2", "the number of the sphere");
  check_says(error_in(std::string("sph 1.0\nsphe 1 0 \0 0 1", 20)), "f.sph:2", "not text");
}

}  // namespace test_read_sph
