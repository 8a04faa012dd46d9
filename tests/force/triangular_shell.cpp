// SPDX-License-Identifier: BSL-1.0
#include "equilibrium.hpp"
#include "frames.hpp"

#include <sinew/force/triangular_shell.hpp>

#include <Eigen/Eigenvalues>

namespace test_triangular_shell {

using namespace sinew;
using Eigen::Quaterniond;
using Eigen::Vector2d;
using Eigen::Vector3d;
using frames::frame;
using frames::moved;
using frames::wave;
using one::force;
using one::ready;
using one::refuses;

namespace {

using Shell = TriangularShellForceField<Rigid3d>;
using VecCoord = Rigid3d::VecCoord;
using VecDeriv = Rigid3d::VecDeriv;

TopologyView over(std::vector<Triangle> const& triangles) {
  TopologyView topology;
  topology.triangles = triangles;
  return topology;
}
// four frames that stand in any way, and a folded sheet of two triangles
const VecCoord folded{frame({0, 0, 0}, Quaterniond(0.3, 0.5, -0.4, 0.7).normalized()),
                      frame({1, 0.2, 0}, Quaterniond(-0.6, 0.2, 0.5, 0.1).normalized()),
                      frame({0.3, 0.9, 0.1}, Quaterniond(0.1, 0.9, 0.2, -0.3).normalized()),
                      frame({1.2, 1.1, 0.5}, Quaterniond(0.7, 0.1, -0.8, 0.2).normalized())};
const std::vector<Triangle> two{{0, 1, 2}, {2, 1, 3}};
const Shell shell{.poissonRatio = 0.3, .youngModulus = 100, .thickness = 0.2};

const PlaneTriangle<double> corners{Vector2d(0.1, 0.2), Vector2d(1.3, 0), Vector2d(0.4, 0.9)};
double area(PlaneTriangle<double> const& p) {
  const Vector2d a = p[1] - p[0], b = p[2] - p[0];
  return (a[0] * b[1] - a[1] * b[0]) / 2;
}
template <class M>
int zeros(M const& k) {
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues();
  CHECK(values[0] > -1e-12 * values.maxCoeff());
  return int((values.array() < 1e-9 * values.maxCoeff()).count());
}

}  // namespace

TEST_CASE("even strain and even curvature have their energies in an element") {
  const double E = 10, h = 0.2, A = area(corners);
  for (const double nu : {0.0, 0.3, 0.5}) {
    const auto membrane = membrane_stiffness(corners, E, nu, h);
    const auto plate = plate_stiffness(corners, E, nu, h);
    CHECK((membrane - membrane.transpose()).norm() < 1e-14 * membrane.norm());
    CHECK((plate - plate.transpose()).norm() < 1e-14 * plate.norm());
    // three rigid motions in the plane and nothing else; none that bends
    CHECK(zeros(membrane) == 3);
    CHECK(zeros(plate) == 0);

    Eigen::Matrix2d g;
    g << 0.3, 0.2, -0.5, 0.7;
    Eigen::Matrix<double, 9, 1> m;
    for (int i = 0; i < 3; ++i) {
      m.segment<2>(3 * i) = g * corners[std::size_t(i)];
      m[3 * i + 2] = (g(1, 0) - g(0, 1)) / 2;
    }
    const Vector3d strain(g(0, 0), g(1, 1), g(0, 1) + g(1, 0));
    CHECK(m.dot(membrane * m) == Approx(A * h * strain.dot(plane_stress(E, nu) * strain)).epsilon(1e-12));

    // w = x'Cx / 2 less the plane through the corners; the rotations are (w_y, -w_x)
    Eigen::Matrix2d c;
    c << 1, 0.3, 0.3, -2;
    Eigen::Matrix3d linear;
    Vector3d w;
    for (int i = 0; i < 3; ++i) {
      Vector2d const& p = corners[std::size_t(i)];
      linear.row(i) << 1, p[0], p[1];
      w[i] = p.dot(c * p) / 2;
    }
    const Vector3d plane = linear.inverse() * w;
    Eigen::Matrix<double, 6, 1> b;
    for (int i = 0; i < 3; ++i) {
      const Vector2d slope = c * corners[std::size_t(i)] - plane.tail<2>();
      b.segment<2>(2 * i) << slope[1], -slope[0];
    }
    const Vector3d curvature(c(0, 0), c(1, 1), 2 * c(0, 1));
    CHECK(b.dot(plate * b) ==
          Approx(A * h * h * h / 12 * curvature.dot(plane_stress(E, nu) * curvature)).epsilon(1e-12));
  }
}

TEST_CASE("how frames stand to a shell, and in which order corners come, changes nothing") {
  const auto x = moved(folded, wave(4, 0.3));
  auto sheet = ready(shell, folded, over(two));
  CHECK(potential_energy(sheet, folded) < 1e-28);
  const auto f = force(sheet, x);
  // other frames at rest, which go along with the same bodies: q r in place of q
  const Quaterniond r = Quaterniond(1, 2, 0, 1).normalized();
  auto restOther = folded, xOther = x;
  for (std::size_t i = 0; i < 4; i += 2) {
    restOther[i].orientation = folded[i].orientation * r;
    xOther[i].orientation = x[i].orientation * r;
    xOther[i].orientation.coeffs() *= -1;  // the same orientation
  }
  auto other = ready(shell, restOther, over(two));
  CHECK(potential_energy(other, xOther) == Approx(potential_energy(sheet, x)).epsilon(1e-12));
  auto turned = ready(shell, folded, over({{1, 2, 0}, {3, 2, 1}})),
       flipped = ready(shell, folded, over({{0, 2, 1}, {1, 2, 3}}));
  const auto g = force(other, xOther), h = force(turned, x), k = force(flipped, x);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK((f[i] - g[i]).norm() < 1e-12 * f[i].norm());
    CHECK((f[i] - h[i]).norm() < 1e-12 * f[i].norm());
    CHECK((f[i] - k[i]).norm() < 1e-12 * f[i].norm());
  }
}

