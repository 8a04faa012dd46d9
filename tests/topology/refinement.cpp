// SPDX-License-Identifier: BSL-1.0
#include <sinew/topology/border.hpp>
#include <sinew/topology/edge_sheets.hpp>
#include <sinew/topology/hexahedra.hpp>
#include <sinew/topology/refinement.hpp>
#include <sinew/topology/regular_grid.hpp>

#include "catch.hpp"
#include "error_of.hpp"

#include <Eigen/Geometry>
#include <map>
#include <random>
#include <set>

namespace test_refinement {

using namespace sinew;
using Eigen::Vector3d;

namespace {

// the integral of det J, of degree two by each coordinate, by two Gauss points a direction
double volume(Hexahedron const& h, std::vector<Vector3d> const& x) {
  Eigen::Matrix<double, 3, 8> corners;
  for (std::size_t k = 0; k < 8; ++k) corners.col(Eigen::Index(k)) = x[std::size_t(h[k])];
  double sum = 0;
  for (int q = 0; q < 8; ++q) {
    Vector3d place;
    for (int c = 0; c < 3; ++c) place[c] = 0.5 + ((q >> c & 1) != 0 ? 0.5 : -0.5) / std::sqrt(3.);
    sum += (corners * MultilinearShape<3>(place).derivatives).determinant() / 8;
  }
  return sum;
}
double volume(Tetrahedron const& t, std::vector<Vector3d> const& x) {
  auto side = [&](std::size_t k) { return Vector3d(x[std::size_t(t[k])] - x[std::size_t(t[0])]); };
  return side(1).dot(side(2).cross(side(3))) / 6;
}
// of a plane one, by the normal z
double area(std::span<Index const> polygon, std::vector<Vector3d> const& x) {
  double sum = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    sum += x[std::size_t(polygon[k])].cross(x[std::size_t(polygon[(k + 1) % polygon.size()])]).z() / 2;
  return sum;
}

TopologyView view(Mesh const& m) {
  return {.edges = m.edges,
          .triangles = m.triangles,
          .quads = m.quads,
          .tetrahedra = m.tetrahedra,
          .hexahedra = m.hexahedra,
          .pyramids = m.pyramids,
          .prisms = m.prisms};
}

// the mesh with the parts in the place of the elements that are refined, behind the others
Mesh refined(Mesh mesh, ElementNumbers const& elements, Refinement& plan) {
  plan = plan_refinement(view(mesh), mesh.positions, elements);
  Renumbering::grown(mesh.positions.size(), plan.parts.points).filter(mesh.positions);
  for_each_kind(mesh, [&](int kind, auto& list) {
    if (kind > int(ElementKind::hexahedron)) return;
    std::vector<bool> stays(list.size(), true);
    for (const Index i : *plan.whole.lists()[std::size_t(kind)]) stays[std::size_t(i)] = false;
    Renumbering::of(stays).filter(list);
    plan.parts.forEach([&](int of, auto const& come) {
      if constexpr (std::is_same_v<std::decay_t<decltype(come)>, std::decay_t<decltype(list)>>)
        if (of == kind) {
          list.insert(list.end(), come.begin(), come.end());
          CHECK(plan.parts.ancestors[std::size_t(kind)].size() == come.size());
        }
    });
  });
  return mesh;
}
Mesh refined(Mesh const& mesh, ElementNumbers const& elements) {
  Refinement plan;
  return refined(mesh, elements, plan);
}

std::set<Edge> sides_of(Mesh const& m) {
  std::set<Edge> sides;
  for (Quad const& q : m.quads) for_each_side(2, q, [&](Edge const& e) { sides.insert(e); });
  for (Hexahedron const& h : m.hexahedra) for_each_side(4, h, [&](Edge const& e) { sides.insert(e); });
  return sides;
}
std::set<Quad> faces_of(Mesh const& m) {
  std::set<Quad> faces;
  for (Hexahedron const& h : m.hexahedra)
    for (auto const& f : hexahedronFaces)
      faces.insert(sorted_corners(Quad{h[f[0]], h[f[1]], h[f[2]], h[f[3]]}));
  return faces;
}
template <class List>
auto keys(List const& list) {
  std::set<typename List::value_type> all;
  for (auto const& e : list) all.insert(sorted_corners(e));
  CHECK(all.size() == list.size());
  return all;
}
// all of one body whose surface is that of the unit cube: a point amid a face or an edge of another element
// would leave a border inside
void check_conforming(Mesh const& m) {
  std::vector<bool> used(m.positions.size(), false);
  for (Hexahedron const& h : m.hexahedra)
    for (const Index i : h) used.at(std::size_t(i)) = true;
  CHECK(std::find(used.begin(), used.end(), false) == used.end());
  std::map<Edge, int> around;
  for (Quad const& q : border_of(m).quads) {
    bool outside = false;
    for (int c = 0; c < 3; ++c)
      for (const double at : {0., 1.}) {
        bool on = true;
        for (const Index i : q) on = on && std::abs(m.positions[std::size_t(i)][c] - at) < 1e-14;
        outside = outside || on;
      }
    CHECK(outside);
    for_each_side(2, q, [&](Edge const& e) { ++around[e]; });
  }
  for (auto const& [edge, faces] : around) CHECK(faces == 2);
}
Mesh cube(int points) { return regular_grid(points, points, points, {0, 0, 0}, {1, 1, 1}); }
// quads of n points each way
Mesh plate(int n) {
  Mesh m;
  for (int i = 0; i < n * n; ++i) m.positions.push_back({double(i % n), double(i / n), 0});
  for (int i = 0; i < n * (n - 1); ++i)
    if (i % n < n - 1) m.quads.push_back({i, i + 1, i + 1 + n, i + n});
  return m;
}

}  // namespace

TEST_CASE("a hexahedron is parted in eight") {
  Mesh m = cube(2);
  Eigen::Matrix3d shape;
  shape << 1, 0.2, 0.1, 0, 2, 0.3, 0.1, 0, 0.7;
  for (Vector3d& x : m.positions) x = shape * x;
  Refinement plan;
  const Mesh fine = refined(m, {.hexahedra = {0}}, plan);
  CHECK(plan.whole.hexahedra == std::vector<Index>{0});
  CHECK(plan.parts.ancestors[4] == std::vector<Index>(8, 0));
  REQUIRE(fine.hexahedra.size() == 8);
  REQUIRE(fine.positions.size() == 27);
  for (Hexahedron const& h : fine.hexahedra)
    CHECK(volume(h, fine.positions) == Approx(shape.determinant() / 8).epsilon(1e-14));
  // each point once, in the middle of what it parts
  std::set<std::array<int, 3>> places;
  for (Vector3d const& x : fine.positions) {
    const Vector3d at = 2 * shape.inverse() * x;
    for (int c = 0; c < 3; ++c) CHECK(std::abs(at[c] - std::round(at[c])) < 1e-14);
    places.insert({int(std::round(at[0])), int(std::round(at[1])), int(std::round(at[2]))});
  }
  CHECK(places.size() == 27);
}

TEST_CASE("parts of a trilinear hexahedron fill it") {
  Mesh m = cube(2);
  std::mt19937 random{3};
  for (Vector3d& x : m.positions)
    for (int c = 0; c < 3; ++c) x[c] += 0.4 * (double(random() >> 5) / double(1u << 27) - 0.5);
  const Mesh fine = refined(m, {});
  Eigen::Matrix<double, 3, 8> corners;
  for (std::size_t k = 0; k < 8; ++k)
    corners.col(Eigen::Index(k)) = m.positions[std::size_t(m.hexahedra[0][k])];
  double sum = 0;
  for (std::size_t part = 0; part < 8; ++part) {
    Hexahedron const& h = fine.hexahedra[part];
    CHECK(volume(h, fine.positions) > 0);
    sum += volume(h, fine.positions);
    for (std::size_t k = 0; k < 8; ++k) {
      Vector3d place;
      for (int c = 0; c < 3; ++c) place[c] = (int(part >> c & 1) + hexahedronCorners[k][c]) / 2.;
      CHECK((fine.positions[std::size_t(h[k])] - corners * MultilinearShape<3>(place).weights).norm() <
            1e-15);
    }
  }
  CHECK(sum == Approx(volume(m.hexahedra[0], m.positions)).epsilon(1e-14));
}

TEST_CASE("with a hexahedron the sheets through it are split, from side to side of the body") {
  const Mesh m = cube(4);
  Refinement plan;
  const Mesh fine = refined(m, {.hexahedra = {13}}, plan);  // that in the middle
  // three layers each way have become four
  CHECK(fine.hexahedra.size() == 64);
  CHECK(fine.positions.size() == 125);
  check_conforming(fine);
  std::map<Index, int> parts;
  for (const Index whole : plan.parts.ancestors[4]) ++parts[whole];
  CHECK(parts[13] == 8);
  CHECK(parts[12] == 4);
  CHECK(parts[9] == 2);
  CHECK(parts.count(0) == 0);
  double sum = 0;
  for (Hexahedron const& h : fine.hexahedra) sum += volume(h, fine.positions);
  CHECK(sum == Approx(1).epsilon(1e-13));
}

TEST_CASE("with a quad the sheets through it are split, and all edges are listed still") {
  Mesh m = plate(4);
  for (Edge const& e : sides_of(m)) m.edges.push_back(e);
  const Mesh fine = refined(m, {.quads = {4}});
  REQUIRE(fine.quads.size() == 16);
  CHECK(fine.positions.size() == 25);
  double sum = 0;
  for (Quad const& q : fine.quads) {
    CHECK(area(q, fine.positions) > 0.25 - 1e-14);
    sum += area(q, fine.positions);
  }
  CHECK(sum == Approx(9).epsilon(1e-14));
  CHECK(keys(fine.edges) == sides_of(fine));
  // a side alone takes its sheet with it
  const auto side = Index(std::find(m.edges.begin(), m.edges.end(), Edge{0, 1}) - m.edges.begin());
  const Mesh strips = refined(m, {.edges = {side}});
  CHECK(strips.quads.size() == 12);
  CHECK(keys(strips.edges) == sides_of(strips));
}

TEST_CASE("a plane quad is parted at the mean of its corners, in the order of these") {
  Mesh m;
  m.positions = {{0, 0, 0}, {4, 1, 0}, {3, 5, 0}, {-1, 2, 0}};
  m.quads = {{0, 1, 2, 3}};
  const Mesh fine = refined(m, {});
  REQUIRE(fine.quads.size() == 4);
  CHECK(fine.positions.back() == Vector3d(1.5, 2, 0));
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) sum += area(fine.quads[k], fine.positions);
  CHECK(sum == Approx(area(m.quads[0], m.positions)).epsilon(1e-15));
  // x fastest, each corner where it was in the whole
  CHECK(fine.quads[0][0] == 0);
  CHECK(fine.quads[1][1] == 1);
  CHECK(fine.quads[3][2] == 2);
  CHECK(fine.quads[2][3] == 3);
}

