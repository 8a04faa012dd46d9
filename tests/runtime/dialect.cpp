// SPDX-License-Identifier: BSL-1.0
// What scenes of SOFA say beyond classes and attributes, read over a small registry.
#include "catch.hpp"
#include "io/files.hpp"

#include <sinew/runtime/precompiled.hpp>
#include <sinew/runtime/read_scene.hpp>

namespace test_dialect {

using namespace sinew;

namespace {

ReadScene<Standard> parse(std::string content, ReadSceneOptions const& options = {}) {
  return parse_scene<Standard>("test.scn", std::move(content), options);
}
ReadScene<Standard> node(std::string components) { return parse("<Node>\n" + components + "\n</Node>"); }
std::string wrong(std::string components) {
  try {
    node(std::move(components));
  } catch (SceneError const& error) {
    return error.what();
  }
  return "nothing was wrong";
}
bool has(std::vector<std::string> const& lines, std::string_view words) {
  return std::any_of(
      lines.begin(), lines.end(), [&](auto const& line) { return line.find(words) != line.npos; });
}
template <class C, class R>
C const& in(ReadScene<R>& scene, std::string_view path = "") {
  auto* found = scene.root.find_node(path);
  REQUIRE(found);
  REQUIRE(found->template get<C>());
  return *found->template get<C>();
}

}  // namespace

TEST_CASE("an include of SOFA's topologies takes the source that the scene gives") {
  const files::TempFolder folder;
  folder.write("TriangleSetTopology.xml", R"(<Node name="Group">
    <TriangleSetTopologyContainer name="Container" src="@" fileTopology="" tags=" "/>
    <TriangleSetTopologyModifier name="Modifier"/>
  </Node>)");
  folder.write("sheet.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n");
  auto scene = parse(R"(<Node>
    <MeshObjLoader name="loader" filename="sheet.obj"/>
    <MechanicalObject src="@loader"/>
    <include href="TriangleSetTopology.xml" src="@loader"/>
  </Node>)",
                     {.dataPaths = {folder / ""}});
  CHECK(in<MeshTopology>(scene).triangles.size() == 2);
  CHECK(in<MeshTopology>(scene).position.size() == 4);
  CHECK(scene.warnings.empty());
  // where no source is given, none is looked for
  auto bare = parse("<Node><MechanicalObject/><include href='TriangleSetTopology.xml' dx='1'/></Node>",
                    {.dataPaths = {folder / ""}});
  CHECK(in<MeshTopology>(bare).triangles.empty());
  CHECK(has(bare.warnings, "test.scn:1:66: <include>: no element of 'TriangleSetTopology.xml' has"));
}

TEST_CASE("a file in an attribute of an include lies beside the file that says so") {
  const files::TempFolder folder, data;
  data.write("part.xml", "<Node><MeshOBJLoader filename='x.obj'/></Node>");
  folder.write("mesh.obj", "v 0 0 0\n");
  const std::string path =
      folder.write("main.scn", "<Node><include href='part.xml' filename='mesh.obj' name='n'/></Node>");
  CHECK(read_scene<Standard>(path, {.dataPaths = {data / ""}}).files ==
        std::vector<std::string>{folder / "mesh.obj"});
}

TEST_CASE("a file of the folder Objects stands for a class that is not there, and never for one that is") {
  const files::TempFolder folder;
  std::filesystem::create_directory(folder / "Objects");
  folder.write("Objects/Held.xml", "<Node name='Group'><FixedConstraint indices='0'/></Node>");
  folder.write("Objects/UniformMass.xml", "<Group/>");
  const std::string path = folder.write("main.scn",
                                        "<Node><MechanicalObject position='0 0 0  1 0 0'/><UniformMass "
                                        "totalMass='3'/><Held indices='1'/></Node>");
  auto scene = read_scene<Standard>(path, {});
  CHECK(in<FixedConstraint<Vec3d>>(scene).indices == std::vector<int>{1});
  CHECK(in<UniformMass<Vec3d>>(scene).totalMass == 3.0);
}

TEST_CASE("LocalMinDistance has its cones, and no other method; a picture that is missing is said") {
  auto scene = node(
      "<LocalMinDistance coneFactor='0.3' angleCone='0.1' filterIntersection='0'/><MechanicalObject/>"
      "<Node><OglModel src='@gone'/></Node>");
  CHECK(in<LocalMinDistance>(scene).coneFactor == 0.3);
  CHECK(in<LocalMinDistance>(scene).angleCone == 0.1);
  CHECK(!in<LocalMinDistance>(scene).filterIntersection);
  CHECK(has(scene.warnings, "<OglModel>: src: '@gone' leads nowhere"));
  CHECK_THAT(wrong("<LocalMinDistance coneFactor='-1'/>"), Catch::Contains("coneFactor"));
  CHECK_THAT(wrong("<MinProximityIntersection coneFactor='0.3'/>"), Catch::Contains("coneFactor"));
}

TEST_CASE("a source or a file that is empty is not given") {
  CHECK(wrong("<MeshTopology src='@' fileTopology=''/><OglModel filename='' src=''/>") ==
        "nothing was wrong");
  CHECK_THAT(wrong("<MeshOBJLoader filename=''/>"), Catch::Contains("filename is empty"));
}

