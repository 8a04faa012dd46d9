// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/constraint/position_based_dynamics.hpp>

#include <cmath>
#include <numbers>

namespace test_position_based_dynamics {

using namespace sinew;
using Pbd = PositionBasedDynamicsProjectiveConstraint<Vec3d>;
using Points = std::vector<Eigen::Vector3d>;

namespace {

/// Points of a block that is not symmetric, in two clusters that share some, and masses.
struct Body {
  Points rest{};
  std::vector<std::vector<int>> clusters{{}, {}};
  std::vector<double> masses{};

  Body() {
    for (int i = 0; i < 12; ++i) {
      rest.push_back({0.5 * (i % 4) + 0.1 * std::sin(3.0 * i),
                      0.4 * (i / 4 % 3) + 0.1 * std::cos(5.0 * i),
                      0.3 * (i % 3) + 0.2 * std::sin(7.0 * i + 1)});
      masses.push_back(1 + 0.3 * i);
      if (i < 8) clusters[0].push_back(i);
      if (i > 4) clusters[1].push_back(i);
    }
  }
  Points bent() const {
    Points x = rest;
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] += 0.1 * Eigen::Vector3d(
                        std::sin(4.0 * double(i)), std::cos(3.0 * double(i)), std::sin(9.0 * double(i)));
    return x;
  }
  Pbd ready(Pbd c, double dt = 0.1) const {
    check_fields(c, "body");
    c.init({"body", rest, {}, masses});
    c.beforeStep(StepAhead{1, 0, dt, dt, true}, 0);
    return c;
  }
};
Eigen::Matrix3d turn(double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, -0.5).normalized()).toRotationMatrix();
}
double farthest(Points const& a, Points const& b) {
  double d = 0;
  for (std::size_t i = 0; i < a.size(); ++i) d = std::max(d, (a[i] - b[i]).norm());
  return d;
}
/// Where a constraint takes points.
Points project(Pbd& c, Points x) {
  c.projectPosition(0.1, x);
  return x;
}

}  // namespace

TEST_CASE("a body that has moved rigidly stays where it is") {
  const Body body;
  for (const double affine : {0.0, 0.4, 1.0})
    for (const double angle : {0.0, 0.7, 2.0, 3.1}) {
      auto c = body.ready({.cluster = body.clusters, .iterations = 3, .affineRatio = affine});
      Points x;
      for (auto const& p : body.rest) x.push_back(turn(angle) * p + Eigen::Vector3d(3, -1, 2));
      CHECK(farthest(project(c, x), x) < 1e-13);  // rounding of numbers of some metres
      Vec3d::VecDeriv v(x.size(), Eigen::Vector3d(1, 0, 0));
      c.projectVelocity(0.1, v);
      for (auto const& one : v) CHECK((one - Eigen::Vector3d(1, 0, 0)).norm() < 1e-11);
    }
}

TEST_CASE("a deformed cluster comes back to its rest shape") {
  const Body body;
  std::vector<int> all;
  for (int i = 0; i < 12; ++i) all.push_back(i);
  auto c = body.ready({.cluster = {all}});
  const Points x = project(c, body.bent());
  // in one step where it is stiff: all distances are those at rest
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      CHECK((x[i] - x[j]).norm() == Approx((body.rest[i] - body.rest[j]).norm()).epsilon(1e-12));
  // by half the way otherwise
  auto soft = body.ready({.stiffness = 0.5, .cluster = {all}});
  Points half = body.bent();
  for (std::size_t i = 0; i < half.size(); ++i) half[i] = (0.5 * (half[i] + x[i])).eval();
  CHECK(farthest(project(soft, body.bent()), half) < 1e-13);

  // clusters that overlap come nearer to it with each step, and there in the end
  auto two = body.ready({.cluster = body.clusters});
  Points y = body.bent();
  auto strain = [&] {
    double worst = 0;
    for (auto const& cluster : body.clusters)
      for (const int i : cluster)
        for (const int j : cluster) {
          const auto a = std::size_t(i), b = std::size_t(j);
          worst = std::max(worst, std::abs((y[a] - y[b]).norm() - (body.rest[a] - body.rest[b]).norm()));
        }
    return worst;
  };
  for (int k = 0; k < 400; ++k) y = project(two, y);
  CHECK(strain() < 1e-9);
  // iterations in one step are steps one after the other
  auto many = body.ready({.cluster = body.clusters, .iterations = 400});
  CHECK(farthest(project(many, body.bent()), y) < 1e-12);
}