TEST_CASE("triangles and quads that share edges are refined together") {
  Mesh m;  // triangle, quad, quad, triangle in a row
  m.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {-1, 0, 0}, {3, 0, 0}};
  m.quads = {{0, 1, 4, 3}, {1, 2, 5, 4}};
  m.triangles = {{6, 0, 3}, {2, 7, 5}};
  for (Edge const& e : sides_of(m)) m.edges.push_back(e);
  for (Edge const e : {Edge{0, 6}, Edge{3, 6}, Edge{2, 7}, Edge{5, 7}}) m.edges.push_back(e);
  Refinement plan;
  const Mesh fine = refined(m, {.triangles = {0}}, plan);
  // one in four, the quads across, and the other triangle at the end of the sheet
  CHECK(fine.triangles.size() == 4 + 2);
  CHECK(fine.quads.size() == 4);
  double sum = 0;
  std::set<Edge> sides = sides_of(fine);
  for (Triangle const& t : fine.triangles) {
    sum += area(t, fine.positions);
    for_each_side(1, t, [&](Edge const& e) { sides.insert(e); });
  }
  for (Quad const& q : fine.quads) sum += area(q, fine.positions);
  CHECK(sum == Approx(3).epsilon(1e-15));
  CHECK(keys(fine.edges) == sides);
  CHECK(fine.positions.size() == m.positions.size() + 5);
}

