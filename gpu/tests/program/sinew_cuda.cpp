// SPDX-License-Identifier: BSL-1.0
// The program sinew_cuda, given scene files over the DataTypes of a device, against the same files over those
// of the processor and the standard registry. SINEW_CUDA in the environment names another program, such as
// the one for a GPU.
#include "catch.hpp"
#include "io/files.hpp"

#include <sinew/runtime/precompiled.hpp>
#include <sinew/runtime/record.hpp>

#include <cstdlib>
#include <fstream>
#include <iterator>

namespace test_sinew_cuda {

using namespace sinew;
using Catch::Matchers::Contains;

namespace {

struct Ended {
  int code = 0;
  std::string errors{};
};
Ended sinew_cuda(files::TempFolder const& folder, std::string const& arguments) {
  const char* const asked = std::getenv("SINEW_CUDA");
  const std::string errors = folder / "errors.txt";
  const int code = std::system(
      text(asked != nullptr ? asked : SINEW_CUDA_PROGRAM, ' ', arguments, " >/dev/null 2>", errors).c_str());
  std::ifstream said(errors);
  return {code, {std::istreambuf_iterator<char>(said), {}}};
}

std::string replaced_everywhere(std::string in, std::string_view word, std::string_view by) {
  for (std::size_t at = 0; (at = in.find(word, at)) != std::string::npos; at += by.size())
    in.replace(at, word.size(), by);
  return in;
}

// largest distance of two records of a state, over the size of the body or its largest speed
double difference(std::vector<double> const& a, std::vector<double> const& b) {
  REQUIRE(a.size() == b.size());
  double apart = 0, size = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    apart = std::max(apart, std::abs(a[i] - b[i])), size = std::max(size, std::abs(b[i]));
  return apart / size;
}

void same_as_host(std::string const& name, double rounding) {
  CAPTURE(name);
  const std::string file = text(SINEW_CUDA_SCENES "/", name, ".scn"), scene = io::read_file(file);
  const files::TempFolder folder;
  const int steps = 100;
  const auto ended = sinew_cuda(folder, text(file, " --steps ", steps, " --record ", folder / "record.txt"));
  CAPTURE(ended.errors);
  REQUIRE(ended.code == 0);
  const RecordedFrame device = read_record(folder / "record.txt").back();

  auto read = parse_scene<Standard>(
      file, replaced_everywhere(replaced_everywhere(scene, "Cuda", ""), "Vec3f", "Vec3d"), {});
  const double dt = read.dt;
  auto host = start(std::move(read));
  const RecordedFrame before = capture(host.root(), 0, 0);
  for (int i = 0; i < steps; ++i) host.animate(dt);
  const RecordedFrame after = capture(host.root(), host.step(), host.time());

  CHECK(device.step == steps);
  REQUIRE(device.states.size() == after.states.size());
  for (std::size_t i = 0; i < after.states.size(); ++i) {
    CAPTURE(after.states[i].path);
    CHECK(device.states[i].path == after.states[i].path);
    CHECK(device.states[i].dataTypes.starts_with("Cuda"));
    CHECK(difference(device.states[i].positions, after.states[i].positions) < rounding);
    CHECK(difference(device.states[i].velocities, after.states[i].velocities) < rounding);
    CHECK(difference(before.states[i].positions, after.states[i].positions) > 1e-3);  // it moved
  }
}

}  // namespace

TEST_CASE("scene files on a device move as over the processor's DataTypes") {
  for (const char* name : {"tetrahedra", "hexahedra", "hyperelastic", "rigid", "contact", "multigrid"})
    same_as_host(name, 1e-10);
}

TEST_CASE("scene files on a device in float move as in double, to rounding") {
  same_as_host("springs", 1e-3);
}

TEST_CASE("the program for scene files on a device says what is wrong with one") {
  const files::TempFolder folder;
  CHECK_THAT(sinew_cuda(folder, folder / "none.scn").errors, Contains("none.scn"));
  const std::string bad = folder.write(
      "bad.scn", "<Node><MechanicalObject template=\"CudaVec6d\" position=\"0 0 0 0 0 0\"/></Node>");
  const auto ended = sinew_cuda(folder, bad);
  CHECK(ended.code != 0);
  CHECK_THAT(ended.errors, Contains("bad.scn:1:") && Contains("CudaVec3d"));
}

}  // namespace test_sinew_cuda
