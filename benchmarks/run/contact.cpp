// SPDX-License-Identifier: BSL-1.0
// Steps a second of a soft block that lies on a plane and slides there, its contacts solved by multipliers,
// by each constraint solver: contact NX NY NZ STEPS [profile]. The block has NX x NY points that touch, and
// NZ layers of them. Each line is a solver: its name, contacts, steps/s, iterations a step, and the residual
// of the friction problem of the last step [m], by the natural map with an estimate of W where W is not
// formed.
#include "bodies.hpp"

#include <sinew/scene/profile_report.hpp>
#include <sinew/scene/profiled.hpp>

#include <cstring>

using namespace bench;

namespace {

constexpr double edge = 0.05, density = 1000, contactDistance = 0.002;

struct Block {
  std::vector<Eigen::Vector3d> points{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<int> bottom{};
};
/// A lattice of cubes, six tetrahedra each (Kuhn 1960), that touches the plane z = 0 by its lowest points.
Block block_of(std::array<int, 3> n) {
  Block b;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        b.points.push_back(edge * Eigen::Vector3d(i, j, k) + Eigen::Vector3d(0, 0, contactDistance));
  auto number = [&](std::array<int, 3> at) { return at[0] + n[0] * (at[1] + n[1] * at[2]); };
  for (int k = 0; k + 1 < n[2]; ++k)
    for (int j = 0; j + 1 < n[1]; ++j)
      for (int i = 0; i + 1 < n[0]; ++i)
        for (auto const& order :
             {std::array{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}) {
          std::array<int, 3> at{i, j, k};
          std::array<int, 4> t{number(at), 0, 0, 0};
          for (std::size_t c = 0; c < 3; ++c) {
            ++at[std::size_t(order[c])];
            t[c + 1] = number(at);
          }
          const bool odd = (order[0] + 1) % 3 != order[1];
          b.tetrahedra.push_back(odd ? Tetrahedron{t[0], t[2], t[1], t[3]}
                                     : Tetrahedron{t[0], t[1], t[2], t[3]});
        }
  for (int i = 0; i < n[0] * n[1]; ++i) b.bottom.push_back(i);
  return b;
}

template <class Solver, class Linear>
auto scene(Block const& block, Solver solver, Linear linear) {
  MeshTopology floor;
  floor.triangles = {{0, 1, 2}, {0, 2, 3}};
  std::vector<Eigen::Vector3d> touching;
  for (const int i : block.bottom) touching.push_back(block.points[std::size_t(i)]);
  return node<"root">(
      FreeMotionAnimationLoop{},
      solver,
      Gravity{{0, 0, -9.81}},
      DefaultPipeline{},
      BruteForceBroadPhase{},
      BVHNarrowPhase{},
      MinProximityIntersection{.alarmDistance = 0.01, .contactDistance = contactDistance},
      DefaultContactManager{.response = "FrictionContactConstraint",
                            .responseParams = "mu=0.5",
                            .capacity = 2 * int(touching.size())},
      node<"floor">(
          floor,
          MechanicalObject<Vec3d>{.position = {{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}}},
          TriangleCollisionModel<Vec3d>{.moving = false, .simulated = false}),
      node<"block">(
          EulerImplicitSolver{.rayleighStiffness = 0.01, .rayleighMass = 0.01},
          linear,
          TetrahedronTopology{block.tetrahedra},
          MechanicalObject<Vec3d>{.position = block.points, .velocity = {{1, 0, 0}}},
          UniformMass<Vec3d>{.totalMass = density * edge * edge * edge * double(block.tetrahedra.size()) / 6},
          TetrahedronFEMForceField<Vec3d>{.youngModulus = {1e5}, .poissonRatio = 0.4},
          node<"skin">(MechanicalObject<Vec3d>{.position = touching},
                       SubsetMapping<Vec3d, Vec3d>{.indices = block.bottom},
                       PointCollisionModel<Vec3d>{})));
}

template <class Sim>
double residual_of(Sim& sim) {
  auto const& solver = sim.root().template first<role::ConstraintSolver>();
  if constexpr (requires { solver.preconditioner; })
    return solver.result.residual;
  else
    return sim.root().template first<role::AnimationLoop>().motion.problem.residual();
}
template <class Sim>
int iterations_of(Sim& sim) {
  auto const& result = sim.root().template first<role::ConstraintSolver>().result;
  if constexpr (requires { result.conjugateGradients; })
    return result.conjugateGradients;
  else
    return result.iterations;
}

template <class Scene>
void measure(char const* name, Scene root, int steps, bool profile) {
  constexpr double dt = 0.01;
  constexpr int settling = 20;  // until all points bear
  Simulation sim{root};
  sim.init();
  for (int i = 0; i < settling; ++i) sim.animate(dt);
  std::vector<double> seconds;
  long iterations = 0;
  double worst = 0;
  for (int i = 0; i < steps; ++i) {
    seconds.push_back(processor_seconds([&] { sim.animate(dt); }));
    iterations += iterations_of(sim);
    worst = std::max(worst, residual_of(sim));
  }
  std::sort(seconds.begin(), seconds.end());
  std::printf("%s %zu %.1f %.1f %.2e\n",
              name,
              sim.root().template get<DefaultContactManager>().contacts.size(),
              1 / seconds[seconds.size() / 2],
              double(iterations) / steps,
              worst);
  std::fflush(stdout);
  if (!profile) return;
  Simulation timed{profiled(root)};
  timed.init();
  for (int i = 0; i < settling + steps; ++i) timed.animate(dt);
  std::printf("%s\n", profile_table(timed.root().profile()).c_str());
}

}  // namespace

int main(int argc, char** argv) try {
  const bool profile = argc == 6 && std::strcmp(argv[5], "profile") == 0;
  if (argc != 5 && !profile) {
    std::fprintf(stderr, "usage: contact NX NY NZ STEPS [profile]\n");
    return 2;
  }
  const Block block = block_of({whole_number(argv[1]), whole_number(argv[2]), whole_number(argv[3])});
  const int steps = whole_number(argv[4]);
  std::printf("# %zu tetrahedra, %zu points\n", block.tetrahedra.size(), block.points.size());
  const CGLinearSolver<CompressedRowSparseMatrixMat3x3d> cg{.iterations = 200, .tolerance = 1e-8};
  measure("ConvexConstraintSolver", scene(block, ConvexConstraintSolver{}, cg), steps, profile);
  const SparseLDLSolver<> ldl{};
  measure("BlockGaussSeidelConstraintSolver",
          scene(block, BlockGaussSeidelConstraintSolver{.maxIterations = 10000, .tolerance = 1e-7}, ldl),
          steps,
          profile);
  measure("NNCGConstraintSolver",
          scene(block, NNCGConstraintSolver{.maxIterations = 10000, .tolerance = 1e-7}, ldl),
          steps,
          profile);
  return 0;
} catch (Error const& error) {
  std::fprintf(stderr, "contact: %s\n", error.what());
  return 1;
}
