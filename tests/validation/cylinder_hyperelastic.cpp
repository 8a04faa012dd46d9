// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "cylinder.hpp"
#include "hyperelastic_laws.hpp"
#include "record.hpp"

namespace test_cylinder_hyperelastic {

using namespace cylinder;
using namespace hyperelastic;

namespace {

/// Where f, which grows, vanishes.
template <class F>
double root_of(F&& f, double low, double high) {
  for (int i = 0; i < 80; ++i) {
    const double middle = (low + high) / 2;
    (f(middle) > 0 ? high : low) = middle;
  }
  return low;
}
/// Stretches at which the sides carry no stress and the ends a nominal stress p.
Stretches closed_form(Law const& law, double p) {
  auto sides = [&](double axial) {
    return root_of([&](double lateral) { return law.kirchhoff({axial, lateral, lateral})[1]; }, 0.3, 2);
  };
  auto nominal = [&](double axial) {
    const double lateral = sides(axial);
    return law.kirchhoff({axial, lateral, lateral})[0] / axial;
  };
  const double axial = root_of([&](double s) { return nominal(s) - p; }, 0.7, 3);
  return {axial, sides(axial)};
}

}  // namespace

TEST_CASE("a cylinder of each hyperelastic law under four pressures", "[page]") {
  Record table("cylinder_hyperelastic", {"law", "p1", "p2", "p3", "p4", "error"});
  const Mesh mesh = tetrahedra();
  for (Law const& law : laws) {
    if (law.material == Material::VerondaWestman) continue;  // that is in hyperelastic_response.cpp
    const auto [shear, bulk] = rest_moduli(law.material, law.p);
    const double E = 9 * bulk * shear / (3 * bulk + shear), nu = E / (2 * shear) - 1;
    double axial[4], worst = 0;
    for (int i = 0; i < 4; ++i) {
      const double p = std::array{1e-4, 0.02, 0.1, 0.3}[std::size_t(i)] * E;
      INFO(enum_names(Material{})[std::size_t(law.material)] << ", p/E = " << p / E);
      const Stretches found = pulled(mesh, law.body(), p, 2), closed = closed_form(law, p);
      // Newton's method ends at a residual of 1e-12
      CHECK(found.axial == Approx(closed.axial).epsilon(1e-9));
      CHECK(found.lateral == Approx(closed.lateral).epsilon(1e-9));
      // at small strain all of them are linear: the next term is of the strain's size
      if (i == 0) {
        CHECK(found.axial - 1 == Approx(p / E).epsilon(1e-3));
        CHECK(found.lateral - 1 == Approx(-nu * p / E).epsilon(1e-3));
      }
      axial[i] = found.axial;
      worst = std::max(worst, std::abs(found.axial - closed.axial));
    }
    table.row(text(enum_names(Material{})[std::size_t(law.material)], law.p.size() > 3 ? " of 3 terms" : ""),
              axial[0] - 1,
              axial[1],
              axial[2],
              axial[3],
              worst);
  }
}

}  // namespace test_cylinder_hyperelastic
