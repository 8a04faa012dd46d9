// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/bake/components.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>
#include <sinew/scene/simulation.hpp>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace sinew {

namespace detail {

/// Writes the typed scene of a runtime tree.
template <class R>
class Baker {
  using Node = RuntimeNode<R>;
  using Entry = RuntimeEntry<R>;

 public:
  Baker(ReadScene<R>& scene, std::string const& path, BakeOptions const& options)
      : scene_(scene), path_(path), options_(options) {}

  std::string write() {
    checkName();
    // a scene that cannot be initialised is not baked; the error is the one that a run would give
    Simulation<Node>{scene_.root}.init();
    // a component may be linked to before it is known that it has to be a variable
    for (std::size_t known = components_.variableCount() + 1; known != components_.variableCount();) {
      known = components_.variableCount();
      components_.start();
      tree_.clear();
      writeNode(scene_.root, 2, 2 + std::string_view("return Simulation{").size(), 2);
    }
    return whole();
  }

 private:
  ReadScene<R>& scene_;
  std::string const& path_;
  BakeOptions const& options_;
  std::filesystem::path folder_ = std::filesystem::absolute(path_).lexically_normal().parent_path();
  BakeClasses<R> classes_{};
  BakeComponents<R> components_{classes_, options_, folder_};
  std::string tree_{};  // of one pass

