// SPDX-License-Identifier: BSL-1.0
#include "io/files.hpp"
#include "same_bits.hpp"

namespace test_read_scene {

using namespace sinew;

namespace {

ReadScene<Standard> parse(std::string content, ReadSceneOptions options = {}) {
  return parse_scene<Standard>("test.scn", std::move(content), options);
}
std::string wrong(std::string content, ReadSceneOptions options = {}) {
  try {
    parse(std::move(content), options);
  } catch (SceneError const& error) {
    return error.what();
  }
  return "nothing was wrong";
}
/// What is wrong with one component in a node with a state.
std::string wrong_component(std::string const& component) {
  return wrong("<Node>\n  <MechanicalObject name=\"dofs\" position=\"0 0 0  1 0 0\"/>\n  " + component +
               "\n</Node>");
}

constexpr char spring_pair[] = R"(<?xml version="1.0"?>
<Node name="root" gravity="0 -10 0" dt="0.01">
  <EulerImplicit name="ode" rayleighStiffness="0.1"/>
  <CGLinearSolver iterations="50" tolerance="1e-12" threshold="1e-30"/>
  <Node name="body">
    <MechanicalObject template="Vec3" name="dofs" position="0 0 0  1 0 0  2 0 0"/>
    <UniformMass totalMass="3"/>
    <StiffSpringForceField spring="0 1 100 1 1  1 2 100 1 1"/>
    <FixedConstraint indices="0"/>
  </Node>
</Node>)";

}  // namespace

TEST_CASE("a scene in SOFA's dialect is the typed scene of the same components") {
  auto scene = parse(spring_pair);
  CHECK(scene.dt == 0.01);
  auto sim = start(std::move(scene));
  Simulation typed{
      node<"root">(Gravity{{0, -10, 0}},
                   EulerImplicitSolver{.rayleighStiffness = 0.1},
                   CGLinearSolver<>{.iterations = 50, .tolerance = 1e-12, .threshold = 1e-30},
                   node<"body">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}},
                                UniformMass<Vec3d>{.totalMass = 3},
                                StiffSpringForceField<Vec3d>{
                                    {{.first = 0, .second = 1, .stiffness = 100, .damping = 1, .length = 1},
                                     {.first = 1, .second = 2, .stiffness = 100, .damping = 1, .length = 1}}},
                                FixedConstraint<Vec3d>{.indices = {0}}))};
  typed.init();
  for (int i = 0; i < 200; ++i) sim.animate(0.01), typed.animate(0.01);
  CHECK(same_bits::bits_of(sim) == same_bits::bits_of(typed));
}

TEST_CASE("components take the DataTypes of the state around them") {
  auto scene = parse(R"(<Node>
    <MechanicalObject template="Rigid3" position="1 2 3 0 0 0 1"/>
    <UniformMass/>
    <Node name="points">
      <MechanicalObject template="Vec3f" position="0 1 0"/>
      <RigidMapping/>
      <ConstantForceField indices="0" forces="1 0 0"/>
    </Node>
  </Node>)");
  CHECK(scene.root.get<UniformMass<Rigid3d>>());
  auto* points = scene.root.find_node("points");
  REQUIRE(points);
  CHECK(points->get<RigidMapping<Rigid3d, Vec3f>>());
  CHECK(points->get<ConstantForceField<Vec3f>>());
}

TEST_CASE("a matrix is stored as the states under its solver allow, unless the template says how") {
  auto with = [](std::string_view solver, std::string_view state) {
    return parse(text(
        "<Node><EulerImplicitSolver/><", solver, "/><MechanicalObject ", state, "/><UniformMass/></Node>"));
  };
  constexpr std::string_view points = "position='0 1 0'",
                             rigid = "template='Rigid3d' position='1 2 3 0 0 0 1'";
  for (auto* any : {"SparseLDLSolver", "SparseLDLSolver template='CompressedRowSparseMatrix'"}) {
    CHECK(with(any, points).root.get<SparseLDLSolver<CompressedRowSparseMatrixMat3x3d>>());
    CHECK(with(any, rigid).root.get<SparseLDLSolver<CompressedRowSparseMatrixd>>());
  }
  CHECK(with("SparseLDLSolver template='CompressedRowSparseMatrixd'", points)
            .root.get<SparseLDLSolver<CompressedRowSparseMatrixd>>());
  // Jacobi's preconditioner is of numbers or of blocks
  CHECK(with("ShewchukPCGLinearSolver template='CompressedRowSparseMatrix'", points)
            .root.get<ShewchukPCGLinearSolver<CompressedRowSparseMatrixd>>());
}

