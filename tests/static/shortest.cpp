// SPDX-License-Identifier: BSL-1.0
// The shortest components of all roles, as the comments of core/roles have them (shortest.cmake), in one
// scene.
#include <sinew/collision/contact_manager.hpp>
#include <sinew/collision/default_pipeline.hpp>
#include <sinew/collision/sphere_collision_model.hpp>
#include <sinew/lagrangian.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

#include "shortest.hpp"

static_assert(ForceField<OriginSpring> && InteractionForceField<Tie<Between<"left", "right">>>);
static_assert(Mass<UnitMass> && ProjectiveConstraint<Nail> && Mapping<Doubled> && Topology<Chain>);
static_assert(OdeSolver<SymplecticEuler> && LinearSolver<SteepestDescent> && Engine<FirstNumbers>);
static_assert(Context<MoonGravity> && Visual<Markers> && BehaviorModel<LateClock>);
static_assert(CollisionPipeline<DefaultPipeline> && FindsModelsNear<AllModels> &&
              ManagesContacts<DefaultContactManager>);
static_assert(FindsPrimitivesNear<AllPrimitives> && IntersectionMethod<NearerThan>);

static_assert(LagrangianConstraint<OnTable> && ConstraintSolver<OnePass> &&
              ConstraintCorrection<OneKilogram>);

int main() {
  Simulation sim{
      node<"root">(MoonGravity{},
                   FreeMotionAnimationLoop{},
                   OnePass{},
                   SymplecticEuler{},
                   SteepestDescent{},
                   FirstNumbers{},
                   Counter{},
                   LateClock{},
                   DefaultPipeline{},
                   AllModels{},
                   AllPrimitives{},
                   NearerThan{},
                   DefaultContactManager{},
                   Tie<Between<"left", "right">>{},
                   node<"left">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}}},
                                Chain{},
                                UnitMass{},
                                OriginSpring{},
                                Nail{},
                                SphereCollisionModel<Vec3d>{.radius = 0.48},
                                node<"further">(MechanicalObject<Vec3d>{}, Doubled{}, OriginSpring{})),
                   node<"right">(MechanicalObject<Vec3d>{.position = {{2, 0, 0}}},
                                 UnitMass{},
                                 OnTable{},
                                 OneKilogram{},
                                 SphereCollisionModel<Vec3d>{.radius = 0.48}))};
  sim.init();
  sim.animate(0.01);
  // the spheres around the points at 1 and 2 m are nearer than 0.1 m to each other, and no others
  const bool touches = sim.root().get<DefaultContactManager>().contacts.size() == 1;
  const bool moves = sim.kineticEnergy() > 0 && sim.potentialEnergy() > 0;
  const bool onTable = std::abs(sim.at<"right">().state().position[0][1]) < 1e-15;
  const bool late = sim.root().get<LateClock>().shown == 0.99 * 0.01;
  return sim.root().get<Counter>().steps == 1 && late && touches && moves && onTable ? 0 : 1;
}
