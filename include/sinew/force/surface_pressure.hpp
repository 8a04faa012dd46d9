// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/core/lists.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace sinew {

/// Pressure on a triangle abc, that follows its area and normal.
///   E = -p (V - V_rest),  V = a.(b x c)/6: volume of the cone from the origin                  [J]
///   f_a = f_b = f_c = p/6 n,  n = (b - a) x (c - a): a third of the load each                  [N]
///   df_a/dx_b = -p/4 [c - m]x,  m = (a + b + c)/3: symmetric part of the derivative
/// On a closed surface f = -dE/dx, and what the tangent leaves out cancels (Hibbitt 1979); along the border
/// of an open one there is no energy, and the tangent is its symmetric part.
template <class D>
struct TrianglePressure {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  static constexpr int arity = 3;
  static constexpr bool usesVelocity = false;

  Real pressure{0};

  struct Rest {
    Real volume;  // V_rest
  };
  struct Tangent {
    Deriv arm[3];  // p/4 (x - m) of each corner
  };

  SINEW_HD Real energy(Rest const& rest, Coord const (&x)[3]) const {
    return pressure * (rest.volume - volume(x[0], x[1], x[2]));
  }

  SINEW_HD void force(Rest const&, Coord const (&x)[3], Deriv const (&)[3], Deriv (&f)[3],
                      Tangent& tangent) const {
    const Deriv middle = (x[0] + x[1] + x[2]) * Real(1.0 / 3);
    for (int k = 0; k < 3; ++k) tangent.arm[k] = (x[k] - middle) * (pressure * Real(0.25));
    f[0] = cross(x[1] - x[0], x[2] - x[0]) * (pressure * Real(1.0 / 6));
    f[1] = f[2] = f[0];
  }

  SINEW_HD void dforce(Rest const&, Tangent const& tangent, Deriv const (&dx)[3], Deriv (&df)[3], Real k,
                       Real /*b*/) const {
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      df[a] = (cross(tangent.arm[b], dx[c]) - cross(tangent.arm[c], dx[b])) * k;
    }
  }

  SINEW_INLINE Mat<Real, 3> block(Rest const&, Tangent const& tangent, int i, int j, Real k,
                                  Real /*b*/) const {
    Mat<Real, 3> block;
    for (int c = 0; c < 9; ++c) block(c) = Real(0);
    if (i == j) return block;
    const Real factor = j == (i + 1) % 3 ? -k : k;
    const Deriv w = tangent.arm[3 - i - j] * factor;
    block(0, 1) = -w[2], block(0, 2) = w[1], block(1, 2) = -w[0];
    block(1, 0) = w[2], block(2, 0) = -w[1], block(2, 1) = w[0];
    return block;
  }

  SINEW_INLINE static Real volume(Deriv const& a, Deriv const& b, Deriv const& c) {
    const Deriv n = cross(b, c);
    return (a[0] * n[0] + a[1] * n[1] + a[2] * n[2]) * Real(1.0 / 6);
  }

 private:
  SINEW_INLINE static Deriv cross(Deriv const& a, Deriv const& b) {
    return Deriv(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
  }
};

/// Whether each edge is passed as often in one direction as in the other.
inline bool is_closed(std::vector<Triangle> const& triangles) {
  std::vector<Edge> there, back;
  for (Triangle const& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      there.push_back({t[k], t[(k + 1) % 3]});
      back.push_back({t[(k + 1) % 3], t[k]});
    }
  std::sort(there.begin(), there.end());
  std::sort(back.begin(), back.end());
  return there == back;
}

/// Pressure on triangles and quads of the topology, along their normals: those with the given indices, else
/// all, and of these only the ones that lie at rest in the box from `min` to `max` where one is given. A quad
/// is the triangles 012 and 023.
///
/// In pulses the pressure starts from 0 and goes, by `pressureSpeed` times the step in each step, to
/// `pressure`, then to `pressureLowerBound` and so on.
template <class D>
struct SurfacePressureForceField {
  using Role = role::ForceField;
  static constexpr bool actsBeforeStep = true;
  using DataTypes = D;
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using VecCoord = typename D::VecCoord;
  static constexpr std::string_view className = "SurfacePressureForceField";

  double pressure = 0;
  std::optional<Coord> min{}, max{};
  std::vector<int> triangleIndices{}, quadIndices{};
  bool pulseMode = false;
  double pressureSpeed = 0, pressureLowerBound = 0;

