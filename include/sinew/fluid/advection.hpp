// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/fluid/staggered_velocity.hpp>

#include <string_view>

namespace sinew::fluid {

/// semiLagrangian: of first order, stable for any step (Stam 1999). macCormack: of second order, kept between
/// the values around, and as stable (Selle, Fedkiw, Kim, Liu, Rossignac 2008).
enum class Advection { semiLagrangian, macCormack };
inline constexpr std::array<std::string_view, 2> enum_names(Advection) {
  return {"semiLagrangian", "macCormack"};
}

/// Room for what advection keeps of a field.
template <class Real>
struct AdvectionRoom {
  std::vector<Real> low{}, high{}, there{};
  void init(std::size_t n) {
    for (auto* field : {&low, &high, &there}) field->assign(n, Real(0));
  }
};

/// result = `field` carried along by u for a step [cells per m/s], where wanted(index) says so, else as it
/// was. The values are those of faces of axis c, or of the centres of cells (-1), and fill(field) makes those
/// of the layer around.
///   a semi-Lagrangian step forth, one back:   r^ = A(field),  f~ = A^-1(r^),  result = r^ + (field - f~) / 2
template <class Real, int N, class Wanted, class Fill>
void advect(StaggeredVelocity<Real, N> const& u, int c, std::vector<Real> const& field,
            std::vector<Real>& result, Real step, Advection method, AdvectionRoom<Real>& room,
            SomeWorkers workers, Wanted&& wanted, Fill&& fill) {
  using Vector = typename StaggeredVelocity<Real, N>::Vector;
  CellGrid<N> const& grid = u.grid;
  const bool second = method == Advection::macCormack;
  std::vector<Real>& once = second ? room.there : result;
  auto forPlaces = [&](auto&& f) {
    grid.forRows(workers, [&](std::size_t row, std::ptrdiff_t first) {
      const auto at = grid.place(row);
      Vector x;
      for (int d = 0; d < N; ++d) x[d] = Real(at[std::size_t(d)]) - (d == c ? Real(1) : Real(0.5));
      for (std::ptrdiff_t i = first; i < first + grid.cells[0]; ++i, x[0] += 1) f(i, x);
    });
  };
  forPlaces([&](std::ptrdiff_t i, Vector const& x) {
    const auto k = std::size_t(i);
    if (!wanted(i)) {
      once[k] = field[k];
      return;
    }
    const Vector from = u.trace(x, u.velocityAt(c, i), step);
    if (second) {
      Real low = std::numeric_limits<Real>::max(), high = std::numeric_limits<Real>::lowest();
      once[k] = u.template interpolate<true>(field.data(), c, from, &low, &high);
      room.low[k] = low;
      room.high[k] = high;
    } else {
      once[k] = u.interpolate(field.data(), c, from);
    }
  });
  fill(once);
  if (!second) return;
  forPlaces([&](std::ptrdiff_t i, Vector const& x) {
    const auto k = std::size_t(i);
    if (!wanted(i)) {
      result[k] = field[k];
      return;
    }
    const Real back = u.interpolate(once.data(), c, u.trace(x, u.velocityAt(c, i), -step));
    result[k] = std::clamp(once[k] + (field[k] - back) / 2, room.low[k], room.high[k]);
  });
  fill(result);
}

}  // namespace sinew::fluid
