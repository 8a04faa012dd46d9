// SPDX-License-Identifier: BSL-1.0
// Elements removed from a runtime tree, and from one in a typed scene: the same bits as in a typed scene.
#include <sinew/registry.hpp>
#include <sinew/runtime/runtime.hpp>

#include "catch.hpp"

namespace test_element_removal {

using namespace sinew;

namespace {

using Bodies =
    Registry<Gravity, EulerImplicitSolver, CGLinearSolver<>, TetrahedronTopology, MechanicalObject<Vec3d>,
             DiagonalMass<Vec3d>, TetrahedronFEMForceField<Vec3d>, ConstantForceField<Vec3d>,
             SubsetMapping<Vec3d, Vec3d>, UniformVelocityDampingForceField<Vec3d>>;

std::vector<Eigen::Vector3d> points() {
  std::vector<Eigen::Vector3d> all;
  for (int i = 0; i < 8; ++i) all.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2)});
  return all;
}
std::vector<Tetrahedron> tetrahedra() {
  return hexahedra_to_tetrahedra(std::vector<Hexahedron>{{0, 1, 3, 2, 4, 5, 7, 6}});
}

TetrahedronTopology topology() { return {tetrahedra()}; }
MechanicalObject<Vec3d> state() { return {.position = points()}; }
DiagonalMass<Vec3d> mass() { return {.massDensity = 1}; }
ConstantForceField<Vec3d> force() { return {.indices = {1, 7}, .forces = {{1, 0, 0}, {0, 1, 0}}}; }

RuntimeNode<Bodies> body() {
  RuntimeNode<Bodies> node("body");
  node.add(topology()), node.add(state()), node.add(mass()), node.add(force());
  node.add(TetrahedronFEMForceField<Vec3d>{});
  auto& child = node.addChild("part");
  child.add(MechanicalObject<Vec3d>{});
  child.add(SubsetMapping<Vec3d, Vec3d>{.indices = {1, 6, 7}});
  child.add(UniformVelocityDampingForceField<Vec3d>{.dampingCoefficient = 1});
  return node;
}

auto typed() {
  return Simulation{node<"root">(
      Gravity{},
      EulerImplicitSolver{},
      CGLinearSolver<>{},
      node<"body">(topology(),
                   state(),
                   mass(),
                   force(),
                   TetrahedronFEMForceField<Vec3d>{},
                   node<"part">(MechanicalObject<Vec3d>{},
                                SubsetMapping<Vec3d, Vec3d>{.indices = {1, 6, 7}},
                                UniformVelocityDampingForceField<Vec3d>{.dampingCoefficient = 1})))};
}
auto runtime() {
  RuntimeNode<Bodies> root;
  root.add(Gravity{}), root.add(EulerImplicitSolver{}), root.add(CGLinearSolver<>{});
  root.addChild(body());
  return Simulation{std::move(root)};
}
auto mounted() {
  RuntimePlace<"objects", Bodies> place;
  place.addChild(body());
  return Simulation{node<"root">(Gravity{}, EulerImplicitSolver{}, CGLinearSolver<>{}, std::move(place))};
}

template <class Sim>
void run(Sim& sim, std::string_view path) {
  sim.init();
  for (int i = 0; i < 3; ++i) sim.animate(0.02);
  sim.removeElements(path, {.tetrahedra = {0, 1}});
  for (int i = 0; i < 3; ++i) sim.animate(0.02);
}

}  // namespace

TEST_CASE("typed, runtime and mounted trees lose elements alike, to the bit") {
  auto a = typed();
  auto b = runtime();
  auto c = mounted();
  run(a, "body"), run(b, "body"), run(c, "objects/body");
  auto const& expected = a.at<"body">().state().position;
  CHECK(expected.size() < 8);
  auto& other = *b.root().find_node("body");
  CHECK(other.get<MechanicalObject<Vec3d>>()->position == expected);
  CHECK(other.find_node("part")->get<SubsetMapping<Vec3d, Vec3d>>()->indices.size() ==
        a.at<"body/part">().get<SubsetMapping<Vec3d, Vec3d>>().indices.size());
  CHECK(c.at<"objects">().find_node("body")->get<MechanicalObject<Vec3d>>()->position == expected);
}

TEST_CASE("what is left in a runtime tree must be a scene; else nothing has changed") {
  auto sim = runtime();
  sim.init();
  sim.animate(0.02);
  auto& before = *sim.root().find_node("body");
  const auto positions = before.get<MechanicalObject<Vec3d>>()->position;
  CHECK_THROWS_AS(sim.removeElements("body", {.tetrahedra = {0, 1, 2, 3, 4, 5}}), Error);
  CHECK_THROWS_AS(sim.removeElements("nobody", {.tetrahedra = {0}}), Error);
  CHECK(&before == sim.root().find_node("body"));
  CHECK(before.get<MechanicalObject<Vec3d>>()->position == positions);
  CHECK(before.get<TetrahedronTopology>()->tetrahedra == tetrahedra());
}

}  // namespace test_element_removal
