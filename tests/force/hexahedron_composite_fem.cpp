// SPDX-License-Identifier: BSL-1.0
#include "equilibrium.hpp"

#include <sinew/force/hexahedron_composite_fem.hpp>
#include <sinew/force/hexahedron_fem.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <Eigen/Geometry>
#include <cmath>

namespace test_hexahedron_composite_fem {

using namespace sinew;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using one::force;
using one::ready;
using one::refuses;

namespace {

using Composite = HexahedronCompositeFEMForceField<Vec3d>;

const auto methods = {
    HexahedronMethod::large, HexahedronMethod::polar, HexahedronMethod::small, HexahedronMethod::nearest};

/// A box of cells, whose halves, and halves of these, are as stiff as fill says at the place of their centre;
/// those with less than 0 are not there.
struct Halved {
  Mesh mesh;
  std::vector<CellLevel> levels;

  template <class Fill>
  Halved(std::array<int, 3> cells, Vector3d const& size, int depth, Fill&& fill)
      : mesh(regular_grid(cells[0] + 1, cells[1] + 1, cells[2] + 1, {0, 0, 0}, size)) {
    std::vector<Vector3d> low;  // of the cells of the level above
    for (auto const& h : mesh.hexahedra) low.push_back(mesh.positions[std::size_t(h[0])]);
    Vector3d edge = size.array() / Eigen::Array3d(cells[0], cells[1], cells[2]);
    for (int level = 0; level < depth; ++level) {
      edge /= 2;
      CellLevel& at = levels.emplace_back();
      std::vector<Vector3d> next, points;
      for (std::size_t parent = 0; parent < low.size(); ++parent)
        for (std::size_t octant = 0; octant < 8; ++octant) {
          auto corner = [&](std::size_t k) {
            return Vector3d(edge[0] * hexahedronCorners[k][0],
                            edge[1] * hexahedronCorners[k][1],
                            edge[2] * hexahedronCorners[k][2]);
          };
          const Vector3d begin = low[parent] + corner(octant);
          const double filled = fill(Vector3d(begin + edge / 2));
          if (filled < 0) continue;
          Hexahedron h;
          for (std::size_t k = 0; k < 8; ++k) {
            const Vector3d p = begin + corner(k);
            std::size_t number = 0;
            while (number < points.size() && (points[number] - p).norm() > 1e-9) ++number;
            if (number == points.size()) points.push_back(p);
            h[k] = Index(number);
          }
          at.hexahedra.push_back(h);
          at.parents.push_back(Index(parent));
          at.octants.push_back(int(octant));
          at.fill.push_back(filled);
          at.massFill.push_back(filled);
          next.push_back(begin);
        }
      low = next;
    }
  }
  TopologyView view() const { return {.hexahedra = mesh.hexahedra, .levels = levels}; }
};

Vec3d::VecCoord deformed(Vec3d::VecCoord x, double by) {
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] +=
        by * Vector3d(std::sin(2.0 * double(i)), std::cos(3.0 * double(i)), std::sin(5.0 * double(i) + 1));
  return x;
}

double one_material(Vector3d const&) { return 1; }
double soft_and_stiff(Vector3d const& p) { return p[0] + p[1] > 0.9 ? 20 : 1; }
double with_a_hole(Vector3d const& p) { return (p - Vector3d(0.6, 0.4, 0.3)).norm() < 0.35 ? -1 : 1; }

double difference(Vec3d::VecDeriv const& a, Vec3d::VecDeriv const& b) {
  double sum = 0, size = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).squaredNorm(), size += b[i].squaredNorm();
  return std::sqrt(sum / size);
}

/// Force that stretches a bar of cells by one, whose ends move along x alone and whose sides are free.
double stretched(Halved const& bar, Composite composite, double length) {
  auto fem = ready(composite, bar.mesh.positions, bar.view());
  std::vector<bool> held;
  Vec3d::VecCoord x = bar.mesh.positions;
  for (auto& p : x) {
    const bool end = p[0] < 1e-9 || p[0] > length - 1e-9;
    held.insert(held.end(), {end, p[1] < 1e-9, p[2] < 1e-9});
    if (p[0] > length - 1e-9) p[0] += 1e-3;
  }
  one::settle(fem, x, held, Vec3d::VecDeriv(x.size(), Vector3d::Zero()), 3);
  double pull = 0;
  const auto f = force(fem, x);
  for (std::size_t i = 0; i < x.size(); ++i)
    if (bar.mesh.positions[i][0] > length - 1e-9) pull -= f[i][0];
  return pull / 1e-3;
}

}  // namespace