  void checkName() {
    bool taken = !is_identifier(options_.name);
    for (auto name : reservedNames) taken = taken || name == options_.name;
    for (auto const& info : classes_.table)
      taken = taken || info.cppName.substr(0, info.cppName.find('<')) == options_.name;
    if (taken)
      throw Error(
          "bake",
          text(shown(options_.name),
               " cannot name the function of a scene; give a C++ name that nothing else has, such as scene"));
  }
  // `used`: columns before the node on its line; `tail`: what follows it there
  void writeNode(Node& node, std::size_t indent, std::size_t used, std::size_t tail) {
    if (node.name.empty() || node.name.find('/') != node.name.npos)
      throw Error(node.path(), "the name of a node of a typed scene is not empty and has no '/'; rename it");
    std::vector<std::string> parts;
    for (auto& entry : node.components())
      if (classes_.infoOf(entry).role != RoleKind::engine || lives(node, entry))
        parts.push_back(components_.inTree(node, entry));
    addLinks(node, parts);
    const std::string head = text("node<", cpp_literal(node.name), ">(");
    tree_ += head;
    std::size_t width = used + head.size() + 1 + tail;
    bool flat = node.children().empty();
    for (auto const& part : parts) width += part.size() + 2;
    flat = flat && width <= lineWidth + 2;
    const std::string pad = flat ? "" : text('\n', std::string(indent + 4, ' '));
    std::size_t left = parts.size() + node.children().size();
    for (std::size_t i = 0; i < parts.size(); ++i) {
      --left;
      tree_ += flat ? (i ? " " : "") : pad;
      tree_ += flat ? parts[i] : fit(parts[i], indent + 4, indent + 4, left ? 1 : tail + 1);
      if (left) tree_ += ',';
    }
    for (auto const& child : node.children()) {
      --left;
      tree_ += pad;
      writeNode(*child, indent + 4, indent + 4, left ? 1 : tail + 1);
      if (left) tree_ += ',';
    }
    tree_ += ')';
  }
  // whether an engine is evaluated again while the scene runs
  bool lives(Node& node, Entry const& entry) {
    return scene_.root.live.find(BakeLinks<R>::pathFrom(scene_.root, node), entry.name) != nullptr;
  }
  // what follows other values while the scene runs: links of the top node
  void addLinks(Node& node, std::vector<std::string>& parts) {
    for (auto const& target : node.live.targets)
      for (LiveLink const& link : target.links) {
        auto refuse = [&](std::string_view why) {
          throw Error(text(node.path(), target.node.empty() ? "" : "/", target.node),
                      text(link.to.field,
                           " of '",
                           target.component,
                           "' follows ",
                           link.from.field,
                           " of '",
                           link.from.component,
                           "' while the scene runs, which a typed scene cannot express: ",
                           why));
        };
        if (&node != &scene_.root) refuse("the scene is a part of another one; bake it by itself");
        if (link.from.list >= 0 || link.to.list >= 0)
          refuse("it is one of several lists under numbers; give the engine one list");
        if (link.pointsTo > 0) refuse("points become frames; let an engine make frames (QuatToRigidEngine)");
        parts.push_back(
            text("data_link(", valueAt(link.from, refuse), "{}, ", valueAt(link.to, refuse), "{})"));
      }
  }
  template <class F>
  std::string valueAt(LiveValue const& value, F const& refuse) {
    Node* const at = scene_.root.find_node(value.node);
    Entry* const entry = at ? at->find(value.component) : nullptr;
    if (!entry) refuse(text("'", value.component, "' is not there"));
    for (auto const& other : at->components()) {
      if (&other == entry) break;
      if (other.component.type() == entry->component.type())
        refuse(text("there are several ", entry->component.name(), " in the node; give each its own"));
    }
    ClassInfo const& info = classes_.infoOf(*entry);
    std::size_t field = 0;
    while (field < info.fields.size() && info.fields[field].offset != value.offset) ++field;
    if (field == info.fields.size()) refuse(text("'", value.component, "' has no ", value.field));
    std::string member = classes_.memberOf(*entry, field);
    if (info.role == RoleKind::visualModel) member = "position";
    return text(
        "At<", cpp_literal(value.node), ", &", class_name(info, classes_.codeOf(*entry)), "::", member, ">");
  }
  std::string whole() const {
    namespace fs = std::filesystem;
    const bool first = options_.name == "scene";
    auto constant = [&](std::string_view type, std::string_view name, std::string const& value) {
      const std::string own =
          first ? std::string(name) : text(options_.name, components_.raised(std::string(name)));
      return text("constexpr ", type, ' ', own, " = ", value, ";");
    };
    std::string cpp = text("// The scene ",
                           cpp_literal(fs::path(path_).filename().string()),
                           ", baked by Sinew: change the scene file and bake it again.\n#pragma once\n\n");
    const bool onDevice =
        components_.locals.find("<Cuda") != components_.locals.npos || tree_.find("<Cuda") != tree_.npos;
    if (onDevice) cpp += "#include <sinew/gpu/gpu.hpp>\n\n";
    cpp += "#include <sinew/sinew.hpp>\n";
    std::set<std::string> more = components_.headers;
    more.insert(options_.includes.begin(), options_.includes.end());
    for (auto const& include : more) cpp += text("#include <", include, ">\n");
    cpp +=
        "\n#include <array>\n#include <string>\n#include <vector>\n\nnamespace baked {\n\nusing namespace "
        "sinew;\n\n";
    cpp += constant("double", "dt", safe_cpp(write_value(scene_.dt))) + "  // [s]\n";
    if (scene_.step > 0 && std::isfinite(scene_.time)) {
      cpp += "// a checkpoint: init(startTime, startStep)\n";
      cpp += constant("double", "startTime", safe_cpp(write_value(scene_.time))) + "  // [s]\n";
      cpp += constant("long", "startStep", std::to_string(scene_.step)) + '\n';
    }
    cpp += '\n' + components_.lists;
    std::string data = options_.data.empty() ? folder_.generic_string() : options_.data;
    if (components_.readsFiles) cpp += "/// The scene; data files lie in the folder `data`.\n";
    cpp += fit(text("inline auto ",
                    options_.name,
                    components_.readsFiles ? text("(std::string const& data = ", cpp_literal(data), ')')
                                           : std::string("()")),
               0,
               0,
               2);
    cpp +=
        text(" {\n", components_.locals, "  return Simulation{", tree_, "};\n}\n\n}  // namespace baked\n");
    return cpp;
  }
};

}  // namespace detail

template <class R>
std::string bake_text(ReadScene<R> scene, std::string const& path, BakeOptions const& options) {
  return detail::Baker<R>(scene, path, options).write();
}

}  // namespace sinew
