// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/constrained_points.hpp>

#include <algorithm>
#include <vector>

namespace sinew {

/// The fields of a constraint by which points move steadily, and behind them those that say where to.
template <class C, class... More>
constexpr auto steady_movement_fields(More... more) {
  return field_list(
      field("indices", &C::indices, "", "points that are moved", range::nonNegative).numbersOf(Of::points),
      field("beginConstraintTime", &C::beginConstraintTime, "s", "time at which the movement starts"),
      field("endConstraintTime", &C::endConstraintTime, "s", "time at which the movement ends"),
      more...);
}

/// Points of a constraint `C` with these fields, which move at constant speed from their rest positions, from
/// a first time to a last; before and after they are held.
template <class D>
struct SteadyMovement {
  using Real = typename D::Real;
  using Deriv = typename D::Deriv;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;

  VecCoord start{};
  VecDeriv movement{};  // from start to the end, one for each

  /// Takes their places at rest; movements are to follow. Throws Error for points that are not there, and
  /// where the end is not after the begin.
  template <class C>
  void init(InitContext<D> const& context, C const& of) {
    check_points<C>(context, of.indices);
    if (!(of.endConstraintTime > of.beginConstraintTime))
      throw Error(place_of<C>(context),
                  text("beginConstraintTime is ",
                       of.beginConstraintTime,
                       " s and endConstraintTime ",
                       of.endConstraintTime,
                       " s; give an end after the begin"));
    start.clear(), movement.clear();
    for (const int i : of.indices) start.push_back(context.rest[std::size_t(i)]);
  }

  template <class C>
  void projectPosition(C const& of, double time, VecCoord& x) const {
    if (time < of.beginConstraintTime) return;
    const double part = std::min((time - of.beginConstraintTime) / duration(of), 1.0);
    for (std::size_t k = 0; k < of.indices.size(); ++k) {
      typename D::Coord& place = x[std::size_t(of.indices[k])];
      place = start[k];
      D::increment(place, movement[k] * Real(part));
    }
  }
  template <class C>
  void projectVelocity(C const& of, double time, VecDeriv& v) const {
    const bool moves = time >= of.beginConstraintTime && time < of.endConstraintTime;
    for (std::size_t k = 0; k < of.indices.size(); ++k)
      v[std::size_t(of.indices[k])] = moves ? Deriv(movement[k] / Real(duration(of))) : Deriv(Deriv::Zero());
  }

 private:
  template <class C>
  static double duration(C const& of) {
    return of.endConstraintTime - of.beginConstraintTime;
  }
};

}  // namespace sinew
