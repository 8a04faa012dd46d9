// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/mechanics.hpp>
#include <sinew/topology/regular_grid.hpp>
#include <sinew/view/film.hpp>
#include <sinew/view/picture.hpp>

#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>

namespace test_picture {

using namespace sinew;
using view::Image;

auto block_at(Eigen::Vector3d const& place) {
  Mesh mesh = regular_grid_tetrahedra(4, 3, 3, place, place + Eigen::Vector3d(1.5, 1, 1));
  return Simulation{
      node<"root">(Gravity{{0, -9.81, 0}},
                   EulerImplicitSolver{},
                   CGLinearSolver<>{},
                   node<"block">(MeshTopology{.position = mesh.positions, .tetrahedra = mesh.tetrahedra},
                                 MechanicalObject<Vec3d>{},
                                 UniformMass<Vec3d>{}))};
}
bool is_white(std::array<unsigned char, 3> const& pixel) {
  return pixel[0] == 255 && pixel[1] == 255 && pixel[2] == 255;
}

TEST_CASE("a picture shows a body where the camera projects it") {
  auto sim = block_at({2, 3, 4});
  sim.init();
  view::Painter painter({.width = 400, .height = 300});
  const view::SeenScene scene = view::seen_scene(sim);
  const Image image = painter.paint(scene);
  const view::Camera camera = *painter.camera();
  // pixels whose rays meet the box of the block, but for those at its outline
  const Eigen::Vector3d low(2, 3, 4), high(3.5, 4, 5);
  auto meets = [&](double x, double y) {
    const auto [origin, direction] = camera.ray(x, y, 400, 300);
    const Eigen::Array3d a = (low - origin).array() / direction.array(),
                         b = (high - origin).array() / direction.array();
    return a.min(b).maxCoeff() <= a.max(b).minCoeff();
  };
  int inside = 0, wrong = 0;
  for (int y = 0; y < 300; ++y)
    for (int x = 0; x < 400; ++x) {
      int corners = 0;
      for (const double dx : {-0.5, 1.5})
        for (const double dy : {-0.5, 1.5}) corners += meets(x + dx, y + dy);
      if (corners != 0 && corners != 4) continue;  // at the outline
      inside += corners == 4;
      wrong += is_white(image.at(x, y)) == (corners == 4);
    }
  CHECK(wrong == 0);
  CHECK(inside > 400 * 300 / 10);
}

TEST_CASE("what falls is lower in the next picture") {
  auto sim = block_at({0, 0, 0});
  sim.init();
  view::Painter painter({.width = 200, .height = 200});
  auto middle = [](Image const& image) {
    double sum = 0, count = 0;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        if (!is_white(image.at(x, y))) sum += y, ++count;
    return sum / count;
  };
  const double before = middle(painter.paint(view::seen_scene(sim)));
  const Eigen::Vector3d place(0.75, 0.5, 0.5);
  const double expected = painter.camera()->project(place, 200, 200)[1];
  for (int i = 0; i < 10; ++i) sim.animate(0.02);
  const double fallen = sim.at<"block">().state().position[0].y();  // it falls as a whole
  const double after = middle(painter.paint(view::seen_scene(sim)));
  const double way = painter.camera()->project(place + Eigen::Vector3d(0, fallen, 0), 200, 200)[1] - expected;
  CHECK(way > 5);
  CHECK(after - before == Approx(way).margin(1));
}

TEST_CASE("visual models hide the states that they follow, states their parents without elements") {
  const Mesh skin{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}};
  Simulation sim{
      node<"root">(EulerExplicitSolver{},
                   node<"seen">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                                UniformMass<Vec3d>{},
                                node<"skin">(VisualModel{.mesh = skin}, IdentityMapping<Vec3d, Vec3f>{})),
                   node<"points">(MechanicalObject<Vec3d>{.position = {{0, 0, 2}}}, UniformMass<Vec3d>{}))};
  sim.init();
  const view::SeenScene scene = view::seen_scene(sim);
  REQUIRE(scene.bodies.size() == 2);
  CHECK(scene.bodies[0].path == "/root/points");
  CHECK(scene.bodies[0].points.size() == 1);
  CHECK(scene.bodies[1].path == "/root/seen/skin");
  CHECK(scene.bodies[1].kind == view::SeenBody::Kind::visual);
  const auto [low, high] = scene.box();
  CHECK(low == Eigen::Vector3d(0, 0, 0));
  CHECK(high == Eigen::Vector3d(1, 1, 2));
}

