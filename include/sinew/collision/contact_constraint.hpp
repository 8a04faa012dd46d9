// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/contact.hpp>
#include <sinew/lagrangian/constraint_rows.hpp>

#include <Eigen/Core>

namespace sinew {

// C is Contact, or what has the same names of members on a GPU.

/// What is left of the gap of a contact at a displacement u: n.u - thickness - limit.
template <class C>
SINEW_HD double gap_of(C const& c, Eigen::Vector3d const& u) {
  return c.normal.dot(u) - c.thickness - c.limit;
}

/// The part of a step behind the impact of a contact that is apart at its start and would not be at its end;
/// all of the step for what touches at its start.
template <class C>
SINEW_HD double part_after_impact(C const& c, ContactMotion const& m) {
  const double before = gap_of(c, m.start), after = gap_of(c, m.free);
  return before > 0 && after < 0 ? after / (after - before) : 1;
}

/// The directions of the equations of a contact: its normal and two tangents, of length 1 and at right
/// angles.
SINEW_HD inline Eigen::Matrix3d contact_axes(Eigen::Vector3d const& normal) {
  int smallest = 0;
  normal.cwiseAbs().minCoeff(&smallest);
  Eigen::Matrix3d axes;
  axes.col(0) = normal;
  axes.col(1) = normal.cross(Eigen::Vector3d::Unit(smallest)).normalized();
  axes.col(2) = normal.cross(axes.col(1));
  return axes;
}

/// A response to contacts by multipliers: addRows(rows, contact, motion) adds nothing, or one block of rows
/// with their violations, along the axes of the contact (contact_axes) in their order. Forces on b along the
/// axes are its multipliers.
template <class R>
concept ContactConstraint = requires(R const r, ConstraintRows rows, Contact c, ContactMotion const m) {
  { R::className } -> std::convertible_to<std::string_view>;
  r.addRows(rows, c, m);
};
/// One whose violations are those of the motion alone, so that they may be found on a GPU:
/// violations(contact, motion, whether they are rates, d) gives the d of its rows.
template <class R>
concept MeasuresMotion =
    requires(Contact const c, ContactMotion const m, double* d) { R::violations(c, m, true, d); };

}  // namespace sinew
