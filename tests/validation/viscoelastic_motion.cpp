// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "closed_forms.hpp"
#include "registry_scene.hpp"

#include <sinew/force/tetrahedron_viscoelasticity.hpp>

#include <Eigen/Eigenvalues>
#include <cmath>

namespace test_viscoelastic_motion {

using namespace sinew;
using Eigen::Matrix3d;
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

/// A tetrahedron of height 1, fixed on its base, with a mass at its apex that is let go 1e-5 m aside: for so
/// small a shear the material is linear, with springs V G.
///   m u'' = -k0 u - q,   q' = k1 u' - q/tau;   Kelvin and Voigt: m u'' = -k0 u - k0 tau u'
struct Shaken {
  Body body;
  double k0, k1, tau;
  bool damper = false;  // Kelvin and Voigt
  static constexpr double m = 0.02, start = 1e-5, end = 0.5;

  double exact() const {
    Matrix3d a;  // of u, u', q
    a << 0, 1, 0, -k0 / m, damper ? -k0 * tau / m : 0, -1 / m, 0, damper ? 0 : k1, damper ? -1 : -1 / tau;
    const Eigen::EigenSolver<Matrix3d> eigen(a);
    const Eigen::Vector3cd x0 = Vector3d(1, 0, damper ? 0 : k1);
    const Eigen::Vector3cd part = eigen.eigenvectors().inverse() * x0;
    const Eigen::Vector3cd grown = (eigen.eigenvalues() * end).array().exp() * part.array();
    return (eigen.eigenvectors() * grown)[0].real();
  }
  template <class Solver>
  double error(Solver solver, int steps) const {
    RegistryScene sim{
        node<"root">(solver,
                     CGLinearSolver<>{.iterations = 12, .tolerance = 1e-15},
                     TetrahedronTopology{{{0, 1, 2, 3}}},
                     MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                     UniformMass<Vec3d>{.vertexMass = m},
                     body,
                     FixedConstraint<Vec3d>{.indices = {0, 1, 2}})};
    sim.init();
    sim.root().state().position[3][0] = start;
    for (int i = 0; i < steps; ++i) sim.animate(end / steps);
    return std::abs(sim.root().state().position[3][0] / start - exact());
  }
  template <class Solver>
  double order(Solver solver, int steps) const {
    return closed_form::order([&](int n) { return error(solver, n); }, steps);
  }
};
// frequencies of 11 and 16 1/s, a relaxation that both of them feel
const Shaken standard{of(Material::SLSMaxwellFirstOrder, {15, 17, 0.08, 20}), 15. / 6, 17. / 6, 0.08};
const Shaken kelvin{of(Material::KelvinVoigtFirstOrder, {15, 0.03, 20}), 15. / 6, 0, 0.03, true};

}  // namespace

TEST_CASE("a mass on a viscoelastic body swings as its differential equation says") {
  // With strains taken to be linear in each step, terms that relax leave order 2 of a Runge-Kutta method; of
  // a step that is linearised in positions and velocities but not in time, order 1. The damper of Kelvin and
  // Voigt leaves solvers their order.
  auto check = [](auto solver, double orderRelaxing, double orderDamped, double error) {
    INFO(std::decay_t<decltype(solver)>::className);
    CHECK(standard.order(solver, 200) > orderRelaxing - 0.15);
    CHECK(kelvin.order(solver, 200) > orderDamped - 0.15);
    CHECK(standard.error(solver, 400) < error);
  };
  check(RungeKutta4Solver{}, 2, 3.5, 6e-6);
  check(EulerImplicitSolver{}, 1, 1, 3e-2);
  check(BDFOdeSolver{.order = 2}, 1.6, 2, 8e-4);
}

}  // namespace test_viscoelastic_motion
