// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/value_numbers.hpp>
#include <sinew/runtime/any_component.hpp>
#include <sinew/runtime/cpp_text.hpp>
#include <sinew/runtime/value_text.hpp>

#include <array>
#include <charconv>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// What can be done with the values of a type, known by their addresses.
struct ValueType {
  std::string (*kind)();  // "number", "list of points", ...
  void (*read)(void* value, std::string_view words);
  std::string (*write)(void const* value);
  std::string (*cpp)(void const* value);
  bool isFile;
  std::span<std::string_view const> choices;  // the words of an enumeration; none where it is none
  std::size_t (*entries)(void const* value);  // of a list; 1 of anything else
  bool listOfLists = false;
  NumberAccess numbers{};
};

/// What scene files, messages and reference pages know of one field of a class.
struct FieldInfo : FieldWords {
  ValueType const* type;
  std::ptrdiff_t offset;  // of the value in a component
  bool isInput;
  std::string kind, defaultValue;  // in words
  bool isFile = type->isFile;

  void read(void* component, std::string_view words) const {
    type->read(static_cast<char*>(component) + offset, words);
  }
  std::string write(void const* component) const {
    return type->write(static_cast<char const*>(component) + offset);
  }
  std::string cpp(void const* component) const {
    return type->cpp(static_cast<char const*>(component) + offset);
  }
  /// Of a field of files: the one that a value names, which may have blanks, or those of a list.
  std::vector<std::string> fileNames(std::string_view value) const {
    Words words(value);
    if (!kind.starts_with("list of")) return {std::string(words.rest())};
    std::vector<std::string> names;
    while (!words.end()) names.emplace_back(words.next());
    return names;
  }
  bool known(std::string_view asked) const { return asked == name || has_name(aliases, asked); }
  /// Of a list of lists, of which scene files have one under each number: "position1", "position2"... Which
  /// of them a name means, from 0; -1 where it means none.
  int numberOf(std::string_view asked) const {
    const std::size_t digits = asked.find_last_not_of("0123456789") + 1;
    const std::string_view base = name.substr(0, name.size() - 1);
    if (!type->listOfLists || !name.ends_with('1') || asked.substr(0, digits) != base) return -1;
    int number = 0;
    const auto [end, error] = std::from_chars(asked.data() + digits, asked.data() + asked.size(), number);
    return error == std::errc{} && end == asked.data() + asked.size() && asked[digits] != '0' &&
                   number <= 100000
               ? number - 1
               : -1;
  }
};

/// What a class says of itself, as static members of these names, to those who know it by its name only.
struct ClassTraits {
  std::string_view header;          // to include beside sinew.hpp, which does not have the class
  std::string_view endings;         // of the files that a loader of meshes reads: ".vtk .vtu"
  bool samePoints = false;          // point i below a mapping is point i above it
  bool movesState = false;          // where no solver does
  bool movesWithoutSolver = false;  // the same, of all that may: a constraint that puts points to places, too
  bool changesPoints = false;       // by changePoints: a state in its node may start without points
  bool takenByDefault = false;      // by a scene that has to have one of its role and has none
  bool ofPositions = false;         // an engine over points as they are, where others take those at rest
  bool sizedValues = false;         // an engine over values of any size (engine/values.hpp)
  std::string_view law;             // an output of an engine that goes on in each step, by what takes it
  bool overElements = false;        // a collision model that is nothing without elements
  bool joinsTopologies = false;  // an engine that makes the elements of its `output` of those of its `input`
  std::string_view followsObject2;  // the field that has the positions of the state that `object2` names
};

/// What scene files, messages and reference pages know of one class of a registry.
struct ClassInfo {
  int type;  // place in the registry
  std::string_view name, aliases;
  RoleKind role;
  std::string dataTypes;  // "Vec3d"; "Rigid3d,Vec3d" of a mapping; the matrix of a linear solver; or nothing
  std::string_view in, in2, out;  // of a mapping; in2: of the second of its two parents
  std::string cppName;            // "UniformMass<Vec3d>"
  bool joins = false;             // has ends object1 and object2
  std::vector<FieldInfo> fields;
  bool severalParents = false;  // a mapping
  ClassTraits traits{};

  bool known(std::string_view asked) const { return asked == name || has_name(aliases, asked); }
  FieldInfo const* field(std::string_view asked) const {
    for (auto const& f : fields)
      if (f.known(asked)) return &f;
    return nullptr;
  }
};

