// SPDX-License-Identifier: BSL-1.0
// A soft block that slides down a slope steeper than the angle of friction, its contacts solved by
// multipliers:
//   contact_block NX NY NZ PX PY STEPS SOLVER [TOLERANCE ...]
// NX x NY x NZ cells of six tetrahedra each; PX x PY points of its skin touch. SOLVER: convex, sweeps or
// nncg. A line for each tolerance, by measure() in contact.hpp.
#include "contact.hpp"

using namespace bench;

namespace {

constexpr double edge = 0.05, density = 1000, skin = 0.002, dt = 0.01;

template <class Solver, class Linear>
auto scene(std::array<int, 3> n, std::array<int, 2> points, Solver solver, Linear linear) {
  const Eigen::Vector3d low(0, 0, skin), high = low + edge * Eigen::Vector3d(n[0], n[1], n[2]);
  const Mesh mesh = regular_grid_tetrahedra(n[0] + 1, n[1] + 1, n[2] + 1, low, high);
  std::vector<Eigen::Vector3d> touching;
  for (int j = 0; j < points[1]; ++j)
    for (int i = 0; i < points[0]; ++i)
      touching.push_back({high[0] * i / (points[0] - 1), high[1] * j / (points[1] - 1), skin});
  return profiled(node<"root">(
      FreeMotionAnimationLoop{},
      solver,
      Gravity{{6, 0, -9.81}},  // 31 degrees
      DefaultPipeline{},
      BruteForceBroadPhase{},
      BVHNarrowPhase{},
      MinProximityIntersection{.alarmDistance = 0.01, .contactDistance = skin},
      contact_manager(2 * int(touching.size())),
      wide_floor(),
      node<"block">(
          EulerImplicitSolver{.rayleighStiffness = 0.01, .rayleighMass = 0.01},
          linear,
          TetrahedronTopology{mesh.tetrahedra},
          MechanicalObject<Vec3d>{.position = mesh.positions, .velocity = {{0.5, 0, 0}}},
          UniformMass<Vec3d>{.totalMass = density * edge * edge * edge * double(n[0] * n[1] * n[2])},
          TetrahedronFEMForceField<Vec3d>{.youngModulus = {1e5}, .poissonRatio = 0.4},
          node<"skin">(MechanicalObject<Vec3d>{.position = touching},
                       BarycentricMapping<Vec3d, Vec3d>{},
                       PointCollisionModel<Vec3d>{}))));
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 8) {
    std::fprintf(stderr, "usage: contact_block NX NY NZ PX PY STEPS convex|sweeps|nncg [TOLERANCE ...]\n");
    return 2;
  }
  const std::array n{whole_number(argv[1]), whole_number(argv[2]), whole_number(argv[3])};
  const std::array points{whole_number(argv[4]), whole_number(argv[5])};
  with_solver(argv[7], [&](auto solver, auto linear, auto matrixOf) {
    Simulation sim{scene(n, points, solver, linear)};
    sim.init();
    for (int i = 0; i < 20; ++i) sim.animate(dt);  // until all points bear
    measure(sim, tolerances_of(argc, argv, 8), dt, whole_number(argv[6]), [&](auto& s) {
      return std::vector{matrixOf(s.template at<"block">().template get<decltype(linear)>())};
    });
  });
  return 0;
} catch (Error const& error) {
  std::fprintf(stderr, "contact_block: %s\n", error.what());
  return 1;
}
