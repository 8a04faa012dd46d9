// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "runtime/bake/point_engine.hpp"
#include "runtime/bake/shape.hpp"

#include <sinew/runtime/bake.hpp>

#include <fstream>

namespace test_bake_engines {

using namespace sinew;
using Catch::Matchers::Contains;

TEST_CASE("engines and what others link to are variables") {
  std::ofstream("bake_points.txt") << "0 0 0\n1 0 0\n0 1 0\n2 2 2\n";
  const std::string xml = R"(<Node name="root"><EulerExplicitSolver/>
    <Node name="a">
      <PointFileLoader name="class" filename="bake_points.txt"/>
      <TetrahedronTopology name="topology" tetrahedra="0 1 2 3"/>
      <MechanicalObject name="dofs" src="@class"/>
      <UniformMass/>
      <HighPoints name="high points" position="@dofs.position" above="0.5"/>
      <FixedConstraint indices="@high points.indices"/>
    </Node>
    <Node name="b"><MechanicalObject template="Vec3f" position="@../a/class.position"/>
      <TetrahedronTopology tetrahedra="@../a/topology.tetrahedra"/>
      <FixedConstraint indices="@[-1].none"/></Node></Node>)";
  // a link that does not fit is said by the reader; the rest bakes
  CHECK_THROWS_AS(parse_scene<Tested>("test.scn", xml, {}), Error);
  std::string right = xml;
  right.replace(right.find("@[-1].none"), 10, "@../a/high_points.indices");
  right.replace(right.find("@high points"), 12, "@high_points");
  auto baked = [&](BakeOptions const& options) {
    return bake_text<Tested>(parse_scene<Tested>("test.scn", right, {}), "test.scn", options);
  };
  const std::string cpp = baked({.data = "/data \"here\"", .includes = {"runtime/bake/point_engine.hpp"}});
  check_shape(cpp);
  CHECK_THAT(cpp, Contains("#include <runtime/bake/point_engine.hpp>\n"));
  CHECK_THAT(cpp, Contains(R"(
inline auto scene(std::string const& data = "/data \"here\"") {
  TetrahedronTopology topology{.tetrahedra = {{0, 1, 2, 3}}};
  PointFileLoader class2{.filename = {data + "/bake_points.txt"}};
  class2.update("/root/a: class");
  HighPoints<Vec3d> highPoints{.position = class2.position, .above = 0.5};
  highPoints.update("/root/a: high_points");
)"));
  CHECK_THAT(cpp, Contains("MechanicalObject<Vec3d>{.position = class2.position}"));
  CHECK_THAT(cpp, Contains("FixedConstraint<Vec3d>{.indices = highPoints.indices}"));
  CHECK_THAT(cpp, Contains("FixedConstraint<Vec3f>{.indices = highPoints.indices}"));
  // it follows the body while the scene runs, and what it makes goes on
  CHECK_THAT(cpp, Contains("          highPoints,\n"));
  CHECK_THAT(cpp, Contains("data_link(") && Contains("At<\"a\", &MechanicalObject<Vec3d>::position>{}"));
  CHECK_THAT(cpp, Contains("At<\"a\", &HighPoints<Vec3d>::position>{}"));
  CHECK_THAT(cpp, Contains("At<\"b\", &FixedConstraint<Vec3f>::indices>{}"));
  // in another type the values stand there
  CHECK_THAT(cpp,
             Contains(".position = {{0.f, 0.f, 0.f}, {1.f, 0.f, 0.f}, {0.f, 1.f, 0.f}, {2.f, 2.f, 2.f}}}"));
  CHECK_THAT(cpp, Contains("          topology,\n") && Contains("{.tetrahedra = topology.tetrahedra}"));

  const std::string embedded = baked({.embed = true});
  check_shape(embedded);
  CHECK_THAT(embedded, Contains("inline auto scene() {") && !Contains("Loader") && Contains("HighPoints"));
  CHECK_THAT(embedded,
             Contains("MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 2, 2}}}"));
  CHECK_THAT(embedded, Contains("FixedConstraint<Vec3d>{.indices = {2, 3}}"));
}

}  // namespace test_bake_engines
