// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "mpi/ranks.hpp"

#include <sinew/lagrangian/fixed_lagrangian_constraint.hpp>
#include <sinew/lagrangian/free_motion_animation_loop.hpp>

#include <chrono>
#include <thread>

namespace test_rank_errors {

using namespace ranks_test;

/// What a rank does in a force: it throws, or it does not come back for a time.
struct Trouble {
  using Role = role::ForceField;
  using DataTypes = Vec3d;
  static constexpr std::string_view className = "Trouble";
  static constexpr bool distributed = true;
  int throws = 0, memory = 0, sleeps = 0;

  static constexpr auto fields() {
    return field_list(field("throws", &Trouble::throws, "", "in a force"),
                      field("memory", &Trouble::memory, "", "runs out in a force"),
                      field("sleeps", &Trouble::sleeps, "", "in a force"));
  }
  void init(InitContext<Vec3d> const&) {}
  void addForce(MechanicalParams const&, Positions& f, Positions const&, Positions const&) const {
    if (throws) throw Error("/root: Trouble", "a force that cannot be; correct it");
    if (memory) throw std::bad_alloc();
    if (sleeps) std::this_thread::sleep_for(std::chrono::milliseconds(3000));
    if (f.empty()) return;
  }
  void addDForce(MechanicalParams const&, Positions&, Positions const&) const {}
  double potentialEnergy(Positions const&) const { return 0; }
  template <class Sink>
  void addToMatrix(MechanicalParams const&, Sink const&) const {}
};

TEST_CASE("an error of one rank ends the step on all, with one sentence, wherever they are") {
  const World world;
  const int bad = world.size - 1;
  auto said = [&](auto linear, auto ode, Trouble trouble) {
    mpi::DistributedSimulation sim{bar(ode, linear, world.rank == bad ? trouble : Trouble{}),
                                   std::make_shared<mpi::Communicator>()};
    sim.init();
    sim.ranks().patience = 1;
    const std::string error = error_of([&] { sim.animate(0.001); });
    if (!trouble.sleeps) CHECK(sim.ranks().reports() == (world.rank == bad));  // else who waits longest
    return error;
  };
  const std::string from = world.size == 1 ? std::string() : text("rank ", bad, " of ", world.size, ": ");
  CHECK(said(PetscLinearSolver<>{}, EulerImplicitSolver{}, {.throws = 1}) ==
        from + "/root: Trouble: a force that cannot be; correct it");
  CHECK(said(CGLinearSolver<>{}, EulerImplicitSolver{}, {.throws = 1}) ==
        from + "/root: Trouble: a force that cannot be; correct it");
  CHECK(said(CGLinearSolver<>{}, EulerExplicitSolver{}, {.throws = 1}) ==
        from + "/root: Trouble: a force that cannot be; correct it");
  CHECK(says(said(CGLinearSolver<>{}, EulerExplicitSolver{}, {.memory = 1}),
             {text("rank ", bad, " of ", world.size, ": out of memory")}));
  if (world.size > 1) {
    // those that wait for the one that sleeps say so, and where the others are
    const std::string slow = said(PetscLinearSolver<>{}, EulerImplicitSolver{}, {.sleeps = 1});
    INFO(slow);
    CHECK(says(slow, {"has waited 1 s for"}));
  }
}

TEST_CASE("PETSc that does not converge says so on all ranks") {
  mpi::DistributedSimulation sim{bar(EulerImplicitSolver{}, PetscLinearSolver<>{.iterations = 2}),
                                 std::make_shared<mpi::Communicator>()};
  sim.init();
  const std::string said = error_of([&] { sim.animate(0.02); });
  INFO(said);
  CHECK(says(said, {"/root: PetscLinearSolver: PETSc's cg with pbjacobi has not converged in 2 iterations"}));
  CHECK(said.find("rank") == std::string::npos);  // of all of them
}

TEST_CASE("scenes that cannot be shared out are refused before the run") {
  const World world;
  auto said = [&](auto scene) {
    mpi::DistributedSimulation sim{std::move(scene), std::make_shared<mpi::Communicator>()};
    return error_of([&] { sim.init(); });
  };
  std::string error = said(bar(EulerImplicitSolver{},
                               CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{},
                               FastTriangularBendingSprings<Vec3d>{}));
  INFO(error);
  CHECK(says(error,
             {"not distributed yet",
              "/root: CGLinearSolver<CompressedRowSparseMatrixMat3x3d>",
              "/root: FastTriangularBendingSprings<Vec3d>"}));
  CHECK(error.find("TetrahedronFEM") == std::string::npos);

  auto constrained = node<"root">(
      FreeMotionAnimationLoop{}, MechanicalObject<Vec3d>{}, FixedLagrangianConstraint<Vec3d>{.fixAll = true});
  const NoScope above{};
  error = error_of([&] {
    mpi::refuse_undistributed(ScopeOf<decltype(constrained), NoScope>::type{constrained, above});
  });
  INFO(error);
  CHECK(says(error,
             {"/root: FreeMotionAnimationLoop, whose multipliers one process has; take springs",
              "/root: FixedLagrangianConstraint<Vec3d>, whose multipliers one process has"}));
  CHECK(error.find("MechanicalObject") == std::string::npos);

  if (world.size > 1) {
    error =
        said(node<"root">(EulerExplicitSolver{},
                          MeshTopology{.tetrahedra = {{0, 1, 2, 3}}},
                          MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                          UniformMass<Vec3d>{},
                          TetrahedronFEMForceField<Vec3d>{}));
    INFO(error);
    CHECK(says(error, {"4 points with 1 elements", text("among ", world.size, " ranks"), "fewer ranks"}));

    // rank 1 has another scene
    auto scene = bar(EulerExplicitSolver{}, CGLinearSolver<>{});
    if (world.rank == 1) scene.state().position[5][0] += 0.01;
    error = said(scene);
    INFO(error);
    CHECK(says(error, {"rank 1 of", "not those of rank 0", "same files"}));
  }
  error = said(node<"root">(EulerExplicitSolver{},
                            MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}}},
                            UniformMass<Vec3d>{}));
  if (world.size > 1) CHECK(says(error, {"2 points with 0 elements"}));

  // what one process says of a scene, all ranks say
  auto wrong = bar(EulerExplicitSolver{}, CGLinearSolver<>{});
  wrong.first<role::ProjectiveConstraint>().indices = {100000};
  error = said(wrong);
  INFO(error);
  CHECK(says(error, {"FixedConstraint", "100000"}));
  CHECK(error.find("rank") == std::string::npos);
}

}  // namespace test_rank_errors
