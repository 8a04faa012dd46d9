// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "mpi/ranks.hpp"

namespace test_preconditioners {

using namespace ranks_test;

struct Solved {
  Positions velocity;
  int iterations;
};
Solved solved(PetscLinearSolver<> linear, double youngModulus = 1) {
  auto scene = bar(EulerImplicitSolver{.rayleighStiffness = 0.01, .rayleighMass = 0.1}, linear);
  for (double& e : scene.first<role::ForceField>().youngModulus) e *= youngModulus;
  mpi::DistributedSimulation sim{std::move(scene), std::make_shared<mpi::Communicator>()};
  sim.init();
  for (int i = 0; i < 3; ++i) sim.animate(0.02);
  return {sim.everywhere(sim.root().state(), vec_id::velocity),
          sim.root().first<role::LinearSolver>().iterationsTaken};
}

TEST_CASE(
    "multigrid on each rank with a coarse level finds the same, in fewer iterations than other "
    "preconditioners") {
  const PetscLinearSolver<> own{.preconditioner = "multigrid", .tolerance = 1e-10};
  const Solved a = solved(own, 1000), b = solved({.preconditioner = "pbjacobi", .tolerance = 1e-10}, 1000);
  // the tolerance times the condition of the matrix
  CHECK(distance(a.velocity, b.velocity) < 1e-5 * length(b.velocity));
  INFO(a.iterations << " and " << b.iterations);
  CHECK(2 * a.iterations < b.iterations);
  CHECK(solved(own, 1000).velocity == a.velocity);  // bit by bit
}

TEST_CASE("products without a matrix are those with one") {
  const Solved a = solved({.preconditioner = "none", .tolerance = 1e-11, .matrix = "free"}),
               b = solved({.preconditioner = "none", .tolerance = 1e-11});
  CHECK(distance(a.velocity, b.velocity) < 1e-7 * length(b.velocity));
  CHECK(std::abs(a.iterations - b.iterations) <= 2);
}

}  // namespace test_preconditioners
