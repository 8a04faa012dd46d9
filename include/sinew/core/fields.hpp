// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>
#include <sinew/core/error.hpp>

#include <boost/hana/for_each.hpp>
#include <boost/hana/tuple.hpp>
#include <boost/hana/unpack.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace sinew {

/// Values that a number may take. Numbers are finite in any case.
struct Range {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  bool openLow = false, openHigh = false;

  constexpr bool contains(double value) const {
    return (openLow ? value > low : value >= low) && (openHigh ? value < high : value <= high);
  }
};

namespace range {
inline constexpr Range any{}, positive{.low = 0, .openLow = true}, nonNegative{.low = 0};
constexpr Range atLeast(double low) { return {.low = low}; }
constexpr Range open(double low, double high) { return {low, high, true, true}; }
constexpr Range halfOpen(double low, double high) { return {low, high, false, true}; }
constexpr Range closed(double low, double high) { return {low, high, false, false}; }
}  // namespace range

/// A field that names a file of data; scene files give it relative to themselves or to a data folder.
struct DataFile {
  std::string path{};
  bool operator==(DataFile const&) const = default;
};

/// What the entries of a list stand for, so that they follow when points and elements are removed while a
/// scene runs (scene/topology_edit.hpp).
enum class Of {
  nothing,
  points,        // of the state on which the component acts; of the first end of an interaction
  secondPoints,  // of the second end
  parentPoints,  // of the parent of a mapping, one entry for each point of the child, or one for all
  edges,
  triangles,
  quads,
  hexahedra,
  pyramids,
  prisms,
  quadraticTetrahedra,
  quadraticHexahedra,
  triquadraticHexahedra,
  lines,     // elements of one dimension,
  surfaces,  // two,
  volumes,   // three,
  elements,  // or of the highest that the topology has
  entries    // of the lists of points beside it
};

/// The properties of a field that do not depend on its type.
struct FieldWords {
  std::string_view name, unit, documentation;
  Range range;
  std::string_view aliases{};  // other names in scene files, apart by blanks
  Of entries = Of::nothing;    // a list that follows: of numbers of these, or with one value for each
  bool numbers = false;
  bool live = false;  // takes another value between two steps, which acts from the next one on
};

/// One value of a component that its user may set: the single declaration from which range checks, messages,
/// scene files and reference pages are made. The default is what a default-constructed component holds.
template <class Owner, class T>
struct Field : FieldWords {
  T Owner::*member;

  /// The same field, known to scene files by other names too: those of older and newer SOFA.
  constexpr Field also(std::string_view names) const {
    Field known = *this;
    known.aliases = names;
    return known;
  }
  /// The same field, whose entries are numbers of points or elements, and go with them.
  constexpr Field numbersOf(Of what) const {
    Field follows = *this;
    follows.entries = what;
    follows.numbers = true;
    return follows;
  }
  /// The same field, whose list has one entry for each of these; one of a single entry, for all, stays.
  constexpr Field oneEach(Of what) const {
    Field follows = *this;
    follows.entries = what;
    return follows;
  }
  /// The same field, which may take another value while the scene runs, of something that changes; a
  /// component that made something of it has takeValues (TakesValues).
  constexpr Field whileRunning() const {
    Field follows = *this;
    follows.live = true;
    return follows;
  }
};

/// f(name) for each of the names that blanks separate in a list.
template <class F>
constexpr void for_each_name(std::string_view list, F&& f) {
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(' '), list.size());
    if (end > 0) f(list.substr(0, end));
    list.remove_prefix(std::min(end + 1, list.size()));
  }
}

constexpr bool has_name(std::string_view list, std::string_view word) {
  bool found = false;
  for_each_name(list, [&](std::string_view name) { found = found || name == word; });
  return found;
}

template <class Owner, class T>
constexpr Field<Owner, T> field(std::string_view name, T Owner::*member, std::string_view unit,
                                std::string_view documentation, Range range = range::any) {
  return {{name, unit, documentation, range}, member};
}

