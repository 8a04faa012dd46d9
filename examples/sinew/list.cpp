// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

#include <sinew/io/output_file.hpp>

#include <algorithm>
#include <cstdio>

namespace cli {

using sinew::text;

namespace {

// one class with all its instantiations
struct Entry {
  std::vector<sinew::ClassInfo const*> variants{};
  sinew::ClassInfo const& first() const { return *variants[0]; }

  std::string_view role() const { return enum_names(first().role)[std::size_t(first().role)]; }
  // "Vec3d, Rigid3d"; of what joins two bodies "Vec3d", too
  std::vector<std::string> dataTypes() const {
    std::vector<std::string> all;
    for (auto const* v : variants)
      if (!v->dataTypes.empty() && std::find(all.begin(), all.end(), v->dataTypes) == all.end())
        all.push_back(v->dataTypes);
    return all;
  }
  bool joins() const {
    return std::any_of(variants.begin(), variants.end(), [](auto const* v) { return v->joins; });
  }
  std::vector<std::string_view> fieldNames(bool inputs) const {
    std::vector<std::string_view> names;
    for (auto const* v : variants)
      for (auto const& f : v->fields)
        if (f.isInput == inputs && std::find(names.begin(), names.end(), f.name) == names.end())
          names.push_back(f.name);
    return names;
  }
};

std::string joined(std::vector<std::string> const& words, std::string_view between = ", ") {
  std::string all;
  for (auto const& word : words) all += text(all.empty() ? "" : between, word);
  return all;
}
std::string commas(std::string_view blankSeparated) {
  std::string all;
  sinew::for_each_name(blankSeparated,
                       [&](std::string_view name) { all += text(all.empty() ? "" : ", ", name); });
  return all;
}

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

// a field over all instantiations of its class
struct FieldWords {
  sinew::FieldInfo const* field = nullptr;
  std::vector<std::pair<std::string, std::string>> kinds{};     // and the DataTypes that have each
  std::vector<std::pair<std::string, std::string>> defaults{};  // likewise
  std::string unit, range;
};
void gather(std::vector<std::pair<std::string, std::string>>& to, std::string const& words,
            std::string const& over) {
  for (auto& [known, where] : to)
    if (known == words) {
      if (where.find(over) == where.npos) where += text(", ", over);
      return;
    }
  to.emplace_back(words, over);
}
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
// "number (Vec3d, Vec2d); mass, volume, inertia by mass (Rigid3d)"
std::string variants_text(std::vector<std::pair<std::string, std::string>> const& variants) {
  if (variants.size() == 1) return variants[0].first;
  std::string all;
  for (auto const& [words, where] : variants)
    all += text(all.empty() ? "" : "; ", words.empty() ? "none" : words, " (", where, ')');
  return all;
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

std::string title_of(sinew::RoleKind role) {
  using sinew::RoleKind;
  switch (role) {
    case RoleKind::context:
      return "Surroundings";
    case RoleKind::topology:
      return "Topologies";
    case RoleKind::state:
      return "States";
    case RoleKind::visualModel:
      return "Visual models";
    case RoleKind::mass:
      return "Masses";
    case RoleKind::forceField:
      return "Force fields";
    case RoleKind::interactionForceField:
      return "Forces between two bodies";
    case RoleKind::projectiveConstraint:
      return "Constraints";
    case RoleKind::mapping:
      return "Mappings";
    case RoleKind::odeSolver:
      return "ODE solvers";
    case RoleKind::linearSolver:
      return "Linear solvers";
    case RoleKind::stepCallback:
      return "Callbacks";
    case RoleKind::engine:
      return "Loaders, selections and other engines";
  }
  return {};
}
std::string explanation_of(sinew::RoleKind role) {
  using sinew::RoleKind;
  switch (role) {
    case RoleKind::context:
      return "What holds for a node and all below it.";
    case RoleKind::topology:
      return "Elements over the points of the state of the node.";
    case RoleKind::state:
      return "Positions and velocities of one body; at most one a node.";
    case RoleKind::visualModel:
      return "Surfaces that follow a mapping, to look at.";
    case RoleKind::mass:
      return "At most one a node; for the state of the node, or the nearest above.";
    case RoleKind::forceField:
      return "Act on the state of the node, or the nearest above.";
    case RoleKind::interactionForceField:
      return "Act between the states of two nodes, object1 and object2.";
    case RoleKind::projectiveConstraint:
      return "Take forbidden motions away; on a state that is not mapped.";
    case RoleKind::mapping:
      return "Make the state or the visual model of the node follow the state above.";
    case RoleKind::odeSolver:
      return "Integrate the node and all below it in time.";
    case RoleKind::linearSolver:
      return "Solve the systems of an implicit ODE solver.";
    case RoleKind::stepCallback:
      return "Called at the end of each step.";
    case RoleKind::engine:
      return "Make data, once, from files or other data; others link to it, as in "
             "position=\"@loader.position\".";
  }
  return {};
}

// the terminal

constexpr std::size_t width = 100;

// words after a margin, in lines that fit a terminal
std::string wrapped(std::string_view words, std::size_t margin) {
  std::string out;
  std::size_t column = margin;
  while (!words.empty()) {
    const std::size_t n = std::min(words.find(' '), words.size());
    if (column > margin && column + 1 + n > width)
      out += text('\n', std::string(margin, ' ')), column = margin;
    if (column > margin) out += ' ', ++column;
    out += words.substr(0, n);
    column += n;
    words.remove_prefix(std::min(n + 1, words.size()));
  }
  return out;
}
std::string padded(std::string_view word, std::size_t to) {
  return text(word, std::string(word.size() < to ? to - word.size() : 1, ' '));
}

void print_overview(std::vector<Entry> const& entries) {
  std::string out;
  std::string_view last;
  for (auto const& e : entries) {
    if (e.role() != last) out += text(last.empty() ? "" : "\n", title_of(e.first().role), '\n');
    last = e.role();
    const std::string types = joined(e.dataTypes(), " ");
    out += types.empty() ? text("  ", e.first().name, '\n')
                         : text("  ", padded(e.first().name, 36), wrapped(types, 38), '\n');
  }
  std::printf("%s\n'sinew list NAME' explains one.\n", out.c_str());
}

void print_field(std::string& out, FieldWords const& f, bool input) {
  auto line = [&](std::string_view label, std::string const& words) {
    if (!words.empty()) out += text("      ", padded(label, 10), wrapped(words, 16), '\n');
  };
  out += text("  ", f.field->name, '\n');
  out += text("      ", wrapped(f.field->documentation, 6), '\n');
  line("is", variants_text(f.kinds));
  line("unit", f.unit);
  line("range", f.range);
  if (input) line("default", variants_text(f.defaults));
  line("also", commas(f.field->aliases));
}

void print_page(Entry const& e) {
  auto const& c = e.first();
  std::string out = text(c.name,
                         ", ",
                         c.role == sinew::RoleKind::engine || c.role == sinew::RoleKind::odeSolver ||
                                 c.role == sinew::RoleKind::interactionForceField
                             ? "an "
                             : "a ",
                         e.role(),
                         "\n");
  out += text("  ", wrapped(explanation_of(c.role), 2), '\n');
  if (!c.aliases.empty()) out += text("  other names: ", wrapped(commas(c.aliases), 15), '\n');
  if (const auto types = e.dataTypes(); !types.empty())
    out += text("  template:    ", wrapped(joined(types, " "), 15), '\n');
  if (e.joins()) out += "  joins two bodies where object1 and object2 are given\n";
  if (const auto names = e.fieldNames(true); !names.empty()) {
    out += "\nattributes\n";
    for (auto name : names) print_field(out, words_of(e, name, true), true);
  } else {
    out += "\nno attributes\n";
  }
  if (const auto names = e.fieldNames(false); !names.empty()) {
    out += "\nmakes, for links\n";
    for (auto name : names) print_field(out, words_of(e, name, false), false);
  }
  std::fputs(out.c_str(), stdout);
}

// the reference page

std::string cell(std::string_view words) {
  std::string out;
  for (const char c : words) {
    if (c == '|' || c == '<' || c == '>' || c == '*' || c == '_') out += '\\';
    out += c;
  }
  return out;
}
// of kinds and defaults over many DataTypes, that of Vec3d, or of the first
std::string typical(std::vector<std::pair<std::string, std::string>> const& variants) {
  auto const* chosen = &variants[0];
  for (auto const& v : variants)
    if (v.second.find("Vec3d") != v.second.npos) chosen = &v;
  std::string words = chosen->first;
  if (words.size() > 40) words = words.substr(0, words.find(' ', 30)) + " ...";
  return words;
}

void table_of(std::string& out, Entry const& e, bool input) {
  const auto names = e.fieldNames(input);
  if (names.empty()) return;
  if (input)
    out += "\n| attribute | | unit | default | meaning |\n| --- | --- | --- | --- | --- |\n";
  else
    out += "\n| makes | | unit | meaning |\n| --- | --- | --- | --- |\n";
  for (auto name : names) {
    const FieldWords f = words_of(e, name, input);
    std::string meaning = cell(f.field->documentation);
    if (!f.range.empty()) meaning += text("; ", f.range);
    if (!f.field->aliases.empty()) {
      std::string also;
      sinew::for_each_name(f.field->aliases,
                           [&](std::string_view a) { also += text(also.empty() ? "" : ", ", '`', a, '`'); });
      meaning += text("; also ", also);
    }
    std::string kind = cell(typical(f.kinds));
    if (f.kinds.size() > 1) kind += " (by template)";
    out += text("| `", name, "` | ", kind, " | ", cell(f.unit), " | ");
    if (input) out += text(cell(typical(f.defaults)), " | ");
    out += text(meaning, " |\n");
  }
}

std::string markdown(std::vector<Entry> const& entries) {
  std::string out =
      "# Components\n\n"
      "Written by `sinew list --markdown` from the declarations of the components; do not edit it.\n\n"
      "Attributes are those of scene files. In C++ the same settings are members: `rest_position` is "
      "`restPosition`. "
      "Values are checked\nagainst their ranges when the scene is initialised. Kind and default are shown "
      "over `Vec3d` "
      "where they depend on the template;\n`sinew list NAME` shows them over all.\n";
  std::string_view last;
  for (auto const& e : entries) {
    auto const& c = e.first();
    if (e.role() != last) out += text("\n## ", title_of(c.role), "\n\n", explanation_of(c.role), '\n');
    last = e.role();
    out += text("\n### ", c.name, '\n');
    std::vector<std::string> facts;
    auto code = [](std::string_view names) {
      std::string all;
      sinew::for_each_name(names,
                           [&](std::string_view n) { all += text(all.empty() ? "" : ", ", '`', n, '`'); });
      return all;
    };
    if (const auto types = e.dataTypes(); !types.empty())
      facts.push_back(text("Over ", code(joined(types, " ")), "."));
    if (!c.aliases.empty()) facts.push_back(text("Other names: ", code(c.aliases), "."));
    if (e.joins()) facts.push_back("Joins two bodies where `object1` and `object2` are given.");
    if (e.fieldNames(true).empty()) facts.push_back("No attributes.");
    if (!facts.empty()) out += text('\n', joined(facts, " "), '\n');
    table_of(out, e, true);
    table_of(out, e, false);
  }
  return out;
}

}  // namespace

int list(ListOptions const& options) {
  const auto table = sinew::make_class_table<sinew::Standard>();
  const auto entries = entries_of(table);
  if (!options.markdown.empty()) {
    writing([&] { sinew::io::write_file(options.markdown, markdown(entries)); });
    return ok;
  }
  if (options.component.empty()) {
    print_overview(entries);
    return ok;
  }
  bool found = false;
  std::vector<std::string_view> names;
  for (auto const& e : entries) {
    auto same = [](std::string_view a, std::string_view b) { return sinew::edit_distance(a, b) == 0; };
    bool asked = same(e.first().name, options.component);
    names.push_back(e.first().name);
    sinew::for_each_name(e.first().aliases, [&](std::string_view alias) {
      names.push_back(alias);
      asked = asked || same(alias, options.component);
    });
    if (!asked) continue;
    if (found) std::printf("\n");
    print_page(e);
    found = true;
  }
  if (found) return ok;
  const std::string nearest = sinew::nearest_name(options.component, names);
  throw Failure{badUsage,
                {text("sinew list: there is no component '",
                      options.component,
                      "'",
                      nearest.empty() ? std::string("; 'sinew list' shows all")
                                      : text("; did you mean '", nearest, "'?"))}};
}

}  // namespace cli
