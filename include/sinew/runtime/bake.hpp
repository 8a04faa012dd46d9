// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/cpp_layout.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>
#include <sinew/scene/simulation.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <typeinfo>

namespace sinew {

namespace detail {

/// What C++ text needs of the type of a field.
struct TypeCode {
  std::type_info const* type = nullptr;
  bool optional = false;
  // of a list: "Vec<double, 3>", and the array of constants that it is made from: "double values[][3]"
  std::string element{}, array{};
  bool copied = false;  // the constants are the elements
};
/// And of a field, beside its FieldInfo: the pointer to its member as the compiler spells it.
struct FieldCode {
  std::string_view spelled;
  TypeCode const& (*type)();
};
/// And of a class: its fields are those of its ClassInfo.
struct ClassCode {
  std::string_view spelled;  // "sinew::CGLinearSolver<sinew::GraphScattered>"
  bool generates;            // a topology that has to be made before it is looked at
  FieldCode const* fields;
};

template <class T>
TypeCode const& type_code() {
  static const TypeCode code = [] {
    TypeCode made{.type = &typeid(T)};
    made.optional = requires(T value) { value.has_value(); };
    auto number = []<class S>(std::type_identity<S>) -> std::string_view {
      return std::is_same_v<S, bool>  ? "bool"
             : std::is_same_v<S, int> ? "int"
             : sizeof(S) == 8         ? "double"
                                      : "float";
    };
    if constexpr (DynamicList<T>) {
      using E = typename T::value_type;
      if constexpr (std::is_arithmetic_v<E>) {
        made = {made.type, false, std::string(number(std::type_identity<E>{})), "", true};
      } else if constexpr (is_eigen<E>) {
        constexpr int n = E::SizeAtCompileTime;
        const std::string_view real = number(std::type_identity<typename E::Scalar>{});
        if (E::ColsAtCompileTime == 1 && n > 1)
          made = {
              made.type, false, text("Vec<", real, ", ", n, '>'), text(real, " values[][", n, ']'), false};
      } else if constexpr (requires { std::tuple_size<E>::value; } && !HasFields<E>) {
        const std::string_view one = number(std::type_identity<typename E::value_type>{});
        made = {made.type, false, text("std::array<", one, ", ", std::tuple_size_v<E>, '>'), "", true};
      } else {
        made.element = std::string(type_name<E>());
      }
      if (made.copied) made.array = text(made.element, " values[]");
    }
    return made;
  }();
  return code;
}

/// A function that returns a list. Numbers stand in constant arrays, which compile fast however long they
/// are.
inline std::string list_function(TypeCode const& type, std::string const& all, std::string const& name) {
  std::string lines = text("inline auto ", name, "() {\n");
  auto statement = [&](std::string const& cpp) { lines += text("  ", fit(cpp, 2, 2, 1), ";\n"); };
  const std::string vector = text("std::vector<", type.element, '>');
  if (type.array.empty()) {
    statement(text("return ", vector, all));
  } else {
    statement(text("static constexpr ", type.array, " = ", all));
    if (type.copied) {
      statement(text("return ", vector, "(std::begin(values), std::end(values))"));
    } else {
      statement(text(vector, " list"));
      statement(text("for (auto const& v : values) list.push_back(Eigen::Map<", type.element, " const>(v))"));
      statement("return list");
    }
  }
  return lines + "}\n";
}

template <auto Member>
consteval std::string_view spelled_member() {
  return __PRETTY_FUNCTION__;
}
/// The name of a member, from how the compiler spells a pointer to it; "mesh.positions" of a list of a Mesh.
inline std::string member_name(std::string_view spelled, std::string_view fieldName) {
  if (spelled.starts_with("mesh.")) return std::string(spelled);
  spelled = spelled.substr(0, spelled.find_first_of(";]"));
  if (const std::size_t at = spelled.rfind("::"); at != spelled.npos)
    if (is_identifier(spelled.substr(at + 2))) return std::string(spelled.substr(at + 2));
  return camel_case(fieldName);
}
/// The name of a class, with the arguments of a template that `name` leaves out.
inline std::string class_name(ClassInfo const& info, ClassCode const& code) {
  std::string type(code.spelled);
  for (std::size_t at = 0; (at = type.find("sinew::", at)) != type.npos;) type.erase(at, 7);
  const bool more = type.starts_with(text(info.name, '<')) && info.cppName.find('<') == info.cppName.npos;
  return more ? type : info.cppName;
}

template <class C, auto const& List, std::size_t... I>
constexpr void add_field_codes(FieldCode*& to, std::index_sequence<I...>) {
  ((*to++ = {spelled_member<boost::hana::at_c<I>(List).member>(),
             &type_code<std::decay_t<decltype(std::declval<C&>().*(boost::hana::at_c<I>(List).member))>>}),
   ...);
}
template <class C, auto const& List>
constexpr void add_field_codes(FieldCode*& to) {
  add_field_codes<C, List>(to, std::make_index_sequence<decltype(boost::hana::length(List))::value>{});
}
// in the order of field_rows
template <class C>
inline constexpr auto field_codes = [] {
  std::array<FieldCode, field_count<C>> codes{};
  FieldCode* to = codes.data();
  add_field_codes<C, fields_of_class<C>>(to);
  add_field_codes<C, state_fields_of_class<C>>(to);
  add_field_codes<C, outputs_of_class<C>>(to);
  if constexpr (HoldsMesh<C>) {
    *to++ = {"mesh.positions", &type_code<decltype(Mesh::positions)>};
    *to++ = {"mesh.edges", &type_code<decltype(Mesh::edges)>};
    *to++ = {"mesh.triangles", &type_code<decltype(Mesh::triangles)>};
    *to++ = {"mesh.quads", &type_code<decltype(Mesh::quads)>};
  }
  return codes;
}();
template <class... Cs>
constexpr auto class_codes(TypeList<Cs...>) {
  return std::array<ClassCode, sizeof...(Cs)>{
      ClassCode{type_name<Cs>(), Generates<Cs>, field_codes<Cs>.data()}...};
}

/// The C++ of a value as FieldInfo gives it, to initialise a member with.
inline std::string initialiser(TypeCode const& type, std::string const& cpp) {
  // an optional takes what it holds as one argument
  const bool wrap = type.optional && cpp.starts_with('{') && cpp != "{}";
  return safe_cpp(wrap ? text('{', cpp, '}') : cpp);
}

/// Writes the typed scene of a runtime tree. Components whose data others take by links, and engines, become
/// local variables, written before what needs them.
template <class R>
class Baker {
  using Node = RuntimeNode<R>;
  using Entry = RuntimeEntry<R>;

