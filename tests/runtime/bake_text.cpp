// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "runtime/bake/shape.hpp"

#include <sinew/runtime/bake.hpp>
#include <sinew/runtime/precompiled.hpp>

namespace test_bake_text {

using namespace sinew;
using Catch::Matchers::Contains;

namespace {

std::string bake(std::string const& xml, BakeOptions const& options = {}) {
  return bake_text<Standard>(parse_scene<Standard>("folder/test.scn", xml, {}), "folder/test.scn", options);
}

template <class T>
std::string initialised(T const& value) {
  return detail::initialiser(detail::type_code<T>(), cpp_value(value));
}

const std::string pendulum = R"(<Node name="root" dt="0.01"><EulerExplicitSolver/>
  <Node name="a"><MechanicalObject name="dofs" position="0 0 0 1 0 0"/><UniformMass/>
    <FixedConstraint indices="1"/><StiffSpringForceField spring="0 1 100 0 auto"/></Node></Node>)";

}  // namespace

TEST_CASE("a baked scene says what the file says, and no default") {
  const std::string cpp = bake(pendulum);
  check_shape(cpp);
  CHECK(cpp.find(R"(// The scene "test.scn", baked by Sinew: change the scene file and bake it again.
#pragma once

#include <sinew/sinew.hpp>

#include <array>
#include <string>
#include <vector>

namespace baked {

using namespace sinew;

constexpr double dt = 0.01;  // [s]

inline auto scene() {
  return Simulation{node<"root">(
      Gravity{},
      EulerExplicitSolver{},
      node<"a">(
          MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}}},
          UniformMass<Vec3d>{},
          FixedConstraint<Vec3d>{.indices = {1}},
          StiffSpringForceField<Vec3d>{
              .springs = {{.first = 0, .second = 1, .stiffness = 100, .damping = 0}}}))};
}

}  // namespace baked
)") == 0);
}

