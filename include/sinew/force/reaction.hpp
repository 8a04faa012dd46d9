// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/platform.hpp>

#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

// clang-format off
/// How values u of a body react, each place for itself: du/dt = R(u, w), with a variable w that remembers.
///   FisherKPP (1937): logistic growth, with the parameter r
///     R = r u (1 - u)
///   FitzHughNagumo (1961, 1962), k a epsilon b; with b = 0 and w = 0 Nagumo's, of two stable values
///     R = k u (1 - u) (u - a) - w,        dw/dt = epsilon (b u - w)
///   MitchellSchaeffer (2003), tauIn tauOut tauOpen tauClose gate: potentials of heart muscle from 0 to 1
///     R = w u^2 (1 - u)/tauIn - u/tauOut, dw/dt = (1 - w)/tauOpen below u = gate, -w/tauClose above
// clang-format on
enum class Reaction { FisherKPP, FitzHughNagumo, MitchellSchaeffer };
constexpr std::array<std::string_view, 3> enum_names(Reaction) {
  return {"FisherKPP", "FitzHughNagumo", "MitchellSchaeffer"};
}
constexpr std::string_view parameter_names(Reaction reaction) {
  return reaction == Reaction::FisherKPP        ? "r"
         : reaction == Reaction::FitzHughNagumo ? "k a epsilon b"
                                                : "tauIn tauOut tauOpen tauClose gate";
}
constexpr bool takes_parameters(Reaction reaction, std::size_t count) {
  return count == (reaction == Reaction::FisherKPP ? 1u : reaction == Reaction::FitzHughNagumo ? 4u : 5u);
}
/// w where nothing has happened.
constexpr double recovery_at_rest(Reaction reaction) {
  return reaction == Reaction::MitchellSchaeffer ? 1 : 0;
}

/// A reaction with its parameters.
struct ReactionLaw {
  Reaction reaction = Reaction::FisherKPP;
  std::array<double, 5> p{};

  /// R, dR/du, and the integral of R over u from 0.
  struct Rate {
    double value, slope, integral;
  };
  Rate at(double u, double w) const {
    const double u2 = u * u, u3 = u2 * u, u4 = u2 * u2;
    switch (reaction) {
      case Reaction::FisherKPP:
        return {p[0] * (u - u2), p[0] * (1 - 2 * u), p[0] * (u2 / 2 - u3 / 3)};
      case Reaction::FitzHughNagumo: {
        const double k = p[0], a = p[1];
        return {k * (-u3 + (1 + a) * u2 - a * u) - w,
                k * (-3 * u2 + 2 * (1 + a) * u - a),
                k * (-u4 / 4 + (1 + a) * u3 / 3 - a * u2 / 2) - w * u};
      }
      case Reaction::MitchellSchaeffer:
        break;
    }
    const double in = w / p[0], out = 1 / p[1];
    return {in * (u2 - u3) - u * out, in * (2 * u - 3 * u2) - out, in * (u3 / 3 - u4 / 4) - u2 * out / 2};
  }
  /// w after a time with this u, exactly (Rush, Larsen 1978).
  double recovered(double u, double w, double dt) const {
    double end = 0, rate = 0;
    if (reaction == Reaction::FitzHughNagumo)
      end = p[3] * u, rate = p[2];
    else if (reaction == Reaction::MitchellSchaeffer)
      end = u < p[4] ? 1 : 0, rate = 1 / (u < p[4] ? p[2] : p[3]);
    return end + (w - end) * std::exp(-rate * dt);
  }
};

/// Throws Error unless the parameters are those of the reaction.
void check_reaction(std::string const& where, Reaction reaction, std::vector<double> const& p);

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/error.hpp>

namespace sinew {

SINEW_ONCE void check_reaction(std::string const& where, Reaction reaction, std::vector<double> const& p) {
  const std::string_view name = enum_names(reaction)[std::size_t(reaction)];
  if (!takes_parameters(reaction, p.size()))
    throw Error(
        where,
        text("ParameterSet has ", p.size(), " values, but ", name, " takes ", parameter_names(reaction)));
  // times and rates; a and b of FitzHughNagumo may be any
  for (std::size_t i = 0; i < p.size(); ++i) {
    const bool any = reaction == Reaction::FitzHughNagumo && i % 2 == 1;
    const bool mayVanish = reaction == Reaction::FitzHughNagumo && i == 2;
    if (any || p[i] > 0 || (mayVanish && p[i] == 0)) continue;
    throw Error(where,
                text("ParameterSet[",
                     i,
                     "] is ",
                     p[i],
                     ", but of ",
                     parameter_names(reaction),
                     " of ",
                     name,
                     " it must be greater than 0"));
  }
}

}  // namespace sinew
#endif
