// SPDX-License-Identifier: BSL-1.0
#include "equilibrium.hpp"

#include <sinew/force/triangle_fem.hpp>

#include <Eigen/Geometry>
#include <cmath>

namespace test_triangle_fem {

using namespace sinew;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using one::force;
using one::ready;
using one::refuses;

namespace {

using Triangles = TriangleFEMForceField<Vec3d>;

const auto methods = {TriangleMethod::large, TriangleMethod::small, TriangleMethod::polar};

/// A sheet of nx x ny quads of unit sides in the plane z = 0.
struct Sheet {
  Vec3d::VecCoord x;
  std::vector<Triangle> triangles;
  std::vector<Quad> quads;

  Sheet(int nx, int ny) {
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i) x.push_back(Vector3d(i, j, 0));
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const int p = i + (nx + 1) * j;
        quads.push_back({p, p + 1, p + nx + 2, p + nx + 1});
        triangles.push_back({p, p + 1, p + nx + 2});
        triangles.push_back({p, p + nx + 2, p + nx + 1});
      }
  }
};

const Matrix3d tilt = Eigen::AngleAxisd(1.1, Vector3d(1, 2, -2) / 3).matrix();

}  // namespace

TEST_CASE("a surface may lose all of its triangles, but not begin without any") {
  const Sheet sheet(1, 1);
  refuses(Triangles{}, sheet.x, {}, {"the topology has no triangle"});
  auto membrane = ready(Triangles{}, sheet.x, {.triangles = sheet.triangles});
  membrane.init(InitContext<Vec3d>{"body", sheet.x, {}});
  auto x = sheet.x;
  x[0] *= 2, x[3] *= 2;
  for (auto const& f : force(membrane, x)) CHECK(f.norm() == 0);
}

TEST_CASE("patch test: points inside an affine boundary settle to the same affine map, in any plane") {
  Sheet sheet(3, 3);
  std::vector<bool> held;
  for (std::size_t i = 0; i < sheet.x.size(); ++i) {
    auto& p = sheet.x[i];
    const bool inside = p[0] > 0.5 && p[0] < 2.5 && p[1] > 0.5 && p[1] < 2.5;
    if (inside) p += 0.2 * Vector3d(std::sin(3.0 * double(i)), std::cos(5.0 * double(i)), 0);
    p = tilt * p;
    held.insert(held.end(), 3, !inside);
  }
  Matrix3d f = Matrix3d::Identity();
  f.topLeftCorner<2, 2>() << 1.05, 0.02, 0.03, 0.98;
  f = (tilt * f * tilt.transpose()).eval();
  // `large` takes another frame in each element, and meets the test in the limit of small strain only
  for (const TriangleMethod method : {TriangleMethod::small, TriangleMethod::polar}) {
    auto fem = ready(Triangles{.youngModulus = {1e3}, .thickness = 0.1, .method = method},
                     sheet.x,
                     {.triangles = sheet.triangles});
    Vec3d::VecCoord x = sheet.x;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (held[3 * i]) x[i] = f * x[i];
    CHECK(one::settle(fem, x, held, Vec3d::VecDeriv(x.size(), Vector3d::Zero()), 12) < 1e-10);
    for (std::size_t i = 0; i < x.size(); ++i) CHECK((x[i] - f * sheet.x[i]).norm() < 1e-11);
  }
}

TEST_CASE("a sheet under traction stretches as in plane stress and in plane strain") {
  const int nx = 4, ny = 2;
  const double E = 1000, nu = 0.3, h = 0.1, p = 2;
  for (const bool planeStrain : {false, true})
    for (const TriangleMethod method : methods) {
      Sheet sheet(nx, ny);
      std::vector<bool> held;
      Vec3d::VecDeriv load;
      for (auto const& x : sheet.x) {
        for (int c = 0; c < 3; ++c) held.push_back(c == 2 || x[c] == 0);
        const bool end = x[0] == nx, corner = x[1] == 0 || x[1] == ny;
        load.push_back(Vector3d(end ? p * h * (corner ? 0.5 : 1) : 0, 0, 0));
      }
      auto fem = ready(Triangles{.youngModulus = {E},
                                 .poissonRatio = {nu},
                                 .thickness = h,
                                 .planeStrain = planeStrain,
                                 .method = method},
                       sheet.x,
                       {.quads = sheet.quads});
      Vec3d::VecCoord x = sheet.x;
      CHECK(one::settle(fem, x, held, load, 40) < 1e-11);
      const double along = (planeStrain ? 1 - nu * nu : 1) * p / E,
                   across = -(planeStrain ? nu * (1 + nu) : nu) * p / E;
      // frames on the edges turn by the order of the strain where diagonals are their first edge: with a
      // strain of 2e-3 `large` is off by about that part of it; the others see pure stretch
      const double tolerance = method == TriangleMethod::large ? 2 * p / E : 1e-10;
      CHECK(x.back()[0] / nx - 1 == Approx(along).epsilon(tolerance));
      CHECK(x.back()[1] / ny - 1 == Approx(across).epsilon(tolerance));
    }
}