 public:
  Baker(ReadScene<R>& scene, std::string const& path, BakeOptions const& options)
      : scene_(scene), path_(path), options_(options), table_(make_class_table<R>()) {
    namespace fs = std::filesystem;
    folder_ = fs::absolute(fs::path(path)).lexically_normal().parent_path();
  }

  std::string write() {
    checkName();
    // a scene that cannot be initialised is not baked; the error is the one that a run would give
    Simulation<Node>{scene_.root}.init();
    // a component may be linked to before it is known that it has to be a variable
    for (std::size_t known = variables_.size() + 1; known != variables_.size();) {
      known = variables_.size();
      start();
      tree_.clear();
      writeNode(scene_.root, 2, 2 + std::string_view("return Simulation{").size(), 2);
    }
    return whole();
  }

 private:
  struct Source {
    Node* node;
    Entry* entry;
    std::size_t field;
  };
  ReadScene<R>& scene_;
  std::string const& path_;
  BakeOptions const& options_;
  std::vector<ClassInfo> table_;
  static constexpr auto code_ = class_codes(typename AnyComponent<R>::List{});
  std::filesystem::path folder_{};
  std::set<Entry const*> variables_{};  // components that are local variables
  // of one pass
  std::map<Entry const*, std::string> names_{};
  std::map<std::string, std::string> functions_{};  // of a list, by what it returns
  std::set<std::string, std::less<>> taken_{};
  std::set<std::string> headers_{};  // of components, beside sinew.hpp
  std::string locals_{}, lists_{}, tree_{};
  std::set<Entry const*> busy_{};  // components being written
  bool readsFiles_ = false;

  ClassInfo const& infoOf(Entry const& entry) const { return table_[std::size_t(entry.component.type())]; }
  ClassCode const& codeOf(Entry const& entry) const { return code_[std::size_t(entry.component.type())]; }
  std::string memberOf(Entry const& entry, std::size_t field) const {
    return member_name(codeOf(entry).fields[field].spelled, infoOf(entry).fields[field].name);
  }

