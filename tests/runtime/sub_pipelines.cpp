// SPDX-License-Identifier: BSL-1.0
// Pipelines among some models in scene files, with links as SOFA has them; one registry of its own, since
// little is needed.
#include "catch.hpp"

#include <sinew/collision/brute_force_broad_phase.hpp>
#include <sinew/collision/bvh_narrow_phase.hpp>
#include <sinew/collision/capsule_collision_model.hpp>
#include <sinew/collision/contact_manager.hpp>
#include <sinew/collision/line_collision_model.hpp>
#include <sinew/collision/min_proximity_intersection.hpp>
#include <sinew/collision/point_collision_model.hpp>
#include <sinew/collision/ray_trace_narrow_phase.hpp>
#include <sinew/collision/sphere_collision_model.hpp>
#include <sinew/collision/sub_collision_pipeline.hpp>
#include <sinew/collision/tetrahedron_collision_model.hpp>
#include <sinew/collision/triangle_collision_model.hpp>
#include <sinew/context/gravity.hpp>
#include <sinew/core/registry.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>
#include <sinew/runtime/save_scene.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/mesh_topology.hpp>

namespace test_sub_pipelines {

using namespace sinew;
using Catch::Contains;
using V = Eigen::Vector3d;

struct Mine
    : Registry<Gravity, EulerImplicitSolver, CGLinearSolver<>, MeshTopology, MechanicalObject<Vec3d>,
               UniformMass<Vec3d>, DefaultPipeline, SubCollisionPipeline, BruteForceBroadPhase,
               BVHNarrowPhase, RayTraceNarrowPhase, MinProximityIntersection, DefaultContactManager,
               PointCollisionModel<Vec3d>, LineCollisionModel<Vec3d>, TriangleCollisionModel<Vec3d>,
               SphereCollisionModel<Vec3d>, CapsuleCollisionModel<Vec3d>, TetrahedronCollisionModel<Vec3d>> {
};

namespace {

const std::string floorNode = R"(<Node name="floor"><MeshTopology triangles="0 1 2  0 2 3"/>
    <MechanicalObject position="-10 -10 0  10 -10 0  10 10 0  -10 10 0"/>
    <TriangleCollisionModel name="faces" moving="0" simulated="0" contactStiffness="100"/></Node>)";
std::string ball(std::string const& name, std::string const& place) {
  return "<Node name='" + name +
         "'><EulerImplicitSolver/><CGLinearSolver iterations='50' tolerance='1e-12'/><MechanicalObject "
         "position='" +
         place +
         "'/><UniformMass vertexMass='1'/><SphereCollisionModel name='ball' radius='0.5' "
         "contactStiffness='100'/></Node>";
}
const std::string stages = R"(<BruteForceBroadPhase name="broad"/><BVHNarrowPhase name="narrow"/>
    <MinProximityIntersection name="wide" alarmDistance="0.6" contactDistance="0.5"/>
    <MinProximityIntersection name="close" alarmDistance="0.2" contactDistance="0.1"/>
    <DefaultContactManager name="first"/><DefaultContactManager name="second"/>)";
std::string pipeline(std::string const& name, std::string const& models, std::string const& method,
                     std::string const& manager) {
  return "<SubCollisionPipeline name='" + name + "' depth='6' collisionModels='" + models +
         "' broadPhaseDetection='@broad' narrowPhaseDetection='@narrow' intersectionMethod='@" + method +
         "' contactManager='@" + manager + "'/>";
}
const std::string both = pipeline("large", "@/a/ball @floor/faces", "wide", "first") +
                         pipeline("small", "@b/ball\n @floor", "close", "second");
const std::string composite =
    "<CompositeCollisionPipeline name='all' parallelDetection='1' subCollisionPipelines='@large @small'/>";
const std::string bodies = floorNode + ball("a", "0 0 1.2") + ball("b", "0.1 0 1.4");

ReadScene<Mine> read(std::string const& components, bool lenient = false) {
  return parse_scene<Mine>(
      "test.scn", "<Node name='root' gravity='0 0 -10'>" + components + "</Node>", {.lenient = lenient});
}
std::string wrong(std::string const& components) {
  try {
    read(components);
  } catch (SceneError const& error) {
    return error.what();
  }
  return {};
}
bool has(std::vector<std::string> const& all, std::string_view what) {
  for (auto const& one : all)
    if (one.find(what) != one.npos) return true;
  return false;
}
std::vector<V> places(RuntimeNode<Mine>& root, int steps = 200) {
  Simulation sim{root};
  sim.init();
  std::vector<V> all;
  for (int i = 0; i < steps; ++i) {
    sim.animate(0.005);
    for (std::string_view body : {"a", "b"})
      if (auto* node = sim.root().find_node(body))
        all.push_back(node->template get<MechanicalObject<Vec3d>>()->position[0]);
  }
  return all;
}

template <FixedString Name>
auto typed_ball(V const& x) {
  return node<Name>(EulerImplicitSolver{},
                    CGLinearSolver<>{.iterations = 50, .tolerance = 1e-12},
                    MechanicalObject<Vec3d>{.position = {x}},
                    UniformMass<Vec3d>{.vertexMass = 1},
                    SphereCollisionModel<Vec3d>{.contactStiffness = 100, .radius = 0.5});
}

}  // namespace

