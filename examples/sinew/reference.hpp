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

/// A file of the reference: Markdown.
struct Page {
  std::string name, text;
};
/// A page for each component, and README.md that lists them. What they are is taken from the comments in the
/// headers in a folder. Throws Failure where a component or a field has no explanation.
std::vector<Page> reference_pages(std::vector<Entry> const& entries, std::string const& headerFolder);

}  // namespace cli
