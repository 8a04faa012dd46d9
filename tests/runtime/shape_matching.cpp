// SPDX-License-Identifier: BSL-1.0
// Matching of shapes in scene files: a constraint takes what an engine was given, and does it in each step.
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/engines.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/runtime/precompiled.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>
#include <sinew/runtime/save_scene.hpp>

namespace test_shape_matching {

using namespace sinew;

namespace {

using Pbd = PositionBasedDynamicsProjectiveConstraint<Vec3d>;
using Mine = Standard;

std::string scene(std::string const& engines, std::string const& constraint) {
  return "<Node dt='0.05' gravity='0 -1 0'><EulerImplicitSolver/><CGLinearSolver iterations='25' "
         "tolerance='1e-12'/>"
         "<MeshTopology name='topo' position='0 0 0  1 0 0  0 1 0  0 0 1  1 1 1' tetrahedra='0 1 2 3  1 2 3 "
         "4'/>"
         "<MechanicalObject name='dofs' src='@topo' dz='10'/><UniformMass vertexMass='3'/>" +
         engines + constraint + "</Node>";
}
const std::string clustering =
                      "<ClusteringEngine template='Vec3' name='clustering' radius='1.2' number='2' "
                      "position='@topo.position'/>",
                  matching =
                      "<ShapeMatching template='Vec3' name='shapeMatching' iterations='2' affineRatio='0.1' "
                      "position='@dofs.position' cluster='@clustering.cluster'/>",
                  constraint =
                      "<PositionBasedDynamicsProjectiveConstraint template='Vec3' stiffness='0.8' "
                      "position='@shapeMatching.targetPosition'/>";

ReadScene<Mine> read(std::string const& text) { return parse_scene<Mine>("test.scn", text); }

}  // namespace

TEST_CASE("the constraint of a scene of SOFA takes the clusters and the settings of its ShapeMatching") {
  auto file = read(scene(clustering + matching, constraint));
  for (auto const& warning : file.warnings) FAIL(warning);
  auto const& pbd = *file.root.get<Pbd>();
  CHECK(pbd.stiffness == 0.8);
  CHECK(pbd.iterations == 2);
  CHECK(pbd.affineRatio == 0.1);
  CHECK(pbd.position.empty());
  CHECK(pbd.cluster == file.root.get<ClusteringEngine<Vec3d>>()->cluster);
  CHECK(pbd.cluster.size() == 2);
  CHECK(file.root.get<ShapeMatching<Vec3d>>()->rest_position[0][2] == 10);

  // it falls as a whole, at the velocity of a free body, and turns as one
  Simulation sim{std::move(file.root)};
  sim.init();
  auto& state = *sim.root().get<MechanicalObject<Vec3d>>();
  const auto rest = state.position;
  for (std::size_t i = 0; i < rest.size(); ++i)
    state.velocity[i] = Eigen::Vector3d(0, 0, 0.3).cross(rest[i]) + Eigen::Vector3d(1, 0, 0);
  Eigen::Vector3d before(0, 0, 0), after(0, 0, 0);
  for (auto const& v : state.velocity) before += v;
  for (int i = 0; i < 40; ++i) sim.animate(0.05);
  for (auto const& v : state.velocity) after += v;
  CHECK((after - before - Eigen::Vector3d(0, -2 * 5, 0)).norm() < 1e-9);
  for (std::size_t i = 0; i < rest.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      CHECK((state.position[i] - state.position[j]).norm() ==
            Approx((rest[i] - rest[j]).norm()).epsilon(0.02));
  CHECK((state.position[1] - state.position[0]).normalized().dot((rest[1] - rest[0]).normalized()) < 0.9);

  // saved in between and read again it goes on the same way
  Simulation again{std::move(read(scene_text(sim, 0.05)).root)};
  again.init();
  sim.animate(0.05), again.animate(0.05);
  auto const& other = *again.root().get<MechanicalObject<Vec3d>>();
  for (std::size_t i = 0; i < rest.size(); ++i) CHECK((other.position[i] - state.position[i]).norm() < 1e-12);
}

TEST_CASE("what is given to the constraint goes before what its ShapeMatching has") {
  auto file =
      read(scene(clustering + matching,
                 "<PositionBasedDynamicsProjectiveConstraint position='@shapeMatching.targetPosition' "
                 "iterations='7' cluster='[0 1 2 3 4]'/>"));
  CHECK(file.root.get<Pbd>()->iterations == 7);
  CHECK(file.root.get<Pbd>()->affineRatio == 0.1);
  // goals may be given, too
  auto fixed = read(scene("", "<PositionBasedDynamicsProjectiveConstraint position='@topo.position'/>"));
  CHECK(fixed.root.get<Pbd>()->position.size() == 5);
}

TEST_CASE("a state that no constraint moves has the shape that is matched, where its points are") {
  auto file = read(
      "<Node dt='0.05' gravity='0 -1 0'><Node name='body'><EulerImplicitSolver/><CGLinearSolver "
      "iterations='25' "
      "tolerance='1e-12'/><MechanicalObject name='dofs' position='0 0 0  1 0 0  0 1 0  0 0 1' velocity='0.1 "
      "0 0  "
      "0 0.2 0  0 0 0.3  0.2 0.1 0'/><UniformMass vertexMass='3'/><ShapeMatching name='matching' "
      "position='@dofs.position' cluster='[0 1 2 3]'/></Node>"
      "<Node name='unbent'><MechanicalObject position='@../body/matching.targetPosition'/></Node></Node>");
  for (auto const& warning : file.warnings) FAIL(warning);
  Simulation sim{std::move(file.root)};
  sim.init();
  auto positions = [&](std::string_view node) -> auto const& {
    return sim.root().find_node(node)->get<MechanicalObject<Vec3d>>()->position;
  };
  const auto rest = positions("body");
  for (int step = 0; step < 20; ++step) {
    sim.animate(0.05);
    auto const &x = positions("body"), &goal = positions("unbent");
    REQUIRE(goal.size() == 4);
    Eigen::Vector3d offset(0, 0, 0);
    for (std::size_t i = 0; i < 4; ++i) {
      offset += goal[i] - x[i];
      for (std::size_t j = 0; j < i; ++j)
        CHECK((goal[i] - goal[j]).norm() == Approx((rest[i] - rest[j]).norm()).epsilon(1e-12));
    }
    CHECK(offset.norm() < 1e-12);
    CHECK((x[0] - goal[0]).norm() > 1e-3 * (step + 1));
  }
}

TEST_CASE("what is wrong with clusters in a scene is told") {
  auto says = [](std::string const& text, std::string_view part) {
    const std::string said = error_of([&] {
      Simulation sim{std::move(read(text).root)};
      sim.init();
    });
    INFO(said);
    CHECK(said.find(part) != std::string::npos);
  };
  says(scene(matching, constraint), "@clustering.cluster");
  says(scene(clustering, constraint), "@shapeMatching.targetPosition");
  says(scene(clustering + matching, "<PositionBasedDynamicsProjectiveConstraint/>"), "it has no goals");
  says(scene(clustering + matching, "<PositionBasedDynamicsProjectiveConstraint position='0 0 0'/>"),
       "position has 1 entries for 5 points");
  says(scene("<ClusteringEngine number='0'/>", ""), "number is 0");
  says(scene("<ClusteringEngine inFile='none.txt'/>", ""), "none.txt");
  says(scene("<ClusteringEngine outFile='x.txt'/>", ""), "outFile is not simulated");
}

}  // namespace test_shape_matching
