// SPDX-License-Identifier: BSL-1.0
// A heap of rigid boxes, its contacts solved by multipliers, or by Bullet:
//   contact_pile BOXES STEPS convex|sweeps|unbuilt [TOLERANCE ...]
//   contact_pile BOXES STEPS bullet [ITERATIONS ...]
// Bullet lets loose layers of boxes fall; what lies there is where all begin. A line for each tolerance or
// number of iterations, by measure() in contact.hpp.
#include "contact_pile.hpp"

#include "contact.hpp"

#include <sinew/collision/convex_collision_model.hpp>

#include <random>

using namespace bench;

namespace {

constexpr double skin = 0.01;  // hulls are that far apart where they touch, and that much smaller than cubes
constexpr double apart = 1.005;  // the heap is spread, out of what Bullet lets overlap, and lies down again

/// Layers of n x n boxes, each turned and shifted a little, 2 s after they were let go.
std::vector<BoxAt> heap(int count) {
  std::mt19937 random(7);
  auto number = [&] { return double(random()) / double(std::mt19937::max()) - 0.5; };
  const int n = std::max(2, int(std::cbrt(2.0 * count)));
  std::vector<BoxAt> boxes;
  for (int i = 0; i < count; ++i) {
    const double x = i % n, y = i / n % n, z = i / (n * n);
    const Eigen::Quaterniond q(Eigen::AngleAxisd(0.5 * number(), Eigen::Vector3d::UnitZ()));
    boxes.push_back({{1.4 * x + 0.3 * number(), 1.4 * y + 0.3 * number(), 0.52 + 1.05 * z},
                     {q.x(), q.y(), q.z(), q.w()}});
  }
  const BulletPile pile = bullet_pile(boxes);
  for (int i = 0; i < 200; ++i) pile.step(20);
  return pile.boxes();
}

template <class Solver>
auto scene(std::vector<BoxAt> const& boxes, Solver solver) {
  MechanicalObject<Rigid3d> state;
  for (BoxAt const& b : boxes)
    state.position.push_back({apart * Eigen::Vector3d(b.center[0], b.center[1], b.center[2] + skin / 2),
                              Eigen::Quaterniond(b.turn[3], b.turn[0], b.turn[1], b.turn[2])});
  std::vector<Eigen::Vector3d> corners;
  const double half = 0.5 - skin / 2;
  for (int k = 0; k < 8; ++k)
    corners.push_back({k & 1 ? half : -half, k & 2 ? half : -half, k & 4 ? half : -half});
  return profiled(node<"root">(
      FreeMotionAnimationLoop{},
      solver,
      Gravity{{0, 0, -9.81}},
      DefaultPipeline{},
      BruteForceBroadPhase{},
      BVHNarrowPhase{},
      MinProximityIntersection{.alarmDistance = 0.05, .contactDistance = skin},
      contact_manager(12 * int(boxes.size())),
      wide_floor(),
      node<"boxes">(
          EulerExplicitSolver{},
          state,
          UniformMass<Rigid3d>{.vertexMass = RigidMass<double, 3>{1, Eigen::Matrix3d::Identity() / 6}},
          ConvexCollisionModel<Rigid3d>{.selfCollision = true, .points = corners})));
}

/// The masses of cubes, which do not turn.
Matrix masses(int boxes) {
  Matrix M;
  M.startPattern(6 * boxes);
  M.finishPattern();
  for (int i = 0; i < 2 * boxes; ++i)
    M.add(3 * i, 3 * i, Eigen::Matrix3d(Eigen::Matrix3d::Identity() / (i % 2 ? 6 : 1)));
  return M;
}

template <class Solver>
void sinew_pile(std::vector<BoxAt> const& boxes, int steps, Solver solver,
                std::vector<double> const& tolerances) {
  Simulation sim{scene(boxes, solver)};
  sim.init();
  Matrix M = masses(int(boxes.size()));
  sim.root().template first<role::ConstraintSolver>().tolerance = 1e-3;
  for (int i = 0; i < 60; ++i) sim.animate(pileStep);
  measure(sim, tolerances, pileStep, steps, [&](auto&) { return std::vector{&M}; });
}

void pile_by_bullet(std::vector<BoxAt> const& boxes, int steps, std::vector<double> const& iterations) {
  const BulletPile pile = bullet_pile(boxes);
  for (int i = 0; i < 60; ++i) pile.step(20);
  for (const double count : iterations) {
    std::vector<double> seconds;
    Quality worst;
    double contacts = 0;
    for (int i = 0; i < steps; ++i) {
      seconds.push_back(processor_seconds([&] { pile.step(int(count)); }));
      std::vector<SolvedContact> solved;
      for (ContactOfStep const& c : pile.contacts())
        solved.push_back({Eigen::Vector3d(c.f.data()), Eigen::Vector3d(c.d.data()), c.w, pileFriction});
      contacts += double(solved.size());
      worst.add(solved);
    }
    print_line("Bullet", 0, contacts / steps, 1 / median(seconds), count, worst, 0);
  }
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string_view by = argc > 3 ? argv[3] : "";
  const std::vector<double> numbers = tolerances_of(argc, argv, 4);
  if (by == "bullet")
    pile_by_bullet(heap(whole_number(argv[1])), whole_number(argv[2]), argc > 4 ? numbers : std::vector{10.});
  else if (by == "convex")
    sinew_pile(heap(whole_number(argv[1])), whole_number(argv[2]), ConvexConstraintSolver{}, numbers);
  else if (by == "sweeps")
    sinew_pile(heap(whole_number(argv[1])), whole_number(argv[2]), gauss_seidel(), numbers);
  else if (by == "unbuilt")
    sinew_pile(
        heap(whole_number(argv[1])),
        whole_number(argv[2]),
        UnbuiltGaussSeidelConstraintSolver{.maxIterations = 20000, .tolerance = 1e-6, .allVerified = true},
        numbers);
  else {
    std::fprintf(stderr,
                 "usage: contact_pile BOXES STEPS convex|sweeps|unbuilt [TOLERANCE ...]\n"
                 "       contact_pile BOXES STEPS bullet [ITERATIONS ...]\n");
    return 2;
  }
  return 0;
} catch (Error const& error) {
  std::fprintf(stderr, "contact_pile: %s\n", error.what());
  return 1;
}
