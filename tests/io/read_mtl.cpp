// SPDX-License-Identifier: BSL-1.0
#include <sinew/io/read_mtl.hpp>

#include "files.hpp"

namespace test_read_mtl {

using namespace sinew;
using files::check_says;
using io::Material;

namespace {

const std::string sample = R"(# two materials
newmtl skin
Ns 96.078431
Ka 1.000000 1.000000 1.000000
Kd 0.8 0.5 .25
Ks 0.5 0.5 0.5
Ke 0.0 0.0 0.0
Ni 1.450000
d 0.5
illum 2
map_Kd -o 0.1 0.2 0 -clamp on textures\red skin.png # an image
newmtl bone
Kd 0.9
Ks xyz 1 1 1
Tr 0.25
)";

std::string error_in(std::string_view content) {
  return error_of([&] { io::parse_mtl("m.mtl", content); });
}

}  // namespace

TEST_CASE("read_mtl reads colours, exponents, opacities and images") {
  const files::TempFolder folder;
  const std::string path = folder.write("m.mtl", sample);
  const std::vector<Material> all = io::read_mtl(path);
  REQUIRE(all.size() == 2);
  CHECK(all[0] == Material{.name = "skin",
                           .diffuse = {0.8, 0.5, 0.25},
                           .specular = {0.5, 0.5, 0.5},
                           .shininess = 96.078431,
                           .opacity = 0.5,
                           .texture = path.substr(0, path.rfind('/')) + "/textures/red skin.png"});
  CHECK(all[1] == Material{.name = "bone", .diffuse = {0.9, 0.9, 0.9}, .opacity = 0.75});
  CHECK(io::parse_mtl("m.mtl", "newmtl a\nmap_Kd b.png")[0].texture == "b.png");
  CHECK(io::parse_mtl("x/m.mtl", "newmtl a\nmap_Kd /b.png")[0].texture == "/b.png");
  CHECK(io::parse_mtl("m.mtl", "newmtl a\nKd 2 -1 0.5")[0].diffuse == Eigen::Vector3d(1, 0, 0.5));
}

TEST_CASE("read_mtl names the line of an error") {
  check_says(error_in("# none\nKd 1 1 1"), "m.mtl:2", "belongs to no material; write \"newmtl NAME\"");
  check_says(error_in("newmtl\n"), "m.mtl:1", "expected the name of a material");
  check_says(error_in("newmtl a\nKd red"), "m.mtl:2", "expected red, green and blue from 0 to 1");
  check_says(error_in("newmtl a\nKd 1 1\n"), "m.mtl:2", "expected red, green and blue");
  check_says(error_in("newmtl a\nKs 1 nan 1"), "m.mtl:2", "is not finite");
  check_says(error_in("newmtl a\nNs\n"), "m.mtl:2", "expected an exponent");
  check_says(error_in("newmtl a\nd 1.5"), "m.mtl:2", "an opacity is 1.5, but is from 0 to 1");
  check_says(error_in("newmtl a\nmap_Kd -s 1 1 1"), "m.mtl:2", "map_Kd names no image");
  check_says(error_in("newmtl a\n\x01"), "m.mtl:2", "not text");
  check_says(error_of([] { io::read_mtl("/no/such/m.mtl"); }), "/no/such/m.mtl", "");
}

TEST_CASE("a broken file MTL gives materials that can be shown, or an Error") {
  auto survives = [](std::string const& content) {
    try {
      for (Material const& m : io::parse_mtl("m.mtl", content)) {
        const Eigen::Array3d d = m.diffuse.array(), s = m.specular.array();
        if (!((d >= 0).all() && (d <= 1).all() && (s >= 0).all() && (s <= 1).all() && m.opacity >= 0 &&
              m.opacity <= 1 && m.shininess >= 0 && std::isfinite(m.shininess) && !m.name.empty()))
          return false;
      }
      return true;
    } catch (Error const& e) {
      return std::string_view(e.what()).starts_with("m.mtl:");
    }
  };
  for (std::size_t n = 0; n < sample.size(); ++n)
    if (!survives(sample.substr(0, n))) FAIL_CHECK(sample.substr(0, n));
  for (std::size_t bit = 0; bit < 8 * sample.size(); ++bit) {
    std::string content = sample;
    content[bit / 8] = char(content[bit / 8] ^ 1 << bit % 8);
    if (!survives(content)) FAIL_CHECK(content);
  }
}

}  // namespace test_read_mtl
