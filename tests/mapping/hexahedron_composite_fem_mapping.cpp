// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/mapping/barycentric_mapping.hpp>
#include <sinew/mapping/hexahedron_composite_fem_mapping.hpp>
#include <sinew/topology/sparse_grid_ramification_topology.hpp>
#include <sinew/topology/sparse_grid_topology.hpp>

#include <Eigen/Geometry>
#include <cmath>

namespace test_hexahedron_composite_fem_mapping {

using namespace sinew;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

using Mapping = HexahedronCompositeFEMMapping<Vec3d, Vec3d>;
using Points = Vec3d::VecCoord;

/// An octahedron of diameter 2 around the origin, whose cells are harder for x > 0.
template <class Grid>
Grid octahedron(int levels, double hard = 50) {
  Grid grid;
  grid.n = {3, 3, 3};
  grid.nbVirtualFinerLevels = levels;
  for (int axis = 0; axis < 3; ++axis)
    for (const double s : {1.0, -1.0}) grid.position.push_back(s * Vector3d::Unit(axis));
  grid.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  grid.generate("body");
  for (std::size_t l = 0; l < grid.levels.size(); ++l)
    for (std::size_t c = 0; c < grid.levels[l].fill.size(); ++c)
      if (c % 3 == 0) grid.levels[l].fill[c] *= hard;
  return grid;
}

Points places(TopologyView const& t) { return {t.positions.begin(), t.positions.end()}; }

const Points given = {{0.1, 0.2, 0.3},
                      {-0.5, 0.1, 0.2},
                      {0.3, -0.3, 0.25},
                      {0.02, 0.01, -0.6},
                      {0.6, 0.2, 0.1},
                      {1.3, 0.9, -0.8}};  // the last outside of all cells

Mapping mapped(Mapping mapping, TopologyView const& t, Points const& rest, Points child = given) {
  const Points childRest = child;
  mapping.init(InitContext<Vec3d>{"body", rest, t}, InitContext<Vec3d>{"body/skin", childRest, {}}, child);
  return mapping;
}

Points shaken(Points x, double by) {
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] +=
        by * Vector3d(std::sin(2.0 * double(i)), std::cos(3.0 * double(i)), std::sin(5.0 * double(i) + 1));
  return x;
}

template <class F>
void for_each_setting(F&& f) {
  for (const HexahedronMethod method :
       {HexahedronMethod::large, HexahedronMethod::polar, HexahedronMethod::small, HexahedronMethod::nearest})
    for (const bool complete : {false, true}) {
      CAPTURE(int(method), complete);
      f(Mapping{.poissonRatio = 0.3, .method = method, .completeInterpolation = complete});
    }
}

}  // namespace

TEST_CASE("points of composite hexahedra are at rest where they are given, and turn with the body") {
  auto check = [](auto const& grid) {
    const Points rest = places(grid.view());
    for_each_setting([&](Mapping const& settings) {
      Mapping m = mapped(settings, grid.view(), rest);
      Points x(given.size());
      m.apply(x, rest);
      for (std::size_t i = 0; i < x.size(); ++i) CHECK((x[i] - given[i]).norm() < 1e-12);
      if (settings.method == HexahedronMethod::small) return;
      const Matrix3d q = Eigen::AngleAxisd(2.1, Vector3d(2, -1, 2) / 3).matrix();
      Points turned = rest;
      for (auto& p : turned) p = q * p + Vector3d(1, 2, 3);
      m.apply(x, turned);
      for (std::size_t i = 0; i < x.size(); ++i)
        CHECK((x[i] - q * given[i] - Vector3d(1, 2, 3)).norm() < 1e-12);
      // and with its velocity
      const Vector3d spin(0.3, -0.5, 0.7);
      Vec3d::VecDeriv v, out(x.size());
      for (auto const& p : turned) v.push_back(spin.cross(p) + Vector3d(1, 0, -1));
      m.applyJ(out, v);
      for (std::size_t i = 0; i < x.size(); ++i)
        CHECK((out[i] - spin.cross(x[i]) - Vector3d(1, 0, -1)).norm() < 1e-11);
    });
  };
  check(octahedron<SparseGridTopology>(2));
  check(octahedron<SparseGridRamificationTopology>(2));
}

