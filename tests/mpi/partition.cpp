// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/mpi/partition.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <algorithm>
#include <set>
#include <string>

namespace test_partition {

using namespace sinew;

TEST_CASE("each point has one rank, and a rank has all elements at its points, those without ghosts first") {
  const int size = GENERATE(1, 2, 3, 4, 7);
  const Mesh mesh = regular_grid_tetrahedra(7, 3, 3, {0, 0, 0}, {3, 1, 1});
  const TopologyView view{.tetrahedra = mesh.tetrahedra};
  const auto parts = mpi::parts_of_points("here", mesh.positions.size(), {&view, 1}, size);
  CHECK(parts == mpi::parts_of_points("here", mesh.positions.size(), {&view, 1}, size));
  std::size_t all = 0;
  for (int rank = 0; rank < size; ++rank) {
    const mpi::Part part = mpi::part_of("here", parts, {&view, 1}, rank, size);
    const std::size_t own = part.owned(rank);
    all += own;
    std::set<Index> here(part.points.kept.begin(), part.points.kept.end());
    CHECK(here.size() == part.points.kept.size());
    for (std::size_t i = 0; i < part.points.kept.size(); ++i)
      CHECK((parts[std::size_t(part.points.kept[i])] == rank) == (i < own));
    std::set<Index> elements(part.topologies[0].elements[3].kept.begin(),
                             part.topologies[0].elements[3].kept.end());
    bool border = false;
    for (const Index e : part.topologies[0].elements[3].kept) {
      bool inner = true;
      for (const Index i : mesh.tetrahedra[std::size_t(e)]) {
        CHECK(here.contains(i));
        inner = inner && parts[std::size_t(i)] == rank;
      }
      CHECK_FALSE((border && inner));
      border = border || !inner;
    }
    for (std::size_t e = 0; e < mesh.tetrahedra.size(); ++e)
      for (const Index i : mesh.tetrahedra[e])
        if (parts[std::size_t(i)] == rank) CHECK(elements.contains(Index(e)));
  }
  CHECK(all == mesh.positions.size());
}

TEST_CASE(
    "what joins points counts as an element, and points that all ranks have are ghosts or own on each") {
  const int size = GENERATE(2, 3, 4);
  const Mesh mesh = regular_grid_tetrahedra(7, 3, 3, {0, 0, 0}, {3, 1, 1});
  const std::size_t n = mesh.positions.size();
  const TopologyView view{.tetrahedra = mesh.tetrahedra};
  const mpi::JoinedPoints joined{{0, Index(n) - 1}, {2, 30, 50, 60}};
  const std::vector<Index> everywhere{6, 7, 40};
  const std::vector<mpi::NeededPoint> needed{{6}, {7}, {40}, {3, 1}};
  const auto parts = mpi::parts_of_points("here", n, {&view, 1}, size, joined);
  std::vector<mpi::Part> all;
  for (int rank = 0; rank < size; ++rank)
    all.push_back(mpi::part_of("here", parts, {&view, 1}, rank, size, joined, needed));
  for (int rank = 0; rank < size; ++rank) {
    mpi::Part const& part = all[std::size_t(rank)];
    const std::set<Index> here(part.points.kept.begin(), part.points.kept.end());
    for (const Index i : everywhere) CHECK(here.contains(i));
    if (rank == 1) CHECK(here.contains(3));
    for (auto const& points : joined)
      if (std::any_of(points.begin(), points.end(), [&](Index i) { return parts[std::size_t(i)] == rank; }))
        for (const Index i : points) CHECK(here.contains(i));
    // what is sent is what the others expect, in their order
    for (auto const& [to, sent] : part.sent) {
      mpi::Part const& other = all[std::size_t(to)];
      std::vector<int> expected;
      for (std::size_t g = 0; g < other.ghostOwner.size(); ++g)
        if (other.ghostOwner[g] == rank) expected.push_back(other.ghostNumber[g]);
      CHECK(sent == expected);
      CHECK(other.sent.contains(rank));
    }
  }
}

TEST_CASE("points that are too few are not shared out") {
  const std::vector<Tetrahedron> one{{0, 1, 2, 3}};
  const TopologyView view{.tetrahedra = one};
  CHECK(mpi::parts_of_points("here", 4, {&view, 1}, 1) == std::vector<int>(4, 0));
  CHECK_THROWS_WITH(
      mpi::parts_of_points("here", 4, {&view, 1}, 2),
      "here: 4 points with 1 elements cannot be shared out among 2 ranks; take fewer ranks (mpirun -n)");
  CHECK_THROWS_WITH(mpi::part_of("here", {0, 0, 0, 0}, {&view, 1}, 0, 2),
                    "here: rank 1 of 2 would have no element of the 4 points; take fewer ranks (mpirun -n)");
}

TEST_CASE("entries of a list come in another order, with the elements that are split into them") {
  std::vector<double> values{0, 1, 2, 3, 4};
  const Renumbering order = Renumbering::inOrder({3, 0, 4}, 5);
  CHECK(order.changes());
  order.filter(values);
  CHECK(values == std::vector<double>{3, 0, 4});
  Index point = 4;
  order.renumber(point);
  CHECK(point == 2);
  CHECK_FALSE(order.stays(1));
  CHECK_FALSE(Renumbering::inOrder({0, 1, 2}, 3).changes());
  CHECK(Renumbering::inOrder({1, 0}, 2).changes());

  // two tetrahedra, and two hexahedra of three values each
  TopologyChange change;
  change.elements[3] = Renumbering::inOrder({1, 0}, 2);
  change.elements[4] = Renumbering::inOrder({1}, 2);
  std::vector<int> each{10, 11, 20, 21, 22, 30, 31, 32};
  change.ofDimension(3, each.size()).filter(each);
  CHECK(each == std::vector<int>{11, 10, 30, 31, 32});
}

}  // namespace test_partition
