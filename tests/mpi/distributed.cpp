// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "mpi/ranks.hpp"

namespace test_distributed {

using namespace ranks_test;

TEST_CASE("implicit steps with PETSc's solvers are those of one process, to the tolerance of the solver") {
  const EulerImplicitSolver ode{.rayleighStiffness = 0.01, .rayleighMass = 0.1};
  const Positions v = velocities_in_one(
      bar(ode, PetscLinearSolver<>{.solver = "preonly", .preconditioner = "cholesky", .matrix = "aij"}),
      3,
      0.02);
  struct Choice {
    std::string solver, preconditioner, matrix, options;
  };
  for (Choice const& c : {Choice{"cg", "pbjacobi", "baij", ""},
                          Choice{"cg", "bjacobi", "baij", ""},
                          Choice{"gmres", "asm", "aij", ""},
                          Choice{"cg", "gamg", "aij", ""},
                          Choice{"cg", "hypre", "aij", "-pc_hypre_type boomeramg"},
                          Choice{"preonly", "cholesky", "aij", "-pc_factor_mat_solver_type mumps"}}) {
    INFO(c.solver << ' ' << c.preconditioner);
    const Positions w = velocities(bar(ode,
                                       PetscLinearSolver<>{.solver = c.solver,
                                                           .preconditioner = c.preconditioner,
                                                           .tolerance = 1e-11,
                                                           .matrix = c.matrix,
                                                           .options = c.options}),
                                   3,
                                   0.02);
    // the tolerance times the condition of the matrix, which is below 1e4
    CHECK(distance(v, w) < 1e-7 * length(v));
  }
}

TEST_CASE("implicit steps without a matrix, with several iterations of Newton's method") {
  const EulerImplicitSolver ode{.rayleighStiffness = 0.01,
                                .trapezoidalScheme = true,
                                .maxNbIterationsNewton = 4,
                                .absoluteResidualStoppingThreshold = 1e-9};
  const CGLinearSolver<> linear{.iterations = 1000, .tolerance = 1e-11};
  const Positions v = velocities_in_one(bar(ode, linear), 3, 0.02), w = velocities(bar(ode, linear), 3, 0.02);
  CHECK(distance(v, w) < 1e-7 * length(v));
}

TEST_CASE("explicit steps are those of one process, to rounding") {
  for (const bool symplectic : {true, false}) {
    const EulerExplicitSolver ode{.symplectic = symplectic};
    auto scene = bar(ode, CGLinearSolver<>{});
    const Positions v = velocities_in_one(scene, 50, 1e-4), w = velocities(scene, 50, 1e-4);
    CHECK(distance(v, w) < 1e-11 * length(v));
  }
}

TEST_CASE("a mass of the whole body is shared out with it") {
  auto scene = [](auto mass) {
    const Mesh mesh = regular_grid_tetrahedra(4, 3, 3, {0, 0, 0}, {3, 1, 1});
    return node<"root">(Gravity{{0, -9.81, 0}},
                        node<"body">(EulerExplicitSolver{},
                                     MeshTopology{.position = mesh.positions, .tetrahedra = mesh.tetrahedra},
                                     MechanicalObject<Vec3d>{},
                                     mass,
                                     TetrahedronFEMForceField<Vec3d>{.youngModulus = {1e4}},
                                     FixedConstraint<Vec3d>{.indices = {0, 1, 2}}));
  };
  auto compare = [&](auto mass) {
    Simulation one{scene(mass)};
    one.init();
    mpi::DistributedSimulation many{scene(mass), std::make_shared<mpi::Communicator>()};
    many.init();
    for (int i = 0; i < 20; ++i) one.animate(1e-4), many.animate(1e-4);
    auto& state = hana::at_c<0>(many.root().children).state();
    const Positions v = one.template at<"body">().state().velocity,
                    w = many.everywhere(state, vec_id::velocity);
    CHECK(distance(v, w) < 1e-11 * length(v));
    CHECK(many.time() == one.time());
  };
  compare(UniformMass<Vec3d>{.totalMass = 7});
  compare(DiagonalMass<Vec3d>{.totalMass = 7});
}

TEST_CASE("no step allocates, not even the first, but for what MPI and PETSc do") {
  auto allocations = [](auto scene) {
    mpi::DistributedSimulation sim{std::move(scene), std::make_shared<mpi::Communicator>()};
    sim.init();
    const long before = allocationsHere;
    for (int i = 0; i < 5; ++i) sim.animate(0.01);
    return allocationsHere - before;
  };
  const EulerImplicitSolver ode{.rayleighStiffness = 0.01};
  CHECK(allocations(bar(ode, CGLinearSolver<>{.iterations = 1000, .tolerance = 1e-11})) == 0);
  for (auto const& preconditioner : {"pbjacobi", "bjacobi", "multigrid"})
    CHECK(allocations(bar(ode, PetscLinearSolver<>{.preconditioner = preconditioner})) == 0);
}

TEST_CASE("two runs have the same bits, and elements without ghosts go while these come") {
  const World world;
  auto scene = [] {
    return bar(EulerImplicitSolver{.rayleighStiffness = 0.01},
               PetscLinearSolver<>{.preconditioner = "bjacobi"});
  };
  CHECK(velocities(scene(), 3, 0.02) == velocities(scene(), 3, 0.02));
  mpi::DistributedSimulation sim{scene(), std::make_shared<mpi::Communicator>()};
  sim.init();
  auto const& driver = sim.root().first<role::ForceField>().driver;
  INFO("rank " << world.rank);
  CHECK(driver.inner > 0);
  CHECK((driver.inner == driver.packs.size()) == (world.size == 1));
  CHECK(sim.root().state().ghosts ==
        (world.size == 1 ? 0 : sim.root().state().size() - sim.root().state().owned()));
}

}  // namespace test_distributed
