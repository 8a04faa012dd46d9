// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/constrained_points.hpp>
#include <sinew/core/lists.hpp>
#include <sinew/lagrangian/constraint_rows.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <utility>
#include <vector>

namespace sinew {

// Contacts between given points, as constraints that are lists of them share them.

/// Two points that a constraint keeps apart along a normal from the first to the second:
///   d = n.(x2 - x1) - distance >= 0
/// and, with friction, the slide d_t of the second against the first over the step, since they touch. It is
/// softer with a compliance C: f = -(d/C + c (d - d0)/h) with what is damped, c, of the depth since the start
/// of the step, d0 <= 0.
struct PointContact {
  int first, second;
  Eigen::Vector3d normal;  // of length 1
  double distance = 0;     // [m]
  double mu = 0;
  double compliance = 0;  // C [m/N]
  double damping = 0;     // c [N s/m]
};

/// Two directions across the normal and each other.
inline std::pair<Eigen::Vector3d, Eigen::Vector3d> tangents_of(PointContact const& contact) {
  const Eigen::Vector3d t = contact.normal.unitOrthogonal();
  return {t, contact.normal.cross(t)};
}

/// Adds the row of a contact, or three with friction, without their violations. `secondSide`: 1 where the
/// second point is of another state.
template <class D>
void add_contact(ConstraintRows& rows, PointContact const& contact, int secondSide) {
  static_assert(!D::rigid && D::size == 3, "contacts are between points in space");
  auto fill = [&](int row, Eigen::Vector3d const& direction) {
    const typename D::Deriv j = direction.template cast<typename D::Real>();
    rows.addTo(row, contact.first, typename D::Deriv(-j));
    rows.addTo(row, contact.second, j, secondSide);
  };
  const int row = contact.mu > 0 ? rows.addContact(contact.mu) : rows.addUnilateral();
  fill(row, contact.normal);
  if (!(contact.mu > 0)) return;
  const auto [t, s] = tangents_of(contact);
  fill(row + 1, t);
  fill(row + 2, s);
}

/// Sets the violations of a contact whose first row is given; returns that of the next one.
template <class D>
int set_violation(ConstraintRows& rows, int row, PointContact const& contact,
                  ConstrainedState<D> const& first, ConstrainedState<D> const& second) {
  using Vector = Eigen::Vector3d;
  const auto a = std::size_t(contact.first), b = std::size_t(contact.second);
  const double h = first.dt;
  const Vector start = (second.position[b] - first.position[a]).template cast<double>();
  // what rows are of: differences at the end of the step, or their rates
  const Vector end =
      rows.ofVelocity ? Vector(start / h + (second.velocity[b] - first.velocity[a]).template cast<double>())
                      : Vector((second.free[b] - first.free[a]).template cast<double>());
  const double unit = rows.ofVelocity ? 1 / h : 1;
  const double before = contact.normal.dot(start) - contact.distance;
  const double d = contact.normal.dot(end) - unit * contact.distance;
  // d + C f + C c (d - d0)/h = 0 over 1 + r, r = C c/h
  const double r = contact.compliance * contact.damping / h;
  rows.setViolation(row, d - unit * r / (1 + r) * std::min(before, 0.0));
  rows.soften(row, unit * contact.compliance / (1 + r));
  if (!(contact.mu > 0)) return row + 1;
  // of a motion that begins apart only the part behind the touch: rates are those at the end
  const double touching = rows.ofVelocity || before <= 0 ? 1 : d < 0 ? d / (d - before) : 0;
  const Vector slide = touching * (end - unit * start);
  const auto [t, s] = tangents_of(contact);
  rows.setViolation(row + 1, t.dot(slide));
  rows.setViolation(row + 2, s.dot(slide));
  return row + 3;
}

/// Throws Error unless there is a point, a normal that is not zero, and one value or one for each in the
/// lists of a constraint C with contacts.
template <class C, class D>
void check_contacts(C const& c, InitContext<D> const& first, InitContext<D> const& second) {
  const std::string where = place_of<C>(first);
  check_points(where, "first_point", c.first_point, first.rest.size());
  check_points(where, "second_point", c.second_point, second.rest.size());
  const std::size_t n = c.first_point.size();
  if (c.second_point.size() != n)
    throw Error(where,
                text("first_point has ",
                     n,
                     " entries and second_point ",
                     c.second_point.size(),
                     "; give as many, a pair for each contact"));
  if (n == 0) return;
  check_one_or_each(where, "normal", c.normal.size(), n, "contacts", "one direction");
  check_one_or_each(where, "contactDistance", c.contactDistance.size(), n, "contacts");
  check_one_or_each(where, "mu", c.mu.size(), n, "contacts");
  for (std::size_t i = 0; i < c.normal.size(); ++i)
    if (!(c.normal[i].norm() > 0))
      throw Error(where,
                  text("normal[", i, "] is zero; give the direction from the first point to the second"));
  for (std::size_t i = 0; i < n; ++i)
    if (!C::between && c.first_point[i] == c.second_point[i])
      throw Error(
          where, text("contact ", i, " is between point ", c.first_point[i], " and itself; give two points"));
}

/// The ith contact of such a constraint.
template <class C>
PointContact contact_of(C const& c, std::size_t i) {
  return {c.first_point[i],
          c.second_point[i],
          one_or_each(c.normal, i).normalized().template cast<double>(),
          one_or_each(c.contactDistance, i),
          one_or_each(c.mu, i)};
}

/// The rows of all contacts of such a constraint, which are contactAt(i), and their violations.
template <class C>
void add_contacts(C const& c, ConstraintRows& rows) {
  for (std::size_t i = 0; i < c.first_point.size(); ++i)
    add_contact<typename C::DataTypes>(rows, c.contactAt(i), C::between ? 1 : 0);
}
template <class C, class D>
void set_violations(C const& c, ConstraintRows& rows, int row, ConstrainedState<D> const& first,
                    ConstrainedState<D> const& second) {
  for (std::size_t i = 0; i < c.first_point.size(); ++i)
    row = set_violation(rows, row, c.contactAt(i), first, second);
}

/// The fields of such a constraint C, and more.
template <class C, class... More>
constexpr auto contact_fields(More... more) {
  return field_list(
      field("first_point", &C::first_point, "", "points of the first body", range::nonNegative)
          .numbersOf(Of::points),
      field("second_point",
            &C::second_point,
            "",
            "points of the second from which they are kept apart",
            range::nonNegative)
          .numbersOf(Of::secondPoints),
      field("normal",
            &C::normal,
            "",
            "direction from the first point to the second, along which they are kept apart; one for all, or "
            "one for each")
          .oneEach(Of::entries),
      field("contactDistance", &C::contactDistance, "m", "how far apart; one for all, or one for each")
          .oneEach(Of::entries),
      field("mu", &C::mu, "", "Coulomb's friction; one for all, or one for each", range::nonNegative)
          .oneEach(Of::entries),
      more...);
}

}  // namespace sinew
