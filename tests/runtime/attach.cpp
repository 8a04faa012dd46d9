// SPDX-License-Identifier: BSL-1.0
// Attached bodies, from a scene file and composed by the compiler.
#include "same_bits.hpp"

namespace test_attach {

using namespace sinew;
using Catch::Matchers::Contains;

namespace {

// SOLVER: of the scene; ATTACH: more attributes
const std::string xml = R"(<Node name="root" gravity="0 -9.81 0" dt="0.01">
  SOLVER
  <Node name="upper">
    <MechanicalObject name="dofs" position="0 0 0  0 -1 0.2  0.3 -1 0"/>
    <UniformMass vertexMass="0.1"/>
    <StiffSpringForceField spring="0 1 100 0.1 1  0 2 100 0.1 1  1 2 50 0.1 0.3"/>
    <FixedConstraint indices="0"/>
  </Node>
  <Node name="lower">
    <MechanicalObject name="dofs" position="0 -1 0.2  0.3 -1 0  0 -2 0"/>
    <UniformMass vertexMass="0.3"/>
    <StiffSpringForceField spring="0 2 100 0.1 1  1 2 100 0.1 1"/>
    <AttachConstraint name="joint" object1="@../upper/dofs" object2="@./" indices1="1 2" indices2="0 1" ATTACH/>
  </Node>
</Node>)";
const std::string euler =
    R"(<EulerImplicitSolver/><CGLinearSolver iterations="40" tolerance="1e-13" MATRIX/>)";

std::string with(std::string_view solver, std::string_view attach, std::string_view matrix = "") {
  std::string scene = xml;
  auto put = [&](std::string_view what, std::string_view by) {
    if (const std::size_t at = scene.find(what); at != scene.npos) scene.replace(at, what.size(), by);
  };
  put("SOLVER", solver);
  put("MATRIX", matrix);
  put("ATTACH", attach);
  return scene;
}

template <class... Solvers>
auto typed(bool twoWay, Solvers... solvers) {
  return Simulation{node<"root">(
      Gravity{{0, -9.81, 0}},
      solvers...,
      AttachProjectiveConstraint<Vec3d, Between<"upper", "lower">>{
          .indices1 = {1, 2}, .indices2 = {0, 1}, .twoWay = twoWay},
      node<"upper">(
          MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {0, -1, 0.2}, {0.3, -1, 0}}},
          UniformMass<Vec3d>{.vertexMass = 0.1},
          StiffSpringForceField<Vec3d>{{{0, 1, 100, 0.1, 1}, {0, 2, 100, 0.1, 1}, {1, 2, 50, 0.1, 0.3}}},
          FixedConstraint<Vec3d>{.indices = {0}}),
      node<"lower">(MechanicalObject<Vec3d>{.position = {{0, -1, 0.2}, {0.3, -1, 0}, {0, -2, 0}}},
                    UniformMass<Vec3d>{.vertexMass = 0.3},
                    StiffSpringForceField<Vec3d>{{{0, 2, 100, 0.1, 1}, {1, 2, 100, 0.1, 1}}}))};
}

template <class Sim>
void same(Sim a, std::string const& scene) {
  auto b = start(parse_scene<Standard>("test.scn", scene));
  a.init();
  const std::string before = same_bits::bits_of(a);
  REQUIRE(before == same_bits::bits_of(b));
  for (int i = 0; i < 100; ++i) a.animate(0.01), b.animate(0.01);
  CHECK(same_bits::bits_of(a) == same_bits::bits_of(b));
  CHECK(same_bits::bits_of(a) != before);
  auto c = start(parse_scene<Standard>("saved.scn", scene_text(b, 0.01)));
  for (int i = 0; i < 20; ++i) a.animate(0.01), c.animate(0.01);
  CHECK(same_bits::bits_of(a) == same_bits::bits_of(c));
  auto d = Simulation(to_runtime<Standard>(a.root()));
  d.init();
  a.init();
  CHECK(same_bits::bits_of(a) == same_bits::bits_of(d));
}

}  // namespace

TEST_CASE("attached bodies: typed and read from a file, the same bits") {
  CGLinearSolver<> free{.iterations = 40, .tolerance = 1e-13};
  CGLinearSolver<CompressedRowSparseMatrixMat3x3d> assembled{.iterations = 40, .tolerance = 1e-13};
  same(typed(true, EulerImplicitSolver{}, free), with(euler, "twoWay='1'"));
  same(typed(true, EulerImplicitSolver{}, assembled),
       with(euler, "twoWay='1'", "template='CompressedRowSparseMatrixMat3x3d'"));
  same(typed(false, EulerImplicitSolver{}, assembled),
       with(euler, "constraintFactor='1 1'", "template='CompressedRowSparseMatrixMat3x3d'"));
}

TEST_CASE("attached bodies are baked") {
  const std::string cpp =
      bake_text<Standard>(parse_scene<Standard>("t.scn", with(euler, "twoWay='1'")), "t.scn");
  CHECK_THAT(cpp,
             Contains("AttachProjectiveConstraint<Vec3d, Between<\"upper\", \"lower\">>{") &&
                 Contains(".twoWay = true"));
}

TEST_CASE("points of one body are attached in a scene file") {
  auto sim = start(parse_scene<Standard>("t.scn", R"(<Node name="root" gravity="0 0 0"><EulerExplicitSolver/>
    <MechanicalObject name="dofs" position="0 0 0 2 0 0"/><UniformMass/>
    <AttachProjectiveConstraint object1="@dofs" object2="@dofs" indices1="0" indices2="1" twoWay="true"/></Node>)"));
  CHECK(sim.root().get<MechanicalObject<Vec3d>>()->position[1].x() == 1);
}

TEST_CASE("bad attachments in a scene file are named") {
  auto says = [](std::string const& scene, std::string const& words) {
    CHECK_THROWS_WITH(start(parse_scene<Standard>("t.scn", scene)), Contains("t.scn:") && Contains(words));
  };
  says(with(euler, "minimum='3'"), "has no attribute 'minimum'");
  says(with(euler, "constraintFactor='1'"), "constraintFactor 1 entries");
  std::string apart = with("", "");
  for (const char* place : {"<Node name=\"upper\">", "<Node name=\"lower\">"}) {
    const std::string at = place;
    apart.replace(apart.find(at), at.size(), at + "<EulerExplicitSolver/>");
  }
  says(apart, "under different ODE solvers");
  std::string mapped = with(euler, "");
  const std::string at = "<Node name=\"lower\">";
  mapped.replace(mapped.find(at),
                 at.size(),
                 "<MechanicalObject position='0 0 0 1 1 1 2 2 2'/>" + at + "<IdentityMapping/>");
  says(mapped, "acts on a mapped state");
}

}  // namespace test_attach
