// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/scene_files.hpp>
#include <sinew/runtime/scene_reader/parts.hpp>

namespace sinew {

namespace detail {

/// Gives an attribute of an element its value: --set path.attribute=value.
inline void set_attribute(XmlElement& root, std::string const& path, std::string const& value) {
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
      known.push_back(name_of(child, child.tag));
      if (!next && (known.back() == step || (child.tag != "Node" && child.tag == step))) next = &child;
    }
    if (!next && at == &root && step == name_of(root, "root")) continue;
    if (!next) {
      const std::string nearest = nearest_name(step, known);
      throw SceneError({text("--set ",
                             path,
                             ": there is no '",
                             step,
                             "' in '",
                             name_of(*at, at->tag),
                             "'",
                             nearest.empty() ? std::string("; name a node or a component")
                                             : text("; did you mean '", nearest, "'?"))});
    }
    at = next;
  }
  at->set(std::string_view(path).substr(dot + 1), value);
}

/// The nodes and components of a scene file, of whatever class: what stands for several components, or for a
/// setting of another one, is taken apart here.
class SceneCollector {
 public:
  SceneCollector(std::vector<ClassInfo> const& table, bool lenient, SceneMessages& messages)
      : table_(table), lenient_(lenient), messages_(messages) {}

  /// Whether what is not simulated is left out with a warning.
  bool lenient() const { return lenient_; }

  /// Whether a tag is a node, or a class that a scene may have, be it simulated or not.
  bool knows(std::string const& tag) const {
    return tag == "Node" || tag == "NewtonRaphsonSolver" || tag == "BoxConstraint" || classNamed(tag) ||
           dialect::preconditioner_named(tag) || dialect::has(dialect::implicitWithCG, tag) ||
           dialect::class_without_meaning(tag) || dialect::left_out(dialect::inert, tag) ||
           dialect::left_out(dialect::notYet, tag) || dialect::is_over_elements(tag) ||
           tag == "NodalMassDensity" || has_name(dialect::tetrahedronModels, tag) ||
           std::any_of(dialect::standsFor.begin(), dialect::standsFor.end(), [&](auto const& other) {
             return other.name == tag;
           });
  }

  /// All in and below a node.
  void collectAll(ScenePlace& top) {
    collect(top);
    setNewton(top);
    warnOfLooseNewton(top);
    setPreconditioners(top);
    setDensities(top);
    splitVisuals(top);
    reportTetrahedra(top);
  }

  /// An element of another class that stands for a part of what an element asks for. It lives as long as
  /// this.
  XmlElement& partOf(XmlElement const& element, std::string_view tag) {
    made_.push_back(std::make_unique<XmlElement>(
        XmlElement{.tag = std::string(tag), .file = element.file, .offset = element.offset}));
    return *made_.back();
  }
  /// The class of loaders that reads files with an ending, ".obj"; none where there is none.
  ClassInfo const* loaderOf(std::string_view ending) const {
    for (auto const& info : table_)
      if (has_name(info.traits.endings, ending)) return &info;
    return nullptr;
  }
  /// All endings of files with meshes.
  std::string endings() const {
    std::string all;
    for (auto const& info : table_)
      if (!info.traits.endings.empty()) all += text(all.empty() ? "" : " ", info.traits.endings);
    return all;
  }
  /// The component that an element is; none where there is no such class, which is said.
  std::unique_ptr<SceneItem> makeItem(ScenePlace& place, XmlElement& element) {
    const std::string tag = tag_of(element);
    std::string_view known = tag;
    for (auto const& other : dialect::standsFor)
      if (other.name == tag) {
        known = other.className;
        element.set(other.attribute, other.value, false);
      }
    if (dialect::is_over_elements(tag)) {
      known = overElements(element, tag);
      if (known.empty()) return nullptr;
    }
    auto item = std::make_unique<SceneItem>(SceneItem{&place, &element, tag, name_of(element, tag)});
    for (auto const& info : table_)
      if (info.known(known)) item->candidates.push_back(&info);
    if (!item->candidates.empty()) {
      hasNoChildren(element);
      warnOfMethod(element, tag);
      std::erase_if(element.attributes, [](XmlAttribute const& a) {
        return dialect::has(dialect::mayBeEmpty, a.name) && (a.value.empty() || a.value == "@");
      });
      return item;
    }
    if (has_name(dialect::tetrahedronModels, tag)) {
      tetrahedra_.push_back(&element);
    } else if (dialect::class_without_meaning(tag)) {
      messages_.ignored.insert(tag);
    } else if (auto const* none = dialect::left_out(dialect::inert, tag)) {
      messages_.warnings.insert(text(element.place(), ": <", tag, "> ", none->why));
    } else {
      auto const* missed = dialect::left_out(dialect::notYet, tag);
      const std::string message =
          missed ? text('<', tag, "> ", missed->why)
                 : text("there is no component <", tag, ">", packageOf(tag, suggestion(tag, classNames())));
      if (lenient_)
        messages_.warnings.insert(text(element.place(), ": ", message, " It is left out."));
      else
        messages_.addError(element.place(), message);
    }
    return nullptr;
  }

