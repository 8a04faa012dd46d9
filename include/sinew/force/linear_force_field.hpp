// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/lists.hpp>

#include <algorithm>
#include <vector>

namespace sinew {

/// The same force on chosen points, linear in time between key times: none before the first, the last for
/// ever.
template <class D>
struct LinearForceField {
  using Role = role::ForceField;
  static constexpr bool isLoad = true;
  using DataTypes = D;
  using Real = typename D::Real;
  using Deriv = typename D::Deriv;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "LinearForceField";

  std::vector<int> points{};
  double force = 1;
  std::vector<double> times{};
  VecDeriv forces{};

  static constexpr auto fields() {
    using F = LinearForceField;
    return field_list(field("points", &F::points, "", "points that the force acts on", range::nonNegative)
                          .numbersOf(Of::points)
                          .also("indices"),
                      field("force", &F::force, "", "factor of all forces").also("factor").whileRunning(),
                      field("times", &F::times, "s", "key times, in rising order"),
                      field("forces", &F::forces, "N", "force on each of the points at each key time"));
  }

  static constexpr ForceProperties properties() {
    return {.internal = false, .objective = false, .conservative = !(D::rigid && D::spatial == 3)};
  }

  VecCoord rest{};
  Deriv current = Deriv::Zero();  // force of the last addForce

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<LinearForceField>());
    if (times.empty()) throw Error(where, "times is empty; give at least one key time, and its force");
    if (times.size() != forces.size())
      throw Error(where,
                  text("there are ",
                       times.size(),
                       " times and ",
                       forces.size(),
                       " forces; give one force for each key time"));
    for (std::size_t k = 1; k < times.size(); ++k)
      if (!(times[k] > times[k - 1]))
        throw Error(where,
                    text("times[",
                         k,
                         "] is ",
                         times[k],
                         " s, not after times[",
                         k - 1,
                         "]; put them in rising order"));
    check_points(where, "points", points, context.rest.size());
    rest = context.rest;
    current = at(0);
  }

  Deriv at(double time) const {
    if (time < times.front()) return Deriv::Zero();
    if (time >= times.back()) return forces.back() * Real(force);
    const auto next = std::size_t(std::upper_bound(times.begin(), times.end(), time) - times.begin());
    const double s = (time - times[next - 1]) / (times[next] - times[next - 1]);
    return (forces[next - 1] * Real(1 - s) + forces[next] * Real(s)) * Real(force);
  }

  void addForce(MechanicalParams const& p, VecDeriv& f, VecCoord const&, VecDeriv const&) {
    current = at(p.time);
    for (const int i : points) f[std::size_t(i)] += current;
  }
  void addDForce(MechanicalParams const&, VecDeriv&, VecDeriv const&) const {}
  template <class Sink>
  void addToMatrix(MechanicalParams const&, Sink const&) const {}

  /// E = -sum f.(x - x_rest) with the force of the last addForce, torques by the rotation vector from rest
  /// [J]
  double potentialEnergy(VecCoord const& x) const {
    double energy = 0;
    for (const int i : points)
      energy -= double(current.dot(D::difference(rest[std::size_t(i)], x[std::size_t(i)])));
    return energy;
  }
};

}  // namespace sinew
