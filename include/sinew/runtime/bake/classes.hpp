// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/bake/type_code.hpp>
#include <sinew/runtime/cpp_members.hpp>
#include <sinew/runtime/node.hpp>

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew {

namespace detail {

/// What C++ text needs of a field, beside its FieldInfo: the pointer to its member as the compiler spells it.
struct FieldCode {
  std::string_view spelled;
  TypeCode const& (*type)();
  std::string (*typeName)();
};
/// And of a class: its fields are those of its ClassInfo.
struct ClassCode {
  std::string_view spelled;  // "sinew::CGLinearSolver<sinew::GraphScattered>"
  bool generates;            // a topology that has to be made before it is looked at
  FieldCode const* fields;
};

template <auto Member>
consteval std::string_view spelled_member() {
  return __PRETTY_FUNCTION__;
}
/// The name of a member, from how the compiler spells a pointer to it; "mesh.positions" of a list of a Mesh.
inline std::string member_name(std::string_view spelled, std::string_view fieldName) {
  if (spelled.starts_with("mesh.")) return std::string(spelled);
  spelled = spelled.substr(0, spelled.find_first_of(";]"));
  if (const std::size_t at = spelled.rfind("::"); at != spelled.npos)
    if (is_identifier(spelled.substr(at + 2))) return std::string(spelled.substr(at + 2));
  return camel_case(fieldName);
}
/// The name of a class, with the arguments of a template that `name` leaves out.
inline std::string class_name(ClassInfo const& info, ClassCode const& code) {
  std::string type(code.spelled);
  for (std::size_t at = 0; (at = type.find("sinew::", at)) != type.npos;) type.erase(at, 7);
  const bool more = type.starts_with(text(info.name, '<')) && info.cppName.find('<') == info.cppName.npos;
  return more ? type : info.cppName;
}

template <class C, auto const& List, std::size_t... I>
constexpr void add_field_codes(FieldCode*& to, std::index_sequence<I...>) {
  ((*to++ = {spelled_member<boost::hana::at_c<I>(List).member>(),
             &type_code<std::decay_t<decltype(std::declval<C&>().*(boost::hana::at_c<I>(List).member))>>,
             &cpp_type<std::decay_t<decltype(std::declval<C&>().*(boost::hana::at_c<I>(List).member))>>}),
   ...);
}
template <class C, auto const& List>
constexpr void add_field_codes(FieldCode*& to) {
  add_field_codes<C, List>(to, std::make_index_sequence<decltype(boost::hana::length(List))::value>{});
}
// in the order of field_rows
template <class C>
inline constexpr auto field_codes = [] {
  std::array<FieldCode, field_count<C>> codes{};
  FieldCode* to = codes.data();
  add_field_codes<C, fields_of_class<C>>(to);
  add_field_codes<C, state_fields_of_class<C>>(to);
  add_field_codes<C, outputs_of_class<C>>(to);
  if constexpr (HoldsMesh<C>) {
    *to++ = {"mesh.positions", &type_code<decltype(Mesh::positions)>, &cpp_type<decltype(Mesh::positions)>};
    *to++ = {"mesh.edges", &type_code<decltype(Mesh::edges)>, &cpp_type<decltype(Mesh::edges)>};
    *to++ = {"mesh.triangles", &type_code<decltype(Mesh::triangles)>, &cpp_type<decltype(Mesh::triangles)>};
    *to++ = {"mesh.quads", &type_code<decltype(Mesh::quads)>, &cpp_type<decltype(Mesh::quads)>};
  }
  return codes;
}();
template <class... Cs>
constexpr auto class_codes(TypeList<Cs...>) {
  return std::array<ClassCode, sizeof...(Cs)>{
      ClassCode{type_name<Cs>(), Generates<Cs>, field_codes<Cs>.data()}...};
}

/// The classes of a registry, and the C++ of them.
template <class R>
struct BakeClasses {
  using Entry = RuntimeEntry<R>;
  std::vector<ClassInfo> table = make_class_table<R>();
  static constexpr auto codes = class_codes(typename AnyComponent<R>::List{});

  ClassInfo const& infoOf(Entry const& entry) const { return table[std::size_t(entry.component.type())]; }
  ClassCode const& codeOf(Entry const& entry) const { return codes[std::size_t(entry.component.type())]; }
  std::string memberOf(Entry const& entry, std::size_t field) const {
    return member_name(codeOf(entry).fields[field].spelled, infoOf(entry).fields[field].name);
  }
};

}  // namespace detail

template <class R>
std::vector<std::vector<CppMember>> cpp_members() {
  const detail::BakeClasses<R> classes;
  std::vector<std::vector<CppMember>> all;
  for (auto const& info : classes.table) {
    auto const* code = classes.codes[std::size_t(info.type)].fields;
    auto& members = all.emplace_back();
    for (auto const& field : info.fields) {
      members.push_back({detail::member_name(code->spelled, field.name), code->typeName()});
      ++code;
    }
  }
  return all;
}

}  // namespace sinew
