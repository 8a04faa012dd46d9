// SPDX-License-Identifier: BSL-1.0
// Scenes over time as glTF: its parts by the rules of the format, and the points at a time as a viewer puts
// them together.
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/mechanics.hpp>
#include <sinew/topology/regular_grid.hpp>
#include <sinew/view/gltf.hpp>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>

namespace test_gltf {

using namespace sinew;

namespace {

struct Parts {
  std::string json{}, bytes{};
};

/// The two chunks of a binary file, whose sizes have to be right.
Parts parts_of(std::string const& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string file{std::istreambuf_iterator<char>(in), {}};
  auto number = [&](std::size_t at) {
    std::uint32_t value;
    std::memcpy(&value, file.data() + at, 4);
    return std::size_t(value);
  };
  REQUIRE(file.size() > 28);
  REQUIRE(file.substr(0, 4) == "glTF");
  REQUIRE(number(4) == 2);
  REQUIRE(number(8) == file.size());
  const std::size_t json = number(12), bytes = number(20 + json);
  REQUIRE(file.substr(16, 4) == "JSON");
  REQUIRE(json % 4 == 0);
  REQUIRE(file.substr(24 + json, 3) == "BIN");
  REQUIRE(28 + json + bytes == file.size());
  return {file.substr(20, json), file.substr(28 + json)};
}
/// The number behind `"name":`, from a place on.
std::size_t value(std::string const& json, std::string const& name, std::size_t from = 0) {
  const std::size_t at = json.find("\"" + name + "\":", from);
  REQUIRE(at != json.npos);
  return std::size_t(std::stoul(json.substr(at + name.size() + 3)));
}
std::size_t count(std::string const& json, std::string const& what) {
  std::size_t n = 0;
  for (std::size_t at = json.find(what); at != json.npos; at = json.find(what, at + 1)) ++n;
  return n;
}
/// The floats of an accessor, by the view with its number: each accessor has its own.
std::vector<float> floats(Parts const& parts, std::size_t accessor) {
  std::size_t at = parts.json.find("\"bufferViews\":[");
  for (std::size_t k = 0; k <= accessor; ++k) at = parts.json.find("\"byteOffset\":", at + 1);
  std::vector<float> values(value(parts.json, "byteLength", at) / 4);
  std::memcpy(values.data(), parts.bytes.data() + value(parts.json, "byteOffset", at), 4 * values.size());
  return values;
}

}  // namespace

TEST_CASE("a body that falls has its points of each time, as a mesh and what is added to it") {
  const Mesh mesh = regular_grid(2, 2, 3, {0, 0, 0}, {1, 1, 2});
  Simulation sim{node<"root">(Gravity{{0, 0, -10}},
                              EulerExplicitSolver{},
                              node<"block">(MeshTopology{.hexahedra = mesh.hexahedra},
                                            MechanicalObject<Vec3d>{mesh.positions},
                                            UniformMass<Vec3d>{.vertexMass = 1}))};
  sim.init();
  view::GltfFile file("falling.glb");
  std::vector<double> heights;
  for (int frame = 0; frame < 4; ++frame) {
    file.add(view::seen_scene(sim));
    heights.push_back(sim.at<"block">().state().position[0].z());
    sim.animate(0.1);
  }
  CHECK_THAT(error_of([&] {
               auto late = view::seen_scene(sim);
               late.time = 0.2;
               file.add(late);
             }),
             Catch::Contains("rising times"));
  file.finish();
  const Parts parts = parts_of("falling.glb");
  CHECK(count(parts.json, "\"mesh\":") == 1);
  CHECK(count(parts.json, "\"mode\":4") == 1);
  CHECK(value(parts.json, "byteLength", parts.json.find("\"buffers\"")) == parts.bytes.size());
  // turned so that z is upwards: a quarter about x
  CHECK_THAT(parts.json, Catch::Contains("\"rotation\":[-0.707"));
  // accessors: times, points, corners, three targets, weights
  CHECK(count(parts.json, "\"componentType\":") == 7);
  const auto times = floats(parts, 0), points = floats(parts, 1), weights = floats(parts, 6);
  REQUIRE(times.size() == 4);
  CHECK(times[3] == Approx(0.3));
  REQUIRE(points.size() == 3 * mesh.positions.size());
  REQUIRE(weights.size() == 4 * 3);
  for (std::size_t t = 0; t < 4; ++t) {
    float z = points[2];
    for (std::size_t target = 0; target < 3; ++target)
      z += weights[3 * t + target] * floats(parts, 3 + target)[2];
    CHECK(z == Approx(heights[t]));
  }
  // ten quads of the surface, as two triangles each
  CHECK(value(parts.json, "count", parts.json.find("\"componentType\":5125")) == 60);
  std::remove("falling.glb");
}

TEST_CASE("a body whose elements change is another one from then on, and each is there in its time") {
  view::SeenScene scene;
  scene.bodies.push_back(
      {.path = "/a", .points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}});
  view::GltfFile file("changing.glb");
  file.add(scene);
  scene.time = 1;
  file.add(scene);
  scene.bodies[0].triangles.clear();
  scene.bodies[0].edges = {{0, 1}};
  scene.time = 2;
  file.add(scene);
  file.finish();
  const Parts parts = parts_of("changing.glb");
  CHECK(count(parts.json, "\"mesh\":") == 2);
  CHECK(count(parts.json, "\"mode\":1") == 1);
  CHECK(count(parts.json, "\"path\":\"scale\"") == 2);
  CHECK(count(parts.json, "\"interpolation\":\"STEP\"") == 2);
  scene.bodies[0].points[1].x() = std::nan("");
  scene.time = 3;
  CHECK_THAT(error_of([&] { file.add(scene); }), Catch::Contains("/a") && Catch::Contains("not finite"));
  std::remove("changing.glb");
}

}  // namespace test_gltf
