// SPDX-License-Identifier: BSL-1.0
#include <sinew/io/read_vtu.hpp>
#include <sinew/io/write_vtu.hpp>

#include "files.hpp"
#include "samples.hpp"

namespace test_write_vtu {

using namespace sinew;
using files::check_says;

namespace {

bool same_bits(std::vector<double> const& a, std::vector<double> const& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}
std::vector<double> flat(Mesh const& mesh) {
  std::vector<double> x;
  for (auto const& p : mesh.positions) x.insert(x.end(), p.begin(), p.end());
  return x;
}

}  // namespace

TEST_CASE("write_vtu writes what read_vtu reads, bit by bit") {
  const files::TempFolder folder;
  Mesh mesh = samples::mesh();
  mesh.positions[0] = {-0.0, 5e-324, 1.0 / 3};
  mesh.positions[1] = {1.7976931348623157e308, -2.2250738585072014e-308, 0.1};
  mesh.positions.insert(mesh.positions.end(), {{2, 0, 0}, {3, 0, 0}, {2, 1, 0}});
  mesh.hexahedra = {{0, 1, 2, 3, 4, 5, 6, 7}, {7, 6, 5, 4, 3, 2, 1, 0}};
  mesh.pyramids = {{0, 3, 2, 4, 5}};
  mesh.triangles.push_back({7, 5, 6});
  io::write_vtu(folder / "a.vtu", mesh);
  const Mesh back = io::read_vtu(folder / "a.vtu");
  CHECK(back == mesh);
  CHECK(same_bits(flat(back), flat(mesh)));
  // a second time gives the same file
  const std::string bytes = io::read_file(folder / "a.vtu");
  io::write_vtu(folder / "a.vtu", back);
  CHECK(io::read_file(folder / "a.vtu") == bytes);
  CHECK(folder.count() == 1);
}

TEST_CASE("write_vtu writes prisms as VTK has them, and read_vtu turns them back") {
  const files::TempFolder folder;
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  mesh.prisms = {{0, 1, 2, 3, 4, 5}};
  io::write_vtu(folder / "a.vtu", mesh);
  CHECK(io::read_vtu(folder / "a.vtu") == mesh);
}

TEST_CASE("write_vtu writes elements of second order as read_vtu and read_vtk read them") {
  const files::TempFolder folder;
  Mesh mesh;
  for (int i = 0; i < 27; ++i) mesh.positions.emplace_back(i, i * i, -i);
  auto number = [](auto& e) {
    for (std::size_t k = 0; k < e.size(); ++k) e[k] = Index(k);
  };
  number(mesh.quadraticTetrahedra.emplace_back());
  number(mesh.quadraticHexahedra.emplace_back());
  number(mesh.triquadraticHexahedra.emplace_back());
  io::write_vtu(folder / "a.vtu", mesh);
  CHECK(io::read_vtu(folder / "a.vtu") == mesh);
}

TEST_CASE("write_vtu writes data at points, bit by bit") {
  const files::TempFolder folder;
  const Mesh mesh = samples::mesh();
  const io::PointData data{{"speed", 1, {1, -0.0, 1.0 / 3, 5e-324, std::numeric_limits<double>::quiet_NaN()}},
                           {"a \"<&>\" name", 2, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}}};
  io::write_vtu(folder / "a.vtu", mesh, data);
  const std::string content = io::read_file(folder / "a.vtu");
  io::VtkXml file("a.vtu", content, "UnstructuredGrid");
  auto array = file.root().child("UnstructuredGrid").child("Piece").child("PointData").child("DataArray");
  for (io::PointArray const& expected : data) {
    CHECK(array.attribute("Name").value() == expected.name);
    CHECK(array.attribute("NumberOfComponents").as_int() == expected.components);
    CHECK(same_bits(file.values<double>(array, 5, std::size_t(expected.components)), expected.values));
    array = array.next_sibling();
  }
  CHECK_FALSE(array);
  CHECK(io::read_vtu(folder / "a.vtu") == mesh);
}

TEST_CASE("write_vtu gives a mesh without elements vertices to see") {
  const files::TempFolder folder;
  Mesh cloud;
  cloud.positions = {{0, 0, 0}, {1, 2, 3}};
  io::write_vtu(folder / "a.vtu", cloud);
  CHECK(io::read_vtu(folder / "a.vtu") == cloud);
  const std::string content = io::read_file(folder / "a.vtu");
  io::VtkXml file("a.vtu", content, "UnstructuredGrid");
  const auto cells = file.root().child("UnstructuredGrid").child("Piece").child("Cells");
  CHECK(file.values<std::int64_t>(cells.find_child_by_attribute("Name", "connectivity")) ==
        std::vector<std::int64_t>{0, 1});
  CHECK(file.values<std::int64_t>(cells.find_child_by_attribute("Name", "offsets")) ==
        std::vector<std::int64_t>{1, 2});
  CHECK(file.values<std::int64_t>(cells.find_child_by_attribute("Name", "types")) ==
        std::vector<std::int64_t>{1, 1});
}

TEST_CASE("write_vtu encodes as a hand does") {
  const files::TempFolder folder;
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 1}};
  mesh.edges = {{0, 1}};
  io::write_vtu(folder / "a.vtu", mesh);
  const std::string content = io::read_file(folder / "a.vtu");
  // types: 8 bytes that say 1, and the byte 3
  const std::string order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
  CHECK(content.find("byte_order=\"" + order + "\" header_type=\"UInt64\"") != content.npos);
  if (order == "LittleEndian") CHECK(content.find(">AQAAAAAAAAAD</DataArray>") != content.npos);
}

TEST_CASE("write_vtu writes nothing that is wrong") {
  const files::TempFolder folder;
  const std::string file = folder / "a.vtu";
  Mesh mesh = samples::mesh();
  auto error = [&](io::PointData const& data) { return error_of([&] { io::write_vtu(file, mesh, data); }); };
  check_says(error({{"u", 3, std::vector<double>(14)}}), file, "\"u\" has 14 values, but 5 points with 3");
  check_says(error({{"u", 0, {}}}), file, "0 components");
  check_says(error({{"", 1, std::vector<double>(5)}}), file, "array 0 has no name");
  check_says(error({{"a\nb", 1, std::vector<double>(5)}}), file, "unprintable byte 10");
  check_says(
      error({{"u", 1, std::vector<double>(5)}, {"u", 1, std::vector<double>(5)}}), file, "named \"u\"");
  mesh.positions[3].y() = std::numeric_limits<double>::infinity();
  check_says(error({}), file, "point 3 has a coordinate that is not a finite number");
  mesh = samples::mesh();
  const std::string missing = folder / "none/a.vtu";
  check_says(error_of([&] { io::write_vtu(missing, mesh); }), missing, "create it first");
  CHECK(folder.count() == 0);
}

}  // namespace test_write_vtu
