// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/bake/links.hpp>
#include <sinew/runtime/scene_files.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace sinew {

namespace detail {

/// The C++ of components. Those whose data others take by links, and engines, become local variables, written
/// before what needs them. The tree is written several times, until it is known which those are.
template <class R>
class BakeComponents {
 public:
  using Node = RuntimeNode<R>;
  using Entry = RuntimeEntry<R>;
  // of one pass
  std::set<std::string> headers{};  // of components, beside sinew.hpp
  std::string locals{}, lists{};    // statements with variables; functions that return long lists
  bool readsFiles = false;

  BakeComponents(BakeClasses<R> const& classes, BakeOptions const& options, std::filesystem::path folder)
      : classes_(classes), options_(options), folder_(std::move(folder)) {}

  /// A pass begins.
  void start() {
    names_.clear(), functions_.clear(), taken_.clear();
    locals.clear(), lists.clear();
    readsFiles = false;
    for (auto name : reservedNames) taken_.emplace(name);
    taken_.insert(options_.name);
  }
  std::size_t variableCount() const { return variables_.size(); }
  /// A component where it stands in its node.
  std::string inTree(Node& node, Entry& entry) {
    return variables_.count(&entry) ? variable(node, entry) : component(node, entry);
  }
  static std::string raised(std::string name) {
    if (!name.empty() && name[0] >= 'a' && name[0] <= 'z') name[0] = char(name[0] - 'a' + 'A');
    return name;
  }

 private:
  BakeClasses<R> const& classes_;
  BakeOptions const& options_;
  std::filesystem::path folder_;  // of the scene file
  BakeLinks<R> links_{classes_};
  std::set<Entry const*> variables_{};  // components that are local variables
  // of one pass
  std::map<Entry const*, std::string> names_{};
  std::map<std::string, std::string> functions_{};  // of a list, by what it returns
  std::set<std::string, std::less<>> taken_{};
  std::set<Entry const*> busy_{};  // components being written

  std::string unique(std::string const& name) {
    std::string free = name;
    for (int n = 2; !taken_.insert(free).second; ++n) free = text(name, n);
    return free;
  }

  /// The name of the variable that holds a component; it is written first.
  std::string variable(Node& node, Entry& entry) {
    variables_.insert(&entry);
    if (auto known = names_.find(&entry); known != names_.end()) return known->second;
    const std::string cpp = component(node, entry);
    std::string name = camel_case(entry.name);
    if (name.empty()) name = camel_case(classes_.infoOf(entry).name);
    name = unique(name);
    names_[&entry] = name;
    const std::size_t brace = className(node, entry).size();
    locals += text("  ", fit(text(cpp.substr(0, brace), ' ', name, cpp.substr(brace)), 2, 2, 1), ";\n");
    const std::string where = cpp_literal(text(node.path(), ": ", entry.name));
    if (classes_.infoOf(entry).role == RoleKind::engine)
      locals += text("  ", fit(text(name, ".update(", where, ")"), 2, 2, 1), ";\n");
    else if (classes_.codeOf(entry).generates)
      locals += text("  ", fit(text(name, ".generate(", where, ")"), 2, 2, 1), ";\n");
    return name;
  }

  std::string value(Node& node, Entry& entry, std::size_t field) {
    ClassInfo const& info = classes_.infoOf(entry);
    using Source = typename BakeLinks<R>::Source;
    if (const auto from = options_.embed ? std::optional<Source>() : links_.source(node, entry, field, busy_))
      return text(variable(*from->node, *from->entry), '.', classes_.memberOf(*from->entry, from->field));
    if (info.fields[field].isFile) {
      const std::string names = info.fields[field].write(entry.component.address());
      if (!info.fields[field].kind.starts_with("list of")) return file(node, entry, names);
      std::string list;
      for (std::string const& name : info.fields[field].fileNames(names))
        list += text(list.empty() ? "{" : ", ", file(node, entry, name));
      return list + '}';
    }
    TypeCode const& type = classes_.codeOf(entry).fields[field].type();
    const std::string cpp = initialiser(type, info.fields[field].cpp(entry.component.address()));
    if (cpp.size() < 1000 || type.element.empty()) return cpp;
    const std::string wanted = text(type.element, cpp);
    auto known = functions_.find(wanted);
    if (known == functions_.end()) {
      std::string member = classes_.memberOf(entry, field);
      member.erase(0, member.find('.') + 1);
      const std::string name = unique(text(options_.name, raised(camel_case(node.name)), raised(member)));
      known = functions_.emplace(wanted, name).first;
      lists += list_function(type, cpp, name) + '\n';
    }
    return known->second + "()";
  }

  std::string file(Node& node, Entry& entry, std::string const& path) {
    namespace fs = std::filesystem;
    if (path.starts_with('#')) return text('{', cpp_literal(path), '}');  // a shape, no file
    if (options_.embed)
      throw Error(
          entry.origin.empty() ? node.path() : entry.origin,
          text(classes_.infoOf(entry).name,
               " reads the file ",
               shown(path),
               " when the scene starts, which --embed cannot avoid; read it by a loader and link to that "
               "(src=\"@loader\"), or bake without --embed"));
    const std::string relative =
        fs::absolute(fs::path(path)).lexically_normal().lexically_relative(folder_).generic_string();
    if (relative.empty()) return text('{', cpp_literal(path), '}');
    readsFiles = true;
    return text("{data + ", cpp_literal(text('/', relative)), '}');
  }

  /// "UniformMass<Vec3d>{.totalMass = 2}".
  std::string component(Node& node, Entry& entry) {
    ClassInfo const& info = classes_.infoOf(entry);
    if (!info.traits.header.empty()) headers.emplace(info.traits.header);
    busy_.insert(&entry);
    std::string members, mesh;
    for (std::size_t f = 0; f < info.fields.size(); ++f) {
      FieldInfo const& field = info.fields[f];
      if (!field.isInput || field.write(entry.component.address()) == field.defaultValue) continue;
      const std::string member = classes_.memberOf(entry, f);
      const bool ofMesh = member.starts_with("mesh.");
      std::string& to = ofMesh ? mesh : members;
      to += text(to.empty() ? "" : ", ", '.', member.substr(ofMesh ? 5 : 0), " = ", value(node, entry, f));
    }
    busy_.erase(&entry);
    if (!mesh.empty()) members = text(".mesh = {", mesh, '}', members.empty() ? "" : ", ", members);
    return text(className(node, entry), '{', members, '}');
  }
  std::string className(Node& node, Entry& entry) const {
    std::string name = class_name(classes_.infoOf(entry), classes_.codeOf(entry));
    if (classes_.infoOf(entry).severalParents) {
      constexpr std::string_view linked = "LinkedParents>";
      if (!name.ends_with(linked))
        throw Error(node.path(),
                    text(name, " names its parents in a way that a typed scene cannot express; remove it"));
      name.resize(name.size() - linked.size());
      return text(name, "Parents<", links_.parentsOf(node, entry), ">>");
    }
    const auto ends = links_.endsOf(node, entry);
    if (!ends[0]) return name;
    constexpr std::string_view linked = ", Linked>";
    if (!name.ends_with(linked))
      throw Error(node.path(),
                  text(name, " joins two nodes in a way that a typed scene cannot express; remove it"));
    name.resize(name.size() - linked.size());
    return text(name,
                ", Between<",
                cpp_literal(links_.pathFrom(node, *ends[0])),
                ", ",
                cpp_literal(links_.pathFrom(node, *ends[1])),
                ">>");
  }
};

}  // namespace detail

}  // namespace sinew
