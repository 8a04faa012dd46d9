// SPDX-License-Identifier: BSL-1.0
// The shortest components of all roles, as the comments of core/roles have them (shortest.cmake), in one
// scene.
#include <sinew/scene/simulation.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

#include "shortest.hpp"

static_assert(ForceField<OriginSpring> && InteractionForceField<Tie<Between<"left", "right">>>);
static_assert(Mass<UnitMass> && ProjectiveConstraint<Nail> && Mapping<Doubled> && Topology<Chain>);
static_assert(OdeSolver<SymplecticEuler> && LinearSolver<SteepestDescent> && Engine<FirstNumbers>);
static_assert(Context<MoonGravity> && Visual<Markers>);

int main() {
  Simulation sim{
      node<"root">(MoonGravity{},
                   SymplecticEuler{},
                   SteepestDescent{},
                   FirstNumbers{},
                   Counter{},
                   Tie<Between<"left", "right">>{},
                   node<"left">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}}},
                                Chain{},
                                UnitMass{},
                                OriginSpring{},
                                Nail{},
                                node<"further">(MechanicalObject<Vec3d>{}, Doubled{}, OriginSpring{})),
                   node<"right">(MechanicalObject<Vec3d>{.position = {{2, 0, 0}}}, UnitMass{}))};
  sim.init();
  sim.animate(0.01);
  return sim.root().get<Counter>().steps == 1 && sim.kineticEnergy() > 0 && sim.potentialEnergy() > 0 ? 0 : 1;
}
