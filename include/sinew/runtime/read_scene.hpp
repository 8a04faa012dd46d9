// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/engine/transform_engine.hpp>
#include <sinew/force/gravity.hpp>
#include <sinew/runtime/class_table.hpp>
#include <sinew/runtime/dialect.hpp>
#include <sinew/runtime/node.hpp>
#include <sinew/runtime/xml_document.hpp>

#include <map>
#include <memory>
#include <set>

namespace sinew {

struct ReadSceneOptions {
  std::vector<std::string> dataPaths{};  // where files are looked for that are not beside the scene
  bool lenient = false;                  // an unknown class is a warning
  std::vector<std::pair<std::string, std::string>> set{};  // "liver/fem.youngModulus" and its value
};

/// A scene file as a runtime tree, and what was noticed on the way.
template <class R>
struct ReadScene {
  RuntimeNode<R> root;
  double dt = 0.01;
  double time = 0;  // of a checkpoint
  long step = 0;
  std::vector<std::string> ignored{};   // classes and attributes without a meaning here, each once
  std::vector<std::string> warnings{};  // what is not simulated, and what was repaired
  std::vector<std::string> files{};     // data files that were read
};

/// All that is wrong with a scene file, one message a line, each with file, line and column.
struct SceneError : Error {
  std::vector<std::string> messages;
  explicit SceneError(std::vector<std::string> all) : Error("", joined(all)), messages(std::move(all)) {}

 private:
  static std::string joined(std::vector<std::string> const& all) {
    std::string lines;
    for (auto const& m : all) lines += text(lines.empty() ? "" : "\n", m);
    return lines;
  }
};

namespace detail {

/// Builds a runtime tree from the elements of a scene file, in SOFA's dialect. Links between components are
/// followed when a value is asked for, so that the order in the file does not matter.
template <class R>
class SceneReader {
 public:
  SceneReader(ReadSceneOptions const& options)
      : options_(options), xml_(options.dataPaths), table_(make_class_table<R>()) {}

  ReadScene<R> read(std::string const& path) { return build(xml_.read(path)); }
  ReadScene<R> parse(std::string const& path, std::string content) {
    return build(xml_.parse(path, std::move(content)));
  }

 private:
  struct Place;
  enum class Progress { fresh, busy, done };
  struct Item {
    Place* place;
    XmlElement* element;
    std::string tag, name;
    std::vector<ClassInfo const*> candidates{};
    ClassInfo const* info = nullptr;
    std::unique_ptr<AnyComponent<R>> component{};
    Progress progress = Progress::fresh;
    std::map<std::string, std::string, std::less<>> links{};
    std::array<std::string, 2> ends{};
    std::vector<std::string> parents{};  // of a mapping with several
    Place* home = nullptr;               // of an interaction: the node above both its ends, where it belongs
    bool failed = false;

    void* address() const { return component->address(); }
  };
  struct Place {
    XmlElement* element;
    std::string name;
    Place* parent = nullptr;
    std::vector<std::unique_ptr<Place>> children{};
    std::vector<std::unique_ptr<Item>> items{};
    std::string state{};  // DataTypes of the state of this node; empty: none
    bool visual = false;
    std::vector<XmlElement*> newton{};  // settings for ODE solvers
    std::vector<XmlElement*> preconditioners{};

    Item* find(std::string_view itemName) const {
      for (auto const& item : items)
        if (item->name == itemName) return item.get();
      for (auto const& item : items)
        if (item->tag == itemName || (item->info && item->info->name == itemName)) return item.get();
      return nullptr;
    }
    Place* child(std::string_view childName) const {
      for (auto const& c : children)
        if (c->name == childName) return c.get();
      return nullptr;
    }
    /// The component of a role; of several topologies the last, as in SOFA.
    Item* ofRole(RoleKind role) const {
      Item* found = nullptr;
      for (auto const& item : items)
        if (item->info && item->info->role == role && (!found || role == RoleKind::topology))
          found = item.get();
      return found;
    }
    /// The nearest node upwards, from this one on, that has a state.
    Place const* owner() const { return !state.empty() ? this : parent ? parent->owner() : nullptr; }
    bool above(Place const& other) const { return this == &other || (other.parent && above(*other.parent)); }
    std::string path() const { return parent ? text(parent->path(), '/', name) : text('/', name); }
  };

  ReadSceneOptions const& options_;
  XmlReader xml_;
  std::vector<ClassInfo> table_;
  std::vector<std::string> errors_{};
  std::set<std::string, std::less<>> ignored_{}, warnings_{};
  std::vector<std::string> files_{};
  std::vector<Item*> moved_{};
  std::set<XmlElement const*> takenNewton_{}, takenPreconditioners_{};
  std::vector<std::unique_ptr<XmlElement>> made_{};  // elements that stand for what an attribute asks for

  void complain(std::string const& place, std::string_view what) {
    errors_.push_back(text(place, ": ", what));
  }
  void complain(XmlElement const& at, std::string_view what) {
    complain(at.place(), text('<', at.tag, ">: ", what));
  }

  ReadScene<R> build(XmlElement root) {
    if (root.tag != "Node")
      throw SceneError(
          {text(root.place(), ": <", root.tag, ">: the outermost element of a scene is <Node>")});
    for (auto const& [path, value] : options_.set) override_(root, path, value);
    Place top{&root, nameOf(root, "root"), nullptr};
    collect(top);
    setNewton(top);
    warnOfLooseNewton(top);
    setPreconditioners(top);
    splitVisuals(top);
    decideStates(top);
    decideClasses(top);
    forEachItem(top, [&](Item& item) { connect(item); });
    forEachItem(top, [&](Item& item) {
      if (item.info) prepare(item);
    });
    forEachItem(top, [&](Item& item) {
      if (item.info) resolve(item);
    });
    forEachItem(top, [&](Item& item) {
      if (item.home && item.home != item.place) moved_.push_back(&item);
    });
    ReadScene<R> scene{RuntimeNode<R>(top.name)};
    readNode(top, scene);
    fill(top, scene.root);
    throwErrors();
    scene.ignored.assign(ignored_.begin(), ignored_.end());
    scene.warnings.assign(warnings_.begin(), warnings_.end());
    scene.warnings.insert(scene.warnings.end(), xml_.warnings.begin(), xml_.warnings.end());
    scene.files = files_;
    return scene;
  }
  void throwErrors() {
    if (!errors_.empty()) throw SceneError(errors_);
  }
  template <class F>
  void forEachItem(Place& place, F&& f) {
    for (std::size_t i = 0; i < place.items.size(); ++i) f(*place.items[i]);
    for (auto& child : place.children) forEachItem(*child, f);
  }

  static std::string nameOf(XmlElement const& element, std::string_view otherwise) {
    auto const* name = element.attribute("name");
    std::string given = name && !name->value.empty() ? name->value : std::string(otherwise);
    for (char& c : given)
      if (c == '/' || c == ' ') c = '_';
    return given;
  }