TEST_CASE("attributes as elements are read; any other element inside a component is an error") {
  auto scene = node(R"(<MechanicalObject position="0 0 0  1 0 0">
    <Attribute type="velocity"><Data value="0 1 0  0 2 0"/></Attribute>
  </MechanicalObject>)");
  CHECK(in<MechanicalObject<Vec3d>>(scene).velocity == Vec3d::VecDeriv{{0, 1, 0}, {0, 2, 0}});
  CHECK_THAT(
      wrong(
          "<MechanicalObject><Attribute type='velocity'><Data value='0 1'/></Attribute></MechanicalObject>"),
      Catch::Contains("test.scn:2:52: <MechanicalObject>: velocity: ends where a number is expected"));
  CHECK(wrong("<MechanicalObject>\n <UniformMass/></MechanicalObject>") ==
        "test.scn:3:2: <UniformMass>: stands inside <MechanicalObject>, but a component has attributes only; "
        "move it out");
}

TEST_CASE("NewtonRaphsonSolver says how the ODE solver beside it searches") {
  auto scene = node(R"(<NewtonRaphsonSolver maxNbIterationsNewton="7" absoluteResidualStoppingThreshold="1e-9"
    maxNbIterationsLineSearch="3" lineSearchCoefficient="0.25" warnWhenLineSearchFails="0" printLog="1"/>
    <EulerImplicitSolver rayleighMass="0.1" relativeInitialStoppingThreshold="1e-3"/>)");
  auto const& euler = in<EulerImplicitSolver>(scene);
  CHECK(euler.rayleighMass == 0.1);
  CHECK(euler.maxNbIterationsNewton == 7);
  CHECK(euler.absoluteResidualStoppingThreshold == 1e-9);
  CHECK(euler.relativeInitialStoppingThreshold == 1e-3);
  CHECK(euler.maxNbIterationsLineSearch == 3);
  CHECK(euler.lineSearchCoefficient == 0.25);
  CHECK(euler.relativeSuccessiveStoppingThreshold == 1e-5);  // SOFA's default, which is not ours
  CHECK(scene.warnings.empty());
}

TEST_CASE("preconditioners are settings of the solver that links to them") {
  auto scene = parse(R"(<Node>
    <Node name="a"><PCGLinearSolver preconditioner="@p"/><JacobiPreconditioner name="p"/></Node>
    <Node name="b"><SSORPreconditioner name="p" omega="1.3"/>
      <ShewchukPCGLinearSolver preconditioners="p" update_step="4"/></Node>
    <Node name="c"><ShewchukPCGLinearSolver preconditioners="precond"/><SparseLDLSolver name="precond"/></Node>
    <Node name="d"><ShewchukPCGLinearSolver preconditioner="@warp" update_step="1"/>
      <WarpPreconditioner name="warp" linearSolver="@factorization" update_step="15"/>
      <AsyncSparseLDLSolver name="factorization" template="CompressedRowSparseMatrixMat3x3"/></Node>
    <Node name="e"><PrecomputedWarpPreconditioner name="p" linearSolver="@s"/><SparseLDLSolver name="s"/>
      <Node name="below"><PCGLinearSolver preconditioner="@../p"/></Node></Node>
    <Node name="f"><PCGLinearSolver preconditioner="@w"/><WarpPreconditioner name="w" solverName="b"/>
      <BlockJacobiPreconditioner name="b"/><SSORPreconditioner name="unused"/></Node>
    <Node name="g"><PCGLinearSolver preconditioner="@m" levels="4"/>
      <MultigridLinearSolver name="m" refresh="7" levels="3" smootherDegree="5" tolerance="1"/></Node>
  </Node>)");
  using Solver = ShewchukPCGLinearSolver<>;
  using enum PreconditionerMethod;
  auto is = [&](std::string_view path, PreconditionerMethod method, bool warp, int updateStep) {
    auto const& solver = in<Solver>(scene, path);
    CHECK(solver.precondition == method);
    CHECK(solver.warp == warp);
    CHECK(solver.updateStep == updateStep);
    CHECK_FALSE(scene.root.find_node(path)->get<SparseLDLSolver<>>());
  };
  is("a", jacobi, false, 1);
  is("b", ssor, false, 4);
  CHECK(in<Solver>(scene, "b").omega == 1.3);
  is("c", ldl, false, 1);
  is("d", ldl, true, 15);
  is("e/below", ldl, true, 0);
  is("f", blockJacobi, true, 1);
  is("g", multigrid, false, 7);
  CHECK(in<Solver>(scene, "g").levels == 4);  // what the solver says itself
  CHECK(in<Solver>(scene, "g").smootherDegree == 5);
  CHECK(scene.warnings.size() == 5);  // of the four that turn, too
  CHECK(has(scene.warnings, "<SSORPreconditioner>: no solver links to it"));
  CHECK(has(scene.warnings, "<WarpPreconditioner>: it rotates with the neighbourhood"));
  CHECK(wrong(R"(<PCGLinearSolver preconditioner="@nowhere"/>)")
            .find("there is no preconditioner '@nowhere'") != std::string::npos);
  CHECK(wrong(R"(<PCGLinearSolver preconditioner="@w"/><WarpPreconditioner name="w" linearSolver="@w"/>)")
            .find("there is no preconditioner '@w'") != std::string::npos);
}

TEST_CASE("NewtonRaphsonSolver is found by a link, in the node, or below") {
  auto scene = parse(R"(<Node>
    <NewtonRaphsonSolver name="first" maxNbIterationsNewton="2"/>
    <NewtonRaphsonSolver name="the second" maxNbIterationsNewton="3"/>
    <Node name="a"><StaticSolver newtonSolver="@../the second"/></Node>
    <Node name="b">
      <StaticOdeSolver newtonSolver="@../newton"/>
      <NewtonRaphsonSolver name="newton" maxNbIterationsNewton="4"/>
    </Node>
    <Node name="c"><BDF1/><Node><NewtonRaphsonSolver maxNbIterationsNewton="5"/></Node></Node>
    <Node name="d"><StaticSolver newton_iterations="6"/></Node>
    <EulerImplicitSolver/>
  </Node>)");
  CHECK(in<StaticSolver>(scene, "a").maxNbIterationsNewton == 3);
  CHECK(in<StaticSolver>(scene, "b").maxNbIterationsNewton == 4);
  CHECK(in<BDFOdeSolver>(scene, "c").maxNbIterationsNewton == 5);
  CHECK(in<BDFOdeSolver>(scene, "c").order == 1);
  CHECK(in<StaticSolver>(scene, "d").maxNbIterationsNewton == 6);
  CHECK(in<EulerImplicitSolver>(scene).maxNbIterationsNewton == 2);
  CHECK(scene.warnings.empty());
}

