// SPDX-License-Identifier: BSL-1.0
// Steps a second on a GPU of a soft block that lies on a plane and slides there, its contacts solved by
// multipliers (ConvexConstraintSolver):
//   contact NX NY NZ [--given] [--double] [--steps N] [--tolerance METRES] [--linear RELATIVE] [--mu
//   FRICTION]
//           [--profile] [--host] [--fused] [--copies N]
// The block has NX x NY points that touch, and NZ layers of them: 32 32 6 are 1,024 contacts and 28,830
// tetrahedra. They are found in each step, between all points of the block and a floor of 3,200 triangles;
// with --given they are a list of points above a plane (UnilateralLagrangianConstraint). With --mu 0 the
// block slides on at 1 m/s. --linear is the
// tolerance of the linear solver in the free motion: what that leaves is solved with the contacts. Prints
// tetrahedra; points; contacts; real; steps a second, the median; of each step the updates of the potentials,
// iterations of Newton's method and of conjugate gradients, and looks of the line search; the largest
// residuals, of the constraints [m] and of the momentum; steps that were not solved; and how far the sum of
// the normal forces is from the weight, relative. --profile prints how long the host was in each part of a
// step (work of the GPU counts where the host waits for it); --host how far points are from where the
// processor has them after the first 20 steps. With --fused all steps are one launch (FusedSimulation), which
// says how many steps were not solved and no more of them; --copies of the block may be made by it.
#include <sinew/gpu/gpu.hpp>

#include <sinew/gpu/fused/simulation.hpp>

#include <sinew/contact.hpp>
#include <sinew/context/gravity.hpp>
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/lagrangian.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/profile_report.hpp>
#include <sinew/scene/profiled.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/mesh_topology.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

using namespace sinew;

namespace {

constexpr double dt = 0.01, edge = 0.05, density = 1000;
constexpr int settling = 20;     // until all points bear
constexpr double apart = 0.005;  // from the floor

struct Options {
  std::array<int, 3> n{};
  int steps = 200;
  double tolerance = 1e-6, linear = 1e-2, mu = 0.5;
  int copies = 1;
  bool inDouble = false, profile = false, host = false, given = false, fused = false;
};

int whole_number(std::string const& text) {
  char* end = nullptr;
  const long value = std::strtol(text.c_str(), &end, 10);
  if (end == text.c_str() || *end || value < 1 || value > 1000000)
    throw Error("arguments", sinew::text("'", text, "' is not a whole number of at least 1"));
  return int(value);
}

Mesh mesh_of(Options const& o) {
  const auto [nx, ny, nz] = o.n;
  return regular_grid_tetrahedra(nx, ny, nz, {0, 0, 0}, edge * Eigen::Vector3d(nx - 1, ny - 1, nz - 1));
}
double volume_of(Options const& o) {
  const auto [nx, ny, nz] = o.n;
  return edge * edge * edge * (nx - 1) * (ny - 1) * (nz - 1);
}

// the block, with more components
using Assembled = CGLinearSolver<CompressedRowSparseMatrixMat3x3d>;
template <class D, class Linear = Assembled, class... More>
auto block(Options const& o, Mesh const& mesh, More... more) {
  return node<"block">(EulerImplicitSolver{.rayleighStiffness = 0.01, .rayleighMass = 0.01},
                       Linear{.iterations = 200, .tolerance = o.linear},
                       MeshTopology{.position = mesh.positions, .tetrahedra = mesh.tetrahedra},
                       MechanicalObject<D>{.velocity = {{1, 0, 0}}},
                       UniformMass<D>{.totalMass = density * volume_of(o)},
                       TetrahedronFEMForceField<D>{.youngModulus = {1e5}, .poissonRatio = 0.4},
                       more...);
}

template <class D>
auto scene_given(Options const& o) {
  const Mesh mesh = mesh_of(o);
  std::vector<int> bottom;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (mesh.positions[i][2] < 1e-9) bottom.push_back(int(i));
  return node<"root">(FreeMotionAnimationLoop{},
                      ConvexConstraintSolver{.tolerance = o.tolerance},
                      Gravity{{0, 0, -9.81}},
                      UnilateralLagrangianConstraint<D, Between<"ground", "block">>{
                          .first_point = std::vector<int>(bottom.size(), 0),
                          .second_point = bottom,
                          .normal = {{0, 0, 1}},
                          .mu = {o.mu}},
                      node<"ground">(MechanicalObject<D>{.position = {{0, 0, 0}}}),
                      block<D>(o, mesh));
}
template <class D, class Linear = Assembled>
auto scene_found(Options const& o) {
  constexpr int cells = 40;
  MeshTopology floor;
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i) floor.position.push_back({0.25 * i - 4, 0.25 * j - 4, -apart});
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const int p = j * (cells + 1) + i, q = p + cells + 1;
      floor.triangles.push_back({p, p + 1, q + 1});
      floor.triangles.push_back({p, q + 1, q});
    }
  return node<"root">(FreeMotionAnimationLoop{},
                      ConvexConstraintSolver{.tolerance = o.tolerance},
                      Gravity{{0, 0, -9.81}},
                      DefaultPipeline{},
                      BruteForceBroadPhase{},
                      BVHNarrowPhase{},
                      MinProximityIntersection{.alarmDistance = 2 * apart, .contactDistance = apart},
                      DefaultContactManager{.response = "FrictionContactConstraint",
                                            .responseParams = "mu=" + std::to_string(o.mu),
                                            .capacity = 2000},
                      node<"floor">(floor,
                                    MechanicalObject<Vec3d>{},
                                    TriangleCollisionModel<Vec3d>{.moving = false, .simulated = false}),
                      block<D, Linear>(o, mesh_of(o), PointCollisionModel<D>{}));
}

