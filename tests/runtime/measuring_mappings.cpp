// SPDX-License-Identifier: BSL-1.0
// Mappings that measure, from a scene file and composed by the compiler.
#include "same_bits.hpp"

namespace test_measuring_mappings {

using namespace sinew;
using Catch::Matchers::Contains;

namespace {

const std::string xml = R"(<Node name="root" gravity="0 -9.81 0" dt="0.01">
  <EulerImplicitSolver rayleighStiffness="0.01"/>
  <CGLinearSolver iterations="60" tolerance="1e-12" MATRIX/>
  <Node name="block">
    <MeshTopology name="mesh" tetrahedra="0 1 2 3  1 2 3 4"
                  position="2 0 0  3 0 0  2.5 0 0.9  2.5 -0.8 0.3  2.5 -1 1.2"/>
    <MechanicalObject/>
    <UniformMass totalMass="0.5"/>
    <FixedConstraint indices="0 1 2"/>
    <Node name="lengths">
      <MeshTopology edges="0 3 1 3 2 3 3 4 2 4"/>
      <MechanicalObject template="Vec1"/>
      <DistanceMapping geometricStiffness="Exact" input="@.." output="@."/>
      <RestShapeSpringsForceField stiffness="80"/>
    </Node>
    <Node name="volumes">
      <MechanicalObject template="Vec1"/>
      <VolumeMapping/>
      <RestShapeSpringsForceField stiffness="20000"/>
    </Node>
    <Node name="center">
      <MechanicalObject/>
      <CenterOfMassMapping/>
      <ConstantForceField forces="1 0 0"/>
    </Node>
  </Node>
  <Node name="frame">
    <MechanicalObject template="Rigid3d" position="4 0 0  0 0 0 1" velocity="0 0 0  0 0 1"/>
    <UniformMass totalMass="1"/>
    <Node name="tip">
      <MechanicalObject position="0 -1 0"/>
      <RigidMapping geometricStiffness="2"/>
      <ConstantForceField forces="0 -10 0"/>
    </Node>
  </Node>
</Node>)";

std::string scene_of(std::string_view matrix) {
  std::string scene = xml;
  return scene.replace(scene.find("MATRIX"), 6, matrix);
}

template <class Linear>
auto typed(Linear linear) {
  linear.iterations = 60, linear.tolerance = 1e-12;
  return Simulation{node<"root">(
      Gravity{{0, -9.81, 0}},
      EulerImplicitSolver{.rayleighStiffness = 0.01},
      linear,
      node<"block">(
          MeshTopology{.position = {{2, 0, 0}, {3, 0, 0}, {2.5, 0, 0.9}, {2.5, -0.8, 0.3}, {2.5, -1, 1.2}},
                       .tetrahedra = {{0, 1, 2, 3}, {1, 2, 3, 4}}},
          MechanicalObject<Vec3d>{},
          UniformMass<Vec3d>{.totalMass = 0.5},
          FixedConstraint<Vec3d>{.indices = {0, 1, 2}},
          node<"lengths">(MeshTopology{.edges = {{0, 3}, {1, 3}, {2, 3}, {3, 4}, {2, 4}}},
                          MechanicalObject<Vec1d>{},
                          DistanceMapping<Vec3d, Vec1d>{.geometricStiffness = GeometricStiffness::exact},
                          RestShapeSpringsForceField<Vec1d>{.stiffness = {80}}),
          node<"volumes">(MechanicalObject<Vec1d>{},
                          VolumeMapping<Vec3d, Vec1d>{},
                          RestShapeSpringsForceField<Vec1d>{.stiffness = {20000}}),
          node<"center">(MechanicalObject<Vec3d>{},
                         CenterOfMassMapping<Vec3d, Vec3d>{},
                         ConstantForceField<Vec3d>{.forces = {{1, 0, 0}}})),
      node<"frame">(
          MechanicalObject<Rigid3d>{.position = {Rigid3d::Coord{.center = {4, 0, 0}}},
                                    .velocity = {{0, 0, 0, 0, 0, 1}}},
          UniformMass<Rigid3d>{.totalMass = 1},
          node<"tip">(MechanicalObject<Vec3d>{{{0, -1, 0}}},
                      RigidMapping<Rigid3d, Vec3d>{.geometricStiffness = RotationalStiffness::symmetrized},
                      ConstantForceField<Vec3d>{.forces = {{0, -10, 0}}})))};
}

template <class Linear>
void same(Linear linear, std::string const& scene) {
  auto a = typed(linear);
  auto b = start(parse_scene<Standard>("test.scn", scene));
  a.init();
  REQUIRE(same_bits::bits_of(a) == same_bits::bits_of(b));
  for (int i = 0; i < 100; ++i) a.animate(0.01), b.animate(0.01);
  CHECK(same_bits::bits_of(a) == same_bits::bits_of(b));
  // a checkpoint goes on as if nothing had been
  auto c = start(parse_scene<Standard>("saved.scn", scene_text(b, 0.01)));
  for (int i = 0; i < 20; ++i) a.animate(0.01), c.animate(0.01);
  CHECK(same_bits::bits_of(a) == same_bits::bits_of(c));
}

}  // namespace

TEST_CASE("mappings that measure: typed and read from a file, the same bits") {
  same(CGLinearSolver<>{}, scene_of(""));
  same(CGLinearSolver<CompressedRowSparseMatrixd>{}, scene_of("template='CompressedRowSparseMatrixd'"));
}

TEST_CASE("mappings that measure are baked") {
  const std::string cpp = bake_text<Standard>(parse_scene<Standard>("t.scn", scene_of("")), "t.scn");
  CHECK_THAT(cpp,
             Contains("DistanceMapping<Vec3d, Vec1d>{.geometricStiffness = GeometricStiffness::exact}") &&
                 Contains("RotationalStiffness::symmetrized"));
}

TEST_CASE("the centre of mass follows a mass that is changed in the middle of a simulation") {
  auto sim = start(parse_scene<Standard>("t.scn", scene_of("")));
  auto center = [&] {
    return sim.root().find_node("block/center")->template get<MechanicalObject<Vec3d>>()->position[0];
  };
  const Eigen::Vector3d before = center();
  sim.change([](auto& root) {
    auto& block = *root.find_node("block");
    block.remove("UniformMass");
    block.add(UniformMass<Vec3d>{.totalMass = 3});
  });
  CHECK((center() - before).norm() < 1e-12);  // equal masses, as before
  CHECK_THROWS_WITH(sim.change([](auto& root) { root.find_node("block")->remove("UniformMass"); }),
                    Contains("CenterOfMassMapping") && Contains("no mass in the node /root/block"));
  sim.animate(0.01);
}

}  // namespace test_measuring_mappings
