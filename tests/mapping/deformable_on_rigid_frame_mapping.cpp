// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/mechanics.hpp>

namespace test_deformable_on_rigid_frame_mapping {

using namespace sinew;

using Mapping = DeformableOnRigidFrameMapping<Vec3d, Rigid3d, Vec3d>;
using OfPaths = DeformableOnRigidFrameMapping<Vec3d, Rigid3d, Vec3d, Parents<"..", "../../frame">>;

Rigid3d::Coord turned(Eigen::Vector3d const& center, Eigen::Vector3d const& turn) {
  Rigid3d::Coord c{.center = center};
  Rigid3d::increment(c, (Rigid3d::Deriv() << 0, 0, 0, turn).finished());
  return c;
}

TEST_CASE("points move in the axes of their frame") {
  Mapping mapping;
  Vec3d::VecCoord child;
  const Vec3d::VecCoord p = {{1, 0, 0}, {0, 0, 2}};
  const Rigid3d::VecCoord frames = {turned({5, 6, 7}, {0, 0, double(EIGEN_PI) / 2})};
  mapping.init({"points", p, {}}, {"frames", frames, {}}, {"child", child, {}}, child);
  REQUIRE(child.size() == 2);
  auto points = mapping.part(ParentNumber<0>{});
  auto frame = mapping.part(ParentNumber<1>{});
  points.apply(child, p);
  frame.apply(child, frames);
  CHECK((child[0] - Eigen::Vector3d(5, 7, 7)).norm() < 1e-14);
  CHECK((child[1] - Eigen::Vector3d(5, 6, 9)).norm() < 1e-14);
  // c' + w x r + R p'
  Vec3d::VecDeriv v(2);
  points.applyJ(v, {{0, 0, 2}, {3, 0, 0}});
  frame.applyJ(v, {(Rigid3d::Deriv() << 1, 0, 0, 0, 0, 4).finished()});
  CHECK((v[0] - Eigen::Vector3d(1 - 4, 0, 2)).norm() < 1e-14);
  CHECK((v[1] - Eigen::Vector3d(1, 3, 0)).norm() < 1e-14);
  // a force of the world on the first: R' f on p, f and r x f on the frame
  Vec3d::VecDeriv onPoints(2, Vec3d::Deriv::Zero());
  Rigid3d::VecDeriv onFrame(1, Rigid3d::Deriv::Zero());
  const Vec3d::VecDeriv f = {{2, 0, 0}, {0, 0, 0}};
  frame.applyJT(onFrame, f);
  points.applyJT(onPoints, f);
  CHECK((onPoints[0] - Eigen::Vector3d(0, -2, 0)).norm() < 1e-14);
  CHECK((onFrame[0] - (Rigid3d::Deriv() << 2, 0, 0, 0, 0, -2).finished()).norm() < 1e-14);
}

// a body of three points in a frame that turns, whose image springs hold to the world
template <class Linear, class Fix>
auto scene(Linear linear, RotationalStiffness stiffness, Fix fix) {
  return node<"root">(
      Gravity{{0, -10, 0}},
      EulerImplicitSolver{.rayleighStiffness = 0.02},
      linear,
      node<"frame">(
          MechanicalObject<Rigid3d>{.position = {turned({1, 2, 0}, {0.3, -0.2, 0.5})},
                                    .velocity = {(Rigid3d::Deriv() << 0, 1, 0, 1, 2, -1).finished()}},
          UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{.mass = 2}}),
      node<"body">(MechanicalObject<Vec3d>{.position = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                   UniformMass<Vec3d>{.vertexMass = 0.5},
                   fix,
                   StiffSpringForceField<Vec3d>{.springs = {{0, 1, 100, 0, 1}, {1, 2, 100, 0, 1}}},
                   node<"world">(MechanicalObject<Vec3d>{},
                                 OfPaths{.geometricStiffness = stiffness},
                                 RestShapeSpringsForceField<Vec3d>{.stiffness = {200}},
                                 ConstantForceField<Vec3d>{.indices = {2}, .forces = {{0, 0, 3}}})));
}

TEST_CASE("a system with and without matrix moves both bodies alike") {
  const auto stiffness = GENERATE(RotationalStiffness::none, RotationalStiffness::symmetrized);
  const FixedConstraint<Vec3d> fix{.indices = {0}};
  Simulation direct{scene(SparseLDLSolver<CompressedRowSparseMatrixd>{}, stiffness, fix)};
  Simulation iterated{scene(CGLinearSolver<>{.iterations = 500, .tolerance = 1e-14}, stiffness, fix)};
  direct.init();
  iterated.init();
  for (int i = 0; i < 20; ++i) {
    direct.animate(0.01);
    iterated.animate(0.01);
  }
  auto const& frame = direct.at<"frame">().state().position[0];
  CHECK((frame.center - iterated.at<"frame">().state().position[0].center).norm() < 1e-8);
  CHECK((frame.center - Eigen::Vector3d(1, 2, 0)).norm() > 0.01);
  for (std::size_t i = 0; i < 3; ++i) {
    auto const& p = direct.at<"body">().state().position[i];
    CHECK((p - iterated.at<"body">().state().position[i]).norm() < 1e-8);
    const Eigen::Vector3d x = frame.center + frame.orientation * p;
    CHECK((direct.at<"body/world">().state().position[i] - x).norm() < 1e-13);
  }
}

TEST_CASE("a body that does not deform is carried as by a RigidMapping") {
  const FixedConstraint<Vec3d> all{.indices = {0, 1, 2}};
  Simulation held{
      scene(SparseLDLSolver<CompressedRowSparseMatrixd>{}, RotationalStiffness::symmetrized, all)};
  Simulation rigid{node<"root">(
      Gravity{{0, -10, 0}},
      EulerImplicitSolver{.rayleighStiffness = 0.02},
      SparseLDLSolver<CompressedRowSparseMatrixd>{},
      node<"frame">(
          MechanicalObject<Rigid3d>{.position = {turned({1, 2, 0}, {0.3, -0.2, 0.5})},
                                    .velocity = {(Rigid3d::Deriv() << 0, 1, 0, 1, 2, -1).finished()}},
          UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{.mass = 2}},
          node<"world">(MechanicalObject<Vec3d>{.position = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                        RigidMapping<Rigid3d, Vec3d>{.geometricStiffness = RotationalStiffness::symmetrized},
                        RestShapeSpringsForceField<Vec3d>{.stiffness = {200}},
                        ConstantForceField<Vec3d>{.indices = {2}, .forces = {{0, 0, 3}}})))};
  held.init();
  rigid.init();
  for (int i = 0; i < 20; ++i) {
    held.animate(0.01);
    rigid.animate(0.01);
  }
  auto const &a = held.at<"frame">().state(), &b = rigid.at<"frame">().state();
  CHECK((a.position[0].center - b.position[0].center).norm() < 1e-12);
  CHECK((a.velocity[0] - b.velocity[0]).norm() < 1e-11);
}

TEST_CASE("a frame of several, from the end, and one for some points each") {
  const Vec3d::VecCoord p(4, Eigen::Vector3d(1, 0, 0));
  const Rigid3d::VecCoord frames = {turned({1, 0, 0}, {0, 0, 0}), turned({2, 0, 0}, {0, 0, 0})};
  auto firstOf = [&](Mapping mapping) {
    Vec3d::VecCoord child;
    mapping.init({"points", p, {}}, {"frames", frames, {}}, {"child", child, {}}, child);
    mapping.part(ParentNumber<0>{}).apply(child, p);
    mapping.part(ParentNumber<1>{}).apply(child, frames);
    std::vector<double> x;
    for (auto const& c : child) x.push_back(c[0]);
    return x;
  };
  CHECK(firstOf({.index = 1}) == std::vector<double>{3, 3, 3, 3});
  CHECK(firstOf({.index = 1, .indexFromEnd = true}) == std::vector<double>{2, 2, 2, 2});
  CHECK(firstOf({.repartition = {2}}) == std::vector<double>{2, 2, 3, 3});
  CHECK(firstOf({.repartition = {1, 3}}) == std::vector<double>{2, 3, 3, 3});
}

TEST_CASE("what does not fit a DeformableOnRigidFrameMapping is named") {
  const Vec3d::VecCoord p(4, Eigen::Vector3d::Zero());
  const Rigid3d::VecCoord frames(2);
  auto with = [&](Mapping mapping, std::size_t children = 0) {
    return error_of([=, &p, &frames]() mutable {
      Vec3d::VecCoord child(children, Eigen::Vector3d::Zero());
      mapping.init({"points", p, {}}, {"/frames", frames, {}}, {"child", child, {}}, child);
    });
  };
  CHECK_THAT(with({.index = 2}),
             Catch::Contains("child: DeformableOnRigidFrameMapping<Vec3d, Rigid3d, Vec3d") &&
                 Catch::Contains("index"));
  CHECK_THAT(with({.repartition = {1, 2, 1}}),
             Catch::Contains("repartition has 3 entries for 2 rigid bodies of /frames"));
  CHECK_THAT(with({.repartition = {1}}),
             Catch::Contains("gives the rigid bodies 2 points, and points has 4"));
  CHECK_THAT(with({}, 3), Catch::Contains("the child has 3 points, and points has 4"));
}

}  // namespace test_deformable_on_rigid_frame_mapping