TEST_CASE("finer cells of one material are the hexahedron that they are in") {
  // a trilinear field is one in each of its parts, and their quadrature is exact
  const Vector3d size(2, 1.5, 1);
  for (const int depth : {0, 1, 2})
    for (const HexahedronMethod method : methods)
      for (const CellInterpolation interpolation :
           {CellInterpolation::condensed, CellInterpolation::trilinear})
        for (const bool directly : {false, true}) {
          CAPTURE(depth, int(method), int(interpolation), directly);
          const Halved halved({2, 1, 1}, size, depth, one_material);
          auto composite = ready(Composite{.poissonRatio = 0.3,
                                           .interpolation = interpolation,
                                           .finestToCoarse = directly,
                                           .method = method,
                                           .youngModulus = {300, 500}},
                                 halved.mesh.positions,
                                 halved.view());
          auto fem = ready(
              HexahedronFEMForceField<Vec3d>{
                  .youngModulus = {300, 500}, .poissonRatio = 0.3, .method = method},
              halved.mesh.positions,
              {.hexahedra = halved.mesh.hexahedra});
          const auto x = deformed(halved.mesh.positions, 0.1);
          CHECK(difference(force(composite, x), force(fem, x)) < 1e-12);
          CHECK(potential_energy(composite, x) == Approx(potential_energy(fem, x)).epsilon(1e-12));
          const auto dx = deformed(Vec3d::VecCoord(x.size(), Vector3d::Zero()), 1);
          CHECK(difference(one::product(composite, dx, 1, 0), one::product(fem, dx, 1, 0)) < 1e-12);
          CHECK((one::stiffness(composite, x.size()) - one::stiffness(fem, x.size())).norm() <
                1e-12 * one::stiffness(fem, x.size()).norm());
        }
}

TEST_CASE("forces are the derivative of the energy, and dforce that of the force") {
  // with method small the law is linear: differences have rounding alone; else the tangent is exact at rest
  for (auto const& fill : {soft_and_stiff, with_a_hole})
    for (const HexahedronMethod method : methods) {
      const Halved halved({2, 1, 1}, {2, 1, 1}, 2, fill);
      auto fem = ready(Composite{.poissonRatio = 0.3, .method = method, .youngModulus = {100}},
                       halved.mesh.positions,
                       halved.view());
      const bool small = method == HexahedronMethod::small;
      const auto at = small ? deformed(halved.mesh.positions, 0.1) : halved.mesh.positions;
      const auto dx = deformed(Vec3d::VecCoord(at.size(), Vector3d::Zero()), 1);
      const double h = 1e-4;
      auto ahead = at, behind = at;
      for (std::size_t i = 0; i < at.size(); ++i) ahead[i] += h * dx[i], behind[i] -= h * dx[i];
      auto change = force(fem, ahead);
      const auto before = force(fem, behind);
      const double rate = (potential_energy(fem, ahead) - potential_energy(fem, behind)) / (2 * h);
      double power = 0;
      const auto f = force(fem, at);
      for (std::size_t i = 0; i < at.size(); ++i) {
        change[i] = (change[i] - before[i]) / (2 * h);
        power -= f[i].dot(dx[i]);
      }
      CHECK(difference(one::product(fem, dx, 1, 0), change) < (small ? 1e-10 : 1e-6));
      // at rest the energy is of second order, k h^2, and its odd part of third
      if (small)
        CHECK(rate == Approx(power).epsilon(1e-8));
      else
        CHECK(rate == Approx(power).margin(10 * potential_energy(fem, ahead)));
    }
}

TEST_CASE("a composite hexahedron moves as a whole at no cost, and its forces turn nothing") {
  for (auto const& fill : {soft_and_stiff, with_a_hole})
    for (const HexahedronMethod method :
         {HexahedronMethod::large, HexahedronMethod::polar, HexahedronMethod::nearest}) {
      const Halved halved({2, 1, 1}, {2, 1, 1}, 2, fill);
      auto fem = ready(Composite{.poissonRatio = 0.3, .method = method, .youngModulus = {100}},
                       halved.mesh.positions,
                       halved.view());
      const Matrix3d q = Eigen::AngleAxisd(1.9, Vector3d(1, -2, 2) / 3).matrix();
      auto turned = halved.mesh.positions, strained = deformed(halved.mesh.positions, 0.1), both = strained;
      for (auto& x : turned) x = q * x + Vector3d(3, 1, -2);
      for (auto& x : both) x = q * x + Vector3d(3, 1, -2);
      CHECK(potential_energy(fem, turned) < 1e-24 * 100);
      CHECK(potential_energy(fem, both) == Approx(potential_energy(fem, strained)).epsilon(1e-12));
      const auto f = force(fem, strained), g = force(fem, both);
      for (std::size_t i = 0; i < f.size(); ++i) CHECK((g[i] - q * f[i]).norm() < 1e-11 * 100);
      // the torque is of second order in the strain, as the rotation is held in the force: 1e-4 of the force
      const auto little = deformed(halved.mesh.positions, 1e-5);
      const auto weak = force(fem, little);
      Vector3d torque = Vector3d::Zero(), sum = Vector3d::Zero();
      double all = 0;
      for (std::size_t i = 0; i < weak.size(); ++i) {
        torque += little[i].cross(weak[i]);
        sum += weak[i];
        all += weak[i].norm();
      }
      CHECK(sum.norm() < 1e-13 * all);
      CHECK(torque.norm() < 1e-4 * all);
    }
}