 private:
  std::vector<ClassInfo> const& table_;
  bool lenient_;
  SceneMessages& messages_;
  std::set<XmlElement const*> takenNewton_{}, takenPreconditioners_{};
  std::vector<std::unique_ptr<XmlElement>> made_{};
  std::vector<XmlElement const*> tetrahedra_{};  // collision models

  void collect(ScenePlace& place) {
    std::map<std::string, int> names;
    for (auto& child : place.element->children) {
      if (child.tag == "Node") {
        auto const* active = child.attribute("activated");
        if (active && (active->value == "0" || active->value == "false")) {
          messages_.ignored.insert(text("Node ", name_of(child, "Node"), " (activated is 0)"));
          continue;
        }
        std::string name = name_of(child, "Node");
        if (const int n = names[name]++) {
          const std::string renamed = text(name, '_', n + 1);
          if (child.attribute("name"))
            messages_.warnings.insert(text(
                child.place(), ": a second node is named '", name, "'; it is called '", renamed, "' here"));
          name = renamed;
        }
        place.children.push_back(std::make_unique<ScenePlace>(ScenePlace{&child, name, &place}));
        collect(*place.children.back());
      } else if (const std::string tag = tag_of(child); tag == "NewtonRaphsonSolver") {
        hasNoChildren(child);
        place.newton.push_back(&child);
      } else if (tag == "NodalMassDensity") {
        hasNoChildren(child);
        place.densities.push_back(&child);
      } else if (dialect::preconditioner_named(tag)) {
        hasNoChildren(child);
        warnOfMethod(child, tag);
        place.preconditioners.push_back(&child);
      } else if (tag == "BoxConstraint") {
        boxConstraint(place, child);
      } else if (dialect::has(dialect::implicitWithCG, tag)) {
        cgImplicit(place, child);
      } else if (auto item = makeItem(place, child)) {
        const bool isState = item->candidates[0]->role == RoleKind::state;
        place.items.push_back(std::move(item));
        if (isState) externalForce(place, child);
      }
    }
  }

  // of a component, and of the response of a contact manager
  void warnOfMethod(XmlElement const& element, std::string_view tag) {
    auto warn = [&](std::string_view name) {
      if (auto const* other = dialect::another_method(name))
        messages_.warnings.insert(text(element.place(),
                                       ": <",
                                       tag,
                                       ">: ",
                                       name == tag ? "" : name,
                                       name == tag ? "" : ": ",
                                       other->difference));
    };
    warn(tag);
    if (auto const* response = element.attribute("response")) warn(response->value);
  }

  void hasNoChildren(XmlElement const& component) {
    for (auto const& child : component.children)
      messages_.addError(
          child,
          text("stands inside <", component.tag, ">, but a component has attributes only; move it out"));
  }

  void addItem(ScenePlace& place, XmlElement& element) {
    if (auto item = makeItem(place, element)) place.items.push_back(std::move(item));
  }