namespace detail {

/// What a value is, in a word or two.
template <class T>
std::string kind_of() {
  if constexpr (std::is_same_v<T, bool>)
    return "yes or no";
  else if constexpr (std::is_enum_v<T>) {
    std::string names;
    for (auto name : enum_names(T{})) names += text(names.empty() ? "" : ", ", name);
    return names;
  } else if constexpr (std::is_integral_v<T>)
    return "whole number";
  else if constexpr (std::is_arithmetic_v<T>)
    return "number";
  else if constexpr (std::is_same_v<T, std::string>)
    return "text";
  else if constexpr (std::is_same_v<T, DataFile>)
    return "file";
  else if constexpr (requires(T v) { v.has_value(); })
    return text(kind_of<typename T::value_type>(), ", or none");
  else if constexpr (requires(T v) { v.inertia; })
    return "mass, volume, inertia by mass";
  else if constexpr (HasKeywords<T>) {
    std::string parts(T::bracket[0]);
    for_each_field_of<T>([&](auto const& fd) {
      parts += ' ';
      if (!fd.aliases.empty()) parts += text(fd.aliases, ' ');
      parts += fd.name;
    });
    return text(parts, ' ', T::bracket[1]);
  } else if constexpr (HasFields<T>) {
    std::string parts;
    for_each_field_of<T>([&](auto const& fd) { parts += text(parts.empty() ? "" : " ", fd.name); });
    return parts;
  } else if constexpr (requires(T v) {
                         v.center;
                         v.orientation;
                       })
    return requires(T v) { v.orientation.coeffs(); } ? "centre, quaternion" : "centre, angle";
  else if constexpr (is_eigen<T>)
    return text(int(T::SizeAtCompileTime), " numbers");
  else if constexpr (DynamicList<T>)
    return text("list of ", kind_of<typename T::value_type>());
  else
    return text(std::tuple_size_v<T>, " of ", kind_of<typename T::value_type>());
}

template <class T>
inline constexpr auto choices_of = [] {
  if constexpr (std::is_enum_v<T>)
    return enum_names(T{});
  else
    return std::array<std::string_view, 0>{};
}();

template <class T>
inline constexpr ValueType value_type{
    &kind_of<T>,
    [](void* value, std::string_view words) { read_value(words, *static_cast<T*>(value)); },
    [](void const* value) { return write_value(*static_cast<T const*>(value)); },
    [](void const* value) { return cpp_value(*static_cast<T const*>(value)); },
    std::is_same_v<T, DataFile> || std::is_same_v<T, std::vector<DataFile>>,
    choices_of<T>,
    [](void const* value) {
      if constexpr (DynamicList<T>)
        return static_cast<T const*>(value)->size();
      else
        return std::size_t(value != nullptr);
    },
    ListOfLists<T>,
    number_access<T>()};

/// What is said of one field in a table of a class.
struct FieldRow {
  FieldWords const* words;
  ValueType const* type;
  bool isInput;
};
inline constexpr FieldWords meshFields[] = {{.name = "position",
                                             .unit = "",
                                             .documentation = "vertices of the surface",
                                             .range = range::any,
                                             .live = true},
                                            {"edges", "", "edges of the surface", range::any},
                                            {"triangles", "", "triangles of the surface", range::any},
                                            {"quads", "", "quads of the surface", range::any}};

template <class C>
inline constexpr auto state_fields_of_class = [] {
  if constexpr (requires { C::state(); })
    return C::state();
  else
    return field_list();
}();
template <class C>
inline constexpr auto outputs_of_class = [] {
  if constexpr (requires { C::outputs(); })
    return C::outputs();
  else
    return field_list();
}();
template <class C>
concept HoldsMesh = requires(C c) { c.mesh.positions; };

template <auto const& List>
inline constexpr std::size_t length_of = decltype(boost::hana::length(List))::value;
// of what scene files know of a class, in this order: fields, state, outputs; a component that holds a Mesh
// has fields for the lists of the mesh behind them
template <class C>
inline constexpr std::size_t field_count =
    length_of<fields_of_class<C>> + length_of<state_fields_of_class<C>> + length_of<outputs_of_class<C>> +
    (HoldsMesh<C> ? std::size(meshFields) : 0);

// Constants of each class, and one function that knows where its values are, so that a class costs the
// compiler little. nvcc 13 takes neither a lambda that captures in the initializer of a variable nor one that
// is instantiated there in another.
template <class C>
struct AddFieldRows {
  FieldRow*& next;
  bool isInput;

