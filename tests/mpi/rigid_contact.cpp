// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "mpi/ranks.hpp"

#include <sinew/contact.hpp>

#include <cmath>

namespace test_rigid_contact {

using namespace ranks_test;

/// A rigid box, which turns a little, falls on a soft block that is held below. No two edges are parallel:
/// where two places are as near, rounding would choose between them.
auto box_on_block() {
  Mesh block = regular_grid_tetrahedra(5, 3, 5, {0, 0, 0}, {1, 0.4, 1});
  for (std::size_t i = 0; i < block.positions.size(); ++i)
    for (int c = 0; c < 3; ++c) block.positions[i][c] += 0.01 * std::sin(double(37 * i) + 11.0 * double(c));
  std::vector<int> top, held;
  std::vector<Index> now(block.positions.size(), -1);
  for (std::size_t i = 0; i < block.positions.size(); ++i) {
    if (block.positions[i][1] > 0.3) now[i] = Index(top.size()), top.push_back(int(i));
    if (block.positions[i][1] < 0.1) held.push_back(int(i));
  }
  // the upper side, as two triangles for each of its squares
  std::vector<Triangle> upper;
  for (Index z = 0; z < 4; ++z)
    for (Index x = 0; x < 4; ++x) {
      auto at = [&](Index i, Index k) { return now[std::size_t(i + 5 * (2 + 3 * k))]; };
      upper.push_back({at(x, z), at(x, z + 1), at(x + 1, z)});
      upper.push_back({at(x + 1, z), at(x, z + 1), at(x + 1, z + 1)});
    }
  Rigid3d::Coord frame{{0.53, 0.62, 0.47}, {1, 0, 0, 0}};
  frame.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(0.2, Eigen::Vector3d(1, 3, 2).normalized()));
  const MechanicalObject<Vec3d> corners{.position = {{-0.2, -0.15, -0.21},
                                                     {0.21, -0.16, -0.2},
                                                     {0.19, 0.15, -0.22},
                                                     {-0.2, 0.14, -0.19},
                                                     {-0.22, -0.15, 0.2},
                                                     {0.2, -0.14, 0.19},
                                                     {0.21, 0.16, 0.2},
                                                     {-0.19, 0.15, 0.21}}};
  const std::vector<Triangle> faces{{0, 2, 1},
                                    {0, 3, 2},
                                    {4, 5, 6},
                                    {4, 6, 7},
                                    {0, 1, 5},
                                    {0, 5, 4},
                                    {1, 2, 6},
                                    {1, 6, 5},
                                    {2, 3, 7},
                                    {2, 7, 6},
                                    {3, 0, 4},
                                    {3, 4, 7}};
  return node<"root">(
      Gravity{{0, -9.81, 0}},
      DefaultPipeline{},
      BruteForceBroadPhase{},
      BVHNarrowPhase{},
      MinProximityIntersection{.alarmDistance = 0.05, .contactDistance = 0.02},
      DefaultContactManager{},
      node<"bodies">(
          EulerImplicitSolver{.rayleighStiffness = 0.02},
          CGLinearSolver<>{.iterations = 3000, .tolerance = 1e-12},
          node<"block">(
              MeshTopology{.tetrahedra = block.tetrahedra},
              MechanicalObject<Vec3d>{block.positions},
              UniformMass<Vec3d>{.totalMass = 5},
              TetrahedronFEMForceField<Vec3d>{.youngModulus = {3e4}, .poissonRatio = 0.3},
              FixedConstraint<Vec3d>{.indices = held},
              node<"surface">(MeshTopology{.triangles = upper},
                              MechanicalObject<Vec3d>{},
                              SubsetMapping<Vec3d, Vec3d>{.indices = top},
                              TriangleCollisionModel<Vec3d>{.contactStiffness = 12, .contactDamping = 2},
                              PointCollisionModel<Vec3d>{.contactStiffness = 12})),
          node<"box">(MechanicalObject<Rigid3d>{.position = {frame}},
                      UniformMass<Rigid3d>{.totalMass = 4},
                      node<"surface">(MeshTopology{.triangles = faces},
                                      corners,
                                      RigidMapping<Rigid3d, Vec3d>{},
                                      TriangleCollisionModel<Vec3d>{.contactStiffness = 12},
                                      PointCollisionModel<Vec3d>{.contactStiffness = 12}))));
}

TEST_CASE("a rigid body comes to lie on a soft one as in one process") {
  Simulation one{box_on_block()};
  mpi::DistributedSimulation many{box_on_block(), std::make_shared<mpi::Communicator>()};
  many.keepWhole();
  one.init(), many.init();
  std::size_t contacts = 0;
  for (int i = 0; i < 40; ++i) {
    one.animate(0.005), many.animate(0.005);
    contacts = std::max(contacts, many.root().template get<DefaultContactManager>().contacts.size());
  }
  CHECK(contacts > 0);
  auto& bodies = hana::at_c<0>(many.root().children).children;
  const auto box = many.everywhere(hana::at_c<1>(bodies).state(), vec_id::velocity);
  auto const& expected = one.at<"bodies/box">().state().velocity;
  CHECK((box[0] - expected[0]).norm() < 1e-7);
  CHECK(expected[0].head<3>().norm() < 0.9 * 9.81 * 0.2);  // it has been stopped
  const Positions block = many.everywhere(hana::at_c<0>(bodies).state(), vec_id::velocity);
  CHECK(distance(block, one.at<"bodies/block">().state().velocity) < 1e-6 * length(block));
  CHECK((many.whole() != nullptr) == (many.ranks().rank() == 0));
}

TEST_CASE("a rigid body that collides by its frames alone is refused, and says what to do") {
  const std::string said = error_of([] {
    mpi::DistributedSimulation sim{
        node<"root">(
            DefaultPipeline{},
            BruteForceBroadPhase{},
            BVHNarrowPhase{},
            MinProximityIntersection{},
            DefaultContactManager{},
            EulerExplicitSolver{},
            MechanicalObject<Rigid3d>{.position = {{{0, 0, 0}, {1, 0, 0, 0}}, {{3, 0, 0}, {1, 0, 0, 0}}}},
            UniformMass<Rigid3d>{},
            SphereCollisionModel<Rigid3d>{}),
        std::make_shared<mpi::Communicator>()};
    sim.init();
  });
  INFO(said);
  CHECK(says(said, {"/root: SphereCollisionModel<Rigid3d>", "RigidMapping"}));
}

}  // namespace test_rigid_contact