TEST_CASE("normals are smooth where a surface is, and sharp at edges") {
  view::SeenBody body{.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}},
                      .quads = {{0, 3, 2, 1}, {0, 1, 5, 4}}};
  view::ShadedMesh mesh = view::shaded_mesh(body);
  REQUIRE(mesh.triangles.size() == 12);
  CHECK(mesh.corners.size() == 8);  // those of the edge twice
  auto normal = [&](std::size_t i) { return mesh.normals[mesh.triangles[i]]; };
  for (std::size_t i = 0; i < 6; ++i) CHECK((normal(i) - Eigen::Vector3f(0, 0, -1)).norm() < 1e-6f);
  for (std::size_t i = 6; i < 12; ++i) CHECK((normal(i) - Eigen::Vector3f(0, -1, 0)).norm() < 1e-6f);
  CHECK(mesh.lines.at.size() == 2 * 7);                          // the edge in the middle once
  body.points[4] = {0, -1, 0.2}, body.points[5] = {1, -1, 0.2};  // 11 degrees
  mesh = view::shaded_mesh(body);
  CHECK(mesh.corners.size() == 6);
  for (std::size_t i = 0; i < 12; ++i)
    if (mesh.corners[mesh.triangles[i]].y() == 0) CHECK(normal(i).y() < -0.05f);
  // 34 degrees: smooth, though more than 20 from the mean of the two
  body.points[4] = {0, -0.1, 0.0675}, body.points[5] = {1, -0.1, 0.0675};
  mesh = view::shaded_mesh(body);
  CHECK(mesh.corners.size() == 6);
}

TEST_CASE(
    "a surface of several materials has the normals that it has as one, and no more corners than are seen") {
  // a tube of triangles and quads, whose materials change around it and along it, with a texture
  view::SeenBody tube{.path = "/tube", .kind = view::SeenBody::Kind::visual};
  constexpr Index around = 16, along = 5;
  for (Index i = 0; i < along; ++i)
    for (Index j = 0; j < around; ++j) {
      const double angle = 2 * std::numbers::pi * j / around;
      tube.points.emplace_back(std::cos(angle), std::sin(angle), 0.3 * i * i);
    }
  SurfaceLooks looks{.materials = {"a", "b"}, .library = "l"};
  std::vector<Index> ofQuads;
  for (Index i = 0; i + 1 < along; ++i)
    for (Index j = 0; j < around; ++j) {
      const Index a = i * around + j, b = i * around + (j + 1) % around, c = b + around, d = a + around;
      const Index material = (i + j / 5) % 3 - 1;
      if (j % 2) {
        tube.triangles.insert(tube.triangles.end(), {{a, b, c}, {a, c, d}});
        looks.faceMaterials.insert(looks.faceMaterials.end(), 2, material);
      } else {
        tube.quads.push_back({a, b, c, d});
        ofQuads.push_back(material);
      }
    }
  looks.faceMaterials.insert(looks.faceMaterials.end(), ofQuads.begin(), ofQuads.end());
  // the normal of each corner, by its place and the middle of its triangle
  using Place = std::array<float, 6>;
  auto normals = [](std::vector<view::SeenBody> const& bodies) {
    std::map<Place, Eigen::Vector3f> all;
    for (view::SeenBody const& body : bodies) {
      const view::ShadedMesh mesh = view::shaded_mesh(body);
      std::vector<bool> used(mesh.corners.size());
      for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
        const std::size_t first = k - k % 3;
        Eigen::Vector3f middle = Eigen::Vector3f::Zero();
        for (std::size_t c = first; c < first + 3; ++c) middle += mesh.corners[mesh.triangles[c]];
        const Eigen::Vector3f at = mesh.corners[mesh.triangles[k]];
        used[mesh.triangles[k]] = true;
        all[{at[0], at[1], at[2], middle[0], middle[1], middle[2]}] = mesh.normals[mesh.triangles[k]];
      }
      CHECK(std::find(used.begin(), used.end(), false) == used.end());
      CHECK(mesh.casters.size() == mesh.triangles.size());
    }
    return all;
  };
  const auto whole = normals({tube});
  const auto bodies =
      view::bodies_by_material(tube, looks, {{.library = "l", .name = "a"}, {.library = "l", .name = "b"}});
  REQUIRE(bodies.size() == 3);
  const auto parts = normals(bodies);
  REQUIRE(parts.size() == 6 * around * (along - 1));
  REQUIRE(whole.size() == parts.size());
  for (auto const& corner : whole) {
    // the middle is a sum of other points in another order
    const auto found = std::find_if(parts.begin(), parts.end(), [&](auto const& one) {
      float apart = 0;
      for (std::size_t k = 0; k < 6; ++k) apart += std::abs(one.first[k] - corner.first[k]);
      return apart < 1e-4f;
    });
    REQUIRE(found != parts.end());
    CHECK((found->second - corner.second).norm() < 1e-5f);
  }
}