TEST_CASE("links lead to values, in whatever order") {
  auto scene = parse(R"(<Node name="root">
    <Node name="a">
      <FixedConstraint name="fix" indices="@../b/held.indices"/>
      <MechanicalObject name="dofs" position="@/b/dofs.position"/>
    </Node>
    <Node name="b">
      <MechanicalObject name="dofs" position="0 0 0 1 1 1"/>
      <FixedConstraint name="held" indices="0-1"/>
      <ConstantForceField name="pull" indices="@[-1].indices" forces="@../push.forces"/>
    </Node>
    <ConstantForceField name="push" indices="0" forces="1 2 3"/>
    <MechanicalObject/>
  </Node>)");
  CHECK(scene.root.find_node("a")->get<FixedConstraint<Vec3d>>()->indices == std::vector<int>{0, 1});
  CHECK(scene.root.find_node("a")->get<MechanicalObject<Vec3d>>()->position.size() == 2);
  CHECK(scene.root.find_node("b")->get<ConstantForceField<Vec3d>>()->indices == std::vector<int>{0, 1});
  CHECK(scene.root.find_node("b")->get<ConstantForceField<Vec3d>>()->forces[0] == Eigen::Vector3d(1, 2, 3));
}

TEST_CASE("an interaction joins the states that its links lead to") {
  auto sim = start(parse(R"(<Node name="root" gravity="0 0 0">
    <EulerExplicitSolver/>
    <Node name="a"><MechanicalObject position="0 0 0"/><UniformMass/></Node>
    <Node name="b"><MechanicalObject name="m" position="3 0 0"/><UniformMass/></Node>
    <Node name="deep"><StiffSpringForceField object1="@../a" object2="@../b/m" spring="0 0 10 0 1"/></Node>
  </Node>)"));
  sim.animate(0.1);
  CHECK(sim.root().find_node("a")->get<MechanicalObject<Vec3d>>()->velocity[0].x() == Approx(2));
  CHECK(sim.root().find_node("b")->get<MechanicalObject<Vec3d>>()->velocity[0].x() == Approx(-2));
}

TEST_CASE("what has no meaning here is accepted, and said once") {
  auto scene = parse(R"(<Node showBoundingTree="0">
    <RequiredPlugin name="A"/> <RequiredPlugin name="B"/> <VisualStyle displayFlags="showForceFields"/>
    <TetrahedronSetGeometryAlgorithms drawTetrahedra="1"/>
    <MechanicalObject showObject="1" drawMode="2" printLog="0"/>
    <LMConstraintSolver/> <CollisionGroupManager/>
    <Node name="off" activated="0"><Nonsense/></Node>
  </Node>)");
  CHECK(scene.ignored.size() == 3);
  REQUIRE(scene.root.view.size() == 1);
  CHECK(*scene.root.view[0].find("displayFlags") == "showForceFields");
  REQUIRE(scene.warnings.size() == 2);
  CHECK_THAT(scene.warnings[0], Catch::Contains("<CollisionGroupManager> does nothing: bodies that touch"));
  CHECK_THAT(scene.warnings[1], Catch::Contains("test.scn:5:5: <LMConstraintSolver> does nothing"));
}

TEST_CASE("an animation loop takes a constraint solver where the scene has none, and says so") {
  auto scene = parse("<Node><FreeMotionAnimationLoop/></Node>");
  REQUIRE(scene.warnings.size() == 1);
  CHECK_THAT(
      scene.warnings[0],
      Catch::Contains("test.scn:1:7: <FreeMotionAnimationLoop> finds no constraint solver, and takes a "
                      "BlockGaussSeidelConstraintSolver"));
  CHECK(scene.root.get<BlockGaussSeidelConstraintSolver>());
  CHECK(parse("<Node><FreeMotionAnimationLoop/><Node><GenericConstraintSolver/></Node></Node>")
            .warnings.empty());
}

TEST_CASE("a class that would be missed is an error, or a warning to the lenient") {
  const std::string content = R"(<Node>
  <MechanicalObject/> <CylinderModel radius="1"/> <DirectSAPNarrowPhase/>
</Node>)";
  const std::string all = wrong(content);
  CHECK_THAT(all, Catch::Contains("test.scn:2:23: <CylinderModel> collides with nothing here; take"));
  CHECK_THAT(all, Catch::Contains("<DirectSAPNarrowPhase> is no stage here; take BVHNarrowPhase"));
  auto scene = parse_scene<Standard>("test.scn", content, {.lenient = true});
  REQUIRE(scene.warnings.size() == 2);
  CHECK_THAT(scene.warnings[0], Catch::Contains("It is left out"));
}

