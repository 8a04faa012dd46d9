// SPDX-License-Identifier: BSL-1.0
// Mappings from several parents, of one kind or of two, in scene files.
#include "same_bits.hpp"

#include <sinew/runtime/save_scene.hpp>

#include <map>

namespace test_joint_mappings {

using namespace sinew;
using Catch::Matchers::Contains;

namespace {

const std::string frames = R"(
<Node name="root" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <SparseLDLSolver template="CompressedRowSparseMatrixd"/>
  <Node name="frame">
    <MechanicalObject name="dofs" template="Rigid3" position="0 0 0  0 0 0 1" velocity="0 0 0  0 0 2"/>
    <UniformMass vertexMass="1"/>
  </Node>
  <Node name="body">
    <MechanicalObject position="0 0 0  1 0 0"/>
    <UniformMass vertexMass="0.1"/>
    <StiffSpringForceField spring="0 1 100 0.1 1"/>
    <Node name="world">
      <MechanicalObject name="image"/>
      <DeformableOnRigidFrameMapping input1="@.." input2="@../../frame/dofs" output="@image" geometricStiffness="symmetrized"/>
      <RestShapeSpringsForceField stiffness="30"/>
    </Node>
  </Node>
</Node>)";

const std::string distances = R"(
<Node name="root" gravity="0 -9.81 0">
  <EulerImplicitSolver/>
  <SparseLDLSolver/>
  <Node name="a"><MechanicalObject position="0 0 0  0 -0.5 0"/><UniformMass vertexMass="0.1"/><FixedConstraint indices="0"/></Node>
  <Node name="b"><MechanicalObject position="0.2 -1 0"/><UniformMass vertexMass="0.1"/></Node>
  <Node name="joint">
    <MechanicalObject template="Vec1"/>
    <MeshTopology name="pairs" edges="0 1  2 1"/>
    <DistanceMultiMapping topology="@pairs" input="@../a @../b" indexPairs="0 1  1 0  0 0" geometricStiffness="exact"/>
    <RestShapeSpringsForceField stiffness="50"/>
  </Node>
</Node>)";

template <class F>
void each_state(Simulation<RuntimeNode<Standard>>& sim, F&& f) {
  sim.visit<role::State>([&](auto const& s, auto const& scope) { f(s, scope.path()); });
}

}  // namespace

TEST_CASE("mappings of several parents run from files, with and without matrix, and are saved") {
  const std::string text = GENERATE_COPY(frames, distances);
  auto assembled = start(parse_scene<Standard>("scene.scn", text));
  std::string other = text;
  const std::size_t at = other.find("<SparseLDLSolver");
  other.replace(at, other.find("/>", at) + 2 - at, "<CGLinearSolver iterations='500' tolerance='1e-14'/>");
  auto iterated = start(parse_scene<Standard>("scene.scn", other));
  auto saved = start(parse_scene<Standard>("saved.scn", scene_text(assembled, 0.01)));
  for (int i = 0; i < 20; ++i)
    for (auto* sim : {&assembled, &iterated, &saved}) sim->animate(0.01);
  std::map<std::string, std::vector<Eigen::Vector3d>> found;
  auto place = [](auto const& s, std::size_t i) {
    using D = typename std::decay_t<decltype(s)>::DataTypes;
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    x.template head<D::spatial>() = D::center(s.position[i]).template cast<double>();
    return x;
  };
  each_state(assembled, [&](auto const& s, std::string const& path) {
    for (std::size_t i = 0; i < s.size(); ++i) found[path].push_back(place(s, i));
  });
  for (auto* sim : {&iterated, &saved})
    each_state(*sim, [&](auto const& s, std::string const& path) {
      REQUIRE(found[path].size() == s.size());
      for (std::size_t i = 0; i < s.size(); ++i) CHECK((found[path][i] - place(s, i)).norm() < 1e-8);
    });
}

TEST_CASE("parents of two kinds that are not there, or of another kind, are named") {
  auto with = [](std::string_view inputs) {
    std::string text = frames;
    const std::string_view given = "input1=\"@..\" input2=\"@../../frame/dofs\"";
    text.replace(text.find(given), given.size(), inputs);
    try {
      parse_scene<Standard>("scene.scn", text);
    } catch (SceneError const& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(with("input1='@..' input2='@../../frame'").empty());
  CHECK_THAT(with("input1='@..'"), Contains("follows two parents, and names 1"));
  CHECK_THAT(with(""), Contains("names no parents"));
  CHECK_THAT(with("input1='@../../frame' input2='@..'"), Contains("is not there over Rigid3d,Vec3d,Vec3d"));
  CHECK_THAT(with("input1='@..' input2='@../../other'"), Contains("other"));
}

}  // namespace test_joint_mappings
