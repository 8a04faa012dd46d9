// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "mpi/ranks.hpp"

namespace test_mapped {

using namespace ranks_test;

TEST_CASE("what is mapped from a body in parts pulls it as in one process, and the whole scene is gathered") {
  auto scene = [] {
    return bar(EulerExplicitSolver{},
               CGLinearSolver<>{},
               node<"tips">(MechanicalObject<Vec3d>{},
                            SubsetMapping<Vec3d, Vec3d>{.indices = {6, 13, 20, 41, 62, 30}},
                            ConstantForceField<Vec3d>{.totalForce = Eigen::Vector3d(100, -3000, 40)}));
  };
  Simulation one{scene()};
  mpi::DistributedSimulation many{scene(), std::make_shared<mpi::Communicator>()};
  CHECK(says(error_of([&] {
               mpi::DistributedSimulation{scene(), std::make_shared<mpi::Communicator>()}.whole();
             }),
             {"keepWhole()"}));
  many.keepWhole();
  one.init(), many.init();
  for (int i = 0; i < 20; ++i) one.animate(1e-4), many.animate(1e-4);
  const Positions v = one.root().state().velocity, w = many.everywhere(many.root().state(), vec_id::velocity);
  CHECK(distance(v, w) < 1e-11 * length(v));
  auto& tips = hana::at_c<0>(many.root().children).state();
  const Positions places = many.everywhere(tips, vec_id::position);
  CHECK(distance(places, one.at<"tips">().state().position) < 1e-12);
  auto const* const whole = many.whole();
  CHECK((whole != nullptr) == (many.ranks().rank() == 0));
  if (whole) {
    CHECK(whole->state().velocity == w);
    CHECK(hana::at_c<0>(whole->children).state().position == places);
  }
  const auto energies = many.energies();
  CHECK(energies.kinetic == Approx(one.kineticEnergy()).epsilon(1e-10));
  CHECK(energies.potential == Approx(one.potentialEnergy()).epsilon(1e-10));
  CHECK(energies.kinetic > 0);
}

}  // namespace test_mapped
