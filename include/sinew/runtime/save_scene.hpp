// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/class_table.hpp>
#include <sinew/runtime/dialect.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/scene_files.hpp>

#include <map>
#include <pugixml.hpp>
#include <sstream>

namespace sinew {

namespace detail {

/// Writes runtime nodes as elements of SOFA's dialect, with the values as they are now.
template <class R>
class SceneWriter {
 public:
  std::string write(RuntimeNode<R> const& root, double dt, double time, long step) {
    pugi::xml_document document;
    document.append_child(pugi::node_comment)
        .set_value(" written by Sinew: the scene as it was, with all data in it ");
    pugi::xml_node node = document.append_child("Node");
    node.append_attribute("name") = root.name.c_str();
    set(node, "dt", write_value(dt));
    if (step > 0) {
      set(node, "time", write_value(time));
      set(node, "step", std::to_string(step));
    }
    view_ = &root.view;
    gatherLive(root, "");
    fill(node, root, {});
    std::ostringstream bytes;
    document.save(bytes, "  ");
    return bytes.str();
  }

 private:
  std::vector<ClassInfo> table_ = make_class_table<R>();
  std::vector<ViewElement> const* view_ = nullptr;
  // attributes that follow others while the scene runs, by their components
  std::map<void const*, std::map<std::string, std::string>> live_{};

  static void set(pugi::xml_node& node, std::string_view name, std::string const& value) {
    node.append_attribute(std::string(name).c_str()) = value.c_str();
  }

  void gatherLive(RuntimeNode<R> const& node, std::string const& path) {
    for (auto const& target : node.live.targets) {
      RuntimeNode<R>* const at = const_cast<RuntimeNode<R>&>(node).find_node(target.node);
      auto* const entry = at ? at->find(target.component) : nullptr;
      if (!entry) continue;
      for (LiveLink const& link : target.links) {
        // a topology whose points come and go is not written
        RuntimeNode<R>* const from = at->top().resolve(text(path, '/', link.from.node));
        if (link.ofEdits && (!from || pointsChange(*from))) continue;
        live_[entry->component.address()][link.to.field] = text('@',
                                                                path,
                                                                '/',
                                                                link.from.node,
                                                                link.from.node.empty() ? "" : "/",
                                                                link.from.component,
                                                                '.',
                                                                link.from.field);
      }
    }
    for (auto const& child : node.children()) gatherLive(*child, text(path, '/', child->name));
  }

