// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/mpi/read_gmsh.hpp>

#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

namespace test_read_gmsh_of_ranks {

using namespace sinew;

/// A file of some text that rank 0 writes and removes.
struct File {
  mpi::Communicator& ranks;
  std::string path = "test_mpi_read_gmsh.msh";
  File(mpi::Communicator& r, std::string const& content) : ranks(r) {
    if (ranks.rank() == 0) std::ofstream(path) << content;
    ranks.meet("a file");
  }
  File(File const&) = delete;
  File& operator=(File const&) = delete;
  ~File() {
    ranks.meet("the end of a file");
    if (ranks.rank() == 0) std::remove(path.c_str());
  }
};

// nodes are numbered by `step`, which leaves gaps, or backwards
std::string version1(int n, int step) {
  std::ostringstream s;
  s.precision(17);
  s << "$NOD\n" << n << '\n';
  for (int i = 0; i < n; ++i)
    s << 5 + step * (step < 0 ? i - n : i) << ' ' << 0.1 * i << " -1e-3 " << i / 7. << '\n';
  s << "$ENDNOD\n$ELM\n" << n - 3 << '\n';
  for (int i = 0; i < n - 3; ++i) {
    s << i + 1 << " 4 1 1 4";
    for (int k = 0; k < 4; ++k) s << ' ' << 5 + step * (step < 0 ? i + k - n : i + k);
    s << '\n';
  }
  return s.str() + "$ENDELM\n";
}
std::string version2(int n, std::string const& newline) {
  std::ostringstream s;
  s.precision(17);
  s << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n\n$PhysicalNames\n1\n3 1 \"a body\"\n$EndPhysicalNames\n"
    << "$Nodes\n"
    << n << '\n';
  for (int i = 0; i < n; ++i) s << i + 1 << ' ' << i * 0.3 << ' ' << 1. / (i + 1) << " 2\n";
  s << "$EndNodes\n$Elements\n" << 2 * n - 9 << '\n';
  for (int i = 0; i < 2 * n - 9; ++i) {
    const int kind[] = {1, 2, 3, 4, 5, 6, 7, 15}, size[] = {2, 3, 4, 4, 8, 6, 5, 1};
    s << i + 1 << ' ' << kind[i % 8] << " 2 1 7";
    for (int k = 0; k < size[i % 8]; ++k) s << "  " << 1 + (i / 2 + k) % n;
    s << '\n';
  }
  s << "$EndElements\n";
  std::string all = s.str(), lines;
  for (char c : all) lines += c == '\n' ? newline : std::string(1, c);
  return lines;
}
std::string version4(int n, int announced) {
  std::ostringstream s;
  s.precision(17);
  s << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 0\n$EndEntities\n$Nodes\n3 " << announced
    << " 1 " << 3 * n << "\n3 1 0 " << n << '\n';
  for (int i = 0; i < n; ++i) s << 3 * i + 1 << '\n';
  for (int i = 0; i < n; ++i) s << i << " 0.5 " << i / 3. << '\n';
  s << "2 7 1 2\n2\n5\n1 2 3 0.5 0.25\n4 5 6 0.125 0\n1 1 0 0\n$EndNodes\n$Elements\n3 " << n + 1 << " 1 "
    << 2 * n << "\n1 1 1 2\n1 1 4\n2 4 2\n3 1 4 0\n3 1 4 " << n - 1 << '\n';
  for (int i = 0; i < n - 1; ++i) s << 10 + i << ' ' << 3 * i + 1 << ' ' << 3 * i + 4 << " 2 5\n";
  return s.str() + "$EndElements\n$Comments\nnothing\n$EndComments\n";
}

void compare(Mesh const& a, Mesh const& b) {
  CHECK(a.positions == b.positions);
  CHECK(a.edges == b.edges);
  CHECK(a.triangles == b.triangles);
  CHECK(a.quads == b.quads);
  CHECK(a.tetrahedra == b.tetrahedra);
  CHECK(a.hexahedra == b.hexahedra);
  CHECK(a.prisms == b.prisms);
  CHECK(a.pyramids == b.pyramids);
}

TEST_CASE("ranks read a Gmsh file each a part, and have the mesh of one process bit by bit") {
  mpi::Communicator ranks;
  const int n = GENERATE(12, 200);
  for (auto const& content : {version1(n, 1),
                              version1(n, 3),
                              version1(n, -2),
                              version2(n, "\n"),
                              version2(n, "\r\n"),
                              version4(n, n + 2)}) {
    const File file(ranks, content);
    const Mesh whole = io::parse_gmsh(file.path, content), mesh = mpi::read_gmsh(file.path, ranks);
    compare(mesh, whole);
    // it has been read in parts, and not again as a whole
    CHECK(mpi::detail::GmshOfRanks(file.path, ranks).read());
  }
  // two nodes on a line: read as a whole
  std::string joined = version2(n, "\n");
  joined[joined.find("\n2 0.")] = ' ';
  const File file(ranks, joined);
  CHECK_FALSE(mpi::detail::GmshOfRanks(file.path, ranks).read());
  compare(mpi::read_gmsh(file.path, ranks), io::parse_gmsh(file.path, joined));
}

TEST_CASE("what is wrong with a Gmsh file all ranks say as one process does") {
  mpi::Communicator ranks;
  auto replaced = [](std::string text, std::string const& what, std::string const& by) {
    REQUIRE(text.rfind(what) != text.npos);
    return text.replace(text.rfind(what), what.size(), by);
  };
  const std::string good = version2(40, "\n");
  for (auto const& content : {good.substr(0, good.size() / 2),
                              good.substr(0, good.size() / 4),
                              replaced(good, "$EndElements", "$EndNodes"),
                              replaced(good, "$Elements\n71", "$Elements\n72"),
                              replaced(good, "$Elements\n71", "$Elements\n70"),
                              replaced(good, "\n30 8.", "\n29 8."),
                              replaced(good, " 2\n$EndNodes", " nan\n$EndNodes"),
                              replaced(good, " 2\n$EndNodes", " 2\x01\n$EndNodes"),
                              replaced(good, "2.2 0 8", "3.0 0 8"),
                              replaced(good, "2.2 0 8", "2.2 1 8"),
                              replaced(good, "  40\n$EndElements", "  400\n$EndElements"),
                              version4(40, 41),
                              replaced(version4(40, 42), "3 1 4 39", "3 1 11 39"),
                              std::string("$MeshFormat\n"),
                              std::string("solid\n")}) {
    const File file(ranks, content);
    std::string expected, said;
    try {
      io::parse_gmsh(file.path, content);
    } catch (Error const& error) {
      expected = error.what();
    }
    try {
      mpi::read_gmsh(file.path, ranks);
    } catch (Error const& error) {
      said = error.what();
    }
    INFO(content.substr(0, 200));
    CHECK(!expected.empty());
    CHECK(said == expected);
  }
}

TEST_CASE("a Gmsh file that one rank does not have, or has another one of, ends all with one sentence") {
  auto said = [](auto const& path) {
    mpi::Communicator ranks;
    std::string error;
    try {
      ranks.collectively("a mesh", [&] { mpi::read_gmsh(path(ranks), ranks); });
    } catch (Error const& e) {
      error = e.what();
    }
    return error;
  };
  int rank = 0, size = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank), MPI_Comm_size(MPI_COMM_WORLD, &size);
  const std::string one = "test_mpi_one_" + std::to_string(rank) + ".msh";
  std::ofstream(one) << version2(rank + 1 == size && size > 1 ? 51 : 50, "\n");
  const std::string last = "rank " + std::to_string(size - 1) + " of " + std::to_string(size) + ": ";
  const bool alone = size == 1;
  const std::string missing =
      said([&](auto& ranks) { return ranks.rank() + 1 == size ? std::string("no_such.msh") : one; });
  INFO(missing);
  CHECK(missing.find("no_such.msh: cannot be read: ") == (alone ? 0 : last.size()));
  if (!alone) CHECK(missing.find(last) == 0);
  if (size == 2) {
    const std::string other = said([&](auto&) { return one; });
    INFO(other);
    CHECK(other == last + one.substr(0, 0) +
                       "test_mpi_one_1.msh: is another file on this rank, not that of rank 0; give all ranks "
                       "the same files");
  }
  std::remove(one.c_str());
}

}  // namespace test_read_gmsh_of_ranks
