// SPDX-License-Identifier: BSL-1.0
#include "components/equilibrium.hpp"

#include <sinew/force/tetrahedron_hyperelasticity.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <cmath>

using namespace sinew;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

using Body = TetrahedronHyperelasticityFEMForceField<Vec3d>;
using Material = HyperelasticMaterial;

/// A material and what its energy makes of stretches along three axes.
struct Law {
  Material material;
  std::vector<double> p;

  Body body() const {
    Body b;
    b.materialName = material;
    b.parameterSet = p;
    return b;
  }
  // parameters with which the volume hardly changes
  Law stiffInVolume() const {
    Law law = *this;
    law.p.back() = 1e5;
    return law;
  }
  // slope of W by B1 where W depends on it alone, times 2
  double chain(double b1) const {
    const double c[] = {1. / 2, 1. / 160, 11. / 67200, 19. / 3584000, 519. / 2759680000};
    double sum = 0;
    for (int n = 1; n <= 5; ++n) sum += 2 * p[0] * n * c[n - 1] * std::pow(b1, n - 1);
    return sum;
  }
  /// Kirchhoff's stress s_a dW/ds_a [Pa] of stretches s, by hand.
  Vector3d kirchhoff(Vector3d const& s) const {
    const double j = s.prod(), ln = std::log(j);
    const Vector3d c = s.cwiseAbs2(), one = Vector3d::Ones();
    const double i1 = c.sum(), i2 = c[0] * c[1] + c[1] * c[2] + c[2] * c[0];
    switch (material) {
      case Material::StVenantKirchhoff:
        return c.cwiseProduct(p[1] * (i1 - 3) / 2 * one + p[0] * (c - one));
      case Material::NeoHookean:
        return p[0] * (c - one) + p[1] * ln * one;
      case Material::StableNeoHookean: {
        const double a = 1 + p[0] / (p[0] + p[1]);
        return p[0] * c + (p[0] + p[1]) * (j - a) * j * one;
      }
      case Material::MooneyRivlin:
        return 2 * p[0] * std::pow(j, -2. / 3) * (c - i1 / 3 * one) +
               2 * p[1] * std::pow(j, -4. / 3) * (i1 * c - c.cwiseAbs2() - 2 * i2 / 3 * one) +
               p[2] * ln * one;
      case Material::ArrudaBoyce: {
        const double q = std::pow(j, -2. / 3);
        return chain(q * i1) * q * (c - i1 / 3 * one) + p[1] * ln * one;
      }
      case Material::Ogden:
        break;
    }
    Vector3d sum = p.back() * ln * one;
    for (std::size_t i = 0; i + 1 < p.size(); i += 2) {
      const Vector3d power = (s / std::cbrt(j)).array().pow(p[i + 1]);
      sum += p[i] / p[i + 1] * (power - power.mean() * one);
    }
    return sum;
  }
};

const std::vector<Law> laws{{Material::ArrudaBoyce, {100, 500}},
                            {Material::StVenantKirchhoff, {100, 150}},
                            {Material::NeoHookean, {100, 150}},
                            {Material::MooneyRivlin, {30, 20, 500}},
                            {Material::Ogden, {200, 3, 500}},
                            {Material::Ogden, {120, 1.3, 40, 5, 20, -2, 500}},
                            {Material::StableNeoHookean, {100, 150}}};

/// The unit cube in 40 tetrahedra.
const Mesh cube = regular_grid_tetrahedra(3, 3, 3, {0, 0, 0}, {1, 1, 1});

Body ready_cube(Law const& law) {
  INFO(enum_names(Material{})[std::size_t(law.material)]);
  return one::ready(law.body(), cube.positions, {.tetrahedra = cube.tetrahedra});
}
/// Mean first Piola-Kirchhoff stress of positions x: sum_k f_k X_k' = -V P.
Matrix3d stress(Body& body, Vec3d::VecCoord const& x) {
  const auto f = one::force(body, x);
  Matrix3d sum = Matrix3d::Zero();
  for (std::size_t i = 0; i < f.size(); ++i) sum -= f[i] * cube.positions[i].transpose();
  return sum;
}

/// Pulls the cube to a stretch along its first `pulled` axes, with planes of symmetry, and lets it find the
/// stretches along the others.
struct Pulled {
  Vector3d stretch;
  Matrix3d stress;
};
Pulled pull(Law const& law, int pulled, double stretch) {
  Body body = ready_cube(law);
  Vec3d::VecCoord x = cube.positions;
  std::vector<bool> held;
  // in steps, so that Newton's method stays near
  const int steps = 8;
  for (auto const& p : x)
    for (int c = 0; c < 3; ++c) held.push_back(p[c] < 1e-12 || (c < pulled && p[c] > 1 - 1e-12));
  const Vec3d::VecDeriv none(x.size(), Vector3d::Zero());
  double left = 0;
  for (int step = 1; step <= steps; ++step) {
    const double to = 1 + (stretch - 1) * step / steps, from = 1 + (stretch - 1) * (step - 1) / steps;
    for (auto& p : x)
      for (int c = 0; c < pulled; ++c) p[c] *= to / from;
    left = one::settle(body, x, held, none, step == steps ? 8 : 4);
  }
  CHECK(left < 1e-9 * law.p.back());
  const Vector3d reached = x.back();
  for (std::size_t i = 0; i < x.size(); ++i)
    CHECK((x[i] - cube.positions[i].cwiseProduct(reached)).norm() < 1e-9);
  return {reached, stress(body, x)};
}