  // what the solvers above keep from step to step: how many auxiliary vectors, and whether dx
  struct Kept {
    int vectors = 0;
    bool dx = false;
  };
  void fill(pugi::xml_node& to, RuntimeNode<R> const& node, Kept kept) {
    const bool mapped = node.mapping() != nullptr;
    const std::string here = node.path();
    auto has_looks = [&](ViewElement const& v) {
      return v.path == here && !dialect::has(dialect::ofViews, v.tag);
    };
    for (ViewElement const& v : *view_)
      if (v.path == here && !has_looks(v)) {
        pugi::xml_node element = to.append_child(v.tag.c_str());
        for (auto const& [name, value] : v.attributes) set(element, name, value);
      }
    for (auto const& entry : node.components())
      entry.component.template visit<role::OdeSolver>([&](auto const& ode) {
        if constexpr (stands_beside<std::decay_t<decltype(ode)>>) return;
        kept.vectors = 0;
        if constexpr (requires { ode.history; }) kept.vectors = ode.history.derivs;
      });
    for (auto const& entry : node.components())
      entry.component.template visit<role::LinearSolver>([&](auto const& linear) {
        if constexpr (requires { linear.warmStart; }) kept.dx = linear.warmStart;
      });
    for (auto const& entry : node.components()) {
      ClassInfo const& info = table_[std::size_t(entry.component.type())];
      const auto follows = live_.find(entry.component.address());
      // what an engine made at the start is in the fields of others
      if (info.role == RoleKind::engine && follows == live_.end()) continue;
      if (info.role == RoleKind::topology && pointsChange(node)) continue;  // it has no more than the points
      if (info.role == RoleKind::context && !node.parent()) {
        set(to, "gravity", info.field("gravity")->write(entry.component.address()));
        continue;
      }
      pugi::xml_node element = to.append_child(std::string(info.name).c_str());
      set(element, "name", entry.name);
      if (!info.dataTypes.empty()) set(element, "template", info.dataTypes);
      const AnyComponent<R> component =
          info.role == RoleKind::state ? stateToWrite(entry.component, mapped, kept) : entry.component;
      for (auto const& field : info.fields) {
        if (!field.isInput) continue;
        const bool isFile = field.isFile || field.name == "materialLibrary";
        std::string value = field.write(component.address());
        if (isFile) {
          std::string names;
          for (std::string const& name : field.fileNames(value))
            names += text(names.empty() ? "" : " ", name.starts_with('#') ? name : absolute(name));
          value = names;
        }
        if (follows != live_.end() && follows->second.count(std::string(field.name))) continue;
        if (value != field.defaultValue) set(element, field.name, value);
      }
      if (follows != live_.end())
        for (auto const& [name, link] : follows->second) set(element, name, link);
      if (info.role == RoleKind::visualModel)
        for (ViewElement const& v : *view_)
          if (has_looks(v))
            for (auto const& [name, value] : v.attributes)
              set(element, name, name == "texturename" ? absolute(value) : value);
      if (auto const* parents = component.parents()) {
        std::string input;
        for (auto const& path : *parents) input += text(input.empty() ? "@" : " @", path);
        if (info.in2.empty()) set(element, "input", input);
        for (std::size_t k = 0; !info.in2.empty() && k < parents->size(); ++k)
          set(element, text("input", k + 1), text('@', (*parents)[k]));
      }
      if (Linked const* ends = component.ends()) {
        set(element, "object1", text('@', ends->object1));
        set(element, "object2", text('@', ends->object2));
      }
    }
    for (auto const& child : node.children()) {
      pugi::xml_node element = to.append_child("Node");
      set(element, "name", child->name);
      fill(element, *child, kept);
    }
  }

  static bool pointsChange(RuntimeNode<R> const& node) {
    bool change = false;
    for (auto const& entry : node.components())
      entry.component.template visit<role::State>([&](auto const& state) { change = state.capacity > 0; });
    return change;
  }
  // a mapped state is what its mapping makes of what it was given
  static AnyComponent<R> stateToWrite(AnyComponent<R> copy, bool mapped, Kept kept) {
    copy.template visit<role::State>([&](auto& state) {
      if (mapped) {
        auto given = state.given.value_or(state.position);
        const bool ofTopology = state.pointsOfTopology;
        state = {};
        state.position = std::move(given);
        state.pointsOfTopology = ofTopology;
      } else {
        if (state.resetPosition == state.position) state.resetPosition.clear();
        if (state.resetVelocity == state.velocity) state.resetVelocity.clear();
        if (state.restPosition == state.position) state.restPosition.clear();
        state.history.clear();
        if (kept.dx) state.lastSolution = state.dx;
        for (int k = 0; k < kept.vectors && k < int(state.auxiliaryDerivs.size()); ++k) {
          auto const& vector = state.auxiliaryDerivs[std::size_t(k)];
          state.history.insert(state.history.end(), vector.begin(), vector.end());
        }
      }
    });
    return copy;
  }
  static std::string absolute(std::string const& path) {
    char whole[PATH_MAX];
    return !path.empty() && ::realpath(path.c_str(), whole) ? std::string(whole) : path;
  }
};

}  // namespace detail

template <class R>
std::string scene_text(Simulation<RuntimeNode<R>>& simulation, double dt) {
  return detail::SceneWriter<R>().write(simulation.root(), dt, simulation.time(), simulation.step());
}

}  // namespace sinew
