// SPDX-License-Identifier: BSL-1.0
// A mapping of one's own: a lever is one angle, and its tip a point on which forces act as on any other.
#include <sinew/mechanics.hpp>

#include <cmath>
#include <cstdio>

using namespace sinew;

/// The tip of a lever that turns about the origin.   y = l (cos q, sin q, 0),   J = l (-sin q, cos q, 0)
struct LeverMapping {
  using Role = role::Mapping;
  using In = Vec1d;
  using Out = Vec3d;
  static constexpr std::string_view className = "LeverMapping";

  double length = 1;

  static constexpr auto fields() {
    return field_list(
        field("length", &LeverMapping::length, "m", "from the axis to the tip", range::positive));
  }

  void init(InitContext<Vec1d> const& parent, InitContext<Vec3d> const&, Vec3d::VecCoord& tips) {
    tips.resize(parent.rest.size());
  }
  void apply(Vec3d::VecCoord& tips, Vec1d::VecCoord const& angles) {
    rates.resize(angles.size());
    for (std::size_t i = 0; i < angles.size(); ++i) {
      const double c = length * std::cos(angles[i][0]), s = length * std::sin(angles[i][0]);
      tips[i] = {c, s, 0};
      rates[i] = {-s, c, 0};
    }
  }
  void applyJ(Vec3d::VecDeriv& out, Vec1d::VecDeriv const& in) const {
    for (std::size_t i = 0; i < in.size(); ++i) out[i] = rates[i] * in[i][0];
  }
  void applyJT(Vec1d::VecDeriv& in, Vec3d::VecDeriv const& out) const {
    for (std::size_t i = 0; i < out.size(); ++i) in[i][0] += rates[i].dot(out[i]);
  }

  Vec3d::VecDeriv rates{};  // the column of J of each lever, at the last apply
};

int main() {
  // a wheel of 0.02 kg m^2 whose tip, 0.2 m from the axis, is pulled down by 3 N
  const double inertia = 0.02, length = 0.2, pull = 3;
  Simulation sim{
      node<"wheel">(RungeKutta4Solver{},
                    MechanicalObject<Vec1d>{.position = {Vec1d::Coord(0.1 - std::acos(0.))}},
                    UniformMass<Vec1d>{.vertexMass = inertia},
                    node<"tip">(MechanicalObject<Vec3d>{},
                                LeverMapping{.length = length},
                                ConstantForceField<Vec3d>{.indices = {0}, .force = {{0, -pull, 0}}}))};
  sim.init();
  // it swings like a pendulum: small swings take 2 pi sqrt(I / (l F)), those of 0.1 rad 1 + 0.1^2 / 16 times
  // as long
  const double period = 2 * std::acos(-1.) * std::sqrt(inertia / (length * pull)) * (1 + 0.01 / 16);
  double before = 0, crossed = 0;
  for (int half = 0; half < 3;) {
    before = sim.root().state().position[0][0] + std::acos(0.);
    sim.animate(1e-4);
    const double now = sim.root().state().position[0][0] + std::acos(0.);
    if (before * now > 0) continue;
    if (half++ == 0) crossed = sim.time();
  }
  std::printf("swings in %.4f s; expected %.4f s\n", sim.time() - crossed, period);
}
