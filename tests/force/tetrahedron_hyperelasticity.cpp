// SPDX-License-Identifier: BSL-1.0
#include "equilibrium.hpp"

#include <sinew/force/tetrahedron_hyperelasticity.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>

namespace test_tetrahedron_hyperelasticity {

using namespace sinew;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using one::force;
using one::ready;
using one::refuses;

namespace {

using Body = TetrahedronHyperelasticityFEMForceField<Vec3d>;
using Material = HyperelasticMaterial;

const std::vector<Tetrahedron> single{{0, 1, 2, 3}};
const Vec3d::VecCoord corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

Body of(Material material, std::vector<double> const& parameters) {
  Body body;
  body.materialName = material;
  body.parameterSet = parameters;
  return body;
}
/// Each material without directions; the shear moduli at rest are near to 1.
std::vector<Body> isotropic() {
  return {of(Material::ArrudaBoyce, {1, 5}),
          of(Material::StVenantKirchhoff, {1, 3}),
          of(Material::NeoHookean, {1, 3}),
          of(Material::MooneyRivlin, {0.3, 0.2, 5}),
          of(Material::Ogden, {2, 3.5, 5}),
          of(Material::Ogden, {1, 1.3, 0.5, -2, 0.3, 7, 5}),
          of(Material::StableNeoHookean, {1, 3}),
          of(Material::VerondaWestman, {0.5, 2, 5})};
}
/// Those with directions: along x, y and z, turned, and with two families of dispersed fibres.
std::vector<Body> directed() {
  std::vector<Body> all{of(Material::Costa, {1, 5, 4, 2, 3, 2.5, 1.5, 2}),
                        of(Material::Costa, {1, 5, 4, 2, 3, 2.5, 1.5, 2}),
                        of(Material::HolzapfelGasserOgden, {1, 5, 2, 0.8, 0}),
                        of(Material::HolzapfelGasserOgden, {1, 5, 2, 0.8, 0.15})};
  all[1].fiberDirections = all[3].fiberDirections = {{1, 2, -1}};
  all[1].sheetDirections = all[3].sheetDirections = {{0, 1, 1}};
  all[3].anisotropyDirections = {{0.8, 0.6, 0}, {0.8, -0.6, 0.1}};
  return all;
}
std::vector<Body> bodies() {
  std::vector<Body> all = isotropic();
  for (Body const& body : directed()) all.push_back(body);
  return all;
}

/// Positions of the corners under F, of which the columns are the edges.
Vec3d::VecCoord deformed(Matrix3d const& f) {
  Vec3d::VecCoord x;
  for (auto const& p : corners) x.push_back(f * p);
  return x;
}
Matrix3d rotation(double angle, Vector3d const& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).matrix();
}
/// U diag(s) V' with rotations that are no multiples of anything.
Matrix3d of_stretches(double a, double b, double c) {
  return rotation(1.1, {1, 2, -2}) * Vector3d(a, b, c).asDiagonal() * rotation(-0.7, {3, 1, 1});
}

/// The rotation in F.
Matrix3d rotation_of(Matrix3d const& f) {
  const auto svd = singular_values(f);
  return svd.u * svd.v.transpose();
}

/// d2W/dF2 times the volume 1/6: its rows and columns are those of the points 1 to 3, since F has the edges.
Eigen::MatrixXd second_derivative(Body& body, Matrix3d const& f) {
  force(body, deformed(f));
  return -one::stiffness(body, 4).bottomRightCorner(9, 9);
}

}  // namespace

