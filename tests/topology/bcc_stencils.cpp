// SPDX-License-Identifier: BSL-1.0
#include <sinew/topology/bcc_stencils.hpp>
#include <sinew/topology/bcc_warp.hpp>
#include <sinew/topology/quality.hpp>

#include <algorithm>
#include <random>

#include "catch.hpp"

namespace test_bcc_stencils {

using namespace sinew;
using namespace sinew::detail;

namespace {

// one lattice point with all of its surroundings, every edge a cut edge
struct OneCell {
  BccLattice lattice = empty_bcc_lattice("test", {0, 0, 0}, {3, 3, 3}, 1.0);
  int p = 0;
  OneCell() {
    const auto n = std::size_t(lattice.size());
    lattice.value.assign(n, 0), lattice.label.assign(n, -1), lattice.snapped.assign(n, -1);
    lattice.cutMask.assign(n, 127), lattice.cutStart.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      lattice.cutStart[i] = std::int32_t(7 * i);
      for (std::int32_t d = 0; d < 7; ++d) lattice.cuts.push_back({0.5, std::int32_t(i), d});
    }
    p = (8 * lattice.sy + 4) * lattice.sx + 4;
  }
  std::array<int, 4> corners(BccTetrahedron const& cell) const {
    std::array<int, 4> points{p};
    for (std::size_t i = 1; i < 4; ++i) points[i] = p + lattice.steps_of(p)[std::size_t(cell.edge[0][i])];
    return points;
  }
  void set_cut(int from, int direction, double t) {
    lattice.cuts[std::size_t(lattice.cut_number(from, direction))].fraction = direction < 7 ? t : 1 - t;
  }
};

}  // namespace

TEST_CASE(
    "lattice tetrahedra are congruent, positively oriented, and their numbers agree with their geometry") {
  const OneCell one;
  for (BccTetrahedron const& cell : bccTetrahedra) {
    const std::array<int, 4> points = one.corners(cell);
    Mesh mesh;
    for (const int i : points) mesh.positions.push_back(one.lattice.lattice_position(i));
    mesh.tetrahedra = {{0, 1, 2, 3}};
    const TetrahedronQuality q = quality(mesh);
    CHECK(q.volume == Approx(1 / 12.0));
    CHECK(q.minDihedral == Approx(60));
    CHECK(q.maxDihedral == Approx(90));
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j)
        if (i != j) {
          CHECK(points[j] == points[i] + one.lattice.steps_of(points[i])[std::size_t(cell.edge[i][j])]);
          CHECK(one.lattice.along(points[i], cell.edge[i][j], 1).isApprox(mesh.positions[j]));
        }
  }
}

// For every pattern of labels: corners on the surface anywhere they can move to, cut points anywhere they are
// allowed. Extremes of the angles are near the ends of these ranges, so half of the samples are there.
TEST_CASE("no position of moved corners and cut points breaks the angle bounds") {
  OneCell one;
  std::mt19937 random(1);
  auto uniform = [&] { return double(random()) / 4294967296.0; };
  auto position = [&] { return random() % 2 == 0 ? double(random() % 2) : uniform(); };
  double smallest = 180, smallestWithout = 180, largest = 0;
  for (std::size_t c = 0; c < 4; ++c)
    for (int pattern = 0; pattern < 81; ++pattern) {
      BccTetrahedron const& cell = bccTetrahedra[c];
      const std::array<int, 4> points = one.corners(cell);
      int digits = pattern, inside = 0;
      bool onSurface = false;
      for (const int i : points) {
        const int label = digits % 3 - 1;
        digits /= 3, inside += label > 0, onSurface = onSurface || label == 0;
        one.lattice.label[std::size_t(i)] = static_cast<signed char>(label);
      }
      if (inside == 0) continue;
      for (int sample = 0; sample < 400; ++sample) {
        Mesh mesh;
        stuff(one.lattice, cell, points, mesh.tetrahedra);
        for (std::size_t i = 0; i < 4; ++i) {
          for (std::size_t j = i + 1; j < 4; ++j) {
            const double alpha = bcc_alpha(cell.edge[i][j]);
            one.set_cut(points[i], cell.edge[i][j], alpha + (1 - 2 * alpha) * position());
          }
        }
        std::array<Eigen::Vector3d, 4> moved;
        for (std::size_t i = 0; i < 4; ++i) {
          const int d = int(random() % 14);
          const double t = one.lattice.label[std::size_t(points[i])] == 0 ? bcc_alpha(d) * position() : 0.0;
          moved[i] = one.lattice.along(points[i], d, t);
        }
        for (Tetrahedron& t : mesh.tetrahedra)
          for (Index& i : t) {
            const auto corner = std::find(points.begin(), points.end(), i);
            mesh.positions.push_back(corner < points.end() ? moved[std::size_t(corner - points.begin())]
                                                           : one.lattice.position(i));
            i = Index(mesh.positions.size()) - 1;
          }
        const TetrahedronQuality q = quality(mesh);
        smallest = std::min(smallest, q.minVolume > 0 ? q.minDihedral : 0);
        if (!onSurface) smallestWithout = std::min(smallestWithout, q.minDihedral);
        largest = std::max(largest, q.maxDihedral);
      }
      for (const int i : points) one.lattice.label[std::size_t(i)] = -1;
    }
  CHECK(smallest > 9.2);
  CHECK(smallest < 14);           // the samples do reach the bad corners
  CHECK(smallestWithout > 12.7);  // where points stay at the lattice: why unsnap_flattened() always helps
  CHECK(largest < 161.7);
  CHECK(largest > 150);
}

