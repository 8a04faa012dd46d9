// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "registry_scene.hpp"

#include <sinew/sinew.hpp>
#include <sinew/solver/sparse_ldl_solver.hpp>
#include <sinew/solver/static_solver.hpp>
#include <sinew/topology/adjacency.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <algorithm>
#include <set>

namespace test_statics {

using namespace sinew;

namespace {

/// A spring of stiffness 8 and length 1 from the origin, pulled at its other end by a force F: it hangs along
/// F, with length 1 + |F| / 8.
auto pulled_spring(StaticSolver solver, Eigen::Vector2d start, Eigen::Vector2d force) {
  RegistryScene sim{
      node<"root">(solver,
                   SparseLDLSolver<CompressedRowSparseMatrixd>{},
                   MechanicalObject<Vec2d>{.position = {{0, 0}, start}},
                   StiffSpringForceField<Vec2d>{
                       .springs = {{.first = 0, .second = 1, .stiffness = 8, .damping = 1, .length = 1}}},
                   ConstantForceField<Vec2d>{.indices = {1}, .forces = {force}},
                   FixedConstraint<Vec2d>{.indices = {0}})};
  sim.init();
  sim.animate(1);
  return sim;
}
const StaticSolver exact{.maxNbIterationsNewton = 30,
                         .relativeInitialStoppingThreshold = 0,
                         .absoluteResidualStoppingThreshold = 1e-12,
                         .relativeEstimateDifferenceThreshold = 0,
                         .absoluteEstimateDifferenceThreshold = 0};

}  // namespace

TEST_CASE("a spring is pulled to its closed form, with quadratic convergence") {
  auto sim = pulled_spring(exact, {1.5, 0}, {3, -6});
  auto const& solver = sim.root().get<StaticSolver>().newton;
  const Eigen::Vector2d f(3, -6), x = (1 + f.norm() / 8) * f.normalized();
  CHECK((sim.root().state().position[1] - x).norm() < 1e-12);
  CHECK(solver.status == NewtonStatus::residualSmall);
  CHECK(solver.converged());
  CHECK(solver.residuals.size() == solver.corrections.size() + 1);
  // each residual of the end is at most a constant times the square of the one before, until rounding
  const std::size_t n = solver.residuals.size();
  REQUIRE(n >= 5);
  for (std::size_t i = 2; i < n; ++i)
    if (solver.residuals[i - 1] < 0.5)
      CHECK(solver.residuals[i] < 2 * std::pow(solver.residuals[i - 1], 2) + 1e-13);
  // the next step finds it there
  sim.animate(1);
  CHECK(solver.status == NewtonStatus::alreadyInEquilibrium);
  CHECK(solver.corrections.empty());
}

TEST_CASE("a spring pulled along itself takes one iteration") {
  auto sim = pulled_spring({}, {1.5, 0}, {3, 0});
  auto const& solver = sim.root().get<StaticSolver>().newton;
  CHECK(sim.root().state().position[1][0] == Approx(1 + 3.0 / 8).epsilon(1e-14));
  CHECK(solver.corrections.size() == 1);
  CHECK(solver.residuals[0] == Approx(1));  // 3 - 8 * 0.5
  CHECK(solver.status == NewtonStatus::residualSmall);
}

TEST_CASE("each criterion stops the search") {
  auto status = [](StaticSolver solver) {
    auto sim = pulled_spring(solver, {1.5, 0}, {3, -6});
    return sim.root().get<StaticSolver>().newton.status;
  };
  StaticSolver solver = exact;
  solver.maxNbIterationsNewton = 2;
  CHECK(status(solver) == NewtonStatus::outOfIterations);
  solver = exact;
  solver.absoluteResidualStoppingThreshold = -1;
  solver.absoluteEstimateDifferenceThreshold = 1e-3;
  CHECK(status(solver) == NewtonStatus::correctionSmall);
  solver.absoluteEstimateDifferenceThreshold = 0;
  solver.relativeEstimateDifferenceThreshold = 1e-3;
  CHECK(status(solver) == NewtonStatus::correctionSmall);
  solver.relativeEstimateDifferenceThreshold = 0;
  solver.relativeInitialStoppingThreshold = 1e-3;
  CHECK(status(solver) == NewtonStatus::residualSmall);
  solver.relativeInitialStoppingThreshold = 0;
  solver.relativeSuccessiveStoppingThreshold = 1e-3;
  CHECK(status(solver) == NewtonStatus::residualSmall);
  solver.relativeSuccessiveStoppingThreshold = 0;
  CHECK(status(solver) == NewtonStatus::outOfIterations);
}

TEST_CASE("a line search makes each residual smaller than the one before") {
  // hardly stretched, the spring holds next to nothing across: Newton's method overshoots 20 times
  const Eigen::Vector2d start(1.02, 0), force(0.5, -6);
  auto free = pulled_spring(exact, start, force);
  auto const& wild = free.root().get<StaticSolver>().newton.residuals;
  CHECK_FALSE(std::is_sorted(wild.rbegin(), wild.rend()));
  StaticSolver solver = exact;
  solver.maxNbIterationsLineSearch = 20;
  auto sim = pulled_spring(solver, start, force);
  auto const& tame = sim.root().get<StaticSolver>().newton;
  CHECK(std::is_sorted(tame.residuals.rbegin(), tame.residuals.rend()));
  CHECK(tame.converged());
  CHECK((sim.root().state().position[1] - (1 + force.norm() / 8) * force.normalized()).norm() < 1e-12);
  // or the search gives up as soon as one is larger
  solver = exact;
  solver.shouldDivergeWhenResidualIsGrowing = true;
  auto stopped = pulled_spring(solver, start, force);
  CHECK(stopped.root().get<StaticSolver>().newton.status == NewtonStatus::residualGrew);
  CHECK_FALSE(stopped.root().get<StaticSolver>().newton.converged());
}

TEST_CASE("points inside an affine boundary come to the same affine map") {
  const int n = 3;
  Mesh mesh = regular_grid_tetrahedra(n + 1, n + 1, n + 1, {0, 0, 0}, {1, 1, 1});
  std::set<int> boundary;
  for (auto const& t : boundary_triangles(mesh.tetrahedra)) boundary.insert(t.begin(), t.end());
  REQUIRE(boundary.size() < mesh.positions.size());
  Eigen::Matrix3d f;
  f << 1.05, 0.02, -0.01, 0.03, 0.98, 0.02, 0.01, -0.02, 1.04;
  for (const RotationMethod method : {RotationMethod::small, RotationMethod::nearest}) {
    MechanicalObject<Vec3d> state{.position = mesh.positions, .restPosition = mesh.positions};
    for (const int i : boundary) state.position[std::size_t(i)] = f * mesh.positions[std::size_t(i)];
    RegistryScene sim{node<"root">(
        exact,
        SparseLDLSolver<>{},
        TetrahedronTopology{mesh.tetrahedra},
        state,
        TetrahedronFEMForceField<Vec3d>{.youngModulus = {1}, .poissonRatio = 0.3, .method = method},
        FixedConstraint<Vec3d>{.indices = {boundary.begin(), boundary.end()}})};
    sim.init();
    sim.animate(1);
    CHECK(sim.root().get<StaticSolver>().newton.converged());
    if (method == RotationMethod::small) CHECK(sim.root().get<StaticSolver>().newton.corrections.size() == 1);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
      CHECK((sim.root().state().position[i] - f * mesh.positions[i]).norm() < 1e-11);
  }
}

TEST_CASE("a body that nothing holds has no equilibrium to find, and is an error") {
  const Mesh mesh = regular_grid_tetrahedra(3, 3, 3, {0, 0, 0}, {1, 1, 1});
  RegistryScene loose{node<"root">(Gravity{{0, -9.81, 0}},
                                   StaticSolver{},
                                   SparseLDLSolver<>{},
                                   TetrahedronTopology{mesh.tetrahedra},
                                   MechanicalObject<Vec3d>{mesh.positions},
                                   DiagonalMass<Vec3d>{.massDensity = 1000},
                                   TetrahedronFEMForceField<Vec3d>{.youngModulus = {1e5}})};
  loose.init();
  try {
    loose.animate(1);
    FAIL("no error");
  } catch (Error const& error) {
    const std::string said = error.what();
    INFO(said);
    CHECK(said.find("/root: SparseLDLSolver: the matrix is singular at point ") == 0);
    CHECK(said.find("fix points") != std::string::npos);
  }
}

}  // namespace test_statics