  // --set path.attribute=value
  void override_(XmlElement& root, std::string const& path, std::string const& value) {
    const std::size_t dot = path.rfind('.');
    if (dot == path.npos)
      throw SceneError({text("--set ", path, ": name an attribute, as in liver/fem.youngModulus=1000")});
    XmlElement* at = &root;
    std::string_view rest = std::string_view(path).substr(0, dot);
    while (!rest.empty()) {
      const std::string_view step = rest.substr(0, rest.find('/'));
      rest.remove_prefix(std::min(step.size() + 1, rest.size()));
      XmlElement* next = nullptr;
      std::vector<std::string> known;
      for (auto& child : at->children) {
        known.push_back(nameOf(child, child.tag));
        if (!next && (known.back() == step || (child.tag != "Node" && child.tag == step))) next = &child;
      }
      if (!next && at == &root && step == nameOf(root, "root")) continue;
      if (!next) {
        const std::string nearest = nearest_name(step, known);
        throw SceneError({text("--set ",
                               path,
                               ": there is no '",
                               step,
                               "' in '",
                               nameOf(*at, at->tag),
                               "'",
                               nearest.empty() ? std::string("; name a node or a component")
                                               : text("; did you mean '", nearest, "'?"))});
      }
      at = next;
    }
    at->set(std::string_view(path).substr(dot + 1), value);
  }

  // nodes and components, of whatever class

  void collect(Place& place) {
    std::map<std::string, int> names;
    for (auto& child : place.element->children) {
      if (child.tag == "Node") {
        auto const* active = child.attribute("activated");
        if (active && (active->value == "0" || active->value == "false")) {
          ignored_.insert(text("Node ", nameOf(child, "Node"), " (activated is 0)"));
          continue;
        }
        std::string name = nameOf(child, "Node");
        if (const int n = names[name]++) {
          const std::string renamed = text(name, '_', n + 1);
          if (child.attribute("name"))
            warnings_.insert(text(
                child.place(), ": a second node is named '", name, "'; it is called '", renamed, "' here"));
          name = renamed;
        }
        place.children.push_back(std::make_unique<Place>(Place{&child, name, &place}));
        collect(*place.children.back());
      } else if (const std::string tag = tagOf(child); tag == "NewtonRaphsonSolver") {
        hasNoChildren(child);
        place.newton.push_back(&child);
      } else if (dialect::preconditioner_named(tag)) {
        hasNoChildren(child);
        place.preconditioners.push_back(&child);
      } else if (tag == "BoxConstraint") {
        boxConstraint(place, child);
      } else if (dialect::has(dialect::implicitWithCG, tag)) {
        cgImplicit(place, child);
      } else if (auto item = makeItem(place, child)) {
        place.items.push_back(std::move(item));
      }
    }
  }
  static std::string tagOf(XmlElement const& element) {
    auto const* type = element.tag == "Object" ? element.attribute("type") : nullptr;
    return type ? type->value : element.tag;
  }
  void hasNoChildren(XmlElement const& component) {
    for (auto const& child : component.children)
      complain(child,
               text("stands inside <", component.tag, ">, but a component has attributes only; move it out"));
  }

  // an element of another class that stands for a part of what an element asks for
  XmlElement& partOf(XmlElement const& element, std::string_view tag) {
    made_.push_back(std::make_unique<XmlElement>(
        XmlElement{.tag = std::string(tag), .file = element.file, .offset = element.offset}));
    return *made_.back();
  }
  void addItem(Place& place, XmlElement& element) {
    if (auto item = makeItem(place, element)) place.items.push_back(std::move(item));
  }

  // <BoxConstraint box="..."/> stands for a BoxROI and a FixedProjectiveConstraint of what is in it
  void boxConstraint(Place& place, XmlElement& element) {
    hasNoChildren(element);
    const std::string name = nameOf(element, "BoxConstraint") + "_roi";
    XmlElement& roi = partOf(element, "BoxROI");
    XmlElement& fixed = partOf(element, "FixedProjectiveConstraint");
    fixed.attributes = {{"indices", text('@', name, ".indices"), element.offset}};
    for (auto const& a : element.attributes)
      if (a.name != "type") (a.name == "name" || a.name == "fixAll" ? fixed : roi).attributes.push_back(a);
    roi.set("name", name);
    addItem(place, roi);
    addItem(place, fixed);
  }

  // <CGImplicit .../> of the first SOFA is an EulerImplicitSolver, damped, with a CGLinearSolver; a node that
  // has a solver gets the latter only
  void cgImplicit(Place& place, XmlElement& element) {
    hasNoChildren(element);
    XmlElement& ode = partOf(element, "EulerImplicitSolver");
    XmlElement& linear = partOf(element, "CGLinearSolver");
    auto const* class_ = classNamed(linear.tag);
    for (auto const& a : element.attributes)
      if (a.name != "type") (class_ && class_->field(a.name) ? linear : ode).attributes.push_back(a);
    ode.set("rayleighStiffness", "0.1", false);
    ode.set("rayleighMass", "0.1", false);
    linear.set("threshold", "1e-5", false);
    linear.set("name", nameOf(element, element.tag) + "_linear");
    if (std::none_of(place.items.begin(), place.items.end(), [](auto const& item) {
          return item->candidates[0]->role == RoleKind::odeSolver;
        }))
      addItem(place, ode);
    addItem(place, linear);
  }
  ClassInfo const* classNamed(std::string_view name) const {
    for (auto const& info : table_)
      if (info.known(name)) return &info;
    return nullptr;
  }

  // NewtonRaphsonSolver holds settings of the ODE solver that links to it; where that names none, of one in
  // its node or above
  void setNewton(Place& place) {
    for (auto& item : place.items)
      if (item->candidates[0]->role == RoleKind::odeSolver) {
        std::string name;
        std::erase_if(item->element->attributes, [&](XmlAttribute const& a) {
          if (a.name != "newtonSolver") return false;
          name = a.value.substr(a.value.find_last_of("@/") + 1);
          std::replace(name.begin(), name.end(), ' ', '_');
          return true;
        });
        XmlElement const* newton = nullptr;
        for (Place* at = &place; at && !newton && !name.empty(); at = at->parent)
          newton = newtonIn(*at, name);
        if (!newton) newton = newtonIn(place, "");
        if (newton) takeNewton(*item, *newton);
      }
    for (auto& child : place.children) setNewton(*child);
  }
  static XmlElement const* newtonIn(Place const& place, std::string_view name) {
    for (XmlElement const* element : place.newton)
      if (name.empty() || nameOf(*element, element->tag) == name) return element;
    for (auto const& child : place.children)
      if (XmlElement const* found = newtonIn(*child, name)) return found;
    return nullptr;
  }
  void warnOfLooseNewton(Place const& place) {
    for (XmlElement const* element : place.newton)
      if (!takenNewton_.count(element))
        warnings_.insert(text(element->place(),
                              ": <NewtonRaphsonSolver>: no ODE solver links to it, stands beside it or "
                              "above; it has no effect"));
    for (auto const& child : place.children) warnOfLooseNewton(*child);
  }
  void takeNewton(Item& item, XmlElement const& newton) {
    takenNewton_.insert(&newton);
    if (!item.candidates[0]->field("maxNbIterationsNewton"))
      return void(warnings_.insert(text(newton.place(),
                                        ": <NewtonRaphsonSolver>: ",
                                        item.tag,
                                        " has no iterations of Newton's method; it has no effect")));
    for (XmlAttribute a : newton.attributes) {
      if (a.name == "name" || a.name == "type") continue;
      if (!a.file) a.file = newton.file;
      if (!item.element->attribute(a.name)) item.element->take(a, true);
    }
    for (auto const& [name, value] : dialect::newtonDefaults) item.element->set(name, value, false);
  }

