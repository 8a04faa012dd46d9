// SPDX-License-Identifier: BSL-1.0
#include "equilibrium.hpp"

#include <sinew/force/hexahedron_fem.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace test_hexahedron_fem {

using namespace sinew;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using one::force;
using one::ready;
using one::refuses;

namespace {

using Hexahedra = HexahedronFEMForceField<Vec3d>;

const auto methods = {
    HexahedronMethod::large, HexahedronMethod::polar, HexahedronMethod::small, HexahedronMethod::nearest};

bool inside(Vector3d const& p) { return (p.array() > 1e-9).all() && (p.array() < 1 - 1e-9).all(); }

Mesh shaken_block(int n) {  // the unit cube in n^3 cells
  Mesh mesh = regular_grid(n + 1, n + 1, n + 1, {0, 0, 0}, {1, 1, 1});
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (inside(mesh.positions[i]))
      mesh.positions[i] +=
          0.2 / n * Vector3d(std::sin(3.0 * double(i)), std::cos(5.0 * double(i)), std::sin(7.0 * double(i)));
  return mesh;
}

}  // namespace

TEST_CASE("hexahedra that are half filled are half as stiff") {
  const Mesh mesh = shaken_block(2);
  const std::vector<double> fill(8, 0.5);
  Vec3d::VecCoord moved = mesh.positions;
  for (std::size_t i = 0; i < moved.size(); ++i)
    moved[i] += 0.05 * Vector3d(std::sin(2.0 * double(i)), std::cos(double(i)), 0.3);
  auto of = [&](std::span<double const> filled) {
    return ready(Hexahedra{.youngModulus = {100}, .poissonRatio = 0.3},
                 mesh.positions,
                 {.hexahedra = mesh.hexahedra, .fill = filled});
  };
  auto whole = of({}), half = of(fill);
  const auto all = force(whole, moved), part = force(half, moved);
  for (std::size_t i = 0; i < all.size(); ++i) CHECK((part[i] - 0.5 * all[i]).norm() < 1e-13 * all[i].norm());
}

