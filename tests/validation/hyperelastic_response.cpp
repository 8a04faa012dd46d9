// SPDX-License-Identifier: BSL-1.0
#include "equilibrium.hpp"
#include "hyperelastic_laws.hpp"
#include "record.hpp"

#include <sinew/topology/regular_grid.hpp>

#include <algorithm>
#include <cmath>

namespace test_hyperelastic_response {

using namespace sinew;
using namespace hyperelastic;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

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
  CHECK(left < 1e-9 * *std::max_element(law.p.begin(), law.p.end()));
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

TEST_CASE("materials with directions follow their closed forms, with another stretch along each free axis") {
  for (Law const& law : directedLaws)
    for (const double stretch : {0.85, 1.1, 1.4}) {
      INFO(enum_names(Material{})[std::size_t(law.material)] << ' ' << stretch);
      // along y, and within that along z, by bisection
      auto across = [&](double y) {
        double low = 0.3, high = 2;
        for (int i = 0; i < 60; ++i) {
          const double middle = (low + high) / 2;
          (law.kirchhoff({stretch, y, middle})[2] > 0 ? high : low) = middle;
        }
        return low;
      };
      double low = 0.3, high = 2;
      for (int i = 0; i < 60; ++i) {
        const double y = (low + high) / 2;
        (law.kirchhoff({stretch, y, across(y)})[1] > 0 ? high : low) = y;
      }
      const Vector3d one(stretch, low, across(low)), two(stretch, stretch, across(stretch));
      for (const int pulled : {1, 2}) {
        Vector3d const& s = pulled == 1 ? one : two;
        const Vector3d tau = law.kirchhoff(s);
        REQUIRE(std::abs(tau[2]) < 1e-9);
        const Pulled found = pull(law, pulled, stretch);
        // bisection leaves 2^-60, Newton's method 1e-9 of the moduli
        CHECK((found.stretch - s).norm() < 1e-8);
        const Matrix3d p = tau.cwiseQuotient(s).asDiagonal();
        CHECK((found.stress - p).norm() < 1e-7 * law.p[1]);
      }
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
        if (law.material == Material::VerondaWestman)
          nominal = (law.exponential(i1) - p[0] * p[1] * (pulled == 1 ? 1 / l : pull2)) * way;
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
      CHECK(stress(body, x)(0, 1) == Approx(law.shear(g)).epsilon(1e-12));
    }
}

TEST_CASE("curves of the response, for the page", "[page]") {
  // what the cases above check at a few stretches, along the whole curve
  Record uniaxial("hyperelastic_uniaxial", {"law", "stretch", "stress", "closed form"}),
      biaxial("hyperelastic_biaxial", {"law", "stretch", "stress", "closed form"}),
      shear("hyperelastic_shear", {"law", "shear", "stress", "closed form"});
  const std::vector<double> stretches =
      Record::wanted() ? std::vector{0.7, 0.8, 0.9, 1.0001, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7}
                       : std::vector{1.0001};
  for (Law const& law : laws) {
    const std::string name =
        text(enum_names(Material{})[std::size_t(law.material)], law.p.size() > 3 ? " of 3 terms" : "");
    INFO(name);
    const double modulus = rest_moduli(law.material, law.p).shear;
    for (const int axes : {1, 2})
      for (const double stretch : stretches) {
        if (law.material == Material::StVenantKirchhoff && axes * stretch > 2.5) continue;
        const Vector3d s = free_stretch(law, axes, stretch);
        const double closed = law.kirchhoff(s)[0] / stretch, found = pull(law, axes, stretch).stress(0, 0);
        CHECK(found == Approx(closed).margin(1e-7 * law.p.back()));
        (axes == 1 ? uniaxial : biaxial).row(name, stretch, found / modulus, closed / modulus);
      }
    Body body = ready_cube(law);
    for (double g = 0; g < 1.55; g += 0.1) {
      Vec3d::VecCoord x = cube.positions;
      for (auto& p : x) p[0] += g * p[1];
      shear.row(name, g, stress(body, x)(0, 1) / modulus, law.shear(g) / modulus);
    }
  }
}

}  // namespace test_hyperelastic_response