template <class... F>
constexpr auto field_list(F... fields) {
  return boost::hana::make_tuple(fields...);
}

template <class T>
concept HasFields = requires { T::fields(); };

/// The classes by which scene files know a component beside its className, apart by blanks.
template <class C>
constexpr std::string_view class_aliases() {
  if constexpr (requires { C::aliases; })
    return C::aliases;
  else
    return {};
}

/// f(field, value) for each field of a component or of a struct that is the value of one.
template <class T, class F>
constexpr void for_each_field(T& owner, F&& f) {
  boost::hana::for_each(std::remove_const_t<T>::fields(), [&](auto const& fd) { f(fd, owner.*fd.member); });
}

/// The values of some fields of one object to as many fields of another, in their order.
template <class From, class Fields, class To, class Targets>
constexpr void copy_fields(From const& from, Fields const& fields, To& to, Targets const& targets) {
  boost::hana::unpack(fields, [&](auto const&... source) {
    boost::hana::unpack(targets,
                        [&](auto const&... target) { ((to.*target.member = from.*source.member), ...); });
  });
}

/// f(field) for each field of a class.
template <class T, class F>
constexpr void for_each_field_of(F&& f) {
  boost::hana::for_each(T::fields(), f);
}

namespace detail {

// "name<first, second, third>"; what a component lacks of these is empty
inline std::string full_name(std::string_view name, std::string_view first = {}, std::string_view second = {},
                             std::string_view third = {}, std::string_view fourth = {}) {
  std::string all(name);
  if (first.empty()) return all;
  all += text('<', first);
  for (const std::string_view next : {second, third, fourth})
    if (!next.empty()) all += text(", ", next);
  return all + '>';
}

}  // namespace detail

/// "TetrahedronFEMForceField<Vec3d>".
template <class C>
std::string component_name() {
  if constexpr (requires {
                  typename C::In;
                  typename C::In2;
                  typename C::Out;
                  typename C::Parents;
                })
    return detail::full_name(C::className,
                             data_types_name<typename C::In>::value,
                             data_types_name<typename C::In2>::value,
                             data_types_name<typename C::Out>::value,
                             C::Parents::name());
  else if constexpr (requires {
                       typename C::In;
                       typename C::Out;
                       typename C::Parents;
                     })
    return detail::full_name(C::className,
                             data_types_name<typename C::In>::value,
                             data_types_name<typename C::Out>::value,
                             C::Parents::name());
  else if constexpr (requires {
                       typename C::In;
                       typename C::Out;
                     })
    return detail::full_name(
        C::className, data_types_name<typename C::In>::value, data_types_name<typename C::Out>::value);
  else if constexpr (requires { C::templateName; })
    return detail::full_name(C::className, C::templateName);
  else if constexpr (requires {
                       typename C::Ends;
                       requires C::between;
                     })
    return detail::full_name(C::className, data_types_name<typename C::DataTypes>::value, C::Ends::name());
  else if constexpr (requires { typename C::DataTypes; })
    return detail::full_name(C::className, data_types_name<typename C::DataTypes>::value);
  else
    return std::string(C::className);
}

/// The fields of a class, for as long as the program runs.
template <class C>
inline constexpr auto fields_of_class = C::fields();

namespace detail {

inline std::string range_text(Range r) {
  const bool low = std::isfinite(r.low), high = std::isfinite(r.high);
  std::string words;
  if (low) words += text(r.openLow ? "greater than " : "at least ", r.low);
  if (low && high) words += " and ";
  if (high) words += text(r.openHigh ? "less than " : "at most ", r.high);
  return words;
}

/// The first number inside a field's value that is refused, with the place where it stands ("[3].length").
struct BadNumber {
  bool found = false;
  double value = 0;
  std::string place{};
  FieldWords const* inside = nullptr;  // the field of a struct inside the value, where it is one that refuses
};

/// Which numbers a field refuses: such as are not finite, or out of its range or of that of the field around
/// it.
struct Refused {
  Range range;
  Refused const* around = nullptr;