  // A preconditioner, or the linear solver that is one, is a setting of the solver that links to it.
  void setPreconditioners(Place& place) {
    for (std::size_t i = 0; i < place.items.size(); ++i)
      if (Item& item = *place.items[i]; item.candidates[0]->field("precondition")) {
        std::string link;
        std::erase_if(item.element->attributes, [&](XmlAttribute const& a) {
          if (a.name != "preconditioner" && a.name != "preconditioners") return false;
          link = a.value;
          return true;
        });
        if (!link.empty()) takePreconditioner(item, link);
      }
    for (auto& child : place.children) setPreconditioners(*child);
    std::erase_if(place.items,
                  [&](auto const& item) { return takenPreconditioners_.count(item->element) > 0; });
    for (XmlElement const* element : place.preconditioners)
      if (!takenPreconditioners_.count(element))
        warnings_.insert(
            text(element->place(), ": <", tagOf(*element), ">: no solver links to it; it has no effect"));
  }
  void takePreconditioner(Item& item, std::string const& link, int depth = 0) {
    XmlElement const* const element = solverNamed(*item.place, link);
    if (!element || element == item.element || depth > 2)
      return complain(*item.element, text("there is no preconditioner ", shown(link), "; correct the link"));
    takenPreconditioners_.insert(element);
    auto const* means = dialect::preconditioner_named(tagOf(*element));
    if (means && means->warp) item.element->set("warp", "1", false);
    if (means && !means->updateStep.empty()) item.element->set("update_step", means->updateStep);
    for (XmlAttribute const& a : element->attributes) {
      if (a.name == "omega") item.element->set(a.name, a.value, false);
      if (a.name == "update_step") item.element->set(a.name, a.value);
      // what is warped
      if (means && means->warp && (a.name == "linearSolver" || a.name == "solverName") && !a.value.empty())
        takePreconditioner(item, a.value, depth + 1);
    }
    item.element->set("precondition", means ? means->precondition : "ldl", false);
  }
  // by the last step of the link, in the node or above
  static XmlElement const* solverNamed(Place const& place, std::string const& link) {
    std::string name = link.substr(link.find_last_of("@/") + 1);
    for (Place const* at = &place; at; at = at->parent) {
      for (XmlElement const* element : at->preconditioners)
        if (nameOf(*element, tagOf(*element)) == name) return element;
      for (auto const& item : at->items)
        if (item->name == name && item->candidates[0]->role == RoleKind::linearSolver) return item->element;
    }
    return nullptr;
  }

  std::unique_ptr<Item> makeItem(Place& place, XmlElement& element) {
    const std::string tag = tagOf(element);
    std::string_view known = tag;
    for (auto const& other : dialect::standsFor)
      if (other.name == tag) {
        known = other.className;
        element.set(other.attribute, other.value, false);
      }
    auto item = std::make_unique<Item>(Item{&place, &element, tag, nameOf(element, tag)});
    for (auto const& info : table_)
      if (info.known(known)) item->candidates.push_back(&info);
    if (!item->candidates.empty()) {
      hasNoChildren(element);
      std::erase_if(element.attributes, [](XmlAttribute const& a) {
        return dialect::has(dialect::mayBeEmpty, a.name) && (a.value.empty() || a.value == "@");
      });
      return item;
    }
    if (dialect::class_without_meaning(tag)) {
      ignored_.insert(tag);
    } else if (dialect::has(dialect::notYet, tag)) {
      warnings_.insert(
          text(tag, ": collision and constraint solving are not simulated; the component is ignored"));
    } else {
      const std::string message =
          text("there is no component <", tag, ">", packageOf(tag, suggestion(tag, classNames())));
      if (options_.lenient)
        warnings_.insert(text(element.place(), ": ", message, " It is left out."));
      else
        complain(element.place(), message);
    }
    return nullptr;
  }
  // what to do about a class that is not there for want of a package; else `otherwise`
  static std::string packageOf(std::string_view tag, std::string otherwise) {
    for (auto const& c : dialect::classesOfPackages) {
      bool named = false;
      for_each_name(c.names, [&](std::string_view name) { named = named || name == tag; });
      if (named)
        return text(" in this program, which was built without ",
                    c.package,
                    "; install that (Debian: ",
                    c.debian,
                    ") and build Sinew anew");
    }
    return otherwise;
  }
  std::vector<std::string_view> classNames() const {
    std::vector<std::string_view> names;
    for (auto const& info : table_) {
      names.push_back(info.name);
      for_each_name(info.aliases, [&](std::string_view alias) { names.push_back(alias); });
    }
    return names;
  }
  template <class Names>
  static std::string suggestion(std::string_view word, Names const& known) {
    const std::string nearest = nearest_name(word, known);
    return nearest.empty() ? "; correct the name, or remove it" : text("; did you mean '", nearest, "'?");
  }

  // In SOFA a node may have a state and visual models; here each visual model gets a node of its own below.
  void splitVisuals(Place& place) {
    auto is = [](Item const& item, RoleKind role) { return item.candidates[0]->role == role; };
    const bool hasState = std::any_of(
        place.items.begin(), place.items.end(), [&](auto const& i) { return is(*i, RoleKind::state); });
    std::size_t visuals = 0;
    for (auto const& i : place.items) visuals += is(*i, RoleKind::visualModel);
    for (auto& child : place.children) splitVisuals(*child);
    if (visuals == 0 || (visuals == 1 && !hasState)) return;
    std::vector<std::unique_ptr<Item>> stay;
    std::vector<Place*> moved;
    for (auto& item : place.items)
      if (is(*item, RoleKind::visualModel) && (hasState || !moved.empty())) {
        std::string name = item->name;
        while (place.child(name)) name += '_';
        made_.push_back(std::make_unique<XmlElement>(
            XmlElement{.tag = "Node", .file = item->element->file, .offset = item->element->offset}));
        auto own = std::make_unique<Place>(Place{made_.back().get(),
                                                 name,
                                                 hasState       ? &place
                                                 : place.parent ? &place
                                                                : &place});
        item->place = own.get();
        own->items.push_back(std::move(item));
        moved.push_back(own.get());
        place.children.push_back(std::move(own));
      } else {
        if (is(*item, RoleKind::visualModel)) moved.push_back(nullptr);
        stay.push_back(std::move(item));
      }
    // a mapping follows the visual model that is its output
    place.items.clear();
    for (auto& item : stay) {
      Place* to = nullptr;
      if (is(*item, RoleKind::mapping))
        if (auto const* output = item->element->attribute("output"))
          for (Place* own : moved)
            if (own && (output->value == text('@', own->items[0]->name) ||
                        output->value == text("@./", own->items[0]->name)))
              to = own;
      if (to) {
        item->place = to;
        to->items.push_back(std::move(item));
      } else {
        place.items.push_back(std::move(item));
      }
    }
  }

  // which instantiation

  std::string templateOf(Item const& item) const {
    auto const* given = item.element->attribute("template");
    return given ? canonical_template(given->value) : "";
  }

  void decideStates(Place& place) {
    for (auto& item : place.items) {
      const RoleKind role = item->candidates[0]->role;
      if (role == RoleKind::state) {
        const std::string wanted = templateOf(*item).empty() ? "Vec3d" : templateOf(*item);
        item->info = withTypes(*item, wanted);
        if (item->info && place.state.empty()) place.state = wanted;
      } else if (role == RoleKind::visualModel) {
        item->info = item->candidates[0];
        place.visual = true;
      }
    }
    for (auto& child : place.children) decideStates(*child);
  }

