// SPDX-License-Identifier: BSL-1.0
// Textures and materials, from files to pixels.
#include "catch.hpp"
#include "error_of.hpp"
#include "io/files.hpp"

#include <sinew/mechanics.hpp>
#include <sinew/view/gltf.hpp>
#include <sinew/view/load_materials.hpp>
#include <sinew/view/picture.hpp>

#include <filesystem>
#include <limits>

namespace test_textures {

using namespace sinew;
using Catch::Matchers::Contains;
using view::Image;
using view::SeenTexture;
using Pixel = std::array<unsigned char, 3>;

using Folder = files::TempFolder;

// 2 x 2 texels: red, green; blue, grey
const std::vector<unsigned char> four{255, 0, 0, 0, 255, 0, 0, 0, 255, 100, 100, 100};
std::string png() { return view::png_of("four.png", 2, 2, 3, four.data()); }

// light from all sides alone: a surface has its own colour
view::SeenSettings even() {
  view::SeenSettings seen;
  seen.lights = {{.colour = {0, 0, 0}}};
  seen.ambient = Eigen::Vector3d(1, 1, 1);
  return seen;
}
// from the front, so that the square from 0 to 1 fills the picture
view::Camera front() {
  view::Camera camera;
  camera.target = {0.5, 0.5, 0};
  camera.angle = 90;
  camera.distance = 0.5;
  return camera;
}
Image pictured(view::SeenScene const& scene) {
  return view::Painter({.width = 200, .height = 200, .camera = front(), .seen = {}}).paint(scene);
}
bool near(Pixel const& a, Pixel const& b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (std::abs(int(a[k]) - int(b[k])) > 2) return false;  // rounded twice
  return true;
}

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

auto shown(io::ObjFile const& file) {
  VisualModel visual{.mesh = file.mesh};
  visual.setLooks(file.looks);
  return Simulation{node<"root">(std::move(visual))};
}

TEST_CASE("the pixels of a square are the texels of its texture, as it stands or turned") {
  const Folder folder;
  auto scene = [&](std::string const& face, std::string const& image) {
    auto sim = shown(io::parse_obj_file("f.obj", square + face));
    sim.init();
    view::SeenSettings seen = even();
    seen.looks = {{.path = "/root", .image = image}};
    std::vector<std::string> warnings;
    view::load_materials(sim, seen, warnings);
    CHECK(warnings.empty());
    return view::seen_scene(sim, seen);
  };
  const std::string image = folder.write("four.png", png());
  // the middle of each texel, where its neighbours have no part in what is between them
  auto corner = [](Image const& of, int x, int y) { return of.at(x ? 150 : 49, y ? 150 : 49); };
  const Pixel red{255, 0, 0}, green{0, 255, 0}, blue{0, 0, 255}, grey{100, 100, 100};
  for (char const* face : {"f 1/1 2/2 3/3 4/4", "f 1/1 2/2 3/3\nf 1/1 3/3 4/4"}) {
    const Image straight = pictured(scene(face, image));
    CHECK(near(corner(straight, 0, 0), red));
    CHECK(near(corner(straight, 1, 0), green));
    CHECK(near(corner(straight, 0, 1), blue));
    CHECK(near(corner(straight, 1, 1), grey));
    // between two texels it is half of each in what files hold
    CHECK(near(straight.at(100, 49), {127, 127, 0}));
  }
  const Image turned = pictured(scene("f 1/2 2/3 3/4 4/1", image));
  CHECK(near(corner(turned, 0, 1), grey));
  CHECK(near(corner(turned, 1, 1), green));
  CHECK(near(corner(turned, 1, 0), red));
  CHECK(near(corner(turned, 0, 0), blue));
  // the lower half from the left half of the texture, the upper one from its right half
  // both halves turned by a quarter, the upper one upside down: its corners are elsewhere at the same points
  const Image sewn = pictured(
      scene("v 0 0.5 0\nv 1 0.5 0\nvt 0.5 0\nvt 0.5 1\nf 1/4 2/1 6/5 5/6\nf 5/3 6/2 3/5 4/6", image));
  CHECK(near(corner(sewn, 1, 1), blue));
  CHECK(near(corner(sewn, 0, 1), red));
  CHECK(near(corner(sewn, 1, 0), grey));
  CHECK(near(corner(sewn, 0, 0), green));
}

TEST_CASE("faces have the colours and textures of their materials, and a look comes before them") {
  const Folder folder;
  folder.write("four.png", png());
  folder.write("m.mtl",
               "newmtl grey\nKd 0.5 0.5 0.5\nKs 0 0 0\nnewmtl image\nKd 1 1 1\nmap_Kd -s 1 1 1 four.png\n"
               "newmtl glass\nKd 0 1 0\nd 0.25\n");
  const std::string file = folder.write("f.obj",
                                        "mtllib m.mtl\n" + square +
                                            "usemtl image\nf 1/1 2/2 3/3\nusemtl grey\nf 1/1 3/3 4/4\n"
                                            "v 2 0 0\nv 2 1 0\nusemtl glass\nf 2 5 6 3\n");
  auto sim = shown(io::read_obj_file(file));
  sim.init();
  view::SeenSettings seen = even();
  std::vector<std::string> warnings;
  view::load_materials(sim, seen, warnings);
  CHECK(warnings.empty());
  REQUIRE(seen.materials.size() == 3);
  view::SeenScene scene = view::seen_scene(sim, seen);
  REQUIRE(scene.bodies.size() == 3);
  CHECK(scene.bodies[0].colour == Eigen::Vector3d(0.5, 0.5, 0.5));
  CHECK(scene.bodies[0].triangles == std::vector<Triangle>{{0, 1, 2}});
  CHECK_FALSE(scene.bodies[0].texture);
  REQUIRE(scene.bodies[1].texture);
  CHECK(scene.bodies[1].texture->width == 2);
  CHECK(scene.bodies[1].inTexture.triangles == std::vector<Triangle>{{0, 1, 2}});
  CHECK(scene.bodies[2].opacity == 0.25);
  CHECK(scene.bodies[2].quads == std::vector<Quad>{{0, 1, 2, 3}});
  CHECK(scene.bodies[2].points[1] == Eigen::Vector3d(2, 0, 0));
  const Image image = pictured(scene);
  CHECK(near(image.at(20, 60), {127, 127, 127}));    // above the diagonal
  CHECK(near(image.at(150, 150), {100, 100, 100}));  // below it
  seen.looks = {{.path = "/root", .colour = Eigen::Vector3d(1, 0, 0)}};
  CHECK(near(pictured(view::seen_scene(sim, seen)).at(20, 60), {255, 0, 0}));
  // without what the library has, it is one body
  seen.materials.clear();
  CHECK(view::seen_scene(sim, seen).bodies.size() == 1);
}

TEST_CASE("what mirrors more is brighter where it mirrors the light, and as much as before beside it") {
  auto brightness = [](double specular, double shininess, int x) {
    view::SeenBody body{.path = "/root",
                        .kind = view::SeenBody::Kind::visual,
                        .points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                        .quads = {{0, 1, 2, 3}},
                        .colour = {0.3, 0.3, 0.3}};
    body.specular.setConstant(specular);
    body.shininess = shininess;
    view::SeenScene scene;
    scene.bodies.push_back(body);
    scene.settings = even();
    scene.settings.ambient = Eigen::Vector3d(0, 0, 0);
    scene.settings.shadows = false;
    scene.settings.lights = {{.direction = {0, 0, 1}}};
    return std::pow(pictured(scene).at(x, 100)[0] / 255., 2.2);
  };
  // 0.75 of the colour, and what is mirrored: s n(h)^e, h halfway between the light and the eye
  const double own = 0.75 * std::pow(0.3, 2.2);
  for (const double e : {10., 100.}) {
    CHECK(brightness(0.5, e, 100) - own == Approx(0.5).margin(0.01));
    const Eigen::Vector3d toEye = Eigen::Vector3d(-(150.5 / 100 - 1), 0, 1).normalized();
    const double n = (toEye + Eigen::Vector3d(0, 0, 1)).normalized().z();
    CHECK(brightness(0.5, e, 150) - own == Approx(0.5 * std::pow(n, e)).margin(0.01));
  }
  CHECK(brightness(0, 10, 100) == Approx(own).margin(0.005));
  // that without a material
  CHECK(brightness(0.12, 40, 100) - own == Approx(0.12).margin(0.01));
}

TEST_CASE("what is missing or wrong of looks is a warning, and the rest is seen") {
  const Folder folder;
  auto warnings_of = [&](std::string const& obj, std::string const& image = "") {
    auto sim = shown(io::read_obj_file(folder.write("f.obj", obj)));
    sim.init();
    view::SeenSettings seen = even();
    if (!image.empty()) seen.looks = {{.path = "/root", .image = image, .origin = "a.scn:3:5"}};
    std::vector<std::string> warnings;
    view::load_materials(sim, seen, warnings);
    CHECK(view::seen_scene(sim, seen).bodies.size() == 1);
    CHECK(warnings.size() == 1);
    return warnings.empty() ? std::string() : warnings[0];
  };
  const std::string face = square + "usemtl skin\nf 1/1 2/2 3/3 4/4\n";
  CHECK_THAT(warnings_of("mtllib none.mtl\n" + face),
             Contains("/root: the materials of its faces: ") && Contains("none.mtl") && Contains("left out"));
  folder.write("other.mtl", "newmtl bone\n");
  CHECK(warnings_of("mtllib other.mtl\n" + face) ==
        "/root: " + (folder / "other.mtl") + " has no material 'skin' for its faces; add it there");
  folder.write("bad.mtl", "newmtl skin\nKd red\n");
  CHECK_THAT(warnings_of("mtllib bad.mtl\n" + face), Contains("bad.mtl:2: expected red, green and blue"));
  folder.write("lost.mtl", "newmtl skin\nmap_Kd lost.png\n");
  CHECK_THAT(warnings_of("mtllib lost.mtl\n" + face),
             Contains("/root: skin: the texture ") && Contains("lost.png"));
  CHECK_THAT(warnings_of(square + "f 1/1 2/2 3/3", "lost.png"),
             Contains("a.scn:3:5: the texture lost.png") && Contains("left out"));
  for (std::string const& bytes : {std::string("no image"), png().substr(0, 60), std::string("BM\0\0", 4)}) {
    const std::string broken = folder.write("broken.png", bytes);
    CHECK(warnings_of(square + "f 1/1 2/2 3/3", broken) ==
          "a.scn:3:5: the texture " + broken +
              ": it is no image that can be read; save it as PNG or JPEG; it is left out");
  }
  CHECK_THAT(warnings_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3", folder.write("four.png", png())),
             Contains("a.scn:3:5: /root has no texcoords for its texture"));
  // files elsewhere than in the folders of a scene are not read
  const std::filesystem::path place(folder / "");
  folder.write("m.mtl",
               text("newmtl skin\nmap_Kd ../", place.parent_path().filename().string(), "/four.png\n"));
  auto sim = shown(io::read_obj_file(folder.write("f.obj", "mtllib m.mtl\n" + face)));
  sim.init();
  for (std::string const& allowed :
       {place.parent_path().string(), place.string(), folder / "below", folder / "f"}) {
    view::SeenSettings seen = even();
    std::vector<std::string> warnings;
    view::load_materials(sim, seen, warnings, {allowed});
    const bool inside = allowed != folder / "below" && allowed != folder / "f";
    CHECK(warnings.size() == (inside ? 0 : 1));
    CHECK(seen.materials.size() == (inside ? 1 : 0));
    if (inside)
      CHECK(bool(seen.materials.at(0).texture));
    else
      CHECK_THAT(warnings.at(0), Contains("this file is elsewhere than those of the scene"));
  }
  // images of other kinds become PNG
  const std::string bmp(
      "BM\x3a\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\1\0\0\0\1\0\0\0\1\0\x18\0\0\0\0\0\4\0\0\0"
      "\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x10\x20\x30\0",
      58);
  const SeenTexture one = view::parse_texture("a.bmp", bmp);
  CHECK(one.rgba == std::vector<unsigned char>{0x30, 0x20, 0x10, 255});
  CHECK(one.file.starts_with("\x89PNG"));
  CHECK(view::parse_texture("b.png", one.file).rgba == one.rgba);
  std::string large = view::png_of("l", 1, 1, 3, four.data());
  large.replace(16, 4, std::string("\0\1\0\0", 4));
  CHECK_THAT(error_of([&] { view::parse_texture("l.png", large); }), Contains("65536 x 1 pixels"));
}

TEST_CASE("vertices and faces that go take their looks along") {
  VisualModel visual{.mesh = {.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}},
                              .triangles = {{0, 1, 2}, {1, 4, 2}, {0, 2, 3}},
                              .quads = {{0, 1, 2, 3}}}};
  visual.texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  visual.textureTriangles = {{0, 1, 2}, {3, 3, -1}, {0, 2, 3}};
  visual.textureQuads = {{3, 2, 1, 0}};
  visual.materialNames = "a b c";
  visual.faceMaterials = {0, 1, 2, 1};
  visual.init("here");
  visual.follow(Renumbering::of({true, true, true, true, false}));
  CHECK(visual.textureTriangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  CHECK(visual.faceMaterials == std::vector<Index>{0, 2, 1});
  visual.follow(Renumbering::of({true, false, true, true}));
  CHECK(visual.mesh.triangles == std::vector<Triangle>{{0, 1, 2}});
  CHECK(visual.textureTriangles == std::vector<Triangle>{{0, 2, 3}});
  CHECK(visual.textureQuads.empty());
  CHECK(visual.faceMaterials == std::vector<Index>{2});
  // faces that are laid bare have none
  const auto before = visual.mesh.triangles;
  visual.mesh.triangles = {{2, 1, 0}, {0, 1, 2}};
  visual.facesWere(before, {});
  CHECK(visual.textureTriangles == std::vector<Triangle>{{-1, -1, -1}, {0, 2, 3}});
  CHECK(visual.faceMaterials == std::vector<Index>{-1, 2});
  CHECK(visual.wrongLooks().empty());
  // texcoords of vertices
  VisualModel simple{.mesh = {.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                              .triangles = {{0, 1, 2}, {0, 2, 3}}},
                     .texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  simple.init("here");
  simple.follow(Renumbering::of({true, false, true, true}));
  simple.init("here");  // as whatever is touched
  CHECK(simple.looks().texcoords == std::vector<Eigen::Vector2d>{{0, 0}, {1, 1}, {0, 1}});
  CHECK(simple.looks().triangles == std::vector<Triangle>{{0, 1, 2}});
  auto wrong = [](VisualModel model) { return error_of([&] { model.init("here"); }); };
  VisualModel few = simple, none = simple, material = simple;
  few.texcoords.pop_back();
  CHECK(
      wrong(few) ==
      "here: VisualModel: texcoords has 2 entries for 3 vertices; give one for each, or textureTriangles and "
      "textureQuads");
  none.textureTriangles = {{0, 1, 3}};
  CHECK(wrong(none) ==
        "here: VisualModel: textureTriangles has the number 3, and there are 3 texcoords, numbered "
        "from 0; correct it, or give -1 for none");
  material.faceMaterials = {0};
  VisualModel scaled = simple, shifted = simple;
  scaled.scaleTex[1] = std::numeric_limits<double>::infinity();
  shifted.translationTex[0] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(wrong(scaled), Contains("scaleTex has a number that is not finite"));
  CHECK_THAT(wrong(shifted), Contains("translationTex has a number that is not finite"));
  CHECK_THAT(wrong(material), Contains("faceMaterials has the number 0, and there are 0 materialNames"));
}

TEST_CASE("a file glTF has textures, and the corners that are at several places in them") {
  const Folder folder;
  auto sim = shown(io::parse_obj_file("f.obj", square + "vt 0.5 0.5\nf 1/1 2/2 3/3\nf 1/5 3/3 4/4"));
  sim.init();
  view::SeenSettings seen = even();
  seen.looks = {{.path = "/root", .image = folder.write("four.png", png())}};
  std::vector<std::string> warnings;
  view::load_materials(sim, seen, warnings);
  view::GltfFile file(folder / "a.glb");
  file.add(view::seen_scene(sim, seen));
  file.finish();
  const std::string bytes = io::read_file(file.path());
  CHECK_THAT(bytes,
             Contains("\"baseColorTexture\":{\"index\":0}") && Contains("\"TEXCOORD_0\":1") &&
                 Contains("\"textures\":[{\"source\":0}]") &&
                 Contains("\"images\":[{\"mimeType\":\"image/png\",\"bufferView\":3}]"));
  CHECK_THAT(bytes, Contains("\"count\":5,\"type\":\"VEC3\"") && Contains("\"count\":5,\"type\":\"VEC2\""));
  CHECK(bytes.find(png()) != bytes.npos);
  // the first corner, from the upper left
  const float first[] = {0, 1, 1, 1, 1, 0};
  CHECK(bytes.find(std::string(reinterpret_cast<char const*>(first), sizeof first)) != bytes.npos);
}

}  // namespace test_textures