TEST_CASE("the link of a lattice point is a sphere of 14 points, 36 edges and 24 triangles") {
  for (auto const& [u, v, left, right] : bccLink.edges) {
    CHECK(u < v);
    CHECK(left != right);
    CHECK((left >= 0 && left < 14 && right >= 0 && right < 14));
  }
  for (std::size_t t = 0; t < 24; ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      auto const& edge = bccLink.edges[std::size_t(bccLink.triangleEdges[t][c])];
      CHECK(edge[0] == bccLink.triangles[t][c == 0 ? 1 : 0]);
      CHECK(edge[1] == bccLink.triangles[t][c == 2 ? 1 : 2]);
    }
}

TEST_CASE("a surface point is a manifold point when its link shows one curve") {
  OneCell one;
  auto set = [&](auto label) {
    for (std::size_t d = 0; d < 14; ++d)
      one.lattice.label[std::size_t(one.p + one.lattice.steps_of(one.p)[d])] =
          static_cast<signed char>(label(int(d)));
    one.lattice.label[std::size_t(one.p)] = 0;
    return is_manifold_at(one.lattice, one.p);
  };
  auto x = [](int d) { return bccDirections[std::size_t(d)][0]; };
  CHECK(set([&](int d) { return x(d) > 0 ? 1 : -1; }));                 // a plane between lattice points
  CHECK(set([&](int d) { return x(d) > 0 ? 1 : x(d) < 0 ? -1 : 0; }));  // a plane through some
  CHECK(set([&](int) { return 1; }));                                   // inside
  CHECK(set([&](int) { return -1; }));                                  // outside
  CHECK(set([&](int d) { return d == 0 ? 1 : -1; }));                   // a tip
  CHECK_FALSE(set([&](int d) { return bcc_is_long(d) && x(d) != 0 ? 1 : -1; }));  // two tips
  CHECK_FALSE(set([&](int d) { return bcc_is_long(d) && x(d) != 0 ? -1 : 1; }));  // a tunnel
  CHECK(set([&](int d) { return bcc_is_long(d) ? 0 : x(d) > 0 ? 1 : -1; }));  // through 4 of 6 surface points
}

TEST_CASE("inside points that see each other through a face on the surface belong to one component") {
  OneCell one;
  auto at = [&](int p) -> signed char& { return one.lattice.label[std::size_t(p)]; };
  auto step = [&](int p, int x, int y, int z) {
    return p + one.lattice.steps_of(p)[std::size_t(bcc_direction(x, y, z))];
  };
  // p and its mirror image in the face of three of its neighbours
  const int a = step(one.p, 2, 0, 0), b = step(one.p, 1, 1, 1), c = step(one.p, 1, 1, -1);
  const int beyond = step(b, 1, 1, -1), apart = step(step(one.p, 0, 0, -2), 0, 0, -2);
  at(a) = at(b) = at(c) = 0;
  at(one.p) = at(beyond) = at(apart) = 1;
  keep_largest_component(one.lattice);
  CHECK(at(one.p) == 1);
  CHECK(at(beyond) == 1);
  CHECK(at(apart) == -1);
}

}  // namespace test_bcc_stencils
