// SPDX-License-Identifier: BSL-1.0
// Each attribute that SOFA's classes have (v26; sofa_attributes.txt: class, attribute and default, as its factory says them) is a
// field of ours, has no effect, or is not simulated, and is one of these only.
#include "same_bits.hpp"

#include <sinew/runtime/dialect.hpp>
#include <sinew/runtime/dialect_attributes.hpp>

#include <cctype>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

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
// loader where the class has no field for one; the tag of the points of a diffusion; externalForce becomes a component of its own
bool taken(ClassInfo const& info, std::string_view name) {
  static const std::set<std::string_view> placing{"translation", "rotation", "scale", "scale3d", "vertices"};
  return name == "topology" || name == "filename" || (info.role == RoleKind::forceField && name == "tagMechanics") || (info.role == RoleKind::engine && name == "useRestPosition") || (info.role == RoleKind::state && name == "externalForce") || (info.role == RoleKind::visualModel && placing.count(name) > 0);
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
      const bool numbered = std::any_of(info.fields.begin(), info.fields.end(), [&](auto const& f) { return f.numberOf(a.name) >= 0; });
      if (info.field(a.name) || numbered || taken(info, a.name)) continue;
      auto const* refused = dialect::not_simulated(info.name, a.name);
      CHECK((refused != nullptr) != dialect::without_effect(info.name, a.name));
      if (!refused) continue;
      seen.insert(std::string(refused->className) + '.' + std::string(refused->attribute));
      // the class by which NewProximityIntersection is known has another default
      if (a.className != "NewProximityIntersection") CHECK(dialect::is_standard(*refused, a.standard));
    }
    CHECK(anywhere);
  }
  // of classes of SOFA's plugins, of those that it has no more, or that it takes with a message
  const std::set<std::string> old{"AdaptiveBeamMapping.contactDuplicate", "AdaptiveBeamMapping.proximity",
                                  "BeamInterpolation.dofsAndBeamsAligned",
                                  "InterventionalRadiologyController.controlledInstrument",
                                  "InterventionalRadiologyController.rigidCurvAbs",
                                  "RigidDistanceGridCollisionModel.dumpfilename",
                                  "RigidDistanceGridCollisionModel.sampling",
                                  ".isCompliance", ".geometricStiffness", ".updateStateWhenDiverged",
                                  "LCPConstraintSolver.multi_grid"};
  for (auto const& n : dialect::notSimulated) {
    const std::string name = std::string(n.className) + '.' + std::string(n.attribute);
    INFO(name);
    CHECK(seen.count(name) + old.count(name) == 1);
  }
}

namespace {

// two values in words are the same where their numbers are, or their words in whatever case
bool same_value(std::string const& a, std::string const& b) {
  const auto zeros = [](std::string const& words) { return words.find_first_not_of(" 0.") == words.npos; };
  if (!a.empty() && zeros(a) && zeros(b)) return true;  // of other DataTypes
  std::istringstream first(a), second(b);
  std::string x, y;
  while (first >> x) {
    if (!(second >> y)) return false;
    char *endX, *endY;
    const double numberX = std::strtod(x.c_str(), &endX), numberY = std::strtod(y.c_str(), &endY);
    const bool numbers = *endX == 0 && *endY == 0;
    if (numbers ? numberX != numberY
                : !std::equal(x.begin(), x.end(), y.begin(), y.end(),
                              [](unsigned char i, unsigned char j) { return std::tolower(i) == std::tolower(j); }))
      return false;
  }
  while (second >> y)
    if (a.empty() || !zeros(y)) return false;  // a vector of fewer coordinates
  return true;
}
std::string in_sofas_words(std::string const& value) {
  std::string words = value == "true" ? "1" : value == "false" ? "0" : value;
  for (char& c : words)
    if (c == '[' || c == ']' || c == ',') c = ' ';  // of matrices
  return words;
}

}  // namespace

