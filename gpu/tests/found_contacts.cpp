// SPDX-License-Identifier: BSL-1.0
// Contacts that the host finds between bodies of the device and of its own, solved by multipliers.
#include "host_scenes.hpp"
#include "same_as_host.hpp"
#include "scenes_contact.hpp"

#include <sinew/contact.hpp>
#include <sinew/mapping/identity_mapping.hpp>

namespace test_found_contacts {

using namespace gpu_test;

namespace {

// Contacts that the host finds, of points that a mapping brings to it; some of them cannot move along a
// tangent.
struct FoundContacts : OneBody {
  static constexpr double dt = 0.01;
  static constexpr int steps = 40;
  static constexpr bool onDevice = false;
  template <class D>
  static auto make() {
    const BlockOnPlane b{.slope = 0.3};
    const Mesh m = b.mesh();
    MeshTopology floor;
    floor.triangles = {{0, 1, 2}, {0, 2, 3}};
    return Simulation{node<"root">(
        FreeMotionAnimationLoop{},
        b.solver(),
        b.gravity(),
        DefaultPipeline{},
        BruteForceBroadPhase{},
        BVHNarrowPhase{},
        MinProximityIntersection{.alarmDistance = 0.02, .contactDistance = 0.01},
        DefaultContactManager{.response = "FrictionContactConstraint", .responseParams = "mu=0.2"},
        node<"floor">(floor,
                      MechanicalObject<Vec3d>{
                          .position = {{-5, -5, -0.01}, {5, -5, -0.01}, {5, 5, -0.01}, {-5, 5, -0.01}}},
                      TriangleCollisionModel<Vec3d>{.moving = false, .simulated = false}),
        node<"body">(
            b.ode(),
            b.linear(),
            MeshTopology{.position = m.positions, .tetrahedra = m.tetrahedra},
            MechanicalObject<D>{},
            UniformMass<D>{.totalMass = b.mass},
            b.material<D>(),
            PartialFixedConstraint<D>{.indices = b.points(m, [](auto const& x) { return x[1] > 0.99; }),
                                      .fixedDirections = {true, false, false}},
            node<"skin">(
                MechanicalObject<Vec3d>{}, IdentityMapping<D, Vec3d>{}, PointCollisionModel<Vec3d>{})))};
  }
};

}  // namespace

TEST_CASE("contacts that the host finds for a block on the device hold it as on the host") {
  same_as_host<FoundContacts, Vec3d>(1e-8);
}

TEST_CASE("the motion of a block on the device with contacts that the host finds is found on the device") {
  auto sim = FoundContacts::make<CudaVec3d>();
  sim.init();
  for (int i = 0; i < 3; ++i) sim.animate(FoundContacts::dt);
  auto const& solver = sim.root().first<role::ConstraintSolver>();
  CHECK(solver.result.converged);
  CHECK(solver.result.conjugateGradients > 0);
  CHECK(solver.preconditioner.system.empty());  // the matrix of the host
}

}  // namespace test_found_contacts
