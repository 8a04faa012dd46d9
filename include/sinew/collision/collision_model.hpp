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
  surface.resize(vertices);
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
