// SPDX-License-Identifier: BSL-1.0
// A force field of one's own: the drag of air, with which what falls comes to a speed at which it stays.
#include <sinew/mechanics.hpp>

#include <cmath>
#include <cstdio>

using namespace sinew;

/// The drag of what is fast in a fluid.   f = -c |v| v [N],   df/dv = -c (|v| I + v v' / |v|)
struct Drag {
  using Role = role::ForceField;
  using DataTypes = Vec3d;
  static constexpr std::string_view className = "Drag";

  double coefficient = 0.1;

  static constexpr auto fields() {
    return field_list(field("coefficient", &Drag::coefficient, "kg/m", "of each point", range::nonNegative));
  }

  void init(InitContext<Vec3d> const&) {}
  void addForce(MechanicalParams const&, Vec3d::VecDeriv& f, Vec3d::VecCoord const&,
                Vec3d::VecDeriv const& v) {
    velocity = v;
    for (std::size_t i = 0; i < v.size(); ++i) f[i] -= coefficient * v[i].norm() * v[i];
  }
  // p.k of the derivative by positions, of which there is none, and p.b of that by velocities
  void addDForce(MechanicalParams const& p, Vec3d::VecDeriv& df, Vec3d::VecDeriv const& dx) const {
    for (std::size_t i = 0; i < dx.size(); ++i) {
      auto const& v = velocity[i];
      const double speed = v.norm();
      if (speed > 0) df[i] -= p.b * coefficient * (speed * dx[i] + v.dot(dx[i]) / speed * v);
    }
  }
  double potentialEnergy(Vec3d::VecCoord const&) const { return 0; }

  Vec3d::VecDeriv velocity{};  // at the last addForce
};

int main() {
  Simulation sim{node<"root">(Gravity{{0, -9.81, 0}},
                              EulerImplicitSolver{},
                              CGLinearSolver<>{.iterations = 20, .tolerance = 1e-12},
                              MechanicalObject<Vec3d>{.position = {{0, 1000, 0}}},
                              UniformMass<Vec3d>{.vertexMass = 80},
                              Drag{.coefficient = 0.25})};
  sim.init();
  while (sim.time() < 60) sim.animate(0.01);
  std::printf("falls at %.3f m/s; sqrt(m g / c) = %.3f m/s\n",
              -sim.root().state().velocity[0].y(),
              std::sqrt(80 * 9.81 / 0.25));
}