  template <class... F>
  constexpr void operator()(F const&... fd) const {
    ((*next++ = {&fd, &value_type<std::decay_t<decltype(std::declval<C&>().*fd.member)>>, isInput}), ...);
  }
};
template <class C>
constexpr auto make_field_rows() {
  std::array<FieldRow, field_count<C>> rows{};
  FieldRow* next = rows.data();
  boost::hana::unpack(fields_of_class<C>, AddFieldRows<C>{next, true});
  boost::hana::unpack(state_fields_of_class<C>, AddFieldRows<C>{next, true});
  boost::hana::unpack(outputs_of_class<C>, AddFieldRows<C>{next, false});
  if constexpr (HoldsMesh<C>) {
    [[maybe_unused]] ValueType const* const types[] = {&value_type<decltype(Mesh::positions)>,
                                                       &value_type<decltype(Mesh::edges)>,
                                                       &value_type<decltype(Mesh::triangles)>,
                                                       &value_type<decltype(Mesh::quads)>};
    for (std::size_t k = 0; k < std::size(meshFields); ++k) *next++ = {&meshFields[k], types[k], true};
  }
  return rows;
}
template <class C>
inline constexpr auto field_rows = make_field_rows<C>();
template <class C>
void field_addresses(void const* component, void const** to) {
  C const& c = *static_cast<C const*>(component);
  const auto add = [&](auto const&... fd) { ((*to++ = std::addressof(c.*fd.member)), ...); };
  boost::hana::unpack(fields_of_class<C>, add);
  boost::hana::unpack(state_fields_of_class<C>, add);
  boost::hana::unpack(outputs_of_class<C>, add);
  if constexpr (HoldsMesh<C>)
    for (void const* list : {static_cast<void const*>(&c.mesh.positions),
                             static_cast<void const*>(&c.mesh.edges),
                             static_cast<void const*>(&c.mesh.triangles),
                             static_cast<void const*>(&c.mesh.quads)})
      *to++ = list;
}

template <class C>
constexpr bool moves_without_solver() {
  if constexpr (HasRole<C, role::ProjectiveConstraint> && !JoinsTwo<C>)
    return requires(C c, typename C::DataTypes::VecCoord x) { c.projectPosition(0.0, x); };
  else
    return ActsBeforeStep<C> && named::beginStep<C>;
}
template <class C>
constexpr ClassTraits class_traits() {
  ClassTraits traits{};
  if constexpr (requires { C::header; }) traits.header = C::header;
  if constexpr (requires { C::endings; }) traits.endings = C::endings;
  if constexpr (requires { C::samePoints; }) traits.samePoints = C::samePoints;
  if constexpr (requires { C::movesState; }) traits.movesState = C::movesState;
  traits.movesWithoutSolver = traits.movesState || moves_without_solver<C>();
  traits.changesPoints = ChangesPoints<C>;
  if constexpr (requires { C::takenByDefault; }) traits.takenByDefault = C::takenByDefault;
  if constexpr (requires { C::ofPositions; }) traits.ofPositions = C::ofPositions;
  if constexpr (requires { C::sizedValues; }) traits.sizedValues = C::sizedValues;
  if constexpr (requires { C::law; }) traits.law = C::law;
  if constexpr (requires { C::overElements; }) traits.overElements = C::overElements;
  if constexpr (requires { C::joinsTopologies; }) traits.joinsTopologies = C::joinsTopologies;
  if constexpr (requires { C::followsObject2; }) traits.followsObject2 = C::followsObject2;
  return traits;
}

struct ClassRow {
  std::string_view name, aliases, dataTypes, in, in2, out;
  RoleKind role;
  bool joins, severalParents;
  ClassTraits traits;
  FieldRow const* fields;
  std::size_t count;
  void (*addresses)(void const* component, void const** to);
};
template <class C>
constexpr ClassRow class_row() {
  ClassRow row{.name = C::className,
               .aliases = class_aliases<C>(),
               .dataTypes = {},
               .in = {},
               .in2 = {},
               .out = {},
               .role = role_kind<typename C::Role>(),
               .joins = HasLinkedEnds<C>,
               .severalParents = HasLinkedParents<C>,
               .traits = class_traits<C>(),
               .fields = field_rows<C>.data(),
               .count = field_count<C>,
               .addresses = &field_addresses<C>};
  if constexpr (requires { typename C::In; }) {
    row.in = data_types_name<typename C::In>::value;
    row.out = data_types_name<typename C::Out>::value;
    if constexpr (requires { typename C::In2; }) row.in2 = data_types_name<typename C::In2>::value;
  } else if constexpr (requires { C::templateName; }) {
    row.dataTypes = C::templateName;
  } else if constexpr (requires { typename C::DataTypes; } && !HasRole<C, role::VisualModel>) {
    row.dataTypes = data_types_name<typename C::DataTypes>::value;
  }
  return row;
}
template <class... Cs>
constexpr auto class_rows(TypeList<Cs...>) {
  return std::array<ClassRow, sizeof...(Cs)>{class_row<Cs>()...};
}

/// `defaults`: a component of the class as it is made.
inline ClassInfo class_info(int type, ClassRow const& row, std::string cppName, void const* defaults) {
  ClassInfo info{.type = type,
                 .name = row.name,
                 .aliases = row.aliases,
                 .role = row.role,
                 .dataTypes = row.in.empty()    ? std::string(row.dataTypes)
                              : row.in2.empty() ? text(row.in, ',', row.out)
                                                : text(row.in, ',', row.in2, ',', row.out),
                 .in = row.in,
                 .in2 = row.in2,
                 .out = row.out,
                 .cppName = row.role == RoleKind::visualModel ? std::string(row.name) : std::move(cppName),
                 .joins = row.joins,
                 .fields = {},
                 .severalParents = row.severalParents,
                 .traits = row.traits};
  std::vector<void const*> values(row.count);
  row.addresses(defaults, values.data());
  for (std::size_t k = 0; k < row.count; ++k) {
    FieldRow const& field = row.fields[k];
    info.fields.push_back({*field.words,
                           field.type,
                           static_cast<char const*>(values[k]) - static_cast<char const*>(defaults),
                           field.isInput,
                           field.type->kind(),
                           field.type->write(values[k])});
  }
  return info;
}

}  // namespace detail