TEST_CASE("NewtonRaphsonSolver without effect is said; what is wrong in it has its place") {
  CHECK(has(node("<NewmarkImplicitSolver/><NewtonRaphsonSolver/>").warnings,
            "test.scn:2:25: <NewtonRaphsonSolver>: NewmarkImplicitSolver has no iterations"));
  CHECK(has(node("<NewtonRaphsonSolver/>").warnings, "test.scn:2:1: <NewtonRaphsonSolver>: no ODE solver"));
  CHECK_THAT(
      wrong("<BDFOdeSolver/>\n<NewtonRaphsonSolver maxNbIterationsNewtn='2'/>"),
      Catch::Contains("test.scn:3:22: ") &&
          Catch::Contains("has no attribute 'maxNbIterationsNewtn'; did you mean 'maxNbIterationsNewton'?"));
  CHECK_THAT(wrong("<BDFOdeSolver/>\n<NewtonRaphsonSolver maxNbIterationsNewton='x'/>"),
             Catch::Contains("test.scn:3:22: ") && Catch::Contains("'x' is no whole number"));
}

TEST_CASE("CGImplicit is implicit Euler with conjugate gradients") {
  auto scene = node("<CGImplicit iterations='40' tolerance='1e-6' vdamping='0.2'/>");
  auto const& euler = in<EulerImplicitSolver>(scene);
  CHECK(euler.rayleighStiffness == 0.1);
  CHECK(euler.rayleighMass == 0.1);
  CHECK(euler.vdamping == 0.2);
  auto const& cg = in<CGLinearSolver<>>(scene);
  CHECK(cg.iterations == 40);
  CHECK(cg.tolerance == 1e-6);
  CHECK(cg.threshold == 1e-5);
  // beside a solver it adds its linear solver only
  auto other = node("<EulerImplicitSolver/><Object type='CGImplicit' threshold='1e-10'/>");
  CHECK(in<EulerImplicitSolver>(other).rayleighMass == 0);
  CHECK(in<CGLinearSolver<>>(other).threshold == 1e-10);
  CHECK(other.root.components().size() == 3);  // with gravity
  CHECK(scene.warnings.empty());
  CHECK(has(other.warnings,
            "test.scn:2:23: <CGImplicit>: its node has an ODE solver already, <EulerImplicitSolver>; of this "
            "one the conjugate gradients alone are taken, where SOFA makes a step with each"));
  for (auto const* name : {"CGImplicitSolver", "CgImplicit", "CgImplicitSolver"}) {
    auto one = node(text("<", name, " vdamping='0.2'/>"));
    CHECK(in<EulerImplicitSolver>(one).vdamping == 0.2);
  }
  CHECK_THAT(wrong("<CGImplicit maxiter='3'/>"), Catch::Contains("has no attribute 'maxiter'"));
}

TEST_CASE("classes that are another one with an attribute of its own") {
  auto scene = node("<MechanicalObject/><NodalLinearDampingForceField dampingCoefficient='0.5'/>");
  CHECK(in<UniformVelocityDampingForceField<Vec3d>>(scene).implicit);
  CHECK(in<UniformVelocityDampingForceField<Vec3d>>(scene).dampingCoefficient == 0.5);
  CHECK_THAT(wrong("<MechanicalObject/><NodalLinearDampingForceField dampingCoefficientVector='1 2 3'/>"),
             Catch::Contains("<NodalLinearDampingForceField> has no attribute 'dampingCoefficientVector'"));
  auto bdf = node("<BDF1OdeSolver/>");
  CHECK(in<BDFOdeSolver>(bdf).order == 1);
  auto fall = node("<GravityForceField gravitationalAcceleration='0 0 -3'/>");
  CHECK(in<Gravity>(fall).gravity == Eigen::Vector3d(0, 0, -3));
  auto svd = node("<MechanicalObject/><TetrahedronFEMForceField method='svd'/>");
  CHECK(in<TetrahedronFEMForceField<Vec3d>>(svd).method == RotationMethod::polar);
  auto membrane = node("<MechanicalObject/><TriangularFEMForceField poissonRatio='0.1 0.2'/>");
  CHECK(in<TriangleFEMForceField<Vec3d>>(membrane).poissonRatio == std::vector<double>{0.1, 0.2});
}

TEST_CASE("of several topologies in a node the last is that of the node; the others give data") {
  auto scene = parse(R"(<Node>
    <RegularGridTopology name="grid" n="3 3 1"/>
    <MechanicalObject name="dofs" translation="0 0 1"/>
    <QuadSetTopologyContainer name="Container" quads="@grid.quads"/>
    <TriangleFEMForceField topology="@Container"/>
    <UniformMass topology="@grid"/>
    <FixedConstraint indices="@box.indices"/>
    <BoxROI name="box" box="-1 -1 0.5 0.1 2 2"/>
    <Node name="surface">
      <TriangleSetTopologyContainer name="Surface"/>
      <Quad2TriangleTopologicalMapping input="@../Container" output="@Surface"/>
    </Node>
  </Node>)");
  CHECK_FALSE(scene.root.get<RegularGridTopology>());
  CHECK(in<MeshTopology>(scene).quads.size() == 4);
  CHECK(in<MeshTopology>(scene).position.empty());
  CHECK(in<MechanicalObject<Vec3d>>(scene).position.size() == 9);
  CHECK(in<FixedConstraint<Vec3d>>(scene).indices == std::vector<int>{0, 3, 6});
  CHECK(in<MeshTopology>(scene, "surface").triangles.size() == 8);
  REQUIRE(scene.warnings.size() == 1);
  CHECK(scene.warnings[0] ==
        "test.scn:6:18: <UniformMass>: topology leads to 'grid', but it acts over "
        "'Container', the last topology of the nearest node that has one");
}

