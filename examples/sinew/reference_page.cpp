// SPDX-License-Identifier: BSL-1.0
#include "reference.hpp"
#include "temporary_folder.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

namespace cli {

using sinew::text;

namespace {

namespace fs = std::filesystem;

/// Markdown of plain words: what stands between backticks stays as it is, the names of other components lead
/// to their pages.
class Prose {
 public:
  Prose(std::vector<Entry> const& entries, std::string_view self) : self_(self) {
    for (auto const& e : entries) names_.insert(e.first().name);
  }
  /// Within a code span that has begun in another line, too.
  std::string operator()(std::string_view words) {
    std::string out;
    for (std::size_t i = 0; i < words.size();) {
      std::size_t end = i;
      while (end < words.size() &&
             (std::isalnum(static_cast<unsigned char>(words[end])) || words[end] == '_'))
        ++end;
      const std::string_view word = words.substr(i, end - i);
      if (!code_ && word != self_ && names_.contains(word)) {
        out += text('[', word, "](", word, ".md)");
        i = end;
        continue;
      }
      for (end = std::max(end, i + 1); i < end; ++i) {
        const char c = words[i];
        if (c == '`') code_ = !code_;
        if (c == '|' || (!code_ && std::string_view("<>*_").find(c) != std::string_view::npos)) out += '\\';
        out += c;
      }
    }
    return out;
  }

