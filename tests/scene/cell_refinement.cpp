// SPDX-License-Identifier: BSL-1.0
// Quads and hexahedra that are refined while a scene runs.
#include <sinew/contact.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/topology/border.hpp>
#include <sinew/topology/edge_sheets.hpp>
#include <sinew/topology/refinement.hpp>
#include <sinew/topology/regular_grid.hpp>
#include <sinew/topology/subdivision.hpp>

#include "catch.hpp"
#include "error_of.hpp"

#include <Eigen/Geometry>
#include <random>
#include <set>

namespace test_cell_refinement {

using namespace sinew;
using Catch::Matchers::Contains;
using Eigen::Vector3d;

namespace {

Mesh block_of(int n) { return regular_grid(n, n, n, {0, 0, 0}, {1, 1.1, 1.3}); }

auto solver() { return CGLinearSolver<>{.iterations = 500, .tolerance = 1e-15, .threshold = 1e-30}; }

template <class Mass>
auto scene(Mesh const& block, Mass const& mass, std::vector<int> const& fixed = {}, double gravity = 0) {
  const std::vector<Quad> skin = border_of(block).quads;
  std::vector<Triangle> halves;
  for (Quad const& q : skin) {
    halves.push_back({q[1], q[2], q[0]});
    halves.push_back({q[3], q[0], q[2]});
  }
  return Simulation{node<"root">(
      Gravity{{0, gravity, 0}},
      EulerImplicitSolver{},
      solver(),
      DefaultPipeline{},
      BruteForceBroadPhase{},
      BVHNarrowPhase{},
      MinProximityIntersection{.alarmDistance = 0.02, .contactDistance = 0.01},
      DefaultContactManager{},
      node<"body">(
          MeshTopology{.hexahedra = block.hexahedra},
          MechanicalObject<Vec3d>{.position = block.positions},
          mass,
          HexahedronFEMForceField<Vec3d>{.youngModulus = {100}, .poissonRatio = 0.3},
          FixedConstraint<Vec3d>{.indices = fixed},
          TriangleCollisionModel<Vec3d>{.selfCollision = false},
          node<"skin">(MeshTopology{.quads = skin}, node<"halves">(MeshTopology{.triangles = halves})),
          node<"look">(VisualModel{Mesh{.positions = block.positions, .quads = skin}},
                       IdentityMapping<Vec3d, Vec3f>{}),
          node<"marks">(MechanicalObject<Vec3d>{.position = {{0.2, 0.3, 0.4}, {0.9, 0.6, 1.2}}},
                        BarycentricMapping<Vec3d, Vec3d>{})))};
}
DiagonalMass<Vec3d> diagonal() { return {.massDensity = 3}; }

double total(std::vector<double> const& mass) {
  double sum = 0;
  for (const double m : mass) sum += m;
  return sum;
}
template <class M, class Sim>
Vector3d momentum(Sim& sim) {
  auto& body = sim.template at<"body">();
  auto const& state = body.state();
  std::vector<Vector3d> product(state.size(), Vector3d::Zero());
  body.template get<M>().addMDx(product, state.position, state.velocity, 1);
  Vector3d sum = Vector3d::Zero();
  for (Vector3d const& p : product) sum += p;
  return sum;
}
// a number by the place of a point at rest
struct ByPlace {
  std::vector<Vector3d> const& rest;
  std::size_t operator()(Vector3d const& place) const {
    for (std::size_t i = 0; i < rest.size(); ++i)
      if ((rest[i] - place).norm() < 1e-12) return i;
    FAIL("no point at " << place.transpose());
    return 0;
  }
};

}  // namespace

TEST_CASE("all hexahedra of a body in motion are refined: mass, momentum and energy stay, and all follows") {
  const Mesh block = block_of(3);
  auto sim = scene(block, diagonal());
  sim.init();
  auto& body = sim.at<"body">();
  // a motion without strain: what lies between points moves with them
  const Vector3d spin(0.3, -0.2, 0.5), speed(1, 2, 3);
  for (std::size_t i = 0; i < body.state().size(); ++i)
    body.state().velocity[i] = speed + spin.cross(body.state().position[i]);
  const Vector3d before = momentum<DiagonalMass<Vec3d>>(sim);
  const double mass = total(body.get<DiagonalMass<Vec3d>>().lumped.mass);
  const auto marks = sim.at<"body/marks">().state().position;
  const TopologyChange change = sim.refineElements("body");
  auto const& state = body.state();
  auto const& mesh = body.get<MeshTopology>();
  CHECK(mesh.hexahedra.size() == 64);
  CHECK(change.of(ElementKind::hexahedron).kept.empty());
  CHECK(change.of(ElementKind::hexahedron).come.size() == 64);
  CHECK(change.points.kept.size() == 27);
  CHECK(state.size() == 125);
  CHECK(change.points.size() == 125);
  CHECK(total(body.get<DiagonalMass<Vec3d>>().lumped.mass) == Approx(mass).epsilon(1e-13));
  CHECK((momentum<DiagonalMass<Vec3d>>(sim) - before).norm() < 1e-13 * before.norm());
  CHECK(sim.potentialEnergy() == Approx(0).margin(1e-12));
  for (std::size_t i = 0; i < state.size(); ++i)
    CHECK((state.velocity[i] - speed - spin.cross(state.position[i])).norm() < 1e-14);
  // 6 sides of 16
  CHECK(sim.at<"body/skin">().get<MeshTopology>().quads.size() == 96);
  CHECK(sim.at<"body/skin/halves">().get<MeshTopology>().triangles.size() == 192);
  CHECK(sim.at<"body/look">().visual().mesh.quads.size() == 96);
  CHECK(sim.at<"body/look">().visual().mesh.positions.size() == 125);
  CHECK(body.get<TriangleCollisionModel<Vec3d>>().surface.size() == 192);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK((sim.at<"body/marks">().state().position[i] - marks[i]).norm() < 1e-14);
    CHECK((sim.at<"body/marks">().state().velocity[i] - speed - spin.cross(marks[i])).norm() < 1e-13);
  }
  sim.animate(0.01);
  CHECK((momentum<DiagonalMass<Vec3d>>(sim) - before).norm() < 1e-11 * before.norm());
}

