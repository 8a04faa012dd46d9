// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/any_component.hpp>
#include <sinew/runtime/cpp_text.hpp>
#include <sinew/runtime/value_text.hpp>

#include <array>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// A field of a class whose components are known by their addresses.
struct FieldAccess : FieldWords {
  std::string (*kind)();  // "number", "list of points", ...
  bool isFile = false, isInput = true;
  void (*read)(void* component, std::string_view words);
  std::string (*write)(void const* component);
  std::string (*cpp)(void const* component);
};

/// What scene files, messages and reference pages know of one field of a class.
struct FieldInfo : FieldAccess {
  std::string kind, defaultValue;  // in words

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

// a field of a component that holds a Mesh stands for the lists of the mesh
template <class C, auto List>
constexpr FieldAccess mesh_field(std::string_view name, std::string_view documentation) {
  using T = std::decay_t<decltype(std::declval<C>().mesh.*List)>;
  return {{.name = name, .unit = "", .documentation = documentation, .range = range::any},
          &kind_of<T>,
          false,
          true,
          [](void* c, std::string_view words) { read_value(words, static_cast<C*>(c)->mesh.*List); },
          [](void const* c) { return write_value(static_cast<C const*>(c)->mesh.*List); },
          [](void const* c) { return cpp_value(static_cast<C const*>(c)->mesh.*List); }};
}

enum class FieldList { inputs, state, outputs };
template <class C, FieldList Which>
constexpr auto fields_of() {
  if constexpr (Which == FieldList::inputs)
    return C::fields();
  else if constexpr (Which == FieldList::state)
    return C::state();
  else
    return C::outputs();
}

template <class C, FieldList Which>
inline constexpr auto list_of_fields = fields_of<C, Which>();

template <class C, FieldList Which, std::size_t I>
constexpr FieldAccess field_access() {
  constexpr auto const& fd = boost::hana::at_c<I>(list_of_fields<C, Which>);
  using T = std::decay_t<decltype(std::declval<C>().*(fd.member))>;
  return {fd,
          &kind_of<T>,
          std::is_same_v<T, DataFile>,
          Which != FieldList::outputs,
          [](void* c, std::string_view words) { read_value(words, static_cast<C*>(c)->*fd.member); },
          [](void const* c) { return write_value(static_cast<C const*>(c)->*fd.member); },
          [](void const* c) { return cpp_value(static_cast<C const*>(c)->*fd.member); }};
}

inline void add_fields(ClassInfo& info, std::span<FieldAccess const> fields, void const* defaults) {
  for (FieldAccess const& f : fields) info.fields.push_back({f, f.kind(), f.write(defaults)});
}

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
  auto add = [&]<FieldList Which>() {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      static constexpr std::array<FieldAccess, sizeof...(I)> fields{field_access<C, Which, I>()...};
      add_fields(info, fields, &defaults);
    }
    (std::make_index_sequence<decltype(boost::hana::length(list_of_fields<C, Which>))::value>{});
  };
  add.template operator()<FieldList::inputs>();
  if constexpr (requires { C::state(); }) add.template operator()<FieldList::state>();
  if constexpr (requires { C::outputs(); }) add.template operator()<FieldList::outputs>();
  if constexpr (requires(C c) { c.mesh.positions; }) {
    static constexpr std::array<FieldAccess, 4> lists{
        mesh_field<C, &Mesh::positions>("position", "vertices of the surface"),
        mesh_field<C, &Mesh::edges>("edges", "edges of the surface"),
        mesh_field<C, &Mesh::triangles>("triangles", "triangles of the surface"),
        mesh_field<C, &Mesh::quads>("quads", "quads of the surface")};
    add_fields(info, lists, &defaults);
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