// of a scene: how many contacts, and the sum of their normal forces
struct Given {
  template <class D>
  static auto scene(Options const& o) {
    return scene_given<D>(o);
  }
  template <class Sim>
  static std::pair<std::size_t, double> contacts(Sim& sim) {
    auto const& c = sim.root().template first<role::LagrangianConstraint>();
    double normal = 0;
    for (std::size_t i = 0; i < c.multipliers.size(); i += 3) normal += c.multipliers[i];
    return {c.first_point.size(), normal};
  }
};
struct Found {
  template <class D>
  static auto scene(Options const& o) {
    return scene_found<D>(o);
  }
  template <class Sim>
  static std::pair<std::size_t, double> contacts(Sim& sim) {
    auto const& all = sim.root().template first<role::ContactManager>().contacts;
    double normal = 0;
    for (Contact const& c : all) normal += std::abs(c.normal.dot(c.force));
    return {all.size(), normal};
  }
};

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

template <class H, class Scene>
void measure(Options const& o) {
  using D = CudaTypes<H>;
  Simulation sim{Scene::template scene<D>(o)};
  sim.init();
  auto const& solver = sim.root().template first<role::ConstraintSolver>();
  auto& block = sim.template at<"block">();
  for (int i = 0; i < settling; ++i) sim.animate(dt);
  auto const& x = std::as_const(block.state().position);
  if (o.host) {
    Options tight = o;
    tight.linear = 1e-8;  // the processor solves the free motion by itself
    Simulation reference{Scene::template scene<H>(tight)};
    reference.init();
    for (int i = 0; i < settling; ++i) reference.animate(dt);
    auto const& y = reference.template at<"block">().state().position;
    double far = 0;
    for (std::size_t i = 0; i < y.size(); ++i)
      for (int c = 0; c < 3; ++c) far = std::max(far, std::abs(double(x[i][c]) - double(y[i][c])));
    std::printf("# %.2e m from the processor after %d steps\n", far, settling);
  }
  std::vector<double> seconds;
  double updates = 0, newton = 0, cg = 0, looks = 0, residual = 0, momentum = 0;
  int unsolved = 0;
  for (int i = 0; i < o.steps; ++i) {
    gpu::wait();
    const double begin = now();
    sim.animate(dt);
    gpu::wait();
    seconds.push_back(now() - begin);
    ConvexStepResult const& r = solver.result;
    updates += r.updates;
    newton += r.newtonIterations;
    cg += r.conjugateGradients;
    looks += r.lineSearches;
    residual = std::max(residual, r.residual);
    momentum = std::max(momentum, r.momentum);
    unsolved += !r.converged;
  }
  std::sort(seconds.begin(), seconds.end());
  const auto [count, normal] = Scene::contacts(sim);
  const double weight = 9.81 * density * volume_of(o), n = o.steps;
  std::printf(
      "%zu; %zu; %zu; %s; %.1f; %.1f updates, %.1f Newton, %.1f conjugate gradients, %.1f looks; %.1e m, "
      "%.1e; %d unsolved; forces %.1e\n",
      block.template first<role::ForceField>().driver.size(),
      x.size(),
      count,
      sizeof(typename H::Real) == 8 ? "double" : "float",
      1 / seconds[seconds.size() / 2],
      updates / n,
      newton / n,
      cg / n,
      looks / n,
      residual,
      momentum,
      unsolved,
      std::abs(normal / weight - 1));
  std::fflush(stdout);
  if (!o.profile) return;
  Simulation timed{profiled(Scene::template scene<D>(o))};
  timed.init();
  for (int i = 0; i < settling + o.steps; ++i) timed.animate(dt);
  std::printf("%s\n", profile_table(timed.root().profile()).c_str());
}

