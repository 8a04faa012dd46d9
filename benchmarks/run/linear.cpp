// SPDX-License-Identifier: BSL-1.0
// Seconds to |b - A x| = 1e-6 |b| over one assembled matrix by multigrid and, where they are installed, by
// CHOLMOD, hypre, PETSc and MueLu: linear CELLS ROUNDS KIND, of a cube of CELLS^3 cells of six tetrahedra, or
// of a mesh file in the place of CELLS; KIND is plain, incompressible (Poisson's ratio 0.49) or contrast
// (layers 10,000 times as stiff); DEGREE is that of the smoother. They take turns. Prints the size, then a
// line a solver: name, seconds of the set-up, of the solution, iterations, residual; and steps a second with
// multigrid made anew in each step, and in each tenth.
#include "bodies.hpp"
#include "linear_system.hpp"

#include <sinew/io/mesh_file.hpp>
#include <sinew/solver/multigrid_linear_solver.hpp>

#include <functional>
#include <string>

using namespace bench;

namespace {

struct Kind {
  std::string_view name;
  double poisson;
  int degree, cycles;  // of the smoother; of a coarse level
};
constexpr Kind kinds[] = {{"plain", 0.3, 2, 1}, {"incompressible", 0.49, 6, 2}, {"contrast", 0.3, 2, 1}};

auto scene(Mesh const& mesh, Kind const& kind, int refresh) {
  std::vector<double> young(mesh.tetrahedra.size(), 3000);
  if (kind.name == "contrast")
    for (std::size_t t = 0; t < young.size(); ++t)
      if (int(4 * mesh.positions[std::size_t(mesh.tetrahedra[t][0])][1]) % 2 == 0) young[t] *= 1e4;
  return solved_body<Vec3d>(mesh,
                            corotational<Vec3d>(young, kind.poisson),
                            damped_euler(),
                            MultigridLinearSolver<>{.iterations = 1000,
                                                    .refresh = refresh,
                                                    .warp = refresh > 1,
                                                    .smootherDegree = kind.degree,
                                                    .coarseCycles = kind.cycles});
}

LinearSystem system_of(CompressedRowSparseMatrixMat3x3d const& a, Eigen::VectorXd const& b,
                       Vec3d::VecCoord const& places) {
  LinearSystem s{.unknowns = a.dofs(), .starts = {0}};
  for (int dof = 0; dof < a.dofs(); ++dof) {
    a.forEachInRow(dof / 3, [&](int column, int slot, bool transposed) {
      for (int c = 0; c < 3; ++c) {
        s.columns.push_back(3 * column + c);
        s.values.push_back(a.block(slot)[transposed ? 3 * c + dof % 3 : dof % 3 * 3 + c]);
      }
    });
    s.starts.push_back(int(s.columns.size()));
    s.rhs.push_back(b[dof]);
    s.places.push_back(places[std::size_t(dof / 3)][dof % 3]);
  }
  return s;
}

double residual(LinearSystem const& s, std::vector<double> const& x) {
  double sum = 0, whole = 0;
  for (std::size_t i = 0; i < s.rhs.size(); ++i) {
    double r = s.rhs[i];
    for (int k = s.starts[i]; k < s.starts[i + 1]; ++k)
      r -= s.values[std::size_t(k)] * x[std::size_t(s.columns[std::size_t(k)])];
    sum += r * r;
    whole += s.rhs[i] * s.rhs[i];
  }
  return std::sqrt(sum / whole);
}

void run(Mesh const& mesh, Kind const& kind, int rounds) {
  auto sim = scene(mesh, kind, 1);
  sim.init();
  for (int i = 0; i < 2; ++i) sim.animate(0.02);
  auto& solver = sim.root().first<role::LinearSolver>();
  const LinearSystem system = system_of(solver.matrix, solver.b, sim.root().state().position);
  std::printf("%zu %zu\n", mesh.positions.size(), mesh.tetrahedra.size());

  struct Choice {
    char const* name;
    std::function<LinearResult()> solve;
    std::vector<double> setUp{}, time{};
    LinearResult last{};
  };
  const auto again = [&] {
    LinearResult result{.iterations = int(solver.residuals.size()) - 1};
    result.solve = processor_seconds([&] { solver.solveSystem(SomeWorkers{}); });
    result.iterations = int(solver.residuals.size()) - 1;
    result.x.assign(solver.x.data(), solver.x.data() + system.unknowns);
    return result;
  };
  auto made = [&](bool anew) {
    if (anew) solver.multigrid.reset();
    const double setUp = processor_seconds([&] { solver.multigrid.update(SomeWorkers{}, solver.matrix); });
    LinearResult result = again();
    result.setUp = setUp;
    return result;
  };
  std::vector<Choice> choices;
  choices.push_back({"sinew", [&] { return made(true); }});
  choices.push_back({"sinew-pattern-kept", [&] { return made(false); }});
#ifdef BENCH_CHOLMOD
  if (system.unknowns < 200000) choices.push_back({"cholmod", [&] { return solve_by_cholmod(system); }});
#endif
#ifdef BENCH_HYPRE
  choices.push_back({"hypre", [&] { return solve_by_hypre(system, false); }});
  choices.push_back({"hypre-nodal", [&] { return solve_by_hypre(system, true); }});
#endif
#ifdef BENCH_PETSC
  choices.push_back({"petsc", [&] { return solve_by_petsc(system, "gamg"); }});
  choices.push_back({"ml", [&] { return solve_by_petsc(system, "ml"); }});
#endif
#ifdef BENCH_MUELU
  choices.push_back({"muelu", [&] { return solve_by_muelu(system); }});
#endif
  for (int r = 0; r < rounds; ++r)
    for (Choice& c : choices) {
      c.last = c.solve();
      c.setUp.push_back(c.last.setUp);
      c.time.push_back(c.last.solve);
    }
  for (Choice const& c : choices)
    std::printf("%s %.6g %.6g %d %.2e\n",
                c.name,
                median(c.setUp),
                median(c.time),
                c.last.iterations,
                residual(system, c.last.x));
  for (const int refresh : {1, 10}) {
    auto steps = scene(mesh, kind, refresh);
    steps.init();
    steps.animate(0.02);
    int iterations = 0;
    std::vector<double> times;
    for (int r = 0; r < rounds; ++r)
      times.push_back(processor_seconds([&] {
                        for (int i = 0; i < 10; ++i) {
                          steps.animate(0.02);
                          auto const& residuals = steps.root().first<role::LinearSolver>().residuals;
                          iterations += int(residuals.size()) - 1;
                          if (residuals.back() > linearTolerance)
                            throw Error("multigrid", "the residual did not get to 1e-6");
                        }
                      }) /
                      10);
    std::printf("steps-%d %.6g %.1f\n", refresh, 1 / median(times), iterations / (10.0 * rounds));
  }
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 4 && argc != 5) {
    std::fprintf(stderr, "usage: linear CELLS|MESH ROUNDS plain|incompressible|contrast [DEGREE]\n");
    return 2;
  }
  const std::string what = argv[1];
  const Mesh mesh = what.ends_with(".msh") ? io::read_mesh(argv[1]) : block(whole_number(argv[1]));
  for (Kind kind : kinds)
    if (kind.name == argv[3]) {
      if (argc == 5) kind.degree = whole_number(argv[4]);
      run(mesh, kind, whole_number(argv[2]));
      return 0;
    }
  throw Error("arguments", text("'", argv[3], "' is none of plain, incompressible, contrast"));
} catch (Error const& error) {
  std::fprintf(stderr, "linear: %s\n", error.what());
  return 1;
}
