// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/any_component.hpp>
#include <sinew/runtime/scene_reader/attributes.hpp>
#include <sinew/runtime/scene_reader/links.hpp>

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace sinew {

namespace detail {

/// The components of a scene file, and the values that links and other components take from them. A value is
/// asked for when its component may not be read yet: `resolve(item)` does that first, so that the order in
/// the file does not matter.
template <class R>
class ComponentValues {
 public:
  ComponentValues(SceneMessages& messages, std::function<void(SceneItem&)> resolve)
      : messages_(messages), resolve_(std::move(resolve)) {}

  void make(SceneItem& item) {
    item.address = components_.emplace(&item, AnyComponent<R>::make(item.info->type)).first->second.address();
  }
  AnyComponent<R>& component(SceneItem const& item) { return components_.at(&item); }

  /// The words of a field of a component, which is made for that if it is not yet.
  std::string valueOf(LinkTarget target) {
    if (!target.item) {
      target.item = target.place->meant();
      if (!target.item)
        throw Error("", text("leads to the node '", target.place->name, "'; link to a component"));
    }
    SceneItem& item = *target.item;
    if (!item.info) throw Error("", text("leads to ", item.name, ", which is wrong itself"));
    resolve_(item);
    // of lists under numbers one
    for (auto const& f : item.info->fields)
      if (const int number = f.isInput ? -1 : f.numberOf(target.data); number >= 0)
        if (const auto lists = split_lists(f.write(item.address)); std::size_t(number) < lists.size())
          return lists[std::size_t(number)];
    FieldInfo const* const field = offered(*item.info, target.data);
    if (field && !field->isInput && field->numberOf(target.data) >= 0) return {};
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
    return field->write(item.address);
  }
  /// How many numbers a value has of the list to which a link leads; 0 where that is not known.
  std::size_t sizeOfValues(LinkTarget const& target) {
    SceneItem* const item = target.item ? target.item : target.place->meant();
    FieldInfo const* const field = item && item->info ? offered(*item->info, target.data) : nullptr;
    if (!field) return 0;
    if (item->info->traits.sizedValues && !field->isInput && field->kind == "list of number") {
      resolve_(*item);
      std::size_t size = 0;
      read_value(item->info->field("size")->write(item->address), size);
      return size;
    }
    std::size_t words = 0;
    const std::string all = valueOf({item, nullptr, target.data});
    for (Words w(all); !w.end(); w.next()) ++words;
    const std::size_t entries = field->type->entries(static_cast<char*>(item->address) + field->offset);
    return entries > 0 && words % entries == 0 ? words / entries : 0;
  }
  /// The same for a field of a component: points in space are frames that are not rotated.
  std::string linkedValue(SceneItem& item, FieldInfo const& field, LinkTarget target) {
    if (!target.item) target.item = target.place->meant();
    const std::string types = target.item && target.item->info ? target.item->info->dataTypes : "Rigid3d";
    FieldInfo const* const from =
        target.item && target.item->info ? offered(*target.item->info, target.data) : nullptr;
    const bool frames = from && from->kind.find("quaternion") != from->kind.npos;
    const bool inSpace = !frames && (types.empty() || types.find("Vec3") != types.npos);
    std::string words = valueOf(std::move(target));
    if (frames && field.kind == "list of 3 numbers") return every(words, 7, 3, "");  // their centers
    if (!inSpace || item.info->role != RoleKind::state || !dialect::has(fields_of_points, field.name))
      return words;
    if (item.info->dataTypes.find("Rigid3") != std::string_view::npos) return every(words, 3, 3, "0 0 0 1 ");
    if (item.info->dataTypes.find("Rigid2") != std::string_view::npos) return every(words, 3, 2, "0 ");
    // a file of values has them as the first coordinates of its points
    if (item.info->dataTypes.find("Vec1") != std::string_view::npos && from &&
        from->kind == "list of 3 numbers")
      return every(words, 3, 1, "");
    return words;
  }
  /// The last topology of a node that has points; null where none has.
  SceneItem* withPoints(ScenePlace& place) {
    for (auto item = place.items.rbegin(); item != place.items.rend(); ++item)
      if ((*item)->info && (*item)->info->role == RoleKind::topology && offered(*(*item)->info, "position") &&
          !valueOf({item->get(), nullptr, "position"}).empty())
        return item->get();
    return nullptr;
  }
  /// Gives a component what another offers under a name.
  void takeFrom(SceneItem& item, std::string_view name, SceneItem& from, std::string_view data) {
    messages_.locate(item, [&] {
      item.info->field(name)->read(item.address, valueOf({&from, nullptr, std::string(data)}));
      item.links[std::string(name)] = text(link_to(from), '.', data);
    });
  }

 private:
  SceneMessages& messages_;
  std::function<void(SceneItem&)> resolve_;
  std::map<SceneItem const*, AnyComponent<R>> components_{};

  // a state takes its points from the topology of its node, and rests where it starts, with a velocity for
  // each point, at init; here it has to be known before
  std::string stateValue(SceneItem& item, FieldInfo const& field) {
    AnyComponent<R> copy(component(item));
    std::vector<Eigen::Vector3d> points;
    if (item.info->field("position")->write(item.address).empty())
      if (SceneItem* topology = withPoints(*item.place))
        read_value(valueOf({topology, nullptr, "position"}), points);
    std::string words;
    copy.template visit<role::State>([&](auto& state) {
      if constexpr (requires { state.place("", points); }) state.place("", points);
      if constexpr (requires { state.velocity.back(); })
        if (field.name == "velocity") {
          using Deriv = typename std::decay_t<decltype(state)>::DataTypes::Deriv;
          const Deriv last = state.velocity.empty() ? Deriv(Deriv::Zero()) : Deriv(state.velocity.back());
          if (state.velocity.size() < state.position.size())
            state.velocity.resize(state.position.size(), last);
        }
      words = field.write(&state);
      if (words.empty() && field.name == "rest_position") words = item.info->field("position")->write(&state);
    });
    return words;
  }
};

}  // namespace detail

}  // namespace sinew
