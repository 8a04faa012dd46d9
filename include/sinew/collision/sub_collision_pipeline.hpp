// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/default_pipeline.hpp>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew {

/// Collision detection among some models of a scene, wherever they are, with the stages that stand in its
/// node: its own intersection method, with its own distances, and its own response. Models of which no one
/// pipeline has both do not collide; a model may be in several. It stands with its stages in the root or in a
/// node right below that.
///
/// In scene files it may have links to its stages, as in SOFA: these then move into a node with it, named as
/// it is, or are there once more where several have them. A CompositeCollisionPipeline in a scene file says
/// which of these pipelines there are (subCollisionPipelines); others are left out then, as in SOFA. It has
/// no component of its own, and nothing changes with its parallelDetection.
struct SubCollisionPipeline {
  using Role = role::CollisionPipeline;
  static constexpr std::string_view className = "SubCollisionPipeline";

  std::string collisionModels{};

  static constexpr auto fields() {
    return field_list(field(
        "collisionModels",
        &SubCollisionPipeline::collisionModels,
        "",
        "paths of the models, from the root, with blanks between: of a node for all in it and below, or "
        "of one model by the path of its node and its name or class, as in 'tool floor/Sphere'"));
  }

  std::vector<CollisionSurface*> surfaces{};  // of the step, all of the scene
  std::vector<std::pair<int, int>> near{};    // pairs of those that are meant
  std::vector<char> listed{};                 // whether each of the surfaces is
  bool afterFreeMotion = false;               // contacts are found behind the free motion of the step
  DefaultPipeline search{};

  bool takes(CollisionSurface const& s) const { return listed[std::size_t(s.number)] != 0; }
  /// Throws Error where nothing is listed, and where a path leads to no model.
  void choose(std::string const& where);

  template <class Broad>
  void findNear(Broad& broad) {
    search.surfaces.assign(surfaces.begin(), surfaces.end());
    search.findNear(broad);
    std::erase_if(search.near, [&](auto const& pair) {
      return !takes(*surfaces[std::size_t(pair.first)]) || !takes(*surfaces[std::size_t(pair.second)]);
    });
    near.assign(search.near.begin(), search.near.end());
  }
  template <Shape... Known, class Narrow, class Intersection, class Manager>
  void findContacts(ShapeList<Known...> known, Narrow& narrow, Intersection const& intersection,
                    Manager& manager, double dt) {
    search.findContacts(known, narrow, intersection, manager, dt);
  }
};

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>

namespace sinew {

SINEW_ONCE void SubCollisionPipeline::choose(std::string const& where) {
  const std::string name = text(where, ": ", component_name<SubCollisionPipeline>());
  listed.assign(surfaces.size(), 0);
  search.surfaces.reserve(surfaces.size());
  search.near.reserve(surfaces.size() * (surfaces.size() + 1) / 2);
  const std::string root = where.substr(0, std::min(where.find('/', 1), where.size()));
  auto isBelow = [](std::string_view path, std::string_view top) {
    return path == top || (path.starts_with(top) && path[top.size()] == '/');
  };
  bool any = false;
  constexpr std::string_view blanks = " \t\r\n";
  const std::string_view all = collisionModels;
  for (std::size_t at = all.find_first_not_of(blanks); at < all.size();
       at = all.find_first_not_of(blanks, at)) {
    const std::size_t end = std::min(all.find_first_of(blanks, at), all.size());
    std::string_view path = all.substr(at, end - at);
    at = end;
    any = true;
    const std::string_view given = path;
    while (path.starts_with('@') || path.starts_with('/')) path.remove_prefix(1);
    const std::string full = path.empty() ? root : text(root, '/', path);
    bool found = false;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      CollisionSurface const& s = *surfaces[i];
      const bool is = isBelow(s.path, full) || (!s.name.empty() && full == text(s.path, '/', s.name)) ||
                      full == text(s.path, '/', s.className);
      if (is) found = true, listed[i] = 1;
    }
    if (found) continue;
    std::string known;
    for (auto const* s : surfaces)
      known += text(known.empty() ? "" : ", ",
                    s->path.substr(std::min(root.size() + 1, s->path.size())),
                    '/',
                    s->className);
    throw Error(name,
                text("collisionModels has '",
                     given,
                     "', where there is no collision model; there is one at: ",
                     known.empty() ? "no place" : known));
  }
  if (!any)
    throw Error(
        name,
        "collisionModels is empty; list the models that collide, by the paths of their nodes from the "
        "root");
}

}  // namespace sinew
#endif