TEST_CASE("a topology may have the points of the state beside it") {
  auto scene = node(R"(<MechanicalObject name="dofs" position="0 0 0  1 1 0"/>
    <EdgeSetTopologyContainer edges="0 1" position="@dofs.position"/>)");
  CHECK(in<MeshTopology>(scene).position.size() == 2);
  CHECK_THAT(wrong("<MechanicalObject name='dofs'/><MeshTopology position='@dofs.position'/>"),
             Catch::Contains("leads in a circle"));
}

TEST_CASE("a container takes from a source what it can hold") {
  auto scene = parse(R"(<Node>
    <Node name="g"><RegularGridTopology name="grid" n="3 3 3"/></Node>
    <Node name="t"><TriangleSetTopologyContainer src="@/g/grid"/></Node>
    <Node name="q"><QuadSetTopologyContainer src="@/g/grid"/></Node>
    <Node name="m"><MeshTopology src="@/g/grid"/></Node>
  </Node>)");
  auto const &t = in<MeshTopology>(scene, "t"), &q = in<MeshTopology>(scene, "q"),
             &m = in<MeshTopology>(scene, "m");
  CHECK((t.triangles.size() == 72 && t.quads.empty() && t.hexahedra.empty() && t.edges.size() == 54 + 36));
  CHECK((q.quads.size() == 36 && q.triangles.empty() && q.hexahedra.empty()));
  CHECK((m.quads.size() == 36 && m.triangles.size() == 72 && m.hexahedra.size() == 8));
}

TEST_CASE("points of a topology may be given as those of the state") {
  auto scene = node("<MechanicalObject template='Vec1'/><PointSetTopologyContainer position='1 '/>");
  CHECK(in<MeshTopology>(scene).position == std::vector<Eigen::Vector3d>{{1, 0, 0}});
  CHECK_THAT(wrong("<MechanicalObject/><PointSetTopologyContainer position='1 '/>"),
             Catch::Contains("ends where a number is expected"));
}

TEST_CASE("a visual model without vertices has those around it") {
  auto scene = parse(R"(<Node>
    <RegularGridTopology name="grid" n="3 3 1"/>
    <MechanicalObject/>
    <Node name="own"><OglModel triangles="@../grid.triangles"/><IdentityMapping/></Node>
    <Node name="all"><OglModel color="red"/><IdentityMapping/></Node>
    <Node name="none"><OglModel quads="0 1 4 3"/><BarycentricMapping/></Node>
    <Node name="two"><OglModel vertices="0 0 0" position="1 1 1  2 2 2"/></Node>
    <Node name="one"><OglModel vertices="0 0 0"/></Node>
    <Node><MechanicalObject/><IdentityMapping/>
      <Node name="far"><OglModel edges="7 8"/><IdentityMapping/></Node></Node>
  </Node>)");
  auto* far = scene.root.find_node("Node/far")->get<VisualModel>();
  REQUIRE(far->mesh.positions.size() == 9);
  CHECK(far->mesh.positions[8] == Eigen::Vector3d(1, 1, 0));
  CHECK(in<VisualModel>(scene, "own").mesh.positions.size() == 9);
  CHECK(in<VisualModel>(scene, "own").mesh.triangles.size() == 8);
  CHECK(in<VisualModel>(scene, "own").mesh.quads.empty());
  CHECK(in<VisualModel>(scene, "all").mesh.positions.size() == 9);
  CHECK(in<VisualModel>(scene, "all").mesh.quads.size() == 4);
  CHECK(in<VisualModel>(scene, "none").mesh.positions.size() == 9);
  CHECK(in<VisualModel>(scene, "none").mesh.quads.size() == 1);
  CHECK(in<VisualModel>(scene, "two").mesh.positions.size() == 2);
  CHECK(in<VisualModel>(scene, "one").mesh.positions.size() == 1);
}

// Standard has no mapping from rigid bodies to such points
using Centres = Registry<Gravity, MechanicalObject<Rigid3d>, VisualModel, IdentityMapping<Rigid3d, Vec3f>>;

TEST_CASE("of a class that needs a package it is said how to get that") {
  for (std::string name : {"ConvexCollisionModel", "BulletConvexHullModel"})
    CHECK_THROWS_WITH(
        parse_scene<Centres>("test.scn", "<Node>\n <" + name + " points='0 0 0'/></Node>"),
        Catch::Contains("test.scn:2:2: there is no component <" + name +
                        "> in this program, which was built without libccd; install that (Debian: "
                        "libccd-dev) and build Sinew anew"));
}

TEST_CASE("a visual model without vertices has the centres of rigid bodies") {
  auto scene = parse_scene<Centres>(
      "test.scn", R"(<Node><MechanicalObject template="Rigid3" position="1 2 3 0 0 0 1  4 5 6 0 0 0 1"/>
    <Node name="points"><OglModel/><IdentityMapping/></Node></Node>)");
  CHECK(in<VisualModel>(scene, "points").mesh.positions ==
        std::vector<Eigen::Vector3d>{{1, 2, 3}, {4, 5, 6}});
}

