// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/scene_reader/items.hpp>

#include <algorithm>

namespace sinew {

namespace detail {

/// In SOFA a node may have a state and visual models; here each visual model gets a node of its own below.
inline void split_visuals(ScenePlace& place, SceneItems& items) {
  auto is = [](SceneItem const& item, RoleKind role) { return item.candidates[0]->role == role; };
  const bool hasState = std::any_of(
      place.items.begin(), place.items.end(), [&](auto const& i) { return is(*i, RoleKind::state); });
  std::size_t visuals = 0;
  for (auto const& i : place.items) visuals += is(*i, RoleKind::visualModel);
  for (auto& child : place.children) split_visuals(*child, items);
  if (visuals == 0 || (visuals == 1 && !hasState)) return;
  std::vector<std::unique_ptr<SceneItem>> stay;
  std::vector<ScenePlace*> moved;
  for (auto& item : place.items)
    if (is(*item, RoleKind::visualModel) && (hasState || !moved.empty())) {
      std::string name = item->name;
      while (place.child(name)) name += '_';
      auto own =
          std::make_unique<ScenePlace>(ScenePlace{&items.partOf(*item->element, "Node"), name, &place});
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

}  // namespace detail

}  // namespace sinew
