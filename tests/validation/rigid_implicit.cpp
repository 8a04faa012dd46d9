// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "registry_scene.hpp"
#include "validation/closed_forms.hpp"

#include <sinew/solver/bdf2.hpp>
#include <sinew/solver/newmark_implicit.hpp>
#include <sinew/solver/variational_symplectic.hpp>

namespace test_rigid_implicit {

using namespace sinew;
using namespace closed_form;

namespace {

template <class Solver>
auto tumbling(Solver solver, int steps) {
  Vec<double, 6> v;
  v << 0, 0, 0, 0.3, 2, 0.1;  // about the middle axis, where free rotation tumbles
  RegistryScene sim{node<"root">(
      solver,
      SparseLDLSolver<CompressedRowSparseMatrixd>{},
      MechanicalObject<Rigid3d>{.position = {{}}, .velocity = {v}},
      UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{2, Eigen::Vector3d(1, 2, 3).asDiagonal()}})};
  sim.init();
  for (int i = 0; i < steps; ++i) sim.animate(2.0 / steps);
  return sim.root().state();
}

/// The error of a free body that tumbles for 2 s, against a solver of order 4 in steps so fine that it has
/// none.
template <class Solver>
double tumbling_error(Solver solver, int steps) {
  static const auto reference = tumbling(RungeKutta4Solver{}, 4000);
  const auto state = tumbling(solver, steps);
  return std::hypot((state.position[0].orientation.toRotationMatrix() -
                     reference.position[0].orientation.toRotationMatrix())
                        .norm(),
                    (state.velocity[0] - reference.velocity[0]).norm());
}

}  // namespace

TEST_CASE("implicit solvers have their order on rotations") {
  auto measured = [](auto solver) { return order([&](int n) { return tumbling_error(solver, n); }, 200); };
  CHECK(measured(EulerImplicitSolver{}) == Approx(1).margin(0.05));
  CHECK(measured(VariationalSymplecticSolver{.newtonError = 0, .steps = 2}) == Approx(2).margin(0.05));
  CHECK(
      measured(BDFOdeSolver{.order = 2, .maxNbIterationsNewton = 2, .relativeInitialStoppingThreshold = 0}) ==
      Approx(2).margin(0.05));
  // with the gyroscopic forces of the start of the step
  CHECK(measured(BDFOdeSolver{.order = 2}) == Approx(1).margin(0.05));
  CHECK(measured(NewmarkImplicitSolver{}) == Approx(1).margin(0.05));
}

}  // namespace test_rigid_implicit