TEST_CASE("of an attribute that is given twice the last counts, which is said") {
  auto scene = node("<UniformMass totalMass='1'\n totalMass='2'/><MechanicalObject/>");
  CHECK(in<UniformMass<Vec3d>>(scene).totalMass == 2.0);
  CHECK(has(scene.warnings, "test.scn:3:2: <UniformMass>: attribute 'totalMass' is given twice"));
}

TEST_CASE("forces and masses over a kind of elements are named by their template") {
  auto fem = [](std::string const& words) { return "<MechanicalObject position='0 0 0'/>" + words; };
  auto hexahedra =
      node(fem("<CorotationalFEMForceField template='Vec3,Hexahedron' youngModulus='7' "
               "computeForceStrategy='parallel' elementSpace='0.1'/>"));
  CHECK(in<HexahedronFEMForceField<Vec3d>>(hexahedra).method == HexahedronMethod::large);
  CHECK(in<HexahedronFEMForceField<Vec3d>>(hexahedra).youngModulus == std::vector<double>{7});
  CHECK(hexahedra.warnings.empty());
  auto polar =
      node(fem("<CorotationalFEMForceField template='Vec3d, Tetrahedron' rotationMethod='stable_polar'/>"));
  CHECK(in<TetrahedronFEMForceField<Vec3d>>(polar).method == RotationMethod::polar);
  auto small = node(fem("<LinearSmallStrainFEMForceField template='Vec3,Tetrahedron'/>"));
  CHECK(in<TetrahedronFEMForceField<Vec3d>>(small).method == RotationMethod::small);

  auto prisms = node(fem("<CorotationalFEMForceField template='Vec3,Prism' rotationMethod='polar'/>"));
  CHECK(in<PrismFEMForceField<Vec3d>>(prisms).method == ElementRotation::polar);
  auto pyramids = node(fem("<LinearSmallStrainFEMForceField template='Vec3,Pyramid'/>"));
  CHECK(in<PyramidFEMForceField<Vec3d>>(pyramids).method == ElementRotation::small);

  const std::string density =
      "<NodalMassDensity property='1100'/><NodalMassDensity name='other' property='5'/>";
  auto mass = node(fem(density + "<Node name='n'><FEMMass template='Vec3,Hexahedron'/></Node>"));
  CHECK(in<MeshMatrixMass<Vec3d>>(mass, "n").elements == MassElements::hexahedra);
  CHECK(in<MeshMatrixMass<Vec3d>>(mass, "n").massDensity == std::vector<double>{1100});
  auto linked = node(fem("<FEMMass template='Vec3,Edge' nodalMassDensity='@other'/>" + density));
  CHECK(in<MeshMatrixMass<Vec3d>>(linked).massDensity == std::vector<double>{5});

  using Catch::Contains;
  CHECK_THAT(wrong(fem("<FEMMass template='Vec3,Edge'/>")),
             Contains("test.scn:2:") && Contains("finds no NodalMassDensity"));
  CHECK_THAT(wrong(fem("<NodalMassDensity property='1 2'/><FEMMass template='Vec3,Edge'/>")),
             Contains("only one density"));
  CHECK_THAT(wrong(fem("<CorotationalFEMForceField template='Vec3,Quad'/>")),
             Contains("'Quad'; its template names one of Hexahedron, Tetrahedron, Prism, Pyramid"));
  CHECK_THAT(wrong(fem("<LinearSmallStrainFEMForceField/>")), Contains("no kind of elements"));
  CHECK_THAT(wrong(fem("<CorotationalFEMForceField template='Vec3,Hexahedron' rotationMethod='qr'/>")),
             Contains("rotationMethod: 'qr' is not one of triangle, "));
}

TEST_CASE("a grid becomes prisms, and pyramids are listed, with forces and masses of their own") {
  auto scene = node(
      "<EulerImplicitSolver/><CGLinearSolver/><RegularGridTopology name='grid' n='3 2 2' max='2 1 1'/>"
      "<MechanicalObject/><FixedConstraint indices='0 3 6 9'/><Node name='prisms'><MeshTopology name='made'/>"
      "<Hexa2PrismTopologicalMapping input='@grid' output='@made'/><NodalMassDensity property='10'/>"
      "<FEMMass template='Vec3,Prism'/><CorotationalFEMForceField template='Vec3,Prism' "
      "topology='@made'/></Node>");
  CHECK(scene.warnings.empty());
  CHECK(in<MeshTopology>(scene, "prisms").prisms.size() == 4);
  Simulation sim{std::move(scene.root)};
  sim.init();
  auto const& mass = *sim.root().children()[0]->get<MeshMatrixMass<Vec3d>>();
  double total = 0;
  for (std::size_t i = 0; i < 12; ++i) total += mass.lumped.at(i);
  CHECK(total == Approx(20).epsilon(1e-12));
  auto listed = node(
      "<MeshTopology pyramids='0 1 2 3 4' prisms='0 1 2 4 5 6'/>"
      "<MechanicalObject position='0 0 0 1 0 0 1 1 0 0 1 0 0.5 0.5 1 1 0 1 1 1 1'/>");
  CHECK(in<MeshTopology>(listed).pyramids == std::vector<Pyramid>{{0, 1, 2, 3, 4}});
  CHECK(in<MeshTopology>(listed).prisms == std::vector<Prism>{{0, 1, 2, 4, 5, 6}});
  // SOFA's containers of one kind have none
  auto container = node(
      "<MeshTopology name='all' tetrahedra='0 1 2 3' prisms='0 1 2 4 5 6'/><Node name='n'>"
      "<TetrahedronSetTopologyContainer src='@../all'/><MechanicalObject "
      "position='0 0 0 1 0 0 0 1 0 0 0 1 1 0 1 0 1 1 1 1 1'/></Node>"
      "<MechanicalObject position='0 0 0 1 0 0 0 1 0 0 0 1 0 0 2 1 0 2 0 1 2'/>");
  CHECK(in<MeshTopology>(container, "n").tetrahedra.size() == 1);
  CHECK(in<MeshTopology>(container, "n").prisms.empty());
}

