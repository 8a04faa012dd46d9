// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/error.hpp>
#include <sinew/view/scene_tree.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::view {

/// A field of a component, in words.
struct SeenField {
  std::string name{};
  std::string value{};                 // nothing of a list that is too long to be looked at
  std::size_t entries = 1;             // of a list
  bool whole = true;                   // whether value is all of it
  std::string kind{};                  // "number", "list of 3 numbers", ...
  std::vector<std::string> choices{};  // the words that it may have, where these are few
  std::string unit{}, help{};
  Range range{};
  std::string rangeWords{};  // "at least 0"
  std::string defaultValue{};
  bool isInput = true;  // otherwise a component has made it
  std::string fixed{};  // why it cannot be changed here; empty: it can
};

/// A component, as one sees it who has selected it.
struct SeenComponent {
  int line = -1;  // in the tree
  std::string path{}, name{}, className{}, role{};
  std::vector<SeenField> fields{};
};

/// A value that a field has been given, and the one before, so that it can be taken back.
struct FieldChange {
  int line = -1;
  std::string field{}, before{}, after{};
};

namespace detail {

/// Whether a field is the path of a file or folder, to read or to write.
inline bool names_file(FieldInfo const& field) {
  return field.isFile || (field.kind == "text" && field.name.starts_with("file"));
}

/// Why a field keeps its value while a scene runs; empty where it may have another.
inline std::string why_fixed(FoundLine const& line, FieldInfo const& field) {
  if (!field.isInput) return "the component makes it";
  if (names_file(field)) return "files are read and written by the scene as it starts";
  ClassInfo const& info = *line.info;
  auto has_file = [&] { return std::any_of(info.fields.begin(), info.fields.end(), names_file); };
  switch (info.role) {
    case RoleKind::engine:
      return "an engine works with what it was given when the scene was read, and with what its links lead "
             "to";
    case RoleKind::execution:
      return "its threads work already";
    case RoleKind::stepCallback:
      if (has_file()) return "its file is open already";
      break;
    case RoleKind::state:
      if (line.mapped) return "the state follows a mapping";
      for (std::string_view changes :
           {"position", "velocity", "rest_position", "reset_position", "reset_velocity"})
        if (field.name == changes) return {};
      return "it says where a scene starts";
    case RoleKind::visualModel:
      if (line.mapped) return "the model follows a mapping";
      break;
    default:
      break;
  }
  return {};
}

/// Whether others are initialised again with a component of this role, since they stand on it.
constexpr bool carries_others(RoleKind role) {
  return role == RoleKind::topology || role == RoleKind::state || role == RoleKind::visualModel ||
         role == RoleKind::mapping || role == RoleKind::mass;
}
constexpr bool stands_on_others(RoleKind role) {
  return carries_others(role) || role == RoleKind::forceField || role == RoleKind::interactionForceField ||
         role == RoleKind::projectiveConstraint || role == RoleKind::lagrangianConstraint ||
         role == RoleKind::constraintCorrection || role == RoleKind::collisionModel;
}

template <class Root>
FoundLine find_component(Root& root, int number) {
  std::optional<FoundLine> found;
  int n = 0;
  for_each_line(root, [&](FoundLine const& line) {
    if (n++ == number) found = line;
  });
  if (!found || !found->info)
    throw Error("fields", text("line ", number, " of the tree of the scene has no component; take another"));
  return *found;
}
inline std::string label_of(FoundLine const& line) {
  const bool named = !line.name.empty() && !line.info->known(line.name);
  return text(line.path, ": ", line.className, named ? text(" '", line.name, "'") : std::string());
}
inline FieldInfo const& find_field(FoundLine const& line, std::string_view name) {
  if (FieldInfo const* field = line.info->field(name)) return *field;
  std::vector<std::string_view> known;
  for (FieldInfo const& field : line.info->fields) known.push_back(field.name);
  const std::string nearest = nearest_name(name, known);
  throw Error(label_of(line),
              text("there is no field ",
                   sinew::detail::shown(name),
                   nearest.empty() ? std::string("; choose one of its fields")
                                   : text("; did you mean '", nearest, "'?")));
}
// f(component) for those of a role in and below a node
template <class Role, class Node, class F>
void for_each_of_role(Node& node, F& f) {
  if constexpr (is_runtime_node<Node>) {
    for (auto& entry : node.components()) entry.component.template visit<Role>(f);
    for (auto& child : node.children()) for_each_of_role<Role>(*child, f);
  } else {
    node.forEachComponent(on<Role>([&](auto& component) { f(component); }));
    boost::hana::for_each(node.children, [&](auto& child) { for_each_of_role<Role>(child, f); });
  }
}
// Contacts and what is held go on
template <class Root>
void keep_contacts(Root& root) {
  auto keep = [](auto& manager) {
    static const Renumbering none{};
    manager.follow([](int) -> Renumbering const& { return none; });
  };
  for_each_of_role<role::ContactManager>(root, keep);
}

}  // namespace detail

