// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/mechanics.hpp>

namespace test_precomputed_linear_solver {

using namespace sinew;

// a chain along x that springs hold and gravity stretches: its matrix does not change
template <class Linear>
auto chain(double dt, int steps, double dtAfter = 0) {
  Simulation sim{
      node<"root">(Gravity{{-9.81, 0, 0}},
                   EulerImplicitSolver{.rayleighStiffness = 0.01},
                   Linear{},
                   MechanicalObject<Vec1d>{.position = {Vec1d::Coord(0), Vec1d::Coord(1), Vec1d::Coord(2)}},
                   UniformMass<Vec1d>{.vertexMass = 2},
                   RestShapeSpringsForceField<Vec1d>{.stiffness = {100}})};
  sim.init();
  for (int i = 0; i < steps; ++i) sim.animate(dt);
  for (int i = 0; i < steps && dtAfter > 0; ++i) sim.animate(dtAfter);
  return sim.root().state().position;
}

// a stiff spring that turns about a point that is held
template <class Linear>
auto pendulum() {
  return node<"root">(Gravity{{0, -10, 0}},
                      EulerImplicitSolver{},
                      Linear{},
                      MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}}},
                      UniformMass<Vec3d>{.vertexMass = 1},
                      FixedConstraint<Vec3d>{.indices = {0}},
                      StiffSpringForceField<Vec3d>{.springs = {{0, 1, 1000, 5, 1}}});
}

using Kept = PrecomputedLinearSolver<CompressedRowSparseMatrixd>;
using Each = SparseLDLSolver<CompressedRowSparseMatrixd>;

TEST_CASE("a matrix that stays has the solutions of one factorised each step") {
  CHECK(chain<Kept>(0.01, 50) == chain<Each>(0.01, 50));
}

TEST_CASE("another dt has another system") {
  CHECK(chain<Kept>(0.01, 20, 0.03) == chain<Each>(0.01, 20, 0.03));
}

TEST_CASE("a matrix that changes is that of the first step") {
  Simulation kept{pendulum<PrecomputedLinearSolver<>>()};
  Simulation each{pendulum<SparseLDLSolver<>>()};
  kept.init();
  each.init();
  kept.animate(0.01);
  each.animate(0.01);
  CHECK(kept.root().state().position == each.root().state().position);
  // M v1 = M v0 + h f(x1) with the old K: across the spring the first matrix is m alone, also when it has
  // turned
  for (int i = 0; i < 9; ++i) {
    const Eigen::Vector3d x = kept.root().state().position[1], v = kept.root().state().velocity[1];
    const double k = 1000, c = 5, h = 0.01, l = x.norm();
    const Eigen::Vector3d u = x / l;
    const Eigen::Vector3d f = Eigen::Vector3d(0, -10, 0) - (k * (l - 1) + c * v.dot(u)) * u;
    Eigen::Matrix3d first = Eigen::Matrix3d::Identity();
    first(0, 0) += h * c + h * h * k;
    // K v of the forces is that of the present state
    const Eigen::Vector3d along = k * v.dot(u) * u + k * (l - 1) / l * (v - v.dot(u) * u);
    kept.animate(h);
    each.animate(h);
    const Eigen::Vector3d expected = v + first.inverse() * (h * f - h * h * along);
    CAPTURE(i);
    CHECK((kept.root().state().velocity[1] - expected).norm() < 1e-3 * expected.norm());
  }
  CHECK((kept.root().state().position[1] - each.root().state().position[1]).norm() > 1e-6);
}

TEST_CASE("reset begins with the system of the start again") {
  Simulation sim{pendulum<PrecomputedLinearSolver<>>()};
  sim.init();
  sim.animate(0.01);
  const auto first = sim.root().state().position;
  for (int i = 0; i < 30; ++i) sim.animate(0.02);
  sim.reset();
  sim.animate(0.01);
  CHECK(sim.root().state().position == first);
}

TEST_CASE("a body that nothing holds is named") {
  Simulation sim{node<"root">(StaticSolver{},
                              PrecomputedLinearSolver<>{},
                              MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}}},
                              StiffSpringForceField<Vec3d>{.springs = {{0, 1, 1000, 5, 1}}},
                              ConstantForceField<Vec3d>{.indices = {1}, .forces = {{0, 1, 0}}})};
  sim.init();
  CHECK_THROWS_WITH(sim.animate(0.01),
                    Catch::Contains("/root: PrecomputedLinearSolver: the matrix is singular at"));
}

}  // namespace test_precomputed_linear_solver
