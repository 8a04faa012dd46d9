// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/scene_reader/items.hpp>
#include <sinew/runtime/scene_reader/links.hpp>

#include <algorithm>
#include <string>

namespace sinew {

namespace detail {

/// The topology whose elements a collision model in a node with a state of its own, and no topology, has in
/// SOFA: the nearest one above. Null where the model does without, or there is none.
inline SceneItem* topology_above(SceneItem const& model) {
  ScenePlace const& node = *model.place;
  if (!model.info->traits.overElements || node.state.empty() || node.ofRole(RoleKind::topology))
    return nullptr;
  for (ScenePlace const* at = node.parent; at; at = at->parent)
    if (SceneItem* const found = at->ofRole(RoleKind::topology)) return found;
  return nullptr;
}

/// A topology of its own for the node of a collision model, with the elements of another, which is returned;
/// null where there is no such class.
inline SceneItem* add_topology(SceneItem& model, SceneItem const& elements, SceneItems& items) {
  XmlElement& element = items.partOf(*model.element, "MeshTopology");
  const std::size_t offset = model.element->offset;
  element.attributes = {{"name", text(elements.name, "_elements"), offset}};
  for (const std::string_view list : {"edges",
                                      "triangles",
                                      "quads",
                                      "tetrahedra",
                                      "hexahedra",
                                      "pyramids",
                                      "prisms",
                                      "quadraticTetrahedra",
                                      "quadraticHexahedra",
                                      "triquadraticHexahedra"})
    if (offered(*elements.info, list))
      element.attributes.push_back({std::string(list), text(link_to(elements), '.', list), offset});
  auto made = items.makeItem(*model.place, element);
  if (!made) return nullptr;
  made->info = made->candidates[0];
  auto& beside = model.place->items;
  const auto before =
      std::find_if(beside.begin(), beside.end(), [&](auto const& i) { return i.get() == &model; });
  return beside.insert(before, std::move(made))->get();
}

}  // namespace detail

}  // namespace sinew
