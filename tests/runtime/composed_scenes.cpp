// SPDX-License-Identifier: BSL-1.0
// Words of SOFA's scenes that stand for other components, or for what other components have said.
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/engines.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/runtime/precompiled.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>
#include <sinew/runtime/save_scene.hpp>
#include <sinew/visual/visual_model.hpp>

#include "io/files.hpp"

namespace test_composed_scenes {

using namespace sinew;

namespace {

using Mine = Standard;

ReadScene<Mine> read(std::string const& inside) {
  return parse_scene<Mine>("test.scn", "<Node gravity='0 0 -10'>" + inside + "</Node>");
}
bool said(std::vector<std::string> const& all, std::string_view part) {
  for (auto const& one : all)
    if (one.find(part) != one.npos) return true;
  return false;
}

}  // namespace

TEST_CASE("a force with a mass is a force and a mass of the same hexahedra") {
  auto scene = read(
      "<EulerImplicitSolver/><CGLinearSolver/><RegularGridTopology n='3 2 2' max='2 1 1'/><MechanicalObject/>"
      "<HexahedronFEMForceFieldAndMass name='F' youngModulus='300' poissonRatio='0.2' density='3' "
      "lumpedMass='1'/>");
  auto const& force = *scene.root.get<HexahedronFEMForceField<Vec3d>>();
  auto const& mass = *scene.root.get<MeshMatrixMass<Vec3d>>();
  CHECK(force.youngModulus == std::vector<double>{300});
  CHECK(force.poissonRatio == 0.2);
  CHECK(mass.massDensity == std::vector<double>{3});
  CHECK(mass.lumping);
  CHECK(mass.fillWeighted);
  CHECK(mass.elements == MassElements::hexahedra);
  scene = read(
      "<EulerImplicitSolver/><CGLinearSolver/><RegularGridTopology n='3 2 2' max='2 1 1'/><MechanicalObject/>"
      "<HexahedralFEMForceFieldAndMass/>");
  CHECK(scene.root.get<MeshMatrixMass<Vec3d>>()->massDensity == std::vector<double>{1});
  CHECK(!scene.root.get<MeshMatrixMass<Vec3d>>()->fillWeighted);
  Simulation sim{std::move(scene.root)};
  sim.init();
  sim.animate(0.1);  // falls as a whole
  for (auto const& v : sim.root().get<MechanicalObject<Vec3d>>()->velocity)
    CHECK(v[2] == Approx(-1).epsilon(1e-3));
}

TEST_CASE("hexahedra of finer cells are a force and a mass, and say to a mapping what it shows") {
  const std::string grid =
      "<EulerImplicitSolver/><CGLinearSolver iterations='500' tolerance='1e-12' threshold='0'/>"
      "<SparseGridTopology n='3 3 3' nbVirtualFinerLevels='1' "
      "position='0 0 0 1 0 0 0 1 0 0 0 1' triangles='0 2 1 0 1 3 1 2 3 2 0 3'/><MechanicalObject/>";
  const std::string points =
      "<Node name='points'><MechanicalObject position='0.1 0.2 0.3'/><HexahedronCompositeFEMMapping "
      "finestToCoarse='0'/></Node>";
  auto scene = read(grid +
                    "<HexahedronCompositeFEMForceFieldAndMass name='F' youngModulus='300' poissonRatio='0.2' "
                    "density='3' lumpedMass='1' nbVirtualFinerLevels='1' method='polar' drawType='0' "
                    "useRamification='1' homogenizationMethod='0' completeInterpolation='1' "
                    "finestToCoarse='1'/>" +
                    points);
  using Force = HexahedronCompositeFEMForceField<Vec3d>;
  using Mass = HexahedronCompositeFEMMass<Vec3d>;
  using Mapping = HexahedronCompositeFEMMapping<Vec3d, Vec3d>;
  {
    auto const& force = *scene.root.get<Force>();
    auto const& mass = *scene.root.get<Mass>();
    auto const& mapping = *scene.root.children()[0]->get<Mapping>();
    CHECK(force.youngModulus == std::vector<double>{300});
    CHECK(force.method == HexahedronMethod::polar);
    CHECK(mass.massDensity == 3);
    CHECK(mass.lumping);
    CHECK(mapping.method == HexahedronMethod::polar);
    CHECK(mapping.completeInterpolation);
    CHECK(force.finestToCoarse);
    CHECK(mass.finestToCoarse);
    CHECK(!mapping.finestToCoarse);  // it says so itself
    for (double const nu : {force.poissonRatio, mass.poissonRatio, mapping.poissonRatio}) CHECK(nu == 0.2);
    for (auto const levels :
         {force.nbVirtualFinerLevels, mass.nbVirtualFinerLevels, mapping.nbVirtualFinerLevels})
      CHECK(levels == 1);
    for (auto const way : {force.interpolation, mass.interpolation, mapping.interpolation})
      CHECK(way == CellInterpolation::condensed);
  }
  Simulation sim{std::move(scene.root)};
  sim.init();
  sim.animate(0.1);  // falls as a whole
  for (auto const& v : sim.root().children()[0]->get<MechanicalObject<Vec3d>>()->velocity)
    CHECK(v[2] == Approx(-1).epsilon(1e-3));

  scene = read(grid + "<NonUniformHexahedronFEMForceFieldAndMass useMass='false' totalMass='2'/>");
  CHECK(scene.root.get<Force>()->interpolation == CellInterpolation::trilinear);
  CHECK(scene.root.get<Force>()->nbVirtualFinerLevels == 0);  // as in SOFA
  CHECK(!scene.root.get<Mass>());
  CHECK(scene.root.get<UniformMass<Vec3d>>()->totalMass == 2);

  auto refused = [&](std::string const& attributes) {
    return error_of([&] { read(grid + "<HexahedronCompositeFEMForceFieldAndMass " + attributes + "/>"); });
  };
  CHECK_THAT(refused("useMass='0'"), Catch::Contains("there is no totalMass"));
  CHECK_THAT(refused("useRamification='0'"), Catch::Contains("useRamification is not simulated"));
}

TEST_CASE("where bodies are named for another number of points, the first one carries all") {
  auto scene = read(
      "<MechanicalObject template='Rigid3d' position='1 0 0 0 0 0 1  2 0 0 0 0 0 1'/><Node name='points'>"
      "<MechanicalObject position='0 1 0  0 2 0  0 3 0'/><RigidMapping rigidIndexPerPoint='0 1'/></Node>");
  CHECK(said(scene.warnings, "rigidIndexPerPoint has 2 entries for 3 points; body 0 carries all of them"));
  Simulation sim{std::move(scene.root)};
  sim.init();
  for (auto const& x : sim.root().children()[0]->get<MechanicalObject<Vec3d>>()->position) CHECK(x[0] == 1);
  scene = read(
      "<MechanicalObject template='Rigid3d' position='1 0 0 0 0 0 1  2 0 0 0 0 0 1'/><Node name='points'>"
      "<MechanicalObject/><RigidMapping rigidIndexPerPoint='0 1' initialPoints='0 1 0  0 2 0'/></Node>");
  CHECK(scene.warnings.empty());
  Simulation other{std::move(scene.root)};
  other.init();
  auto const& x = other.root().children()[0]->get<MechanicalObject<Vec3d>>()->position;
  REQUIRE(x.size() == 2);
  CHECK(x[1] == Eigen::Vector3d(2, 2, 0));
}

TEST_CASE("what is mapped onto colours is left out with them") {
  const std::string picture =
      "<MechanicalObject position='0 0 0'/><Node name='data'><DataDisplay "
      "name='d'/><IdentityMapping/></Node>";
  CHECK(said(read(picture).ignored, "IdentityMapping onto DataDisplay"));
  const std::string message = error_of(
      [] { read("<MechanicalObject position='0 0 0'/><Node name='data'><IdentityMapping/></Node>"); });
  CHECK(message.find("has no child") != message.npos);
}

TEST_CASE("a list of files is found and kept, each by its own name") {
  const files::TempFolder folder;
  std::string cube = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  const std::string a = folder.write("a.obj", cube), b = folder.write("b.obj", cube);
  auto scene = read("<SparseGridMultipleTopology n='3 3 3' finestConnectivity='0' fileTopologies='" + a +
                    " " + b + "' stiffnessCoefs='1 2'/><MechanicalObject/>");
  auto const& grid = *scene.root.get<SparseGridMultipleTopology>();
  CHECK(grid.fileTopologies == std::vector<DataFile>{{a}, {b}});
  Simulation sim{std::move(scene.root)};
  sim.init();
  const std::string words = scene_text(sim, 0.01);
  CHECK(words.find("fileTopologies=\"" + a + " " + b + "\"") != words.npos);
  const std::string message =
      error_of([&] { read("<SparseGridMultipleTopology fileTopologies='" + a + " none.obj'/>"); });
  CHECK(message.find("there is no file 'none.obj'") != message.npos);
}

}  // namespace test_composed_scenes
