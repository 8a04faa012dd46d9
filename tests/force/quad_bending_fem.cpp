// SPDX-License-Identifier: BSL-1.0
// Plates of quads: membrane strains, shear across the plate, and bad input.
#include "equilibrium.hpp"

#include <sinew/force/quad_bending_fem.hpp>

#include <Eigen/Geometry>
#include <cmath>

namespace test_quad_bending_fem {

using namespace sinew;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using one::force;
using one::ready;
using one::refuses;

namespace {

using Plate = QuadBendingFEMForceField<Vec3d>;

/// A sheet of nx x ny quads of unit sides in a plane that is tilted.
struct Sheet {
  Vec3d::VecCoord x;
  std::vector<Quad> quads;

  Sheet(int nx, int ny, Matrix3d const& turn = Matrix3d::Identity()) {
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i) x.push_back(turn * Vector3d(i, j, 0));
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const int p = i + (nx + 1) * j;
        quads.push_back({p, p + 1, p + nx + 2, p + nx + 1});
      }
  }
};

const Matrix3d tilt = Eigen::AngleAxisd(1.1, Vector3d(1, 2, -2) / 3).matrix();

}  // namespace

TEST_CASE("patch test: points of a plate inside an affine boundary settle to the same affine map") {
  Sheet sheet(3, 3);
  std::vector<bool> held;
  for (auto& p : sheet.x) {
    const bool inside = p[0] > 0.5 && p[0] < 2.5 && p[1] > 0.5 && p[1] < 2.5;
    if (inside) p += 0.2 * Vector3d(std::sin(3 * p[0] + p[1]), std::cos(5 * p[1] - p[0]), 0);
    p = tilt * p;
    held.insert(held.end(), 3, !inside);
  }
  Matrix3d f = Matrix3d::Identity();
  f << 1.05, 0.02, 0, 0.03, 0.98, 0, 0.04, -0.02, 1;  // in its plane, and tilted out of it
  f = (tilt * f * tilt.transpose()).eval();
  auto plate = ready(Plate{.youngModulus = {1e3}, .thickness = 0.1}, sheet.x, {.quads = sheet.quads});
  Vec3d::VecCoord x = sheet.x;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (held[3 * i]) x[i] = f * x[i];
  CHECK(one::settle(plate, x, held, Vec3d::VecDeriv(x.size(), Vector3d::Zero()), 2) < 1e-10);
  for (std::size_t i = 0; i < x.size(); ++i) CHECK((x[i] - f * sheet.x[i]).norm() < 1e-11);
}

TEST_CASE("a plate under traction stretches as in plane stress") {
  const int nx = 4, ny = 2;
  const double E = 1000, nu = 0.3, h = 0.1, p = 2;
  Sheet sheet(nx, ny, tilt);
  std::vector<bool> held;
  Vec3d::VecDeriv load;
  for (auto const& at : sheet.x) {
    const Vector3d x = tilt.transpose() * at;
    const bool end = std::abs(x[0] - nx) < 1e-9, corner = std::abs(x[1]) < 1e-9 || std::abs(x[1] - ny) < 1e-9;
    load.push_back(tilt * Vector3d((end                     ? 1
                                    : std::abs(x[0]) < 1e-9 ? -1
                                                            : 0) *
                                       p * h * (corner ? 0.5 : 1),
                                   0,
                                   0));
    held.insert(held.end(), 3, false);
  }
  auto plate = ready(
      Plate{.youngModulus = {E}, .poissonRatio = {nu}, .thickness = h}, sheet.x, {.quads = sheet.quads});
  Vec3d::VecCoord x = sheet.x;
  CHECK(one::settle(plate, x, held, load, 2) < 1e-10);
  const Vector3d across = tilt.transpose() * (x.back() - x.front());
  CHECK(across[0] == Approx(nx * (1 + p / E)).epsilon(1e-10));
  CHECK(across[1] == Approx(ny * (1 - nu * p / E)).epsilon(1e-10));
}