TEST_CASE("an affine map of a cluster stays where it is, and a reflection turns back") {
  const Body body;
  std::vector<int> all;
  for (int i = 0; i < 12; ++i) all.push_back(i);
  Eigen::Matrix3d map;
  map << 1.2, 0.3, 0, -0.1, 0.8, 0.2, 0, 0.1, 1.1;
  Points x;
  for (auto const& p : body.rest) x.push_back(map * p + Eigen::Vector3d(1, 2, 3));
  auto affine = body.ready({.cluster = {all}, .affineRatio = 1});
  CHECK(farthest(project(affine, x), x) < 1e-12);
  auto rigid = body.ready({.cluster = {all}});
  CHECK(farthest(project(rigid, x), x) > 0.1);
  Points mirrored = body.rest;
  for (auto& p : mirrored) p[0] = -p[0];
  const Points back = project(rigid, mirrored);
  Eigen::Matrix3d was, now;
  for (int k = 0; k < 3; ++k) {
    was.col(k) = body.rest[std::size_t(k) + 1] - body.rest[0];
    now.col(k) = back[std::size_t(k) + 1] - back[0];
  }
  CHECK(now.determinant() == Approx(was.determinant()).epsilon(1e-10));  // not inside out
}

TEST_CASE("momentum and angular momentum are kept, where clusters overlap too") {
  const Body body;
  for (const double affine : {0.0, 0.6})
    for (const double stiffness : {1.0, 0.3}) {
      auto c = body.ready({.stiffness = stiffness, .cluster = body.clusters, .affineRatio = affine});
      const Points before = body.bent();
      Points x = before;
      Vec3d::VecDeriv v(x.size(), Eigen::Vector3d(0.2, 0, -1));
      const Vec3d::VecDeriv was = v;
      c.projectPosition(0.1, x);
      c.projectVelocity(0.1, v);
      Eigen::Vector3d moved(0, 0, 0), turned(0, 0, 0), push(0, 0, 0);
      double size = 0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        const Eigen::Vector3d d = body.masses[i] * (x[i] - before[i]);
        moved += d;
        turned += before[i].cross(d);
        push += body.masses[i] * (v[i] - was[i]);
        CHECK((v[i] - was[i] - (x[i] - before[i]) / 0.1).norm() < 1e-13);
        size += d.norm();
      }
      CHECK(size > 0.1);
      CHECK(moved.norm() < 1e-13 * size * 10);
      CHECK(push.norm() < 1e-12 * size * 10);
      CHECK(turned.norm() < 1e-13 * size * 100);
    }
}

TEST_CASE("fixed points hold a cluster") {
  const Body body;
  // the first four points are fixed as well: a cluster with them far heavier than the others does not leave
  std::vector<int> all;
  for (int i = 0; i < 16; ++i) all.push_back(i);
  const Points held(body.rest.begin(), body.rest.begin() + 4);
  auto c = body.ready({.cluster = {all}, .fixedweight = 1e9, .fixedPosition0 = held, .fixedPosition = held});
  Points x = body.bent();
  for (auto& p : x) p += Eigen::Vector3d(0, -1, 0);
  // what the others weigh beside them: 12 of 4e9
  CHECK(farthest(project(c, x), body.rest) < 1e-7);
}

