// SPDX-License-Identifier: BSL-1.0
// Surfaces that a body carries are parted where the body is cut.
#include "../topology/cut_bodies.hpp"

#include <sinew/contact.hpp>
#include <sinew/mechanics.hpp>

#include <map>

namespace test_cutting_carried {

using namespace cutting;

namespace {

/// The skin of a block of nx * ny * nz m, n squares a metre, two triangles each, moved outwards by a bulge.
Mesh fine_skin(int nx, int ny, int nz, int n, double bulge) {
  Mesh m;
  std::map<std::array<int, 3>, Index> numbers;
  const int size[3] = {n * nx, n * ny, n * nz};
  auto number = [&](std::array<int, 3> const& k) {
    const auto [entry, fresh] = numbers.try_emplace(k, Index(m.positions.size()));
    if (fresh) {
      Point p(double(k[0]) / n, double(k[1]) / n, double(k[2]) / n);
      const Point middle(nx / 2., ny / 2., nz / 2.);
      m.positions.push_back(p + bulge * (p - middle));
    }
    return entry->second;
  };
  for (int c = 0; c < 3; ++c)
    for (const int side : {0, 1}) {
      const int u = (c + 1) % 3, v = (c + 2) % 3;
      for (int j = 0; j < size[v]; ++j)
        for (int i = 0; i < size[u]; ++i) {
          auto at = [&](int di, int dj) {
            std::array<int, 3> k{};
            k[std::size_t(c)] = side * size[c];
            k[std::size_t(u)] = i + di;
            k[std::size_t(v)] = j + dj;
            return number(k);
          };
          Quad q{at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
          if (side == 0) std::swap(q[1], q[3]);
          m.triangles.push_back({q[0], q[1], q[2]});
          m.triangles.push_back({q[0], q[2], q[3]});
        }
    }
  return m;
}
double area(std::vector<Point> const& x, std::vector<Triangle> const& triangles) {
  double sum = 0;
  for (auto const& t : triangles) {
    auto at = [&](std::size_t k) { return x[std::size_t(t[k])]; };
    sum += (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
  }
  return sum;
}
/// Of each point the piece to which it belongs.
template <std::size_t N>
std::vector<int> piece_of(std::size_t points, std::vector<std::array<Index, N>> const& elements) {
  std::vector<int> piece(points, -1);
  int count = 0;
  for (bool any = true; any;) {
    any = false;
    for (auto const& e : elements)
      if (piece[std::size_t(e[0])] < 0) {
        any = true;
        piece[std::size_t(e[0])] = count;
        for (bool more = true; more;) {
          more = false;
          for (auto const& f : elements) {
            bool has = false, all = true;
            for (const Index i : f)
              has = has || piece[std::size_t(i)] == count, all = all && piece[std::size_t(i)] == count;
            if (!has || all) continue;
            more = true;
            for (const Index i : f) piece[std::size_t(i)] = count;
          }
        }
        ++count;
        break;
      }
  }
  return piece;
}

auto scene(Body const& b, Mesh const& skin, CuttingManager const& manager, std::vector<Point> const& blade) {
  return Simulation{node<"root">(
      DefaultPipeline{},
      BruteForceBroadPhase{},
      BVHNarrowPhase{},
      MinProximityIntersection{.alarmDistance = 1e-6, .contactDistance = 1e-7},
      DefaultContactManager{},
      manager,
      node<"body">(EulerImplicitSolver{.rayleighMass = 1},
                   CGLinearSolver<>{.iterations = 100, .tolerance = 1e-10, .threshold = 1e-20},
                   MeshTopology{.tetrahedra = b.tetrahedra},
                   MechanicalObject<Vec3d>{.position = b.points},
                   DiagonalMass<Vec3d>{.massDensity = 1},
                   TetrahedronFEMForceField<Vec3d>{.youngModulus = {100}, .poissonRatio = 0.3},
                   node<"skin">(MechanicalObject<Vec3d>{.position = skin.positions},
                                MeshTopology{.triangles = skin.triangles},
                                BarycentricMapping<Vec3d, Vec3d>{},
                                TriangleCollisionModel<Vec3d>{.selfCollision = false},
                                node<"copy">(VisualModel{skin}, IdentityMapping<Vec3d, Vec3f>{})),
                   node<"look">(VisualModel{skin}, BarycentricMapping<Vec3d, Vec3f>{})),
      node<"tool">(MechanicalObject<Vec3d>{.position = blade}))};
}

/// Each triangle goes with one piece of the body, and all of it: the pieces are moved apart, and none is
/// stretched.
template <class Mapping, class VecCoord>
void check_parted(std::vector<Point> const& body, std::vector<int> const& piece, Mapping const& mapping,
                  VecCoord now, std::vector<Triangle> const& triangles, double tolerance) {
  auto moved = body;
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += piece[i] * Point(5, 7, 9);
  VecCoord then = now;
  mapping.apply(then, moved);
  mapping.apply(now, body);
  double worst = 0;
  for (auto const& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i = std::size_t(t[k]), j = std::size_t(t[(k + 1) % 3]);
      worst = std::max(worst, double(((then[i] - now[i]) - (then[j] - now[j])).norm()));
    }
  CHECK(worst < tolerance);
}
template <class Sim>
void check_all(Sim& sim, double areaBefore, int expected) {
  auto& body = sim.template at<"body">();
  auto& skin = sim.template at<"body/skin">();
  auto const& x = body.state().restPosition;
  const auto piece = piece_of(x.size(), body.template get<MeshTopology>().tetrahedra);
  CHECK(1 + *std::max_element(piece.begin(), piece.end()) == expected);
  auto const& triangles = skin.template get<MeshTopology>().triangles;
  auto const& given = *skin.state().given;
  CHECK(area(given, triangles) == Approx(areaBefore).epsilon(1e-10));
  CHECK(pieces(given.size(), triangles) == expected);
  check_parted(x,
               piece,
               skin.template get<BarycentricMapping<Vec3d, Vec3d>>(),
               skin.state().position,
               triangles,
               1e-9);
  CHECK(sim.template at<"body/skin/copy">().visual().mesh.triangles == triangles);
  auto& look = sim.template at<"body/look">();
  // (its vertices are in single precision, and so its cut is another one by rounding)
  CHECK(area(look.visual().mesh.positions, look.visual().mesh.triangles) ==
        Approx(areaBefore).epsilon(1e-10));
  CHECK(pieces(look.visual().size(), look.visual().mesh.triangles) == expected);
  check_parted(x,
               piece,
               look.template get<BarycentricMapping<Vec3d, Vec3f>>(),
               look.visual().position,
               look.visual().mesh.triangles,
               1e-4);
}

}  // namespace

TEST_CASE(
    "the skin that a body carries is parted with it, whole or bit by bit, also where it is beside the body") {
  for (const double bulge : {0., 0.05})
    for (const double jitter : {0., 0.15}) {
      INFO("bulge " << bulge << ", jitter " << jitter);
      const Body b = block(4, 2, 2, jitter);
      const Mesh skin = fine_skin(4, 2, 2, 4, bulge);
      const double before = area(skin.positions, skin.triangles);
      auto sim =
          scene(b, skin, {.active = false, .toolModel = "tool", .bodyModel = "body"}, {{0, 0, 9}, {0, 1, 9}});
      sim.init();
      check_all(sim, before, 1);
      sim.cut("body", {{Point(2.1, -1, -1), Point(2.3, -1, 3)}, {Point(1.8, 3, -1), Point(2.0, 3, 3)}});
      check_all(sim, before, 2);
      sim.cut("body", {{Point(-1, -1, 1.1), Point(-1, 3, 1.2)}, {Point(5, -1, 1.1), Point(5, 3, 1.2)}});
      check_all(sim, before, 4);
      sim.animate(0.01);

      auto slow =
          scene(b, skin, {.toolModel = "tool", .bodyModel = "body"}, {{2.1, -0.7, -1}, {2.3, -0.7, 3}});
      slow.init();
      slow.animate(1e-6);
      for (int i = 0; i < 20; ++i) {
        for (auto& p : slow.at<"tool">().state().position) p[1] += 0.2;
        slow.animate(1e-6);
        auto& s = slow.at<"body/skin">();
        CHECK(area(*s.state().given, s.get<MeshTopology>().triangles) == Approx(before).epsilon(1e-10));
      }
      CHECK(slow.root().get<CuttingManager>().refused == 0);
      check_all(slow, before, 2);
    }
}

TEST_CASE("a blade that stops leaves the skin in one piece, which opens behind it") {
  const Body b = block(4, 2, 2);
  const Mesh skin = fine_skin(4, 2, 2, 4, 0);
  auto sim =
      scene(b, skin, {.active = false, .toolModel = "tool", .bodyModel = "body"}, {{0, 0, 9}, {0, 1, 9}});
  sim.init();
  sim.cut("body", {{Point(2.1, -1, -1), Point(2.1, -1, 3)}, {Point(2.1, 1.1, -1), Point(2.1, 1.1, 3)}});
  auto& s = sim.at<"body/skin">();
  CHECK(pieces(s.state().size(), s.get<MeshTopology>().triangles) == 1);
  CHECK(s.state().size() > skin.positions.size() + 10);
}

TEST_CASE("what a sheet carries is parted with it") {
  Mesh coarse, fine;
  for (auto [mesh, n] : {std::pair(&coarse, 4), std::pair(&fine, 13)}) {
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) mesh->positions.emplace_back(4. * i / n, 4. * j / n, 0);
    auto at = [n = n](int i, int j) { return Index(i + (n + 1) * j); };
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        mesh->triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        mesh->triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
  }
  for (auto& p : fine.positions) p[2] = 0.05;
  Simulation sim{
      node<"root">(EulerExplicitSolver{},
                   node<"sheet">(MeshTopology{.triangles = coarse.triangles},
                                 MechanicalObject<Vec3d>{.position = coarse.positions},
                                 DiagonalMass<Vec3d>{.totalMass = 1},
                                 TriangleFEMForceField<Vec3d>{.youngModulus = {100}},
                                 node<"look">(VisualModel{fine}, BarycentricMapping<Vec3d, Vec3f>{})))};
  sim.init();
  sim.cut("sheet", {{Point(1.7, -1, -1), Point(1.7, -1, 1)}, {Point(2.2, 5, -1), Point(2.2, 5, 1)}});
  auto& node = sim.at<"sheet">();
  auto& look = sim.at<"sheet/look">();
  auto const& x = node.state().restPosition;
  const auto piece = piece_of(x.size(), node.get<MeshTopology>().triangles);
  CHECK(pieces(x.size(), node.get<MeshTopology>().triangles) == 2);
  CHECK(pieces(look.visual().size(), look.visual().mesh.triangles) == 2);
  CHECK(area(look.visual().mesh.positions, look.visual().mesh.triangles) == Approx(16).epsilon(1e-10));
  check_parted(x,
               piece,
               look.get<BarycentricMapping<Vec3d, Vec3f>>(),
               look.visual().position,
               look.visual().mesh.triangles,
               1e-4);
}

TEST_CASE("what cannot follow a body that is cut is an error, and nothing has changed") {
  const Body b = block(2, 2, 2);
  const Mesh skin = fine_skin(2, 2, 2, 3, 0);
  Simulation sim{node<"root">(
      EulerExplicitSolver{},
      node<"body">(
          MeshTopology{.tetrahedra = b.tetrahedra},
          MechanicalObject<Vec3d>{.position = b.points},
          DiagonalMass<Vec3d>{.massDensity = 1},
          TetrahedronFEMForceField<Vec3d>{.youngModulus = {100}, .poissonRatio = 0.3},
          node<"skin">(MechanicalObject<Vec3d>{.position = skin.positions},
                       MeshTopology{.triangles = skin.triangles},
                       BarycentricMapping<Vec3d, Vec3d>{},
                       DiagonalMass<Vec3d>{.vertexMass = std::vector<double>(skin.positions.size(), 1)})))};
  sim.init();
  CHECK_THROWS_AS(sim.cut("body", Plane{0.9}.blade(-1, 3, -1, 3)), Error);
  CHECK(sim.at<"body">().state().size() == b.points.size());
  CHECK(sim.at<"body/skin">().state().size() == skin.positions.size());
}

}  // namespace test_cutting_carried
