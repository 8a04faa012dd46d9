// SPDX-License-Identifier: BSL-1.0
// Each attribute that SOFA's classes have (v26; sofa_attributes.txt: class, attribute and default, as its factory says them) is a
// field of ours, has no effect, or is not simulated, and is one of these only.
#include "catch.hpp"

#include <sinew/runtime/dialect_attributes.hpp>
#include <sinew/runtime/precompiled.hpp>

#include <fstream>
#include <set>

namespace test_sofa_attributes {

using namespace sinew;
using Catch::Matchers::Contains;

namespace {

struct Attribute {
  std::string className, name, standard;
};
std::vector<Attribute> attributes_of_sofa() {
  std::vector<Attribute> all;
  std::ifstream file(SINEW_SOFA_ATTRIBUTES);
  REQUIRE(file);
  for (std::string line; std::getline(file, line);) {
    const std::size_t first = line.find('\t'), second = line.find('\t', first + 1);
    REQUIRE(second != line.npos);
    all.push_back({line.substr(0, first), line.substr(first + 1, second - first - 1), line.substr(second + 1)});
  }
  return all;
}

// what the reader takes beside fields: where a visual model is put, the topology that is named, and a file, which it reads by a
// loader where the class has no field for one
bool taken(ClassInfo const& info, std::string_view name) {
  static const std::set<std::string_view> placing{"translation", "rotation", "scale", "scale3d", "vertices"};
  return name == "topology" || name == "filename" || (info.role == RoleKind::visualModel && placing.count(name) > 0);
}

ReadScene<Standard> parse(std::string const& component, bool lenient = false) {
  return parse_scene<Standard>("test.scn",
                               "<Node><MechanicalObject position='0 0 0 1 0 0'/>" + component + "</Node>",
                               {.lenient = lenient});
}

}  // namespace

TEST_CASE("each attribute of SOFA is a field, has no effect, or is not simulated") {
  const auto table = make_class_table<Standard>();
  std::set<std::string> seen;
  for (Attribute const& a : attributes_of_sofa()) {
    INFO(a.className << '.' << a.name);
    bool anywhere = false;
    for (auto const& info : table) {
      if (!info.known(a.className)) continue;
      anywhere = true;
      if (info.field(a.name) || taken(info, a.name)) continue;
      auto const* refused = dialect::not_simulated(info.name, a.name);
      CHECK((refused != nullptr) != dialect::without_effect(info.name, a.name));
      if (!refused) continue;
      seen.insert(std::string(refused->className) + '.' + std::string(refused->attribute));
      // the class by which NewProximityIntersection is known has another default
      if (a.className != "NewProximityIntersection") CHECK(dialect::is_standard(*refused, a.standard));
    }
    CHECK(anywhere);
  }
  // of classes that SOFA has no more
  const std::set<std::string> old{".isCompliance", ".geometricStiffness", ".solveVelocityConstraintFirst", ".updateStateWhenDiverged"};
  for (auto const& n : dialect::notSimulated) {
    const std::string name = std::string(n.className) + '.' + std::string(n.attribute);
    INFO(name);
    CHECK(seen.count(name) + old.count(name) == 1);
  }
}

TEST_CASE("what is not simulated is refused unless it is as SOFA has it by default") {
  for (std::string const usual : {"rayleighStiffness='0'", "rayleighStiffness='0.0'", "separateGravity='false'", "localRange='-1 -1'",
                                  "indices=''", "printMass='1'"})
    CHECK(parse("<UniformMass totalMass='1' " + usual + "/>").warnings.empty());
  const std::string other = "<UniformMass totalMass='1' separateGravity='1'/>";
  CHECK_THROWS_WITH(parse(other),
                    Contains("test.scn:1:") && Contains("<UniformMass>: separateGravity is not simulated: only its default '0' is") &&
                        Contains("--lenient"));
  const auto scene = parse(other, true);
  REQUIRE(scene.warnings.size() == 1);
  CHECK_THAT(scene.warnings[0], Contains("test.scn:1:") && Contains("separateGravity is not simulated") && Contains("left out"));
  // the only load of a scene
  CHECK_THROWS_WITH(parse("<EdgePressureForceField pressure='0 1 0' p_intensity='2'/>"), Contains("p_intensity is not simulated"));
}

TEST_CASE("attributes that SOFA has today and that change nothing are taken") {
  const auto scene = parse("<CollisionPipeline depth='6' draw='0' verbose='0'/><BruteForceBroadPhase/><BVHNarrowPhase/>"
                           "<MinProximityIntersection/><CollisionResponse/><PointCollisionModel contactDistance='0.25'/>");
  CHECK(scene.root.get<PointCollisionModel<Vec3d>>()->proximity == 0.25);
}

}  // namespace test_sofa_attributes
