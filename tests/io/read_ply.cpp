// SPDX-License-Identifier: BSL-1.0
#include <sinew/io/read_ply.hpp>

#include "files.hpp"

#include <bit>
#include <cstdint>
#include <limits>
#include <string>

namespace test_read_ply {

using namespace sinew;
using files::check_says;
using files::replaced;

namespace {

const std::string ascii = R"(ply
format ascii 1.0
comment a tent
obj_info made by hand
element vertex 5
property float x
property uchar red
property double y
property float32 z
element face 3
property list uchar int vertex_indices
property float quality
element edge 1
property int vertex1
property int vertex2
element camera 1
property float64 view
property list uint8 short pixels
end_header
0 255 0 0
1 255 0 0
1 0 1 0
0 0 1 0
0.25 7 5e-1 -1.5
3 0 2 1 nan
4 0 1 2 3 1
5 0 1 2 3 4 1
3 4
0.5 2 -3 4
)";

/// The same file as binary data.
std::string binary(bool big) {
  std::string bytes = ascii.substr(0, ascii.find("end_header\n") + 11);
  bytes.replace(bytes.find("ascii"), 5, big ? "binary_big_endian" : "binary_little_endian");
  auto add = [&](auto value) {
    char raw[sizeof(value)];
    std::memcpy(raw, &value, sizeof(value));
    if (big == (std::endian::native == std::endian::little)) std::reverse(raw, raw + sizeof(value));
    bytes.append(raw, sizeof(value));
  };
  auto list = [&](std::initializer_list<std::int32_t> corners) {
    add(std::uint8_t(corners.size()));
    for (const std::int32_t c : corners) add(c);
    add(std::numeric_limits<float>::quiet_NaN());
  };
  const double points[5][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.25, 0.5, -1.5}};
  for (auto const& p : points) add(float(p[0])), add(std::uint8_t(200)), add(p[1]), add(float(p[2]));
  list({0, 2, 1});
  list({0, 1, 2, 3});
  list({0, 1, 2, 3, 4});
  add(std::int32_t(3)), add(std::int32_t(4));
  add(0.5), add(std::uint8_t(2)), add(std::int16_t(-3)), add(std::int16_t(4));
  return bytes;
}
std::string error_in(std::string_view content) {
  return error_of([&] { io::parse_ply("f.ply", content); });
}

}  // namespace

TEST_CASE("read_ply reads ASCII files and binary ones of both byte orders") {
  const files::TempFolder folder;
  std::string windows;
  for (const char c : ascii) windows += c == '\n' ? "\r\n" : std::string(1, c);
  for (const std::string& content : {ascii, binary(false), binary(true), windows}) {
    const Mesh mesh = io::read_ply(folder.write("a.ply", content));
    CHECK(mesh.positions ==
          std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.25, 0.5, -1.5}});
    CHECK(mesh.triangles == std::vector<Triangle>{{0, 2, 1}, {0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
    CHECK(mesh.quads == std::vector<Quad>{{0, 1, 2, 3}});
    CHECK(mesh.edges == std::vector<Edge>{{3, 4}});
  }
}

TEST_CASE("read_ply turns strips into triangles that look to one side") {
  const Mesh mesh = io::parse_ply("f", R"(ply
format ascii 1.0
element vertex 5
property float x
property float y
property float z
element tristrips 1
property list int int vertex_indices
end_header
0 0 0
1 0 0
0 1 0
1 1 0
0 2 0
9 0 1 2 3 4 -1 2 1 0
)");
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {2, 1, 0}});
}

TEST_CASE("read_ply names the place of an error") {
  check_says(error_in(""), "f.ply:1", "does not begin with a line \"ply\"");
  check_says(error_in("ply\nformat ascii 1.0\n"), "f.ply:2", "no end_header");
  check_says(error_in(replaced(ascii, "ascii 1.0", "ascii 2.0")), "f.ply:2", "1.0, the version");
  check_says(error_in(replaced(ascii, "ascii 1.0", "text 1.0")), "f.ply:2", "binary_big_endian");
  check_says(error_in(replaced(ascii, "format ascii 1.0\n", "")), "f.ply", "no format");
  check_says(error_in(replaced(ascii, "comment a tent", "remark")), "f.ply:3", "expected format, element");
  check_says(error_in(replaced(ascii, "vertex 5", "vertex -5")), "f.ply:5", "-5 items");
  check_says(error_in(replaced(ascii, "vertex 5", "vertex 5000000000")), "f.ply:5", "5000000000 items");
  check_says(error_in(replaced(ascii, "vertex 5", "vertex five")), "f.ply:5", "the number of items");
  check_says(error_in(replaced(ascii, "vertex 5", "vertex 5 6")), "f.ply:5", "the end of the line");
  check_says(error_in(replaced(ascii, "property float x", "property real x")), "f.ply:6", "a type");
  check_says(error_in(replaced(ascii, "property float x", "property float t")), "f.ply:5", "no property x");
  check_says(
      error_in(replaced(ascii, "list uchar int vertex", "list float int vertex")), "f.ply:11", "real type");
  check_says(error_in(replaced(ascii, "vertex_indices", "corners")), "f.ply:10", "no list vertex_indices");
  check_says(error_in(replaced(ascii, "vertex1", "from")), "f.ply:13", "vertex1 and vertex2");
  check_says(
      error_in(replaced(ascii, "1 0 1 0\n", "1 0 one 0\n")), "f.ply:22", "property y of element vertex");
  check_says(error_in(replaced(ascii, "1 0 1 0\n", "1 0 inf 0\n")),
             "f.ply:22",
             "point 2 has a coordinate that is not a finite number");
  check_says(
      error_in(replaced(ascii, "4 0 1 2 3 1", "4 0 1 2 9 1")), "f.ply:26", "point 9 is not among the 5");
  check_says(error_in(replaced(ascii, "4 0 1 2 3 1", "400000 0 1 2 3 1")), "f.ply:26", "400000 entries");
  check_says(error_in(replaced(ascii, "0.5 2 -3 4", "0.5 2 -3")),
             "f.ply:30",
             "the data end where an entry of pixels");
  check_says(error_in(ascii + "7\n"), "f.ply:30", "more follows");
  check_says(
      error_in(replaced(ascii, "0 255 0 0", std::string("0 255 0 0\1", 10))), "f.ply:20", "the byte 1");
  check_says(
      error_in(
          "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 1\n"
          "property float x\nproperty float y\nproperty float z\nend_header\n3 0 0 0\n0 0 0\n"),
      "f.ply:3",
      "put the points first");
}

TEST_CASE("read_ply names the byte of an error in binary data") {
  const std::string whole = binary(false);
  const std::size_t data = whole.find("end_header\n") + 11;
  check_says(
      error_in(whole.substr(0, whole.size() - 1)),
      "f.ply",
      text("byte ", whole.size() - 4, ": the list pixels of element camera is given 2 entries, but 3 bytes"));
  check_says(error_in(whole + '\0'), "f.ply", text("byte ", whole.size(), ": more follows"));
  std::string bad = whole;
  for (std::size_t k = 0; k < 4; ++k) bad[data + 17 + k] = char(0xff);  // x of the second point
  check_says(error_in(bad), "f.ply", text("byte ", data + 34, ": point 1 has a coordinate"));
  bad = whole;
  bad[data + 85 + 1] = 77;  // the first corner of the first face
  check_says(error_in(bad), "f.ply", "point 77 is not among the 5");
  for (std::size_t size = 0; size < whole.size(); ++size) CHECK(!error_in(whole.substr(0, size)).empty());
}

}  // namespace test_read_ply
