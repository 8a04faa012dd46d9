// SPDX-License-Identifier: BSL-1.0
// Scene files with textures and materials: what is read, seen, kept in checkpoints, and warned of.
#include "catch.hpp"
#include "io/files.hpp"

#include <sinew/engine/mesh_loader.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>
#include <sinew/runtime/save_scene.hpp>
#include <sinew/view/load_materials.hpp>
#include <sinew/view/seen_scene.hpp>
#include <sinew/view/view_settings.hpp>

#include <filesystem>

namespace test_textured_scenes {

using namespace sinew;
using Catch::Matchers::Contains;

using Few = Registry<Gravity, MechanicalObject<Vec3d>, UniformMass<Vec3d>, EulerExplicitSolver, VisualModel,
                     MeshOBJLoader>;

// a folder that goes with the test, with two triangles and a quad
struct Folder : files::TempFolder {
  Folder() {
    write(
        "a.obj",
        "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
        "vt 0.5 0.5\nf 1/1 2/2 3/3\nusemtl red\nf 1/5 3/3 4/4\nusemtl blue\nf 2/1 5/2 6/3 3/4\n");
    write("a.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
    const unsigned char pixel[] = {10, 20, 30};
    write("a.png", view::png_of("a.png", 1, 1, 3, pixel));
  }
  ReadScene<Few> read(std::string const& inside) const {
    return parse_scene<Few>(*this / "a.scn", "<Node name='root'>" + inside + "</Node>");
  }
};
struct Seen {
  view::SeenScene scene{};
  std::vector<std::string> warnings{};
};
template <class Simulation>
Seen seen(Simulation& simulation) {
  view::ViewSettings settings = view::view_settings_of(simulation);
  view::load_materials(simulation, settings.seen, settings.warnings);
  return {view::seen_scene(simulation, settings.seen), settings.warnings};
}

TEST_CASE("an OglModel has the looks of its file, by whatever way it takes it, and a checkpoint keeps them") {
  const Folder folder;
  auto check = [](auto& simulation) {
    const Seen all = seen(simulation);
    CHECK(all.warnings.empty());
    REQUIRE(all.scene.bodies.size() == 3);
    auto const &plain = all.scene.bodies[0], &red = all.scene.bodies[1], &blue = all.scene.bodies[2];
    CHECK(plain.colour == Eigen::Vector3d(1, 1, 1));
    CHECK(red.colour == Eigen::Vector3d(1, 0, 0));
    CHECK(blue.colour == Eigen::Vector3d(0, 0, 1));
    for (auto const& body : all.scene.bodies) {
      REQUIRE(body.texture);
      CHECK(body.texture->rgba == std::vector<unsigned char>{10, 20, 30, 255});
    }
    auto at = [](view::SeenBody const& body, Index t) { return body.inTexture.texcoords[std::size_t(t)]; };
    CHECK(at(plain, plain.inTexture.triangles[0][1]) == Eigen::Vector2d(1, 0));
    CHECK(at(red, red.inTexture.triangles[0][0]) == Eigen::Vector2d(0.5, 0.5));
    CHECK(at(blue, blue.inTexture.quads[0][2]) == Eigen::Vector2d(1, 1));
  };
  for (char const* visual :
       {"<OglModel filename='a.obj' texturename='a.png'/>",
        "<MeshOBJLoader name='l' filename='a.obj'/><OglModel src='@l' texturename='a.png'/>",
        "<MeshOBJLoader name='l' filename='a.obj' translation='1 0 0'/>"
        "<OglModel src='@l' texturename='a.png' texcoords='@l.texcoords'/>"}) {
    auto scene = folder.read(visual);
    CHECK(scene.warnings.empty());
    auto simulation = start(std::move(scene));
    check(simulation);
    // elsewhere
    auto again = start(parse_scene<Few>("/b.scn", scene_text(simulation, 0.01)));
    check(again);
  }
}

TEST_CASE(
    "a texture is repeated by scaleTex and shifted by translationTex, once, and a checkpoint keeps both") {
  const Folder folder;
  auto check = [](auto& simulation) {
    const Seen all = seen(simulation);
    CHECK(all.warnings.empty());
    auto const& plain = all.scene.bodies[0];
    auto at = [&](int corner) {
      return plain.inTexture.texcoords[std::size_t(plain.inTexture.triangles[0][std::size_t(corner)])];
    };
    CHECK(at(0) == Eigen::Vector2d(0.5, -1));
    CHECK(at(1) == Eigen::Vector2d(2 * 1 + 0.5, -1));
    CHECK(at(2) == Eigen::Vector2d(2 * 1 + 0.5, 3 * 1 - 1));
  };
  auto scene =
      folder.read("<OglModel filename='a.obj' texturename='a.png' scaleTex='2 3' translationTex='0.5 -1'/>");
  CHECK(scene.warnings.empty());
  CHECK(scene.ignored.empty());
  auto simulation = start(std::move(scene));
  check(simulation);
  simulation.animate(0.01);
  auto again = start(parse_scene<Few>("/b.scn", scene_text(simulation, 0.01)));
  check(again);
}

TEST_CASE("a loader turns, mirrors and triangulates looks with its faces") {
  const Folder folder;
  // the place in the texture of each corner, by the point there
  auto places = [&](std::string const& attributes) {
    auto simulation = start(
        folder.read("<MeshOBJLoader name='l' filename='a.obj' " + attributes + "/><OglModel src='@l'/>"));
    auto const& visual = *simulation.root().template get<VisualModel>();
    const SurfaceLooks looks = visual.looks();
    std::vector<std::pair<Index, Index>> all;  // point, texcoord
    std::vector<Index> materials;
    auto add = [&](auto const& faces, auto const& corners) {
      REQUIRE(faces.size() == corners.size());
      for (std::size_t f = 0; f < faces.size(); ++f)
        for (std::size_t k = 0; k < faces[f].size(); ++k) all.emplace_back(faces[f][k], corners[f][k]);
    };
    add(visual.mesh.triangles, looks.triangles);
    add(visual.mesh.quads, looks.quads);
    CHECK(looks.faceMaterials.size() == visual.mesh.triangles.size() + visual.mesh.quads.size());
    CHECK(std::count(looks.faceMaterials.begin(), looks.faceMaterials.end(), -1) == 1);
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  };
  const std::vector<std::pair<Index, Index>> expected = {
      {0, 0}, {0, 4}, {1, 0}, {1, 1}, {2, 2}, {2, 3}, {3, 3}, {4, 1}, {5, 2}};
  for (char const* attributes :
       {"", "flipNormals='1'", "scale3d='-1 1 1'", "scale3d='-1 1 1' flipNormals='1'", "triangulate='1'"})
    CHECK(places(attributes) == expected);
}

TEST_CASE("a scene that lacks its texture, or has one that does not fit, runs with a warning") {
  const Folder folder;
  auto warned = [&](std::string const& visual) {
    auto scene = folder.read(visual);
    std::vector<std::string> all = scene.warnings;
    auto simulation = start(std::move(scene));
    simulation.animate(0.01);
    const Seen now = seen(simulation);
    CHECK(now.scene.bodies.size() >= 1);
    all.insert(all.end(), now.warnings.begin(), now.warnings.end());
    REQUIRE(all.size() == 1);
    return all[0];
  };
  CHECK_THAT(warned("<OglModel filename='a.obj' texturename='none.png'/>"),
             Contains("a.scn:1:") && Contains("the texture none.png: ") && Contains("left out"));
  const std::string triangle = "<OglModel position='0 0 0 1 0 0 0 1 0' triangles='0 1 2' ";
  CHECK_THAT(
      warned(triangle + "texcoords='0 0 1 0'/>"),
      Contains("<OglModel>: texcoords and materials of its faces: texcoords has 2 entries for 3 vertices"));
  CHECK_THAT(warned(triangle + "texcoords='0 0 1 x'/>"),
             Contains("<OglModel>: texcoords: ") && Contains("'x'"));
  CHECK_THAT(warned(triangle + "texcoords='@nobody.texcoords'/>"), Contains("<OglModel>: texcoords: "));
  CHECK_THAT(warned(triangle + "texturename='a.png'/>"), Contains("/root has no texcoords for its texture"));
  folder.write("a.mtl", "newmtl\n");
  CHECK_THAT(warned("<OglModel filename='a.obj'/>"), Contains("a.mtl:1: expected the name of a material"));
  std::filesystem::remove(folder / "a.mtl");
  CHECK_THAT(warned("<OglModel filename='a.obj'/>"),
             Contains("the materials of its faces: ") && Contains("a.mtl"));
}

}  // namespace test_textured_scenes
