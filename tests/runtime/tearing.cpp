// SPDX-License-Identifier: BSL-1.0
// Scene files in which bodies tear.
#include "catch.hpp"
#include "topology/cut_bodies.hpp"

#include <sinew/engines.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>
#include <sinew/runtime/save_scene.hpp>

namespace test_tearing_scenes {

using namespace sinew;

namespace {

struct Few : Registry<Gravity, GridMeshCreator, TransformEngine<Vec3d>, BoxROI<Vec3d>, MeshTopology,
                      EulerImplicitSolver, CGLinearSolver<>, MechanicalObject<Vec3d>, DiagonalMass<Vec3d>,
                      TriangleFEMForceField<Vec3d>, TetrahedronFEMForceField<Vec3d>, FixedConstraint<Vec3d>,
                      LinearMovementConstraint<Vec3d>, TopologicalChangeProcessor, TearingEngine<Vec3d>,
                      VisualModel, IdentityMapping<Vec3d, Vec3f>> {};
using Sim = Simulation<RuntimeNode<Few>>;

}  // namespace

TEST_CASE("a sheet with a notch tears from it, across the pull, into two", "[long]") {
  auto read = read_scene<Few>(std::string(SINEW_EXAMPLE_SCENES) + "/tear.scn");
  CHECK(read.warnings.empty());
  const double dt = read.dt;
  Sim sim(std::move(read.root));
  sim.init();
  auto sheet = [&]() -> auto& { return *sim.root().find_node("sheet"); };  // a tear makes another scene
  auto state = [&]() -> auto const& { return *sheet().get<MechanicalObject<Vec3d>>(); };
  auto engine = [&]() -> auto const& { return *sheet().get<TearingEngine<Vec3d>>(); };
  sim.animate(dt);  // the notch
  const std::size_t points = state().size();
  CHECK(points > 21 * 31);
  int pieces = 1;
  double first = 0;
  while (sim.time() < 2) {
    sim.animate(dt);
    if (first == 0 && engine().fractures > 0) {
      first = sim.time();
      // beside the end of the notch
      for (std::size_t i = points; i < state().size(); ++i)
        CHECK((state().restPosition[i] - Eigen::Vector3d(0.015, 0.0533, 0)).norm() < 0.01);
    }
  }
  CHECK(first > 0.2);
  CHECK(first < 1.2);
  for (std::size_t i = points; i < state().size(); ++i)
    CHECK(std::abs(state().restPosition[i][1] - 0.0533) < 0.02);
  pieces = cutting::pieces(state().size(), sheet().get<MeshTopology>()->triangles);
  CHECK(pieces >= 2);
  CHECK(engine().fractures > 2);

  // saved, it goes on
  auto again = parse_scene<Few>("again.scn", scene_text(sim, dt));
  Sim other(std::move(again.root));
  other.init(again.time, again.step);
  CHECK(other.root().find_node("sheet")->get<TearingEngine<Vec3d>>()->fractures == engine().fractures);
  CHECK(other.root().find_node("sheet")->get<MechanicalObject<Vec3d>>()->size() == state().size());
  other.animate(dt);
}

TEST_CASE("attributes of SOFA's plugin are known, and what leads nowhere is said") {
  auto scene = [](std::string const& engine) {
    return parse_scene<Few>("tear.scn",
                            R"(<Node gravity="0 0 0"><EulerImplicitSolver/><CGLinearSolver/>
      <TriangleSetTopologyContainer name="Container" position="0 0 0 1 0 0 1 1 0 0 1 0" triangles="0 1 2 0 2 3"/>
      <TriangleSetTopologyModifier/><TriangleSetGeometryAlgorithms template="Vec3d"/>
      <MechanicalObject name="Mo"/><DiagonalMass massDensity="2"/>
      <TriangularFEMForceField youngModulus="300" poissonRatio="0.3" method="large" computePrincipalStress="1"/>)" +
                                engine + "</Node>");
  };
  auto read = scene(R"(<TearingEngine name="TearingEngine" input_position="@Mo.position" topology="@Container"
      computeVertexStressMethod="WeightedAverageArea" stressThreshold="6.0" step="30" nbFractureMax="40"
      ignoreTriangleAtStart="0" showFracturePath="1" showTearableCandidates="1" fractureMaxLength="1.0"/>)");
  CHECK(read.warnings.empty());
  Sim sim(std::move(read.root));
  sim.init();
  auto const& engine = *sim.root().get<TearingEngine<Vec3d>>();
  CHECK(engine.computeVertexStressMethod == PointStress::WeightedAverageArea);
  CHECK(engine.step == 30);
  CHECK(!engine.ignoreTriangles);
  for (char const* bad : {"stressThreshold='-1'",
                          "stressThreshold='nan'",
                          "step='a'",
                          "trianglesToIgnore='-1'",
                          "computeVertexStressMethod='Best'",
                          "fractureMaxLength='inf'"})
    CHECK_THROWS_AS(scene(std::string("<TearingEngine ") + bad + "/>"), SceneError);
}

}  // namespace test_tearing_scenes