TEST_CASE("the tangent of a shell is the symmetric part of the derivative of its forces, far from rest too") {
  auto sheet = ready(shell, folded, over(two));
  const auto x = moved(folded, wave(4, 0.5, 3));
  frames::check_tangent(sheet, x, 1e-7);
}

TEST_CASE("a shell has six motions without energy, a membrane also those that do not stretch it") {
  for (const bool bending : {true, false}) {
    Shell s = shell;
    s.bending = bending;
    auto sheet = ready(s, folded, over(two));
    force(sheet, folded);
    // each membrane feels its three sides and three drilling rotations; one side is common
    CHECK(zeros(Eigen::MatrixXd(-one::stiffness(sheet, 4))) == (bending ? 6 : 24 - (6 + 6 - 1)));
  }
}

TEST_CASE("quads are two triangles each, where there are no triangles") {
  const auto x = moved(folded, wave(4, 0.2));
  TopologyView quads;
  const std::vector<Quad> all{{0, 1, 3, 2}};
  quads.quads = all;
  auto ofQuad = ready(shell, folded, quads), halved = ready(shell, folded, over({{0, 1, 3}, {0, 3, 2}}));
  CHECK(potential_energy(ofQuad, x) == potential_energy(halved, x));
}

TEST_CASE("shells that cannot be are refused") {
  const auto topology = over(two);
  refuses(
      shell, folded, {}, {"body", "TriangularShellForceField<Rigid3d>", "no triangle", "triangles or quads"});
  refuses(shell, folded, over({{0, 1, 4}}), {"triangle 0 refers to point 4", "4 points"});
  refuses(shell, folded, over({{0, 1, 2}, {0, 1, 1}}), {"triangle 1 has no area"});
  auto collinear = folded;
  collinear[2].center = 2 * collinear[1].center;
  refuses(shell, collinear, topology, {"triangle 0 has no area"});
  refuses(Shell{.poissonRatio = -1}, folded, topology, {"poissonRatio is -1", "greater than -1"});
  refuses(Shell{.poissonRatio = 0.6}, folded, topology, {"poissonRatio is 0.6"});
  refuses(Shell{.youngModulus = 0}, folded, topology, {"youngModulus is 0 Pa"});
  refuses(Shell{.thickness = -1}, folded, topology, {"thickness is -1 m"});
  refuses(Shell{.thickness = one::notANumber}, folded, topology, {"thickness is nan"});
}

}  // namespace test_triangular_shell
