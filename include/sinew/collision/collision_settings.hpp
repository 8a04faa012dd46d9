// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/fields.hpp>

#include <string>
#include <vector>

namespace sinew {

/// The settings that all collision models have, as fields of the class M that has members of these names.
template <class M, class... More>
constexpr auto collision_model_fields(More... more) {
  return field_list(
      field("active", &M::active, "", "takes part in collisions"),
      field("moving", &M::moving, "", "moves: two models that do not are never compared"),
      field("simulated", &M::simulated, "", "feels the forces of its contacts"),
      field("selfCollision",
            &M::selfCollision,
            "",
            "collides with itself; primitives that share a point do not"),
      field("bothSide",
            &M::bothSide,
            "",
            "both sides of a triangle are outside; else only the one from which its corners go round "
            "counterclockwise; LocalMinDistance asks that of the lines and points of triangles, too"),
      field("group", &M::group, "", "models that have a group in common do not collide with each other"),
      field("proximity", &M::proximity, "m", "thickness around the primitives", range::nonNegative)
          .also("contactDistance"),
      field("contactStiffness",
            &M::contactStiffness,
            "N^(1/2)",
            "stiffness of contacts: that of a pair is k1 k2 / d [N/m], d the contact distance with the radii "
            "of the two [m], and its force k times what is missing of the contact distance",
            range::nonNegative),
      field("contactFriction",
            &M::contactFriction,
            "",
            "coefficient of friction: that of a pair is the sum",
            range::nonNegative),
      field("contactDamping",
            &M::contactDamping,
            "N s/m",
            "damping of contacts along their normal: that of a pair is the sum",
            range::nonNegative),
      field("contactResponse",
            &M::contactResponse,
            "",
            "class of the response to contacts of this model; that of the contact manager when not given"),
      more...);
}

/// Those settings, as a surface has them from its model.
struct CollisionSettings {
  bool active = true, moving = true, simulated = true, selfCollision = false, bothSide = true;
  std::vector<int> group{};
  double proximity = 0, contactStiffness = 10, contactFriction = 0, contactDamping = 0;
  std::string contactResponse{};

  static constexpr auto fields() { return collision_model_fields<CollisionSettings>(); }
};

}  // namespace sinew