/// Lists of more entries than this are counted, and not written out.
inline constexpr std::size_t longest_list = 64;

/// The component at a line of the tree of a simulation, with its fields as they are now. Throws Error where
/// there is none.
template <class Simulation>
SeenComponent seen_component(Simulation& simulation, int line) {
  const FoundLine found = detail::find_component(simulation.root(), line);
  SeenComponent seen{.line = line,
                     .path = found.path,
                     .name = found.name,
                     .className = found.className,
                     .role = std::string(enum_names(found.info->role)[std::size_t(found.info->role)])};
  for (FieldInfo const& field : found.info->fields) {
    if (found.info->field(field.name) != &field) continue;  // a list that is given, and made where it is not
    SeenField one{.name = std::string(field.name),
                  .kind = field.kind,
                  .unit = std::string(field.unit),
                  .help = std::string(field.documentation),
                  .range = field.range,
                  .rangeWords = sinew::detail::range_text(field.range),
                  .defaultValue = field.defaultValue,
                  .isInput = field.isInput,
                  .fixed = detail::why_fixed(found, field)};
    one.entries = field.type->entries(static_cast<char const*>(found.component) + field.offset);
    one.whole = one.entries <= longest_list;
    if (one.whole) one.value = field.write(found.component);
    if (one.defaultValue.size() > 200) one.defaultValue.clear();
    for (std::string_view choice : field.type->choices) one.choices.emplace_back(choice);
    if (field.kind == "yes or no") one.choices = {"0", "1"};
    seen.fields.push_back(std::move(one));
  }
  return seen;
}

/// The whole value of a field, however long. Throws Error where there is none of this name.
template <class Simulation>
std::string field_text(Simulation& simulation, int line, std::string_view name) {
  const FoundLine found = detail::find_component(simulation.root(), line);
  return detail::find_field(found, name).write(found.component);
}

/// Gives a field another value, in the words of a scene file, and returns what has changed. All that stands
/// on it is initialised again; contacts and what is held go on. Throws Error, as a scene file would, where
/// the words are none of the kind of the field, out of its range, or make no scene: nothing has changed then.
template <class Simulation>
FieldChange set_field(Simulation& simulation, int line, std::string_view name, std::string_view words) {
  FieldChange change{.line = line};
  simulation.change([&](auto& root) {
    const FoundLine found = detail::find_component(root, line);
    FieldInfo const& field = detail::find_field(found, name);
    const std::string where = detail::label_of(found);
    if (const std::string why = detail::why_fixed(found, field); !why.empty())
      throw Error(where, text(field.name, " cannot be changed while the scene is there: ", why));
    change.field = field.name;
    change.before = field.write(found.component);
    auto entriesOf = [&] {
      return field.type->entries(static_cast<char const*>(found.component) + field.offset);
    };
    const std::size_t entriesBefore = entriesOf();
    try {
      field.read(found.component, words);
    } catch (Error const& error) {
      throw Error(where, text(field.name, ": ", error.what()));
    }
    const std::size_t entries = entriesOf();
    if (found.info->role == RoleKind::state && entries != entriesBefore)
      throw Error(where,
                  text(field.name,
                       ": here are ",
                       entries,
                       " entries for a state of ",
                       entriesBefore,
                       " points; give one for each"));
    change.after = field.write(found.component);
    detail::keep_contacts(root);
    std::vector<void const*> touched{found.component};
    if (detail::carries_others(found.info->role))
      for_each_line(root, [&](FoundLine const& other) {
        if (other.info && detail::stands_on_others(other.info->role)) touched.push_back(other.component);
      });
    return touched;
  });
  return change;
}

}  // namespace sinew::view
