// SPDX-License-Identifier: BSL-1.0
// Carving of other elements than tetrahedra; what contacts remember; what cannot be carved.
#include <sinew/topology/regular_grid_topology.hpp>

#include "carved_block.hpp"

namespace test_carving_kinds {

using namespace carving;

namespace {

// a row of three cells of 0.1 m, or its upper side, hung up on springs between its points
template <class... More>
auto body(MeshTopology const& topology, std::vector<Point> const& points, Point const& tool, More... more) {
  std::vector<int> fixed(points.size());
  std::iota(fixed.begin(), fixed.end(), 0);
  return contact_scene(
      near,
      0,
      CarvingManager{.active = true, .carvingDistance = 0, .toolModel = "tool", .surfaceModelPath = "body"},
      node<"body">(EulerImplicitSolver{},
                   CGLinearSolver<>{},
                   topology,
                   MechanicalObject<Vec3d>{.position = points},
                   UniformMass<Vec3d>{.vertexMass = 1},
                   FixedConstraint<Vec3d>{.indices = fixed},
                   TriangleCollisionModel<Vec3d>{.bothSide = true},
                   more...),
      node<"tool">(MechanicalObject<Vec3d>{.position = {tool}},
                   SphereCollisionModel<Vec3d>{.simulated = false, .radius = 0.1}));
}
std::vector<Point> row() {
  std::vector<Point> p;
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 4; ++i) p.push_back({0.1 * i, 0.1 * j, 0.1 * k});
  return p;
}
MeshTopology cells() {
  MeshTopology t;
  for (int i = 0; i < 3; ++i) t.hexahedra.push_back({i, i + 1, i + 5, i + 4, i + 8, i + 9, i + 13, i + 12});
  return t;
}

}  // namespace

TEST_CASE("a hexahedron goes when its surface is touched, and lays quads bare") {
  auto sim = body(cells(), row(), {0.05, 0.05, 0.3});
  sim.init();
  auto& mesh = sim.at<"body">().get<MeshTopology>();
  CHECK(sim.at<"body">().get<TriangleCollisionModel<Vec3d>>().surface.size() == 28);  // of 14 quads
  sim.animate(0.01);
  CHECK(mesh.hexahedra.size() == 3);
  sim.at<"tool">().state().position[0][2] = 0.195;
  sim.animate(0.01);
  CHECK(mesh.hexahedra.size() == 2);
  CHECK(sim.at<"body">().state().size() == 12);
  CHECK(sim.at<"body">().get<TriangleCollisionModel<Vec3d>>().surface.size() == 20);
  sim.animate(0.01);
  CHECK(mesh.hexahedra.size() == 2);
}

TEST_CASE("triangles and quads of a membrane go themselves") {
  std::vector<Point> top;
  for (Point const& p : row())
    if (p[2] == 0) top.push_back(p);
  MeshTopology sheet;
  sheet.quads = {{0, 1, 5, 4}, {1, 2, 6, 5}};
  sheet.triangles = {{2, 3, 7}, {2, 7, 6}};
  auto sim = body(sheet, top, {0.05, 0.05, 0.09});
  sim.init();
  auto& mesh = sim.at<"body">().get<MeshTopology>();
  sim.animate(0.01);
  CHECK(mesh.quads.size() == 1);
  CHECK(mesh.triangles.size() == 2);
  CHECK(sim.at<"body">().state().size() == 6);
  sim.at<"tool">().state().position[0] = Point(0.28, 0.03, 0.09);
  sim.animate(0.01);
  CHECK(mesh.quads.size() == 1);
  CHECK(mesh.triangles.size() == 1);
}

TEST_CASE("what cannot be removed stops the step before it, and says why") {
  auto sim = body(cells(),
                  row(),
                  {0.05, 0.05, 0.195},
                  node<"grid">(RegularGridTopology{.n = {4, 2, 2}, .min = {0, 0, 0}, .max = {0.3, 0.1, 0.1}},
                               MechanicalObject<Vec3d>{},
                               IdentityMapping<Vec3d, Vec3d>{}));
  sim.init();
  std::string message;
  try {
    sim.animate(0.01);
  } catch (Error const& error) {
    message = error.what();
  }
  CHECK(message.find("carving at step 0") != message.npos);
  CHECK(message.find("1 elements of 'body' cannot be removed") != message.npos);
  CHECK(message.find("take a MeshTopology") != message.npos);
  CHECK(sim.at<"body">().get<MeshTopology>().hexahedra.size() == 3);
  CHECK(sim.step() == 0);
  sim.root().get<CarvingManager>().active = false;
  sim.animate(0.01);
  CHECK(sim.step() == 1);
}

TEST_CASE("contacts of what stays remember, and those of what has gone are dropped") {
  const Block block(3, 2);
  auto sim = scene(block, {0.24, 0.25, 0.29}, false, false);
  sim.at<"tool">().get<SphereCollisionModel<Vec3d>>().contactFriction = 1;
  sim.init();
  for (int i = 0; i < 5; ++i) {
    sim.at<"tool">().state().position[0][0] += 1e-4;
    sim.animate(0.001);
  }
  auto& manager = sim.root().get<Contacts>();
  const auto before = manager.contacts;
  REQUIRE(!before.empty());
  CHECK(before[0].frictionState.slip.norm() > 1e-5);
  auto where = [&](Contact const& c) {
    return position_of(c.a, *manager.surfaces[std::size_t(c.a.surface)]);
  };
  const Point at = where(before[0]);
  // all of a column of cells in a far corner: points go, and numbers change
  std::vector<Index> gone;
  for (std::size_t e = 0; e < block.tetrahedra.size(); ++e) {
    Point middle(0, 0, 0);
    for (const int i : block.tetrahedra[e]) middle += block.points[std::size_t(i)] / 4;
    if (middle[0] < 0.1 && middle[1] < 0.1) gone.push_back(Index(e));
  }
  const auto change = sim.removeElements("block", {.tetrahedra = gone});
  REQUIRE(change.points.changes());
  REQUIRE(manager.contacts.size() == before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    CHECK(manager.contacts[i].frictionState.slip == before[i].frictionState.slip);
    for (std::size_t k = 0; k < 3; ++k) {
      const int old = before[i].a.vertices[k];
      CHECK(manager.contacts[i].a.vertices[k] == (old < 0 ? -1 : change.points.now[std::size_t(old)]));
    }
  }
  sim.animate(1e-9);  // the same place but for the step before, and what it remembers
  REQUIRE(!manager.contacts.empty());
  CHECK((where(manager.contacts[0]) - at).norm() < 1e-3);
  CHECK(manager.contacts[0].frictionState.slip.norm() > 1e-5);
  // and what is under the ball
  std::set<Index> under;
  auto const& left = sim.at<"block">().get<TetrahedronTopology>().tetrahedra;
  for (std::size_t e = 0; e < left.size(); ++e)
    for (const int i : left[e])
      if ((sim.at<"block">().state().restPosition[std::size_t(i)] - Point(0.25, 0.25, 0.2)).norm() < 0.12)
        under.insert(Index(e));
  sim.removeElements("block", {.tetrahedra = {under.begin(), under.end()}});
  CHECK(manager.contacts.empty());
  sim.animate(0.001);
  check_whole(sim);
}

}  // namespace test_carving_kinds
