// SPDX-License-Identifier: BSL-1.0
// Fluids and bodies of scene files: a stirred tank, a flooded organ, a bleeding cut.
#include "catch.hpp"

#include <sinew/engines.hpp>
#include <sinew/fluid/fluid2d.hpp>
#include <sinew/fluid/fluid3d.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/registry.hpp>
#include <sinew/runtime/precompiled.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>
#include <sinew/solver/dfsph.hpp>

namespace test_fluid_scenes {

using namespace sinew;

namespace {

using Few = Standard;

auto started(std::string const& name) {
  auto read = read_scene<Few>(std::string(SINEW_EXAMPLE_SCENES) + "/" + name);
  Simulation<RuntimeNode<Few>> sim(std::move(read.root));
  sim.init();
  return sim;
}
template <class C>
C& component(Simulation<RuntimeNode<Few>>& sim, std::string_view path) {
  auto* node = sim.root().find_node(path);
  REQUIRE(node != nullptr);
  C* found = node->template get<C>();
  REQUIRE(found != nullptr);
  return *found;
}

}  // namespace

TEST_CASE("a solid in a fluid of a scene file has the bits of a typed one") {
  auto read = parse_scene<Few>("pool.scn", R"(
<Node name="root" gravity="0 -9.81 0">
  <Node name="pool"><Fluid3D nx="14" ny="14" nz="14" cellwidth="0.0625" height="9"/></Node>
  <Node name="box">
    <EulerExplicitSolver/>
    <MechanicalObject template="Rigid3d" position="0 0.1 0 0 0 0 1"/>
    <UniformMass vertexMass="14 1  0.015 0 0  0 0.015 0  0 0 0.015"/>
    <Node name="surface">
      <CubeTopology min="-0.15 -0.15 -0.15" max="0.15 0.15 0.15"/>
      <MechanicalObject template="Vec3d"/>
      <RigidMapping/>
      <ImmersedSolid/>
    </Node>
  </Node>
</Node>)");
  Simulation<RuntimeNode<Few>> sim(std::move(read.root));
  sim.init();
  Rigid3d::Coord at = Rigid3d::zero();
  at.center = {0, 0.1, 0};
  Simulation typed{node<"root">(
      Gravity{{0, -9.81, 0}},
      node<"pool">(Fluid3D<Vec3d>{.nx = 14, .ny = 14, .nz = 14, .cellwidth = 0.0625, .height = 9}),
      node<"box">(EulerExplicitSolver{},
                  MechanicalObject<Rigid3d>{.position = {at}},
                  UniformMass<Rigid3d>{
                      .vertexMass =
                          Rigid3d::MassType{.mass = 14, .inertia = 0.015 * 14 * Eigen::Matrix3d::Identity()}},
                  node<"surface">(CubeTopology{.min = {-0.15, -0.15, -0.15}, .max = {0.15, 0.15, 0.15}},
                                  MechanicalObject<Vec3d>{},
                                  RigidMapping<Rigid3d, Vec3d>{},
                                  ImmersedSolid<Vec3d>{})))};
  typed.init();
  for (int k = 0; k < 30; ++k) {
    sim.animate(0.01);
    typed.animate(0.01);
  }
  auto const& state = component<MechanicalObject<Rigid3d>>(sim, "box");
  CHECK(state.velocity == typed.at<"box">().state().velocity);
  CHECK(state.position[0].center == typed.at<"box">().state().position[0].center);
  CHECK(component<Fluid3D<Vec3d>>(sim, "pool").flow == typed.at<"pool">().get<Fluid3D<Vec3d>>().flow);
  CHECK(state.velocity[0].norm() > 1e-3);

  // and in a copy
  auto copy = sim;
  copy.animate(0.01);
  sim.animate(0.01);
  CHECK(component<MechanicalObject<Rigid3d>>(copy, "box").velocity == state.velocity);
}

TEST_CASE("a blade stirs a tank, the water takes its torque, and a box that swims goes with it", "[long]") {
  auto sim = started("stirred_tank.scn");
  auto& blade = component<ImmersedSolid<Vec3d>>(sim, "stirrer/blade");
  auto& stirrer = component<MechanicalObject<Rigid3d>>(sim, "stirrer");
  auto& box = component<MechanicalObject<Rigid3d>>(sim, "box");
  auto& water = component<Fluid3D<Vec3d>>(sim, "water");
  const double volume = water.volume();
  for (int k = 0; k < 150; ++k) {
    sim.animate(0.01);
    // in air it would turn by 1 N m / (6 * 0.0136 kg m^2) t
    REQUIRE(std::abs(stirrer.velocity[0][4]) < 12.3 * (k + 1) * 0.01);
  }
  CHECK(stirrer.velocity[0][4] > 0.5);
  CHECK(blade.body.load[4] < -0.2);
  CHECK((stirrer.position[0].center - Eigen::Vector3d(0, -0.09, 0)).norm() < 1e-9);
  // the water turns with it, and the box in the water
  double spin = 0;
  for (int k = 0; k < 8; ++k) {
    const double angle = k * 0.785;
    const Eigen::Vector3d x(0.15 * std::cos(angle), -0.09, 0.15 * std::sin(angle));
    const Eigen::Vector3d along(-std::sin(angle), 0, std::cos(angle));
    spin -= along.dot(water.grid.velocityAt(x)) / 8;
  }
  CHECK(spin > 0.01);
  CAPTURE(spin, stirrer.velocity[0][4], box.position[0].center);
  const Eigen::Vector3d moved = box.position[0].center - Eigen::Vector3d(0.2, 0.1, 0);
  CHECK(moved[2] < -0.001);
  // it swims with half of itself below the level, within a cell
  const double level = 0.28 - 0.2;
  CHECK(box.position[0].center[1] == Approx(level).margin(0.03));
  // the blade, and of the box at first 3 cm, take room from 14 cells of water
  CHECK(volume == Approx(0.64 * 0.64 * 0.28 - 0.4 * 0.12 * 0.06 - 0.1 * 0.1 * 0.03).epsilon(0.01));
  CHECK(water.volume() == Approx(volume).epsilon(1e-6));
}

TEST_CASE("water that floods an organ bends it, and does not go through it", "[long]") {
  auto sim = started("flooded_organ.scn");
  auto& tissue = component<MechanicalObject<Vec3d>>(sim, "tissue");
  auto& skin = component<FluidBoundary<Vec3d>>(sim, "tissue/skin");
  const auto rest = tissue.position;
  auto& water = component<MechanicalObject<Vec3d>>(sim, "water");
  double most = 0;
  for (int k = 0; k < 75; ++k) {
    sim.animate(0.004);
    double force = 0;
    for (auto const& f : skin.forces) force += f.norm();
    most = std::max(most, force);
  }
  CHECK(most > 1);  // [N]
  double bent = 0;
  for (std::size_t i = 0; i < rest.size(); ++i) bent = std::max(bent, (tissue.position[i] - rest[i]).norm());
  CHECK(bent > 0.005);
  CHECK(bent < 0.1);
  // all water is in the tank, and none nearer to a point of the skin than half a distance of particles
  auto const& points = component<MechanicalObject<Vec3d>>(sim, "tissue/skin").position;
  double nearest = 1;
  for (auto const& x : water.position) {
    CHECK(std::abs(x[0]) < 0.2275);
    CHECK(x[1] > -0.1075);
    CHECK(std::abs(x[2]) < 0.0975);
    for (auto const& p : points) nearest = std::min(nearest, (x - p).norm());
  }
  CHECK(nearest > 0.5 * 0.015);
}

TEST_CASE("a cut bleeds, and what comes to the tool is sucked off", "[long]") {
  auto sim = started("bleeding_cut.scn");
  auto& blood = component<MechanicalObject<Vec3d>>(sim, "blood");
  auto& source = component<ParticleSource<Vec3d>>(sim, "blood");
  auto& sink = component<ParticleSink<Vec3d>>(sim, "blood");
  for (int k = 0; k < 900; ++k) sim.animate(0.002);
  CHECK(source.batches == 44);  // at 0.04, 0.08 ... 1.76 s and 1.796 s is the start of the last step
  CHECK(sink.removed > 10);
  CHECK(int(blood.size()) + sink.removed == source.batches * 5);
  // it lies on the tissue
  for (auto const& x : blood.position) {
    CHECK(x[0] < 0.0602);
    CHECK(x[1] > 0.005);
  }
}

}  // namespace test_fluid_scenes
