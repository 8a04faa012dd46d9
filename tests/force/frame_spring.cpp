// SPDX-License-Identifier: BSL-1.0
// Springs between points and axes of rigid bodies.
#include "frames.hpp"

#include <sinew/force/frame_spring.hpp>
#include <sinew/runtime/value_text.hpp>

#include <cmath>

namespace test_frame_spring {

using namespace sinew;
using frames::frame;
using Springs = FrameSpringForceField<Rigid3d>;

namespace {

Springs made(FrameSpring spring) {
  spring.second = 1;
  return one::ready(Springs{.springs = {spring}}, {frame({0, 0, 0}), frame({0, 0, 0})});
}
Rigid3d::VecDeriv motion(double from) {
  Rigid3d::VecDeriv v(2);
  for (auto& body : v)
    for (int c = 0; c < 6; ++c) body[c] = std::sin(from++);
  return v;
}
double dot(Rigid3d::VecDeriv const& a, Rigid3d::VecDeriv const& b) { return a[0].dot(b[0]) + a[1].dot(b[1]); }

}  // namespace

TEST_CASE("points are drawn together, and axes are turned to each other") {
  auto spring = made(
      {.stiffnessTranslation = 3, .stiffnessRotation = 5, .firstPoint = {1, 0, 0}, .secondPoint = {0, 2, 0}});
  const double quarter = std::acos(0.0);
  // the first point is at (0, 1, 0) of the world, the second one at (4, 2, 0)
  const Rigid3d::VecCoord x{frame({0, 0, 0}, {0, 0, quarter}), frame({4, 0, 0})};
  const auto f = one::force(spring, x);
  CHECK(f[0].isApprox((Rigid3d::Deriv() << 12, 3, 0, 0, 0, 0 * 3 - 1 * 12 - 5 * quarter).finished()));
  CHECK(f[1].isApprox((Rigid3d::Deriv() << -12, -3, 0, 0, 0, 2 * 12 + 5 * quarter).finished()));
  CHECK(potential_energy(spring, x) == Approx(1.5 * (16 + 1) + 2.5 * quarter * quarter));
}

TEST_CASE("damping takes energy from motions against each other, and from no other") {
  auto spring = made({.damping = 2, .firstPoint = {1, 0.5, 0}, .secondPoint = {0, 2, -1}});
  // the two points at one place
  const Rigid3d::VecCoord x{frame({0, 0, 0}), frame(Eigen::Vector3d(1, 0.5, 0) - Eigen::Vector3d(0, 2, -1))};
  const Eigen::Vector3d w(0.3, -0.7, 1.1);
  Rigid3d::VecDeriv whole(2);
  for (std::size_t i = 0; i < 2; ++i) whole[i] << Eigen::Vector3d(1, 2, 3) + w.cross(x[i].center), w;
  for (auto const& f : one::force(spring, x, whole)) CHECK(f.norm() < 1e-14);
  const auto v = motion(1);
  CHECK(dot(one::force(spring, x, v), v) < -1);
}

TEST_CASE("forces are those of an energy, and the tangent the symmetric part of their derivative") {
  auto spring = made({.stiffnessTranslation = 3,
                      .stiffnessRotation = 5,
                      .damping = 0.7,
                      .firstPoint = {1, 0.5, -0.3},
                      .secondPoint = {-0.2, 2, 0.4}});
  const Rigid3d::VecCoord x{frame({0.1, 0.2, -0.4}, {0.3, -0.8, 0.5}),
                            frame({1, -0.6, 0.3}, {-0.9, 0.2, 1.3})};
  const double h = 1e-5;  // differences: truncation 1e-10, rounding 1e-11
  auto moved = [&](Rigid3d::VecDeriv const& d, double step) {
    auto y = x;
    for (std::size_t i = 0; i < 2; ++i) Rigid3d::increment(y[i], step * d[i]);
    return y;
  };
  const auto u = motion(2), w = motion(31);
  const auto f = one::force(spring, x);
  CHECK(dot(f, u) ==
        Approx(-(potential_energy(spring, moved(u, h)) - potential_energy(spring, moved(u, -h))) / (2 * h))
            .epsilon(1e-7));
  auto slope = [&](Rigid3d::VecDeriv const& d, Rigid3d::VecDeriv const& along) {
    return (dot(one::force(spring, moved(d, h)), along) - dot(one::force(spring, moved(d, -h)), along)) /
           (2 * h);
  };
  const double expected = (slope(u, w) + slope(w, u)) / 2;
  one::force(spring, x);
  CHECK(dot(one::product(spring, u, 1, 0), w) == Approx(expected).epsilon(1e-6));
  CHECK(dot(one::product(spring, w, 1, 0), u) == Approx(expected).epsilon(1e-6));
  // of velocities it is exact
  const auto fast = one::force(spring, x, u);
  const auto damped = one::product(spring, u, 0, 1);
  for (std::size_t i = 0; i < 2; ++i) CHECK((fast[i] - f[i] - damped[i]).norm() < 1e-13);
  // the same by blocks
  auto const& pack = spring.driver.packs[0];
  for (int i = 0; i < 2; ++i) {
    Rigid3d::Deriv sum = Rigid3d::Deriv::Zero();
    for (int j = 0; j < 2; ++j)
      sum += FrameSpringLaw<Rigid3d>{}.block(pack.rest, pack.tangent, i, j, 0.7, 0.3) * u[std::size_t(j)];
    CHECK((sum - one::product(spring, u, 0.7, 0.3)[std::size_t(i)]).norm() < 1e-13);
  }
}

TEST_CASE("springs between frames are read as SOFA writes them, and say what is wrong") {
  std::vector<FrameSpring> springs;
  read_value("BEGIN_SPRING 0 3 KS_T 100 KS_R 20 KD 1.5 VEC1 1 0 0 VEC2 -1 0.5 0 END_SPRING", springs);
  REQUIRE(springs.size() == 1);
  CHECK(springs[0].second == 3);
  CHECK(springs[0].stiffnessTranslation == 100);
  CHECK(springs[0].stiffnessRotation == 20);
  CHECK(springs[0].damping == 1.5);
  CHECK(springs[0].firstPoint == Eigen::Vector3d(1, 0, 0));
  CHECK(springs[0].secondPoint == Eigen::Vector3d(-1, 0.5, 0));
  std::vector<FrameSpring> again;
  read_value(write_value(springs), again);
  CHECK(write_value(again) == write_value(springs));
  one::says([&] { read_value("BEGIN_SPRING 0 3 KS 1 END_SPRING", again); }, {"KS", "KS_T", "VEC2"});
  const Rigid3d::VecCoord x{frame({0, 0, 0}), frame({1, 0, 0})};
  auto with = [&](FrameSpring const& s) { return [&x, s] { one::ready(Springs{.springs = {s}}, x); }; };
  one::says(with({.first = 0, .second = 2}), {"body", "springs[0] refers to point 2", "has 2 points"});
  one::says(with({.first = 1, .second = 1}), {"springs[0] joins body 1 to itself"});
  one::says(with({.first = 0, .second = 1, .stiffnessTranslation = -1}), {"stiffnessTranslation"});
  one::says(with({.first = 0, .second = 1, .damping = one::notANumber}), {"damping"});
}

}  // namespace test_frame_spring
