// SPDX-License-Identifier: BSL-1.0
// Loads that turn points and bodies about an axis, steadily, or a surface to and fro.
#include "one_component.hpp"

#include <sinew/force/oscillating_torsion_pressure.hpp>
#include <sinew/force/torsion_force_field.hpp>

#include <cmath>

namespace test_torsion_force_field {

using namespace sinew;
using Twist = OscillatingTorsionPressureForceField<Vec3d>;

TEST_CASE("a torsion grows with the distance from its axis") {
  // about z through (1, 0, 0)
  auto points = one::ready(
      TorsionForceField<Vec3d>{.indices = {0, 2}, .torque = 3, .axis = {0, 0, 2}, .origin = {1, 0, 0}},
      {{3, 0, 5}, {9, 9, 9}, {1, -1, 0}});
  const auto f = one::force(points, {{3, 0, 5}, {9, 9, 9}, {1, -1, 0}});
  CHECK(f[0] == Eigen::Vector3d(0, 6, 0));
  CHECK(f[1] == Eigen::Vector3d(0, 0, 0));
  CHECK(f[2] == Eigen::Vector3d(3, 0, 0));
  Rigid3d::VecCoord bodies(1);
  bodies[0].center = {3, 0, 5};
  auto rigid = one::ready(
      TorsionForceField<Rigid3d>{.indices = {0}, .torque = 3, .axis = {0, 0, 2}, .origin = {1, 0, 0}},
      bodies);
  CHECK(one::force(rigid, bodies)[0] == (Rigid3d::Deriv() << 0, 6, 0, 0, 0, 3).finished());
  CHECK(one::product(rigid, {Rigid3d::Deriv::Ones()}, 1, 1)[0].norm() == 0);
}

// a square with a corner on the axis z, 3 m above the origin
const Vec3d::VecCoord square = {{0, 0, 3}, {2, 0, 3}, {2, 2, 3}, {0, 2, 3}};
const std::vector<Triangle> halves = {{0, 1, 2}, {0, 2, 3}};
TopologyView topology() {
  TopologyView view;
  view.triangles = halves;
  return view;
}
Vec3d::VecCoord turned(double angle, double scale = 1) {
  auto x = square;
  for (auto& p : x) p = scale * (Eigen::AngleAxisd(angle, Eigen::Vector3d(0, 0, 1)) * p);
  return x;
}
double momentOf(Vec3d::VecDeriv const& f, Vec3d::VecCoord const& x) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += x[i].cross(f[i])[2];
  return sum;
}

TEST_CASE("a surface feels the moment that oscillates, shared by arms") {
  auto twist = one::ready(Twist{.moment = 7, .triangleList = {0, 1}, .frequency = 0.25}, square, topology());
  const auto x = turned(0.4);
  CHECK(twist.meanTurn(x) == Approx(0.4));
  for (const double time : {0.0, 0.7, 2.0}) {
    const auto f = one::force(twist, x, {}, time);
    CHECK(momentOf(f, x) == Approx(7 * std::cos(std::acos(0.0) * time)));
    CHECK(f[0].norm() < 1e-12);  // on the axis
    // across the arms, the same for arms that are alike
    CHECK(std::abs(f[1].dot(x[1] - x[0])) < 1e-12);
    CHECK(f[1].norm() == Approx(f[3].norm()));
  }
  // what bends it out of shape draws it back, with the same moment in all: the far corner is 1 cm high
  auto bent = x;
  bent[2][2] += 0.01;
  const auto f = one::force(twist, bent);
  CHECK(f[2][2] == Approx(-10));
  CHECK(momentOf(f, bent) == Approx(7));
  // the shares of SOFA: of the corner between the halves, distances 0, 2 and sqrt(8)
  const double d = std::sqrt(8.0), g = (2 + d) / 3;
  auto share = [&](double a, double s, double r) {
    const double third = (a + s + r) / 3;
    return a * (a * a + s * s + r * r + third * third + g * g);
  };
  const double far = 2 * share(d, d / 2, (2 + d) / 2), near = share(2, (2 + d) / 2, 1);
  CHECK(twist.points[2].share == Approx(far / (far + 2 * near)));
}

TEST_CASE("triangles between two planes are turned") {
  auto points = [](double low, double high) {
    return one::ready(Twist{.moment = 1, .dmin = low, .dmax = high}, square, topology()).points.size();
  };
  CHECK(points(2.9, 3.1) == 4);
  CHECK(points(3.1, 4) == 0);
  CHECK(points(0, 0) == 0);
  CHECK(one::ready(Twist{.moment = 1}, square, topology()).warning().find("dmin") != std::string_view::npos);
}

TEST_CASE("torsions say what is wrong") {
  using Torsion = TorsionForceField<Vec3d>;
  auto with = [](auto c) { return [c] { one::ready(c, square, topology()); }; };
  one::says(with(Torsion{.indices = {0}}), {"body: TorsionForceField<Vec3d>", "axis is 0 0 0"});
  one::says(with(Torsion{.indices = {4}, .axis = {0, 0, 1}}), {"indices has 4", "4 points"});
  one::says(with(Torsion{.indices = {0}, .torque = one::notANumber, .axis = {0, 0, 1}}), {"torque"});
  CHECK(!one::ready(Torsion{.axis = {0, 0, 1}}, square).warning().empty());
  one::says(with(Twist{.triangleList = {2}}), {"triangleList has 2", "2 triangles"});
  one::says(with(Twist{.axis = {0, 0, 0}}), {"axis is 0 0 0"});
  one::says(with(Twist{.penalty = -1}), {"penalty"});
  one::says(with(Twist{.dmin = 2, .dmax = 1}), {"dmin is 2, above dmax, 1"});
  // along its own diagonal there is no arm of the points on it, but of the others; a line has none
  one::says(
      [] {
        TopologyView view;
        static const std::vector<Triangle> flat = {{0, 1, 2}};
        view.triangles = flat;
        one::ready(Twist{.triangleList = {0}}, {{0, 0, 0}, {0, 0, 1}, {0, 0, 2}}, view);
      },
      {"lie on the axis"});
}

}  // namespace test_torsion_force_field