TEST_CASE("a strip under a load across it sags as a membrane of the tension 5/6 mu h") {
  // held at both ends: w = q x (L - x) / (2 T), which linear elements meet at their points
  const int nx = 8, ny = 2;
  const double E = 1000, nu = 0.25, h = 0.2, q = 0.3, T = 5. / 6 * E / (2 * (1 + nu)) * h;
  Sheet sheet(nx, ny, tilt);
  std::vector<bool> held;
  Vec3d::VecDeriv load;
  for (std::size_t i = 0; i < sheet.x.size(); ++i) {
    const std::size_t column = i % (nx + 1), row = i / (nx + 1);
    held.insert(held.end(), 3, column == 0 || column == nx);
    load.push_back(tilt * Vector3d(0, 0, q * (row == 0 || row == ny ? 0.5 : 1)));
  }
  auto plate = ready(
      Plate{.youngModulus = {E}, .poissonRatio = {nu}, .thickness = h}, sheet.x, {.quads = sheet.quads});
  Vec3d::VecCoord x = sheet.x;
  CHECK(one::settle(plate, x, held, load, 2) < 1e-10);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double at = double(i % (nx + 1));
    const Vector3d moved = tilt.transpose() * (x[i] - sheet.x[i]);
    CHECK((moved - Vector3d(0, 0, q * at * (nx - at) / (2 * T))).norm() < 1e-11);
  }
}

TEST_CASE("forces of a plate are those of its energy, of warped quads too, and none at rest") {
  Sheet sheet(2, 2, tilt);
  for (std::size_t i = 0; i < sheet.x.size(); ++i)
    sheet.x[i] += 0.2 * Vector3d(std::sin(3. * double(i)), std::cos(7. * double(i)), std::sin(double(i)));
  auto plate = ready(Plate{.youngModulus = {100, 200, 50, 10}}, sheet.x, {.quads = sheet.quads});
  for (auto const& f : force(plate, sheet.x)) CHECK(f.norm() < 1e-12);
  Vec3d::VecCoord x = sheet.x;
  Vec3d::VecDeriv u;
  for (std::size_t i = 0; i < x.size(); ++i)
    u.push_back(Vector3d(std::cos(2. * double(i)), std::sin(5. * double(i)), std::cos(double(i))));
  // the energy is quadratic: E(u) = -f.u / 2
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += u[i];
  const auto f = force(plate, x), ku = one::product(plate, u, 1, 0);
  double work = 0, difference = 0;
  for (std::size_t i = 0; i < x.size(); ++i) work += f[i].dot(u[i]), difference += (f[i] - ku[i]).norm();
  CHECK(potential_energy(plate, x) == Approx(-work / 2).epsilon(1e-12));
  CHECK(difference < 1e-11 * std::abs(work));
}

TEST_CASE("plates are checked") {
  const Sheet sheet(1, 1);
  const TopologyView topology{.quads = sheet.quads};
  refuses(Plate{}, sheet.x, {}, {"body", "QuadBendingFEMForceField<Vec3d>", "no quad"});
  refuses(Plate{.youngModulus = {1, 2}}, sheet.x, topology, {"2 values for 1 quads"});
  refuses(Plate{.youngModulus = {0}}, sheet.x, topology, {"youngModulus[0] is 0"});
  refuses(Plate{.poissonRatio = {0.7}}, sheet.x, topology, {"poissonRatio[0] is 0.7", "at most 0.5"});
  refuses(Plate{.thickness = one::notANumber}, sheet.x, topology, {"thickness is nan"});
  const std::vector<Quad> crossed{{0, 1, 2, 3}}, far{{0, 1, 3, 9}};
  refuses(Plate{}, sheet.x, {.quads = crossed}, {"quad 0 has no area, or is not convex"});
  refuses(Plate{}, sheet.x, {.quads = far}, {"quad 0 refers to point 9", "4 points"});
}

}  // namespace test_quad_bending_fem