TEST_CASE("momentum and kinetic energy of a consistent mass stay, whatever moves and is refined") {
  auto sim = scene(block_of(3), MeshMatrixMass<Vec3d>{.massDensity = {2}});
  sim.init();
  auto& body = sim.at<"body">();
  std::mt19937 random{4};
  auto noise = [&] { return double(random() >> 5) / double(1u << 27) - 0.5; };
  for (auto& v : body.state().velocity) v = {noise(), noise(), noise()};
  const Vector3d before = momentum<MeshMatrixMass<Vec3d>>(sim);
  const double energy = sim.kineticEnergy();
  for (int round = 0; round < 3; ++round) {
    sim.refineElements("body", {.hexahedra = {Index(random() % body.get<MeshTopology>().hexahedra.size())}});
    CHECK((momentum<MeshMatrixMass<Vec3d>>(sim) - before).norm() < 1e-13 * before.norm());
    CHECK(sim.kineticEnergy() == Approx(energy).epsilon(1e-13));
  }
  CHECK(body.get<MeshTopology>().hexahedra.size() > 8 + 3 * 4);
}

TEST_CASE("a body that is turned and refined bears no force, and falls as one") {
  const Mesh block = block_of(3);
  auto sim = scene(block, diagonal(), {}, -9.81);
  sim.init();
  auto& state = sim.at<"body">().state();
  const Eigen::Matrix3d turn(Eigen::AngleAxisd(2, Vector3d(1, 2, -1).normalized()));
  for (std::size_t i = 0; i < state.size(); ++i) {
    state.position[i] = turn * state.position[i] + Vector3d(1, 2, 3);
    state.velocity[i] = {0, -4, 0};
  }
  sim.refineElements("body", {.hexahedra = {5}});
  CHECK(state.size() > block.positions.size());
  CHECK(sim.potentialEnergy() == Approx(0).margin(1e-20));
  auto& force = sim.at<"body">().get<HexahedronFEMForceField<Vec3d>>();
  std::vector<Vector3d> f(state.size(), Vector3d::Zero());
  add_force(force, {}, f, state.position, state.velocity);
  for (Vector3d const& one : f) CHECK(one.norm() < 1e-12 * 100);
  for (int i = 0; i < 5; ++i) sim.animate(0.01);
  for (std::size_t i = 0; i < state.size(); ++i) {
    CHECK((state.velocity[i] - Vector3d(0, -4 - 9.81 * 0.05, 0)).norm() < 1e-11);
    CHECK((turn.transpose() * (state.position[i] - state.position[0]) -
           (state.restPosition[i] - state.restPosition[0]))
              .norm() < 1e-11);
  }
}

