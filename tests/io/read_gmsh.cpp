// SPDX-License-Identifier: BSL-1.0
#include <sinew/io/read_gmsh.hpp>
#include <sinew/topology/quadratic_shapes.hpp>

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

// Where Gmsh has the nodes of its hexahedra ("Node ordering" in its manual), and of its tetrahedra.
constexpr double ofHexahedron[27][3] = {
    {-1, -1, -1}, {1, -1, -1}, {1, 1, -1},  {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1},
    {-1, 1, 1},   {0, -1, -1}, {-1, 0, -1}, {-1, -1, 0}, {1, 0, -1},  {1, -1, 0}, {0, 1, -1},
    {1, 1, 0},    {-1, 1, 0},  {0, -1, 1},  {-1, 0, 1},  {1, 0, 1},   {0, 1, 1},  {0, 0, -1},
    {0, -1, 0},   {-1, 0, 0},  {1, 0, 0},   {0, 1, 0},   {0, 0, 1},   {0, 0, 0}};
constexpr double ofTetrahedron[10][3] = {{0, 0, 0},
                                         {1, 0, 0},
                                         {0, 1, 0},
                                         {0, 0, 1},
                                         {0.5, 0, 0},
                                         {0.5, 0.5, 0},
                                         {0, 0.5, 0},
                                         {0, 0, 0.5},
                                         {0, 0.5, 0.5},
                                         {0.5, 0, 0.5}};

// one element of a type, with all nodes, in a file of version 2 or 4
template <std::size_t N>
std::string one_element(int type, std::size_t nodes, double const (&places)[N][3], bool fourth) {
  std::string points, list, tags;
  for (std::size_t k = 0; k < N; ++k) {
    const std::string at = text(places[k][0], ' ', places[k][1], ' ', places[k][2], '\n');
    points += fourth ? at : text(k + 1, ' ', at);
    tags += text(k + 1, '\n');
    if (k < nodes) list += text(' ', k + 1);
  }
  if (fourth)
    return text("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 ", N, " 1 ", N, "\n3 1 0 ", N, "\n") + tags +
           points + text("$EndNodes\n$Elements\n1 1 1 1\n3 1 ", type, " 1\n1") + list + "\n$EndElements\n";
  return text("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n", N, '\n') + points +
         text("$EndNodes\n$Elements\n1\n1 ", type, " 2 0 0") + list + "\n$EndElements\n";
}

TEST_CASE("read_gmsh brings the nodes of elements of second order into VTK's order") {
  for (const bool fourth : {false, true}) {
    const Mesh tetrahedron = io::parse_gmsh("f", one_element(11, 10, ofTetrahedron, fourth));
    REQUIRE(tetrahedron.quadraticTetrahedra.size() == 1);
    auto const& t = tetrahedron.quadraticTetrahedra[0];
    auto at = [&](std::size_t k) { return tetrahedron.positions[std::size_t(t[k])]; };
    for (auto const& [i, j, middle] : sinew::detail::quadraticTetrahedronEdges)
      CHECK(at(middle) == (at(i) + at(j)) / 2);

    const Mesh whole = io::parse_gmsh("f", one_element(12, 27, ofHexahedron, fourth)),
               serendipity = io::parse_gmsh("f", one_element(17, 20, ofHexahedron, fourth));
    REQUIRE(whole.triquadraticHexahedra.size() == 1);
    REQUIRE(serendipity.quadraticHexahedra.size() == 1);
    for (std::size_t k = 0; k < 27; ++k) {
      const Eigen::Vector3d place(sinew::detail::triquadraticPlaces.at[k]);
      CHECK(whole.positions[std::size_t(whole.triquadraticHexahedra[0][k])] == place);
      if (k < 20) CHECK(serendipity.positions[std::size_t(serendipity.quadraticHexahedra[0][k])] == place);
    }
  }
}

TEST_CASE("read_gmsh cuts faces and lines of second order between their nodes") {
  // of version 1, which says how many nodes there are
  const std::string nodes =
      "$NOD\n9\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0.5 0 0\n6 1 0.5 0\n"
      "7 0.5 1 0\n8 0 0.5 0\n9 0.5 0.5 0\n$ENDNOD\n$ELM\n1\n";
  auto read = [&](std::string const& element) {
    return io::parse_gmsh("f.msh", nodes + element + "\n$ENDELM");
  };
  CHECK(read("1 8 1 1 3 1 2 5").edges == std::vector<Edge>{{0, 4}, {4, 1}});
  CHECK(read("1 9 1 1 6 1 2 4 5 9 8").triangles ==
        std::vector<Triangle>{{0, 4, 7}, {1, 8, 4}, {3, 7, 8}, {4, 8, 7}});
  CHECK(read("1 10 1 1 9 1 2 3 4 5 6 7 8 9").quads ==
        std::vector<Quad>{{0, 4, 8, 7}, {4, 1, 5, 8}, {8, 5, 2, 6}, {7, 8, 6, 3}});
  const Mesh mesh = read("1 16 1 1 8 1 2 3 4 5 6 7 8");
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 4, 7}, {1, 5, 4}, {2, 6, 5}, {3, 7, 6}});
  CHECK(mesh.quads == std::vector<Quad>{{4, 5, 6, 7}});
}

TEST_CASE("read_gmsh says what is wrong with an element of second order") {
  auto error = [](std::string const& file) { return error_of([&] { io::parse_gmsh("f.msh", file); }); };
  for (const bool fourth : {false, true}) {
    check_says(error(one_element(11, 9, ofTetrahedron, fourth)),
               fourth ? "f.msh:31" : "f.msh:19",
               "an element of 10 nodes has fewer in its line");
    check_says(error(replaced(one_element(11, 10, ofTetrahedron, fourth), " 9 10\n", " 9 9\n")),
               "f.msh",
               "quadratic tetrahedron 0 has point 8 twice; give it 10 different points");
  }
}

TEST_CASE("read_gmsh says what it does not read") {
  check_says(error_with(samples::gmsh2, "2.2 0", "2.2 1"), "f.msh:2", "binary");
  check_says(error_with(samples::gmsh4, "4.1 0", "4.1 1"), "f.msh:2", "export it as ASCII");
  check_says(error_with(samples::gmsh2, "2.2 0", "4 0"),
             "f.msh:2",
             "version 4 of Gmsh's format; save it as version 4.1");
  check_says(error_with(samples::gmsh2, "3 2 3 1 1 6 10 300 7", "3 13 0 10 300 7 2 5 10"),
             "f.msh:20",
             "prisms or pyramids of second order");
  check_says(error_with(samples::gmsh4, "3 1 4 1", "3 1 29 1"), "f.msh:35", "type 29");
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