TEST_CASE("all that is wrong is said at once, each with file, line and column") {
  const std::string all = wrong(R"(<Node>
  <MechanicalObject position="0 0 zero"/>
  <UniformMas totalMass="1"/>
  <UniformMass totalMas="1"/>
  <FixedConstraint indices="@nobody.indices"/>
</Node>)");
  CHECK_THAT(
      all, Catch::Contains("test.scn:3:3: there is no component <UniformMas>; did you mean 'UniformMass'?"));
  const std::string more = wrong(R"(<Node>
  <MechanicalObject position="0 0 zero"/>
  <UniformMass totalMas="1"/>
  <FixedConstraint indices="@nobody.indices"/>
</Node>)");
  CHECK_THAT(more, Catch::Contains("test.scn:2:21: <MechanicalObject>: position: 'zero' is no number"));
  CHECK_THAT(
      more,
      Catch::Contains("test.scn:3:16: <UniformMass> has no attribute 'totalMas'; did you mean 'totalMass'?"));
  CHECK_THAT(more,
             Catch::Contains("test.scn:4:20: <FixedConstraint>: indices: '@nobody.indices' leads nowhere"));
}

TEST_CASE("each mistake has its sentence") {
  CHECK_THAT(wrong("<Scene/>"), Catch::Contains("the outermost element of a scene is <Node>"));
  CHECK_THAT(wrong("<Node"), Catch::Contains("is no well-formed XML"));
  CHECK_THAT(wrong("<Node><A></B></Node>"), Catch::Contains("is no well-formed XML"));
  CHECK_THAT(wrong("  "), Catch::Contains("XML"));
  CHECK_THAT(wrong("<Node dt=\"0\"/>"), Catch::Contains("dt is 0 s, but must be"));
  CHECK_THAT(wrong("<Node gravity=\"down\"/>"),
             Catch::Contains("test.scn:1:7: <Node>: gravity: 'down' is no number"));
  CHECK_THAT(wrong("<Node gravty=\"0 0 0\"/>"), Catch::Contains("did you mean 'gravity'?"));
  CHECK_THAT(wrong("<Node><UniformMass/></Node>"), Catch::Contains("has no state to act on"));
  // a class is named once
  CHECK_THAT(wrong("<Node><BoxROI box='0 0 0 1 1 1'/></Node>"),
             Catch::Contains("<BoxROI>: position is empty"));
  CHECK_THAT(wrong("<Node><Node><MechanicalObject/><IdentityMapping/></Node></Node>"),
             Catch::Contains("has no parent"));
  CHECK_THAT(wrong("<Node><MechanicalObject/><Node><IdentityMapping/></Node></Node>"),
             Catch::Contains("has no child"));
  CHECK_THAT(wrong("<Node><MechanicalObject template=\"Vec4\"/></Node>"),
             Catch::Contains("is not there over Vec4d; it is over"));
  CHECK_THAT(wrong("<Node><MechanicalObject template=\"CudaVec3f\"/></Node>"),
             Catch::Contains("none of the CUDA DataTypes: take Vec3f, or run the scene with"));
  CHECK_THAT(wrong_component("<TetrahedronFEMForceField template=\"Rigid3\"/>"),
             Catch::Contains("give both the same"));
  CHECK_THAT(wrong_component("<FixedConstraint indices=\"@dofs\"/>"), Catch::Contains("has no ''"));
  CHECK_THAT(wrong_component("<FixedConstraint indices=\"@dofs.positions\"/>"),
             Catch::Contains("did you mean 'position'?"));
  CHECK_THAT(wrong_component("<FixedConstraint name=\"f\" indices=\"@f.indices\"/>"),
             Catch::Contains("leads in a circle"));
  CHECK_THAT(wrong_component("<FixedConstraint indices=\"@[5].indices\"/>"),
             Catch::Contains("leads outside the node"));
  CHECK_THAT(wrong_component("<VisualModel filename=\"no/such.obj\"/>"),
             Catch::Contains("there is no file 'no/such.obj'"));
  CHECK_THAT(wrong_component("<VisualModel filename=\"picture.png\"/>"),
             Catch::Contains("no ending that is known"));
  CHECK_THAT(
      wrong_component("<StiffSpringForceField object1=\"@dofs\" object2=\"@nobody\" spring=\"0 0 1 1 1\"/>"),
      Catch::Contains("object2: '@nobody' leads nowhere"));
}

