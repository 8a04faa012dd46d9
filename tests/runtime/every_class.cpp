// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/runtime/precompiled.hpp>

#include <optional>

// Every class of the registry stands in a scene file that is made for it, with each of its fields, where a
// scene would have it: nothing is written for a class.

namespace test_every_class {

using namespace sinew;

namespace {

std::string element(std::string_view tag, std::string const& attributes) {
  return text('<', tag, ' ', attributes, "/>");
}
std::string state(std::string_view types) {
  return types.empty() ? std::string() : element("MechanicalObject", text("template=\"", types, '"'));
}
std::string node(std::string_view name, std::string const& content) {
  return text("<Node name=\"", name, "\">", content, "</Node>");
}

// all fields, as they are when none is given; gravity is an attribute of nodes
std::string attributes(ClassInfo const& info) {
  std::string all = info.dataTypes.empty() ? "" : text("template=\"", info.dataTypes, '"');
  for (auto const& field : info.fields)
    if (field.isInput && !field.defaultValue.empty())
      all += text(' ', field.name, "=\"", field.defaultValue, '"');
  return all;
}

// a scene in which a class is at its place, in the node "place"
std::string scene_of(ClassInfo const& info) {
  std::string const given = attributes(info);
  if (info.role == RoleKind::context) return text("<Node name=\"place\" ", given, "/>");
  if (info.joins)
    return node("place",
                element(info.name, given + " object1=\"@a\" object2=\"@b\"") +
                    node("a", state(info.dataTypes)) + node("b", state(info.dataTypes)));
  if (info.role == RoleKind::mapping) {
    std::string const place = state(info.out);
    if (!info.in2.empty())
      return node(
          "scene",
          node("above", state(info.in)) + node("second", state(info.in2)) +
              node("place",
                   place + element(info.name, given + " input1=\"@../above\" input2=\"@../second\"")));
    std::string const input = info.severalParents ? " input=\"@..\"" : "";
    return node("above", state(info.in) + node("place", place + element(info.name, given + input)));
  }
  if (info.traits.joinsTopologies)
    return node("above", "<MeshTopology/>" + node("place", "<MeshTopology/>" + element(info.name, given)));
  const bool hasState = info.role == RoleKind::state || info.role == RoleKind::visualModel ||
                        info.role == RoleKind::engine || info.role == RoleKind::linearSolver;
  return node("place", (hasState ? "" : state(info.dataTypes)) + element(info.name, given));
}

RuntimeNode<Standard> const* place_in(RuntimeNode<Standard> const& node) {
  if (node.name == "place") return &node;
  for (auto const& child : node.children())
    if (auto const* found = place_in(*child)) return found;
  return nullptr;
}

}  // namespace

TEST_CASE("every class of the registry can stand in a scene file, with all its fields") {
  const auto table = make_class_table<Standard>();
  for (ClassInfo const& info : table) {
    INFO(info.cppName);
    std::string const scene = scene_of(info);
    INFO(scene);
    std::optional<ReadScene<Standard>> read;
    try {
      read = parse_scene<Standard>("test.scn", scene);
    } catch (SceneError const& error) {
      // engines and grids make their data when they are read, and have said what they miss
      INFO(error.what());
      CHECK((info.role == RoleKind::engine || info.role == RoleKind::topology));
      CHECK(error.messages.size() == 1);
      CHECK(std::string(error.what()).find(text('<', info.name, ">: ")) != std::string::npos);
      CHECK(std::string(error.what()).find("attribute") == std::string::npos);
      continue;
    }
    CHECK(read->ignored.empty());
    auto const* const place = place_in(read->root);
    REQUIRE(place);
    const auto found = std::find_if(place->components().begin(),
                                    place->components().end(),
                                    [&](auto const& entry) { return entry.component.type() == info.type; });
    REQUIRE(found != place->components().end());
    for (auto const& field : info.fields) {
      INFO(field.name);
      if (field.isInput && !field.defaultValue.empty())
        CHECK(field.write(found->component.address()) == field.defaultValue);
    }
  }
}

}  // namespace test_every_class