TEST_CASE("layers along a bar are as stiff as their mean") {
  // nu = 0, half of the section 1 and half 9 times as stiff: E A/L of the mean, exactly, as both stretch
  // alike
  for (const CellInterpolation interpolation : {CellInterpolation::condensed, CellInterpolation::trilinear})
    for (const int depth : {1, 2}) {
      const Halved bar({3, 1, 1}, {3, 1, 1}, depth, [](Vector3d const& p) { return p[2] < 0.5 ? 1 : 9; });
      const double k = stretched(
          bar, Composite{.poissonRatio = 0, .interpolation = interpolation, .youngModulus = {100}}, 3);
      CHECK(k == Approx(100 * (1 + 9) / 2. / 3).epsilon(1e-4));
    }
}

TEST_CASE("layers across a bar are as stiff as springs in series, or no less") {
  // trilinear: each layer takes the same strain, the mean 5. condensed: 2/(1/1 + 1/9) = 1.8, which is a lower
  // bound, as points follow corners of their own edge or face alone
  auto k = [](CellInterpolation interpolation, double ratio) {
    const Halved bar({1, 1, 1}, {1, 1, 1}, 1, [ratio](Vector3d const& p) { return p[0] < 0.5 ? 1 : ratio; });
    return stretched(
        bar, Composite{.poissonRatio = 0, .interpolation = interpolation, .youngModulus = {1}}, 1);
  };
  for (const double ratio : {2.0, 9.0, 1000.0}) {
    const double series = 2 / (1 + 1 / ratio), mean = (1 + ratio) / 2;
    CAPTURE(ratio, series, k(CellInterpolation::condensed, ratio));
    CHECK(k(CellInterpolation::trilinear, ratio) == Approx(mean).epsilon(1e-6));
    CHECK(k(CellInterpolation::condensed, ratio) > series * (1 - 1e-6));
    CHECK(k(CellInterpolation::condensed, ratio) < series * 1.1);
  }
}

TEST_CASE("bad composites are refused") {
  const Halved halved({2, 1, 1}, {2, 1, 1}, 1, one_material);
  auto const& x = halved.mesh.positions;
  refuses(Composite{}, x, {}, {"body", "HexahedronCompositeFEMForceField<Vec3d>", "no hexahedron"});
  refuses(Composite{.nbVirtualFinerLevels = 2},
          x,
          halved.view(),
          {"nbVirtualFinerLevels is 2", "has 1 finer levels"});
  refuses(Composite{.nbVirtualFinerLevels = -1}, x, halved.view(), {"nbVirtualFinerLevels is -1"});
  refuses(Composite{.youngModulus = {1, 2, 3}}, x, halved.view(), {"3 values for 2 hexahedra"});
  refuses(Composite{.youngModulus = {0}}, x, halved.view(), {"youngModulus", "greater than 0"});
  refuses(Composite{.poissonRatio = one::notANumber}, x, halved.view(), {"poissonRatio is nan"});
  auto bent = x;
  bent[1][1] += 0.1;
  refuses(Composite{}, bent, halved.view(), {"is no box"});
  auto sheared = x;
  for (auto& p : sheared) p[0] += 0.3 * p[1];
  refuses(Composite{}, sheared, halved.view(), {"hexahedron 0 is no box"});
  auto mirrored = x;
  for (auto& p : mirrored) p[0] = -p[0];
  refuses(Composite{}, mirrored, halved.view(), {"hexahedron 0 is no box, or inside out"});
  auto flat = x;
  for (auto& p : flat) p[2] = 0;
  refuses(Composite{}, flat, halved.view(), {"hexahedron 0"});
}

}  // namespace test_hexahedron_composite_fem
