// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/topology/inertia.hpp>

#include <Eigen/Geometry>
#include <numbers>

namespace test_inertia {

using namespace sinew;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using std::numbers::pi;

namespace {

MassProperties of(Mesh const& mesh) {
  return mass_properties("body", mesh.positions, mesh.triangles, mesh.quads);
}
template <class F>
Mesh moved(Mesh mesh, F&& f) {
  for (auto& x : mesh.positions) x = f(x);
  return mesh;
}
double error(Matrix3d const& a, Matrix3d const& b) { return (a - b).norm() / b.norm(); }

/// A box around the origin in quads.
Mesh box(Vector3d const& size) {
  Mesh mesh;
  for (int k = 0; k < 8; ++k)
    mesh.positions.push_back(size.cwiseProduct(Vector3d(k % 2 - 0.5, k / 2 % 2 - 0.5, k / 4 - 0.5)));
  mesh.quads = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return mesh;
}
Matrix3d inertia_of_box(Vector3d const& s) {
  const Vector3d q = s.cwiseProduct(s) * s.prod() / 12;
  return Vector3d(q[1] + q[2], q[2] + q[0], q[0] + q[1]).asDiagonal();
}

/// A torus about z: circles of radius r around one of radius R, with n x m points.
Mesh torus(double R, double r, int n, int m) {
  Mesh mesh;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const double a = 2 * pi * i / n, b = 2 * pi * j / m, d = R + r * std::cos(b);
      mesh.positions.push_back({d * std::cos(a), d * std::sin(a), r * std::sin(b)});
      auto at = [&](int u, int v) { return u % n * m + v % m; };
      mesh.quads.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

}  // namespace

TEST_CASE("a box has its volume, centre and inertia, wherever it is and however it is turned") {
  const Vector3d size(2, 3, 5);
  const Eigen::Quaterniond rotation(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 2).normalized()));
  for (Vector3d const& center : {Vector3d(0, 0, 0), Vector3d(-4, 7, 1), Vector3d(1e3, 1e3, -1e3)}) {
    const auto body =
        of(moved(box(size), [&](Vector3d const& x) -> Vector3d { return center + rotation * x; }));
    // rounding of coordinates: 1e-16 of the distance from the origin
    const double tolerance = 1e-14 * (1 + center.norm());
    CHECK(body.volume == Approx(30).epsilon(tolerance));
    CHECK((body.center - center).norm() < 10 * tolerance);
    const Matrix3d r = rotation.toRotationMatrix();
    CHECK(error(body.inertia, r * inertia_of_box(size) * r.transpose()) < tolerance);
  }
}

TEST_CASE("a tetrahedron has the inertia of its corners") {
  // of uniform density: covariance V/20 sum (x_i - c)(x_i - c)', the centre being the mean of the corners
  Mesh mesh;
  mesh.positions = {{1, 0, 2}, {4, 1, 1}, {2, 5, 0}, {0, 1, 6}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  Matrix3d edges, covariance = Matrix3d::Zero();
  Vector3d center = Vector3d::Zero();
  for (auto const& x : mesh.positions) center += x / 4;
  for (int k = 0; k < 3; ++k) edges.col(k) = mesh.positions[std::size_t(k) + 1] - mesh.positions[0];
  const double volume = std::abs(edges.determinant()) / 6;
  for (auto const& x : mesh.positions) covariance += volume / 20 * (x - center) * (x - center).transpose();
  const auto body = of(mesh);
  CHECK(body.volume == Approx(volume).epsilon(1e-14));
  CHECK((body.center - center).norm() < 1e-14);
  CHECK(error(body.inertia, covariance.trace() * Matrix3d::Identity() - covariance) < 1e-14);
  // faces that look inwards bound the same body
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  const auto inside = of(mesh);
  CHECK(inside.volume == Approx(volume).epsilon(1e-14));
  CHECK((inside.center - center).norm() < 1e-14);
  CHECK(error(inside.inertia, body.inertia) < 1e-14);
}

TEST_CASE("a torus converges with the square of the size of its faces") {
  const double R = 2, r = 0.6, volume = 2 * pi * pi * R * r * r;
  const Matrix3d inertia =
      volume *
      Vector3d(R * R / 2 + 5 * r * r / 8, R * R / 2 + 5 * r * r / 8, R * R + 3 * r * r / 4).asDiagonal();
  double last = 0;
  for (const int n : {16, 32, 64}) {
    const auto body = of(torus(R, r, n, n));
    const double wrong = error(body.inertia, inertia);
    CHECK(body.center.norm() < 1e-13);
    CHECK(std::abs(body.volume / volume - 1) < 20. / (n * n));
    if (last > 0) CHECK(last / wrong == Approx(4).epsilon(0.05));
    last = wrong;
  }
  CHECK(last < 5e-3);
}

TEST_CASE("a hollow body is what is between two surfaces") {
  const Vector3d outer(4, 4, 4), inner(2, 1, 3), at(0.5, -0.5, 0.2);
  Mesh both = box(outer);
  const Mesh hole = moved(box(inner), [&](Vector3d const& x) -> Vector3d { return x + at; });
  for (auto q : hole.quads) both.quads.push_back({q[3] + 8, q[2] + 8, q[1] + 8, q[0] + 8});
  both.positions.insert(both.positions.end(), hole.positions.begin(), hole.positions.end());
  const auto body = of(both);
  CHECK(body.volume == Approx(64 - 6));
  const Vector3d center = -6 * at / 58;
  CHECK((body.center - center).norm() < 1e-14);
  // Steiner: both about the common centre
  auto shifted = [](double v, Vector3d const& d) -> Matrix3d {
    return v * (d.squaredNorm() * Matrix3d::Identity() - d * d.transpose());
  };
  const Matrix3d expected =
      inertia_of_box(outer) + shifted(64, center) - inertia_of_box(inner) - shifted(6, at - center);
  CHECK(error(body.inertia, expected) < 1e-13);
}

TEST_CASE("surfaces without an inside are refused") {
  auto says = [](Mesh const& mesh, std::string_view words) {
    const std::string said = error_of([&] { of(mesh); });
    INFO(said);
    CHECK(said.find("body: ") == 0);
    CHECK(said.find(words) != said.npos);
  };
  Mesh mesh = box({1, 1, 1});
  says({}, "there is no triangle and no quad");
  Mesh open = mesh;
  open.quads.pop_back();
  says(open, "not closed");
  says(open, "at the edge from point 1 to 3");
  Mesh turned = mesh;
  std::swap(turned.quads[0][1], turned.quads[0][3]);
  says(turned, "not oriented alike");
  Mesh missing = mesh;
  missing.quads[2][1] = 8;
  says(missing, "quad 2 refers to point 8");
  says(moved(mesh, [](Vector3d const& x) { return Vector3d(x[0], x[1], 0); }), "holds no volume");
}

}  // namespace test_inertia
