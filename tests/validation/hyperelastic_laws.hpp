// SPDX-License-Identifier: BSL-1.0
#pragma once

// The hyperelastic laws, one of each, and their closed forms.

#include <sinew/core/data_types.hpp>
#include <sinew/force/tetrahedron_hyperelasticity.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hyperelastic {

using namespace sinew;
using Eigen::Vector3d;
using Body = TetrahedronHyperelasticityFEMForceField<Vec3d>;
using Material = HyperelasticMaterial;

/// A material and what its energy makes of stretches along three axes.
struct Law {
  Material material;
  std::vector<double> p;
  std::vector<Vector3d> fibres{};  // unit vectors, two of them mirrored in a plane of the axes

  Body body() const {
    Body b;
    b.materialName = material;
    b.parameterSet = p;
    b.anisotropyDirections = fibres;
    return b;
  }
  // parameters with which the volume hardly changes; an exponential feels it more
  Law stiffInVolume() const {
    Law law = *this;
    law.p.back() = material == Material::VerondaWestman ? 1e6 : 1e5;
    return law;
  }
  // twice the slope of VerondaWestman's W by B1
  double exponential(double b1) const { return 2 * p[0] * p[1] * std::exp(p[1] * (b1 - 3)); }
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
      case Material::VerondaWestman: {
        const double q = std::pow(j, -2. / 3);
        return exponential(q * i1) * q * (c - i1 / 3 * one) -
               p[0] * p[1] * q * q * (i1 * c - c.cwiseAbs2() - 2 * i2 / 3 * one) + p[2] * ln * one;
      }
      case Material::Costa: {
        const Vector3d e = (c - one) / 2, b(p[2], p[4], p[7]);
        const double q = b.dot(e.cwiseAbs2()), power = std::pow(j, -4. / 3);
        return p[0] * std::exp(power * q) * power * (b.cwiseProduct(e).cwiseProduct(c) - 2 * q / 3 * one) +
               p[1] * j * ln * one;
      }
      case Material::HolzapfelGasserOgden: {
        const double q = std::pow(j, -2. / 3);
        Vector3d sum = p[0] * q * (c - i1 / 3 * one) + p[1] * ln * one;
        for (auto const& a : fibres) {
          const Vector3d h = p[4] * one + (1 - 3 * p[4]) * a.cwiseAbs2();
          const double strain = std::max(0., q * h.dot(c) - 1);
          sum += 2 * p[2] * strain * std::exp(p[3] * strain * strain) * q *
                 (h.cwiseProduct(c) - h.dot(c) / 3 * one);
        }
        return sum;
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
  /// Shear stress [Pa] in a simple shear g, which keeps the volume.
  double shear(double g) const {
    switch (material) {
      case Material::StVenantKirchhoff:
        return p[0] * g + (p[1] / 2 + p[0]) * g * g * g;
      case Material::MooneyRivlin:
        return 2 * (p[0] + p[1]) * g;
      case Material::ArrudaBoyce:
        return chain(3 + g * g) * g;
      case Material::VerondaWestman:
        return (exponential(3 + g * g) - p[0] * p[1]) * g;
      case Material::Ogden: {
        // principal stretches l, 1, 1/l
        const double l = g / 2 + std::sqrt(1 + g * g / 4);
        double sum = 0;
        for (std::size_t i = 0; i + 1 < p.size(); i += 2)
          sum += p[i] / p[i + 1] * (std::pow(l, p[i + 1]) - std::pow(l, -p[i + 1])) * l / (1 + l * l);
        return sum;
      }
      default:
        return p[0] * g;  // Neo-Hooke
    }
  }
};

inline const std::vector<Law> laws{{Material::ArrudaBoyce, {100, 500}},
                                   {Material::StVenantKirchhoff, {100, 150}},
                                   {Material::NeoHookean, {100, 150}},
                                   {Material::MooneyRivlin, {30, 20, 500}},
                                   {Material::Ogden, {200, 3, 500}},
                                   {Material::Ogden, {120, 1.3, 40, 5, 20, -2, 500}},
                                   {Material::StableNeoHookean, {100, 150}},
                                   {Material::VerondaWestman, {250, 0.4, 500}}};

/// Those with directions, along the axes or mirrored in a plane of them.
inline const std::vector<Law> directedLaws{
    {Material::Costa, {50, 500, 3, 2, 2, 1.5, 1.2, 1}},
    {Material::HolzapfelGasserOgden, {60, 500, 80, 0.7, 0}, {{1, 0, 0}}},
    {Material::HolzapfelGasserOgden, {60, 500, 80, 0.7, 0.1}, {{0.8, 0.6, 0}, {0.8, -0.6, 0}}}};

}  // namespace hyperelastic
