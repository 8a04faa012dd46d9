// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>
#include <sinew/core/lists.hpp>
#include <sinew/core/point_loop.hpp>

#include <numeric>
#include <vector>

namespace sinew {

// What projective constraints share.

/// "node: component", for messages.
template <class C>
std::string place_of(InitContext<typename C::DataTypes> const& context) {
  return text(context.where, ": ", component_name<C>());
}

/// Throws Error unless all indices are points of the state.
template <class C>
void check_points(InitContext<typename C::DataTypes> const& context, std::vector<int> const& indices) {
  check_points(place_of<C>(context), "indices", indices, context.rest.size());
}

/// The points that a constraint holds: those of a list, or all; as a loop over them reads them.
template <class C>
auto held_points(InitContext<typename C::DataTypes> const& context, std::vector<int> const& indices,
                 bool all) {
  if (!all) check_points<C>(context, indices);
  std::vector<int> held = indices;
  if (all) {
    held.resize(context.rest.size());
    for (std::size_t i = 0; i < held.size(); ++i) held[i] = int(i);
  }
  return held;
}

/// The same, into the list that there is.
template <class C, class Held>
void hold_points(std::string_view where, std::size_t points, std::vector<int> const& indices, bool all,
                 Held& held) {
  if (!all) check_points([&] { return text(where, ": ", component_name<C>()); }, "indices", indices, points);
  if (!all) return void(held = indices);
  std::vector<int> each(points);
  std::iota(each.begin(), each.end(), 0);
  held = each;
}

/// Throws Error unless times rise and have one value each.
template <class C>
void check_key_times(InitContext<typename C::DataTypes> const& context, std::vector<double> const& times,
                     std::size_t values, std::string_view name) {
  const std::string where = place_of<C>(context);
  if (times.empty()) throw Error(where, "keyTimes is empty; give at least one time");
  if (times.size() != values)
    throw Error(
        where,
        text("there are ", times.size(), " keyTimes and ", values, ' ', name, "; give one for each time"));
  for (std::size_t k = 1; k < times.size(); ++k)
    if (!(times[k] > times[k - 1]))
      throw Error(where,
                  text("keyTimes[",
                       k,
                       "] is ",
                       times[k],
                       " s, not after keyTimes[",
                       k - 1,
                       "]; put them in rising order"));
}

/// Throws Error unless a movement ends after it begins; one of no points may be without times.
template <class C>
void check_begin_and_end(InitContext<typename C::DataTypes> const& context, double begin, double end,
                         bool noPoints) {
  if (!noPoints && !(end > begin))
    throw Error(place_of<C>(context),
                text("BeginTime is ", begin, " s and EndTime ", end, " s; give an end after the beginning"));
}

/// The interval between two key times that holds a time, and how far in it the time is, from 0 to 1. Needs
/// two times or more; a time outside gets the nearest interval.
struct KeyInterval {
  std::size_t first;
  double part, length;
};
KeyInterval key_interval(std::vector<double> const& times, double time);

/// The time that a prescribed movement takes.
struct MovementTime {
  double begin, end;

  /// Whether points move in the step from a time on.
  bool moves(double time) const { return time >= begin && time < end; }
  /// Whether the movement says where they are at a time.
  bool given(double time) const { return time >= begin && time <= end && begin < end; }
};

template <class D>
void set_center(typename D::Coord& x, Vec<typename D::Real, D::spatial> const& center) {
  if constexpr (D::rigid)
    x.center = center;
  else
    x.template head<D::spatial>() = center;
}

/// Puts the centres of points to one place, or gives them one velocity, without rotation.
template <class D>
void place_points(typename D::VecCoord& x, std::vector<int> const& indices,
                  Vec<double, D::spatial> const& place) {
  for (const int i : indices) set_center<D>(x[std::size_t(i)], place.template cast<typename D::Real>());
}
template <class D>
void move_points(typename D::VecDeriv& v, std::vector<int> const& indices,
                 Vec<double, D::spatial> const& velocity) {
  for (const int i : indices) {
    v[std::size_t(i)].setZero();
    v[std::size_t(i)].template head<D::spatial>() = velocity.template cast<typename D::Real>();
  }
}

/// The projector of all coordinates of a point from that of its place.
template <class D>
Mat<typename D::Real, D::size> projector_of_place(Mat<double, D::spatial> const& place) {
  using Real = typename D::Real;
  Mat<Real, D::size> all = Mat<Real, D::size>::Identity();
  all.template topLeftCorner<D::spatial, D::spatial>() = place.template cast<Real>();
  return all;
}

/// A direction of length 1; throws Error where it is zero.
template <class C, class V>
V unit(InitContext<typename C::DataTypes> const& context, std::string_view name, V const& direction) {
  if (!(direction.norm() > 0)) throw Error(place_of<C>(context), text(name, " is zero; give a direction"));
  return direction.normalized();
}

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>

namespace sinew {

SINEW_ONCE KeyInterval key_interval(std::vector<double> const& times, double time) {
  const auto after = std::upper_bound(times.begin(), times.end(), time) - times.begin();
  const auto first = std::size_t(std::clamp<std::ptrdiff_t>(after - 1, 0, std::ptrdiff_t(times.size()) - 2));
  const double length = times[first + 1] - times[first];
  return {first, (time - times[first]) / length, length};
}

}  // namespace sinew
#endif
