// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/fluid/staggered_velocity.hpp>

#include <limits>
#include <string_view>

namespace sinew::fluid {

/// semiLagrangian: of first order, stable for any step (Stam 1999). macCormack: of second order, kept between
/// the values around, and as stable (Selle, Fedkiw, Kim, Liu, Rossignac 2008).
enum class Advection { semiLagrangian, macCormack };
inline constexpr std::array<std::string_view, 2> enum_names(Advection) {
  return {"semiLagrangian", "macCormack"};
}

/// Room for what advection keeps of a field.
template <class Real, class Loops = HostLoops>
struct AdvectionRoom {
  typename Loops::template Array<Real> low{}, high{}, there{};
  void init(std::size_t n) {
    for (auto* field : {&low, &high, &there}) Loops::assign(*field, n, Real(0));
  }
};

/// A step forth: once = A(field), and the bounds of what it lay between, if they are wanted.
template <class Real, int N, class Wanted>
struct CarryForth {
  VelocityView<Real, N> u;
  int axis;  // of the faces; -1: centres
  Real step;
  Wanted wanted;
  Real const* field;
  Real *once, *low, *high;
  bool bounds;

  SINEW_INLINE typename VelocityView<Real, N>::Vector from(Each<int, N> const& at, std::ptrdiff_t i,
                                                           Real by) const {
    typename VelocityView<Real, N>::Vector x;
    for (int d = 0; d < N; ++d) x[d] = Real(at[std::size_t(d)]) - (d == axis ? Real(1) : Real(0.5));
    return u.trace(x, u.velocityAt(axis, i), by);
  }
  SINEW_INLINE void operator()(Each<int, N> const& at, std::ptrdiff_t i) const {
    if (!wanted(i)) {
      once[i] = field[i];
      return;
    }
    const auto x = from(at, i, step);
    if (bounds) {
      Real least = std::numeric_limits<Real>::max(), most = std::numeric_limits<Real>::lowest();
      once[i] = u.template interpolate<true>(field, axis, x, &least, &most);
      low[i] = least;
      high[i] = most;
    } else {
      once[i] = u.interpolate(field, axis, x);
    }
  }
};
/// A step back, and what it misses of the field halved.
template <class Real, int N, class Wanted>
struct CarryBack {
  CarryForth<Real, N, Wanted> forth;
  Real* result;

  SINEW_INLINE void operator()(Each<int, N> const& at, std::ptrdiff_t i) const {
    if (!forth.wanted(i)) {
      result[i] = forth.field[i];
      return;
    }
    const Real back =
        forth.u.interpolate(static_cast<Real const*>(forth.once), forth.axis, forth.from(at, i, -forth.step));
    const Real value = forth.once[i] + (forth.field[i] - back) / 2;
    result[i] = value < forth.low[i] ? forth.low[i] : (forth.high[i] < value ? forth.high[i] : value);
  }
};

/// result = `field` carried along by u for a step [cells per m/s], where wanted(index) says so, else as it
/// was. The values are those of faces of axis c, or of the centres of cells (-1), and fill(field) makes those
/// of the layer around.
///   a semi-Lagrangian step forth, one back:   r^ = A(field),  f~ = A^-1(r^),  result = r^ + (field - f~) / 2
template <class Real, int N, class Loops, class Wanted, class Fill>
void advect(StaggeredVelocity<Real, N, Loops> const& u, int c,
            typename Loops::template Array<Real> const& field, typename Loops::template Array<Real>& result,
            Real step, Advection method, AdvectionRoom<Real, Loops>& room, Loops const& loops,
            Wanted const& wanted, Fill&& fill) {
  const bool second = method == Advection::macCormack;
  auto& once = second ? room.there : result;
  const CarryForth<Real, N, Wanted> forth{u.view(),
                                          c,
                                          step,
                                          wanted,
                                          entries(field),
                                          entries(once),
                                          entries(room.low),
                                          entries(room.high),
                                          second};
  loops.cells(u.grid, forth);
  fill(once);
  if (!second) return;
  loops.cells(u.grid, CarryBack<Real, N, Wanted>{forth, entries(result)});
  fill(result);
}

}  // namespace sinew::fluid
