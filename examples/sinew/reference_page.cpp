// SPDX-License-Identifier: BSL-1.0
#include "reference.hpp"

namespace cli {

using sinew::text;

namespace {

std::string cell(std::string_view words) {
  std::string out;
  for (const char c : words) {
    if (c == '|' || c == '<' || c == '>' || c == '*' || c == '_') out += '\\';
    out += c;
  }
  return out;
}
// of kinds and defaults over many DataTypes, that of Vec3d, or of the first
std::string typical(Variants const& variants) {
  auto const* chosen = &variants[0];
  for (auto const& v : variants)
    if (v.second.find("Vec3d") != v.second.npos) chosen = &v;
  return chosen->first;
}
// a long list, from its beginning
std::string shortened(std::string words) {
  const std::size_t end = words.size() > 40 ? words.find(' ', 30) : words.npos;
  return end == words.npos ? words : words.substr(0, end) + " ...";
}

void table_of(std::string& out, Entry const& e, bool input) {
  const auto names = e.fieldNames(input);
  if (names.empty()) return;
  if (input)
    out += "\n| attribute | | unit | default | meaning |\n| --- | --- | --- | --- | --- |\n";
  else
    out += "\n| makes | | unit | meaning |\n| --- | --- | --- | --- |\n";
  for (auto name : names) {
    const FieldWords f = words_of(e, name, input);
    std::string meaning = cell(f.field->documentation);
    if (!f.range.empty()) meaning += text("; ", f.range);
    if (!f.field->aliases.empty()) {
      std::string also;
      sinew::for_each_name(f.field->aliases,
                           [&](std::string_view a) { also += text(also.empty() ? "" : ", ", '`', a, '`'); });
      meaning += text("; also ", also);
    }
    std::string kind = cell(typical(f.kinds));
    if (f.kinds.size() > 1) kind += " (by template)";
    out += text("| `", name, "` | ", kind, " | ", cell(f.unit), " | ");
    if (input) out += text(cell(shortened(typical(f.defaults))), " | ");
    out += text(meaning, " |\n");
  }
}

}  // namespace

std::string reference_page(std::vector<Entry> const& entries) {
  std::string out =
      "# Components\n\n"
      "Written by `sinew list --markdown` from the declarations of the components; do not edit it.\n\n"
      "Attributes are those of scene files. In C++ the same settings are members: `rest_position` is\n"
      "`restPosition`. Values are checked against their ranges when the scene is initialised. Kind and\n"
      "default are shown over `Vec3d` where they depend on the template; `sinew list NAME` shows them over "
      "all.\n";
  std::string_view last;
  for (auto const& e : entries) {
    auto const& c = e.first();
    if (e.role() != last)
      out += text("\n## ", words_of(c.role).title, "\n\n", words_of(c.role).explanation, '\n');
    last = e.role();
    out += text("\n### ", c.name, '\n');
    std::vector<std::string> facts;
    auto code = [](std::string_view names) {
      std::string all;
      sinew::for_each_name(names,
                           [&](std::string_view n) { all += text(all.empty() ? "" : ", ", '`', n, '`'); });
      return all;
    };
    if (const auto types = e.dataTypes(); !types.empty())
      facts.push_back(text("Over ", code(joined(types, " ")), "."));
    if (!c.aliases.empty()) facts.push_back(text("Other names: ", code(c.aliases), "."));
    if (e.joins()) facts.push_back("Joins two bodies where `object1` and `object2` are given.");
    if (e.fieldNames(true).empty()) facts.push_back("No attributes.");
    if (!facts.empty()) out += text('\n', joined(facts, " "), '\n');
    table_of(out, e, true);
    table_of(out, e, false);
  }
  return out;
}

}  // namespace cli
