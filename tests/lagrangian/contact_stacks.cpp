// SPDX-License-Identifier: BSL-1.0
// Contacts by multipliers of several bodies that lie: rigid boxes on each other, soft and rigid ones, and
// what forces a step is said to have had.
#include "lagrangian/contact_scenes.hpp"

#include <memory>
#include <tuple>

namespace test_contact_stacks {

using namespace sinew;
using Eigen::Vector3d;

namespace {

constexpr double dt = 0.01;

const std::vector<Vector3d> corners{{-0.5, -0.5, -0.5},
                                    {0.5, -0.5, -0.5},
                                    {0.5, 0.5, -0.5},
                                    {-0.5, 0.5, -0.5},
                                    {-0.5, -0.5, 0.5},
                                    {0.5, -0.5, 0.5},
                                    {0.5, 0.5, 0.5},
                                    {-0.5, 0.5, 0.5}};
MeshTopology box_surface() {
  MeshTopology t;
  t.triangles = blockSurface;
  return t;
}
// a cube of 1 m and 3 kg, on its n-th place in a stack
template <FixedString Name>
auto box(int n) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.2 * n, Vector3d::UnitZ()));
  return node<Name>(
      EulerExplicitSolver{},
      MechanicalObject<Rigid3d>{.position = {{{0.02 * n, 0.01 * n, 0.51 + 1.01 * n}, turn}}},
      UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{3, 0.5 * Eigen::Matrix3d::Identity()}},
      node<"skin">(box_surface(),
                   MechanicalObject<Vec3d>{.position = corners},
                   RigidMapping<Rigid3d, Vec3d>{},
                   TriangleCollisionModel<Vec3d>{},
                   LineCollisionModel<Vec3d>{},
                   PointCollisionModel<Vec3d>{}));
}

// an elastic block of cubes of tetrahedra, 0.4 m wide and 0.3 m high
struct SoftBlock {
  std::vector<Vector3d> points{};
  std::vector<std::array<Index, 4>> tetrahedra{};
  std::vector<std::array<Index, 3>> bottom{};

  explicit SoftBlock(double lowest) {
    const int n = 4, high = 3;
    auto at = [&](int x, int y, int z) { return Index(x + (n + 1) * (y + (n + 1) * z)); };
    for (int z = 0; z <= high; ++z)
      for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n; ++x) points.push_back({0.1 * x - 0.2, 0.1 * y - 0.2, lowest + 0.1 * z});
    // along the six ways over the edges of a cube from its first corner to the last
    for (int z = 0; z < high; ++z)
      for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
          for (auto const& way :
               {std::array{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}) {
            std::array<int, 3> p{x, y, z};
            std::array<Index, 4> t{at(x, y, z), 0, 0, 0};
            for (std::size_t k = 0; k < 3; ++k) {
              ++p[std::size_t(way[k])];
              t[k + 1] = at(p[0], p[1], p[2]);
            }
            if ((way[1] - way[0] + 3) % 3 != 1) std::swap(t[2], t[3]);
            tetrahedra.push_back(t);
          }
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        bottom.push_back({at(x, y, 0), at(x + 1, y + 1, 0), at(x + 1, y, 0)});
        bottom.push_back({at(x, y, 0), at(x, y + 1, 0), at(x + 1, y + 1, 0)});
      }
  }
  MeshTopology topology() const {
    MeshTopology t;
    t.tetrahedra = tetrahedra;
    return t;
  }
};
// of 3 kg, its points collide; and a node whose points follow it
template <class... Skin>
auto soft_block(double lowest, std::vector<int> const& fixed, Skin... skin) {
  const SoftBlock block(lowest);
  return node<"block">(EulerImplicitSolver{.rayleighStiffness = 0.02},
                       SparseLDLSolver<>{},
                       block.topology(),
                       MechanicalObject<Vec3d>{.position = block.points},
                       UniformMass<Vec3d>{.totalMass = 3},
                       TetrahedronFEMForceField<Vec3d>{.youngModulus = {2e4}, .poissonRatio = 0.3},
                       FixedConstraint<Vec3d>{.indices = fixed},
                       PointCollisionModel<Vec3d>{},
                       skin...);
}
template <class State>
Vector3d sum_of_velocities(State const& s) {
  Vector3d sum(0, 0, 0);
  for (auto const& v : s.velocity) sum += v.template head<3>();
  return sum;
}

}  // namespace