  bool operator()(double value) const {
    return !std::isfinite(value) || !range.contains(value) || (around && (*around)(value));
  }
};

template <class T>
BadNumber find_number(T const& value, Refused const& bad) {
  if constexpr (std::is_same_v<T, bool> || std::is_enum_v<T> || std::is_convertible_v<T, std::string_view>) {
    return {};
  } else if constexpr (std::is_arithmetic_v<T>) {
    return {.found = bad(double(value)), .value = double(value)};
  } else if constexpr (requires {
                         value.has_value();
                         *value;
                       }) {
    return value ? find_number(*value, bad) : BadNumber{};
  } else if constexpr (HasFields<T>) {
    static constexpr auto list = T::fields();
    BadNumber first;
    boost::hana::for_each(list, [&](auto const& fd) {
      if (first.found) return;
      first = find_number(value.*fd.member, Refused{fd.range, &bad});
      if (!first.found) return;
      if (!first.inside) first.inside = &fd;
      first.place = text('.', fd.name, first.place);
    });
    return first;
  } else if constexpr (requires {
                         value.center;
                         value.orientation;
                       }) {
    BadNumber first = find_number(value.center, bad);
    if (!first.found) first = find_number(value.orientation, bad);
    return first;
  } else if constexpr (
      requires { value.coeffs(); } && !requires { value.rows(); }) {
    return find_number(value.coeffs().eval(), bad);
  } else if constexpr (requires {
                         value.rows();
                         value.coeff(0);
                       }) {
    for (Eigen::Index i = 0; i < value.size(); ++i)
      if (bad(double(value.coeff(i)))) return {.found = true, .value = double(value.coeff(i))};
    return {};
  } else if constexpr (requires {
                         value.begin();
                         value.end();
                       }) {
    std::size_t i = 0;
    for (auto const& v : value) {
      if (BadNumber b = find_number(v, bad); b.found) {
        b.place = text('[', i, ']', b.place);
        return b;
      }
      ++i;
    }
    return {};
  } else {
    return {};
  }
}

[[noreturn]] inline void refuse(std::string_view where, std::string_view component, FieldWords const& field,
                                BadNumber const& bad) {
  FieldWords const& says = bad.inside ? *bad.inside : field;
  const std::string expected = range_text(says.range);
  throw Error(where,
              text(component,
                   ": ",
                   field.name,
                   bad.place,
                   " is ",
                   bad.value,
                   says.unit.empty() ? "" : " ",
                   says.unit,
                   ", but must be a finite number",
                   expected.empty() ? "" : ", ",
                   expected,
                   " (",
                   says.documentation,
                   "); correct this value"));
}

/// A field, and what looks for a number in its value that it refuses.
struct CheckedField {
  FieldWords const* words;
  BadNumber (*find)(void const* value, Refused const& bad);
};
template <class T>
BadNumber find_number_at(void const* value, Refused const& bad) {
  return find_number(*static_cast<T const*>(value), bad);
}
template <class C>
inline constexpr auto checked_fields = boost::hana::unpack(fields_of_class<C>, [](auto const&... fd) {
  return std::array<CheckedField, sizeof...(fd)>{
      CheckedField{&fd, &find_number_at<std::decay_t<decltype(std::declval<C&>().*fd.member)>>}...};
});
inline void check_values(std::span<CheckedField const> fields, void const* const* values,
                         std::string (*component)(), std::string_view where) {
  for (std::size_t i = 0; i < fields.size(); ++i)
    if (const auto bad = fields[i].find(values[i], {fields[i].words->range}); bad.found)
      refuse(where, component(), *fields[i].words, bad);
}

}  // namespace detail

/// Throws Error unless every field of `component` is finite and in its declared range.
template <class C>
void check_fields(C const& component, std::string_view where) {
  boost::hana::unpack(fields_of_class<C>, [&](auto const&... fd) {
    void const* const values[] = {std::addressof(component.*fd.member)..., nullptr};
    detail::check_values(detail::checked_fields<C>, values, &component_name<C>, where);
  });
}

}  // namespace sinew