TEST_CASE(
    "the Jacobian of composite hexahedra is the derivative of their points, and its transpose pulls back") {
  // differences over 2e-5: truncation 1e-10, rounding 1e-11
  const auto grid = octahedron<SparseGridTopology>(2);
  const Points rest = places(grid.view()), at = shaken(rest, 0.1);
  const Vec3d::VecDeriv dx = shaken(Points(rest.size(), Vector3d::Zero()), 1);
  for_each_setting([&](Mapping const& settings) {
    Mapping m = mapped(settings, grid.view(), rest);
    const double h = 1e-5;
    Points ahead = at, behind = at, plus(given.size()), minus(given.size()), x(given.size());
    for (std::size_t i = 0; i < at.size(); ++i) ahead[i] += h * dx[i], behind[i] -= h * dx[i];
    m.apply(plus, ahead);
    m.apply(minus, behind);
    m.apply(x, at);
    Vec3d::VecDeriv rate(given.size()), pulled(rest.size(), Vector3d::Zero());
    m.applyJ(rate, dx);
    for (std::size_t i = 0; i < x.size(); ++i)
      CHECK((rate[i] - (plus[i] - minus[i]) / (2 * h)).norm() < 1e-8 * (1 + rate[i].norm()));
    const Vec3d::VecDeriv force = shaken(Points(given.size(), Vector3d::Zero()), 2);
    m.applyJT(pulled, force);
    double work = 0, above = 0;
    Vector3d sum = Vector3d::Zero(), torque = Vector3d::Zero();
    for (std::size_t i = 0; i < x.size(); ++i) {
      work += force[i].dot(rate[i]);
      sum += force[i], torque += x[i].cross(force[i]);
    }
    for (std::size_t i = 0; i < at.size(); ++i) {
      above += pulled[i].dot(dx[i]);
      sum -= pulled[i], torque -= at[i].cross(pulled[i]);
    }
    CHECK(work == Approx(above).epsilon(1e-12));
    CHECK(sum.norm() < 1e-12);
    if (settings.method != HexahedronMethod::small) CHECK(torque.norm() < 1e-11);
  });
}

TEST_CASE("points in one material follow as those of a BarycentricMapping") {
  SparseGridTopology grid;
  grid.n = {2, 2, 2}, grid.nbVirtualFinerLevels = 2;
  grid.fillWeighted = false;
  for (int k = 0; k < 8; ++k) grid.position.push_back(Vector3d(k & 1, k >> 1 & 1, k >> 2));
  grid.quads = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}};
  grid.generate("box");
  const Points rest = places(grid.view()), at = shaken(rest, 0.1);
  const Points child = {{0.1, 0.2, 0.3}, {0.5, 0.5, 0.5}, {0.9, 0.4, 0.7}};
  for (const HexahedronMethod method : {HexahedronMethod::large, HexahedronMethod::nearest}) {
    Mapping m = mapped(Mapping{.method = method}, grid.view(), rest, child);
    BarycentricMapping<Vec3d, Vec3d> b;
    Points same = child, x(3);
    b.init(InitContext<Vec3d>{"body", rest, grid.view()}, InitContext<Vec3d>{"body/skin", child, {}}, same);
    m.apply(x, at);
    b.apply(same, at);
    for (std::size_t i = 0; i < 3; ++i) CHECK((x[i] - same[i]).norm() < 1e-12);
  }
}

TEST_CASE("what is a thousand times as stiff keeps its shape in a hexahedron that stretches") {
  // the cells of one half: points in it keep their distance to 1 % of the strain, where those that follow
  // along straight lines stretch with the hexahedron
  SparseGridTopology grid;
  grid.n = {2, 2, 2}, grid.nbVirtualFinerLevels = 1;
  grid.fillWeighted = false;
  for (int k = 0; k < 8; ++k) grid.position.push_back(Vector3d(k & 1, k >> 1 & 1, k >> 2));
  grid.quads = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}};
  grid.generate("box");
  auto& level = grid.levels[0];
  level.fill.assign(8, 1);
  for (std::size_t c = 0; c < 8; ++c)
    if (hexahedronCorners[level.octants[c]][0] == 0) level.fill[c] = 1000;
  const Points rest = places(grid.view()), child = {{0.1, 0.5, 0.5}, {0.4, 0.5, 0.5}};
  Points at = rest;
  for (auto& p : at) p[0] *= 1.1;
  for (const CellInterpolation interpolation : {CellInterpolation::condensed, CellInterpolation::trilinear}) {
    Mapping m =
        mapped(Mapping{.poissonRatio = 0.3, .interpolation = interpolation}, grid.view(), rest, child);
    Points x(2);
    m.apply(x, at);
    const double strain = (x[1] - x[0]).norm() / 0.3 - 1;
    if (interpolation == CellInterpolation::condensed)
      CHECK(std::abs(strain) < 0.01 * 0.1);
    else
      CHECK(strain == Approx(0.1));
  }
}

TEST_CASE("bad composite mappings are refused") {
  const auto grid = octahedron<SparseGridTopology>(1);
  const Points rest = places(grid.view());
  auto said = [&](Mapping m, TopologyView const& t, Points const& at) -> std::string {
    try {
      check_fields(m, "body/skin");
      mapped(m, t, at);
    } catch (Error const& e) {
      return e.what();
    }
    return "";
  };
  auto contains = [](std::string const& all, std::string_view part) { return all.find(part) != all.npos; };
  CHECK(contains(said({}, {}, rest), "body/skin: HexahedronCompositeFEMMapping<Vec3d, Vec3d>"));
  CHECK(contains(said({}, {}, rest), "no hexahedron"));
  CHECK(contains(said({.nbVirtualFinerLevels = 2}, grid.view(), rest), "the grid has 1 finer levels"));
  CHECK(contains(said({.poissonRatio = 0.5}, grid.view(), rest), "poissonRatio is 0.5"));
  Points few(rest.begin(), rest.begin() + 3), bent = rest;
  CHECK(contains(said({}, grid.view(), few), "3 points"));
  bent[1] += Vector3d(0.1, 0.2, 0);
  CHECK(contains(said({}, grid.view(), bent), "is no box"));
}

}  // namespace test_hexahedron_composite_fem_mapping
