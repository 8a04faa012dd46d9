// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/any_component.hpp>
#include <sinew/runtime/cpp_text.hpp>
#include <sinew/runtime/value_text.hpp>

#include <array>
#include <cstddef>
#include <memory>
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
  bool known(std::string_view asked) const {
    bool found = asked == name;
    for_each_name(aliases, [&](std::string_view alias) { found = found || alias == asked; });
    return found;
  }
};

/// The role of a class, as a value.
enum class RoleKind {
  context,
  topology,
  state,
  visualModel,
  mass,
  forceField,
  interactionForceField,
  projectiveConstraint,
  mapping,
  odeSolver,
  linearSolver,
  stepCallback,
  engine,
  collisionPipeline,
  broadPhase,
  narrowPhase,
  intersection,
  contactManager,
  collisionModel,
  carving,
  execution
};
inline constexpr std::array<std::string_view, 21> enum_names(RoleKind) {
  return {"context",
          "topology",
          "state",
          "visual model",
          "mass",
          "force field",
          "interaction force field",
          "projective constraint",
          "mapping",
          "ODE solver",
          "linear solver",
          "step callback",
          "engine",
          "collision pipeline",
          "broad phase",
          "narrow phase",
          "intersection method",
          "contact manager",
          "collision model",
          "carving",
          "execution"};
}
template <class Role>
constexpr RoleKind role_kind() {
  int i = 0, found = -1;
  auto is = [&]<class K>() { (std::is_same_v<Role, K> ? found = i : found), ++i; };
  is.template operator()<role::Context>();
  is.template operator()<role::Topology>();
  is.template operator()<role::State>();
  is.template operator()<role::VisualModel>();
  is.template operator()<role::Mass>();
  is.template operator()<role::ForceField>();
  is.template operator()<role::InteractionForceField>();
  is.template operator()<role::ProjectiveConstraint>();
  is.template operator()<role::Mapping>();
  is.template operator()<role::OdeSolver>();
  is.template operator()<role::LinearSolver>();
  is.template operator()<role::StepCallback>();
  is.template operator()<role::Engine>();
  is.template operator()<role::CollisionPipeline>();
  is.template operator()<role::BroadPhase>();
  is.template operator()<role::NarrowPhase>();
  is.template operator()<role::Intersection>();
  is.template operator()<role::ContactManager>();
  is.template operator()<role::CollisionModel>();
  is.template operator()<role::Carving>();
  is.template operator()<role::Execution>();
  return RoleKind(found);
}

/// What scene files, messages and reference pages know of one class of a registry.
struct ClassInfo {
  int type;  // place in the registry
  std::string_view name, aliases;
  RoleKind role;
  std::string dataTypes;  // "Vec3d"; "Rigid3d,Vec3d" of a mapping; the matrix of a linear solver; or nothing
  std::string_view in, out;  // of a mapping
  std::string cppName;       // "UniformMass<Vec3d>"
  bool joins = false;        // has ends object1 and object2
  std::vector<FieldInfo> fields;
  bool severalParents = false;  // a mapping

  bool known(std::string_view asked) const {
    bool found = asked == name;
    for_each_name(aliases, [&](std::string_view alias) { found = found || alias == asked; });
    return found;
  }
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
  else if constexpr (HasFields<T>) {
    std::string parts;
    for_each_field_of<T>([&](auto const& fd) { parts += text(parts.empty() ? "" : " ", fd.name); });
    return parts;
  } else if constexpr (requires(T v) {
                         v.center;
                         v.orientation;
                       })
    return requires(T v) { v.orientation.coeffs(); }
  ? "centre, quaternion" : "centre, angle";
  else if constexpr (is_eigen<T>) return text(int(T::SizeAtCompileTime), " numbers");
  else if constexpr (DynamicList<T>) return text("list of ", kind_of<typename T::value_type>());
  else return text(std::tuple_size_v<T>, " of ", kind_of<typename T::value_type>());
}