TEST_CASE("the strain energy of a body that is deformed evenly stays, with a material for each hexahedron") {
  auto sim = scene(block_of(3), diagonal());
  sim.init();
  auto& body = sim.at<"body">();
  auto& force = body.get<HexahedronFEMForceField<Vec3d>>();
  force.youngModulus = {100, 200, 300, 400, 500, 600, 700, 800};
  sim.init();
  Eigen::Matrix3d stretch;
  stretch << 1.02, 0.01, 0, 0.01, 0.98, 0.005, 0, 0.005, 1.01;
  for (auto& x : body.state().position) x = stretch * x;
  const double energy = sim.potentialEnergy();
  REQUIRE(energy > 1e-3);
  const TopologyChange change = sim.refineElements("body", {.hexahedra = {3}});
  auto const& r = change.of(ElementKind::hexahedron);
  REQUIRE(force.youngModulus.size() == r.size());
  for (std::size_t k = 0; k < r.come.size(); ++k)
    CHECK(force.youngModulus[r.kept.size() + k] == 100 * (r.come[k].a + 1));
  CHECK(sim.potentialEnergy() == Approx(energy).epsilon(1e-12));
  sim.refineElements("body");
  CHECK(sim.potentialEnergy() == Approx(energy).epsilon(1e-12));
}

TEST_CASE("a bar that is refined bends as one that was fine from the start") {
  const Mesh coarse = regular_grid(4, 2, 2, {0, 0, 0}, {3, 1, 1}), fine = subdivide(coarse);
  auto held = [](Mesh const& m) {
    std::vector<int> all;
    for (std::size_t i = 0; i < m.positions.size(); ++i)
      if (m.positions[i].x() == 0) all.push_back(int(i));
    return all;
  };
  auto refined = scene(coarse, diagonal(), held(coarse), -2), same = scene(fine, diagonal(), held(fine), -2);
  refined.init(), same.init();
  refined.refineElements("body");
  auto const &a = refined.at<"body">().state(), &b = same.at<"body">().state();
  REQUIRE(a.size() == b.size());
  CHECK(refined.at<"body">().get<FixedConstraint<Vec3d>>().indices.size() == 9);
  for (int i = 0; i < 20; ++i) refined.animate(0.02), same.animate(0.02);
  const ByPlace find{b.restPosition};
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK((a.position[i] - b.position[find(a.restPosition[i])]).norm() < 1e-9);
    most = std::max(most, (a.position[i] - a.restPosition[i]).norm());
  }
  CHECK(most > 0.1);
}

TEST_CASE("tetrahedra into which hexahedra are split have their values, and UniformMass keeps its total") {
  const Mesh bar = regular_grid(3, 2, 2, {0, 0, 0}, {2, 1, 1});
  std::vector<double> moduli(12, 100);
  for (std::size_t k = 6; k < 12; ++k) moduli[k] = 300;
  Simulation sim{node<"root">(EulerImplicitSolver{},
                              solver(),
                              MeshTopology{.hexahedra = bar.hexahedra},
                              MechanicalObject<Vec3d>{.position = bar.positions},
                              UniformMass<Vec3d>{.vertexMass = 2},
                              TetrahedronFEMForceField<Vec3d>{.youngModulus = moduli})};
  sim.init();
  sim.refineElements("", {.hexahedra = {1}});
  // the first in 4, the second in 8
  auto const& now = sim.root().get<TetrahedronFEMForceField<Vec3d>>().youngModulus;
  REQUIRE(now.size() == 6 * 12);
  for (std::size_t k = 0; k < now.size(); ++k) CHECK(now[k] == (k < 24 ? 100 : 300));
  auto const& mass = sim.root().get<UniformMass<Vec3d>>().lumped.mass;
  CHECK(mass.size() == 1);
  CHECK(mass[0] * double(sim.root().state().size()) == Approx(2. * 12));
  sim.animate(0.01);
}

