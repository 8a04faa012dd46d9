// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/scene_reader/items.hpp>

#include <algorithm>
#include <string>

namespace sinew {

namespace detail {

/// A file that a visual model or a topology names is read by a loader of its own, which is returned; null
/// where there is no such file, or no loader, which is said.
inline SceneItem* add_loader(SceneItem& item, SceneItems& items, SceneMessages& messages) {
  if (item.info->field("filename") || item.info->field("fileTopology") ||
      dialect::without_effect(item.info->name, "filename"))
    return nullptr;
  auto& attributes = item.element->attributes;
  auto named = std::find_if(attributes.begin(), attributes.end(), [](XmlAttribute const& a) {
    return a.name == "filename" || a.name == "fileMesh" || a.name == "fileTopology";
  });
  if (named == attributes.end()) return nullptr;
  const XmlAttribute file = *named;
  const std::string ending =
      io::lower_case(std::string_view(file.value).substr(std::min(file.value.rfind('.'), file.value.size())));
  ClassInfo const* const loader = items.names().loaderOf(ending);
  if (!loader) {
    item.failed = true;
    messages.addError(item.element->place(file),
                      text('<',
                           item.tag,
                           ">: ",
                           file.name,
                           ": ",
                           shown(file.value),
                           " has no ending that is known; meshes are ",
                           items.names().endings()));
    return nullptr;
  }
  XmlElement& element = items.partOf(*item.element, loader->name);
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
  auto made = items.makeItem(*item.place, element);
  if (!made) {
    item.failed = true;
    return nullptr;
  }
  made->info = made->candidates[0];
  item.element->set("src", text('@', made->name));
  auto& beside = item.place->items;
  const auto before =
      std::find_if(beside.begin(), beside.end(), [&](auto const& i) { return i.get() == &item; });
  return beside.insert(before, std::move(made))->get();
}

}  // namespace detail

}  // namespace sinew
