// SPDX-License-Identifier: BSL-1.0
#include "reference.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

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

namespace {

/// What the comment above a class says, line by line, without the slashes.
std::vector<std::string> comment_above(std::vector<std::string> const& lines, std::size_t line) {
  while (line > 0 && !lines[line - 1].starts_with("///") && !lines[line - 1].empty() &&
         !lines[line - 1].starts_with('}'))
    --line;
  std::size_t first = line;
  while (first > 0 && lines[first - 1].starts_with("///")) --first;
  std::vector<std::string> comment;
  for (; first < line; ++first)
    comment.push_back(lines[first].size() > 4 ? lines[first].substr(4) : std::string());
  return comment;
}

/// The headers of the components, to find what their comments say.
class Headers {
 public:
  explicit Headers(std::string const& folder) {
    std::vector<std::filesystem::path> paths;
    std::error_code failed;
    for (auto const& file : std::filesystem::recursive_directory_iterator(folder, failed))
      if (file.path().extension() == ".hpp") paths.push_back(file.path());
    if (failed || paths.empty())
      throw Failure{badUsage, {text(folder, ": there are no headers; give the folder include/sinew")}};
    std::sort(paths.begin(), paths.end());
    for (auto const& path : paths) {
      files_.push_back({std::filesystem::relative(path, folder).generic_string(), {}});
      std::ifstream in(path);
      for (std::string line; std::getline(in, line);) files_.back().lines.push_back(line);
    }
  }

  struct Found {
    std::string header{};
    std::vector<std::string> comment{};
  };
  /// The comment above the class of a name, or above its alias; below it, for a class that is one case of a
  /// family, that of the family.
  Found find(std::string_view name) const {
    const std::string wanted = text('"', name, '"');
    for (auto const& file : files_)
      for (std::size_t i = 0; i < file.lines.size(); ++i)
        if (const auto at = file.lines[i].find(" className = ");
            at != std::string::npos && file.lines[i].find(wanted, at) != std::string::npos) {
          Found found{file.header, comment_above(file.lines, structAbove(file, i))};
          for (std::size_t k = 0; k < file.lines.size(); ++k)
            if (file.lines[k].starts_with(text("using ", name, " =")))
              for (auto& line : comment_above(file.lines, k)) found.comment.push_back(std::move(line));
          for (std::size_t k = 0; k < file.lines.size(); ++k)
            if (file.lines[k].find("::className") != std::string::npos &&
                structAbove(file, k) != structAbove(file, i)) {
              if (!found.comment.empty()) found.comment.emplace_back();
              for (auto& line : comment_above(file.lines, structAbove(file, k)))
                found.comment.push_back(std::move(line));
              break;
            }
          return found;
        }
    return {};
  }

 private:
  struct File {
    std::string header;
    std::vector<std::string> lines;
  };
  std::vector<File> files_{};

  static std::size_t structAbove(File const& file, std::size_t line) {
    while (line > 0 && !file.lines[line].starts_with("struct ")) --line;
    return line;
  }
};

/// A comment as Markdown: formulas, which are indented, become code.
std::string as_markdown(std::vector<std::string> const& comment) {
  std::string out;
  bool code = false;
  for (auto const& line : comment) {
    const bool formula = line.starts_with("  ");
    if (formula != code) out += formula ? "\n```text\n" : "```\n\n";
    code = formula;
    out += formula ? text(line.substr(2), '\n') : text(cell(line), '\n');
  }
  return code ? out + "```\n" : out;
}

std::string page_of(Entry const& e, Headers::Found const& source) {
  auto const& c = e.first();
  std::string out = text("# ", c.name, "\n\n");
  auto code = [](std::string_view names) {
    std::string all;
    sinew::for_each_name(names,
                         [&](std::string_view n) { all += text(all.empty() ? "" : ", ", '`', n, '`'); });
    return all;
  };
  out += text(words_of(c.role).title, ". Header: `sinew/", source.header, "`.");
  if (const auto types = e.dataTypes(); !types.empty())
    out += text(" In scene files over ", code(joined(types, " ")), '.');
  if (!c.aliases.empty()) out += text(" Other names: ", code(c.aliases), '.');
  if (e.joins()) out += " Joins two bodies where `object1` and `object2` are given.";
  out += text("\n\n", as_markdown(source.comment));
  if (e.fieldNames(true).empty()) out += "\nNo attributes.\n";
  table_of(out, e, true);
  table_of(out, e, false);
  return out;
}

// up to the first full stop
std::string first_sentence(std::vector<std::string> const& comment) {
  std::string words;
  for (auto const& line : comment) {
    if (line.starts_with("  ") || line.empty()) break;
    words += text(words.empty() ? "" : " ", line);
  }
  const std::size_t end = std::min({words.find(". "), words.find(": "), words.find("; ")});
  words = words.substr(0, end);
  if (words.ends_with('.') || words.ends_with(':')) words.pop_back();
  return words;
}

// Throws Failure where a component is not explained in full.
void check_complete(Entry const& e, Headers::Found const& source) {
  auto const& c = e.first();
  if (source.comment.empty())
    throw Failure{badUsage, {text(c.name, ": no comment (///) above its class explains it; write one")}};
  for (const bool input : {true, false})
    for (auto name : e.fieldNames(input))
      if (words_of(e, name, input).field->documentation.empty())
        throw Failure{badUsage, {text(c.name, ".", name, ": the field has no documentation; write some")}};
}

}  // namespace

std::vector<Page> reference_pages(std::vector<Entry> const& entries, std::string const& headerFolder) {
  const Headers headers(headerFolder);
  std::vector<Page> pages;
  std::string index =
      "# Components\n\n"
      "A page for each component that scenes may have, written by `sinew list --markdown` from the\n"
      "declarations of the components and the comments in their headers; do not edit them.\n\n"
      "Attributes are those of scene files. In C++ the same settings are members: `rest_position` is\n"
      "`restPosition`. Values are checked against their ranges when the scene is initialised. Kind and\n"
      "default are shown over `Vec3d` where they depend on the template; `sinew list NAME` shows them over "
      "all.\n";
  std::string_view last;
  for (auto const& e : entries) {
    auto const& c = e.first();
    const auto source = headers.find(c.name);
    check_complete(e, source);
    if (e.role() != last)
      index += text("\n## ", words_of(c.role).title, "\n\n", words_of(c.role).explanation, "\n\n");
    last = e.role();
    index += text("- [", c.name, "](", c.name, ".md): ", cell(first_sentence(source.comment)), '\n');
    pages.push_back({text(c.name, ".md"), page_of(e, source)});
  }
  pages.push_back({"README.md", index});
  return pages;
}

}  // namespace cli
