// SPDX-License-Identifier: BSL-1.0
#include <sinew/engine/sphere_loader.hpp>

#include "io/files.hpp"

namespace test_sphere_loader {

using namespace sinew;
using files::check_says;

static_assert(Engine<SphereLoader>);

TEST_CASE("SphereLoader brings spheres to their place") {
  const files::TempFolder folder;
  const std::string file =
      folder.write("a.sph", "sph 1.0\n#nums 2\nsphe 1 -4 1.25 0 0.85\nsphe 2 1 2 3 0.5\n");
  SphereLoader spheres{.filename = {file}};
  spheres.update("s");
  CHECK(spheres.position == std::vector<Eigen::Vector3d>{{-4, 1.25, 0}, {1, 2, 3}});
  CHECK(spheres.listRadius == std::vector<double>{0.85, 0.5});
  // sized, turned about z, moved; updating again starts from the file
  spheres.scale = {2, 2, 2}, spheres.rotation = {0, 0, 90}, spheres.translation = {1, 0, 0};
  for (int round = 0; round < 2; ++round) {
    spheres.update("s");
    CHECK(spheres.position[1].isApprox(Eigen::Vector3d(1 - 4, 2, 6)));
    CHECK(spheres.listRadius[0] == Approx(1.7));
    CHECK(spheres.listRadius[1] == Approx(1));
  }
  spheres.scale = {1, -8, 1};
  spheres.update("s");
  CHECK(spheres.listRadius[1] == Approx(1));
}

TEST_CASE("SphereLoader says what is wrong, and keeps what it had") {
  const files::TempFolder folder;
  SphereLoader spheres{.filename = {folder.write("a.sph", "sph 1.0\nsphe 1 0 0 0 1\n")}};
  spheres.update("s");
  auto refused = [&](SphereLoader change, std::string_view words) {
    check_says(error_of([&] { change.update("/root"); }), "/root: SphereLoader", words);
    CHECK(change.listRadius == std::vector<double>{1});
  };
  SphereLoader other = spheres;
  other.filename.path.clear();
  refused(other, "filename is empty");
  other.filename.path = folder / "b.sph";
  refused(other, "b.sph: cannot be read");
  other.filename.path = folder.write("c.sph", "sph 1.0\nsphe 1 0 0 0 -1\n");
  refused(other, "c.sph:2: the radius is -1");
  other = spheres;
  other.scale[2] = 0;
  refused(other, "scale is 0");
  other.scale[2] = INFINITY;
  refused(other, "scale is inf");
}

}  // namespace test_sphere_loader