TEST_CASE("singular values of any matrix, with rotations") {
  for (Matrix3d const& f : {of_stretches(3, 2, 1),
                            of_stretches(1, 1, -1),
                            of_stretches(1, 1e-9, 1e-12),
                            of_stretches(2, 2, 1e-3),
                            of_stretches(5, 0, 0),
                            of_stretches(5, 4, 0),
                            Matrix3d(Matrix3d::Zero()),
                            Matrix3d(Matrix3d::Identity()),
                            Matrix3d(Vector3d(-1, -2, -3).asDiagonal())}) {
    const auto svd = singular_values(f);
    const double scale = std::max(f.norm(), 1e-300);
    CHECK((svd.u.transpose() * svd.u - Matrix3d::Identity()).norm() < 1e-14);
    CHECK((svd.v.transpose() * svd.v - Matrix3d::Identity()).norm() < 1e-14);
    CHECK(svd.u.determinant() > 0);
    CHECK(svd.v.determinant() > 0);
    // F'F loses what is below the root of rounding: seen where F makes nearly a line of space
    const double line = svd.sigma[1] < 1e-7 * scale ? 1e-8 : 1e-14;
    CHECK((svd.u * svd.sigma.asDiagonal() * svd.v.transpose() - f).norm() <= line * scale);
    CHECK(svd.sigma[0] >= svd.sigma[1] - 1e-14 * scale);
    CHECK(svd.sigma[1] >= std::abs(svd.sigma[2]) - 1e-14 * scale);
  }
}

TEST_CASE("energy, force and tangent are derivatives of one another, of inverted elements too") {
  // equal stretches, rest, a smallest ratio just passed, flat, inside out, nearly a line
  const std::vector<Matrix3d> shapes{of_stretches(1.3, 0.9, 0.7),
                                     of_stretches(1.2, 1.2, 0.8),
                                     of_stretches(0.9, 0.9, 0.9),
                                     Matrix3d::Identity(),
                                     of_stretches(1.5, 1.2, 0.05),
                                     of_stretches(1, 0.4, 0.3),
                                     of_stretches(1.1, 0.9, 0),
                                     of_stretches(1, 1, -1),
                                     of_stretches(1.3, 0.8, -0.6),
                                     of_stretches(2, 0.02, 0.02)};
  for (Body const& setting : bodies())
    for (Matrix3d const& f : shapes) {
      // fibres begin to pull where the shape does not change, and the tangent jumps
      if (setting.materialName == Material::HolzapfelGasserOgden &&
          (f - f.norm() / std::sqrt(3.) * rotation_of(f)).norm() < 1e-12)
        continue;
      Body body = ready(setting, corners, {.tetrahedra = single});
      INFO(enum_names(Material{})[std::size_t(body.materialName)] << " F = " << f);
      const auto x = deformed(f), f0 = force(body, x);
      const Eigen::MatrixXd k = one::stiffness(body, 4);
      // differences over 2 h: rounding 1e-16 W/h, truncation h^2 W''' with W''' up to 1e3 times W'', since
      // the functions of J change over the smallest ratio, 0.3
      const double h = 1e-6, tolerance = 1e-7 * (1 + k.norm());
      for (long i = 0; i < 12; ++i) {
        auto moved = [&](double by) {
          auto y = x;
          y[std::size_t(i / 3)][i % 3] += by;
          return y;
        };
        const double slope = (potential_energy(body, moved(h)) - potential_energy(body, moved(-h))) / (2 * h);
        CHECK(std::abs(slope + f0[std::size_t(i / 3)][i % 3]) < tolerance);
        Body other = body;
        const auto high = force(other, moved(h)), low = force(other, moved(-h));
        for (long j = 0; j < 12; ++j)
          CHECK(std::abs((high[std::size_t(j / 3)][j % 3] - low[std::size_t(j / 3)][j % 3]) / (2 * h) -
                         k(j, i)) < tolerance);
      }
    }
}