TEST_CASE("a stack of five boxes stands", "[long]") {
  auto sim = constrained_scene(
      near_by(), 0.5, fixed_floor(), box<"a">(0), box<"b">(1), box<"c">(2), box<"d">(3), box<"e">(4));
  auto& solver = sim.root().get<BlockGaussSeidelConstraintSolver>();
  solver.tolerance = 1e-9;
  sim.init();
  const auto first = sim.at<"a">().state().position[0], top = sim.at<"e">().state().position[0];
  for (int i = 0; i < 1000; ++i) sim.animate(dt);  // 10 s
  auto moved = [](auto const& state, Rigid3d::Coord const& start) {
    return Rigid3d::difference(start, state.position[0]).norm();
  };
  CHECK(moved(sim.at<"a">().state(), first) < 1e-4);
  CHECK(moved(sim.at<"e">().state(), top) < 1e-4);
  auto const& manager = sim.root().get<DefaultContactManager>();
  CHECK(force_on(manager, "/root/a/skin")[2] == Approx(3 * g).epsilon(1e-4));
  CHECK(force_on(manager, "/root/floor")[2] == Approx(-15 * g).epsilon(1e-4));
}

TEST_CASE("a soft block comes to rest on the floor, which bears its weight") {
  auto sim = constrained_scene(near_by(), 0.5, fixed_floor(), soft_block(0.05, {}));
  sim.init();
  auto const& s = sim.at<"block">().state();
  auto const& manager = sim.root().get<DefaultContactManager>();
  const double each = 3.0 / double(s.position.size());
  for (int i = 0; i < 200; ++i) {
    const Vector3d before = sum_of_velocities(s);
    sim.animate(dt);
    const Vector3d change = each / dt * (sum_of_velocities(s) - before);
    CHECK((change - force_on(manager, "/root/block") + Vector3d(0, 0, 3 * g)).norm() < 1e-8);
    for (auto const& x : s.position) REQUIRE(x[2] > 0.01 - 1e-9);
  }
  CHECK((force_on(manager, "/root/block") - Vector3d(0, 0, 3 * g)).norm() < 1e-6);
}

TEST_CASE("forces of a step are those of contacts and what holds points, and change the momentum") {
  // a ball on a soft block, by a solver of its own; the block collides by a skin, too, and some of its points
  // are fixed
  const SoftBlock shape(0.01);
  MeshTopology bottom;
  bottom.triangles.assign(shape.bottom.begin(), shape.bottom.begin() + 8);
  std::vector<Vector3d> skin(shape.points.begin(), shape.points.begin() + 25);
  for (const bool fixed : {false, true}) {
    INFO(fixed);
    auto sim = constrained_scene(
        near_by(),
        0.4,
        fixed_floor(),
        soft_block(0.01,
                   fixed ? std::vector<int>{0, 1, 30} : std::vector<int>{},
                   node<"skin">(bottom,
                                MechanicalObject<Vec3d>{.position = skin},
                                BarycentricMapping<Vec3d, Vec3d>{},
                                TriangleCollisionModel<Vec3d>{})),
        node<"ball">(
            EulerExplicitSolver{},
            MechanicalObject<Rigid3d>{.position = {{{0.04, 0.03, 0.525}, Eigen::Quaterniond::Identity()}}},
            UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{1, 0.016 * Eigen::Matrix3d::Identity()}},
            SphereCollisionModel<Rigid3d>{.radius = 0.2}));
    // each place of the skin is one of the block too: so many solutions that only the sums are asked for
    sim.root().get<BlockGaussSeidelConstraintSolver>().maxIterations = 50;
    sim.init();
    sim.keepForces(true);
    auto const& s = sim.at<"block">().state();
    auto const& ball = sim.at<"ball">().state();
    const double each = 3.0 / double(s.position.size());
    bool together = false;
    for (int i = 0; i < 20; ++i) {
      const Vector3d before = sum_of_velocities(s), ballBefore = ball.velocity[0].head<3>();
      sim.animate(dt);
      const Vector3d change = each / dt * (sum_of_velocities(s) - before),
                     ballChange = (ball.velocity[0].head<3>() - ballBefore) / dt;
      Vector3d onBlock(0, 0, -3 * g), onBall(0, 0, -g), net(0, 0, 0);
      int reactions = 0;
      for (ForceOnBody const& f : sim.forces()) {
        if (f.kind == ForceKind::net) {
          net = f.wrench.force;
          continue;
        }
        if (f.body == "/root/block" || f.body == "/root/block/skin") onBlock += f.wrench.force;
        if (f.body == "/root/ball") onBall += f.wrench.force;
        reactions += f.kind == ForceKind::reaction;
        together = together || (f.body == "/root/ball" && f.other == "/root/block");
      }
      CHECK(reactions == (fixed ? 3 : 0));
      CHECK((change - onBlock).norm() < 1e-8);
      CHECK((ballChange - onBall).norm() < 1e-8);
      CHECK((net - onBall).norm() < 1e-8);
    }
    CHECK(together);
  }
}