TEST_CASE("elements of second order have forces and masses, and are refused by what would leave them out") {
  const std::string points =
                        "<MechanicalObject position='0 0 0  2 0 0  0 2 0  0 0 2  1 0 0  1 1 0  0 1 0  0 0 1  "
                        "1 0 1  0 1 1'/>",
                    ten = "<MeshTopology name='all' quadraticTetrahedra='0 1 2 3 4 5 6 7 8 9'/>";
  auto scene = node("<EulerImplicitSolver/><SparseLDLSolver/>" + ten + points +
                    "<NodalMassDensity property='3'/><FEMMass template='Vec3,QuadraticTetrahedron'/>"
                    "<FixedConstraint indices='0 1 2 4 5 6'/><CorotationalFEMForceField "
                    "template='Vec3,QuadraticTetrahedron' rotationMethod='polar'/>");
  CHECK(scene.warnings.empty());
  CHECK(in<QuadraticTetrahedronFEMForceField<Vec3d>>(scene).method == ElementRotation::polar);
  CHECK(in<MeshMatrixMass<Vec3d>>(scene).elements == MassElements::quadraticTetrahedra);
  Simulation sim{std::move(scene.root)};
  sim.init();
  sim.animate(0.01);
  CHECK(sim.root().get<MechanicalObject<Vec3d>>()->position[3][1] < 0);

  auto container = node(ten + points + "<Node name='n'><TetrahedronSetTopologyContainer src='@../all'/>" +
                        points + "</Node>");
  CHECK(in<MeshTopology>(container, "n").quadraticTetrahedra.size() == 1);
  using Catch::Contains;
  CHECK_THAT(
      wrong((ten + points + "<SubsetTopology template='Vec3d' src='@all'/>")),
      Contains("has quadraticTetrahedra, elements of second order, and this takes those of first order"));
  CHECK_THAT(wrong((ten + points +
                    "<Node name='n'><MeshTopology name='out'/><Tetra2TriangleTopologicalMapping "
                    "input='@../all' output='@out'/></Node>")),
             Contains("has quadraticTetrahedra"));
  CHECK_THAT(wrong(("<MeshTopology quadraticTetrahedra='0 1 2 3 4 5 6 7 8'/>" + points)),
             Contains("quadraticTetrahedra"));
}

TEST_CASE("FEM of tetrahedra has more names, with words and defaults of their own") {
  auto body = [](std::string const& force) {
    return node(
        "<TetrahedronTopology tetrahedra='0 1 2 3'/>"
        "<MechanicalObject position='0 0 0 1 0 0 0 1 0 0 0 1'/>" +
        force);
  };
  auto method = [&](std::string const& attribute) {
    auto scene = body("<FastTetrahedralCorotationalForceField " + attribute + "/>");
    return in<TetrahedronFEMForceField<Vec3d>>(scene).method;
  };
  CHECK(method("") == RotationMethod::large);
  CHECK(method("method='qr'") == RotationMethod::large);
  CHECK(method("method='large'") == RotationMethod::large);
  CHECK(method("method='polar'") == RotationMethod::nearest);
  CHECK(method("method='polar2'") == RotationMethod::polar);
  for (std::string const word : {"none", "linear", "small"})
    CHECK(method("method='" + word + "'") == RotationMethod::small);
  auto mass = body("<TetrahedralTensorMassForceField youngModulus='7'/>");
  auto const& fem = in<TetrahedronFEMForceField<Vec3d>>(mass);
  CHECK(fem.method == RotationMethod::small);
  CHECK(fem.youngModulus == std::vector<double>{7});
  CHECK(fem.poissonRatio == 0.3);
}

TEST_CASE("what shaders read and what is only looked at is left out") {
  auto scene = node(
      "<MechanicalObject position='0 0 0'/><OglFloatVariable id='a' value='1'/><OglInt4Attribute id='b' "
      "value='1 2 3 4'/>"
      "<VisualMesh position='@../x.position'/><VisualPointCloud/><OglTexture textureFilename='none.png'/>"
      "<GlobalSystemMatrixImage linearSystem='@s'/><RotationMatrixSystem assemblingRate='15'/>");
  CHECK(in<MechanicalObject<Vec3d>>(scene).position.size() == 1);
}

