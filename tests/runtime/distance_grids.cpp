// SPDX-License-Identifier: BSL-1.0
// Grids of distances in scene files, by SOFA's names; one registry of its own, since little is needed.
#include "catch.hpp"

#include <sinew/collision/brute_force_broad_phase.hpp>
#include <sinew/collision/bvh_narrow_phase.hpp>
#include <sinew/collision/contact_manager.hpp>
#include <sinew/collision/default_pipeline.hpp>
#include <sinew/collision/min_proximity_intersection.hpp>
#include <sinew/collision/point_collision_model.hpp>
#include <sinew/collision/rigid_distance_grid_collision_model.hpp>
#include <sinew/context/gravity.hpp>
#include <sinew/core/registry.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>
#include <sinew/runtime/save_scene.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

namespace test_distance_grids {

using namespace sinew;
using Catch::Contains;

struct Mine : Registry<Gravity, EulerExplicitSolver, MechanicalObject<Vec3d>, MechanicalObject<Rigid3d>,
                       UniformMass<Vec3d>, DefaultPipeline, BruteForceBroadPhase, BVHNarrowPhase,
                       MinProximityIntersection, DefaultContactManager, PointCollisionModel<Vec3d>,
                       RigidDistanceGridCollisionModel<Rigid3d>> {};

namespace {

std::string scene(std::string const& model) {
  return R"(<Node name="root" gravity="0 0 -10"><DefaultPipeline/><BruteForceBroadPhase/><BVHNarrowPhase/>
    <MinProximityIntersection alarmDistance="0.3" contactDistance="0.1"/><DefaultContactManager/>
    <Node name="tool"><MechanicalObject template="Rigid3d" position="0 0 0  0 0 0 1"/>)" +
         model + R"(</Node>
    <Node name="free"><EulerExplicitSolver/><MechanicalObject position="0 0 1.05"/><UniformMass vertexMass="1"/>
      <PointCollisionModel/></Node></Node>)";
}

}  // namespace

TEST_CASE("shapes that are no files are read, found in contact, and saved as they are written") {
  for (const std::string name : {"RigidDistanceGridCollisionModel", "DistanceGridCollisionModel"}) {
    const std::string text =
        scene("<" + name + R"( fileRigidDistanceGrid="#cube" nx="11" ny="11" nz="11" showMeshPoints="0"
        sampling="0" moving="0" simulated="0"/>)");
    Simulation sim{parse_scene<Mine>("test.scn", text).root};
    sim.init();
    sim.animate(1e-3);
    auto const& contacts = sim.root().get<DefaultContactManager>()->contacts;
    REQUIRE(contacts.size() == 1);
    CHECK(contacts[0].distance == Approx(0.05));
    CHECK_THAT(scene_text(sim, 1e-3), Contains("filename=\"#cube\""));
  }
}

TEST_CASE("what SOFA's grids can and these cannot is said, with its place") {
  auto refused = [](std::string const& model) {
    try {
      Simulation sim{parse_scene<Mine>("test.scn", scene(model)).root};
      sim.init();
    } catch (Error const& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK_THAT(refused(R"(<RigidDistanceGridCollisionModel filename="#cube" sampling="0.1"/>)"),
             Contains("sampling"));
  CHECK_THAT(refused(R"(<RigidDistanceGridCollisionModel filename="#cone"/>)"), Contains("#sphere"));
  CHECK_THAT(refused(R"(<RigidDistanceGridCollisionModel filename="none.obj"/>)"), Contains("none.obj"));
}

}  // namespace test_distance_grids