  // <BoxConstraint box="..."/> stands for a BoxROI and a FixedProjectiveConstraint of what is in it
  void boxConstraint(ScenePlace& place, XmlElement& element) {
    hasNoChildren(element);
    const std::string name = name_of(element, "BoxConstraint") + "_roi";
    XmlElement& roi = partOf(element, "BoxROI");
    XmlElement& fixed = partOf(element, "FixedProjectiveConstraint");
    fixed.attributes = {{"indices", text('@', name, ".indices"), element.offset}};
    for (auto const& a : element.attributes)
      if (a.name != "type") (a.name == "name" || a.name == "fixAll" ? fixed : roi).attributes.push_back(a);
    roi.set("name", name);
    addItem(place, roi);
    addItem(place, fixed);
  }

  // <MechanicalObject externalForce="..."/>, forces on the first of its points, stands for a
  // ConstantForceField
  void externalForce(ScenePlace& place, XmlElement& state) {
    auto const* const given = state.attribute("externalForce");
    if (!given) return;
    const XmlAttribute forces = *given;
    std::erase_if(state.attributes, [](XmlAttribute const& a) { return a.name == "externalForce"; });
    int numbers = 0;
    bool zero = true;
    io::TextReader reader("", forces.value);
    for (std::string_view word = reader.word(); !word.empty(); word = reader.word(), ++numbers) {
      double number = 1;
      zero = (io::parse_number(word, number) && number == 0) && zero;
    }
    if (zero) return;
    auto const* const types = state.attribute("template");
    const std::string_view of = types ? std::string_view(types->value) : "Vec3";
    const int each = of.find("Rigid2") != of.npos  ? 3
                     : of.find("Rigid") != of.npos ? 6
                     : of.find("Vec1") != of.npos  ? 1
                     : of.find("Vec2") != of.npos  ? 2
                     : of.find("Vec6") != of.npos  ? 6
                                                   : 3;
    if (is_link(forces.value) || numbers % each != 0)
      return messages_.addError(state.place(forces),
                                text('<',
                                     state.tag,
                                     ">: externalForce: give ",
                                     each,
                                     " numbers for each of the first points, or use a ConstantForceField"));
    XmlElement& constant = partOf(state, "ConstantForceField");
    std::string indices;
    for (int i = 0; i < numbers / each; ++i) indices += text(i > 0 ? " " : "", i);
    constant.attributes = {{"name", name_of(state, state.tag) + "_externalForce", forces.offset},
                           {"indices", indices, forces.offset},
                           {"forces", forces.value, forces.offset}};
    addItem(place, constant);
  }

  // <CGImplicit .../> of the first SOFA is an EulerImplicitSolver, damped, with a CGLinearSolver; a node that
  // has a solver gets the latter only, with a warning
  void cgImplicit(ScenePlace& place, XmlElement& element) {
    hasNoChildren(element);
    XmlElement& ode = partOf(element, "EulerImplicitSolver");
    XmlElement& linear = partOf(element, "CGLinearSolver");
    auto const* class_ = classNamed(linear.tag);
    for (auto const& a : element.attributes)
      if (a.name != "type") (class_ && class_->field(a.name) ? linear : ode).attributes.push_back(a);
    ode.set("rayleighStiffness", "0.1", false);
    ode.set("rayleighMass", "0.1", false);
    linear.set("threshold", "1e-5", false);
    linear.set("name", name_of(element, element.tag) + "_linear");
    auto const first = std::find_if(place.items.begin(), place.items.end(), [](auto const& item) {
      return item->candidates[0]->role == RoleKind::odeSolver;
    });
    if (first == place.items.end())
      addItem(place, ode);
    else
      messages_.warnings.insert(
          text(element.place(),
               ": <",
               tag_of(element),
               ">: its node has an ODE solver already, <",
               (*first)->tag,
               ">; of this one the conjugate gradients alone are taken, where SOFA makes a step with each; "
               "remove one of them"));
    addItem(place, linear);
  }
  ClassInfo const* classNamed(std::string_view name) const {
    for (auto const& info : table_)
      if (info.known(name)) return &info;
    return nullptr;
  }