TEST_CASE("goals that are given are reached, by points and by frames") {
  const Body body;
  Points goals = body.rest;
  for (auto& g : goals) g += Eigen::Vector3d(1, 0, 0);
  auto c = body.ready({.stiffness = 0.25, .position = goals});
  Points x = body.rest;
  Vec3d::VecDeriv v(x.size(), Eigen::Vector3d::Zero());
  c.projectPosition(0.1, x);
  c.projectVelocity(0.1, v);
  for (std::size_t i = 0; i < x.size(); ++i) {
    CHECK((x[i] - body.rest[i] - Eigen::Vector3d(0.25, 0, 0)).norm() < 1e-15);
    CHECK((v[i] - Eigen::Vector3d(2.5, 0, 0)).norm() < 1e-13);
  }
  // nothing is moved before a step has a length, nor after a reset
  Pbd early{.position = goals};
  early.init({"body", body.rest, {}, {}});
  CHECK(project(early, body.rest) == body.rest);
  c.reset();
  CHECK(project(c, body.rest) == body.rest);

  using Frames = PositionBasedDynamicsProjectiveConstraint<Rigid3d>;
  Rigid3d::VecCoord one(1), goal(1);
  Rigid3d::increment(goal[0], (Rigid3d::Deriv() << 1, 2, 3, 0, 0, 1).finished());
  Frames frames{.stiffness = 0.5, .position = goal};
  frames.init({"frame", one, {}, {}});
  frames.beforeStep(StepAhead{1, 0, 0.1, 0.1, true}, 0);
  frames.projectPosition(0.1, one);
  CHECK((Rigid3d::difference({}, one[0]) - (Rigid3d::Deriv() << 0.5, 1, 1.5, 0, 0, 0.5).finished()).norm() <
        1e-14);
}

TEST_CASE("clusters follow where points go and come") {
  Pbd c{.cluster = {{0, 1, 2, 3, 12}, {3, 4, 5}, {4}}};
  Renumbering points =
      Renumbering::of({true, false, true, true, false, true, true, true, true, true, true, true});
  points.come = {{2, 3, 0.5}, {3, 5, 0.5}, {0, 5, 0.5}, {12, 0, 0.5}};  // the last of the first
  const TopologyChange none{};
  c.follow(Followed{points, points, points, none});
  // 0 2 3 are 0 1 2 now, 5 is 3, and 10 to 13 are new; 12 was a fixed point, behind the 12 of the state
  CHECK(c.cluster == std::vector<std::vector<int>>{{0, 1, 2, 14, 10, 13}, {2, 3, 11}});
}

TEST_CASE("bad input of PositionBasedDynamicsProjectiveConstraint is told") {
  const Body body;
  auto says = [&](Pbd c, std::string_view part) {
    const std::string said = error_of([&] { body.ready(c); });
    INFO(said);
    CHECK(said.find(part) != std::string::npos);
  };
  const std::vector<std::vector<int>> some{{0, 1, 2}};
  says({}, "it has no goals");
  says({.position = body.rest, .cluster = some}, "both given");
  says({.position = {{0, 0, 0}}}, "position has 1 entries for 12 points");
  says({.stiffness = 2, .cluster = some}, "stiffness");
  says({.stiffness = std::nan(""), .cluster = some}, "stiffness");
  says({.cluster = some, .iterations = 0}, "iterations");
  says({.cluster = some, .affineRatio = -0.1}, "affineRatio");
  says({.cluster = {{0, 1}, {}}}, "cluster 1 is empty");
  says({.cluster = {{0, 1, 0}}}, "cluster 0 has point 0 twice");
  says({.cluster = {{0, 12}}}, "cluster 0 has point 12, but there are 12 points and 0 fixed ones");
  says({.cluster = {{-1, 2}}}, "cluster 0 has point -1");
  says({.cluster = {{0, 1, 2}}, .affineRatio = 0.5}, "cluster 0 is flat");
  says({.cluster = some, .fixedPosition0 = {{0, 0, 0}}}, "fixedPosition0 has 1 points and fixedPosition 0");
  says({.cluster = some, .fixedweight = 0}, "fixedweight");
  using Frames = PositionBasedDynamicsProjectiveConstraint<Rigid3d>;
  const Rigid3d::VecCoord one(1);
  CHECK(error_of([&] {
          Frames{.cluster = {{0}}}.init({"frame", one, {}, {}});
        }).find("in space only") != std::string::npos);
}

}  // namespace test_position_based_dynamics
