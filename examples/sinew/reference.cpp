// SPDX-License-Identifier: BSL-1.0
#include "reference.hpp"

#include <algorithm>
#include <array>

namespace cli {

using sinew::text;

std::vector<std::string> Entry::dataTypes() const {
  std::vector<std::string> all;
  for (auto const* v : variants)
    if (!v->dataTypes.empty() && std::find(all.begin(), all.end(), v->dataTypes) == all.end())
      all.push_back(v->dataTypes);
  return all;
}
bool Entry::joins() const {
  return std::any_of(variants.begin(), variants.end(), [](auto const* v) { return v->joins; });
}
std::vector<std::string_view> Entry::fieldNames(bool inputs) const {
  std::vector<std::string_view> names;
  for (auto const* v : variants)
    for (auto const& f : v->fields)
      if (f.isInput == inputs && std::find(names.begin(), names.end(), f.name) == names.end())
        names.push_back(f.name);
  return names;
}

std::vector<Entry> entries_of(std::vector<sinew::ClassInfo> const& table) {
  std::vector<Entry> entries;
  for (auto const& info : table) {
    auto same = [&](Entry const& e) { return e.first().name == info.name; };
    auto at = std::find_if(entries.begin(), entries.end(), same);
    if (at == entries.end()) at = entries.insert(entries.end(), Entry{});
    at->variants.push_back(&info);
  }
  std::stable_sort(entries.begin(), entries.end(), [](Entry const& a, Entry const& b) {
    return a.first().role != b.first().role ? a.first().role < b.first().role
                                            : a.first().name < b.first().name;
  });
  return entries;
}

RoleWords words_of(sinew::RoleKind role) {
  static constexpr std::string_view concepts = "../concepts.md", collision = "../collision.md",
                                    constraints = "../constraints.md", files = "../scene-files.md",
                                    whatState = "what a state is",
                                    howFound = "how contacts are found and answered",
                                    byMultipliers = "constraints by multipliers";
  static constexpr auto all = std::to_array<RoleWords>(
      {{"Surroundings", "What holds for a node and all below it.", concepts, "scenes, nodes and components"},
       {"Topologies",
        "Elements over the points of the state of the node.",
        "../concepts.md#state",
        whatState},
       {"States",
        "Positions and velocities of one body; at most one a node.",
        "../concepts.md#state",
        whatState},
       {"Visual models",
        "Surfaces that follow a mapping, to look at.",
        "../viewing.md",
        "pictures and windows"},
       {"Masses",
        "At most one a node; for the state of the node, or the nearest above.",
        concepts,
        "scenes, nodes and components"},
       {"Force fields",
        "Act on the state of the node, or the nearest above.",
        "../guide/force-field.md",
        "a force of your own"},
       {"Forces between two bodies",
        "Act between the states of two nodes, object1 and object2.",
        "../guide/force-field.md",
        "a force of your own"},
       {"Constraints",
        "Take forbidden motions away; on a state that is not mapped.",
        constraints,
        "the other kind of constraints, by multipliers"},
       {"Mappings",
        "Make the state or the visual model of the node follow the state above.",
        "../guide/mapping.md",
        "a mapping of your own"},
       {"ODE solvers",
        "Integrate the node and all below it in time.",
        "../concepts.md#step",
        "what a step is"},
       {"Linear solvers",
        "Solve the systems of an implicit ODE solver.",
        "../guide/types.md",
        "numbers and matrices"},
       {"Behavior models",
        "Have degrees of freedom of their own, which no solver moves.",
        "../fluids.md#fluids-on-grids",
        "fluids on grids"},
       {"Callbacks",
        "Watch the state of the node, or the nearest above, before and after each step.",
        "../scene-files.md#recording-and-replaying",
        "recording and replaying"},
       {"Loaders, selections and other engines",
        "Make data from files or other data; others link to it, as in position=\"@loader.position\".",
        files,
        "scene files"},
       {"Data links",
        "In a typed scene: make a value follow another one while the scene runs.",
        "../scene-files.md#engines",
        "what engines follow"},
       {"Collision pipelines",
        "Compose collision detection from the stages that stand in the same node.",
        collision,
        howFound},
       {"Broad phases", "Find the collision models that are near each other.", collision, howFound},
       {"Narrow phases",
        "Find the primitives of two collision models that are near each other.",
        collision,
        howFound},
       {"Intersection methods", "Say where two primitives meet.", collision, howFound},
       {"Contact managers",
        "Keep the contacts from step to step, and apply the responses to them.",
        collision,
        howFound},
       {"Collision models",
        "Primitives over the points of the state of the node.",
        "../collision.md#models",
        "collision models"},
       {"Carving", "Takes away what tools touch.", collision, howFound},
       {"Cutting", "Parts what blades go through.", "../runtime.md#cuts", "cuts"},
       {"Topological changes",
        "Take elements out of the topology of the node, or the nearest above, or put some in, while the "
        "scene "
        "runs.",
        "../runtime.md#elements-that-go",
        "elements that go"},
       {"Execution",
        "By which threads of the processor the solvers of the node and its children work.",
        "../guide/sweep.md",
        "many runs in threads"},
       {"Division of steps",
        "In the root: in how many parts a step of the scene goes.",
        "../concepts.md#step",
        "what a step is"},
       {"Animation loops", "In the root: what a step of the scene is.", constraints, byMultipliers},
       {"Constraints by multipliers",
        "Equations for the states of the scene; an animation loop solves them.",
        constraints,
        byMultipliers},
       {"Constraint solvers",
        "Find the multipliers of all constraints of the scene together.",
        constraints,
        byMultipliers},
       {"Constraint corrections",
        "Say what multipliers do to the bodies of the node and below it.",
        constraints,
        byMultipliers}});
  static_assert(all.size() == enum_names(sinew::RoleKind{}).size());
  return all[std::size_t(role)];
}

namespace {

// "list of 4 whole numbers" for "list of 4 of whole number"
std::string polished(std::string kind) {
  auto replace = [&](std::string_view from, std::string_view to) {
    for (std::size_t at = kind.find(from); at != kind.npos; at = kind.find(from, at + to.size()))
      kind.replace(at, from.size(), to);
  };
  replace("list of number", "numbers");
  replace("list of whole number", "whole numbers");
  replace("list of 1 numbers", "numbers");
  replace(" of whole number", " whole numbers");
  replace(" of number", " numbers");
  return kind;
}

void gather(Variants& to, std::string const& words, std::string const& over) {
  for (auto& [known, where] : to)
    if (known == words) {
      if (where.find(over) == where.npos) where += text(", ", over);
      return;
    }
  to.emplace_back(words, over);
}
}  // namespace

FieldWords words_of(Entry const& entry, std::string_view name, bool input) {
  FieldWords words;
  for (auto const* v : entry.variants)
    for (auto const& f : v->fields) {
      if (f.name != name || f.isInput != input) continue;
      // Vec3d speaks for all
      if (!words.field || v->dataTypes == "Vec3d") words.field = &f;
      gather(words.kinds, polished(f.kind), v->dataTypes);
      gather(words.defaults, f.defaultValue, v->dataTypes);
    }
  words.unit = words.field->unit;
  words.range = sinew::detail::range_text(words.field->range);
  return words;
}
std::string joined(std::vector<std::string> const& words, std::string_view between) {
  std::string all;
  for (auto const& word : words) all += text(all.empty() ? "" : between, word);
  return all;
}

}  // namespace cli
