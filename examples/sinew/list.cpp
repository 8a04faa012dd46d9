// SPDX-License-Identifier: BSL-1.0
#include "reference.hpp"

#include <sinew/io/output_file.hpp>

#include <algorithm>
#include <cstdio>

namespace sinew {
extern template std::vector<std::vector<CppMember>> cpp_members<Standard>();
}

namespace cli {

using sinew::text;

namespace {

std::string commas(std::string_view blankSeparated) {
  std::string all;
  sinew::for_each_name(blankSeparated,
                       [&](std::string_view name) { all += text(all.empty() ? "" : ", ", name); });
  return all;
}

// "number (Vec3d, Vec2d); mass, volume, inertia by mass (Rigid3d)"
std::string variants_text(Variants const& variants) {
  if (variants.size() == 1) return variants[0].first;
  std::string all;
  for (auto const& [words, where] : variants)
    all += text(all.empty() ? "" : "; ", words.empty() ? "none" : words, " (", where, ')');
  return all;
}

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
    if (e.role() != last) out += text(last.empty() ? "" : "\n", words_of(e.first().role).title, '\n');
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
  std::string out =
      text(c.name,
           ", ",
           std::string_view("aeiouO").find(e.role().front()) != std::string_view::npos ? "an " : "a ",
           e.role(),
           "\n");
  out += text("  ", wrapped(words_of(c.role).explanation, 2), '\n');
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

}  // namespace

int list(ListOptions const& options) {
  const auto table = sinew::make_class_table<sinew::Standard>();
  const auto entries = entries_of(table);
  if (!options.markdown.empty()) {
    const auto members = sinew::cpp_members<sinew::Standard>();
    for (auto const& page : reference_pages(entries, {members, options.headers, options.scenes}))
      writing([&] { sinew::io::write_file(text(options.markdown, '/', page.name), page.text); });
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