TEST_CASE("the stiffness of a hexahedron is the integral of B'CB") {
  // one distorted element; its corners' signs in VTK's order
  const double sign[8][3] = {
      {-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
  Vec3d::VecCoord x;
  for (int i = 0; i < 8; ++i)
    x.push_back(Vector3d(sign[i][0], 1.5 * sign[i][1], 0.7 * sign[i][2]) +
                0.2 * Vector3d(std::sin(3.0 * i), std::cos(5.0 * i), std::sin(7.0 * i)));
  const std::vector<Hexahedron> element{{0, 1, 2, 3, 4, 5, 6, 7}};
  const double E = 100, nu = 0.3, g = 1 / std::sqrt(3);
  Eigen::Matrix<double, 6, 6> C = Eigen::Matrix<double, 6, 6>::Zero();
  C.topLeftCorner<3, 3>().setConstant(nu);
  C.topLeftCorner<3, 3>().diagonal().setConstant(1 - nu);
  C.bottomRightCorner<3, 3>().diagonal().setConstant((1 - 2 * nu) / 2);
  C *= E / ((1 + nu) * (1 - 2 * nu));
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(24, 24);
  for (int point = 0; point < 8; ++point) {
    const double at[3] = {point & 1 ? g : -g, point & 2 ? g : -g, point & 4 ? g : -g};
    Eigen::Matrix<double, 8, 3> slope;
    Matrix3d J = Matrix3d::Zero();
    for (int i = 0; i < 8; ++i)
      for (int k = 0; k < 3; ++k) {
        slope(i, k) = sign[i][k] / 8;
        for (int l = 0; l < 3; ++l)
          if (l != k) slope(i, k) *= 1 + sign[i][l] * at[l];
        J.col(k) += x[std::size_t(i)] * slope(i, k);
      }
    const Eigen::Matrix<double, 8, 3> grad = slope * J.inverse();
    Eigen::MatrixXd B = Eigen::MatrixXd::Zero(6, 24);
    for (int i = 0; i < 8; ++i) {
      const double a = grad(i, 0), b = grad(i, 1), c = grad(i, 2);
      B.middleCols<3>(3 * i) << a, 0, 0, 0, b, 0, 0, 0, c, b, a, 0, 0, c, b, c, 0, a;
    }
    K += J.determinant() * B.transpose() * C * B;
  }
  for (const HexahedronMethod method : methods) {
    auto fem = ready(
        Hexahedra{.youngModulus = {E}, .poissonRatio = nu, .method = method}, x, {.hexahedra = element});
    force(fem, x);
    CHECK((one::stiffness(fem, 8) + K).norm() < 1e-13 * K.norm());
  }
}

TEST_CASE("parallelepipeds are integrated as other hexahedra are") {
  // sheared, deformed much; their sums have other orders: rounding
  Matrix3d shear;
  shear << 1, 0.3, -0.2, 0.1, 1.2, 0.25, -0.15, 0.05, 0.8;
  Mesh mesh = regular_grid(3, 3, 3, {0, 0, 0}, {1, 1, 1});
  for (auto& p : mesh.positions) p = shear * p + Vector3d(3, -2, 1);
  Vec3d::VecCoord x = mesh.positions;
  Vec3d::VecDeriv dx;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double t = double(i);
    x[i] += 0.2 * Vector3d(std::sin(3 * t), std::cos(5 * t), std::sin(7 * t));
    dx.push_back({std::cos(2 * t), std::sin(3 * t), std::cos(4 * t)});
  }
  auto same = [](auto const& a, auto const& b) {
    double difference = 0, size = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      difference = std::max(difference, (a[i] - b[i]).norm());
      size = std::max(size, a[i].norm());
    }
    return size > 1 && difference < 1e-13 * size;
  };
  for (const HexahedronMethod method : methods) {
    auto fem = ready(Hexahedra{.youngModulus = {1e3}, .poissonRatio = 0.3, .method = method},
                     mesh.positions,
                     {.hexahedra = mesh.hexahedra});
    REQUIRE(fem.parallelepipeds);
    auto general = fem;
    general.parallelepipeds = false;
    CHECK(same(force(general, x), force(fem, x)));
    CHECK(same(one::product(general, dx, 1, 0), one::product(fem, dx, 1, 0)));

    const Hexahedron& element = mesh.hexahedra[5];
    Vector3d rest[8], at[8], v[8], f[8];
    for (std::size_t i = 0; i < 8; ++i) {
      rest[i] = mesh.positions[std::size_t(element[i])];
      at[i] = x[std::size_t(element[i])];
      v[i].setZero();
    }
    const auto constants = HexahedronFEM<Vec3d>::restOf(rest, 400, 600, method);
    const HexahedronFEM<Vec3d> terms{method, true}, points{method, false};
    HexahedronFEM<Vec3d>::Tangent tangent;
    points.force(constants, at, v, f, tangent);
    CHECK(terms.energy(constants, at) == Approx(points.energy(constants, at)).epsilon(1e-13));
    for (int i = 0; i < 8; ++i)
      for (int j = i; j < 8; ++j) {
        CAPTURE(i, j);
        const Matrix3d expected = points.block(constants, tangent, i, j, 1, 0);
        CHECK((terms.block(constants, tangent, i, j, 1, 0) - expected).norm() < 1e-13 * 1e3);
      }
  }
  // a corner moved by more than rounding makes it one of the others
  mesh.positions[13][0] += 1e-12;
  CHECK_FALSE(ready(Hexahedra{}, mesh.positions, {.hexahedra = mesh.hexahedra}).parallelepipeds);
}

