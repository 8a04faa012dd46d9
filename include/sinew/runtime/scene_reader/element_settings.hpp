// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/io/text_reader.hpp>
#include <sinew/runtime/scene_reader/parts.hpp>

#include <algorithm>
#include <set>

namespace sinew {

namespace detail {

/// Elements that are settings of others: each goes to that which links to it, or stands nearest.
class ElementSettings {
 public:
  explicit ElementSettings(SceneMessages& messages) : messages_(messages) {}

  /// All in and below a node.
  void giveAll(ScenePlace& top) {
    setNewton(top);
    warnOfLooseNewton(top);
    setPreconditioners(top);
    setDensities(top);
    setComposites(top);
    forgetInterpolation(top);
    setRods(top);
  }

 private:
  SceneMessages& messages_;
  std::set<XmlElement const*> takenNewton_{}, takenPreconditioners_{};

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

  // HexahedronCompositeFEMMapping shows the cells of the force of its parent: what it does not say is as
  // there
  void setComposites(ScenePlace& place) {
    for (auto& item : place.items) {
      if (item->candidates[0]->name != dialect::compositeMapping) continue;
      XmlElement const* force = nullptr;
      for (ScenePlace* at = place.parent; at && !force; at = at->parent)
        for (auto const& other : at->items)
          if (other->candidates[0]->name == dialect::compositeForce) force = other->element;
      for (std::size_t i = 0; force && i < force->attributes.size(); ++i) {
        XmlAttribute a = force->attributes[i];
        if (item->element->attribute(a.name) ||
            !has_name("nbVirtualFinerLevels poissonRatio interpolation finestToCoarse method "
                      "completeInterpolation",
                      a.name))
          continue;
        if (is_link(a.value))
          messages_.addError(*item->element,
                             text(a.name, " of the force above is a link; give it here, too"));
        if (!a.file) a.file = force->file;
        item->element->take(a, true);
      }
    }
    for (auto& child : place.children) setComposites(*child);
  }
  // SOFA's forces say it, and it is of their mappings
  static void forgetInterpolation(ScenePlace& place) {
    for (auto& item : place.items)
      if (item->candidates[0]->name == dialect::compositeForce)
        std::erase_if(item->element->attributes,
                      [](XmlAttribute const& a) { return a.name == "completeInterpolation"; });
    for (auto& child : place.children) forgetInterpolation(*child);
  }

  // what is on a rod has the beams of the interpolation in its node, or, a mapping, above it; a controller
  // names it without @
  void setRods(ScenePlace& place) {
    for (auto& item : place.items) {
      const std::string_view name = item->candidates[0]->name;
      const bool controls = name == "InterventionalRadiologyController";
      if (!controls && name != dialect::rodForce && name != dialect::rodMass && name != "AdaptiveBeamMapping")
        continue;
      if (controls) stretchGrid(place);
      const std::string field = controls ? "instruments" : "interpolation";
      if (auto const* given = item->element->attribute(field)) {
        if (!controls || is_link(given->value) || Words(given->value).end()) continue;
        Words words(given->value);
        const std::string first(words.next());
        if (!words.end())
          messages_.addError(*item->element,
                             "instruments: wires inside of each other are not simulated; name one");
        item->element->set(field, "@" + first);
        continue;
      }
      SceneItem const* found = nullptr;
      for (ScenePlace* at = &place; at && !found; at = at->parent) {
        for (auto const& other : at->items)
          if (!found && has_name("BeamInterpolation WireBeamInterpolation", other->candidates[0]->name))
            found = other.get();
        if (!at->state.empty() && (at != &place || name != "AdaptiveBeamMapping")) break;
      }
      if (found) item->element->set(field, link_to(*found));
    }
    for (auto& child : place.children) setRods(*child);
  }

  // the frames of a wire have no places before its controller gives them some: SOFA's scenes have a grid for
  // them that is a point
  static void stretchGrid(ScenePlace& place) {
    for (auto& item : place.items) {
      XmlAttribute const *low = item->element->attribute("xmin"), *high = item->element->attribute("xmax");
      double from = 0, to = 0;
      if (item->candidates[0]->name == "RegularGridTopology" && low && high &&
          io::parse_number(low->value, from) && io::parse_number(high->value, to) && from == to)
        item->element->set("xmax", text(from + 1));
    }
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
    const std::string tag = tag_of(*element);
    auto const* means = dialect::preconditioner_named(tag);
    const bool multigrid = tag == "MultigridLinearSolver";
    if (means && means->warp) item.element->set("warp", "1", false);
    if (means && !means->updateStep.empty()) item.element->set("update_step", means->updateStep);
    for (XmlAttribute const& a : element->attributes) {
      if (a.name == "omega") item.element->set(a.name, a.value, false);
      if (a.name == "update_step") item.element->set(a.name, a.value);
      if (multigrid && a.name == "refresh") item.element->set("update_step", a.value);
      if (multigrid && dialect::has(dialect::multigridAttributes, a.name))
        item.element->set(a.name, a.value, false);
      // what is warped
      if (means && means->warp && (a.name == "linearSolver" || a.name == "solverName") && !a.value.empty())
        takePreconditioner(item, a.value, depth + 1);
    }
    item.element->set("precondition", means ? means->precondition : multigrid ? "multigrid" : "ldl", false);
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
};

}  // namespace detail

}  // namespace sinew
