// SPDX-License-Identifier: BSL-1.0
#include <sinew/io/read_gmsh.hpp>

#include "files.hpp"
#include "samples.hpp"

namespace test_read_gmsh {

using namespace sinew;
using files::check_says;
using files::replaced;

namespace {

// the error of a sample with one change
std::string error_with(std::string const& sample, std::string_view from, std::string_view to) {
  return error_of([&] { io::parse_gmsh("f.msh", replaced(sample, from, to)); });
}

}  // namespace

TEST_CASE("read_gmsh reads all versions, in the order of the file") {
  const files::TempFolder folder;
  for (auto const* sample : {&samples::gmsh1, &samples::gmsh2, &samples::gmsh4}) {
    CHECK(io::read_gmsh(folder.write("a.msh", *sample)) == samples::mesh());
    std::string dos = *sample;
    for (std::size_t i = 0; (i = dos.find('\n', i)) != dos.npos; i += 2) dos.insert(i, 1, '\r');
    CHECK(io::read_gmsh(folder.write("dos.msh", dos)) == samples::mesh());
  }
  CHECK(io::parse_gmsh("f", replaced(samples::gmsh2, "2.2 0", "2 0")) == samples::mesh());
}

TEST_CASE("read_gmsh reads hexahedra and keeps unused nodes") {
  const Mesh mesh = io::parse_gmsh("f",
                                   "$NOD\n9\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n"
                                   "8 0 1 1\n9 5 5 5\n$ENDNOD\n$ELM\n1\n1 5 1 1 8 1 2 3 4 5 6 7 8\n$ENDELM");
  CHECK(mesh.positions.size() == 9);
  CHECK(mesh.hexahedra == std::vector<Hexahedron>{{0, 1, 2, 3, 4, 5, 6, 7}});
}

TEST_CASE("read_gmsh reads prisms and pyramids") {
  const Mesh mesh =
      io::parse_gmsh("f",
                     "$NOD\n7\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 0 1\n6 0 1 1\n7 2 2 0.5\n"
                     "$ENDNOD\n$ELM\n2\n1 6 1 1 6 1 2 3 4 5 6\n2 7 1 1 5 2 3 6 5 7\n$ENDELM");
  CHECK(mesh.prisms == std::vector<Prism>{{0, 1, 2, 3, 4, 5}});
  CHECK(mesh.pyramids == std::vector<Pyramid>{{1, 2, 5, 4, 6}});
}

TEST_CASE("read_gmsh says what it does not read") {
  check_says(error_with(samples::gmsh2, "2.2 0", "2.2 1"), "f.msh:2", "binary");
  check_says(error_with(samples::gmsh4, "4.1 0", "4.1 1"), "f.msh:2", "export it as ASCII");
  check_says(error_with(samples::gmsh2, "2.2 0", "4 0"),
             "f.msh:2",
             "version 4 of Gmsh's format; save it as version 4.1");
  check_says(error_with(samples::gmsh2, "3 2 3 1 1 6 10 300 7", "3 9 0 10 300 7 2 5 10"),
             "f.msh:20",
             "second or higher order");
  check_says(error_with(samples::gmsh4, "3 1 4 1", "3 1 11 1"), "f.msh:35", "type 11");
  check_says(error_with(samples::gmsh1, "9 4 1 1 4", "9 6 1 1 4"), "f.msh:15", "type 6 have 6 nodes");
  check_says(
      error_of([] { io::parse_gmsh("f.msh", "solid thing\n"); }), "f.msh:1", "with which a Gmsh file begins");
}

TEST_CASE("read_gmsh names the line of an error") {
  check_says(error_with(samples::gmsh1, "7 1 0 0", "7 1 nan 0"), "f.msh:4", "not a finite number");
  check_says(error_with(samples::gmsh1, "7 1 0 0", "7 1 -inf 0"), "f.msh:4", "not a finite number");
  check_says(
      error_with(samples::gmsh1, "7 1 0 0", "7 1 x 0"), "f.msh:4", "expected a coordinate, found \"x\"");
  check_says(error_with(samples::gmsh1, "7 1 0 0", "10 1 0 0"), "f.msh:4", "node number 10 is given twice");
  check_says(error_with(samples::gmsh1, "4 10 7 300 5", "4 10 7 300 6"),
             "f.msh:15",
             "node 6, but no node has this number");
  check_says(error_with(samples::gmsh2, "2 1 0 2 5", "2 1 0 2 -9223372036854775808"),
             "f.msh:19",
             "no node has this number");
  check_says(error_with(samples::gmsh1, "3 2 1 1 3", "3 2 1 1 4"), "f.msh:13", "type 2 have 3 nodes");
  check_says(error_with(samples::gmsh1, "$NOD\n5", "$NOD\n4"), "f.msh:7", "expected the end of section $NOD");
  check_says(
      error_with(samples::gmsh1, "$ELM\n5", "$ELM\n6"), "f.msh:16", "expected the number of an element");
  check_says(error_with(samples::gmsh4, "4 5 2 300", "4 6 2 300"),
             "f.msh:9",
             "6 nodes are announced, but the blocks hold 5");
  check_says(error_with(samples::gmsh4, "5 5 1 9", "5 4 1 9"),
             "f.msh:26",
             "4 elements are announced, but the blocks hold 5");
  check_says(error_with(samples::gmsh1, "$ELM\n", "$NOD\n"), "f.msh:9", "second section");
  check_says(error_with(samples::gmsh2, "$PhysicalNames\n1", "$Elements\n1"), "f.msh:4", "before the nodes");
  check_says(error_with(samples::gmsh1, "300 1 1 0", "300 1 1 \x01"), "f.msh:5", "not text");
}

TEST_CASE("read_gmsh takes no memory on a number's word") {
  for (const char* n : {"-5", "1000000000", "4294967296", "9223372036854775807"}) {
    check_says(
        error_with(samples::gmsh1, "$NOD\n5", std::string("$NOD\n") + n), "f.msh:2", "correct the number");
    check_says(error_with(samples::gmsh2, "$Elements\n5", std::string("$Elements\n") + n),
               "f.msh:17",
               "correct the number");
    check_says(
        error_with(samples::gmsh4, "3 1 4 1", std::string("3 1 4 ") + n), "f.msh:35", "correct the number");
    check_says(
        error_with(samples::gmsh2, "4 3 2", std::string("4 3 ") + n), "f.msh:21", "correct the number");
  }
  CHECK_FALSE(error_with(samples::gmsh1, "$NOD\n5", "$NOD\n0").empty());
}

TEST_CASE("read_gmsh refuses every incomplete file") {
  for (auto const* sample : {&samples::gmsh1, &samples::gmsh2, &samples::gmsh4})
    for (std::size_t n = 0; n + 1 < sample->size(); ++n) {  // the last byte is the end of the last line
      INFO(sample->substr(0, n));
      CHECK_THROWS_AS(io::parse_gmsh("f", std::string_view(*sample).substr(0, n)), Error);
    }
}

}  // namespace test_read_gmsh