TEST_CASE("names and strings stay names and strings") {
  const std::string cpp = bake(
      "<Node name='root\"&gt;(); evil(); //'><EulerExplicitSolver/>"
      "<Node name='a\\'><MechanicalObject name='x&#10;#include' position='0 0 0'/><UniformMass/></Node>"
      "<Node name='b&#10;#error&#13;??_&#x202E;&#x85;'><MechanicalObject position='0 0 "
      "0'/><UniformMass/></Node>"
      "<Node name='&quot;, evil(&quot;'><MechanicalObject position='0 0 0'/><UniformMass/></Node></Node>",
      {.name = "hostile"});
  check_shape(cpp);
  CHECK_THAT(cpp, Contains(R"(node<"root\">();_evil();___">()"));
  CHECK_THAT(cpp, Contains(R"(node<"a\\">()"));
  CHECK_THAT(cpp,
             Contains(R"(node<"b\012#error\015?\077_\342\200\256\302\205">()") ||
                 Contains(R"(node<"b\n#error\015?\077_\342\200\256\302\205">()"));
  CHECK_THAT(cpp, Contains(R"(node<"\",_evil(\"">()"));
  CHECK_THAT(cpp, Contains("constexpr double hostileDt"));
  // the name of the file stands in a comment
  const std::string path = "a\nint evil;\\";
  CHECK_THAT(bake_text<Standard>(parse_scene<Standard>("t", pendulum, {}), path, {}),
             Contains(R"(// The scene "a\nint evil;\\", baked)"));
}

TEST_CASE("the function needs a name of its own") {
  for (std::string name :
       {"", "class", "7up", "a b", "x;y", "node", "Gravity", "UniformMass", "std", "a__b", "_a"})
    CHECK_THROWS_WITH(bake(pendulum, {.name = name}), Contains("cannot name the function"));
  CHECK_THAT(bake(pendulum, {.name = "pendulum_2"}), Contains("inline auto pendulum_2() {"));
}

TEST_CASE("numbers keep their bits") {
  CHECK(detail::safe_cpp("{-0, 0, 10, -0.f, 1e-0, x0, 12345678901, -123}") ==
        "{-0.0, 0, 10, -0.f, 1e-0, x0, 12345678901.0, -123}");
  CHECK(initialised(-0.0) == "-0.0");
  CHECK(initialised(0.1f) == "0.1f");
  CHECK(initialised(std::optional<Eigen::Vector3d>({1, 2, 3})) == "{{1, 2, 3}}");
  CHECK(initialised(std::optional<double>(3)) == "3");
  CHECK(initialised(std::string("a\"\t\\\x7F")) == R"("a\"\011\\\177")");
}

TEST_CASE("lines break between arguments") {
  const std::string numbers = cpp_value(std::vector<int>(100, 12345));
  const std::string broken = detail::fit("values[] = " + numbers, 2, 2, 1);
  std::istringstream lines(broken);
  std::string line, again;
  int count = 0;
  for (; std::getline(lines, line); ++count) {
    CHECK(line.size() + (count == 0 ? 2 : 0) <= 110);
    again += count && line.size() > 6 ? (count > 1 ? " " : "") + line.substr(6) : line;
  }
  CHECK(count == 8);
  CHECK(again == "values[] = " + numbers);
  CHECK(detail::camel_case("rest_position") == "restPosition");
  CHECK(detail::camel_case("Linear solver 2") == "linearSolver2");
  CHECK(detail::camel_case("7 \"+/") == "");
}

TEST_CASE("an interaction stands above its ends") {
  const std::string ends =
      "<Node name='a'><MechanicalObject position='0 0 0'/><UniformMass/></Node>"
      "<Node name='b'><MechanicalObject position='1 0 0'/><UniformMass/></Node>";
  const std::string joint = "<StiffSpringForceField object1='@/a' object2='@/b' spring='0 0 10 0 0.3'/>";
  const std::string here = bake("<Node><EulerExplicitSolver/>" + joint + ends + "</Node>");
  CHECK_THAT(here, Contains(R"(StiffSpringForceField<Vec3d, Between<"a", "b">>{)") && !Contains("moved"));
  const std::string moved =
      bake("<Node><EulerExplicitSolver/>" + ends + "<Node name='j'>" + joint + "</Node></Node>");
  check_shape(moved);
  CHECK_THAT(moved, Contains(R"(Between<"a", "b">)"));
  CHECK(moved.find(R"(Between<"a", "b">)") < moved.find(R"(node<"a">)"));
  CHECK_THAT(moved, Contains("node<\"j\">()"));
}

TEST_CASE("long lists stand above the scene, each once") {
  std::string points, elements;
  for (int i = 0; i < 300; ++i) points += text(i, ".5 ", i % 7, ' ', -i, ' ');
  const std::string body = text("<Node name='body 1'><MechanicalObject position='",
                                points,
                                "'/><UniformMass/></Node>",
                                "<Node name='2'><MechanicalObject position='",
                                points,
                                "'/><UniformMass/></Node>",
                                "<Node name='f'><MechanicalObject template='Vec3f' position='",
                                points,
                                "'/></Node>");
  const std::string cpp = bake("<Node name='root'><EulerExplicitSolver/>" + body + "</Node>");
  check_shape(cpp);
  CHECK_THAT(cpp,
             Contains("inline auto sceneBody1Position() {\n  static constexpr double values[][3] = {\n"));
  CHECK_THAT(cpp, Contains("std::vector<Vec<double, 3>> list;") && Contains("return list;"));
  CHECK_THAT(cpp, Contains("static constexpr float values[][3]"));
  std::size_t uses = 0;
  for (std::size_t at = 0; (at = cpp.find("{.position = sceneBody1Position()}", at)) != cpp.npos; ++at)
    ++uses;
  CHECK(uses == 2);
}

TEST_CASE("what does not run is not baked") {
  CHECK_THROWS_WITH(bake("<Node><EulerImplicitSolver/><MechanicalObject position='0 0 0'/></Node>"),
                    Contains("linear solver"));
  CHECK_THROWS_WITH(bake("<Node><MechanicalObject position='nan 0 0'/></Node>"), Contains("finite"));
  CHECK_THROWS_WITH(bake("<Node><MechanicalObject position='0 0 0'/><FixedConstraint indices='3'/></Node>"),
                    Contains("numbered from 0"));
  auto named = parse_scene<Standard>("t.scn", pendulum, {});
  named.root.addChild("a/b");
  CHECK_THROWS_WITH(bake_text<Standard>(named, "t.scn", {}), Contains("has no '/'"));
}

TEST_CASE("an optional field links to the value that it holds") {
  const std::string cpp = bake(R"(<Node name="root"><EulerExplicitSolver/>
    <GenerateRigidMass name="inside" density="12" position="0 0 0 1 0 0 0 1 0 0 0 1"
                       triangles="0 2 1 0 1 3 1 2 3 0 3 2"/>
    <MechanicalObject template="Rigid3d"/><UniformMass vertexMass="@inside.rigidMass"/></Node>)");
  check_shape(cpp);
  CHECK_THAT(cpp, Contains("  inside.update(\"/root: inside\");\n"));
  CHECK_THAT(cpp, Contains("UniformMass<Rigid3d>{.vertexMass = inside.rigidMass}"));
}

}  // namespace test_bake_text
