// SPDX-License-Identifier: BSL-1.0
// A body in static equilibrium has its system solved for multipliers, and only where there are some.
#include "lagrangian/contact_scenes.hpp"

#include <sinew/scene/profiled.hpp>

namespace test_static_constraints {

using namespace sinew;

namespace {

constexpr double stiffness = 50, radius = 0.1, thickness = 0.01;

// a ball on a spring to a fixed point, in equilibrium, that far above the lowest place of the floor
template <class Solver>
auto ball(Solver solver, double height) {
  const double z = height + radius + thickness;
  return Simulation{profiled(
      node<"root">(FreeMotionAnimationLoop{},
                   solver,
                   DefaultPipeline{},
                   BruteForceBroadPhase{},
                   BVHNarrowPhase{},
                   MinProximityIntersection{.alarmDistance = 0.05, .contactDistance = thickness},
                   DefaultContactManager{.response = "FrictionContactConstraint", .responseParams = "mu=0"},
                   Gravity{{0, 0, 0}},
                   fixed_floor(),
                   node<"ball">(StaticSolver{},
                                SparseLDLSolver<>{},
                                MechanicalObject<Vec3d>{.position = {{0, 0, z + 1}, {0, 0, z}}},
                                UniformMass<Vec3d>{.vertexMass = 1},
                                StiffSpringForceField<Vec3d>{{{0, 1, stiffness, 0, 1}}},
                                FixedConstraint<Vec3d>{.indices = {0}},
                                // along the floor
                                PartialFixedConstraint<Vec3d>{.indices = {1}, .fixedDirections = {1, 1, 0}},
                                SphereCollisionModel<Vec3d>{.radius = radius})),
      Profile(500))};
}

}  // namespace

TEST_CASE(
    "what is in equilibrium is not factorised where no constraint acts on it, and where one does once") {
  const BlockGaussSeidelConstraintSolver gaussSeidel{.tolerance = 1e-14};
  const ConvexConstraintSolver convex{.tolerance = 1e-12, .momentumTolerance = 1e-12};
  auto factorised = [](auto solver, double height) {
    auto sim = ball(solver, height);
    sim.init();
    for (int i = 0; i < 4; ++i) sim.animate(0.01);
    auto const& body = sim.template at<"ball">();
    const double depth = std::max(0., -height), force = stiffness * depth;
    CHECK(body.state().position[1][2] == Approx(std::max(0., height) + radius + thickness).margin(1e-9));
    CHECK(force_on(sim.root().template get<DefaultContactManager>(), "/root/ball")[2] ==
          Approx(force).margin(1e-9));
    return sim.root().profile().calls(Phase::factorisation);
  };
  CHECK(factorised(gaussSeidel, 1) == 0);
  // in the first step it is in equilibrium, later ones solve its system themselves
  CHECK(factorised(gaussSeidel, -0.02) == 4);
  // without the compliance of the body
  CHECK(factorised(convex, 1) == 0);
  CHECK(factorised(convex, -0.02) == 3);
}

}  // namespace test_static_constraints
