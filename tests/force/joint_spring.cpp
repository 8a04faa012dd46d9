// SPDX-License-Identifier: BSL-1.0
// Joints as springs: what is free and what is held, limits, words of scene files.
#include "frames.hpp"

#include <sinew/force/joint_spring.hpp>
#include <sinew/runtime/value_text.hpp>

#include <cmath>

namespace test_joint_spring {

using namespace sinew;
using frames::frame;
using Joints = JointSpringForceField<Rigid3d>;

namespace {

Joints made(JointSpring spring) {
  spring.second = 1;
  return one::ready(Joints{.springs = {spring}}, {frame({0, 0, 0}), frame({0, 0, 0})});
}
Eigen::Vector3d torque(JointSpring const& spring, Eigen::Vector3d const& turn) {
  auto joints = made(spring);
  return one::force(joints, {frame({0, 0, 0}), frame({0, 0, 0}, turn)})[0].tail<3>();
}

}  // namespace

TEST_CASE("a joint pulls by its axes, hard where it is held and soft where it is free") {
  auto joints = made({.freeAxis = {true, false, false, false, false, false},
                      .stiffnessTranslation = {3, 100},
                      .restTranslation = {0, 0, 2}});
  // the first body is turned by 90 degrees about z: its x axis is y of the world
  const Rigid3d::VecCoord x{frame({1, 1, 1}, {0, 0, std::acos(-1.0) / 2}), frame({1.5, 1.25, 3})};
  auto f = one::force(joints, x);
  CHECK(f[0].head<3>().isApprox(Eigen::Vector3d(50, 0.75, 0)));
  CHECK(f[1] == -f[0]);
  // damping of both, at the start of the step only
  auto damped = made({.damping = 2});
  f = one::force(damped, {x[0], x[0]}, {Rigid3d::Deriv::Zero(), Rigid3d::Deriv::Ones()});
  CHECK(f[0].isApprox(2 * Rigid3d::Deriv::Ones()));
  CHECK(one::product(damped, {Rigid3d::Deriv::Zero(), Rigid3d::Deriv::Ones()}, 0, 1)[0].norm() == 0);
}

TEST_CASE("rotations are held about the axes that are not free") {
  const std::array<bool, 6> none{}, all{false, false, false, true, true, true};
  CHECK(torque({.freeAxis = none, .stiffnessRotation = {1, 50}}, {0.1, -0.2, 0.3})
            .isApprox(50 * Eigen::Vector3d(0.1, -0.2, 0.3)));
  CHECK(torque({.freeAxis = all, .stiffnessRotation = {1, 50}}, {0.1, -0.2, 0.3})
            .isApprox(Eigen::Vector3d(0.1, -0.2, 0.3)));
  // more than half a turn is less than that the other way
  CHECK(torque({.freeAxis = none, .stiffnessRotation = {1, 1}}, {4, 0, 0})
            .isApprox(Eigen::Vector3d(4 - 2 * std::acos(-1.0), 0, 0)));
  // a hinge about y: turning about it is free, tilting its axis by theta about z is held by K theta a x e
  const JointSpring hinge{.freeAxis = {false, false, false, false, true, false},
                          .stiffnessRotation = {0, 50}};
  CHECK(torque(hinge, {0, 0.7, 0}).norm() < 1e-12);
  CHECK(torque(hinge, {0, 0, 0.1}).isApprox(50 * 0.1 * Eigen::Vector3d(0, 0, std::sin(0.1)), 1e-9));
}

TEST_CASE("beyond its limits a free axis is pushed back to the nearer one") {
  JointSpring spring{.freeAxis = {false, false, false, true, true, true},
                     .stiffnessRotation = {1, 50},
                     .stiffnessLimit = 8,
                     .limitX = {-0.5, 1}};
  CHECK(torque(spring, {0.9, 0, 0}).isApprox(Eigen::Vector3d(0.9, 0, 0)));
  CHECK(torque(spring, {1.2, 0, 0}).isApprox(Eigen::Vector3d(8 * 0.2, 0, 0)));
  CHECK(torque(spring, {-0.7, 0, 0}).isApprox(Eigen::Vector3d(-8 * 0.2, 0, 0)));
  // at -3 the upper limit is nearer around the circle than the lower one: 2 pi - 4 against 2.5
  CHECK(torque(spring, {-3, 0, 0}).isApprox(8 * Eigen::Vector3d(2 * std::acos(-1.0) - 4, 0, 0)));
  spring.stiffnessLimit = 0;  // a hundredth of the hard one
  CHECK(torque(spring, {1.2, 0, 0}).isApprox(Eigen::Vector3d(0.5 * 0.2, 0, 0)));
  // an axis whose limits are one is not free
  spring.limitX = {0, 0};
  CHECK(torque(spring, {0.1, 0, 0}).isApprox(Eigen::Vector3d(50 * 0.1, 0, 0)));
}

TEST_CASE("the tangent of a joint at rest is the slope of its force") {
  auto joints = made({.freeAxis = {true, false, true, false, true, true},
                      .stiffnessTranslation = {3, 100},
                      .stiffnessRotation = {2, 40}});
  const Rigid3d::VecCoord rest{frame({1, 2, 3}, {0.3, -0.8, 0.5}), frame({1, 2, 3}, {0.3, -0.8, 0.5})};
  Rigid3d::VecDeriv dx(2);
  dx[0] << 0.3, -0.2, 0.5, 0.1, 0.7, -0.4;
  dx[1] << -0.1, 0.6, 0.2, -0.5, 0.3, 0.9;
  const double h = 1e-6;
  auto moved = [&](double by) {
    auto x = rest;
    for (std::size_t i = 0; i < 2; ++i) Rigid3d::increment(x[i], by * dx[i]);
    return x;
  };
  const auto plus = one::force(joints, moved(h)), minus = one::force(joints, moved(-h));
  one::force(joints, rest);
  const auto ku = one::product(joints, dx, 1, 0);
  for (std::size_t i = 0; i < 2; ++i)
    CHECK(((plus[i] - minus[i]) / (2 * h) - ku[i]).norm() < 1e-6 * ku[i].norm());
}

TEST_CASE("joints are read as SOFA writes them, and written so that they are read again") {
  std::vector<JointSpring> springs;
  read_value(
      "BEGIN_SPRING 0 1 FREE_AXIS 0 0 0 0 1 0  KS_T 0 30000  KS_R 0 200000  KD 1  R_LIM_X -0.8 0.8 "
      "REST_R 0 0 1 0 END_SPRING\n BEGIN_SPRING  2 3 KS_B 7 END_SPRING",
      springs);
  REQUIRE(springs.size() == 2);
  CHECK(springs[0].freeAxis == std::array<bool, 6>{false, false, false, false, true, false});
  CHECK(springs[0].stiffnessTranslation == std::array<double, 2>{0, 30000});
  CHECK(springs[0].damping == 1);
  CHECK(springs[0].restRotation == Eigen::Vector4d(0, 0, 1, 0));
  CHECK(springs[1].second == 3);
  CHECK(springs[1].stiffnessLimit == 7);
  const std::string words = write_value(springs);
  CHECK(
      words ==
      "BEGIN_SPRING 0 1 FREE_AXIS 0 0 0 0 1 0 KS_T 0 30000 KS_R 0 2e+05 KD 1 R_LIM_X -0.8 0.8 REST_R 0 0 1 0 "
      "END_SPRING BEGIN_SPRING 2 3 KS_B 7 END_SPRING");
  std::vector<JointSpring> again;
  read_value(words, again);
  CHECK(write_value(again) == words);
  one::says([&] { read_value("BEGIN_SPRING 0 1 KZ 3 END_SPRING", springs); },
            {"'KZ' is not one of FREE_AXIS, KS_T"});
  one::says([&] { read_value("BEGIN_SPRING 0 1 KD 3", springs); }, {"END_SPRING"});
  one::says([&] { read_value("0 1", springs); }, {"write BEGIN_SPRING ... END_SPRING"});
}

TEST_CASE("joints say what is wrong") {
  const Rigid3d::VecCoord two{frame({0, 0, 0}), frame({0, 0, 0})};
  one::refuses(
      Joints{.springs = {{.first = 0, .second = 2}}}, two, {}, {"springs[0] refers to point 2 of body"});
  one::refuses(
      Joints{.springs = {{.first = 1, .second = 1}}}, two, {}, {"springs[0] joins body 1 to itself"});
  one::refuses(Joints{.springs = {{.second = 1, .limitY = {1, 0}}}}, two, {}, {"turns from 1 to 0"});
  one::refuses(Joints{.springs = {{.second = 1, .restRotation = {0, 0, 0, 0}}}}, two, {}, {"is no rotation"});
  one::refuses(Joints{.springs = {{.second = 1, .damping = -1}}}, two, {}, {"damping", "-1"});
}

}  // namespace test_joint_spring