TEST_CASE("at rest all materials are linear ones of the same two moduli, and cost nothing") {
  for (Body const& setting : isotropic()) {
    Body body = ready(setting, corners, {.tetrahedra = single});
    INFO(enum_names(Material{})[std::size_t(body.materialName)]);
    CHECK(std::abs(potential_energy(body, corners)) < 1e-15);
    for (auto const& f : force(body, corners)) CHECK(f.norm() < 1e-15);
    const auto [shear, bulk] = rest_moduli(body.materialName, body.parameterSet);
    // d2W/dF2 = 2 G sym + (K - 2/3 G) tr
    const Eigen::MatrixXd a = second_derivative(body, Matrix3d::Identity());
    for (long p = 0; p < 9; ++p)
      for (long q = 0; q < 9; ++q) {
        const long i = p % 3, m = p / 3, j = q % 3, n = q / 3;
        const double sym = (i == j) * (m == n) + (i == n) * (m == j), trace = (i == m) * (j == n);
        CHECK(a(p, q) == Approx((shear * sym + (bulk - 2 * shear / 3) * trace) / 6).margin(1e-14));
      }
  }
}

TEST_CASE("matrixRegularization takes the negative eigenvalues out of the tangent, and nothing else") {
  int negative = 0, positive = 0;
  for (Body const& setting : isotropic())
    for (Matrix3d const& f : {of_stretches(1.3, 1.1, 1.05),
                              of_stretches(1.3, 0.9, 0.4),
                              of_stretches(0.7, 0.6, 0.5),
                              of_stretches(0.8, 0.8, 0.8),
                              of_stretches(1.3, 0.8, -0.6)}) {
      Body exact = ready(setting, corners, {.tetrahedra = single});
      Body regular = exact;
      regular.matrixRegularization = true;
      INFO(enum_names(Material{})[std::size_t(exact.materialName)] << " F = " << f);
      const Eigen::MatrixXd a = second_derivative(exact, f), b = second_derivative(regular, f);
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(a);
      const Eigen::MatrixXd wanted = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() *
                                     eigen.eigenvectors().transpose();
      (eigen.eigenvalues()[0] < -1e-3 ? negative : positive) += 1;
      CHECK((b - wanted).norm() < 1e-12 * a.norm());
      const auto fa = force(exact, deformed(f)), fb = force(regular, deformed(f));
      for (std::size_t i = 0; i < 4; ++i) CHECK((fa[i] - fb[i]).norm() < 1e-13 * a.norm());
    }
  CHECK(negative > 5);
  CHECK(positive > 2);
}

TEST_CASE("crushing an element to a point and through it costs more and more") {
  for (Body const& setting : bodies()) {
    // these give way when they are crushed, or turned inside out
    if (setting.materialName == Material::StVenantKirchhoff || setting.materialName == Material::Costa)
      continue;
    Body body = ready(setting, corners, {.tetrahedra = single});
    INFO(enum_names(Material{})[std::size_t(body.materialName)]);
    double last = 0;
    for (double s = 0.9; s > -1.5; s -= 0.05) {
      const double energy = potential_energy(body, deformed(of_stretches(1, 1, s)));
      INFO("s = " << s);
      CHECK(energy > last);
      last = energy;
    }
  }
}

TEST_CASE("materials with directions are at rest without stress, and turn with their fibres") {
  const Matrix3d turn = rotation(0.8, {2, -1, 1}), f = of_stretches(1.3, 0.9, 0.8);
  for (Body setting : directed()) {
    INFO(enum_names(Material{})[std::size_t(setting.materialName)]);
    if (setting.fiberDirections.empty())
      setting.fiberDirections = {{1, 0, 0}}, setting.sheetDirections = {{0, 1, 0}};
    Body body = ready(setting, corners, {.tetrahedra = single});
    CHECK(std::abs(potential_energy(body, corners)) < 1e-15);
    for (auto const& p : force(body, corners)) CHECK(p.norm() < 1e-15);
    // the body is turned afterwards: so are its forces
    const auto forces = force(body, deformed(f)), turned = force(body, deformed(turn * f));
    for (std::size_t i = 0; i < 4; ++i) CHECK((turned[i] - turn * forces[i]).norm() < 1e-14);
    // the body is turned before, with its fibres: F Q' of fibres Q a
    Body other = setting;
    for (auto& d : other.fiberDirections) d = turn * d;
    for (auto& d : other.sheetDirections) d = turn * d;
    other = ready(other, corners, {.tetrahedra = single});
    const Vec3d::VecCoord x = deformed(f * turn.transpose());
    CHECK(potential_energy(other, x) == Approx(potential_energy(body, deformed(f))).epsilon(1e-13));
    // P' = P Q', and forces on points 1 to 3 are the columns of -P/6
    const auto p = force(other, x);
    Matrix3d first, second;
    for (int i = 0; i < 3; ++i)
      first.col(i) = forces[std::size_t(i) + 1], second.col(i) = p[std::size_t(i) + 1];
    CHECK((second - first * turn.transpose()).norm() < 1e-14);
    // without turning the fibres the energy is another one
    CHECK(potential_energy(body, x) != Approx(potential_energy(body, deformed(f))).epsilon(1e-3));
  }
}

