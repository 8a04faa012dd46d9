// SPDX-License-Identifier: BSL-1.0
// Counts every allocation while scenes step after init.
#include "static/allocations.hpp"

#include "catch.hpp"
#include "io/files.hpp"
#include "one_tetrahedron/scene.hpp"
#include "string_on_rigid/scene.hpp"
#include "vitrectomy/scene.hpp"

#include <sinew/control/hand_device.hpp>
#include <sinew/control/haptic_loop.hpp>
#include <sinew/scene/profiled.hpp>
#include <sinew/sinew.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <atomic>
#include <cstdlib>

using namespace sinew;

namespace {

template <class Sim>
long allocations_of(Sim sim) {
  sim.init();
  const long before = allocations;
  for (int i = 0; i < 100; ++i) sim.animate(0.001);
  sim.updateVisual();
  return allocations - before;
}

template <class Linear>
auto block(Linear linear) {
  const Mesh mesh = regular_grid_tetrahedra(4, 4, 4, {0, 0, 0}, {1, 1, 1});
  return Simulation{node<"root">(Gravity{},
                                 EulerImplicitSolver{},
                                 linear,
                                 TetrahedronTopology{mesh.tetrahedra},
                                 MechanicalObject<Vec3d>{mesh.positions},
                                 DiagonalMass<Vec3d>{.massDensity = 1000},
                                 TetrahedronFEMForceField<Vec3d>{},
                                 FixedConstraint<Vec3d>{.indices = {0, 1, 2}})};
}

// what is mapped, attached and joined
template <class Linear>
auto joints(Linear linear) {
  return Simulation{node<"root">(
      EulerImplicitSolver{},
      linear,
      AttachProjectiveConstraint<Vec3d, Between<"a", "b">>{.indices1 = {0}, .indices2 = {1}, .twoWay = true},
      node<"a">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}}},
                UniformMass<Vec3d>{},
                node<"length">(MeshTopology{.edges = {{0, 1}}},
                               MechanicalObject<Vec1d>{},
                               DistanceMapping<Vec3d, Vec1d>{.geometricStiffness = GeometricStiffness::exact},
                               RestShapeSpringsForceField<Vec1d>{})),
      node<"b">(MechanicalObject<Vec3d>{.position = {{0, 1, 0}, {0, 0, 0}}}, UniformMass<Vec3d>{}),
      node<"both">(MechanicalObject<Vec3d>{},
                   SubsetMultiMapping<Vec3d, Vec3d, Parents<"../a", "../b">>{.indexPairs = {{0, 1}, {1, 0}}},
                   StiffSpringForceField<Vec3d>{{{.first = 0, .second = 1, .length = 1}}}))};
}

// bodies that fall on a floor and on each other, in front of and behind the first contact; none starts in
// another, since what a step has to warn of allocates
template <class Intersection>
auto contacts(Intersection intersection) {
  MeshTopology floor;
  floor.triangles = {{0, 1, 2}, {0, 2, 3}};
  std::vector<Eigen::Vector3d> balls;
  for (int i = 0; i < 20; ++i) balls.push_back({0.3 * (i % 5), 0.35 * (i / 5 % 2), 0.3 + 0.4 * (i / 10)});
  MeshTopology box;
  box.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 1, 4}};
  return Simulation{node<"root">(
      Gravity{{0, 0, -10}},
      DefaultPipeline{},
      BruteForceBroadPhase{},
      BVHNarrowPhase{},
      intersection,
      DefaultContactManager{},
      node<"floor">(
          floor,
          MechanicalObject<Vec3d>{.position = {{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}}},
          TriangleCollisionModel<Vec3d>{.moving = false, .simulated = false, .contactFriction = 0.2}),
      node<"bodies">(
          EulerImplicitSolver{},
          CGLinearSolver<>{},
          node<"balls">(MechanicalObject<Vec3d>{.position = balls, .velocity = {{0, 0, -5}}},
                        UniformMass<Vec3d>{},
                        SphereCollisionModel<Vec3d>{.selfCollision = true, .radius = 0.15}),
          node<"tool">(
              MechanicalObject<Rigid3d>{.position = {{{0, 0, 1.2}}},
                                        .velocity = {Rigid3d::Deriv::Unit(2) * -3}},
              UniformMass<Rigid3d>{},
              SphereCollisionModel<Rigid3d>{.group = {1}, .radius = 0.2},
              node<"skin">(box,
                           MechanicalObject<Vec3d>{
                               .position = {{0, 0, 0.2}, {1, 0, 0.2}, {1, 1, 0.2}, {0, 1, 0.2}, {0, 0, 1}}},
                           RigidMapping<Rigid3d, Vec3d>{},
                           TriangleCollisionModel<Vec3d>{.group = {1}},
                           LineCollisionModel<Vec3d>{.group = {1}},
                           PointCollisionModel<Vec3d>{.group = {1}}))))};
}