TEST_CASE("the mesh of a body is made again where the body has changed, its shadow by fewer faces") {
  view::SeenBody body{.kind = view::SeenBody::Kind::visual};
  constexpr Index n = 40;
  for (Index i = 0; i <= n; ++i)
    for (Index j = 0; j <= n; ++j) body.points.push_back({double(i), double(j), 0});
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      body.quads.push_back(
          {i * (n + 1) + j, (i + 1) * (n + 1) + j, (i + 1) * (n + 1) + j + 1, i * (n + 1) + j + 1});
  view::ShadedBody shaded;
  CHECK(shaded.update(body, {}, {}, 2));
  CHECK(!shaded.update(body, {}, {}, 2));
  CHECK(shaded.mesh().triangles.size() == 6 * n * n);
  CHECK(shaded.mesh().longest == Approx(std::sqrt(2)));
  // squares of 2 m, from 0 to 40 m
  auto area = [&] {
    double sum = 0;
    auto const& mesh = shaded.mesh();
    for (std::size_t k = 0; k < mesh.casters.size(); k += 3) {
      auto at = [&](std::size_t c) { return mesh.corners[mesh.casters[k + c]]; };
      sum += double((at(1) - at(0)).cross(at(2) - at(0)).norm()) / 2;
    }
    return sum;
  };
  CHECK(shaded.mesh().casters.size() == 6 * n * n / 4);
  CHECK(area() == Approx(n * n));
  // what moves takes its shadow along
  for (Eigen::Vector3d& p : body.points) p *= 1.5;
  CHECK(shaded.update(body, {}, {}, 2));
  CHECK(area() == Approx(2.25 * n * n));
  CHECK(shaded.mesh().high == Eigen::Vector3d(60, 60, 0));
  // other colours, another look, other elements, points that are nowhere
  body.colour = {1, 0, 0};
  CHECK(shaded.update(body));
  CHECK(!shaded.update(body));
  CHECK(shaded.mesh().colours[7] == Eigen::Vector3f(1, 0, 0));
  CHECK(shaded.update(body, {}, {.wireframe = true}));
  CHECK(shaded.mesh().triangles.empty());
  body.quads.pop_back();
  body.points[0] = {1e300, std::nan(""), 0};
  CHECK(shaded.update(body, {}, {}, 2));
  CHECK(shaded.mesh().triangles.size() == 6 * n * n - 12);
}

TEST_CASE("files of pictures, and what cannot be pictured") {
  auto sim = block_at({0, 0, 0});
  sim.init();
  const auto path = std::filesystem::temp_directory_path() / "sinew_picture.png";
  view::Picture(sim, {.width = 64, .height = 48}).write(path.string());
  std::ifstream file(path, std::ios::binary);
  char head[24]{};
  file.read(head, sizeof head);
  CHECK(std::string_view(head, 8) == "\x89PNG\r\n\x1a\n");
  CHECK(head[19] == 64);
  CHECK(head[23] == 48);
  file.close();
  std::filesystem::remove(path);
  CHECK(error_of([&] { view::Picture(sim, {.width = 0, .height = 48}); }) ==
        "pictures: a picture of 0 x 48 pixels has none; width and height are at least 1");
  CHECK(error_of([&] { view::Picture(sim, {.width = 1000000, .height = 1}); }).find("larger than the") !=
        std::string::npos);
  CHECK(error_of([&] {
          view::Picture(sim, {.width = 8, .height = 8}).write("/no/such/folder/a.png");
        }).find("/no/such/folder/a.png") != std::string::npos);
  // nothing to see, and a point that is not finite
  view::Painter painter({.width = 8, .height = 8});
  view::SeenScene scene;
  CHECK(is_white(painter.paint(scene).at(4, 4)));
  scene.bodies.push_back({.points = {{0, 0, std::nan("")}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}});
  CHECK(is_white(painter.paint(scene).at(4, 4)));
}

TEST_CASE("a film has its pictures, or says what is missing") {
  const auto path = (std::filesystem::temp_directory_path() / "sinew_film.mp4").string();
  const Image image{4, 4, std::vector<unsigned char>(48, 100)};
  const std::string wrong = error_of([&] {
    view::Film film(path, 4, 4, 25);
    film.add(image);
    film.add(image);
    film.finish();
  });
  if (wrong.empty()) {
    CHECK(std::filesystem::file_size(path) > 100);
    std::filesystem::remove(path);
  } else {
    CHECK(wrong ==
          path +
              ": the program ffmpeg, which makes films, is not there; install it (Debian: ffmpeg), or "
              "write pictures");
  }
}

}  // namespace test_picture
