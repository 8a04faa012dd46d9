// SPDX-License-Identifier: BSL-1.0
// BarycentricMapping of frames.
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/core/mesh.hpp>
#include <sinew/mapping/barycentric_mapping.hpp>

namespace test_barycentric_frames {

using namespace sinew;

using Frames = BarycentricMapping<Vec3d, Rigid3d>;

const Vec3d::VecCoord corners{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 3}};
const std::vector<Tetrahedron> tetrahedra{{0, 1, 2, 3}};
const Vec3d::VecCoord box{
    {0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, {0, 0, 3}, {2, 0, 3}, {2, 1, 3}, {0, 1, 3}};
const std::vector<Hexahedron> hexahedra{{0, 1, 2, 3, 4, 5, 6, 7}};

Rigid3d::Coord frame() {
  return {.center = {0.3, 0.2, 0.4},
          .orientation = Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()))};
}
struct One {
  Frames mapping{};
  Rigid3d::VecCoord child{frame()};

  One(Vec3d::VecCoord const& points, TopologyView topology) {
    mapping.init({"parent", points, topology}, {"child", child, {}}, child);
  }
};

TEST_CASE("frames turn as elements do, and stretching does not turn them") {
  const bool tetrahedron = GENERATE(true, false);
  auto const& rest = tetrahedron ? corners : box;
  One one(rest, tetrahedron ? TopologyView{.tetrahedra = tetrahedra} : TopologyView{.hexahedra = hexahedra});
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(2.1, Eigen::Vector3d(-1, 0.5, 2).normalized()));
  const Eigen::Matrix3d stretch = (Eigen::Matrix3d() << 2, 0.3, 0, 0.3, 0.5, 0.1, 0, 0.1, 1.2).finished();
  Vec3d::VecCoord moved;
  for (auto const& x : rest) moved.push_back(turn * (stretch * x) + Eigen::Vector3d(1, 2, 3));
  one.mapping.apply(one.child, moved);
  CHECK((one.child[0].center - (turn * (stretch * frame().center) + Eigen::Vector3d(1, 2, 3))).norm() <
        1e-13);
  CHECK(one.child[0].orientation.angularDistance(turn * frame().orientation) < 1e-12);

  // the velocities of a rigid motion are those of the frame
  const Eigen::Vector3d w(0.5, -1, 2), at(3, 1, 0);
  Vec3d::VecDeriv v;
  for (auto const& x : moved) v.push_back(w.cross(x - at));
  Rigid3d::VecDeriv out(1);
  one.mapping.applyJ(out, v);
  CHECK((out[0].head<3>() - w.cross(one.child[0].center - at)).norm() < 1e-12);
  CHECK((out[0].tail<3>() - w).norm() < 1e-12);

  // a torque becomes forces that add up to it, and to no force
  Vec3d::VecDeriv f(rest.size(), Vec3d::Deriv::Zero());
  const Eigen::Vector3d torque(1, -3, 2);
  one.mapping.applyJT(f, {(Rigid3d::Deriv() << 0, 0, 0, torque).finished()});
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < f.size(); ++i) {
    force += f[i];
    moment += moved[i].cross(f[i]);
  }
  CHECK(force.norm() < 1e-12);
  CHECK((moment - torque).norm() < 1e-12);
}

TEST_CASE("an element that is turned over, or flat, has a frame") {
  One one(corners, {.tetrahedra = tetrahedra});
  Vec3d::VecCoord moved = corners;
  moved[3][2] = -3;
  one.mapping.apply(one.child, moved);
  CHECK(one.child[0].orientation.coeffs().allFinite());
  moved = Vec3d::VecCoord(4, Eigen::Vector3d::Zero());
  one.mapping.apply(one.child, moved);
  CHECK(one.child[0].orientation.coeffs().allFinite());
  Rigid3d::VecDeriv out(1);
  one.mapping.applyJ(out, Vec3d::VecDeriv(4, Eigen::Vector3d::UnitX()));
  CHECK(out[0].allFinite());
}

TEST_CASE("frames need elements with a volume") {
  const std::vector<Triangle> triangles{{0, 1, 2}};
  CHECK_THAT(error_of([&] { One one(corners, {.triangles = triangles}); }),
             Catch::Contains("child: BarycentricMapping<Vec3d, Rigid3d>: the topology of parent has neither "
                             "tetrahedra nor hexahedra"));
}

}  // namespace test_barycentric_frames