// a tool that is moved and recorded, and pulls at a point
auto replay(std::string file, StateFormat format) {
  return Simulation{node<"root">(
      node<"tool">(
          MechanicalObject<Rigid3d>{.position = Rigid3d::VecCoord(20)},
          ReadState<Rigid3d>{.keyTimes = {0, 1},
                             .keyPositions = Rigid3d::VecCoord(40),
                             .interpolation = Interpolation::cubic},
          WriteState<Rigid3d>{.filename = std::move(file), .writeV = true, .format = format},
          node<"tip">(MechanicalObject<Vec3d>{.position = {{0, 0.5, 0}}}, RigidMapping<Rigid3d, Vec3d>{})),
      node<"point">(
          EulerExplicitSolver{}, MechanicalObject<Vec3d>{.position = {{0, 1, 0}}}, UniformMass<Vec3d>{}),
      StiffSpringForceField<Vec3d, Between<"tool/tip", "point">>{{{0, 0, 10, 0, 0.1}}})};
}

}  // namespace

TEST_CASE("the counter counts") {
  const long before = allocations;
  std::vector<double> some(100);
  some.push_back(1);
  void* volatile p = std::malloc(10);
  std::free(p);
  CHECK(allocations - before >= 3);
}

TEST_CASE("no step with multigrid allocates, not even the first") {
  CHECK(allocations_of(block(MultigridLinearSolver<>{.coarsestSize = 12})) == 0);
  CHECK(allocations_of(block(MultigridLinearSolver<>{.coarsestSize = 12, .coarseCycles = 2})) == 0);
  CHECK(allocations_of(block(MultigridLinearSolver<>{.refresh = 3, .warp = true})) == 0);
  CHECK(allocations_of(block(MultigridLinearSolver<CompressedRowSparseMatrixd>{.coarsestSize = 12})) == 0);
  CHECK(allocations_of(block(ShewchukPCGLinearSolver<>{.precondition = PreconditionerMethod::multigrid,
                                                       .coarsestSize = 12})) == 0);
}

TEST_CASE("a blade that moves beside a body makes no step allocate") {
  const Mesh mesh = regular_grid_tetrahedra(4, 4, 4, {0, 0, 0}, {1, 1, 1});
  CHECK(allocations_of(Simulation{
            node<"root">(CuttingManager{.toolModel = "tool", .bodyModel = "body"},
                         node<"tool">(EulerExplicitSolver{},
                                      MechanicalObject<Vec3d>{.position = {{3, 0, 0}, {3, 1, 0}, {3, 2, 0}},
                                                              .velocity = {{1, 0, 0}, {1, 0, 0}, {1, 0, 0}}},
                                      UniformMass<Vec3d>{}),
                         node<"body">(EulerExplicitSolver{},
                                      MeshTopology{.tetrahedra = mesh.tetrahedra},
                                      MechanicalObject<Vec3d>{mesh.positions},
                                      DiagonalMass<Vec3d>{.totalMass = 1}))}) == 0);
}

