// SPDX-License-Identifier: BSL-1.0
#include <sinew/io/pvd_series.hpp>
#include <sinew/io/read_vtu.hpp>

#include "files.hpp"
#include "samples.hpp"

namespace test_pvd_series {

using namespace sinew;
using files::check_says;

namespace {

// times and files of a .pvd file
std::vector<std::pair<double, std::string>> listed(std::string const& path) {
  pugi::xml_document document;
  REQUIRE(document.load_file(path.c_str()));
  CHECK(document.child("VTKFile").attribute("type").value() == std::string("Collection"));
  std::vector<std::pair<double, std::string>> list;
  for (auto const set : document.child("VTKFile").child("Collection").children("DataSet"))
    list.emplace_back(set.attribute("timestep").as_double(), set.attribute("file").value());
  return list;
}

}  // namespace

TEST_CASE("PvdSeries is complete after each call") {
  const files::TempFolder folder;
  io::PvdSeries series(folder / "out/deep/liver & co");
  CHECK(std::filesystem::is_directory(folder / "out/deep"));
  CHECK(series.path() == folder / "out/deep/liver & co.pvd");
  CHECK(series.size() == 0);
  std::vector<std::pair<double, std::string>> expected;
  Mesh mesh = samples::mesh();
  for (int i = 0; i < 3; ++i) {
    mesh.positions[0].x() = 0.1 * i;
    series.add(0.02 * i, mesh, {{"index", 1, {0, 1, 2, 3, 4}}});
    expected.emplace_back(0.02 * i, "liver & co_000" + std::to_string(i) + ".vtu");
    CHECK(listed(series.path()) == expected);
    CHECK(series.size() == expected.size());
    CHECK(io::read_vtu(folder / "out/deep/" + expected.back().second) == mesh);
  }
}

TEST_CASE("pieces of several processes are named by one file") {
  const files::TempFolder folder;
  const Mesh mesh = samples::mesh();
  io::PvdSeries first(folder / "a"), second(folder / "a");
  for (int step = 0; step < 2; ++step) {
    second.addPiece(0.5 * step, mesh, {{"rank", 1, {1, 1, 1, 1, 1}}}, {1, 2});
    first.addPiece(0.5 * step, mesh, {{"rank", 1, {0, 0, 0, 0, 0}}}, {0, 2});
  }
  CHECK(listed(first.path()) ==
        std::vector<std::pair<double, std::string>>{{0, "a_0000.pvtu"}, {0.5, "a_0001.pvtu"}});
  CHECK(folder.count() == 7);  // a file for each piece, one that names them, twice, and the list
  pugi::xml_document document;
  REQUIRE(document.load_file((folder / "a_0001.pvtu").c_str()));
  CHECK(document.child("VTKFile").attribute("type").value() == std::string("PUnstructuredGrid"));
  const auto grid = document.child("VTKFile").child("PUnstructuredGrid");
  CHECK(grid.child("PPointData").child("PDataArray").attribute("Name").value() == std::string("rank"));
  CHECK(grid.child("PPoints").child("PDataArray").attribute("NumberOfComponents").as_int() == 3);
  std::vector<std::string> pieces;
  for (auto const piece : grid.children("Piece")) pieces.push_back(piece.attribute("Source").value());
  CHECK(pieces == std::vector<std::string>{"a_0001_0.vtu", "a_0001_1.vtu"});
  for (auto const& piece : pieces) CHECK(io::read_vtu(folder / piece) == mesh);
  check_says(error_of([&] {
               first.addPiece(std::numeric_limits<double>::infinity(), mesh, {}, {0, 2});
             }),
             first.path(),
             "time inf");
  CHECK(first.size() == 2);
  // a piece that has points of elements of others, and none of its own
  Mesh points;
  points.positions = mesh.positions;
  io::PvdSeries none(folder / "b");
  none.addPiece(0, points, {}, {0, 1, false});
  CHECK(io::read_file(folder / "b_0000_0.vtu").find("NumberOfCells=\"0\"") != std::string::npos);
}

TEST_CASE("PvdSeries stays as it was when a state cannot be added") {
  const files::TempFolder folder;
  io::PvdSeries series(folder / "a.pvd");
  CHECK(series.path() == folder / "a.pvd");
  Mesh mesh = samples::mesh();
  series.add(0, mesh);
  check_says(error_of([&] { series.add(std::numeric_limits<double>::quiet_NaN(), mesh); }),
             series.path(),
             "time nan");
  mesh.positions[2].z() = std::numeric_limits<double>::infinity();
  check_says(error_of([&] { series.add(1, mesh); }), folder / "a_0001.vtu", "point 2");
  CHECK(series.size() == 1);
  CHECK(folder.count() == 2);
  series.add(2, samples::mesh());
  CHECK(listed(series.path()) ==
        std::vector<std::pair<double, std::string>>{{0, "a_0000.vtu"}, {2, "a_0001.vtu"}});
}

TEST_CASE("PvdSeries needs a name and a folder") {
  const files::TempFolder folder;
  check_says(error_of([&] { io::PvdSeries(folder / ""); }), folder / "", "names no file");
  CHECK(error_of([] { io::PvdSeries(""); }).find("names no file") != std::string::npos);
  const std::string file = folder.write("file", "x");
  check_says(error_of([&] { io::PvdSeries(file + "/liver"); }), file, "cannot be created as a folder");
}

}  // namespace test_pvd_series