  // NewtonRaphsonSolver holds settings of the ODE solver that links to it; where that names none, of one in
  // its node or above
  void setNewton(ScenePlace& place) {
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
        for (ScenePlace* at = &place; at && !newton && !name.empty(); at = at->parent)
          newton = newtonIn(*at, name);
        if (!newton) newton = newtonIn(place, "");
        if (newton) takeNewton(*item, *newton);
      }
    for (auto& child : place.children) setNewton(*child);
  }
  static XmlElement const* newtonIn(ScenePlace const& place, std::string_view name) {
    for (XmlElement const* element : place.newton)
      if (name.empty() || name_of(*element, element->tag) == name) return element;
    for (auto const& child : place.children)
      if (XmlElement const* found = newtonIn(*child, name)) return found;
    return nullptr;
  }
  void warnOfLooseNewton(ScenePlace const& place) {
    for (XmlElement const* element : place.newton)
      if (!takenNewton_.count(element))
        messages_.warnings.insert(
            text(element->place(),
                 ": <NewtonRaphsonSolver>: no ODE solver links to it, stands beside it or "
                 "above; it has no effect"));
    for (auto const& child : place.children) warnOfLooseNewton(*child);
  }
  void takeNewton(SceneItem& item, XmlElement const& newton) {
    takenNewton_.insert(&newton);
    if (!item.candidates[0]->field("maxNbIterationsNewton"))
      return void(messages_.warnings.insert(text(newton.place(),
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

  // the class for a kind of elements, told what sets it apart; none where there is no such class, which is
  // said
  std::string_view overElements(XmlElement& element, std::string const& tag) {
    auto const* types = element.attribute("template");
    const std::string whole = types ? types->value : "";
    const std::size_t comma = std::min(whole.find(','), whole.size());
    const std::string kind(Words(std::string_view(whole).substr(std::min(comma + 1, whole.size()))).rest());
    std::string known;
    for (auto const& over : dialect::overElements) {
      if (over.name != tag) continue;
      known += text(known.empty() ? "" : ", ", over.element);
      if (over.element != kind) continue;
      element.set("template", whole.substr(0, comma));
      std::string_view value = over.value;
      if (auto const* method = element.attribute("rotationMethod"); method && over.attribute == "method") {
        value = "";
        std::string methods;
        for (auto const& [name, ours] : dialect::rotationMethods) {
          methods += text(methods.empty() ? "" : ", ", name);
          if (method->value == name) value = ours;
        }
        if (value.empty())
          return messages_.addError(
                     element.place(*method),
                     text('<', tag, ">: rotationMethod: ", shown(method->value), " is not one of ", methods)),
                 "";
        std::erase_if(element.attributes, [](auto const& a) { return a.name == "rotationMethod"; });
      }
      element.set(over.attribute, value);
      return over.className;
    }
    messages_.addError(types ? element.place(*types) : element.place(),
                       text('<',
                            tag,
                            "> is not there over ",
                            kind.empty() ? "no kind of elements" : shown(kind),
                            "; its template names one of ",
                            known,
                            ", as in Vec3,",
                            known.substr(0, known.find(','))));
    return "";
  }

  // FEMMass takes its density from the NodalMassDensity that it links to, or the nearest in its node or above
  void setDensities(ScenePlace& place) {
    for (auto& item : place.items) {
      if (item->tag != "FEMMass") continue;
      std::string name;
      std::erase_if(item->element->attributes, [&](XmlAttribute const& a) {
        if (a.name != "nodalMassDensity") return false;
        name = a.value.substr(a.value.find_last_of("@/") + 1);
        return true;
      });
      XmlElement const* found = nullptr;
      for (ScenePlace* at = &place; at && !found; at = at->parent)
        for (XmlElement const* density : at->densities)
          if (!found && (name.empty() || name_of(*density, density->tag) == name)) found = density;
      if (!found) {
        messages_.addError(*item->element, "finds no NodalMassDensity; put one into its node, or above");
        continue;
      }
      auto const* given = found->attribute("property");
      const std::string property = given ? given->value : "1";
      Words words(property);
      const std::string density(words.end() ? "1" : words.next());
      if (!words.end() || is_link(density))
        messages_.addError(
            found->place(*given),
            "<NodalMassDensity>: property: only one density for all points is simulated; give one number");
      item->element->set("massDensity", density);
    }
    for (auto& child : place.children) setDensities(*child);
  }

  // tetrahedra collide with the points that DiscreteIntersection tests against them, and with nothing
  // otherwise
  void reportTetrahedra(ScenePlace const& top) {
    if (tetrahedra_.empty()) return;
    const bool collide = isThere(top, "DiscreteIntersection") && isThere(top, "PointCollisionModel");
    for (XmlElement const* element : tetrahedra_)
      if (collide && !lenient_)
        messages_.addError(*element,
                           "collides with points in SOFA, and with nothing here; take triangles, lines, "
                           "points, spheres or convex hulls");
      else
        messages_.warnings.insert(
            text(element->place(),
                 ": <",
                 tag_of(*element),
                 "> collides with nothing",
                 collide ? " here"
                         : ", as in SOFA, where only DiscreteIntersection tests tetrahedra, against points",
                 "; it is left out"));
  }
  static bool isThere(ScenePlace const& place, std::string_view className) {
    return std::any_of(place.items.begin(),
                       place.items.end(),
                       [&](auto const& item) { return item->candidates[0]->name == className; }) ||
           std::any_of(place.children.begin(), place.children.end(), [&](auto const& child) {
             return isThere(*child, className);
           });
  }

  // A preconditioner, or the linear solver that is one, is a setting of the solver that links to it.
  void setPreconditioners(ScenePlace& place) {
    for (std::size_t i = 0; i < place.items.size(); ++i)
      if (SceneItem& item = *place.items[i]; item.candidates[0]->field("precondition")) {
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
        messages_.warnings.insert(
            text(element->place(), ": <", tag_of(*element), ">: no solver links to it; it has no effect"));
  }
  void takePreconditioner(SceneItem& item, std::string const& link, int depth = 0) {
    XmlElement const* const element = solverNamed(*item.place, link);
    if (!element || element == item.element || depth > 2)
      return messages_.addError(*item.element,
                                text("there is no preconditioner ", shown(link), "; correct the link"));
    takenPreconditioners_.insert(element);
    auto const* means = dialect::preconditioner_named(tag_of(*element));
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
  static XmlElement const* solverNamed(ScenePlace const& place, std::string const& link) {
    std::string name = link.substr(link.find_last_of("@/") + 1);
    for (ScenePlace const* at = &place; at; at = at->parent) {
      for (XmlElement const* element : at->preconditioners)
        if (name_of(*element, tag_of(*element)) == name) return element;
      for (auto const& item : at->items)
        if (item->name == name && item->candidates[0]->role == RoleKind::linearSolver) return item->element;
    }
    return nullptr;
  }

  // what to do about a class that is not there for want of a package; else `otherwise`
  static std::string packageOf(std::string_view tag, std::string otherwise) {
    for (auto const& c : dialect::classesOfPackages)
      if (has_name(c.names, tag))
        return text(" in this program, which was built without ",
                    c.package,
                    "; install that (Debian: ",
                    c.debian,
                    ") and build Sinew anew");
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

  // In SOFA a node may have a state and visual models; here each visual model gets a node of its own below.
  void splitVisuals(ScenePlace& place) {
    auto is = [](SceneItem const& item, RoleKind role) { return item.candidates[0]->role == role; };
    const bool hasState = std::any_of(
        place.items.begin(), place.items.end(), [&](auto const& i) { return is(*i, RoleKind::state); });
    std::size_t visuals = 0;
    for (auto const& i : place.items) visuals += is(*i, RoleKind::visualModel);
    for (auto& child : place.children) splitVisuals(*child);
    if (visuals == 0 || (visuals == 1 && !hasState)) return;
    std::vector<std::unique_ptr<SceneItem>> stay;
    std::vector<ScenePlace*> moved;
    for (auto& item : place.items)
      if (is(*item, RoleKind::visualModel) && (hasState || !moved.empty())) {
        std::string name = item->name;
        while (place.child(name)) name += '_';
        auto own = std::make_unique<ScenePlace>(ScenePlace{&partOf(*item->element, "Node"), name, &place});
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
      ScenePlace* to = nullptr;
      if (is(*item, RoleKind::mapping))
        if (auto const* output = item->element->attribute("output"))
          for (ScenePlace* own : moved)
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
};

}  // namespace detail

}  // namespace sinew