TEST_CASE("a spring of the mouse, penalties and multipliers act beside each other") {
  // a box is held in the air by the mouse, a ball lies by multipliers, another one by penalties
  auto sphere = [](Vector3d const& place, std::string const& response) {
    return std::tuple(
        EulerImplicitSolver{},
        CGLinearSolver<>{.iterations = 100, .tolerance = 1e-14},
        MechanicalObject<Vec3d>{.position = {place}},
        UniformMass<Vec3d>{.totalMass = 2},
        SphereCollisionModel<Vec3d>{
            .contactStiffness = 30, .contactDamping = 50, .contactResponse = response, .radius = 0.1});
  };
  auto make = [&]<FixedString Name>(Vector3d const& place, std::string const& response) {
    return std::apply([](auto... c) { return node<Name>(c...); }, sphere(place, response));
  };
  auto sim = constrained_scene(near_by(),
                               0.5,
                               fixed_floor(),
                               make.template operator()<"hard">({0, 0, 0.11}, ""),
                               make.template operator()<"soft">({1, 0, 0.11}, "PenalityContactForceField"),
                               make.template operator()<"held">({2, 0, 0.11}, ""));
  sim.init();
  const auto pick = sim.pick({2, 0, 3}, {0, 0, -1});
  REQUIRE(pick);
  const int spring = sim.attach(*pick, {.stiffness = 50, .damping = 20});
  sim.pull(spring, pick->point + Vector3d(0, 0, 0.2));
  for (int i = 0; i < 500; ++i) sim.animate(dt);
  auto const& manager = sim.root().get<DefaultContactManager>();
  const Vector3d weight(0, 0, -2 * g);
  CHECK((force_on(manager, "/root/hard") + weight).norm() < 1e-8);
  CHECK((force_on(manager, "/root/soft") + weight).norm() < 1e-3);
  // the spring bears 50 N/m times 0.2 m
  CHECK((force_on(manager, "/root/held") + weight + Vector3d(0, 0, 10)).norm() < 1e-6);
  CHECK(sim.at<"hard">().state().position[0][2] == Approx(0.11).epsilon(1e-9));
  CHECK(sim.at<"soft">().state().position[0][2] < 0.11);

  // a copy says the same of its last step, whatever becomes of the scene that made it
  auto first = std::make_unique<decltype(sim)>(sim);
  first->animate(dt);
  const auto expected = first->forces();
  auto copy = *first;
  first.reset();
  const auto forces = copy.forces();
  REQUIRE(forces.size() == expected.size());
  CHECK(forces.size() > 4);
  for (std::size_t i = 0; i < forces.size(); ++i) {
    CHECK(forces[i].body == expected[i].body);
    CHECK(forces[i].point == expected[i].point);
    CHECK(forces[i].wrench.force == expected[i].wrench.force);
  }
}

}  // namespace test_contact_stacks