  void checkName() {
    bool taken = !is_identifier(options_.name);
    for (auto name : reservedNames) taken = taken || name == options_.name;
    for (auto const& info : table_)
      taken = taken || info.cppName.substr(0, info.cppName.find('<')) == options_.name;
    if (taken)
      throw Error(
          "bake",
          text(shown(options_.name),
               " cannot name the function of a scene; give a C++ name that nothing else has, such as scene"));
  }
  void start() {
    names_.clear(), functions_.clear(), taken_.clear();
    locals_.clear(), lists_.clear();
    readsFiles_ = false;
    for (auto name : reservedNames) taken_.emplace(name);
    taken_.insert(options_.name);
  }
  std::string unique(std::string const& name) {
    std::string free = name;
    for (int n = 2; !taken_.insert(free).second; ++n) free = text(name, n);
    return free;
  }
  static std::string raised(std::string name) {
    if (!name.empty() && name[0] >= 'a' && name[0] <= 'z') name[0] = char(name[0] - 'a' + 'A');
    return name;
  }

  // interactions, and mappings with several parents

  std::array<Node*, 2> endsOf(Node& node, Entry const& entry) const {
    std::array<Node*, 2> ends{nullptr, nullptr};
    entry.component
        .template visit<role::InteractionForceField, role::ProjectiveConstraint, role::LagrangianConstraint>(
            [&](auto const& joint) {
              if constexpr (requires { joint.ends.object1; })
                ends = {node.resolve(joint.ends.object1), node.resolve(joint.ends.object2)};
            });
    return ends;
  }
  // "../left"
  static std::string relativePath(Node const& node, Node const& to) {
    std::string up;
    for (Node const* at = &node; at; at = at->parent()) {
      for (Node const* below = &to; below; below = below->parent())
        if (below == at) {
          const std::string down = pathFrom(*at, to);
          return down.empty() ? up : up.empty() ? down : text(up, '/', down);
        }
      up += up.empty() ? ".." : "/..";
    }
    return up;
  }
  std::string parentsOf(Node& node, Entry const& entry) const {
    std::string all;
    entry.component.template visit<role::Mapping>([&](auto const& mapping) {
      if constexpr (requires { mapping.parents.paths; })
        for (auto const& path : mapping.parents.paths)
          all += text(all.empty() ? "" : ", ", cpp_literal(relativePath(node, *node.resolve(path))));
    });
    return all;
  }
  static std::string pathFrom(Node const& above, Node const& node) {
    std::string path;
    for (Node const* at = &node; at != &above; at = at->parent())
      path = path.empty() ? at->name : text(at->name, '/', path);
    return path;
  }

  // where linked values come from

  Entry* named(Node& node, std::string_view name) const {
    if (Entry* entry = node.find(name)) return entry;
    for (auto& entry : node.components())
      if (infoOf(entry).known(name)) return &entry;
    return nullptr;
  }
  // the component that a link leads to, and the name behind its dot; as read_scene follows links
  std::pair<Node*, Entry*> follow(Node& from, Entry const& entry, std::string_view link,
                                  std::string& data) const {
    const std::optional<LinkWords> words = read_link(link);
    if (!words) return {};
    data = words->data;
    if (words->offset) {
      const long at = long(&entry - from.components().data()) + *words->offset;
      if (at < 0 || at >= long(from.components().size())) return {};
      return {&from, &from.components()[std::size_t(at)]};
    }
    const std::string_view path = words->path;
    for (Node* at = path.starts_with('/') ? &from.top() : &from; at;
         at = words->based ? nullptr : at->parent())
      if (const auto found = walk(*at, path); found.second) return found;
    return {};
  }
  std::pair<Node*, Entry*> walk(Node& from, std::string_view path) const {
    Node* at = &from;
    while (!path.empty()) {
      const std::string_view step = path.substr(0, path.find('/'));
      path.remove_prefix(std::min(step.size() + 1, path.size()));
      if (step == "..") {
        at = at->parent();
      } else if (!step.empty() && step != ".") {
        if (Entry* entry = named(*at, step); entry && path.empty()) return {at, entry};
        Node* const child = at->find_node(step);
        if (!child && !at->parent() && step == at->name) continue;
        at = child;
      }
      if (!at) return {};
    }
    return {at, at->state()};
  }

