// SPDX-License-Identifier: BSL-1.0
// Joints of articulated bodies as SOFA's scene files have them, in nodes of their own.
#include "same_bits.hpp"

#include <sinew/runtime/save_scene.hpp>

#include <string>
#include <vector>

namespace test_articulations {

using namespace sinew;
using Catch::Matchers::Contains;

namespace {

// an arm of two links on a base; what stands in braces is changed by tests
const std::string arm = R"(
<Node name="root" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <SparseLDLSolver template="CompressedRowSparseMatrixd"/>
  <Node name="base">
    <MechanicalObject name="dofs" template="Rigid3" position="0 1 0  0 0 0 1"/>
    <UniformMass vertexMass="1"/>
  </Node>
  <Node name="arm">
    <MechanicalObject name="angles" template="Vec1" position="0.3 0.2"/>
    <Node name="links">
      <MechanicalObject name="bodies" template="Rigid3"/>
      <UniformMass vertexMass="0.5"/>
      <ArticulatedSystemMapping input1="@../angles" input2="@../../base/dofs" output="@bodies" geometricStiffness="symmetrized"/>
    </Node>
    <ArticulatedHierarchyContainer name="joints"/>
    <Node name="centers">
      <Node name="first">
        <ArticulationCenter parentIndex="0" childIndex="1" posOnParent="0 -0.5 0" posOnChild="0 0.5 0" articulationProcess="2"/>
        <Node name="articulations">
          <Articulation rotation="1" translation="0" rotationAxis="0 0 1" articulationIndex="0"/>
        </Node>
      </Node>
      <Node name="second">
        <ArticulationCenter parentIndex="1" childIndex="2" posOnParent="0 -0.5 0" posOnChild="0 0.5 0"/>
        <Node name="articulations">
          <Articulation rotation="true" axis="0 0 1" articulationIndex="1"/>
        </Node>
      </Node>
    </Node>
  </Node>
</Node>)";

std::string with(std::string_view from, std::string_view to) {
  std::string text = arm;
  const std::size_t at = text.find(from);
  REQUIRE(at != text.npos);
  return text.replace(at, from.size(), to);
}
std::string error(std::string const& text) {
  try {
    auto sim = start(parse_scene<Standard>("arm.scn", text));
  } catch (Error const& e) {
    return e.what();
  }
  return "";
}
std::vector<Eigen::Vector3d> places(Simulation<RuntimeNode<Standard>>& sim) {
  std::vector<Eigen::Vector3d> all;
  sim.visit<role::State>([&](auto const& s, auto const&) {
    using D = typename std::decay_t<decltype(s)>::DataTypes;
    if constexpr (D::rigid && D::spatial == 3)
      for (auto const& x : s.position) all.push_back(x.center.template cast<double>());
  });
  return all;
}

}  // namespace

TEST_CASE("articulated bodies run from files, with and without matrix, and are saved") {
  auto assembled = start(parse_scene<Standard>("arm.scn", arm));
  const auto first = places(assembled);
  REQUIRE(first.size() == 4);
  CHECK((first[2] - (Eigen::Vector3d(0, 0.5, 0) + 0.5 * Eigen::Vector3d(std::sin(0.3), -std::cos(0.3), 0)))
            .norm() < 1e-14);
  auto iterated =
      start(parse_scene<Standard>("arm.scn",
                                  with("<SparseLDLSolver template=\"CompressedRowSparseMatrixd\"/>",
                                       "<CGLinearSolver iterations='200' tolerance='1e-14'/>")));
  const std::string saved = scene_text(assembled, 0.01);
  CHECK(saved.find("Articulation ") == std::string::npos);
  CHECK(saved.find("centers") != std::string::npos);
  auto again = start(parse_scene<Standard>("saved.scn", saved));
  for (int i = 0; i < 20; ++i)
    for (auto* sim : {&assembled, &iterated, &again}) sim->animate(0.01);
  const auto end = places(assembled), other = places(iterated), same = places(again);
  REQUIRE(same.size() == end.size());
  for (std::size_t i = 0; i < end.size(); ++i) {
    CHECK((end[i] - first[i]).norm() > 1e-3);
    CHECK((end[i] - other[i]).norm() < 1e-8);
    CHECK((end[i] - same[i]).norm() < 1e-12);
  }
}

