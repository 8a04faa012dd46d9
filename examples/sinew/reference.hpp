// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scene.hpp"

namespace cli {

/// One class of components with all its instantiations.
struct Entry {
  std::vector<sinew::ClassInfo const*> variants{};
  sinew::ClassInfo const& first() const { return *variants[0]; }

  std::string_view role() const { return enum_names(first().role)[std::size_t(first().role)]; }
  std::vector<std::string> dataTypes() const;
  /// Whether it may join two bodies.
  bool joins() const;
  /// Attributes, or what links may take from it besides.
  std::vector<std::string_view> fieldNames(bool inputs) const;
};
/// The classes of a table, by role and name.
std::vector<Entry> entries_of(std::vector<sinew::ClassInfo> const& table);

struct RoleWords {
  std::string_view title, explanation;
};
RoleWords words_of(sinew::RoleKind role);

/// Words, and the DataTypes over which they hold.
using Variants = std::vector<std::pair<std::string, std::string>>;

/// What there is to say of a field over all instantiations of its class.
struct FieldWords {
  sinew::FieldInfo const* field = nullptr;
  Variants kinds{}, defaults{};
  std::string unit, range;
};
FieldWords words_of(Entry const& entry, std::string_view field, bool input);

std::string joined(std::vector<std::string> const& words, std::string_view between);

/// The reference of all components, as Markdown.
std::string reference_page(std::vector<Entry> const& entries);

}  // namespace cli
