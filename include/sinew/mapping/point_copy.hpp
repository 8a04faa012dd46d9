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

  // the same as loops of MappedLoops take it

  struct Positions {
    SINEW_HD typename Out::Coord operator()(typename In::Coord const* from, int i) const {
      typename Out::Coord to;
      position(to, from[i]);
      return to;
    }
  };
  struct Velocities {
    SINEW_HD typename Out::Deriv operator()(typename In::Deriv const* from, int i) const {
      typename Out::Deriv to;
      velocity(to, from[i]);
      return to;
    }
  };
  struct Forces {
    SINEW_HD typename In::Deriv operator()(typename Out::Deriv const* from, int i,
                                           typename In::Deriv sum) const {
      force(sum, from[i]);
      return sum;
    }
  };
};

}  // namespace sinew