TEST_CASE("a mass that all points have is shared out, and one for each point is refused") {
  const Mesh cube = block_of(2);
  auto sim = scene(cube, DiagonalMass<Vec3d>{.vertexMass = {2}});
  sim.init();
  sim.refineElements("body");
  CHECK(sim.at<"body">().get<DiagonalMass<Vec3d>>().lumped.mass.size() == 27);
  CHECK(total(sim.at<"body">().get<DiagonalMass<Vec3d>>().lumped.mass) == Approx(16).epsilon(1e-14));
  auto each = scene(cube, DiagonalMass<Vec3d>{.vertexMass = {1, 2, 3, 4, 5, 6, 7, 8}});
  each.init();
  CHECK_THAT(error_of([&] { each.refineElements("body"); }), Contains("has a value for each point"));
  CHECK(each.at<"body">().state().size() == 8);
}

TEST_CASE("a load on a part of the skin and densities of hexahedra stay, with all faces and edges listed") {
  const Mesh bar = regular_grid(3, 2, 2, {0, 0, 0}, {2, 1, 1});
  std::vector<Quad> skin = border_of(bar).quads, faces = skin;
  faces.push_back({1, 4, 10, 7});
  std::vector<Edge> edges;
  for (int i = 0; i < 12; ++i) {
    if (i % 3 < 2) edges.push_back({i, i + 1});
    if (i / 3 % 2 == 0) edges.push_back({i, i + 3});
    if (i < 6) edges.push_back({i, i + 6});
  }
  // that at x = 2
  const auto end = int(
      std::find_if(skin.begin(),
                   skin.end(),
                   [](Quad q) { return std::all_of(q.begin(), q.end(), [](int i) { return i % 3 == 2; }); }) -
      skin.begin());
  Simulation sim{node<"root">(
      EulerImplicitSolver{},
      solver(),
      node<"bar">(MeshTopology{.edges = edges, .quads = faces, .hexahedra = bar.hexahedra},
                  MechanicalObject<Vec3d>{.position = bar.positions},
                  MeshMatrixMass<Vec3d>{.massDensity = {2, 6}},
                  HexahedronFEMForceField<Vec3d>{},
                  node<"skin">(MeshTopology{.quads = skin},
                               SurfacePressureForceField<Vec3d>{.pressure = 3, .quadIndices = {end}})))};
  sim.init();
  for (int round = 0; round < 2; ++round) {
    sim.refineElements("bar", {.hexahedra = {1}});
    auto const& mesh = sim.at<"bar">().get<MeshTopology>();
    std::size_t inside = 0;
    for (std::size_t k = 0; k < mesh.hexahedra.size(); ++k) {
      double x = 0;
      for (const Index i : mesh.hexahedra[k])
        x += sim.at<"bar">().state().restPosition[std::size_t(i)].x() / 8;
      CHECK(sim.at<"bar">().get<MeshMatrixMass<Vec3d>>().massDensity[k] == (x < 1 ? 2 : 6));
      inside += x > 1;
    }
    CHECK(inside >= 8);
    // as many faces as there are: by Euler's formula of a ball
    CHECK(sim.at<"bar">().state().size() + mesh.quads.size() ==
          1 + mesh.edges.size() + mesh.hexahedra.size());
    auto const& state = sim.at<"bar">().state();
    std::vector<Vector3d> f(state.size(), Vector3d::Zero());
    add_force(
        sim.at<"bar/skin">().get<SurfacePressureForceField<Vec3d>>(), {}, f, state.position, state.velocity);
    Vector3d all = Vector3d::Zero();
    for (auto const& one : f) all += one;
    CHECK((all - Vector3d(3, 0, 0)).norm() < 1e-14);
  }
  sim.animate(0.01);
}