TEST_CASE(
    "positions of a state are whole points, frames where points are linked, and centers where frames are") {
  auto few = node("<MechanicalObject position='0 1 2 3 4 5 6'/>");
  CHECK(in<MechanicalObject<Vec3d>>(few).position == Vec3d::VecCoord{{0, 1, 2}, {3, 4, 5}});
  CHECK(has(few.warnings,
            "test.scn:2:19: <MechanicalObject>: position: goes on with 1 of the 3 numbers of a point"));
  auto zero = node("<MechanicalObject template='Rigid3' position='5 0 0 0 0 0 0 1'/>");
  REQUIRE(in<MechanicalObject<Rigid3d>>(zero).position.size() == 1);
  CHECK(in<MechanicalObject<Rigid3d>>(zero).position[0].orientation.w() == 1);
  CHECK(has(zero.warnings, "position: goes on with 1 of the 7"));
  CHECK(has(zero.warnings, "the orientation of point 0 is zero"));
  CHECK_THAT(wrong("<MechanicalObject position='0 1'/>"), Catch::Contains("ends where a number is expected"));

  for (std::string const from : {"position='@g.position'", "src='@g'"}) {
    auto frames =
        node("<RegularGridTopology name='g' n='2 1 1' max='3 0 0'/><MechanicalObject template='Rigid3' " +
             from + "/>");
    auto const& x = in<MechanicalObject<Rigid3d>>(frames).position;
    REQUIRE(x.size() == 2);
    CHECK(x[1].center == Eigen::Vector3d(3, 0, 0));
    CHECK(x[1].orientation.w() == 1);
  }
  auto same = node(
      "<MechanicalObject name='a' template='Rigid3' position='1 2 3 0 0 1 0'/>"
      "<Node name='n'><MechanicalObject template='Rigid3' position='@../a.position'/></Node>");
  CHECK(in<MechanicalObject<Rigid3d>>(same, "n").position[0].orientation.z() == 1);
  auto centers = node(
      "<MechanicalObject name='a' template='Rigid3' position='1 2 3 0 0 0 1  4 5 6 0 0 1 0'/>"
      "<Node name='n'><MeshTopology position='@../a.position' edges='0 1'/><MechanicalObject/></Node>");
  CHECK(in<MeshTopology>(centers, "n").position == Vec3d::VecCoord{{1, 2, 3}, {4, 5, 6}});
}

TEST_CASE("springs are held by a state that does not move") {
  const std::string held =
      "<Node name='n'><EulerExplicitSolver/><MechanicalObject position='0 0 0'/><UniformMass/>"
      "<RestShapeSpringsForceField external_rest_shape='@../there'/></Node>";
  auto scene = node("<MechanicalObject name='there' position='1 2 3'/>" + held);
  CHECK(in<RestShapeSpringsForceField<Vec3d>>(scene, "n").externalRestShape == Vec3d::VecCoord{{1, 2, 3}});
  CHECK_THAT(wrong("<EulerExplicitSolver/><MechanicalObject name='there' position='1 2 3'/>" + held),
             Catch::Contains("external_rest_shape: '@../there' moves"));
}

TEST_CASE("a load whose elements are chosen by a link to none is on none, which is said") {
  const std::string sheet = "<RegularGridTopology n='3 3 1' max='1 1 0'/><MechanicalObject/>";
  auto empty = node(sheet +
                    "<BoxROI name='roi' box='5 5 5 6 6 6'/>"
                    "<TrianglePressureForceField pressure='1 0 0' triangleList='@roi.triangleIndices'/>");
  CHECK(in<TrianglePressureForceField<Vec3d>>(empty).none);
  CHECK(has(empty.warnings, "triangleList: names no element; no element bears the load"));
  CHECK(has(empty.warnings, "by its number, as in SOFA"));
  auto volume = node(
      "<MeshTopology position='0 0 0 1 0 0 0 1 0 0 0 1' tetrahedra='0 1 2 3' createTriangleArray='1'/>"
      "<MechanicalObject/><BoxROI name='roi' box='-1 -1 -1 2 2 2'/>"
      "<TrianglePressureForceField pressure='1 0 0' triangleList='@roi.triangleIndices'/>");
  CHECK(has(volume.warnings, "by its number, while in SOFA those may that createTriangleArray makes"));
  auto nowhere =
      node(sheet + "<TrianglePressureForceField pressure='1 0 0' triangleList='@rol.triangleIndices'/>");
  CHECK(in<TrianglePressureForceField<Vec3d>>(nowhere).none);
  CHECK(has(nowhere.warnings, "triangleList: '@rol.triangleIndices' leads nowhere"));
  auto unselected = node(sheet + "<TrianglePressureForceField pressure='1 0 0'/>");
  CHECK_FALSE(in<TrianglePressureForceField<Vec3d>>(unselected).none);
  CHECK_THAT(wrong(sheet + "<FixedConstraint indices='@rol.indices'/>"), Catch::Contains("leads nowhere"));
}

TEST_CASE("a link to nowhere is as none where the surroundings have the value, which is said") {
  const std::string sheet = "<RegularGridTopology n='3 3 1' max='1 1 0'/><MechanicalObject/>";
  auto chosen = node(sheet + "<BoxROI name='roi' position='@../Volume.position' box='-1 -1 -1 0.1 2 1'/>" +
                     "<FixedConstraint indices='@roi.indices'/>");
  CHECK(in<FixedConstraint<Vec3d>>(chosen).indices == std::vector<int>{0, 3, 6});
  CHECK(has(chosen.warnings,
            "<BoxROI>: position: the points of its node are taken, where SOFA's would choose none: "
            "'@../Volume.position' leads nowhere"));
  auto child = node(sheet +
                    "<Node name='n'><MechanicalObject rest_position='@../gone.rest_position'/>"
                    "<IdentityMapping/></Node>");
  CHECK(in<MechanicalObject<Vec3d>>(child, "n").restPosition.empty());
  CHECK(has(child.warnings, "rest_position: its points are at rest where the mapping has them then"));
  CHECK_THAT(wrong("<MechanicalObject position='0 0 0' rest_position='@gone.position'/>"),
             Catch::Contains("leads nowhere"));
}

TEST_CASE("an attribute with an underscore in front is switched off, which is said") {
  auto scene = node("<EulerImplicitSolver _rayleighMass='3'/><CGLinearSolver/>");
  CHECK(in<EulerImplicitSolver>(scene).rayleighMass == EulerImplicitSolver{}.rayleighMass);
  CHECK(has(scene.warnings, "_rayleighMass has no effect, as in SOFA"));
}