  ClassInfo const* withTypes(Item& item, std::string_view types, std::string_view why = "") {
    std::string known;
    for (auto const* info : item.candidates) {
      if (info->dataTypes == types) return info;
      if (text(", ", known, ", ").find(text(", ", info->dataTypes, ", ")) == std::string::npos)
        known += text(known.empty() ? "" : ", ", info->dataTypes);
    }
    item.failed = true;
    auto const* given = item.element->attribute("template");
    std::string advice;
    if (types.starts_with("Cuda") && !onDevice())
      advice = text("; this program has none of the CUDA DataTypes: take ",
                    types.substr(4),
                    ", or run the scene with the program sinew_cuda, which `cmake --build build --target "
                    "sinew_cuda` makes where nvcc is installed");
    else if (types.starts_with("Cuda") && item.candidates[0]->role == RoleKind::collisionModel)
      advice = "; map the state to one over Vec3d, and put the collision model there";
    complain(given ? item.element->place(*given) : item.element->place(),
             text('<', item.tag, "> is not there over ", types, why, "; it is over ", known, advice));
    return nullptr;
  }
  // some class is over the DataTypes of a device
  bool onDevice() const {
    return std::any_of(
        table_.begin(), table_.end(), [](auto const& info) { return info.dataTypes.starts_with("Cuda"); });
  }

  void decideClasses(Place& place) {
    for (auto& item : place.items)
      if (!item->info && !item->failed) item->info = decide(*item);
    for (auto& child : place.children) decideClasses(*child);
  }

  ClassInfo const* decide(Item& item) {
    ClassInfo const& first = *item.candidates[0];
    Place const* const owner = item.place->owner();
    const std::string given = templateOf(item);
    switch (first.role) {
      case RoleKind::mapping: {
        Place const* parent = item.place->parent ? item.place->parent->owner() : nullptr;
        if (first.severalParents) {
          parent = firstOfParents(item);
          if (!parent) return nullptr;
        }
        if (!parent)
          return complain(
                     *item.element,
                     "has no parent: no node above has a MechanicalObject; add one, or remove the mapping"),
                 nullptr;
        if (item.place->state.empty() && !item.place->visual)
          return complain(*item.element,
                          "has no child: its node has neither a MechanicalObject nor an OglModel; add one"),
                 nullptr;
        const std::string out = item.place->state.empty() ? "Vec3f" : item.place->state;
        return withTypes(
            item,
            text(parent->state, ',', out),
            text(", from the state of '", parent->name, "' to that of '", item.place->name, "'"));
      }
      case RoleKind::linearSolver: {
        // blocks of three are twice as fast where all points are in space
        const std::string_view assembled = allStatesAre(*item.place, "Vec3")
                                               ? "CompressedRowSparseMatrixMat3x3d"
                                               : "CompressedRowSparseMatrixd";
        if (!given.empty()) return withTypes(item, given);
        for (std::string_view wanted : {std::string_view("GraphScattered"), assembled})
          for (auto const* info : item.candidates)
            if (info->dataTypes == wanted) return info;
        return &first;
      }
      case RoleKind::mass:
      case RoleKind::forceField:
      case RoleKind::interactionForceField:
      case RoleKind::stepCallback:
      case RoleKind::collisionModel:
      case RoleKind::projectiveConstraint: {
        Place const* acted = owner;
        const bool joins = endsDiffer(item);
        if (joins && item.ends[0].empty() && item.ends[1].empty()) return nullptr;
        if (joins) acted = followNode(item, *item.element->attribute("object1"));
        std::erase_if(item.candidates, [&](ClassInfo const* info) { return info->joins != joins; });
        if (item.candidates.empty())
          return complain(*item.element,
                          joins ? "does not join two objects; remove object1 and object2"
                                : "joins two objects; give object1 and object2"),
                 nullptr;
        if (!acted)
          return complain(*item.element,
                          "has no state to act on; put it into a node with a MechanicalObject, or below one"),
                 nullptr;
        if (!given.empty() && given.find(',') == given.npos && given != acted->state && joins == false &&
            first.role != RoleKind::mass && !sameKind(given, acted->state))
          return complain(item.element->place(*item.element->attribute("template")),
                          text('<',
                               item.tag,
                               "> has the template ",
                               given,
                               ", but the state it acts on, in '",
                               acted->name,
                               "', is over ",
                               acted->state,
                               "; give both the same")),
                 nullptr;
        return withTypes(item, acted->state, text(", as the state it acts on, in '", acted->name, "'"));
      }
      case RoleKind::engine:
        if (first.dataTypes.empty()) return &first;
        return withTypes(item, onHost(item, !given.empty() ? given : owner ? owner->state : "Vec3d"));
      default:
        return &first;
    }
  }
  // loaders and selections work on the host: over "Vec3f" for "CudaVec3f", or where they are not, "Vec3d"
  static std::string onHost(Item const& item, std::string const& types) {
    if (!types.starts_with("Cuda")) return types;
    const std::string host = types.substr(4);
    const bool known = std::any_of(item.candidates.begin(), item.candidates.end(), [&](auto const* info) {
      return info->dataTypes == host;
    });
    return known ? host : text(std::string_view(host).substr(0, host.size() - 1), 'd');
  }
  // the node of the first of the parents that `input` names: "@left @../right/corner"
  Place const* firstOfParents(Item& item) {
    auto const* input = item.element->attribute("input");
    if (!input || !isLink(input->value))
      return complain(*item.element, "names no parents; name them: input=\"@../left @../right\""), nullptr;
    Place const* firstParent = nullptr;
    XmlAttribute one = *input;
    std::string_view rest = input->value;
    for (std::size_t at = rest.find('@'); at != rest.npos;) {
      const std::size_t next = rest.find('@', at + 1);
      one.value = std::string(rest.substr(at, next == rest.npos ? next : next - at));
      at = next;
      one.value.erase(one.value.find_last_not_of(" \t\r\n") + 1);
      Place const* const parent = followNode(item, one);
      if (!parent) return nullptr;
      if (!firstParent) firstParent = parent;
      item.parents.push_back(fromTop(*parent));
    }
    return firstParent;
  }
  // "/liver/skin"
  static std::string fromTop(Place const& place) {
    const std::string path = place.path();
    const std::string below = path.substr(std::min(path.find('/', 1), path.size()));
    return below.empty() ? "/" : below;
  }
  static bool allStatesAre(Place const& place, std::string_view kind) {
    return (place.state.empty() || place.state.starts_with(kind) || place.ofRole(RoleKind::mapping)) &&
           std::all_of(place.children.begin(), place.children.end(), [&](auto const& child) {
             return allStatesAre(*child, kind);
           });
  }
  // "Vec3d" for a state over Vec3f is taken for SOFA's default precision
  static bool sameKind(std::string_view a, std::string_view b) {
    return a.substr(0, a.size() - 1) == b.substr(0, b.size() - 1);
  }

  // an interaction joins two bodies, unless both its ends are the state of its own node
  bool endsDiffer(Item& item) {
    auto const *a = item.element->attribute("object1"), *b = item.element->attribute("object2");
    if (!a || !b ||
        std::none_of(item.candidates.begin(), item.candidates.end(), [](auto const* c) { return c->joins; }))
      return false;
    Place const *first = followNode(item, *a), *second = followNode(item, *b);
    if (!first || !second) return true;
    if (first == second && first == item.place->owner()) return false;
    // forces are gathered from the leaves to the root, so that an interaction has to be above its ends
    item.home = item.place;
    while (!item.home->above(*first) || !item.home->above(*second)) item.home = item.home->parent;
    item.ends = {fromTop(*first), fromTop(*second)};
    return true;
  }

