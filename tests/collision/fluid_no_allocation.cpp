// SPDX-License-Identifier: BSL-1.0
// A fluid on a grid has all its memory after init. Here, since this program counts what is taken.
#include "catch.hpp"
#include "collision/allocations.hpp"

#include <sinew/fluid/fluid3d.hpp>
#include <sinew/mechanics.hpp>

namespace test_fluid_no_allocation {

using namespace sinew;

TEST_CASE("a step of a fluid on a grid does not allocate") {
  for (const int threads : {1, 2}) {
    Simulation sim{node<"root">(Gravity{{0, -9.81, 0}},
                                Threads{.count = threads},
                                node<"water">(Fluid3D{.nx = 22,
                                                      .ny = 18,
                                                      .nz = 18,
                                                      .cellwidth = 0.05,
                                                      .height = 9,
                                                      .dir = {1, 0.5, 0},
                                                      .viscosity = 1,
                                                      .source = {0, 0.2, 0},
                                                      .sourceRadius = 0.1}))};
    const long before = allocations;
    sim.init();
    const long after = allocations;
    CHECK(after > before);
    for (int k = 0; k < 40; ++k) sim.animate(0.01);
    CHECK(allocations == after);
    CHECK(sim.kineticEnergy() > 0);
    CHECK(sim.warnings().list().empty());
  }
}

}  // namespace test_fluid_no_allocation
