// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_settings.hpp>
#include <sinew/collision/collision_surface.hpp>
#include <sinew/core/component.hpp>

#include <string>

namespace sinew {

/// What a model says of itself to detection and response; its elements are there.
template <class M>
void describe_surface(M const& model, CollisionSurface& surface, std::string const& where,
                      std::size_t vertices) {
  surface.shape = M::shape;
  surface.rigid = M::DataTypes::rigid;
  copy_fields(model, collision_model_fields<M>(), surface.settings, CollisionSettings::fields());
  surface.path = where;
  surface.className = M::className;
  surface.resize(vertices);
}

/// Fills a list of one value for each of `count` things up with a value for those that have none; an empty
/// one stays empty. Throws Error where it has more.
template <class T>
void fill_up(std::vector<T>& list, std::size_t count, T const& value, std::string_view name,
             std::string_view things, std::string const& where) {
  if (list.size() > count)
    throw Error(where,
                text(name,
                     " has ",
                     list.size(),
                     " entries for ",
                     count,
                     ' ',
                     things,
                     "; give one for each, or fewer"));
  if (!list.empty()) list.resize(count, value);
}
/// The same as one value for each.
template <class T>
T each_or(std::vector<T> const& list, std::size_t i, T const& value) {
  return list.empty() ? value : list[i];
}

/// The model of the points, lines or triangles of a topology. `Kind` says which: shape, elements(context),
/// and what scene files call it; `noun` is for messages. C++ has no designated initialisers for members of a
/// base class or of an inner struct, which is why settings stand in each class that has fields of its own
/// beside them.
template <class D, class Kind>
struct MeshCollisionModel {
  using Role = role::CollisionModel;
  using DataTypes = D;
  static_assert(D::spatial == 3,
                "Sinew: collision models are in space; take Vec3d, Vec3f, Rigid3d or Rigid3f.");
  static constexpr std::string_view className = Kind::className;
  static constexpr std::string_view aliases = Kind::aliases;
  static constexpr Shape shape = Kind::shape;
  static constexpr bool overElements = shape != Shape::point;

  bool active = true, moving = true, simulated = true, selfCollision = false, bothSide = false;
  std::vector<int> group{};
  double proximity = 0, contactStiffness = 10, contactFriction = 0, contactDamping = 0;
  std::string contactResponse{};

  static constexpr auto fields() { return collision_model_fields<MeshCollisionModel>(); }

  CollisionSurface surface{};

  void init(InitContext<D> const& context) {
    surface.elements = Kind::elements(context);
    describe_surface(*this, surface, context.where, context.rest.size());
    if (surface.elements.empty() && !context.topology.grows)
      throw Error(context.where,
                  text(component_name<MeshCollisionModel>(),
                       ": there is no ",
                       Kind::noun,
                       " to collide with; give the node points, or a topology that has some"));
  }
};

}  // namespace sinew