template <class T>
inline constexpr ValueType value_type{
    &kind_of<T>,
    [](void* value, std::string_view words) { read_value(words, *static_cast<T*>(value)); },
    [](void const* value) { return write_value(*static_cast<T const*>(value)); },
    [](void const* value) { return cpp_value(*static_cast<T const*>(value)); },
    std::is_same_v<T, DataFile>};

/// Adds fields of a class to what is known of it, from a component that holds the defaults.
struct FieldsOf {
  ClassInfo& info;
  void const* component;
  bool isInput;

  template <class T>
  void add(FieldWords const& words, T const& value) const {
    add(words, value_type<T>, std::addressof(value));
  }
  template <class C, class List>
  void addAll(C const& owner, List const& list) const {
    boost::hana::unpack(list, [&](auto const&... fd) { (add(fd, owner.*fd.member), ...); });
  }

 private:
  void add(FieldWords const& words, ValueType const& type, void const* value) const {
    info.fields.push_back({words,
                           &type,
                           static_cast<char const*>(value) - static_cast<char const*>(component),
                           isInput,
                           type.kind(),
                           type.write(value)});
  }
};

template <class C>
ClassInfo class_info(int type) {
  ClassInfo info{type,
                 C::className,
                 class_aliases<C>(),
                 role_kind<typename C::Role>(),
                 {},
                 {},
                 {},
                 component_name<C>(),
                 false,
                 {}};
  if constexpr (requires { typename C::In; }) {
    info.in = data_types_name<typename C::In>::value;
    info.out = data_types_name<typename C::Out>::value;
    info.dataTypes = text(info.in, ',', info.out);
  } else if constexpr (requires { C::templateName; }) {
    info.dataTypes = std::string(C::templateName);
  } else if constexpr (requires { typename C::DataTypes; } && !HasRole<C, role::VisualModel>) {
    info.dataTypes = std::string(data_types_name<typename C::DataTypes>::value);
  }
  if constexpr (HasRole<C, role::VisualModel>) info.cppName = std::string(C::className);
  if constexpr (requires(C c) { c.ends.object1; }) info.joins = true;
  info.severalParents = requires(C c) { c.parents.paths; };
  const C defaults{};
  const FieldsOf inputs{info, &defaults, true}, outputs{info, &defaults, false};
  inputs.addAll(defaults, fields_of_class<C>);
  if constexpr (requires { C::state(); }) inputs.addAll(defaults, C::state());
  if constexpr (requires { C::outputs(); }) outputs.addAll(defaults, C::outputs());
  // a component that holds a Mesh has fields for the lists of the mesh
  if constexpr (requires { defaults.mesh.positions; }) {
    inputs.add({"position", "", "vertices of the surface", range::any}, defaults.mesh.positions);
    inputs.add({"edges", "", "edges of the surface", range::any}, defaults.mesh.edges);
    inputs.add({"triangles", "", "triangles of the surface", range::any}, defaults.mesh.triangles);
    inputs.add({"quads", "", "quads of the surface", range::any}, defaults.mesh.quads);
  }
  return info;
}

}  // namespace detail

/// All classes of a registry, in its order.
template <class R>
std::vector<ClassInfo> make_class_table() {
  std::vector<ClassInfo> table;
  for_each_registered<R>([&]<class C>() { table.push_back(detail::class_info<C>(int(table.size()))); });
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
  if (name.starts_with("FullMatrix") || name.starts_with("SparseMatrix") || name.starts_with("FullVector"))
    return "CompressedRowSparseMatrixd";
  if (name == "CudaVec3" || name == "CudaRigid3") return text(name, 'f');
  if (!name.empty() && name.back() >= '0' && name.back() <= '9' &&
      (name.starts_with("Vec") || name.starts_with("Rigid")))
    return text(name, 'd');
  return std::string(name);
}

}  // namespace sinew
