// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/contact.hpp>
#include <sinew/core/compiled.hpp>

namespace sinew {

/// A place on a collision surface held by a spring whose other end is moved from outside: by a mouse, a
/// haptic device, a script. With p the point that is held, the force on the surface is
///   F = k (target - p) + c (target' - p')   [N]
/// and it acts as that of a contact does: on any model of any state, implicitly under an implicit solver.
struct Attachment {
  int id = 0;
  double stiffness = 0, damping = 0;                   // [N/m], [N s/m]
  Eigen::Vector3d target{0, 0, 0}, velocity{0, 0, 0};  // of the other end
  Eigen::Vector3d offset{
      0, 0, 0};       // from the place on the surface to p: from the centre of a particle to its skin
  Contact contact{};  // its side b is the place; it has no side a

  void evaluate(CollisionSurface const& s);
};

/// The solver that sees a contact of these two surfaces as part of its system, if there is one; of one alone,
/// with the rest of the world.
void find_solver(Contact& c, CollisionSurface const* a, CollisionSurface const* b);

}  // namespace sinew

#if SINEW_DEFINES
namespace sinew {

SINEW_ONCE void Attachment::evaluate(CollisionSurface const& s) {
  const Eigen::Vector3d p = position_of(contact.b, s) + offset,
                        rate = rate_of(contact.b, s, s.velocity, s.spin);
  contact.evaluated = stiffness * (target - p) + damping * (velocity - rate);
  contact.stiffnessMatrix = Eigen::Vector3d::Constant(stiffness).asDiagonal();
  contact.dampingMatrix = Eigen::Vector3d::Constant(damping).asDiagonal();
}

SINEW_ONCE void find_solver(Contact& c, CollisionSurface const* a, CollisionSurface const* b) {
  const int sa = a && a->settings.simulated ? a->solver : -1,
            sb = b && b->settings.simulated ? b->solver : -1;
  c.loose = sa >= 0 && sb >= 0 && sa != sb;
  c.solver = c.loose ? -1 : std::max(sa, sb);
  c.implicit = !c.loose && ((sa >= 0 && a->implicit) || (sa < 0 && sb >= 0 && b->implicit));
}

}  // namespace sinew
#endif