  // a topological mapping takes elements from its input, the topology above where none is named, and its
  // output, or the topology of its node, takes what it makes of them
  void connect(Item& item) {
    if (!item.info || item.info->role != RoleKind::engine || !item.info->name.ends_with("TopologicalMapping"))
      return;
    auto topologyOf = [&](std::initializer_list<std::string_view> names, Place* otherwise) -> Item* {
      for (const std::string_view name : names)
        if (auto const* given = item.element->attribute(name)) {
          const std::string link = isLink(given->value) ? given->value : text('@', given->value);
          const Target target = follow(item, link);
          Item* to = target.item ? target.item : target.place->ofRole(RoleKind::topology);
          if (to && to->info && to->info->role == RoleKind::topology) return to;
          throw Error("", text(name, " leads to no topology; link to one"));
        }
      for (Place* at = otherwise; at; at = at->parent)
        if (Item* found = at->ofRole(RoleKind::topology)) return found;
      throw Error("", text("there is no topology for its ", *names.begin(), "; name one"));
    };
    locate(item, [&] {
      Item* const input = topologyOf({"input", "object1"}, item.place->parent);
      Item* const output = topologyOf({"output", "object2"}, item.place);
      if (input == output) throw Error("", "has the same topology as input and output; name two");
      item.element->set("src", linkTo(*input));
      for (auto const& made : item.info->fields)
        if (!made.isInput && output->info->field(made.name) && !output->element->attribute(made.name))
          output->element->set(made.name, text(linkTo(item), '.', made.name));
    });
  }
  static std::string linkTo(Item const& item) { return text('@', item.place->path(), '/', item.name); }

  // links

  struct Target {
    Item* item = nullptr;
    Place* place = nullptr;
    std::string data{};
  };

  /// The node that an attribute's link leads to, or whose component it leads to.
  Place* followNode(Item& item, XmlAttribute const& attribute) {
    try {
      const Target target = follow(item, attribute.value);
      Place* place = target.item ? target.item->place : target.place;
      if (!place->owner())
        throw Error("", text("leads to '", place->name, "', which has no MechanicalObject; link to a state"));
      while (place->state.empty()) place = place->parent;
      return place;
    } catch (Error const& error) {
      complain(item.element->place(attribute),
               text('<', item.tag, ">: ", attribute.name, ": ", error.what()));
      return nullptr;
    }
  }

  /// "@name", "@../x/y", "@/x/y", "@[-1].position", "@name.position". Throws Error where it leads nowhere.
  Target follow(Item& item, std::string_view link) {
    std::string whole(Words(link).rest());
    if (!whole.starts_with('@')) throw Error("", text(shown(link), " is no link; a link starts with @"));
    std::replace(whole.begin(), whole.end(), ' ', '_');  // as in names
    std::string_view path = std::string_view(whole).substr(1);
    Target target;
    const std::size_t slash = path.rfind('/') == path.npos ? 0 : path.rfind('/') + 1;
    if (const std::string_view last = path.substr(slash); last != "." && last != "..")
      if (const std::size_t dot = last.rfind('.'); dot != last.npos) {
        target.data = std::string(last.substr(dot + 1));
        path = path.substr(0, slash + dot);
      }
    if (path.starts_with('[')) {
      const std::size_t close = path.find(']');
      const int offset = read_number<int>(path.substr(1, std::min(close, path.size()) - 1));
      const auto& items = item.place->items;
      for (std::size_t i = 0; i < items.size(); ++i)
        if (items[i].get() == &item) {
          const long at = long(i) + offset;
          if (at < 0 || at >= long(items.size()))
            throw Error("",
                        text(shown(link), " leads outside the node; it has ", items.size(), " components"));
          target.item = items[std::size_t(at)].get();
        }
      if (!target.item) throw Error("", text(shown(link), " leads nowhere"));
      return target;
    }
    Place* from = item.place;
    const bool based = path.starts_with('/') || path.starts_with("./") || path.starts_with("../") ||
                       path == "." || path == ".." || path.empty();
    if (path.starts_with('/')) {
      while (from->parent) from = from->parent;
      path.remove_prefix(1);
    }
    while (from) {
      if (walk(*from, path, target)) return target;
      from = based ? nullptr : from->parent;
    }
    std::vector<std::string> known;
    for (Place* at = item.place; at; at = at->parent) {
      for (auto const& other : at->items) known.push_back(other->name);
      for (auto const& child : at->children) known.push_back(child->name);
    }
    const std::string_view last = path.substr(path.rfind('/') == path.npos ? 0 : path.rfind('/') + 1);
    throw Error("", text(shown(link), " leads nowhere", suggestion(last, known)));
  }
  static bool walk(Place& from, std::string_view path, Target& target) {
    Place* at = &from;
    while (!path.empty()) {
      const std::string_view step = path.substr(0, path.find('/'));
      path.remove_prefix(std::min(step.size() + 1, path.size()));
      if (step == "..") {
        at = at->parent;
      } else if (!step.empty() && step != ".") {
        Place* const child = at->child(step);
        Item* const named = at->find(step);
        if (path.empty() && named && (!child || named->name == step)) return target.item = named, true;
        if (!child && !at->parent && step == at->name) continue;
        at = child;
      }
      if (!at) return false;
    }
    target.place = at;
    return true;
  }

  /// What a component offers under a name: a result goes before a field of the same name.
  static FieldInfo const* offered(ClassInfo const& info, std::string_view name) {
    for (auto const& f : info.fields)
      if (!f.isInput && f.known(name)) return &f;
    return info.field(name);
  }

  /// The words of a field of a component, which is made for that if it is not yet.
  std::string valueOf(Target target) {
    if (!target.item) {
      if (!target.place->ofRole(RoleKind::state))
        throw Error("", text("leads to the node '", target.place->name, "'; link to a component"));
      target.item = target.place->ofRole(RoleKind::state);
    }
    Item& item = *target.item;
    if (!item.info) throw Error("", text("leads to ", item.name, ", which is wrong itself"));
    resolve(item);
    FieldInfo const* const field = offered(*item.info, target.data);
    if (!field) {
      std::vector<std::string_view> names;
      for (auto const& f : item.info->fields) names.push_back(f.name);
      throw Error("",
                  text("'",
                       item.name,
                       "' (",
                       item.info->name,
                       ") has no '",
                       target.data,
                       "'",
                       suggestion(target.data, names)));
    }
    if (item.info->role == RoleKind::state) return stateValue(item, *field);
    return field->write(item.address());
  }

  // a state takes its points from the topology of its node, and rests where it starts, at init; here it has
  // to be known before
  std::string stateValue(Item& item, FieldInfo const& field) {
    AnyComponent<R> copy(*item.component);
    std::vector<Eigen::Vector3d> points;
    if (item.info->field("position")->write(item.address()).empty())
      if (Item* topology = withPoints(*item.place))
        read_value(valueOf({topology, nullptr, "position"}), points);
    std::string words;
    copy.template visit<role::State>([&](auto& state) {
      if constexpr (requires { state.place("", points); }) state.place("", points);
      words = field.write(&state);
      if (words.empty() && field.name == "rest_position") words = item.info->field("position")->write(&state);
    });
    return words;
  }

  // values

