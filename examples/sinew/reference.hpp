// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scene.hpp"

#include <sinew/runtime/cpp_members.hpp>

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
  std::string_view guide{}, guideTitle{};  // a page that leads on, as docs/components links to it
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

/// A scene with the component as its users write it: XML in SOFA's dialect. Empty where none is known, of a
/// class that is not Sinew's.
std::string example_of(Entry const& entry);

std::string joined(std::vector<std::string> const& words, std::string_view between);

/// A file of the reference: Markdown.
struct Page {
  std::string name, text;
};
/// What the pages are made of, beside the table of classes.
struct ReferenceSources {
  std::vector<std::vector<sinew::CppMember>> const& members;  // of each class of the table
  std::string headers;                                        // folder whose comments say what components are
  std::string scenes;                                         // folder of the data files that examples read
};
/// A page for each component, and README.md that lists them. Examples are loaded, stepped, and baked into
/// C++. Throws Failure where a component or a field has no explanation, or an example does not run.
std::vector<Page> reference_pages(std::vector<Entry> const& entries, ReferenceSources const& sources);

}  // namespace cli