  static constexpr auto fields() {
    using F = SurfacePressureForceField;
    return field_list(
        field("pressure", &F::pressure, "Pa", "force per area along the normal").whileRunning(),
        field("min", &F::min, "m", "lowest corner of a box around the elements"),
        field("max", &F::max, "m", "highest corner of a box around the elements"),
        field("triangleIndices", &F::triangleIndices, "", "triangles under pressure", range::nonNegative)
            .numbersOf(Of::triangles),
        field("quadIndices", &F::quadIndices, "", "quads under pressure", range::nonNegative)
            .numbersOf(Of::quads),
        field("pulseMode", &F::pulseMode, "", "whether the pressure rises and falls"),
        field("pressureSpeed",
              &F::pressureSpeed,
              "Pa/s",
              "how fast it does; 0: from 0 to pressure in a second",
              range::nonNegative),
        field(
            "pressureLowerBound", &F::pressureLowerBound, "Pa", "where pulses reverse, besides at pressure"));
  }

  ForceProperties properties() const {
    return {.internal = closed, .objective = closed, .conservative = closed, .exactTangent = closed};
  }

  bool none = false;  // all of them have been removed
  double pulse = 0;   // pressure of the pulse [Pa]
  bool returning = false;

  static constexpr auto state() {
    using F = SurfacePressureForceField;
    return field_list(
        field("none", &F::none, "", "all of the elements with an index have been removed"),
        field("pulse", &F::pulse, "Pa", "pressure of the pulse"),
        field("returning", &F::returning, "", "whether the pulse goes from pressure to its other bound"));
  }

  double currentPressure() const { return pulseMode ? pulse : pressure; }

  template <class State>
  bool beginStep(StepAhead const& step, State const&) {
    if (!pulseMode) return false;
    const double speed = pressureSpeed > 0 ? pressureSpeed : std::abs(pressure);
    const double to = returning ? pressureLowerBound : pressure;
    const bool rises = returning != (pressure > 0);
    pulse += rises ? speed * step.dt : -speed * step.dt;
    if (rises ? pulse >= to : pulse <= to) pulse = to, returning = !returning;
    return false;
  }
  void reset() {
    pulse = 0;
    returning = false;
  }

  using Driver = ElementDriver<TrianglePressure, D>;
  Driver driver{};
  bool closed = false;  // the surface has no border

  /// The pressure as it is now, for lanes or one element at a time: it may change from step to step.
  template <class L>
  L law() const {
    return {typename L::Real(currentPressure())};
  }

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<SurfacePressureForceField>());
    TopologyView const& t = context.topology;
    if (t.triangles.empty() && t.quads.empty() && !none)
      throw Error(where, "the topology has neither triangle nor quad; give the node a surface");
    detail::check_indices(where, "triangle", t.triangles, context.rest.size());
    detail::check_indices(where, "quad", t.quads, context.rest.size());
    std::vector<Triangle> loaded;
    choose(where, "triangleIndices", triangleIndices, t.triangles, context.rest, [&](Triangle const& e) {
      loaded.push_back(e);
    });
    choose(where, "quadIndices", quadIndices, t.quads, context.rest, [&](Quad const& e) {
      loaded.push_back({e[0], e[1], e[2]});
      loaded.push_back({e[0], e[2], e[3]});
    });
    std::vector<typename Driver::Rest> rest;
    for (Triangle const& e : loaded)
      rest.push_back({TrianglePressure<D>::volume(context.rest[std::size_t(e[0])],
                                                  context.rest[std::size_t(e[1])],
                                                  context.rest[std::size_t(e[2])])});
    driver.init(loaded, rest);
    closed = is_closed(loaded);
  }

 private:
  template <class Elements, class F>
  void choose(std::string const& where, std::string_view name, std::vector<int> const& indices,
              Elements const& elements, VecCoord const& rest, F&& take) const {
    auto inBox = [&](auto const& element) {
      return std::all_of(element.begin(), element.end(), [&](int i) {
        auto const& x = rest[std::size_t(i)];
        return (!min || (x.array() >= min->array()).all()) && (!max || (x.array() <= max->array()).all());
      });
    };
    check_numbers(where, name, indices, elements.size(), "such elements", "the topology");
    for (const int e : indices) take(elements[std::size_t(e)]);
    if (indices.empty() && !none)
      for (auto const& element : elements)
        if (inBox(element)) take(element);
  }
};

}  // namespace sinew
