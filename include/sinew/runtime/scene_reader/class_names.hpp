// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/scene_reader/parts.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace sinew {

namespace detail {

/// What an element of a scene file is.
enum class ElementKind {
  node,
  newton,             // settings of an ODE solver,
  preconditioner,     // of a linear one,
  density,            // and of a mass
  boxConstraint,      // stands for two components
  implicitWithCG,     // the same
  forceAndMass,       // the same
  compositePipeline,  // lists collision pipelines
  articulation,       // joints of articulated bodies, and where they are
  component,          // of a class that the registry has, or should have
  withoutMeaning,     // is left out, as is all that follows
  inert,
  notYet,
  unknown
};

/// The classes of a registry, by the words of scene files.
struct SceneClassNames {
  std::vector<ClassInfo> const& table;

  ElementKind kindOf(XmlElement const& element) const {
    if (element.tag == "Node") return ElementKind::node;
    const std::string tag = tag_of(element);
    if (tag == "NewtonRaphsonSolver") return ElementKind::newton;
    if (tag == "NodalMassDensity") return ElementKind::density;
    if (tag == "BoxConstraint") return ElementKind::boxConstraint;
    if (dialect::preconditioner_named(tag)) return ElementKind::preconditioner;
    if (dialect::has(dialect::implicitWithCG, tag)) return ElementKind::implicitWithCG;
    if (dialect::force_and_mass(tag)) return ElementKind::forceAndMass;
    if (tag == "CompositeCollisionPipeline" && named("SubCollisionPipeline"))
      return ElementKind::compositePipeline;
    if (dialect::has(dialect::ofArticulations, tag) && named("ArticulatedSystemMapping"))
      return ElementKind::articulation;
    if (named(tag) || dialect::is_over_elements(tag)) return ElementKind::component;
    for (auto const& other : dialect::standsFor)
      if (other.name == tag) return ElementKind::component;
    return withoutClass(tag);
  }
  /// Of a tag that is no class of the registry, and stands for none.
  static ElementKind withoutClass(std::string_view tag) {
    if (dialect::class_without_meaning(tag)) return ElementKind::withoutMeaning;
    if (dialect::left_out(dialect::inert, tag)) return ElementKind::inert;
    return dialect::left_out(dialect::notYet, tag) ? ElementKind::notYet : ElementKind::unknown;
  }

  /// None where there is no such class.
  ClassInfo const* named(std::string_view name) const {
    for (auto const& info : table)
      if (info.known(name)) return &info;
    return nullptr;
  }

  /// The class of loaders that reads files with an ending, ".obj"; none where there is none.
  ClassInfo const* loaderOf(std::string_view ending) const {
    for (auto const& info : table)
      if (has_name(info.traits.endings, ending)) return &info;
    return nullptr;
  }
  /// All endings of files with meshes.
  std::string endings() const {
    std::string all;
    for (auto const& info : table)
      if (!info.traits.endings.empty()) all += text(all.empty() ? "" : " ", info.traits.endings);
    return all;
  }
  std::vector<std::string_view> all() const {
    std::vector<std::string_view> names;
    for (auto const& info : table) {
      names.push_back(info.name);
      for_each_name(info.aliases, [&](std::string_view alias) { names.push_back(alias); });
    }
    return names;
  }
};

}  // namespace detail

}  // namespace sinew