TEST_CASE("a tetrahedron that is refined splits the sheets of the hexahedra at its edges") {
  Mesh m = regular_grid(3, 2, 2, {0, 0, 0}, {2, 1, 1});
  // beside the edge at x = 0, z = 1
  const auto at = [&](Vector3d const& x) {
    return Index(std::find(m.positions.begin(), m.positions.end(), x) - m.positions.begin());
  };
  m.positions.push_back({-1, 0.5, 2});
  m.positions.push_back({-1, 0.5, 1});
  m.tetrahedra = {{at({0, 0, 1}), at({0, 1, 1}), 12, 13}};
  if (volume(m.tetrahedra[0], m.positions) < 0) std::swap(m.tetrahedra[0][2], m.tetrahedra[0][3]);
  const double whole = volume(m.tetrahedra[0], m.positions);
  const Mesh fine = refined(m, {.tetrahedra = {0}});
  CHECK(fine.tetrahedra.size() == 8);
  CHECK(fine.hexahedra.size() == 4);
  double sum = 0;
  for (Tetrahedron const& t : fine.tetrahedra) sum += volume(t, fine.positions);
  CHECK(sum == Approx(whole).epsilon(1e-15));
  // and the other way round
  const Mesh other = refined(m, {.hexahedra = {1}});
  CHECK(other.hexahedra.size() == 8 + 4);
  CHECK(other.tetrahedra.size() == 2);
}