/// The stretch of the free axes at which they carry no stress, by bisection of the law's closed form.
Vector3d free_stretch(Law const& law, int pulled, double stretch) {
  auto at = [&](double free) {
    Vector3d s = Vector3d::Constant(free);
    s.head(pulled).setConstant(stretch);
    return s;
  };
  double low = 0.3, high = 2;
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    (law.kirchhoff(at(middle))[2] > 0 ? high : low) = middle;
  }
  return at(low);
}

}  // namespace

TEST_CASE("uniaxial and biaxial tension and compression follow each law's closed form") {
  for (Law const& law : laws)
    for (const int pulled : {1, 2})
      for (const double stretch : {0.85, 1.1, 1.5}) {
        // pulled so far along two axes it has lost all thickness
        if (law.material == Material::StVenantKirchhoff && pulled * stretch > 2.5) continue;
        INFO(enum_names(Material{})[std::size_t(law.material)] << ' ' << pulled << " axes, " << stretch);
        const Vector3d s = free_stretch(law, pulled, stretch), tau = law.kirchhoff(s);
        REQUIRE(std::abs(tau[2]) < 1e-10);
        const Pulled found = pull(law, pulled, stretch);
        // Newton's residual is left, 1e-9 of the moduli
        CHECK((found.stretch - s).norm() < 1e-8);
        const Matrix3d p = tau.cwiseQuotient(s).asDiagonal();
        CHECK((found.stress - p).norm() < 1e-7 * law.p.back());
      }
}

TEST_CASE("with a stiff volume the stresses are those of textbooks for incompressible rubber") {
  for (Law const& law : laws) {
    if (law.material == Material::StVenantKirchhoff) continue;
    for (const double l : {0.8, 1.3})
      for (const int pulled : {1, 2}) {
        INFO(enum_names(Material{})[std::size_t(law.material)] << ' ' << pulled << " axes, " << l);
        auto const& p = law.p;
        // squares of the stretches: of a pulled axis, of a free one
        const double pull2 = l * l, free2 = pulled == 1 ? 1 / l : std::pow(l, -4);
        const double way = l - free2 / l, i1 = pulled * pull2 + (3 - pulled) * free2;
        double nominal = p[0] * way;  // of Neo-Hooke's
        if (law.material == Material::ArrudaBoyce) nominal = law.chain(i1) * way;
        if (law.material == Material::MooneyRivlin)
          nominal = 2 * (p[0] + p[1] * (pulled == 1 ? 1 / l : pull2)) * way;
        if (law.material == Material::Ogden) {
          nominal = 0;
          for (std::size_t i = 0; i + 1 < p.size(); i += 2)
            nominal += p[i] / p[i + 1] * (std::pow(l, p[i + 1]) - std::pow(free2, p[i + 1] / 2)) / l;
        }
        // the change of volume is the pressure, up to 100 Pa, over 1e5 Pa
        CHECK(pull(law.stiffInVolume(), pulled, l).stress(0, 0) == Approx(nominal).epsilon(5e-3));
      }
  }
}

TEST_CASE("simple shear keeps the volume, and has each law's closed form") {
  for (Law const& law : laws)
    for (const double g : {0.05, 0.4, 1.5}) {
      INFO(enum_names(Material{})[std::size_t(law.material)] << ' ' << g);
      Body body = ready_cube(law);
      Vec3d::VecCoord x = cube.positions;
      for (auto& p : x) p[0] += g * p[1];
      auto const& p = law.p;
      double shear = p[0] * g;  // of Neo-Hooke's
      if (law.material == Material::StVenantKirchhoff) shear += (p[1] / 2 + p[0]) * g * g * g;
      if (law.material == Material::MooneyRivlin) shear = 2 * (p[0] + p[1]) * g;
      if (law.material == Material::ArrudaBoyce) shear = law.chain(3 + g * g) * g;
      if (law.material == Material::Ogden) {
        // principal stretches l, 1, 1/l
        const double l = g / 2 + std::sqrt(1 + g * g / 4);
        shear = 0;
        for (std::size_t i = 0; i + 1 < p.size(); i += 2)
          shear += p[i] / p[i + 1] * (std::pow(l, p[i + 1]) - std::pow(l, -p[i + 1])) * l / (1 + l * l);
      }
      CHECK(stress(body, x)(0, 1) == Approx(shear).epsilon(1e-12));
    }
}