TEST_CASE("fibres carry tension only, and grow stiffer in it") {
  auto energy = [](double k1, Matrix3d const& f) {
    Body body = ready(of(Material::HolzapfelGasserOgden, {1, 5, k1, 2, 0}), corners, {.tetrahedra = single});
    return potential_energy(body, deformed(f));
  };
  auto along = [](double s) {
    return Matrix3d(Vector3d(s, 1 / std::sqrt(s), 1 / std::sqrt(s)).asDiagonal());
  };
  for (double s = 0.5; s < 1; s += 0.1) CHECK(energy(3, along(s)) == energy(0, along(s)));
  double last = 0, rise = 0;
  for (double s = 1.02; s < 1.5; s += 0.02) {
    // k1/(2 k2) (e^(k2 (s^2 - 1)^2) - 1) of the volume of 1/6
    const double fibres = energy(3, along(s)) - energy(0, along(s));
    CHECK(fibres == Approx(3 / 4. * (std::exp(2 * std::pow(s * s - 1, 2)) - 1) / 6).epsilon(1e-11));
    CHECK(fibres - last > rise);  // convex
    rise = fibres - last, last = fibres;
  }
  // as many fibres in all directions feel I1/3 alone
  Body all = ready(of(Material::HolzapfelGasserOgden, {1, 5, 3, 2, 1. / 3}), corners, {.tetrahedra = single});
  Body turned = all;
  turned.fiberDirections = {{1, -1, 2}};
  turned = ready(turned, corners, {.tetrahedra = single});
  const Matrix3d f = of_stretches(1.3, 0.9, 0.8);
  const double e = std::pow(f.determinant(), -2. / 3) * f.squaredNorm() / 3 - 1;
  CHECK(potential_energy(all, deformed(f)) - energy(0, f) == Approx(3 / 4. * (std::exp(2 * e * e) - 1) / 6));
  CHECK(potential_energy(turned, deformed(f)) == Approx(potential_energy(all, deformed(f))).epsilon(1e-13));
}

TEST_CASE("at rest materials with directions have the moduli of their coefficients") {
  // Costa: d2W/dE2 = a b on each component, with k0 of the trace; d2W/dF2 takes the symmetric part
  Body costa = ready(of(Material::Costa, {2, 5, 4, 2, 3, 2.5, 1.5, 2.2}), corners, {.tetrahedra = single});
  const double b[3][3] = {{4, 2, 2.5}, {2, 3, 1.5}, {2.5, 1.5, 2.2}};
  // fibres of HolzapfelGasserOgden in tension add 4 k1 (a a' - I/3)(a a' - I/3)
  Body hgo = ready(of(Material::HolzapfelGasserOgden, {2, 5, 3, 0.7, 0}), corners, {.tetrahedra = single});
  const Eigen::MatrixXd c = second_derivative(costa, Matrix3d::Identity()),
                        h = second_derivative(hgo, Matrix3d::Identity());
  for (long p = 0; p < 9; ++p)
    for (long q = 0; q < 9; ++q) {
      const long i = p % 3, m = p / 3, j = q % 3, n = q / 3;
      const double sym = (i == j) * (m == n) + (i == n) * (m == j), trace = (i == m) * (j == n);
      CHECK(c(p, q) == Approx((2 * b[i][m] * sym / 2 + 5 * trace) / 6).margin(1e-13));
      auto fibre = [](long r, long s) { return r != s ? 0. : r == 0 ? 2. / 3 : -1. / 3; };
      const double wanted = 2 * sym + (5 - 2 * 2 / 3.) * trace + 4 * 3 * fibre(i, m) * fibre(j, n);
      CHECK(h(p, q) == Approx(wanted / 6).margin(1e-13));
    }
}