TEST_CASE("a state that is told how it rests starts so") {
  auto scene = node("<MechanicalObject rest_position='1 2 3  4 5 6'/>");
  CHECK(in<MechanicalObject<Vec3d>>(scene).position == Vec3d::VecCoord{{1, 2, 3}, {4, 5, 6}});
  auto carried = node(
      "<MechanicalObject template='Rigid3' position='1 0 0 0 0 0 1  2 0 0 0 0 0 1'/><Node name='n'>"
      "<MechanicalObject template='Rigid3' rest_position='0 1 0 0 0 0 1  0 2 0 0 0 0 1  0 3 0 0 0 0 1'/>"
      "<RigidMapping rigidIndexPerPoint='1 1'/></Node>");
  CHECK(has(carried.warnings, "rigidIndexPerPoint has 2 entries for 3 points; body 0 carries all of them"));
  CHECK(in<MechanicalObject<Rigid3d>>(carried, "n").position.size() == 3);
}

TEST_CASE("a collision model over as many points as the topology above has its elements") {
  const std::string grid =
      "<RegularGridTopology name='grid' n='3 3 1' max='1 1 0'/><MechanicalObject name='body'/>";
  const std::string models = "<TriangleCollisionModel/><LineCollisionModel/></Node>";
  for (std::string const state :
       {"<MechanicalObject position='@../body.position'/>", "<MechanicalObject/><IdentityMapping/>"}) {
    auto scene = node(grid + "<Node name='n'>" + state + models);
    Simulation sim{std::move(scene.root)};
    sim.init();
    auto const& n = *sim.root().children()[0];
    CHECK(n.get<TriangleCollisionModel<Vec3d>>()->surface.elements.size() == 8);
    CHECK(n.get<LineCollisionModel<Vec3d>>()->surface.elements.size() == 12 + 4);
    CHECK(n.get<MeshTopology>()->quads.size() == 4);
  }
  auto fewer = node(grid + "<Node name='n'><MechanicalObject position='0 0 0'/>" + models);
  CHECK(fewer.root.find_node("n")->get<MeshTopology>() == nullptr);
}

TEST_CASE("what collides in another way than in SOFA is there, and a warning says what differs") {
  const std::string
      pipeline = "<DefaultPipeline/><BruteForceBroadPhase/><DefaultContactManager/>",
      model =
          "<MeshTopology tetrahedra='0 1 2 3'/><MechanicalObject position='0 0 0 1 0 0 0 1 0 0 0 1'/>"
          "<TetrahedronModel/>";
  auto scene = node(pipeline + "<RayTraceNarrowPhase/><MinProximityIntersection/>" + model);
  CHECK(has(scene.warnings, "keeps points and spheres out of its inside"));
  CHECK(in<TetrahedronCollisionModel<Vec3d>>(scene).active);
  CHECK_THAT(wrong(pipeline + "<RayTraceDetection/>"),
             Catch::Contains("take BruteForceBroadPhase and RayTraceNarrowPhase"));
}

TEST_CASE("what has no effect on a picture, or on a response that is named, is taken") {
  auto scene = node(
      "<MechanicalObject position='0 0 0'/><DefaultPipeline/><DefaultContactManager "
      "response='PenalityContactForceField' responseParams='mu=0.5'/>"
      "<Node name='n'><OglModel/><IdentityMapping mapForces='0' mapMasses='0'/></Node>");
  CHECK(scene.warnings.empty());
  const std::string mapped =
      "<MechanicalObject position='0 0 0'/><Node name='n'><MechanicalObject name='child'/><IdentityMapping ";
  CHECK(node(mapped + "mapForces='0' mapMasses='0' mapConstraints='0'/></Node>").warnings.empty());
  for (std::string const below :
       {"<UniformMass/></Node>",
        "<Node name='m'><ConstantForceField indices='0' force='0 1 0'/></Node></Node>",
        "</Node><Node name='j'><MechanicalObject/><SubsetMultiMapping input='@/n' indexPairs='0 0'/></Node>"})
    CHECK_THAT(wrong(mapped + "mapForces='0'/>" + below), Catch::Contains("mapForces is not simulated"));
  CHECK_THAT(wrong(mapped + "mapMasses='0'/><UniformMass/></Node>"),
             Catch::Contains("mapMasses is not simulated"));
  CHECK(node(mapped + "mapMasses='0'/><ConstantForceField indices='0' force='0 1 0'/></Node>")
            .warnings.empty());
}

TEST_CASE("what old scenes say beside is ignored") {
  auto scene = parse(R"(<Node multiThreadSimulation="1" currentLevel="0" coarsestLevel="3" finestLevel="0">
    <CollisionGroupManager/> <NaturalOrderingMethod/> <MatrixLinearSystem/>
    <EulerImplicitSolver computeResidual="1"/> <EigenSimplicialLDLT ordering="Natural" iterations="25"
      tolerance="1e-9" threshold="1e-9"/>
    <MechanicalObject position="0 0 0 1 1 1" free_position="0 0 0" free_velocity="0 0 0" dx="0 0 0 0 0 0"/>
    <BoxROI box="-1 -1 -1 2 2 2" indices="0"/>
    <BoxConstraint box="0.5 0.5 0.5 2 2 2" fixAll="0"/>
  </Node>)");
  CHECK(in<FixedConstraint<Vec3d>>(scene).indices == std::vector<int>{1});
  CHECK(in<MechanicalObject<Vec3d>>(scene).position[1] == Eigen::Vector3d(1, 1, 1));
  CHECK(scene.warnings.size() == 1);  // collision is not simulated
  CHECK(in<MechanicalObject<Vec3d>>(scene).translation == Eigen::Vector3d(0, 0, 0));
}

}  // namespace test_dialect