TEST_CASE("patch test: points inside an affine boundary settle to the same affine map") {
  const Mesh mesh = shaken_block(3);
  Matrix3d f;
  f << 1.05, 0.02, -0.01, 0.03, 0.98, 0.02, 0.01, -0.02, 1.04;
  // `large` takes another frame in each distorted element, and meets the test in the limit of small strain
  // only
  for (const HexahedronMethod method : {HexahedronMethod::small, HexahedronMethod::nearest}) {
    auto fem = ready(Hexahedra{.youngModulus = {1e4}, .poissonRatio = 0.3, .method = method},
                     mesh.positions,
                     {.hexahedra = mesh.hexahedra});
    Vec3d::VecCoord x = mesh.positions;
    std::vector<bool> held;
    for (auto& p : x) {
      held.insert(held.end(), 3, !inside(p));
      if (!inside(p)) p = f * p;
    }
    const double left = one::settle(fem, x, held, Vec3d::VecDeriv(x.size(), Vector3d::Zero()), 12);
    CHECK(left < 1e-9);  // of forces of the order of 1e4 Pa times areas of 0.1 m^2
    for (std::size_t i = 0; i < x.size(); ++i) CHECK((x[i] - f * mesh.positions[i]).norm() < 1e-11);
  }
}

TEST_CASE("a block under traction stretches by p/E and thins by nu p/E") {
  const Mesh mesh = regular_grid(3, 4, 5, {0, 0, 0}, {1, 1.5, 4});
  const double E = 2000, nu = 0.35, p = 300;
  // planes of symmetry at 0; a dead load p on the end, a quarter of each face's to its corners
  std::vector<bool> held;
  for (auto const& x : mesh.positions)
    for (int c = 0; c < 3; ++c) held.push_back(x[c] < 1e-12);
  Vec3d::VecDeriv load(mesh.positions.size(), Vector3d::Zero());
  double total = 0;
  for (auto const& h : mesh.hexahedra)
    if (mesh.positions[std::size_t(h[4])][2] > 4 - 1e-12)
      for (std::size_t k = 4; k < 8; ++k) {
        load[std::size_t(h[k])][2] += p * (0.5 * 0.5) / 4;
        total += p * (0.5 * 0.5) / 4;
      }
  REQUIRE(total == Approx(p * 1.5));
  // the axes of the strain are those of the elements: all methods find no rotation, and the strain is linear
  for (const HexahedronMethod method : methods) {
    auto fem = ready(Hexahedra{.youngModulus = {E}, .poissonRatio = nu, .method = method},
                     mesh.positions,
                     {.hexahedra = mesh.hexahedra});
    Vec3d::VecCoord x = mesh.positions;
    CHECK(one::settle(fem, x, held, load, 3) < 1e-9 * total);
    const Vector3d stretch(1 - nu * p / E, 1 - nu * p / E, 1 + p / E);
    for (std::size_t i = 0; i < x.size(); ++i)
      CHECK((x[i] - mesh.positions[i].cwiseProduct(stretch)).norm() < 1e-11);
    CHECK(potential_energy(fem, x) == Approx(0.5 * p * p / E * 1.5 * 4));
  }
}

TEST_CASE("a large rotation costs no energy, and turns the forces of a strain") {
  const Mesh mesh = shaken_block(2);
  Vec3d::VecCoord strained = mesh.positions;
  for (std::size_t i = 0; i < strained.size(); ++i)
    strained[i] +=
        0.1 * Vector3d(std::cos(2.0 * double(i)), std::sin(3.0 * double(i)), std::cos(5.0 * double(i)));
  for (const HexahedronMethod method :
       {HexahedronMethod::large, HexahedronMethod::polar, HexahedronMethod::nearest})
    for (const double angle : {0.5, 1.6, 3.1}) {
      auto fem = ready(Hexahedra{.youngModulus = {3000}, .poissonRatio = 0.3, .method = method},
                       mesh.positions,
                       {.hexahedra = mesh.hexahedra});
      const Matrix3d rotation = Eigen::AngleAxisd(angle, Vector3d(1, 2, -2) / 3).matrix();
      Vec3d::VecCoord turned = mesh.positions, both = strained;
      for (auto& x : turned) x = rotation * x + Vector3d(1, 2, 3);
      for (auto& x : both) x = rotation * x + Vector3d(1, 2, 3);
      CHECK(potential_energy(fem, turned) < 1e-24 * 3000);  // (rounding of the strain)^2 times the modulus
      CHECK(potential_energy(fem, both) == Approx(potential_energy(fem, strained)).epsilon(1e-12));
      const auto f = force(fem, strained), g = force(fem, both);
      for (std::size_t i = 0; i < f.size(); ++i) CHECK((g[i] - rotation * f[i]).norm() < 1e-11 * 3000);
    }
}