TEST_CASE("each element has its own directions, and each hexahedron") {
  const Mesh mesh = regular_grid(3, 2, 2, {0, 0, 0}, {2, 1, 1});
  Body body = of(Material::HolzapfelGasserOgden, {1, 5, 3, 2, 0});
  body.fiberDirections = {{2, 0, 0}, {0, 1, 0}};
  body = ready(body, mesh.positions, {.hexahedra = mesh.hexahedra});
  Body without = ready(
      of(Material::HolzapfelGasserOgden, {1, 5, 0, 2, 0}), mesh.positions, {.hexahedra = mesh.hexahedra});
  // along x only the first cell of 1 m^3 has fibres that are pulled
  Vec3d::VecCoord x = mesh.positions;
  for (auto& p : x) p[0] *= 1.2;
  const double e = std::pow(1.2, -2. / 3) * 1.44 - 1;
  CHECK(potential_energy(body, x) - potential_energy(without, x) ==
        Approx(3 / 4. * (std::exp(2 * e * e) - 1)));
}

TEST_CASE("hexahedra are cut into tetrahedra where there are none") {
  const Mesh mesh = regular_grid(2, 2, 3, {0, 0, 0}, {1, 1, 2});
  Body body = ready(bodies()[2], mesh.positions, {.hexahedra = mesh.hexahedra});
  // homogeneous: F = diag(1.1, 1, 1) in the whole volume of 2 m^3
  Vec3d::VecCoord x = mesh.positions;
  for (auto& p : x) p[0] *= 1.1;
  const double ln = std::log(1.1);
  CHECK(potential_energy(body, x) == Approx(2 * (0.5 * (1.21 - 1) - ln + 1.5 * ln * ln)));
}