/// All classes of a registry, in its order.
template <class R>
std::vector<ClassInfo> make_class_table() {
  static constexpr auto rows = detail::class_rows(typename AnyComponent<R>::List{});
  std::vector<ClassInfo> table;
  for (auto const& row : rows) {
    const int type = int(table.size());
    const auto defaults = AnyComponent<R>::make(type);
    table.push_back(detail::class_info(type, row, defaults.name(), defaults.address()));
  }
  return table;
}

/// "Vec3d" for the names that scenes use for a template: Vec3, Vec3d, ExtVec3f, Rigid, Rigid3, ..., and
/// "CudaVec3f" for CudaVec3; a mapping's two are apart by a comma; the matrices of linear solvers.
inline std::string canonical_template(std::string_view name) {
  if (const std::size_t comma = name.find(','); comma != name.npos) {
    std::string_view second = name.substr(comma + 1);
    while (second.starts_with(' ')) second.remove_prefix(1);
    return text(canonical_template(name.substr(0, comma)), ',', canonical_template(second));
  }
  if (name.starts_with("ExtVec"))
    return text("Vec", name[name.size() - (name.ends_with('f') || name.ends_with('d') ? 2 : 1)], 'f');
  if (name.starts_with("StdVec") || name.starts_with("StdRigid")) name.remove_prefix(3);
  if (name == "Rigid") return "Rigid3d";
  if (name.starts_with("Parallel")) name.remove_prefix(8);
  if (name == "GraphScattered") return "GraphScattered";
  if (name.starts_with("CompressedRowSparseMatrix")) {
    const bool isFloat = name.ends_with('f');
    const bool blocks = name.find("3x3") != name.npos || name.find("Mat3") != name.npos;
    return text("CompressedRowSparseMatrix", blocks ? "Mat3x3" : "", isFloat ? "f" : "d");
  }
  if (name.starts_with("FullMatrix") || name.starts_with("SparseMatrix") || name.starts_with("FullVector") ||
      name.starts_with("BTDMatrix"))
    return "CompressedRowSparseMatrixd";
  if (name == "CudaVec3" || name == "CudaRigid3") return text(name, 'f');
  if (!name.empty() && name.back() >= '0' && name.back() <= '9' &&
      (name.starts_with("Vec") || name.starts_with("Rigid")))
    return text(name, 'd');
  return std::string(name);
}

}  // namespace sinew