 private:
  std::set<std::string_view> names_{};
  std::string_view self_;
  bool code_ = false;
};
std::string code(std::string_view words) { return words.empty() ? std::string() : text('`', words, '`'); }
/// The anchor of a heading.
std::string anchor(std::string_view heading) {
  std::string out;
  for (const char c : heading)
    if (c == ' ')
      out += '-';
    else if (std::isalnum(static_cast<unsigned char>(c)))
      out += char(std::tolower(static_cast<unsigned char>(c)));
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

/// A field as a member, "`double dampingCoefficient`", of the instantiation that speaks for all.
std::string member_text(Entry const& e, FieldWords const& f, ReferenceSources const& sources) {
  for (auto const* v : e.variants)
    if (f.field >= v->fields.data() && f.field < v->fields.data() + v->fields.size()) {
      auto const& m = sources.members[std::size_t(v->type)][std::size_t(f.field - v->fields.data())];
      return text('`', m.type, ' ', m.name, '`');
    }
  return {};
}

void table_of(std::string& out, Entry const& e, bool input, Prose& prose, ReferenceSources const& sources) {
  const auto names = e.fieldNames(input);
  if (names.empty()) return;
  if (input)
    out +=
        "\n## Attributes\n\n| attribute | | unit | default | meaning | in C++ |\n"
        "| --- | --- | --- | --- | --- | --- |\n";
  else
    out +=
        "\n## What it makes\n\n| for links | | unit | meaning | in C++ |\n| --- | --- | --- | --- | --- |\n";
  for (auto name : names) {
    const FieldWords f = words_of(e, name, input);
    std::string meaning = prose(f.field->documentation);
    if (!f.range.empty()) meaning += text("; ", prose(f.range));
    if (!f.field->aliases.empty()) {
      std::string also;
      sinew::for_each_name(f.field->aliases,
                           [&](std::string_view a) { also += text(also.empty() ? "" : ", ", code(a)); });
      meaning += text("; also ", also);
    }
    if (f.field->live) meaning += "; may follow [what moves](../scene-files.md#engines)";
    std::string kind = prose(typical(f.kinds));
    if (f.kinds.size() > 1) kind += " (by template)";
    out += text("| ", code(name), " | ", kind, " | ", prose(f.unit), " | ");
    if (input) out += text(prose(shortened(typical(f.defaults))), " | ");
    out += text(meaning, " | ", member_text(e, f, sources), " |\n");
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
  /// The comment above the alias of a name, and that above its class; below them, for a class that is one
  /// case of a family, that of the family.
  Found find(std::string_view name) const {
    const std::string wanted = text('"', name, '"');
    for (auto const& file : files_)
      for (std::size_t i = 0; i < file.lines.size(); ++i)
        if (const auto at = file.lines[i].find(" className = ");
            at != std::string::npos && file.lines[i].find(wanted, at) != std::string::npos) {
          Found found{file.header, {}};
          auto add = [&](std::size_t above) {
            auto comment = comment_above(file.lines, above);
            if (!found.comment.empty() && !comment.empty()) found.comment.emplace_back();
            for (auto& line : comment) found.comment.push_back(std::move(line));
          };
          for (std::size_t k = 0; k < file.lines.size(); ++k)
            if (file.lines[k].starts_with(text("using ", name, " ="))) add(k);
          add(structAbove(file, i));
          for (std::size_t k = 0; k < file.lines.size(); ++k)
            if (file.lines[k].find("::className") != std::string::npos &&
                structAbove(file, k) != structAbove(file, i)) {
              add(structAbove(file, k));
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
std::string as_markdown(std::vector<std::string> const& comment, Prose& prose) {
  std::string out;
  bool formulas = false;
  for (auto const& line : comment) {
    const bool formula = line.starts_with("  ");
    if (formula != formulas) out += formula ? "\n```text\n" : "```\n\n";
    formulas = formula;
    out += formula ? text(line.substr(2), '\n') : text(prose(line), '\n');
  }
  return formulas ? out + "```\n" : out;
}

/// A folder of its own to work in, for scenes that write files, until the end of the scope.
class WorkingFolder {
 public:
  WorkingFolder() { fs::current_path(folder_.path); }
  ~WorkingFolder() {
    std::error_code failed;
    fs::current_path(before_, failed);
  }
  WorkingFolder(WorkingFolder const&) = delete;
  WorkingFolder& operator=(WorkingFolder const&) = delete;

 private:
  TemporaryFolder folder_{"reference"};
  fs::path before_ = fs::current_path();
};

/// A scene as C++: includes, and a function that returns it. It is loaded and stepped on the way.
std::string cpp_of(std::string const& xml, Entry const& e, ReferenceSources const& sources) {
  const std::string path = (fs::absolute(sources.scenes) / text(e.first().name, ".scn")).string();
  const WorkingFolder folder;
  try {
    auto simulation = sinew::start(sinew::parse_scene<sinew::Standard>(path, xml));
    for (int i = 0; i < 3; ++i) simulation.animate(0.01);
    if (!std::isfinite(simulation.kineticEnergy())) throw sinew::Error(path, "the simulation diverged");
    const std::string baked = sinew::bake_text<sinew::Standard>(
        sinew::parse_scene<sinew::Standard>(path, xml), path, {.data = "examples/scenes"});
    std::string out;
    for (std::size_t at = 0; (at = baked.find("#include <sinew/", at)) != baked.npos;) {
      const std::size_t end = baked.find('\n', at) + 1;
      out += baked.substr(at, end - at);
      at = end;
    }
    const std::size_t begin = baked.find("auto scene("), end = baked.find("\n}\n", begin);
    if (begin == baked.npos || end == baked.npos) throw sinew::Error(path, "no function came out of bake");
    return text(out, "\nusing namespace sinew;\n\n", baked.substr(begin, end + 3 - begin));
  } catch (sinew::Error const& error) {
    throw Failure{badUsage,
                  {text(e.first().name, ": its example in reference_*.cpp does not run: ", error.what())}};
  }
}

/// The components of a scene but one, as links, in their order.
std::string components_in(std::string const& xml, std::vector<Entry> const& entries, std::string_view but) {
  std::string out;
  std::set<std::string_view> seen{but};
  for (std::size_t at = 0; (at = xml.find('<', at)) != xml.npos;) {
    const std::size_t end = xml.find_first_of(" />\n", ++at);
    for (auto const& e : entries)
      if (e.first().known(std::string_view(xml).substr(at, end - at)) && seen.insert(e.first().name).second)
        out += text(out.empty() ? "" : ", ", '[', e.first().name, "](", e.first().name, ".md)");
  }
  return out;
}

std::string page_of(Entry const& e, Headers::Found const& source, std::vector<Entry> const& entries,
                    ReferenceSources const& sources) {
  auto const& c = e.first();
  const RoleWords role = words_of(c.role);
  Prose prose(entries, c.name);
  auto all = [](std::string_view names) {
    std::string out;
    sinew::for_each_name(names, [&](std::string_view n) { out += text(out.empty() ? "" : ", ", code(n)); });
    return out;
  };
  std::string out = text("# ",
                         c.name,
                         "\n\n[",
                         role.title,
                         "](README.md#",
                         anchor(role.title),
                         "). Header: `sinew/",
                         source.header,
                         "`.");
  if (const auto types = e.dataTypes(); !types.empty())
    out += text(" In scene files over ", all(joined(types, " ")), '.');
  if (!c.aliases.empty()) out += text(" Other names: ", all(c.aliases), '.');
  if (e.joins()) out += " Joins two bodies where `object1` and `object2` are given.";
  out += text("\n\n", as_markdown(source.comment, prose));
  if (const std::string xml = example_of(e); !xml.empty()) {
    out += text("\n## Example\n\n```xml\n",
                xml,
                "```\n\nThe same in C++:\n\n```cpp\n",
                cpp_of(xml, e, sources),
                "```\n");
    if (const auto others = components_in(xml, entries, c.name); !others.empty())
      out += text("\nThe other components in it: ", others, ".\n");
  }
  if (e.fieldNames(true).empty()) out += "\nIt has no attributes.\n";
  table_of(out, e, true, prose, sources);
  table_of(out, e, false, prose, sources);
  out += text(
      "\n## See also\n\n- [", role.title, "](README.md#", anchor(role.title), "): the others of its role.\n");
  if (!role.guide.empty())
    out += text(
        "- [", char(std::toupper(role.guideTitle[0])), role.guideTitle.substr(1), "](", role.guide, ").\n");
  return out;
}

// a comment up to the end of its first sentence or clause, without references to publications
std::string first_sentence(std::vector<std::string> const& comment) {
  std::string words;
  for (auto const& line : comment) {
    if (line.starts_with("  ") || line.empty()) break;
    words += text(words.empty() ? "" : " ", line);
  }
  auto is_reference = [](std::string_view inside) {
    int digits = 0;
    for (const char c : inside) {
      digits = std::isdigit(static_cast<unsigned char>(c)) ? digits + 1 : 0;
      if (digits == 4 || c == '`') return true;
    }
    return false;
  };
  for (std::size_t open = 0; (open = words.find(" (", open)) != words.npos;) {
    int depth = 0;
    std::size_t close = open + 1;
    for (; close < words.size(); ++close) {
      depth += words[close] == '(' ? 1 : words[close] == ')' ? -1 : 0;
      if (depth == 0) break;
    }
    if (is_reference(std::string_view(words).substr(open, close - open)))
      words.erase(open, close + 1 - open);
    else
      ++open;
  }
  words = words.substr(0, std::min({words.find(". "), words.find(": "), words.find("; ")}));
  while (words.ends_with('.') || words.ends_with(':') || words.ends_with(',')) words.pop_back();
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

std::vector<Page> reference_pages(std::vector<Entry> const& entries, ReferenceSources const& sources) {
  const Headers headers(sources.headers);
  if (!fs::is_directory(sources.scenes))
    throw Failure{badUsage,
                  {text(sources.scenes, ": there is no such folder; give the folder examples/scenes")}};
  std::vector<Page> pages;
  std::string index =
      "# Components\n\n"
      "Each component that scenes may have has a page with an example, its attributes and the members that "
      "they\n"
      "are in C++. The pages are written by `sinew list --markdown docs/components` from the declarations of "
      "the\n"
      "components and the comments in their headers; do not edit them.\n\n"
      "Attributes are those of scene files. In C++ the same settings are members, in camel case: "
      "`rest_position`\n"
      "is `restPosition`. Values are checked against their ranges when the scene is initialised. Where "
      "kind,\n"
      "default and C++ type depend on the template, they are shown over `Vec3d`; `sinew list NAME` shows "
      "them over\n"
      "all.\n";
  std::string_view last;
  for (auto const& e : entries) {
    auto const& c = e.first();
    const auto source = headers.find(c.name);
    check_complete(e, source);
    if (e.role() != last)
      index += text("\n## ", words_of(c.role).title, "\n\n", words_of(c.role).explanation, "\n\n");
    last = e.role();
    Prose prose(entries, c.name);
    index += text("- [", c.name, "](", c.name, ".md): ", prose(first_sentence(source.comment)), ".\n");
    pages.push_back({text(c.name, ".md"), page_of(e, source, entries, sources)});
  }
  pages.push_back({"README.md", index});
  return pages;
}

}  // namespace cli
