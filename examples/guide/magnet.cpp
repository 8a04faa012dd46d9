// SPDX-License-Identifier: BSL-1.0
// A force field of one's own in a scene file: a ball goes round a magnet.
#include <sinew/mechanics.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>

#include <cmath>
#include <cstdio>

using namespace sinew;

/// Draws points to a place.   f = -s r / |r|^3 [N],  r = x - c,   E = -s / |r| [J]
///   df/dx = -s (I / |r|^3 - 3 r r' / |r|^5)
struct Magnet {
  using Role = role::ForceField;
  using DataTypes = Vec3d;
  static constexpr std::string_view className = "Magnet";

  Vec<double, 3> centre{0, 0, 0};
  double strength = 1;

  static constexpr auto fields() {
    return field_list(
        field("centre", &Magnet::centre, "m", "where the magnet is"),
        field("strength", &Magnet::strength, "N m^2", "force at a distance of 1 m", range::nonNegative));
  }

  void init(InitContext<Vec3d> const&) {}
  void addForce(MechanicalParams const&, Vec3d::VecDeriv& f, Vec3d::VecCoord const& x,
                Vec3d::VecDeriv const&) {
    distance.resize(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      distance[i] = x[i] - centre;
      f[i] -= strength / std::pow(distance[i].norm(), 3) * distance[i];
    }
  }
  void addDForce(MechanicalParams const& p, Vec3d::VecDeriv& df, Vec3d::VecDeriv const& dx) const {
    for (std::size_t i = 0; i < dx.size(); ++i) {
      auto const& r = distance[i];
      const double r2 = r.squaredNorm();
      df[i] -= p.k * strength / (r2 * std::sqrt(r2)) * (dx[i] - 3 * r.dot(dx[i]) / r2 * r);
    }
  }
  double potentialEnergy(Vec3d::VecCoord const& x) const {
    double energy = 0;
    for (auto const& p : x) energy -= strength / (p - centre).norm();
    return energy;
  }

  Vec3d::VecDeriv distance{};  // from the magnet, at the last addForce
};

/// What the scene file may have.
struct Classes : Registry<Gravity, RungeKutta4Solver, MechanicalObject<Vec3d>, UniformMass<Vec3d>, Magnet> {};

int main() try {
  auto scene = parse_scene<Classes>("magnet.scn", R"(
    <Node name="root" gravity="0 0 0" dt="0.01">
      <RungeKutta4Solver/>
      <MechanicalObject position="1 0 0" velocity="0 1 0"/>
      <UniformMass vertexMass="1"/>
      <Magnet strength="1"/>
    </Node>)");
  const double dt = scene.dt;
  auto sim = start(std::move(scene));
  for (int step = 0; step < 314; ++step) sim.animate(dt);
  auto const& p = sim.root().get<MechanicalObject<Vec3d>>()->position[0];
  std::printf("after half a turn at (%.3f, %.3f)\n", p.x(), p.y());
} catch (Error const& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