TEST_CASE("what a scene leaves out has SOFA's default, or the exception has a reason") {
  const std::map<std::string, std::string_view> exceptions{
      {"CGLinearSolver.threshold", "1e-5 ends iterations of light bodies before they begin; docs/sofa.md"},
      {"CubeTopology.nx", "0 is no grid"},
      {"CubeTopology.ny", "0 is no grid"},
      {"CubeTopology.nz", "0 is no grid"},
      {"Gravity.gravity", "that of a node without one, which SOFA's nodes have"},
      {"MeshSpringForceField.stiffness", "the factory lists that of StiffSpringForceField; MeshSpringForceField.inl has 0"},
      {"MeshSpringForceField.damping", "the same"},
      {"InteractionEllipsoidForceField.object2_forces", "scene files have SOFA's default, which is refused"},
      {"MeshROI.strict", "its constructor sets it to 0"},
      {"RestShapeSpringsForceField.activeDirections", "none given are all"},
      {"UncoupledConstraintCorrection.defaultCompliance", "rigid bodies answer by their masses"},
      {"RigidMapping.geometricStiffness", "the factory lists that of all mappings; RigidMapping.inl selects none"}};
  const auto table = make_class_table<Standard>();
  std::set<std::string> other;
  int compared = 0;
  for (Attribute const& a : attributes_of_sofa()) {
    if (a.standard.empty()) continue;
    for (auto const& info : table) {
      if (!info.known(a.className)) continue;
      FieldInfo const* field = info.field(a.name);
      // a field that may be left out: what it is then, the law suites and closed forms have
      if (!field || field->kind.ends_with("or none") || field->kind.ends_with("inertia by mass")) continue;
      ++compared;
      const std::string name = text(info.name, '.', a.name);
      INFO(name << ": '" << field->defaultValue << "', in SOFA '" << a.standard << "' (as " << a.className << ')');
      if (same_value(in_sofas_words(field->defaultValue), in_sofas_words(a.standard))) continue;
      other.insert(name);
      CHECK(exceptions.count(name) == 1);
    }
  }
  CHECK(compared > 300);
  for (auto const& [name, reason] : exceptions) {
    INFO(name);
    CHECK(other.count(name) == 1);
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
  CHECK_THROWS_WITH(parse("<SurfacePressureForceField pressure='1' volumeConservationMode='1'/>"), Contains("volumeConservationMode is not simulated"));
}

TEST_CASE("attributes that SOFA has today and that change nothing are taken") {
  const auto scene = parse("<CollisionPipeline depth='6' draw='0' verbose='0'/><BruteForceBroadPhase/><BVHNarrowPhase/>"
                           "<MinProximityIntersection/><CollisionResponse/><PointCollisionModel contactDistance='0.25'/>");
  CHECK(scene.root.get<PointCollisionModel<Vec3d>>()->proximity == 0.25);
}

TEST_CASE("externalForce of a state acts on its first points, and is nothing where it is zero") {
  auto fall = [](std::string const& attribute) {
    auto simulation = start(parse_scene<Standard>(
        "test.scn", "<Node dt='0.1' gravity='0 0 0'><EulerExplicitSolver/><MechanicalObject position='0 0 0 1 0 0 2 0 0' " + attribute +
                        "/><UniformMass vertexMass='2'/></Node>"));
    simulation.animate(0.1);
    return simulation.root().get<MechanicalObject<Vec3d>>()->velocity;
  };
  const auto pushed = fall("externalForce='4 0 0  0 -6 0'");
  CHECK(pushed[0] == Eigen::Vector3d(0.2, 0, 0));
  CHECK((pushed[1] - Eigen::Vector3d(0, -0.3, 0)).norm() < 1e-15);
  CHECK(pushed[2] == Eigen::Vector3d(0, 0, 0));
  CHECK(fall("externalForce='0 0 0'")[0] == Eigen::Vector3d(0, 0, 0));
  CHECK_THROWS_WITH(fall("externalForce='1 0 0 2'"), Contains("test.scn:1:") && Contains("externalForce: give 3 numbers for each"));
  CHECK_THROWS_WITH(fall("externalForce='1 0 x'"), Contains("test.scn:1:") && Contains("'x'"));
  CHECK_THROWS_WITH(fall("externalForce='1 0 0 1 0 0 1 0 0 1 0 0'"), Contains("the state has 3 points"));
}

TEST_CASE("a state of one point takes the points of its topology, and runs along a grid that runs backwards") {
  auto scene = start(parse_scene<Standard>(
      "test.scn", "<Node><RegularGridTopology n='3 2 1' min='2 0 0' max='-2 1 4'/><MechanicalObject position='0 0 0'/>"
                  "<UniformMass vertexMass='1'/></Node>"));
  auto const& x = scene.root().get<MechanicalObject<Vec3d>>()->position;
  REQUIRE(x.size() == 6);
  CHECK(x[0] == Eigen::Vector3d(2, 0, 0));
  CHECK(x[5] == Eigen::Vector3d(-2, 1, 0));
  CHECK_THROWS_WITH(start(parse_scene<Standard>("test.scn", "<Node><RegularGridTopology n='3 2 1' min='2 0 0' max='-2 0 4'/></Node>")),
                    Contains("is empty"));
}

TEST_CASE("translation, rotation and scale3d move points of the plane within it") {
  auto moved = [](std::string const& attributes) {
    return start(parse_scene<Standard>("test.scn", "<Node><MechanicalObject template='Vec2d' position='1 0 0 2' " + attributes + "/></Node>"))
        .root().get<MechanicalObject<Vec2d>>()->position;
  };
  const auto x = moved("translation='3 4 0' rotation='0 0 90' scale3d='2 1 1'");
  CHECK((x[0] - Eigen::Vector2d(3, 6)).norm() < 1e-15);
  CHECK((x[1] - Eigen::Vector2d(1, 4)).norm() < 1e-15);
  CHECK_THROWS_WITH(moved("rotation='0 90 0'"), Contains("test.scn:1:") && Contains("out of its plane"));
}

TEST_CASE("a name that stands for another method than SOFA's says what differs") {
  const auto table = make_class_table<Standard>();
  for (auto const& other : dialect::anotherMethod) {
    INFO(other.name);
    const bool known = std::any_of(table.begin(), table.end(), [&](auto const& info) { return info.known(other.name); });
    CHECK((known || dialect::preconditioner_named(other.name) || DefaultContactManager::All::find(other.name) >= 0));
  }
  const auto scene = parse("<EulerImplicitSolver/><AsyncSparseLDLSolver/><UniformMass totalMass='1'/>");
  REQUIRE(scene.warnings.size() == 1);
  CHECK_THAT(scene.warnings[0], Contains("test.scn:1:") && Contains("<AsyncSparseLDLSolver>: the matrix of each step"));
  CHECK(parse("<EulerImplicitSolver/><SparseLDLSolver/><UniformMass totalMass='1'/>").warnings.empty());
}

}  // namespace test_sofa_attributes