  void prepare(Item& item) {
    item.component = std::make_unique<AnyComponent<R>>(AnyComponent<R>::make(item.info->type));
  }

  static bool isLink(std::string_view value) {
    const std::size_t first = value.find_first_not_of(" \t\r\n");
    return first != value.npos && value[first] == '@';
  }

  void resolve(Item& item) {
    if (item.progress == Progress::done || item.failed) return;
    if (item.progress == Progress::busy)
      throw Error("", text("leads in a circle back to '", item.name, "'; break it"));
    item.progress = Progress::busy;
    spellOut(item);
    if (item.failed) return void(item.progress = Progress::done);
    expandFile(item);
    const std::vector<XmlAttribute> placing = takePlacing(item);
    std::set<std::string_view> given;
    for (auto const& a : item.element->attributes) attribute(item, a, given);
    if (auto const* src = item.element->attribute("src")) source(item, *src, given);
    if (item.info->role == RoleKind::visualModel) clothe(item, given);
    place(item, placing);
    if (item.info->role == RoleKind::engine && !item.element->attribute("src")) surroundings(item, given);
    if (item.info->role == RoleKind::state) statePoints(item, given);
    locate(item, [&] {
      item.component->template visit<AnyRole>([&](auto const& component) { check_fields(component, ""); });
      item.component->template visit<role::Engine>([&](auto& engine) { engine.update(item.info->cppName); });
      item.component->template visit<role::Topology>([&](auto& topology) {
        if constexpr (requires { topology.generate(""); }) topology.generate(item.info->cppName);
      });
      item.component->template visit<role::InteractionForceField, role::ProjectiveConstraint>(
          [&](auto& joint) {
            if constexpr (requires { joint.ends.object1; })
              joint.ends.object1 = item.ends[0], joint.ends.object2 = item.ends[1];
          });
    });
    if (item.info->role == RoleKind::mapping) ends(item);
    if (item.info->severalParents)
      item.component->template visit<role::Mapping>([&](auto& mapping) {
        if constexpr (requires { mapping.parents.paths; }) mapping.parents.paths = item.parents;
      });
    item.progress = Progress::done;
  }
  // dx="1" stands for translation="1 0 0", rx="30" for rotation="30 0 0"
  static void spellOut(Item& item) {
    if (item.info->role != RoleKind::visualModel && !item.info->field("translation")) return;
    auto& attributes = item.element->attributes;
    struct Kind {
      char letter;
      std::string_view name;
    };
    for (const Kind kind : {Kind{'d', "translation"}, Kind{'r', "rotation"}}) {
      std::array<std::string, 3> parts{"0", "0", "0"};
      auto whole = std::find_if(
          attributes.begin(), attributes.end(), [&](auto const& a) { return a.name == kind.name; });
      if (whole != attributes.end()) {
        Words words(whole->value);
        for (auto& part : parts)
          if (!words.end()) part = std::string(words.next());
      }
      std::optional<std::size_t> offset;
      std::erase_if(attributes, [&](XmlAttribute const& a) {
        if (a.name.size() != 2 || a.name[0] != kind.letter || a.name[1] < 'x' || a.name[1] > 'z')
          return false;
        // in an old scene that SOFA saved, dx is a vector of the state
        Words words(a.value);
        if (!words.end()) words.next();
        if (item.info->role == RoleKind::state && !words.end()) return true;
        parts[std::size_t(a.name[1] - 'x')] = a.value;
        offset = a.offset;
        return true;
      });
      if (!offset) continue;
      std::erase_if(attributes, [&](auto const& a) { return a.name == kind.name; });
      attributes.push_back({std::string(kind.name), text(parts[0], ' ', parts[1], ' ', parts[2]), *offset});
    }
  }

  // a visual model is moved where its vertices come from
  static std::vector<XmlAttribute> takePlacing(Item& item) {
    std::vector<XmlAttribute> taken;
    if (item.info->role != RoleKind::visualModel) return taken;
    // SOFA's second name for them
    const bool named = item.element->attribute("position");
    if (named) std::erase_if(item.element->attributes, [](auto const& a) { return a.name == "vertices"; });
    for (auto& a : item.element->attributes)
      if (a.name == "vertices") a.name = "position";
    static constexpr std::array names =
        std::to_array<std::string_view>({"translation", "rotation", "scale", "scale3d"});
    std::erase_if(item.element->attributes, [&](XmlAttribute const& a) {
      if (!dialect::has(names, a.name)) return false;
      taken.push_back(a);
      return true;
    });
    return taken;
  }
  void place(Item& item, std::vector<XmlAttribute> const& placing) {
    if (placing.empty() || item.failed) return;
    FieldInfo const& position = *item.info->field("position");
    TransformEngine<Vec3d> engine;
    for (auto const& a : placing) try {
        auto words = [&](auto& to) {
          std::string value = a.value;
          Words again(value);
          if (const std::string one(again.next()); again.end()) value = text(one, ' ', one, ' ', one);
          read_value(value, to);
        };
        a.name == "translation" ? words(engine.translation)
        : a.name == "rotation"  ? words(engine.rotation)
                                : words(engine.scale);
      } catch (Error const& error) {
        item.failed = true;
        complain(item.element->place(a), text('<', item.tag, ">: ", a.name, ": ", error.what()));
      }
    locate(item, [&] {
      read_value(position.write(item.address()), engine.inputPosition);
      engine.update(item.name);
      position.read(item.address(), write_value(engine.outputPosition));
      item.links.erase("position");
    });
  }

  template <class F>
  void locate(Item& item, F&& f) {
    if (item.failed) return;
    try {
      f();
    } catch (Error const& error) {
      item.failed = true;
      complain(*item.element, error.what());
    }
  }

  void attribute(Item& item, XmlAttribute const& a, std::set<std::string_view>& given) {
    static constexpr std::array own = std::to_array<std::string_view>({"name", "template", "src", "type"});
    if (dialect::has(own, a.name) && !(a.name == "type" && item.element->tag != "Object")) return;
    if (a.name == "object1" || a.name == "object2") return;
    if (a.name == "topology") return otherTopology(item, a);
    const bool maps = item.info->role == RoleKind::mapping || item.info->role == RoleKind::engine;
    if (maps && (a.name == "input" || a.name == "output")) return;
    FieldInfo const* field = nullptr;
    for (auto const& f : item.info->fields)
      if (f.isInput && f.known(a.name)) field = &f;
    if (!field) {
      if (dialect::attribute_without_meaning(item.info->name, a.name)) return;
      if (dialect::has(dialect::attributesNotYet, a.name))
        return void(ignored_.insert(text(item.tag, '.', a.name)));
      std::vector<std::string_view> names;
      for (auto const& f : item.info->fields)
        if (f.isInput) {
          names.push_back(f.name);
          for_each_name(f.aliases, [&](std::string_view alias) { names.push_back(alias); });
        }
      item.failed = true;
      complain(item.element->place(a),
               text('<', item.tag, "> has no attribute '", a.name, "'", suggestion(a.name, names)));
      return;
    }
    given.insert(field->name);
    try {
      std::string linked;
      if (isLink(a.value) && item.info->role == RoleKind::carving) {
        const Target model = follow(item, a.value);  // a model, by its node
        linked = (model.item ? model.item->place : model.place)->path();
        linked.erase(0, linked.find('/', 1));  // from the root on
      } else if (isLink(a.value)) {
        linked = valueOf(follow(item, a.value));
        item.links[std::string(field->name)] = a.value;
      }
      setField(item, *field, isLink(a.value) ? linked : a.value, a);
    } catch (Error const& error) {
      item.failed = true;
      complain(item.element->place(a), text('<', item.tag, ">: ", a.name, ": ", error.what()));
    }
  }

