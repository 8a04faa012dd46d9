// SPDX-License-Identifier: BSL-1.0
// Broken files of every format: a reader gives a sound mesh or throws Error, and does nothing else.
#include <sinew/io/mesh_file.hpp>
#include <sinew/io/read_vtk.hpp>
#include <sinew/io/write_vtu.hpp>

#include "files.hpp"
#include "samples.hpp"

namespace test_broken_files {

using namespace sinew;

namespace {

struct Case {
  Mesh (*parse)(std::string_view, std::string_view);
  std::string sample;
};

std::vector<Case> cases() {
  const files::TempFolder folder;
  io::write_vtu(folder / "a.vtu", samples::mesh(), {{"u", 1, {0, 1, 2, 3, 4}}});
  const std::string inside = io::read_file(folder / "a.vtu");
  // the same arrays, appended as raw bytes; the first is at the end of an empty one
  std::string raw = files::replaced(samples::vtuAscii,
                                    "format=\"ascii\">\n          0 0 0  1 0 0  1 1 0\n"
                                    "          0 1 0  0.25 0.5 -1.5\n        </DataArray>",
                                    "format=\"appended\" offset=\"4\"/>");
  std::string bytes("\0\0\0\0\x78\0\0\0", 8);
  for (auto const& p : samples::mesh().positions) bytes.append(reinterpret_cast<char const*>(p.data()), 24);
  raw = files::replaced(
      raw, "</VTKFile>", "<AppendedData encoding=\"raw\">_" + bytes + "</AppendedData></VTKFile>");
  return {{io::parse_gmsh, samples::gmsh1},
          {io::parse_gmsh, samples::gmsh2},
          {io::parse_gmsh, samples::gmsh4},
          {io::parse_obj, samples::obj},
          {io::parse_vtk, samples::vtkGrid3},
          {io::parse_vtk, samples::vtkGrid5},
          {io::parse_vtk, samples::vtkPoly},
          {io::parse_stl, samples::stl},
          {io::parse_stl, samples::stl_binary()},
          {io::parse_vtu, samples::vtuAscii},
          {io::parse_vtu, inside},
          {io::parse_vtu, raw}};
}

// false, with a message, if anything but Error comes out of the reader
bool survives(Case const& c, std::string const& content) {
  try {
    const Mesh mesh = c.parse("f", content);
    check_mesh("f", mesh);
    return !mesh.positions.empty();
  } catch (Error const& e) {
    return std::string_view(e.what()).starts_with("f");
  } catch (std::exception const& e) {
    UNSCOPED_INFO(e.what());
    return false;
  }
}

/// Numbers of Marsaglia's xorshift64 (2003).
struct Random {
  std::uint64_t state;
  std::size_t below(std::size_t n) {
    state ^= state << 13, state ^= state >> 7, state ^= state << 17;
    return std::size_t(state % n);
  }
};

}  // namespace

TEST_CASE("whole samples are read") {
  for (Case const& c : cases()) CHECK(c.parse("f", c.sample).positions == samples::mesh().positions);
}

TEST_CASE("files cut off anywhere") {
  for (Case const& c : cases())
    for (std::size_t n = 0; n < c.sample.size(); ++n)
      if (!survives(c, c.sample.substr(0, n))) FAIL_CHECK(c.sample.substr(0, n));
}

TEST_CASE("files with any one bit flipped") {
  for (Case const& c : cases())
    for (std::size_t bit = 0; bit < 8 * c.sample.size(); ++bit) {
      std::string content = c.sample;
      content[bit / 8] = char(content[bit / 8] ^ 1 << bit % 8);
      if (!survives(c, content)) FAIL_CHECK(content);
    }
}

TEST_CASE("files with random damage") {
  Random random{20070103};
  const std::string_view words[] = {
      "-1", "0", "9", "4294967296", "9223372036854775807", "nan", "1e999", " ", "\n", "<", "$", "/"};
  for (Case const& c : cases())
    for (int round = 0; round < 1500; ++round) {
      std::string content = c.sample;
      for (std::size_t edits = 1 + random.below(4); edits > 0 && !content.empty(); --edits) {
        const std::size_t at = random.below(content.size()), length = random.below(20);
        switch (random.below(5)) {
          case 0:
            content[at] = char(random.below(256));
            break;
          case 1:
            content.erase(at, length);
            break;
          case 2:
            content.insert(at, content.substr(random.below(content.size()), length));
            break;
          case 3:
            content.insert(at, words[random.below(std::size(words))]);
            break;
          default:
            content.replace(at, 1, words[random.below(std::size(words))]);
        }
      }
      if (!survives(c, content)) FAIL_CHECK(content);
    }
}

TEST_CASE("no file at all: random bytes") {
  Random random{42};
  const auto all = cases();
  for (int round = 0; round < 2000; ++round) {
    std::string content(1 + random.below(300), ' ');
    for (char& c : content) c = char(random.below(256));
    for (Case const& c : all) {
      bool threw = false;
      try {
        c.parse("f", content);
      } catch (Error const&) {
        threw = true;
      }
      if (!threw) FAIL_CHECK(content);
    }
  }
}

}  // namespace test_broken_files
