// SPDX-License-Identifier: BSL-1.0
// What materials and gears remember goes into checkpoints: a scene goes on with the same bits.
#include "catch.hpp"

#include <sinew/mechanics.hpp>
#include <sinew/runtime/precompiled.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>
#include <sinew/runtime/save_scene.hpp>

namespace test_histories {

using namespace sinew;

namespace {

using Mine = Standard;

template <class D>
void goes_on(std::string const& words, int before) {
  Simulation whole{parse_scene<Mine>("test.scn", words).root};
  whole.init();
  for (int n = 0; n < before; ++n) whole.animate(0.01);
  Simulation again{parse_scene<Mine>("saved.scn", scene_text(whole, 0.01)).root};
  again.init(whole.time(), whole.step());
  for (int n = 0; n < 20; ++n) {
    whole.animate(0.01);
    again.animate(0.01);
  }
  auto const& a = *whole.root().template get<MechanicalObject<D>>();
  auto const& b = *again.root().template get<MechanicalObject<D>>();
  CHECK(a.velocity == b.velocity);
}

}  // namespace

TEST_CASE("a plastic body in a scene file, with SOFA's attributes") {
  goes_on<Vec3d>(R"(<Node gravity="0 -9.81 0"><EulerImplicitSolver/><CGLinearSolver iterations="50"/>
      <RegularGridTopology n="4 2 2" max="3 1 1"/><MechanicalObject/><UniformMass totalMass="20"/>
      <TetrahedronFEMForceField youngModulus="2000" poissonRatio="0.3" plasticYieldThreshold="0.01"
                                plasticMaxThreshold="0.1" plasticCreep="0.5"/>
      <FixedConstraint indices="0 4 8 12"/></Node>)",
                 30);
}

TEST_CASE("gears in a scene file, after some turns") {
  goes_on<Rigid3d>(R"(<Node gravity="0 0 0"><EulerImplicitSolver/><CGLinearSolver iterations="50"/>
      <MechanicalObject template="Rigid3d" position="0 0 0 0 0 0 1  3 0 0 0 0 0 1" velocity="0 0 0 0 0 40  0 0 0 0 0 0"/>
      <UniformMass vertexMass="1 1  0.1 0 0  0 0.1 0  0 0 0.1"/>
      <GearSpringForceField spring="BEGIN_SPRING 0 0 1 1 AXIS 2 2 KS_T 1000 KS_R 100 1000 KD 0.001 RATIO 0.5 END_SPRING"/></Node>)",
                   70);
}

}  // namespace test_histories
