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

}  // namespace detail

}  // namespace sinew