TEST_CASE("without a second input bodies hang where the first one is given") {
  auto sim = start(parse_scene<Standard>(
      "arm.scn", with("input2=\"@../../base/dofs\"", "input2=\"\" container=\"@../joints\"")));
  const auto x = places(sim);
  CHECK(x[1].norm() < 1e-14);
  CHECK((x[2] - (Eigen::Vector3d(0, -0.5, 0) + 0.5 * Eigen::Vector3d(std::sin(0.3), -std::cos(0.3), 0)))
            .norm() < 1e-14);
}

TEST_CASE("a constraint on a body that does not move is left out, one on another is an error") {
  auto held = [](std::string_view index, std::string_view input2) {
    std::string scene = with("input2=\"@../../base/dofs\"", input2);
    const std::string_view at = "<UniformMass vertexMass=\"0.5\"/>";
    return scene.insert(scene.find(at), text("<FixedProjectiveConstraint indices=\"", index, "\"/>"));
  };
  const auto read = parse_scene<Standard>("arm.scn", held("0", ""));
  REQUIRE(read.warnings.size() == 1);
  CHECK_THAT(read.warnings[0], Contains("<FixedProjectiveConstraint> is left out"));
  CHECK_THAT(error(held("1", "")), Contains("acts on a mapped state"));
  CHECK_THAT(error(held("0", "input2=\"@../../base/dofs\"")), Contains("acts on a mapped state"));
}

TEST_CASE("joints that are wrong are named with their place") {
  CHECK_THAT(error(with("childIndex=\"2\"", "childIndex=\"two\"")),
             Contains("arm.scn:25") && Contains("<ArticulationCenter>: childIndex"));
  CHECK_THAT(error(with("posOnParent=\"0 -0.5 0\"", "posOnParnt=\"0 -0.5 0\"")),
             Contains("<ArticulationCenter> has no attribute 'posOnParnt'") && Contains("posOnParent"));
  CHECK_THAT(error(with("axis=\"0 0 1\" articulationIndex=\"1\"", "axis=\"0 0\" articulationIndex=\"1\"")),
             Contains("<Articulation>: axis"));
  CHECK_THAT(error(with("childIndex=\"2\"", "childIndex=\"1\"")), Contains("body 1 is borne by"));
  CHECK_THAT(error(with("articulationIndex=\"1\"", "articulationIndex=\"2\"")),
             Contains("articulationIndex 2") && Contains("there are 2 values"));
  CHECK_THAT(error(with("<ArticulatedHierarchyContainer name=\"joints\"/>", "")),
             Contains("there is no center"));
  CHECK_THAT(error(with("name=\"joints\"", "name=\"joints\" filename=\"walk.bvh\"")), Contains("BVH"));
  CHECK_THAT(error(with("output=\"@bodies\"", "container=\"@../nothing\"")),
             Contains("container: '@../nothing' leads to no <ArticulatedHierarchyContainer>"));
  CHECK_THAT(error(with("<ArticulationCenter parentIndex=\"0\" childIndex=\"1\" posOnParent=\"0 -0.5 0\" "
                        "posOnChild=\"0 0.5 0\" articulationProcess=\"2\"/>",
                        "")),
             Contains("<Articulation>: stands below no <ArticulationCenter>"));
}

TEST_CASE("springs to the place of a state that moves are refused, unless a constraint holds all of it") {
  auto with = [](std::string const& constraint, std::string const& more = "") {
    return error(
        text("<Node><EulerImplicitSolver/><CGLinearSolver/><Node name='held'><MechanicalObject name='dofs' ",
             "position='1 0 0'",
             more,
             "/>",
             constraint,
             "</Node><Node><MechanicalObject position='0 0 0'/><UniformMass/><RestShapeSpringsForceField ",
             "points='0' stiffness='3' external_rest_shape='@../held/dofs'/></Node></Node>"));
  };
  const std::string refused = "but springs are to a place that stays";
  CHECK_THAT(with(""), Contains(refused));
  CHECK(with("<FixedProjectiveConstraint indices='0'/>").empty());
  CHECK(with("<PartialFixedProjectiveConstraint fixAll='1' fixedDirections='1 1 1'/>").empty());
  CHECK_THAT(with("<PartialFixedProjectiveConstraint indices='0' fixedDirections='1 0 1'/>"),
             Contains(refused));
  CHECK_THAT(with("<FixedProjectiveConstraint indices='0'/>", " velocity='1 0 0'"), Contains(refused));
}

}  // namespace test_articulations