TEST_CASE("hyperelastic bodies are checked") {
  const TopologyView topology{.tetrahedra = single};
  auto wrong =
      [&](Material material, std::vector<double> parameters, std::initializer_list<std::string_view> words) {
        refuses(of(material, parameters), corners, topology, words);
      };
  wrong(Material::NeoHookean,
        {},
        {"body",
         "TetrahedronHyperelasticityFEMForceField<Vec3d>",
         "ParameterSet has 0 values",
         "NeoHookean takes mu lambda"});
  wrong(Material::MooneyRivlin, {1, 2}, {"2 values", "MooneyRivlin takes c1 c2 k0"});
  wrong(Material::Ogden, {1, 2, 3, 4}, {"4 values", "Ogden takes mu1 alpha1"});
  wrong(Material::Ogden, {1, 0, 3}, {"ParameterSet[1] is 0", "alpha"});
  wrong(Material::Ogden, {1, 2, -1, 3, 5}, {"shear modulus of 0 Pa", "bulk modulus of 5 Pa"});
  wrong(Material::StVenantKirchhoff, {-1, 3}, {"shear modulus of -1 Pa", "greater than 0"});
  wrong(Material::NeoHookean, {3, -2}, {"bulk modulus of 0 Pa"});
  wrong(Material::ArrudaBoyce, {1, 0}, {"bulk modulus of 0 Pa"});
  wrong(Material::ArrudaBoyce, {one::notANumber, 1}, {"ParameterSet[0] is nan", "finite"});
  wrong(Material::VerondaWestman,
        {-1, -2, 3},
        {"ParameterSet[0] is -1", "c1 of VerondaWestman", "greater than 0"});
  wrong(Material::Costa, {1, 2, 3}, {"3 values", "Costa takes a k0 bff bfs bss bfn bsn bnn"});
  wrong(Material::Costa, {1, 5, 1, 1, 0, 1, 1, 1}, {"ParameterSet[4] is 0", "bss of Costa"});
  wrong(Material::HolzapfelGasserOgden, {1, 5, 1, 1}, {"4 values", "takes mu k0 k1 k2 kappa"});
  wrong(Material::HolzapfelGasserOgden, {1, 5, 1, 0, 0}, {"ParameterSet[3] is 0", "k2"});
  wrong(Material::HolzapfelGasserOgden, {1, 5, -1, 1, 0}, {"ParameterSet[2] is -1", "k1"});
  wrong(Material::HolzapfelGasserOgden, {1, 5, 1, 1, 0.4}, {"ParameterSet[4] is 0.4", "kappa", "1/3"});
  wrong(Material::HolzapfelGasserOgden, {0, 5, 1, 1, 0.1}, {"shear modulus of 0 Pa"});
  Body fibres = of(Material::HolzapfelGasserOgden, {1, 5, 1, 1, 0.1});
  auto without = [&](auto member,
                     std::vector<Vector3d> const& directions,
                     std::initializer_list<std::string_view>
                         words) {
    Body body = fibres;
    body.*member = directions;
    refuses(body, corners, topology, words);
  };
  without(&Body::anisotropyDirections, {{0, 0, 0}}, {"AnisotropyDirections has no direction at [0]"});
  without(&Body::anisotropyDirections,
          {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {"3 directions", "one or two families"});
  without(&Body::fiberDirections, {{1, 0, 0}, {0, 1, 0}}, {"fiberDirections has 2 values for 1 tetrahedra"});
  without(&Body::fiberDirections, {{one::notANumber, 0, 0}}, {"fiberDirections[0]", "finite"});
  without(&Body::sheetDirections, {{1, 0, 0}}, {"sheetDirections needs fiberDirections"});
  fibres.fiberDirections = {{1, 0, 0}};
  without(&Body::sheetDirections, {{-2, 0, 0}}, {"sheetDirections has at element 0", "not parallel"});
  fibres.matrixRegularization = true;
  refuses(fibres, corners, topology, {"matrixRegularization is not there for HolzapfelGasserOgden"});
  fibres = of(Material::NeoHookean, {1, 3});
  without(&Body::fiberDirections, {{1, 0, 0}}, {"NeoHookean is the same in all directions"});
  fibres = of(Material::Costa, {1, 5, 1, 1, 1, 1, 1, 1});
  without(&Body::anisotropyDirections, {{1, 0, 0}}, {"give the axes of Costa by fiberDirections"});
  refuses(Body{.materialName = Material::NeoHookean, .parameterSet = {1, 1}, .continuedBelow = 0},
          corners,
          topology,
          {"continuedBelow is 0", "greater than 0 and less than 1"});

  const Body good{.materialName = Material::NeoHookean, .parameterSet = {1, 1}};
  refuses(good, corners, {}, {"no tetrahedron", "give the node a topology"});
  refuses(good,
          Vec3d::VecCoord{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}},
          topology,
          {"tetrahedron 0 has no volume"});
  const std::vector<Tetrahedron> insideOut{{0, 2, 1, 3}}, far{{0, 1, 2, 4}};
  refuses(good, corners, {.tetrahedra = insideOut}, {"tetrahedron 0 is inside out"});
  refuses(good, corners, {.tetrahedra = far}, {"tetrahedron 0 refers to point 4", "4 points"});
}

}  // namespace test_tetrahedron_hyperelasticity