TEST_CASE(
    "a mesh with all that grids list is refined as planned: nothing goes with the whole elements but these") {
  Mesh m = regular_grid(3, 3, 3, {0, 0, 0}, {1, 1, 1});
  std::set<Quad> faces;
  std::set<Edge> sides;
  for_each_quad_face({.hexahedra = m.hexahedra}, [&](Quad const& f) {
    if (!faces.insert(sorted_corners(f)).second) return;
    m.quads.push_back(f);
    for (Triangle const& t : {Triangle{f[0], f[1], f[2]}, Triangle{f[0], f[2], f[3]}}) {
      m.triangles.push_back(t);
      for_each_side(1, t, [&](Edge const& e) { sides.insert(e); });
    }
  });
  m.edges.assign(sides.begin(), sides.end());
  Simulation sim{node<"root">(
      EulerImplicitSolver{},
      solver(),
      MeshTopology{.edges = m.edges, .triangles = m.triangles, .quads = m.quads, .hexahedra = m.hexahedra},
      MechanicalObject<Vec3d>{.position = m.positions},
      DiagonalMass<Vec3d>{.massDensity = 1},
      HexahedronFEMForceField<Vec3d>{})};
  sim.init();
  const TopologyView before{
      .edges = m.edges, .triangles = m.triangles, .quads = m.quads, .hexahedra = m.hexahedra};
  const Refinement plan = plan_refinement(before, m.positions, {.edges = {0}});
  sim.refineElements("", {.edges = {0}});
  auto const& now = sim.root().get<MeshTopology>();
  REQUIRE(now.hexahedra.size() == 8 + 4);
  CHECK(now.edges.size() == m.edges.size() - plan.whole.edges.size() + plan.parts.edges.size());
  CHECK(now.triangles.size() ==
        m.triangles.size() - plan.whole.triangles.size() + plan.parts.triangles.size());
  CHECK(now.quads.size() == m.quads.size() - plan.whole.quads.size() + plan.parts.quads.size());
  CHECK(total(sim.root().get<DiagonalMass<Vec3d>>().lumped.mass) == Approx(1).epsilon(1e-14));
  sim.refineElements("");
  CHECK(now.hexahedra.size() == 8 * 12);
  sim.animate(0.01);
}

TEST_CASE("a plate of quads and its edges are refined, with the material of each quad and its load") {
  std::vector<Vector3d> points;
  for (int i = 0; i < 9; ++i) points.push_back({double(i % 3), double(i / 3), 0});
  const std::vector<Quad> quads{{0, 1, 4, 3}, {1, 2, 5, 4}, {3, 4, 7, 6}, {4, 5, 8, 7}};
  std::vector<Edge> edges;
  for (int i = 0; i < 9; ++i) {
    if (i % 3 < 2) edges.push_back({i, i + 1});
    if (i < 6) edges.push_back({i, i + 3});
  }
  Simulation sim{node<"root">(
      EulerImplicitSolver{},
      solver(),
      node<"plate">(MeshTopology{.edges = edges, .quads = quads},
                    MechanicalObject<Vec3d>{.position = points},
                    DiagonalMass<Vec3d>{.massDensity = 5},
                    QuadBendingFEMForceField<Vec3d>{.youngModulus = {100, 200, 300, 400},
                                                    .poissonRatio = {0.1, 0.2, 0.3, 0.4}},
                    SurfacePressureForceField<Vec3d>{.pressure = 2, .quadIndices = {0}},
                    FixedConstraint<Vec3d>{.indices = {5, 8}},
                    node<"rim">(MeshTopology{
                        .edges = {{0, 1}, {1, 2}, {2, 5}, {5, 8}, {8, 7}, {7, 6}, {6, 3}, {3, 0}}})))};
  sim.init();
  auto& plate = sim.at<"plate">();
  const auto sum = [&] {
    Vector3d all = Vector3d::Zero();
    auto const& state = plate.state();
    std::vector<Vector3d> f(state.size(), Vector3d::Zero());
    add_force(plate.get<SurfacePressureForceField<Vec3d>>(), {}, f, state.position, state.velocity);
    for (auto const& one : f) all += one;
    return all;
  };
  sim.refineElements("plate", {.quads = {0}});
  CHECK(plate.state().size() == 16);
  CHECK(plate.get<MeshTopology>().quads.size() == 9);
  CHECK(plate.get<MeshTopology>().edges.size() == 24);
  CHECK(sim.at<"plate/rim">().get<MeshTopology>().edges.size() == 12);
  CHECK(plate.get<QuadBendingFEMForceField<Vec3d>>().youngModulus ==
        std::vector<double>{400, 100, 100, 100, 100, 200, 200, 300, 300});
  CHECK(plate.get<QuadBendingFEMForceField<Vec3d>>().poissonRatio ==
        std::vector<double>{0.4, 0.1, 0.1, 0.1, 0.1, 0.2, 0.2, 0.3, 0.3});
  CHECK(plate.get<SurfacePressureForceField<Vec3d>>().quadIndices == std::vector<int>{1, 2, 3, 4});
  CHECK(plate.get<FixedConstraint<Vec3d>>().indices == std::vector<int>{5, 8});
  CHECK(total(plate.get<DiagonalMass<Vec3d>>().lumped.mass) == Approx(20).epsilon(1e-14));
  CHECK((sum() - Vector3d(0, 0, 2)).norm() < 1e-14);
  sim.refineElements("plate");
  CHECK(plate.get<SurfacePressureForceField<Vec3d>>().quadIndices.size() == 16);
  CHECK(plate.get<FixedConstraint<Vec3d>>().indices.size() == 3);
  CHECK((sum() - Vector3d(0, 0, 2)).norm() < 1e-14);
  sim.animate(0.01);
}