  /// The first of the chain of links that ends at this field which holds the same value in the same type.
  std::optional<Source> source(Node& node, Entry& entry, std::size_t field, std::size_t depth = 0) const {
    ClassInfo const& info = infoOf(entry);
    const auto link = entry.links.find(info.fields[field].name);
    if (options_.embed || link == entry.links.end() || depth > 1000) return {};
    std::string data;
    const auto [at, from] = follow(node, entry, link->second, data);
    if (!from) return {};
    const std::string value = info.fields[field].write(entry.component.address());
    std::vector<std::pair<Entry*, std::string_view>> places{{from, data}};
    // a state takes its points from the topology of its node, and rests where it starts
    if (infoOf(*from).role == RoleKind::state) {
      places.push_back({from, "position"});
      if (at->topology()) places.push_back({at->topology(), "position"});
    }
    for (auto const& [place, name] : places) {
      // the type of an interaction says where it stands
      if (infoOf(*place).joins || infoOf(*place).severalParents || busy_.count(place)) continue;
      auto const& fields = infoOf(*place).fields;
      std::optional<std::size_t> found;
      for (std::size_t f = 0; f < fields.size(); ++f)
        if (fields[f].known(name) && (!found || !fields[f].isInput)) found = f;
      if (!found || *codeOf(*place).fields[*found].type().type != *codeOf(entry).fields[field].type().type ||
          fields[*found].write(place->component.address()) != value)
        continue;
      if (fields[*found].isInput)
        if (auto deeper = source(*at, *place, *found, depth + 1)) return deeper;
      return Source{at, place, *found};
    }
    return {};
  }

  // values

  /// The name of the variable that holds a component; it is written first.
  std::string variable(Node& node, Entry& entry) {
    variables_.insert(&entry);
    if (auto known = names_.find(&entry); known != names_.end()) return known->second;
    const std::string cpp = component(node, entry);
    std::string name = camel_case(entry.name);
    if (name.empty()) name = camel_case(infoOf(entry).name);
    name = unique(name);
    names_[&entry] = name;
    const std::size_t brace = className(node, entry).size();
    locals_ += text("  ", fit(text(cpp.substr(0, brace), ' ', name, cpp.substr(brace)), 2, 2, 1), ";\n");
    const std::string where = cpp_literal(text(node.path(), ": ", entry.name));
    if (infoOf(entry).role == RoleKind::engine)
      locals_ += text("  ", fit(text(name, ".update(", where, ")"), 2, 2, 1), ";\n");
    else if (codeOf(entry).generates)
      locals_ += text("  ", fit(text(name, ".generate(", where, ")"), 2, 2, 1), ";\n");
    return name;
  }

  std::string value(Node& node, Entry& entry, std::size_t field) {
    ClassInfo const& info = infoOf(entry);
    if (auto from = source(node, entry, field))
      return text(variable(*from->node, *from->entry), '.', memberOf(*from->entry, from->field));
    if (info.fields[field].isFile)
      return file(node, entry, info.fields[field].write(entry.component.address()));
    TypeCode const& type = codeOf(entry).fields[field].type();
    const std::string cpp = initialiser(type, info.fields[field].cpp(entry.component.address()));
    if (cpp.size() < 1000 || type.element.empty()) return cpp;
    const std::string wanted = text(type.element, cpp);
    auto known = functions_.find(wanted);
    if (known == functions_.end()) {
      std::string member = memberOf(entry, field);
      member.erase(0, member.find('.') + 1);
      const std::string name = unique(text(options_.name, raised(camel_case(node.name)), raised(member)));
      known = functions_.emplace(wanted, name).first;
      lists_ += list_function(type, cpp, name) + '\n';
    }
    return known->second + "()";
  }

  std::string file(Node& node, Entry& entry, std::string const& path) {
    namespace fs = std::filesystem;
    if (options_.embed)
      throw Error(
          entry.origin.empty() ? node.path() : entry.origin,
          text(infoOf(entry).name,
               " reads the file ",
               shown(path),
               " when the scene starts, which --embed cannot avoid; read it by a loader and link to that "
               "(src=\"@loader\"), or bake without --embed"));
    const std::string relative =
        fs::absolute(fs::path(path)).lexically_normal().lexically_relative(folder_).generic_string();
    if (relative.empty()) return text('{', cpp_literal(path), '}');
    readsFiles_ = true;
    return text("{data + ", cpp_literal(text('/', relative)), '}');
  }

