// SPDX-License-Identifier: BSL-1.0
// Mappings with several parents, from a scene file and composed by the compiler.
#include "same_bits.hpp"

namespace test_multi_mapping {

using namespace sinew;
using Catch::Matchers::Contains;

namespace {

const std::string left = R"(<Node name="left">
    <MechanicalObject name="dofs" position="0 0 0  0 1 0"/><UniformMass vertexMass="0.4"/>
    <StiffSpringForceField spring="0 1 50 0.1 1"/><FixedConstraint indices="0"/></Node>)";
const std::string right = R"(<Node name="right">
    <MechanicalObject template="Rigid3d" position="2 1 0 0 0 0 1" velocity="0 1 0 0 0 2"/><UniformMass/>
    <Node name="corner"><MechanicalObject name="points" position="-0.5 0 0 0 0.5 0.2"/><RigidMapping/></Node></Node>)";
const std::string joined = R"(<Node name="joined">
    <MechanicalObject name="child"/>
    <SubsetMultiMapping input="@../left/dofs @/right/corner " output="@child" indexPairs="1 1  0 1  1 0"/>
    <StiffSpringForceField spring="1 2 30 0.2 1  1 0 30 0.2 1"/></Node>)";

std::string scene(std::string_view parts, std::string_view matrix = "") {
  return text("<Node name='root' gravity='0 -9.81 0' dt='0.01'><EulerImplicitSolver/>",
              "<CGLinearSolver iterations='60' tolerance='1e-13' ",
              matrix,
              "/>",
              parts,
              "</Node>");
}

template <class Linear>
auto typed(Linear linear) {
  linear.iterations = 60, linear.tolerance = 1e-13;
  return Simulation{
      node<"root">(Gravity{{0, -9.81, 0}},
                   EulerImplicitSolver{},
                   linear,
                   node<"left">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {0, 1, 0}}},
                                UniformMass<Vec3d>{.vertexMass = 0.4},
                                StiffSpringForceField<Vec3d>{{{0, 1, 50, 0.1, 1}}},
                                FixedConstraint<Vec3d>{.indices = {0}}),
                   node<"right">(MechanicalObject<Rigid3d>{.position = {Rigid3d::Coord{.center = {2, 1, 0}}},
                                                           .velocity = {{0, 1, 0, 0, 0, 2}}},
                                 UniformMass<Rigid3d>{},
                                 node<"corner">(MechanicalObject<Vec3d>{{{-0.5, 0, 0}, {0, 0.5, 0.2}}},
                                                RigidMapping<Rigid3d, Vec3d>{})),
                   node<"joined">(MechanicalObject<Vec3d>{},
                                  SubsetMultiMapping<Vec3d, Vec3d, Parents<"../left", "../right/corner">>{
                                      .indexPairs = {{1, 1}, {0, 1}, {1, 0}}},
                                  StiffSpringForceField<Vec3d>{{{1, 2, 30, 0.2, 1}, {1, 0, 30, 0.2, 1}}}))};
}

template <class Linear>
void same(Linear linear, std::string const& xml) {
  auto a = typed(linear);
  auto b = start(parse_scene<Standard>("test.scn", xml));
  auto c = Simulation(to_runtime<Standard>(a.root()));
  a.init();
  c.init();
  const std::string before = same_bits::bits_of(a);
  REQUIRE(before == same_bits::bits_of(b));
  for (int i = 0; i < 100; ++i) a.animate(0.01), b.animate(0.01), c.animate(0.01);
  CHECK(same_bits::bits_of(a) == same_bits::bits_of(b));
  CHECK(same_bits::bits_of(a) == same_bits::bits_of(c));
  CHECK(same_bits::bits_of(a) != before);
  // checkpoints of both go on
  auto d = start(parse_scene<Standard>("saved.scn", scene_text(b, 0.01)));
  auto e = start(parse_scene<Standard>("saved.scn", scene_text(c, 0.01)));
  for (int i = 0; i < 20; ++i) a.animate(0.01), d.animate(0.01), e.animate(0.01);
  CHECK(same_bits::bits_of(a) == same_bits::bits_of(d));
  CHECK(same_bits::bits_of(a) == same_bits::bits_of(e));
}

}  // namespace

TEST_CASE("a child of several bodies: typed and read from a file, the same bits") {
  same(CGLinearSolver<>{}, scene(left + right + joined));
  same(CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{},
       scene(left + right + joined, "template='CompressedRowSparseMatrixMat3x3d'"));
}

TEST_CASE("a child of several bodies is baked") {
  const std::string cpp =
      bake_text<Standard>(parse_scene<Standard>("t.scn", scene(left + right + joined)), "t.scn");
  CHECK_THAT(cpp,
             Contains("SubsetMultiMapping<Vec3d, Vec3d, Parents<\"../left\", \"../right/corner\">>{") &&
                 Contains(".indexPairs = {{1, 1}, {0, 1}, {1, 0}}"));
}

TEST_CASE("a child of several bodies follows changes in the middle of a simulation") {
  auto sim = start(parse_scene<Standard>("t.scn", scene(left + right + joined)));
  for (int i = 0; i < 10; ++i) sim.animate(0.01);
  auto points = [&](std::string_view path) {
    return sim.root().find_node(path)->template get<MechanicalObject<Vec3d>>()->position;
  };
  sim.change([](auto& root) {
    auto& mapping = *root.find_node("joined")->find("SubsetMultiMapping");
    mapping.component.template getIf<SubsetMultiMapping<Vec3d, Vec3d>>()->indexPairs[2] = {0, 0};
    mapping.initialised = false;
  });
  CHECK(points("joined")[2] == points("left")[0]);
  CHECK(points("joined")[1] == points("left")[1]);
  sim.animate(0.01);
  CHECK_THROWS_WITH(
      sim.change([](auto& root) { root.takeChild(*root.find_node("left")); }),
      Contains("SubsetMultiMapping") && Contains("follows a node that is not there (at '/left')"));
  sim.animate(0.01);
}

TEST_CASE("bad parents in a scene file are named") {
  auto says = [](std::string const& xml, std::string const& words) {
    CHECK_THROWS_WITH(start(parse_scene<Standard>("t.scn", xml)), Contains("t.scn:") && Contains(words));
  };
  auto with = [](std::string what, std::string const& by) {
    std::string xml = scene(left + right + joined);
    return xml.replace(xml.find(what), what.size(), by);
  };
  const std::string input = "input=\"@../left/dofs @/right/corner \"";
  says(scene(left + joined + right), "comes before a parent, which it follows (at '/right/corner')");
  says(with(input, ""), "names no parents");
  says(with(input, "input='left'"), "names no parents");
  says(with(input, "input='@../left @../centre'"), "leads nowhere");
  says(with(input, "input='@../left @../right'"),
       "maps from other DataTypes than those of a parent (Vec3d from Rigid3d, at '/right')");
  says(with("indexPairs=\"1 1", "indexPairs=\"2 1"), "names parent 2");
  std::string apart = left;
  const std::string at = "<Node name=\"left\">";
  apart.replace(0, at.size(), at + "<EulerExplicitSolver/>");
  // the solver of the root moves all, too
  CHECK(start(parse_scene<Standard>("t.scn", scene(apart + right + joined))).root().warnings.size() == 1);
  std::string without = scene(apart + right + joined);
  const std::size_t solver = without.find("<EulerImplicitSolver"), linear = without.find("<CGLinearSolver");
  REQUIRE(linear != without.npos);
  without.erase(solver, without.find("/>", linear) + 2 - solver);
  says(without, "is under another ODE solver than a parent (at '/left')");
}

}  // namespace test_multi_mapping