  // all of a node act over its last topology
  void otherTopology(Item& item, XmlAttribute const& a) {
    if (!isLink(a.value)) return;
    Item const* linked = nullptr;
    try {
      linked = follow(item, a.value).item;
    } catch (Error const&) {
      return;  // as in SOFA, the topology of the node then
    }
    Item const* used = nullptr;
    for (Place* at = item.place; at && !used; at = at->parent) used = at->ofRole(RoleKind::topology);
    if (linked && linked != used && linked->info && linked->info->role == RoleKind::topology)
      warnings_.insert(text(item.element->place(a),
                            ": <",
                            item.tag,
                            ">: topology leads to '",
                            linked->name,
                            "', but it acts over '",
                            used ? used->name : "",
                            "', the last topology of the nearest node that has one"));
  }

  void setField(Item& item, FieldInfo const& field, std::string value, XmlAttribute const& written) {
    // one number stretches alike in all directions
    if (field.name == "scale3d" && written.name == "scale") {
      Words again(value);
      if (!again.end()) {
        const std::string one(again.next());
        if (again.end()) value = text(one, ' ', one, ' ', one);
      }
    }
    if (field.name == "position" && item.info->role == RoleKind::topology) value = inSpace(item, value);
    if (field.isFile) {
      auto const& file = written.file ? written.file : item.element->file;
      value = xml_.find(std::string(Words(value).rest()), file ? file->folder : "");
      files_.push_back(value);
    }
    field.read(item.address(), value);
  }

  // points of a topology are in space, but may be given as those of a state in fewer dimensions
  static std::string inSpace(Item const& item, std::string value) {
    Place const* const owner = item.place->owner();
    const std::size_t given =
        owner && owner->state.starts_with("Vec") ? std::size_t(owner->state[3] - '0') : 3;
    std::size_t count = 0;
    for (Words words(value); !words.end(); words.next()) ++count;
    if (given >= 3 || count % 3 == 0 || count % given != 0) return value;
    return every(value, given, given, given == 2 ? "0 " : "0 0 ");
  }
  // of each group of words the first ones, with more behind them
  static std::string every(std::string_view value, std::size_t group, std::size_t first,
                           std::string_view more) {
    std::string all;
    std::size_t i = 0;
    for (Words words(value); !words.end(); ++i) {
      const std::string_view word = words.next();
      if (i % group < first) all += text(word, ' ');
      if (i % group == group - 1) all += more;
    }
    return all;
  }

  // src="@loader": all that the loader offers under the name of a field that is not given
  void source(Item& item, XmlAttribute const& src, std::set<std::string_view>& given) {
    try {
      const Target target = follow(item, src.value);
      if (!target.item || !target.item->info)
        throw Error("", text(shown(src.value), " leads to no loader; link to a component"));
      for (auto const& field : item.info->fields) {
        if (!field.isInput || given.count(field.name)) continue;
        bool offered = false;
        if (!dialect::container_holds(item.tag, field.name)) continue;
        for (auto const& other : target.item->info->fields)
          if (other.known(field.name) && (!other.isInput || target.item->info->role != RoleKind::engine))
            offered = true;
        if (!offered) continue;
        const std::string words = valueOf({target.item, nullptr, std::string(field.name)});
        if (words.empty()) continue;
        field.read(item.address(), words);
        item.links[std::string(field.name)] = text(src.value, '.', field.name);
        given.insert(field.name);
      }
    } catch (Error const& error) {
      item.failed = true;
      complain(item.element->place(src), text('<', item.tag, ">: src: ", error.what()));
    }
  }

  // what a selection is not told, it takes from the state and the topology around it
  void surroundings(Item& item, std::set<std::string_view>& given) {
    for (auto const& field : item.info->fields) {
      if (!field.isInput || given.count(field.name)) continue;
      for (Place* at = item.place; at; at = at->parent) {
        Item* from = nullptr;
        std::string data(field.name);
        if (field.name == "position" && !item.info->dataTypes.empty()) {
          from = at->ofRole(RoleKind::state);
          data = "rest_position";
          if (!from) from = at->ofRole(RoleKind::topology), data = "position";
        } else if (dialect::has(topologyLists, field.name)) {
          from = at->ofRole(RoleKind::topology);
        }
        if (!from || !offered(*from->info, data)) continue;
        locate(item, [&] {
          field.read(item.address(), valueOf({from, nullptr, data}));
          item.links[std::string(field.name)] = text('@', from->name, '.', data);
        });
        break;
      }
    }
  }
  static constexpr auto topologyLists =
      std::to_array<std::string_view>({"edges", "triangles", "quads", "tetrahedra", "hexahedra"});

  // A state that is given no points takes, at init, those of the topology of its node; here it takes those of
  // another where that has none. One of its own without any topology has one point, at the origin.
  void statePoints(Item& item, std::set<std::string_view> const& given) {
    if (given.count("position")) return;
    Item const* const used = item.place->ofRole(RoleKind::topology);
    if (Item* topology = withPoints(*item.place)) {
      if (topology != used) takeFrom(item, "position", *topology, "position");
    } else if (!used && !item.place->ofRole(RoleKind::mapping)) {
      item.component->template visit<role::State>(
          [&](auto& state) { state.position.push_back(std::decay_t<decltype(state)>::DataTypes::zero()); });
    }
  }
  Item* withPoints(Place& place) {
    for (auto item = place.items.rbegin(); item != place.items.rend(); ++item)
      if ((*item)->info && (*item)->info->role == RoleKind::topology && offered(*(*item)->info, "position") &&
          !valueOf({item->get(), nullptr, "position"}).empty())
        return item->get();
    return nullptr;
  }
  void takeFrom(Item& item, std::string_view name, Item& from, std::string_view data) {
    locate(item, [&] {
      item.info->field(name)->read(item.address(), valueOf({&from, nullptr, std::string(data)}));
      item.links[std::string(name)] = text(linkTo(from), '.', data);
    });
  }

  static bool isIdentity(Place const& place) {
    Item const* const mapping = place.ofRole(RoleKind::mapping);
    return mapping && mapping->info->name == "IdentityMapping";
  }

  // A visual model without vertices has, below an IdentityMapping, those of the state above, otherwise those
  // of the nearest topology; and its elements, where it has none of its own.
  void clothe(Item& item, std::set<std::string_view> const& given) {
    if (given.count("position")) return;
    Item* topology = nullptr;
    for (Place* at = item.place; at && !topology; at = at->parent) {
      topology = at->ofRole(RoleKind::topology);
      if (!at->state.empty()) break;
    }
    if (isIdentity(*item.place))
      locate(item, [&] {
        std::string words;
        Place* at = item.place;
        do {
          at = at->parent;
          while (at->state.empty()) at = at->parent;
          words = valueOf({at->ofRole(RoleKind::state), nullptr, "position"});
        } while (words.empty() && isIdentity(*at));
        if (at->state.find("Rigid3") != at->state.npos) words = every(words, 7, 3, "");
        item.info->field("position")->read(item.address(), words);
      });
    else if (topology && offered(*topology->info, "position"))
      takeFrom(item, "position", *topology, "position");
    std::size_t points = 0;
    item.component->template visit<role::VisualModel>(
        [&](auto const& v) { points = v.mesh.positions.size(); });
    static constexpr std::array lists = std::to_array<std::string_view>({"edges", "triangles", "quads"});
    if (!topology || item.failed ||
        std::any_of(lists.begin(), lists.end(), [&](std::string_view list) { return given.count(list); }))
      return;
    for (const std::string_view list : lists) {
      if (!offered(*topology->info, list)) continue;
      std::vector<int> corners;
      locate(item, [&] { read_value(valueOf({topology, nullptr, std::string(list)}), corners); });
      if (std::all_of(corners.begin(), corners.end(), [&](int i) { return i >= 0 && i < int(points); }))
        takeFrom(item, list, *topology, list);
    }
  }