TEST_CASE("a sheet may cross itself, and turn over") {
  // from side 0 1 to 3 2, 5 4, 7 6 and 2 1, across the first quad again
  Mesh m;
  m.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 2, 1}, {0, 2, 1}, {2, 1, 2}, {2, 2, 2}};
  m.quads = {{0, 1, 2, 3}, {3, 2, 4, 5}, {5, 4, 6, 7}, {7, 6, 1, 2}};
  Refinement plan;
  CHECK(refined(m, {.quads = {1}}, plan).quads.size() == 4 + 4 + 2 + 2);
  CHECK(plan.parts.ancestors[2] == std::vector<Index>{0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 3, 3});
  // the same with a thickness, and no edge across split
  for (int i = 0; i < 8; ++i) m.positions.push_back(m.positions[std::size_t(i)] + Vector3d(0, -0.1, 1));
  for (Quad const& q : m.quads)
    m.hexahedra.push_back({q[0], q[1], q[2], q[3], q[0] + 8, q[1] + 8, q[2] + 8, q[3] + 8});
  m.edges = {{0, 1}};
  const Mesh solid = refined(m, {.edges = {0}}, plan);
  CHECK(plan.parts.ancestors[4] == std::vector<Index>{0, 0, 0, 0, 1, 1, 2, 2, 3, 3});
  CHECK(solid.quads.size() == 10);
  CHECK(keys(solid.hexahedra).size() == 10);

  Mesh moebius;
  for (int i = 0; i < 3; ++i) {
    const double a = 2 * M_PI / 3 * i, half = M_PI / 3 * i;
    const Vector3d out(std::cos(a), std::sin(a), 0),
        across = std::cos(half) * out + std::sin(half) * Vector3d::UnitZ();
    moebius.positions.push_back(3 * out - across);
    moebius.positions.push_back(3 * out + across);
  }
  moebius.quads = {{0, 2, 3, 1}, {2, 4, 5, 3}, {4, 1, 0, 5}};
  const Mesh finer = refined(moebius, {.quads = {0}});
  CHECK(finer.quads.size() == 4 + 2 + 2);
  std::map<Edge, int> around;
  for (Quad const& q : finer.quads) for_each_side(2, q, [&](Edge const& e) { ++around[e]; });
  int rim = 0;
  for (auto const& [edge, quads] : around) rim += quads == 1;
  CHECK(rim == 6 + 2);
}

TEST_CASE("whichever hexahedra are refined, again and again, the body is whole") {
  std::mt19937 random{5};
  for (int run = 0; run < (brief ? 2 : 12); ++run) {
    Mesh m = cube(3 + run % 2);
    // inner points anywhere near; others in their plane
    for (Vector3d& x : m.positions)
      for (int c = 0; c < 3; ++c)
        if (x[c] > 0.1 && x[c] < 0.9) x[c] += 0.1 * (double(random() >> 5) / double(1u << 27) - 0.5);
    for (Edge const& e : sides_of(m)) m.edges.push_back(e);
    for (Quad const& q : border_of(m).quads) m.quads.push_back(q);
    const bool allFaces = run % 3 == 0;
    if (allFaces) {
      m.quads.clear();
      for (Hexahedron const& h : m.hexahedra)
        for (auto const& f : hexahedronFaces) {
          const Quad face{h[f[0]], h[f[1]], h[f[2]], h[f[3]]};
          if (std::none_of(m.quads.begin(), m.quads.end(), [&](Quad const& q) {
                return sorted_corners(q) == sorted_corners(face);
              }))
            m.quads.push_back(face);
        }
    }
    for (int round = 0; round < 3; ++round) {
      ElementNumbers some;
      for (int k = 0; k < 2; ++k) some.hexahedra.push_back(Index(random() % m.hexahedra.size()));
      Refinement plan;
      const Mesh fine = refined(m, some, plan);
      check_conforming(fine);
      std::vector<double> left(m.hexahedra.size());
      for (std::size_t k = 0; k < plan.parts.hexahedra.size(); ++k) {
        const double part = volume(plan.parts.hexahedra[k], fine.positions);
        CHECK(part > 0);
        left[std::size_t(plan.parts.ancestors[4][k])] += part;
      }
      for (const Index h : plan.whole.hexahedra)
        CHECK(left[std::size_t(h)] ==
              Approx(volume(m.hexahedra[std::size_t(h)], m.positions)).epsilon(1e-13));
      CHECK(keys(fine.edges) == sides_of(fine));
      CHECK(keys(fine.hexahedra).size() == fine.hexahedra.size());
      if (allFaces)
        CHECK(keys(fine.quads) == faces_of(fine));
      else
        CHECK(keys(fine.quads) == keys(border_of(fine).quads));
      m = fine;
      if (m.hexahedra.size() > 2000) break;
    }
  }
}