TEST_CASE("triangles and quads of one body keep the values of their own") {
  const std::vector<Vector3d> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0.5, 0}, {2, 2, 0}};
  Simulation sim{
      node<"root">(EulerImplicitSolver{},
                   solver(),
                   MeshTopology{.triangles = {{1, 4, 2}, {4, 5, 2}}, .quads = {{0, 1, 2, 3}}},
                   MechanicalObject<Vec3d>{.position = points},
                   MeshMatrixMass<Vec3d>{.massDensity = {3, 4, 5}},
                   TriangleFEMForceField<Vec3d>{.youngModulus = {100, 200}, .poissonRatio = {0.3}})};
  sim.init();
  sim.refineElements("", {.triangles = {0}});
  CHECK(sim.root().get<MeshMatrixMass<Vec3d>>().massDensity == std::vector<double>{3, 3, 3, 3, 4, 4, 5, 5});
  CHECK(sim.root().get<TriangleFEMForceField<Vec3d>>().youngModulus ==
        std::vector<double>{100, 100, 100, 100, 200, 200});
  sim.animate(0.01);
}

TEST_CASE("cells that cannot be refined are refused, and the scene is what it was") {
  Mesh block = block_of(2);
  block.positions.push_back({0.5, 0.5, 2});
  Simulation sim{node<"root">(Gravity{{0, -2, 0}},
                              EulerImplicitSolver{},
                              solver(),
                              MeshTopology{.hexahedra = block.hexahedra, .pyramids = {{4, 5, 7, 6, 8}}},
                              MechanicalObject<Vec3d>{.position = block.positions},
                              DiagonalMass<Vec3d>{.massDensity = 1},
                              HexahedronFEMForceField<Vec3d>{})};
  sim.init();
  sim.animate(0.01);
  const auto x = sim.root().state().position;
  CHECK_THAT(error_of([&] { sim.refineElements("", {.hexahedra = {0}}); }),
             Contains("pyramid 0 would be parted, and elements of its kind are not refined"));
  CHECK_THAT(error_of([&] { sim.refineElements("", {.hexahedra = {2}}); }),
             Contains("there is no hexahedron 2 to refine"));
  CHECK(sim.root().state().position == x);
  CHECK(sim.root().get<MeshTopology>().hexahedra == block.hexahedra);
  sim.animate(0.01);
  CHECK(sim.root().state().position != x);
}

}  // namespace test_cell_refinement