TEST_CASE("links in a circle end in a sentence") {
  CHECK_THAT(wrong("<Node><MechanicalObject name='a' position='@n/b.position'/>"
                   "<Node name='n'><MechanicalObject name='b' position='@../a.position'/></Node></Node>"),
             Catch::Contains("leads in a circle"));
}

TEST_CASE("an unknown class is a warning where the reader is lenient, an unknown attribute is not") {
  const auto scene = parse("<Node><Whatever/></Node>", {.lenient = true});
  REQUIRE(scene.warnings.size() == 1);
  CHECK_THAT(scene.warnings[0], Catch::Contains("there is no component <Whatever>"));
  CHECK_THAT(wrong("<Node><MechanicalObject whatever=\"1\"/></Node>", {.lenient = true}),
             Catch::Contains("has no attribute 'whatever'"));
}

TEST_CASE("attributes are set from outside") {
  ReadSceneOptions options;
  options.set = {
      {"body/UniformMass.totalMass", "6"}, {"root.dt", "0.5"}, {"body/dofs.position", "1 1 1 2 2 2 3 3 3"}};
  auto scene = parse(spring_pair, options);
  CHECK(scene.dt == 0.5);
  CHECK(scene.root.find_node("body")->get<UniformMass<Vec3d>>()->totalMass == 6.0);
  CHECK(scene.root.find_node("body")->get<MechanicalObject<Vec3d>>()->position[2] ==
        Eigen::Vector3d(3, 3, 3));
  auto set = [](std::string path) { return ReadSceneOptions{.set = {{std::move(path), "1"}}}; };
  CHECK_THAT(wrong(spring_pair, set("boddy/UniformMass.totalMass")), Catch::Contains("did you mean 'body'?"));
  CHECK_THAT(wrong(spring_pair, set("body")), Catch::Contains("name an attribute"));
  CHECK_THAT(wrong(spring_pair, set("body/UniformMass.totl")), Catch::Contains("has no attribute 'totl'"));
}

TEST_CASE("values out of range are wrong in the file; what init finds has its place there too, all at once") {
  CHECK_THAT(wrong_component("<UniformMass totalMass='-1'/>"),
             Catch::Contains("test.scn:3:3: <UniformMass>") && Catch::Contains("totalMass is -1"));
  auto scene = parse(R"(<Node>
  <MechanicalObject position="0 0 0"/>
  <FixedConstraint indices="5"/>
  <ConstantForceField indices="9" forces="1 0 0"/>
</Node>)");
  StandardSimulation sim(std::move(scene.root));
  try {
    sim.init();
    FAIL("nothing was wrong");
  } catch (Error const& error) {
    CHECK_THAT(error.what(), Catch::Contains("test.scn:3:3: ") && Catch::Contains("indices has 5"));
    CHECK_THAT(error.what(), Catch::Contains("test.scn:4:3: ") && Catch::Contains("indices has 9"));
  }
}

TEST_CASE("a checkpoint goes on bit by bit") {
  auto sim = start(parse(spring_pair));
  for (int i = 0; i < 57; ++i) sim.animate(0.01);
  auto again = start(parse(scene_text(sim, 0.01)));
  CHECK(again.time() == sim.time());
  CHECK(again.step() == 57);
  CHECK(same_bits::bits_of(again) == same_bits::bits_of(sim));
  for (int i = 0; i < 100; ++i) sim.animate(0.01), again.animate(0.01);
  CHECK(same_bits::bits_of(again) == same_bits::bits_of(sim));
  sim.reset();
  again.reset();
  CHECK(same_bits::bits_of(again) == same_bits::bits_of(sim));
}

}  // namespace test_read_scene