TEST_CASE("no step after init allocates, not even the first") {
  CHECK(allocations_of(examples::string_on_rigid(EulerExplicitSolver{})) == 0);
  CHECK(allocations_of(examples::string_on_rigid(RungeKutta2Solver{})) == 0);
  CHECK(allocations_of(examples::string_on_rigid(RungeKutta4Solver{})) == 0);
  CHECK(allocations_of(examples::string_on_rigid(EulerImplicitSolver{}, CGLinearSolver<>{})) == 0);
  CHECK(allocations_of(examples::string_on_rigid(EulerImplicitSolver{},
                                                 CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{})) == 0);
  CHECK(allocations_of(examples::one_tetrahedron()) == 0);
  CHECK(allocations_of(block(CGLinearSolver<>{})) == 0);
  CHECK(allocations_of(block(CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{})) == 0);
  for (const auto method :
       {PreconditionerMethod::ssor, PreconditionerMethod::incompleteCholesky, PreconditionerMethod::ldl})
    CHECK(allocations_of(
              block(ShewchukPCGLinearSolver<>{.updateStep = 3, .precondition = method, .warp = true})) == 0);
  CHECK(allocations_of(block(ShewchukPCGLinearSolver<CompressedRowSparseMatrixMat3x3d>{
            .updateStep = 3, .precondition = PreconditionerMethod::ldl, .warp = true})) == 0);
  CHECK(allocations_of(joints(CGLinearSolver<>{})) == 0);
  CHECK(allocations_of(joints(SparseLDLSolver<CompressedRowSparseMatrixMat3x3d>{})) == 0);
  CHECK(allocations_of(contacts(MinProximityIntersection{.alarmDistance = 0.1, .contactDistance = 0.05})) ==
        0);
  CHECK(allocations_of(contacts(ContinuousIntersection{.alarmDistance = 0.1, .contactDistance = 0.05})) == 0);
  CHECK(allocations_of(contacts(DiscreteIntersection{})) == 0);
  CHECK(allocations_of(Simulation{profiled(block(CGLinearSolver<>{}).root(), Profile(1000))}) == 0);
  // what is recorded is more than its buffer
  const files::TempFolder folder;
  for (const auto format : {StateFormat::text, StateFormat::binary})
    CHECK(allocations_of(replay(folder / "state", format)) == 0);
  CHECK(std::filesystem::file_size(folder / "state") > 3 * 65536 / 2);
}

TEST_CASE("no step of the vitrectomy allocates, not even those in which springs are cut") {
  const auto eye = examples::make_eye({.sectors = 24});
  auto sim = examples::vitrectomy_scene(eye);
  sim.init();
  const long before = allocations;
  while (sim.time() < eye.cutEnds) sim.animate(0.005);
  const long after = allocations;
  CHECK(after == before);
  CHECK(sim.at<"eye">().get<examples::CuttableSpringForceField<Vec3d>>().springs.empty());
}

TEST_CASE("the thread of a haptic loop does not allocate") {
  struct Counted : HandDevice<Rigid3d::Coord (*)(double)> {
    std::atomic<long> reads{0};
    DeviceState read(double time) {
      ++reads;
      return HandDevice::read(time);
    }
  } device;
  device.target = [](double time) {
    Rigid3d::Coord pose;
    pose.center[0] = 0.01 * time;
    return pose;
  };
  HapticController settings;
  settings.deviceMass = device.mass;
  HapticLoop loop(device, settings);
  loop.start();
  auto ticks = [&](long n) {
    for (const long until = device.reads + n; device.reads < until;) {
      loop.publish({loop.target().pose, loop.target().velocity});
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  };
  ticks(20);
  const long before = allocations;
  ticks(100);
  CHECK(allocations == before);
}
