// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/constrained_points.hpp>

#include <cmath>
#include <vector>

namespace sinew {

/// One point of an OscillatorConstraint.
template <class D>
struct Oscillator {
  int index = 0;
  typename D::Coord mean = D::zero();
  typename D::Deriv amplitude = D::Deriv::Zero();
  double pulsation = 0, phase = 0;

  static constexpr auto fields() {
    using O = Oscillator;
    return field_list(
        field("index", &O::index, "", "point that is moved", range::nonNegative).numbersOf(Of::points),
        field("mean", &O::mean, "m", "position in the middle"),
        field("amplitude", &O::amplitude, "m", "largest movement from there"),
        field("pulsation", &O::pulsation, "rad/s", "angular frequency"),
        field("phase", &O::phase, "rad", "angle at time 0"));
  }
};

/// Points that swing about a place: x = mean + amplitude sin(pulsation t + phase), and the velocity of that.
template <class D>
struct OscillatorConstraint {
  using Role = role::ProjectiveConstraint;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "OscillatorConstraint";
  static constexpr std::string_view aliases = "OscillatorProjectiveConstraint";

  std::vector<Oscillator<D>> oscillators{};

  static constexpr auto fields() {
    return field_list(field("oscillators",
                            &OscillatorConstraint::oscillators,
                            "",
                            "the oscillators: point, mean position, amplitude, pulsation, phase"));
  }

  void init(InitContext<D> const& context) {
    for (std::size_t k = 0; k < oscillators.size(); ++k)
      if (std::size_t(oscillators[k].index) >= context.rest.size())
        throw Error(place_of<OscillatorConstraint>(context),
                    text("oscillators[",
                         k,
                         "] moves point ",
                         oscillators[k].index,
                         ", but the state has ",
                         context.rest.size(),
                         " points, numbered from 0; correct the index"));
  }

  void projectResponse(VecDeriv& dx) const {
    for (auto const& o : oscillators) dx[std::size_t(o.index)].setZero();
  }
  template <class Sink>
  void projectMatrix(Sink const& sink) const {
    for (auto const& o : oscillators) sink.fix(o.index);
  }

  void projectPosition(double time, VecCoord& x) const {
    for (auto const& o : oscillators) {
      typename D::Coord& place = x[std::size_t(o.index)];
      place = o.mean;
      D::increment(place, o.amplitude * Real(std::sin(o.pulsation * time + o.phase)));
    }
  }
  void projectVelocity(double time, VecDeriv& v) const {
    for (auto const& o : oscillators)
      v[std::size_t(o.index)] = o.amplitude * Real(o.pulsation * std::cos(o.pulsation * time + o.phase));
  }
};

}  // namespace sinew