template <class H>
void measure_fused(Options const& o) {
  using D = CudaTypes<H>;
  Simulation sim{scene_found<D, CGLinearSolver<>>(o)};
  sim.init();
  gpu::FusedSimulation fused(sim, o.copies);
  fused.animate(dt, settling);
  fused.finish();
  if (o.host) {
    Options tight = o;
    tight.linear = 1e-8;
    Simulation reference{scene_found<H>(tight)};
    reference.init();
    for (int i = 0; i < settling; ++i) reference.animate(dt);
    fused.store(0, sim);
    auto const& x = std::as_const(sim.template at<"block">().state()).position;
    auto const& y = reference.template at<"block">().state().position;
    double far = 0;
    for (std::size_t i = 0; i < y.size(); ++i)
      for (int c = 0; c < 3; ++c) far = std::max(far, std::abs(double(x[i][c]) - double(y[i][c])));
    std::printf("# %.2e m from the processor after %d steps\n", far, settling);
  }
  gpu::wait();
  const double begin = now();
  fused.animate(dt, o.steps);
  gpu::wait();
  const double seconds = now() - begin;
  fused.finish();
  double normal = 0;
  const auto contacts = fused.contacts(0);
  for (auto const& [node, c] : contacts) normal += std::abs(c.normal.dot(c.force));
  auto& block = sim.template at<"block">();
  std::printf("%zu; %zu; %zu; %s; %.1f; fused, %d copies by %d blocks each; %d unsolved; forces %.1e\n",
              block.template first<role::ForceField>().driver.size(),
              block.state().size(),
              contacts.size(),
              sizeof(typename H::Real) == 8 ? "double" : "float",
              o.copies * o.steps / seconds,
              o.copies,
              fused.shape().blocks,
              fused.unsolved(0),
              std::abs(normal / (9.81 * density * volume_of(o)) - 1));
}

Options options(int argc, char** argv) {
  Options o;
  std::size_t given = 0;
  for (int i = 1; i < argc; ++i) {
    const std::string a = argv[i];
    auto next = [&]() -> std::string {
      if (++i == argc) throw Error("arguments", text(a, " needs a number behind it"));
      return argv[i];
    };
    if (a == "--double")
      o.inDouble = true;
    else if (a == "--profile")
      o.profile = true;
    else if (a == "--host")
      o.host = true;
    else if (a == "--given")
      o.given = true;
    else if (a == "--fused")
      o.fused = true;
    else if (a == "--copies")
      o.copies = whole_number(next());
    else if (a == "--steps")
      o.steps = whole_number(next());
    else if (a == "--tolerance")
      o.tolerance = std::strtod(next().c_str(), nullptr);
    else if (a == "--mu")
      o.mu = std::strtod(next().c_str(), nullptr);
    else if (a == "--linear")
      o.linear = std::strtod(next().c_str(), nullptr);
    else if (given < 3)
      o.n[given++] = std::max(2, whole_number(a));
    else
      throw Error("arguments", text("'", a, "' is not known"));
  }
  if (given < 3)
    throw Error("arguments",
                "contact NX NY NZ [--given] [--double] [--steps N] [--tolerance METRES] [--linear RELATIVE] "
                "[--mu FRICTION] "
                "[--profile] [--host] [--fused] [--copies N]");
  if (o.fused && o.given) throw Error("arguments", "--fused finds its contacts; leave --given out");
  return o;
}

}  // namespace

int main(int argc, char** argv) try {
  const Options o = options(argc, argv);
  if (o.fused)
    o.inDouble ? measure_fused<Vec3d>(o) : measure_fused<Vec3f>(o);
  else if (o.inDouble)
    o.given ? measure<Vec3d, Given>(o) : measure<Vec3d, Found>(o);
  else
    o.given ? measure<Vec3f, Given>(o) : measure<Vec3f, Found>(o);
  return 0;
} catch (Error const& error) {
  std::fprintf(stderr, "contact: %s\n", error.what());
  return 1;
}