// A box of a x b x c sheared by s across y, F = (1 s; 0 1): the rotation of its edges (a s b; 0 b) in the
// plane has tan t = -s b / (a + b), that of F itself tan t = -s / 2, and of a cube they are the same.
TEST_CASE("the rotation of a sheared box is that of its edges, or of its deformation") {
  const double E = 100, nu = 0.3, a = 2, c = 3, s = 0.4;
  const double lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), mu = E / (2 * (1 + nu));
  for (const double b : {0.5, 2.0}) {
    const Mesh mesh = regular_grid(2, 2, 2, {0, 0, 0}, {a, b, c});
    Vec3d::VecCoord x = mesh.positions;
    for (auto& p : x) p[0] += s * p[1];
    for (const HexahedronMethod method : {HexahedronMethod::polar, HexahedronMethod::nearest}) {
      const double t = method == HexahedronMethod::polar ? std::atan2(-s * b, a + b) : std::atan2(-s, 2);
      Eigen::Matrix2d F, R;
      F << 1, s, 0, 1;
      R << std::cos(t), -std::sin(t), std::sin(t), std::cos(t);
      const Eigen::Matrix2d g = F * R.transpose(),
                            e = 0.5 * (g + g.transpose()) - Eigen::Matrix2d::Identity();
      auto fem = ready(Hexahedra{.youngModulus = {E}, .poissonRatio = nu, .method = method},
                       mesh.positions,
                       {.hexahedra = mesh.hexahedra});
      CHECK(potential_energy(fem, x) ==
            Approx(a * b * c * (mu * e.squaredNorm() + lambda / 2 * e.trace() * e.trace())).epsilon(1e-12));
    }
  }
}

TEST_CASE("hexahedra may differ in stiffness, and are checked") {
  const Mesh mesh = regular_grid(3, 2, 2, {0, 0, 0}, {2, 1, 1});
  const TopologyView topology{.hexahedra = mesh.hexahedra};
  auto fem = ready(Hexahedra{.youngModulus = {100, 300}, .poissonRatio = 0}, mesh.positions, topology);
  // both stretched alike by 1 %: E/2 e^2 each
  Vec3d::VecCoord x = mesh.positions;
  for (auto& p : x) p[0] *= 1.01;
  CHECK(potential_energy(fem, x) == Approx(0.5 * (100 + 300) * 1e-4));

  refuses(Hexahedra{}, mesh.positions, {}, {"body", "HexahedronFEMForceField<Vec3d>", "no hexahedron"});
  refuses(Hexahedra{.youngModulus = {1, 2, 3}}, mesh.positions, topology, {"3 values for 2 hexahedra"});
  refuses(Hexahedra{.youngModulus = {1, 0}},
          mesh.positions,
          topology,
          {"youngModulus[1] is 0 Pa", "greater than 0"});
  refuses(Hexahedra{.poissonRatio = 0.5}, mesh.positions, topology, {"poissonRatio is 0.5", "less than 0.5"});
  refuses(Hexahedra{.poissonRatio = one::notANumber}, mesh.positions, topology, {"poissonRatio is nan"});
  std::vector<Hexahedron> bad = mesh.hexahedra;
  std::swap(bad[1][0], bad[1][1]);
  refuses(Hexahedra{}, mesh.positions, {.hexahedra = bad}, {"hexahedron 1 is flat, inside out or twisted"});
  Vec3d::VecCoord flat = mesh.positions;
  for (auto& p : flat) p[2] = 0;
  refuses(Hexahedra{}, flat, topology, {"hexahedron 0 is flat"});
  bad[1][0] = 12;
  refuses(Hexahedra{}, mesh.positions, {.hexahedra = bad}, {"hexahedron 1 refers to point 12", "12 points"});
}

}  // namespace test_hexahedron_fem