TEST_CASE("each triangle may have a material of its own") {
  const Sheet sheet(1, 1);
  Vec3d::VecCoord x = sheet.x;
  x[2] += Vector3d(0.1, 0.2, 0.3);
  double sum = 0;
  for (const std::size_t e : {0u, 1u}) {
    const std::vector<Triangle> one{sheet.triangles[e]};
    auto fem = ready(Triangles{.youngModulus = {100.0 + double(e)}, .poissonRatio = {0.1 + 0.3 * double(e)}},
                     sheet.x,
                     {.triangles = one});
    sum += potential_energy(fem, x);
  }
  auto both = ready(Triangles{.youngModulus = {100, 101}, .poissonRatio = {0.1, 0.4}},
                    sheet.x,
                    {.triangles = sheet.triangles});
  CHECK(sum > 1);
  CHECK(potential_energy(both, x) == Approx(sum).epsilon(1e-14));
}

TEST_CASE("a membrane turns and bends freely") {
  Sheet sheet(1, 1);
  for (const TriangleMethod method : {TriangleMethod::large, TriangleMethod::polar}) {
    auto fem = ready(Triangles{.method = method}, sheet.x, {.triangles = sheet.triangles});
    Vec3d::VecCoord turned = sheet.x;
    for (auto& x : turned) x = tilt * x + Vector3d(1, 2, 3);
    CHECK(potential_energy(fem, turned) < 1e-26);
    // folded about the common edge 0-3 of the two triangles
    Vec3d::VecCoord folded = sheet.x;
    folded[1] = Eigen::AngleAxisd(1.2, Vector3d(1, 1, 0).normalized()) * folded[1];
    CHECK(potential_energy(fem, folded) < 1e-26);
    for (auto const& f : force(fem, folded)) CHECK(f.norm() < 1e-11);
  }
}

TEST_CASE(
    "a membrane with triangles of another size at rest is in uniform tension, and has none at that size") {
  const int n = 3;
  const double E = 1000, nu = 0.3, h = 0.1, s = 0.9;
  Sheet sheet(n, n);
  for (auto& x : sheet.x) x = tilt * x;
  // membrane forces sum to tension times the length of the edge that they act on
  const double tension = E / (1 - nu) * (1 / s - 1) * h;
  for (const TriangleMethod method : {TriangleMethod::large, TriangleMethod::polar}) {
    auto fem = ready(
        Triangles{
            .youngModulus = {E}, .poissonRatio = {nu}, .thickness = h, .method = method, .restScale = s},
        sheet.x,
        {.triangles = sheet.triangles});
    // the rest area is smaller by s^2 and gradients greater by 1/s: a force per length of s times the tension
    const auto f = force(fem, sheet.x);
    Vector3d edge = Vector3d::Zero();
    for (std::size_t i = 0; i < f.size(); ++i) {
      const bool inside = i % 4 != 0 && i % 4 != 3 && i / 4 != 0 && i / 4 != 3;
      if (inside) CHECK(f[i].norm() < 1e-12 * tension);
      if (i % 4 == 0) edge += f[i];
    }
    CHECK((edge - tilt * Vector3d(s * tension * n, 0, 0)).norm() < 1e-12 * tension);
    Vec3d::VecCoord shrunk = sheet.x;
    for (auto& x : shrunk) x = s * x + Vector3d(1, 2, 3);
    CHECK(potential_energy(fem, shrunk) < 1e-26 * E);
  }
}

TEST_CASE("membranes are checked") {
  const Sheet sheet(1, 1);
  const TopologyView topology{.triangles = sheet.triangles};
  refuses(Triangles{}, sheet.x, {}, {"body", "TriangleFEMForceField<Vec3d>", "no triangle"});
  refuses(Triangles{.youngModulus = {1, 2, 3}}, sheet.x, topology, {"3 values for 2 triangles"});
  refuses(Triangles{.poissonRatio = {}}, sheet.x, topology, {"poissonRatio has 0 values for 2 triangles"});
  refuses(Triangles{.youngModulus = {-1}}, sheet.x, topology, {"youngModulus[0] is -1"});
  refuses(Triangles{.poissonRatio = {0.6}}, sheet.x, topology, {"poissonRatio[0] is 0.6", "at most 0.5"});
  refuses(Triangles{.poissonRatio = {0.5}, .planeStrain = true},
          sheet.x,
          topology,
          {"less than 0.5 in plane strain"});
  refuses(Triangles{.thickness = 0}, sheet.x, topology, {"thickness is 0 m", "greater than 0"});
  refuses(Triangles{.restScale = 0}, sheet.x, topology, {"restScale is 0", "greater than 0"});
  refuses(Triangles{.restScale = one::notANumber}, sheet.x, topology, {"restScale is nan"});
  refuses(Triangles{.thickness = one::notANumber}, sheet.x, topology, {"thickness is nan"});
  Vec3d::VecCoord line = sheet.x;
  for (auto& x : line) x[1] = 0;
  refuses(Triangles{}, line, topology, {"triangle 0 has no area"});
  const std::vector<Triangle> far{{0, 1, 4}};
  refuses(Triangles{}, sheet.x, {.triangles = far}, {"triangle 0 refers to point 4", "4 points"});
}

}  // namespace test_triangle_fem