TEST_CASE("pipelines with links give the bits of the typed scene, and of the one that is saved") {
  auto scene = read(stages + both + composite + bodies);
  CHECK(scene.warnings.empty());
  const auto found = places(scene.root);
  MeshTopology topology;
  topology.triangles = {{0, 1, 2}, {0, 2, 3}};
  Simulation typed{node<"root">(
      Gravity{{0, 0, -10}},
      node<"floor">(
          topology,
          MechanicalObject<Vec3d>{.position = {{-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}}},
          TriangleCollisionModel<Vec3d>{.moving = false, .simulated = false, .contactStiffness = 100}),
      typed_ball<"a">({0, 0, 1.2}),
      typed_ball<"b">({0.1, 0, 1.4}),
      node<"large">(SubCollisionPipeline{.collisionModels = "a/SphereCollisionModel floor"},
                    BruteForceBroadPhase{},
                    BVHNarrowPhase{},
                    MinProximityIntersection{.alarmDistance = 0.6, .contactDistance = 0.5},
                    DefaultContactManager{}),
      node<"small">(SubCollisionPipeline{.collisionModels = "b floor"},
                    BruteForceBroadPhase{},
                    BVHNarrowPhase{},
                    MinProximityIntersection{.alarmDistance = 0.2, .contactDistance = 0.1},
                    DefaultContactManager{}))};
  typed.init();
  std::vector<V> expected;
  for (int i = 0; i < 200; ++i) {
    typed.animate(0.005);
    expected.push_back(typed.at<"a">().state().position[0]);
    expected.push_back(typed.at<"b">().state().position[0]);
  }
  CHECK(found == expected);
  // the floor has stopped both, each at its distance
  CHECK(found[found.size() - 2][2] > 0.9);
  double least = 10;
  for (V const& x : found) least = std::min(least, x[2]);
  CHECK(least > 0.4);
  CHECK(least < 0.65);

  Simulation again{read(stages + both + composite + bodies).root};
  again.init();
  const std::string saved = scene_text(again, 0.005);
  CHECK_THAT(saved,
             Contains("<SubCollisionPipeline") && !Contains("broadPhaseDetection") && !Contains("Composite"));
  auto reread = parse_scene<Mine>("saved.scn", saved);
  CHECK(places(reread.root) == found);
}

TEST_CASE("what a composite does not list does nothing, and what no pipeline lists is warned of") {
  auto one = read(stages + both + "<CompositeCollisionPipeline subCollisionPipelines='@large'/>" + bodies);
  CHECK(
      has(one.warnings, "'small' is listed by no <CompositeCollisionPipeline>: it does nothing, as in SOFA"));
  const auto found = places(one.root, 400);
  CHECK(found[found.size() - 2][2] > 0.9);
  CHECK(found.back()[2] < -1);  // b falls through the floor
  Simulation sim{one.root};
  sim.init();
  bool warned = false;
  for (auto const& warning : sim.root().warnings)
    warned = warned || warning.find("since no SubCollisionPipeline lists it") != warning.npos;
  CHECK(warned);
  // without a composite all act
  auto all = read(stages + both + bodies);
  CHECK(places(all.root, 400).back()[2] > 0.4);
}

TEST_CASE("a pipeline that lists models stands right below the root") {
  auto scene = read(
      "<Node name='deep'><Node name='p'>" +
      stages.substr(0, stages.find("<MinProximityIntersection name=\"close\"")) +
      "<DefaultContactManager/><SubCollisionPipeline collisionModels='a floor'/></Node></Node>" + bodies);
  Simulation sim{scene.root};
  std::string message;
  try {
    sim.init();
  } catch (Error const& error) {
    message = error.what();
  }
  CHECK_THAT(message, Contains("deep/p") && Contains("a node right below the root"));
}

TEST_CASE("wrong links of pipelines are said, each with its place") {
  const std::string list = "@a/ball @floor/faces";
  CHECK_THAT(wrong(stages + pipeline("p", "@a/bal @floor", "wide", "first") + bodies),
             Contains("<SubCollisionPipeline>: collisionModels: '@a/bal' leads nowhere"));
  CHECK_THAT(wrong(stages + pipeline("p", "@a/MechanicalObject", "wide", "first") + bodies),
             Contains("is no collision model"));
  CHECK_THAT(wrong(stages + pipeline("p", list, "wid", "first") + bodies),
             Contains("intersectionMethod: '@wid' leads nowhere"));
  CHECK_THAT(wrong(stages + pipeline("p", list, "first", "first") + bodies),
             Contains("is no intersection method"));
  CHECK_THAT(
      wrong(stages + "<SubCollisionPipeline collisionModels='@a' broadPhaseDetection='@broad'/>" + bodies),
      Contains("no link to a stage: narrowPhaseDetection, intersectionMethod, contactManager"));
  CHECK_THAT(wrong(stages + both + "<CompositeCollisionPipeline/>" + bodies),
             Contains("it lists no pipelines"));
  CHECK_THAT(wrong(stages + both + "<CompositeCollisionPipeline subCollisionPipelines='@broad'/>" + bodies),
             Contains("'@broad' is no <SubCollisionPipeline>"));
  CHECK_THAT(wrong(stages + both + "<CompositeCollisionPipeline subCollisionPipelines='@medium'/>" + bodies),
             Contains("'@medium' leads nowhere"));
  CHECK_THAT(wrong(stages + both +
                   "<CompositeCollisionPipeline subCollisionPipelines='@large' parallel='1'/>" + bodies),
             Contains("has no attribute 'parallel'"));
}

}  // namespace test_sub_pipelines