  /// "UniformMass<Vec3d>{.totalMass = 2}".
  std::string component(Node& node, Entry& entry) {
    ClassInfo const& info = infoOf(entry);
    if (!info.traits.header.empty()) headers_.emplace(info.traits.header);
    busy_.insert(&entry);
    std::string members, mesh;
    for (std::size_t f = 0; f < info.fields.size(); ++f) {
      FieldInfo const& field = info.fields[f];
      if (!field.isInput || field.write(entry.component.address()) == field.defaultValue) continue;
      const std::string member = memberOf(entry, f);
      const bool ofMesh = member.starts_with("mesh.");
      std::string& to = ofMesh ? mesh : members;
      to += text(to.empty() ? "" : ", ", '.', member.substr(ofMesh ? 5 : 0), " = ", value(node, entry, f));
    }
    busy_.erase(&entry);
    if (!mesh.empty()) members = text(".mesh = {", mesh, '}', members.empty() ? "" : ", ", members);
    return text(className(node, entry), '{', members, '}');
  }
  std::string className(Node& node, Entry& entry) const {
    std::string name = class_name(infoOf(entry), codeOf(entry));
    if (infoOf(entry).severalParents) {
      constexpr std::string_view linked = "LinkedParents>";
      if (!name.ends_with(linked))
        throw Error(node.path(),
                    text(name, " names its parents in a way that a typed scene cannot express; remove it"));
      name.resize(name.size() - linked.size());
      return text(name, "Parents<", parentsOf(node, entry), ">>");
    }
    const auto ends = endsOf(node, entry);
    if (!ends[0]) return name;
    constexpr std::string_view linked = ", Linked>";
    if (!name.ends_with(linked))
      throw Error(node.path(),
                  text(name, " joins two nodes in a way that a typed scene cannot express; remove it"));
    name.resize(name.size() - linked.size());
    return text(name,
                ", Between<",
                cpp_literal(pathFrom(node, *ends[0])),
                ", ",
                cpp_literal(pathFrom(node, *ends[1])),
                ">>");
  }

  // the tree

  // `used`: columns before the node on its line; `tail`: what follows it there
  void writeNode(Node& node, std::size_t indent, std::size_t used, std::size_t tail) {
    if (node.name.empty() || node.name.find('/') != node.name.npos)
      throw Error(node.path(), "the name of a node of a typed scene is not empty and has no '/'; rename it");
    std::vector<std::string> parts;
    for (auto& entry : node.components())
      if (infoOf(entry).role != RoleKind::engine)
        parts.push_back(variables_.count(&entry) ? variable(node, entry) : component(node, entry));
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
  std::string whole() const {
    namespace fs = std::filesystem;
    const bool first = options_.name == "scene";
    auto constant = [&](std::string_view type, std::string_view name, std::string const& value) {
      const std::string own = first ? std::string(name) : text(options_.name, raised(std::string(name)));
      return text("constexpr ", type, ' ', own, " = ", value, ";");
    };
    std::string cpp = text("// The scene ",
                           cpp_literal(fs::path(path_).filename().string()),
                           ", baked by Sinew: change the scene file and bake it again.\n#pragma once\n\n");
    const bool onDevice = locals_.find("<Cuda") != locals_.npos || tree_.find("<Cuda") != tree_.npos;
    if (onDevice) cpp += "#include <sinew/gpu/gpu.hpp>\n\n";
    cpp += "#include <sinew/sinew.hpp>\n";
    std::set<std::string> more = headers_;
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
    cpp += '\n' + lists_;
    std::string data = options_.data.empty() ? folder_.generic_string() : options_.data;
    if (readsFiles_) cpp += "/// The scene; data files lie in the folder `data`.\n";
    cpp += fit(
        text("inline auto ",
             options_.name,
             readsFiles_ ? text("(std::string const& data = ", cpp_literal(data), ')') : std::string("()")),
        0,
        0,
        2);
    cpp += text(" {\n", locals_, "  return Simulation{", tree_, "};\n}\n\n}  // namespace baked\n");
    return cpp;
  }
};

}  // namespace detail

template <class R>
std::string bake_text(ReadScene<R> scene, std::string const& path, BakeOptions const& options) {
  return detail::Baker<R>(scene, path, options).write();
}

}  // namespace sinew