  // a file that a visual model or a topology names is read by a loader of its own
  void expandFile(Item& item) {
    if (item.info->field("filename") || item.info->field("fileTopology")) return;
    auto& attributes = item.element->attributes;
    auto named = std::find_if(attributes.begin(), attributes.end(), [](XmlAttribute const& a) {
      return a.name == "filename" || a.name == "fileMesh" || a.name == "fileTopology";
    });
    if (named == attributes.end()) return;
    const XmlAttribute file = *named;
    const std::string ending = io::lower_case(
        std::string_view(file.value).substr(std::min(file.value.rfind('.'), file.value.size())));
    const std::string_view loader = ending == ".obj"                       ? "MeshOBJLoader"
                                    : ending == ".msh"                     ? "MeshGmshLoader"
                                    : ending == ".stl"                     ? "MeshSTLLoader"
                                    : ending == ".vtk" || ending == ".vtu" ? "MeshVTKLoader"
                                                                           : "";
    made_.push_back(std::make_unique<XmlElement>(
        XmlElement{.tag = std::string(loader), .file = item.element->file, .offset = item.element->offset}));
    XmlElement& element = *made_.back();
    element.attributes = {{"name", text(item.name, "_loader"), file.offset},
                          {"filename", file.value, file.offset}};
    attributes.erase(named);
    // a surface is moved where it is read
    for (auto a = attributes.begin(); a != attributes.end();)
      if (a->name == "translation" || a->name == "rotation" || a->name == "scale" || a->name == "scale3d") {
        element.attributes.push_back(*a);
        a = attributes.erase(a);
      } else {
        ++a;
      }
    if (loader.empty()) {
      item.failed = true;
      return complain(item.element->place(file),
                      text('<',
                           item.tag,
                           ">: ",
                           file.name,
                           ": ",
                           shown(file.value),
                           " has no ending that is known; meshes are .obj .msh .vtk .vtu .stl"));
    }
    auto made = makeItem(*item.place, element);
    if (!made) return void(item.failed = true);
    made->info = made->candidates[0];
    prepare(*made);
    item.element->set("src", text('@', made->name));
    auto& items = item.place->items;
    items.insert(std::find_if(items.begin(), items.end(), [&](auto const& i) { return i.get() == &item; }),
                 std::move(made));
  }

  // input and output of a mapping say what the tree says: the state above, and that of its node
  void ends(Item& item) {
    for (std::string_view name : {"input", "output"}) {
      auto const* a = item.element->attribute(name);
      if (!a || !isLink(a->value) || (item.info->severalParents && name == "input")) continue;
      try {
        const Target target = follow(item, a->value);
        Place const* const place = target.item ? target.item->place : target.place;
        if (name == "output") {
          if (place != item.place && !(place->parent == item.place || item.place->parent == place))
            throw Error("",
                        text("leads to the node '",
                             place->name,
                             "', but a mapping moves what is in its own node; move it there"));
        } else if (place->owner() != (item.place->parent ? item.place->parent->owner() : nullptr) &&
                   place != item.place) {
          throw Error("",
                      text("leads to '",
                           place->name,
                           "', but a mapping follows the nearest state above its node; put the node below '",
                           place->name,
                           "'"));
        }
      } catch (Error const& error) {
        complain(item.element->place(*a), text('<', item.tag, ">: ", a->name, ": ", error.what()));
      }
    }
  }

  // the tree

  void readNode(Place const& place, ReadScene<R>& scene) {
    auto number = [&](std::string_view name, auto& to) {
      auto const* a = place.element->attribute(name);
      if (!a) return;
      try {
        read_value(a->value, to);
      } catch (Error const& error) {
        complain(place.element->place(*a), text("<Node>: ", name, ": ", error.what()));
      }
    };
    number("dt", scene.dt);
    number("time", scene.time);
    number("step", scene.step);
    if (!(scene.dt > 0) || !std::isfinite(scene.dt))
      complain(place.element->place(),
               text("<Node>: dt is ", scene.dt, " s, but must be a finite number greater than 0"));
  }

  // those written in a node that belong there, then those that belong there and are written elsewhere
  std::vector<Item*> itemsOf(Place& place) {
    std::vector<Item*> items;
    Item const* const topology = place.ofRole(RoleKind::topology);
    for (auto& item : place.items) {
      if (item->info && item->info->role == RoleKind::topology && item.get() != topology) continue;
      if (!item->home || item->home == &place) items.push_back(item.get());
    }
    for (Item* item : moved_)
      if (item->home == &place) items.push_back(item);
    return items;
  }

  void fill(Place& place, RuntimeNode<R>& node) {
    auto const* gravity = place.element->attribute("gravity");
    if (gravity || !place.parent) {
      Gravity value;
      try {
        if (gravity) read_value(gravity->value, value.gravity);
      } catch (Error const& error) {
        complain(place.element->place(*gravity), text("<Node>: gravity: ", error.what()));
      }
      if (!place.ofRole(RoleKind::context)) {
        node.add(value);
        node.components().back().origin = place.element->place();
      }
    }
    static constexpr std::array known =
        std::to_array<std::string_view>({"name", "gravity", "dt", "activated", "step", "type"});
    for (auto const& a : place.element->attributes)
      if (!dialect::has(known, a.name) && !dialect::has(dialect::nodeAttributesWithoutMeaning, a.name) &&
          !a.name.starts_with("show"))
        complain(place.element->place(a),
                 text("<Node> has no attribute '", a.name, "'", suggestion(a.name, known)));
    for (Item* item : itemsOf(place))
      if (item->component && !item->failed) {
        RuntimeEntry<R> entry{
            std::move(*item->component), item->name, item->element->place(), std::move(item->links)};
        node.add(std::move(entry));
      }
    for (auto& child : place.children) fill(*child, node.addChild(child->name));
  }
};

}  // namespace detail

/// Reads a scene in SOFA's XML dialect, of the classes of the registry R. Throws SceneError with all that is
/// wrong with the file; nothing is returned then.
template <class R>
ReadScene<R> read_scene(std::string const& path, ReadSceneOptions const& options = {}) {
  try {
    return detail::SceneReader<R>(options).read(path);
  } catch (SceneError const&) {
    throw;
  } catch (Error const& error) {
    throw SceneError({error.what()});
  }
}
/// The same from the content of a file.
template <class R>
ReadScene<R> parse_scene(std::string const& path, std::string content, ReadSceneOptions const& options = {}) {
  try {
    return detail::SceneReader<R>(options).parse(path, std::move(content));
  } catch (SceneError const&) {
    throw;
  } catch (Error const& error) {
    throw SceneError({error.what()});
  }
}

}  // namespace sinew
