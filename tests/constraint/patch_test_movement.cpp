// SPDX-License-Identifier: BSL-1.0
// Points on the border of a mesh move between the corners of a box; what is inside follows.
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/constraint/patch_test_movement.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/topology/regular_grid.hpp>

namespace test_patch_test_movement {

using namespace sinew;
using Movement = PatchTestMovementProjectiveConstraint<Vec3d>;

TEST_CASE("points move between the corners of the box around them") {
  const Vec3d::VecCoord rest{{0, 0, 0}, {2, 0, 0}, {2, 4, 0}, {0, 4, 0}, {0.5, 3, 0}};
  Movement movement{.indices = {0, 4, 2},
                    .beginConstraintTime = 1,
                    .endConstraintTime = 3,
                    .constrainedPoints = rest,
                    .cornerMovements = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 2}}};
  movement.init({"body", rest, {}});
  auto at = [&](double time) {
    auto x = rest;
    movement.projectPosition(time, x);
    return x;
  };
  CHECK(at(0.5) == rest);
  CHECK(at(2)[0].isApprox(Eigen::Vector3d(0, 0, 0.5)));
  CHECK(at(3)[2].isApprox(Eigen::Vector3d(2, 5, 0)));
  // (0.25, 0.75): 0.1875, 0.0625, 0.1875, 0.5625 of the corners
  const Eigen::Vector3d u(0.0625, 0.1875, 0.1875 + 2 * 0.5625);
  CHECK(at(7)[4].isApprox(rest[4] + u));
  CHECK(at(7)[1] == rest[1]);
  Vec3d::VecDeriv v(5, Eigen::Vector3d::Ones());
  movement.projectVelocity(2, v);
  CHECK(v[4].isApprox(u / 2));
  CHECK(v[1] == Eigen::Vector3d::Ones());
  movement.projectVelocity(3.5, v);
  CHECK(v[4].norm() == 0);
}

TEST_CASE("a block of tetrahedra passes the patch test") {
  // the border moves as an affine map does: so does the middle, at rest to the tolerance of the solver
  const Mesh mesh = regular_grid_tetrahedra(5, 5, 5, {0, 0, 0}, {1, 1, 1});
  std::vector<int> border;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if ((mesh.positions[i].array() == 0 || mesh.positions[i].array() == 1).any()) border.push_back(int(i));
  const Eigen::Matrix3d slope =
      (Eigen::Matrix3d() << 0.01, 0.02, 0, -0.01, 0.03, 0.01, 0.02, 0, -0.02).finished();
  Vec3d::VecDeriv corners;
  for (auto const& c : hexahedronCorners) corners.push_back(slope * Eigen::Vector3d(c[0], c[1], c[2]));
  Simulation sim{
      node<"root">(StaticSolver{},
                   CGLinearSolver<>{.iterations = 200, .tolerance = 1e-12, .threshold = 1e-14},
                   MechanicalObject<Vec3d>{.position = mesh.positions},
                   UniformMass<Vec3d>{.totalMass = 1},
                   TetrahedronTopology{mesh.tetrahedra},
                   TetrahedronFEMForceField<Vec3d>{
                       .youngModulus = {100}, .poissonRatio = 0.3, .method = RotationMethod::small},
                   Movement{.indices = border, .endConstraintTime = 1, .cornerMovements = corners})};
  sim.init();
  for (int i = 0; i < 3; ++i) sim.animate(0.5);
  auto const& x = sim.root().state().position;
  for (std::size_t i = 0; i < x.size(); ++i)
    CHECK((x[i] - mesh.positions[i] - slope * mesh.positions[i]).norm() < 1e-8);
}

TEST_CASE("movements of a patch say what is wrong") {
  const Vec3d::VecCoord rest{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  auto refusal = [&](Movement movement) { return error_of([&] { movement.init({"body", rest, {}}); }); };
  auto contains = [](std::string const& all, std::string_view part) { return all.find(part) != all.npos; };
  const Vec3d::VecDeriv four(4, Eigen::Vector3d::Zero());
  CHECK(refusal({.indices = {0, 1, 2, 3}, .cornerMovements = four}).empty());
  CHECK(contains(refusal({.indices = {4}, .cornerMovements = four}), "indices has 4"));
  CHECK(contains(refusal({.indices = {0, 1}, .cornerMovements = four}), "is flat along x or y"));
  CHECK(contains(refusal({.indices = {0, 2}}), "cornerMovements has 0 entries for a box of 4 corners"));
  CHECK(
      contains(refusal({.indices = {0, 2}, .cornerMovements = four, .cornerPoints = {{0, 0, 0}, {1, 1, 1}}}),
               "4 entries for a box of 8 corners"));
  CHECK(contains(refusal({.indices = {0}, .beginConstraintTime = 20, .cornerMovements = four}),
                 "give an end after"));
}

}  // namespace test_patch_test_movement
