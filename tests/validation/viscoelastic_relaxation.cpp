// SPDX-License-Identifier: BSL-1.0
#include "one_component.hpp"
#include "validation/record.hpp"

#include <sinew/force/tetrahedron_viscoelasticity.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <cmath>

namespace test_viscoelastic_relaxation {

using namespace sinew;
using Eigen::Vector3d;

namespace {

using Body = TetrahedronViscoelasticityFEMForceField<Vec3d>;
using Material = ViscoelasticMaterial;

Body of(Material material, std::vector<double> const& parameters) {
  Body body;
  body.materialName = material;
  body.parameterSet = parameters;
  return body;
}

/// The unit cube in 40 tetrahedra, sheared by g: the shear stress dW/dg = S_xy + g S_yy of its material.
struct Cube {
  Mesh mesh = regular_grid_tetrahedra(3, 3, 3, {0, 0, 0}, {1, 1, 1});
  Body body;

  explicit Cube(Body b) : body(one::ready(b, mesh.positions, {.tetrahedra = mesh.tetrahedra})) {}
  double stress(double g, double time, double dt) {
    Vec3d::VecCoord x = mesh.positions;
    for (auto& p : x) p[0] += g * p[1];
    Vec3d::VecDeriv f(x.size(), Vector3d::Zero()), rest(x.size(), Vector3d::Zero());
    add_force(body, {.time = time, .dt = dt}, f, x, rest);
    double sum = 0;
    for (std::size_t i = 0; i < f.size(); ++i) sum -= f[i][0] * mesh.positions[i][1];
    return sum;
  }
};

}  // namespace

TEST_CASE("held in a shear, the stress relaxes as the Prony series says", "[page]") {
  const double g = 1e-4, lambda = 300;
  const double G[] = {50, 30, 20, 10}, tau[] = {0.1, 0.7, 4};
  Record curve("relaxation", {"step", "time", "modulus", "closed form"});
  for (const double dt : {0.01, 0.25, 3.0}) {  // for steps of any size
    Cube cube(of(Material::Prony, {G[0], G[1], tau[0], G[2], tau[1], G[3], tau[2], lambda}));
    for (int n = 0; n <= 12; ++n) {
      double modulus = G[0];
      for (int i = 0; i < 3; ++i) modulus += G[i + 1] * std::exp(-n * dt / tau[i]);
      // the stretch that comes with a shear, g^2/2, has a part of g^2 in the stress
      const double found = cube.stress(g, n * dt, dt) / g;
      CHECK(found == Approx(modulus).epsilon(1e-7));
      if (n > 0) curve.row(text("dt = ", dt, " s"), n * dt, found, modulus);
    }
  }
}

TEST_CASE("in a shear that grows evenly, the stress is the integral of the Prony series") {
  const double rate = 1e-4, dt = 0.2;
  Cube cube(of(Material::SLSMaxwellSecondOrder, {50, 30, 0.1, 20, 0.7, 300}));
  for (int n = 0; n <= 12; ++n) {
    const double t = n * dt, wanted = rate * (50 * t + 30 * 0.1 * (1 - std::exp(-t / 0.1)) +
                                              20 * 0.7 * (1 - std::exp(-t / 0.7)));
    CHECK(cube.stress(rate * t, t, dt) == Approx(wanted).epsilon(1e-6).margin(1e-18));
  }
}

}  // namespace test_viscoelastic_relaxation
