// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>

namespace sinew {

/// A point of one state that is a point of another: the same in another precision perhaps, or the centre of a
/// rigid body.
template <class In, class Out>
struct PointCopy {
  using Real = typename Out::Real;
  static constexpr bool centers = In::rigid && !Out::rigid;
  static constexpr bool possible =
      centers ? In::spatial == Out::size : In::size == Out::size && In::rigid == Out::rigid;
  using Jacobian = Mat<Real, Out::size, In::size>;

  SINEW_HD static void position(typename Out::Coord& to, typename In::Coord const& from) {
    if constexpr (centers) {
      to = from.center.template cast<Real>();
    } else if constexpr (In::rigid) {
      to.center = from.center.template cast<Real>();
      if constexpr (In::spatial == 3)
        to.orientation.coeffs() = from.orientation.coeffs().template cast<Real>();
      else
        to.orientation = Real(from.orientation);
    } else {
      to = from.template cast<Real>();
    }
  }
  SINEW_HD static void velocity(typename Out::Deriv& to, typename In::Deriv const& from) {
    to = from.template head<Out::size>().template cast<Real>();
  }
  SINEW_HD static void force(typename In::Deriv& to, typename Out::Deriv const& from) {
    to.template head<Out::size>() += from.template cast<typename In::Real>();
  }

  // the same for the loops over all points

  struct Position {
    SINEW_HD void operator()(typename Out::Coord& to, typename In::Coord const& from) const {
      position(to, from);
    }
  };
  struct Velocity {
    SINEW_HD void operator()(typename Out::Deriv& to, typename In::Deriv const& from) const {
      velocity(to, from);
    }
  };
  struct Force {
    SINEW_HD void operator()(typename In::Deriv& to, typename Out::Deriv const& from) const {
      force(to, from);
    }
  };
};

}  // namespace sinew