TEST_CASE("halves of quads and their diagonals are refined with these, as grids list them") {
  for (const int points : {2, 3, 4}) {
    Mesh m = cube(points);
    std::set<Quad> faces;
    std::set<Edge> sides;
    for_each_quad_face({.hexahedra = m.hexahedra}, [&](Quad const& f) {
      if (!faces.insert(sorted_corners(f)).second) return;
      m.quads.push_back(f);
      m.triangles.push_back({f[0], f[1], f[2]});
      m.triangles.push_back({f[0], f[2], f[3]});
    });
    auto sidesOf = [](Mesh const& mesh) {
      std::set<Edge> all = sides_of(mesh);
      for (Triangle const& t : mesh.triangles) for_each_side(1, t, [&](Edge const& e) { all.insert(e); });
      return all;
    };
    for (Edge const& e : sidesOf(m)) m.edges.push_back(e);
    for (auto const& some : {ElementNumbers{.hexahedra = {0}},
                             ElementNumbers{.triangles = {3}},
                             ElementNumbers{.edges = {Index(m.edges.size()) / 2}},
                             ElementNumbers{}}) {
      const Mesh fine = refined(m, some);
      check_conforming(fine);
      CHECK(keys(fine.quads) == faces_of(fine));
      CHECK(keys(fine.edges) == sidesOf(fine));
      // each side of the cube is covered once, by as many triangles on each edge as there are
      double area = 0;
      std::map<Edge, int> around;
      for (Triangle const& t : fine.triangles) {
        auto at = [&](std::size_t k) { return fine.positions[std::size_t(t[k])]; };
        if (at(0).z() != 0 || at(1).z() != 0 || at(2).z() != 0) continue;
        area += (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
        for_each_side(1, t, [&](Edge const& e) { ++around[e]; });
      }
      CHECK(area == Approx(1).epsilon(1e-14));
      double rim = 0;
      for (auto const& [e, count] : around)
        if (count == 1)
          rim += (fine.positions[std::size_t(e[0])] - fine.positions[std::size_t(e[1])]).norm();
        else
          CHECK(count == 2);
      CHECK(rim == Approx(4).epsilon(1e-14));
      // all were refined: two halves for each quad
      if (some.lists()[4]->empty() && some.triangles.empty() && some.edges.empty())
        CHECK(fine.triangles.size() == 2 * fine.quads.size());
    }
  }
  // a diagonal without its halves would lose its quads
  Mesh crossed = plate(2);
  crossed.edges = {{0, 3}, {0, 1}};
  CHECK(error_of([&] { refined(crossed, {.edges = {1}}); }) ==
        "edge 0 lies across quad 0, which would be parted; put it into a topology of its own");
  const Mesh split = refined(crossed, {.edges = {0}});
  CHECK(split.positions.size() == 9);
  CHECK(split.quads.size() == 4);
  CHECK(split.edges == std::vector<Edge>{{0, 8}, {8, 3}, {0, split.edges[2][1]}, {split.edges[2][1], 1}});
}

TEST_CASE("values that cannot be weighed are those of a corner") {
  Mesh m = cube(2);
  const Refinement plan = plan_refinement(view(m), m.positions, {});
  std::vector<int> values{0, 1, 2, 3, 4, 5, 6, 7};
  const Renumbering points = Renumbering::grown(8, plan.parts.points);
  points.filter(values);
  REQUIRE(values.size() == 27);
  for (const int v : values) CHECK((v >= 0 && v < 8));
  // and points that come may be numbered again, with what comes of them
  std::vector<bool> stays(27, true);
  stays[0] = false;
  const Renumbering both = points.then(Renumbering::of(stays));
  std::vector<double> x;
  for (Vector3d const& p : m.positions) x.push_back(p.x());
  std::vector<double> after = x, atOnce = x;
  points.filter(after);
  Renumbering::of(stays).filter(after);
  both.filter(atOnce);
  CHECK(atOnce == after);
  // a new point that goes, of which none has come
  const auto edges = Renumbering::grown(2, {{0, 1, 0.5}, {0, 1, 0.25}, {2, 3, 0.5}, {3, 1, 0.5}});
  const auto fewer = edges.then(Renumbering::of({true, true, false, true, false, true}));
  std::vector<double> ends{0, 8};
  fewer.filter(ends);
  CHECK(ends == std::vector<double>{0, 8, 2, 5});
}

TEST_CASE("values of elements come with the parts, one kind after the other") {
  TopologyChange change;
  change.elements[1] = Renumbering::grown(2, {{1, 1, 0}, {1, 1, 0}});
  change.elements[2] = Renumbering::grown(2, {{0, 0, 0}, Origin::none()});
  std::vector<double> values{1, 2, 30, 40};
  change.ofDimension(2, 4).filter(values);
  CHECK(values == std::vector<double>{1, 2, 2, 2, 30, 40, 30, 0});
  // two for each quad, which are parted into triangles
  std::vector<double> halves{1, 2, 30, 31, 40, 41};
  change.ofDimension(2, 6).filter(halves);
  CHECK(halves == std::vector<double>{1, 2, 2, 2, 30, 31, 40, 41, 30, 31, 0, 0});
  // rows, and hexahedra beside others that stay
  TopologyChange solid;
  solid.elements[4] = Renumbering::grown(1, {{0, 0, 0}});
  solid.elements[6] = Renumbering::grown(1, {});
  std::vector<int> rows{1, 2, 3, 4};
  solid.ofDimension(3, 2).filterRows(rows, 2);
  CHECK(rows == std::vector<int>{1, 2, 1, 2, 3, 4});
}

TEST_CASE("what cannot be refined is refused") {
  auto refuse = [](Mesh const& m, ElementNumbers const& elements) {
    return error_of([&] { plan_refinement(view(m), m.positions, elements); });
  };
  Mesh m = cube(2);
  CHECK(refuse(m, {.hexahedra = {1}}) == "there is no hexahedron 1 to refine: there are 1, numbered from 0");
  CHECK(refuse(m, {.quads = {-1}}) == "there is no quad -1 to refine: there are 0, numbered from 0");
  // on its upper face
  m.positions.push_back({0.5, 0.5, 2});
  m.pyramids = {{m.hexahedra[0][4], m.hexahedra[0][5], m.hexahedra[0][6], m.hexahedra[0][7], 8}};
  const std::string others =
      " would be parted, and elements of its kind are not refined while a scene runs; refine others, that "
      "have none of its edges, or the mesh before";
  CHECK(refuse(m, {.hexahedra = {0}}) == "pyramid 0" + others);
  CHECK(refuse(m, {.pyramids = {0}}) == "pyramid 0" + others);
  m.pyramids.clear();
  m.positions.pop_back();
  Mesh crossed = m;
  crossed.edges = {{m.hexahedra[0][0], m.hexahedra[0][6]}};
  CHECK(refuse(crossed, {.edges = {0}}) ==
        "edge 0 7 goes through hexahedron 0 from corner to corner, and would be split; refine other elements "
        "than those with this edge, or put them into a topology of their own");
  CHECK(refuse(crossed, {.hexahedra = {0}}) ==
        "edge 0 lies across hexahedron 0, which would be parted; put it into a topology of its own");
  Mesh flat = m;
  flat.hexahedra[0][7] = flat.hexahedra[0][6];
  CHECK(refuse(flat, {.hexahedra = {0}}) ==
        text("hexahedron 0 would be parted, and has point ", flat.hexahedra[0][6], " twice; correct it"));
}

}  // namespace test_refinement
