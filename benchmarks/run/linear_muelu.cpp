// SPDX-License-Identifier: BSL-1.0
#include "linear_system.hpp"
#include "paired.hpp"

#include <BelosSolverFactory_Tpetra.hpp>
#include <BelosTpetraAdapter.hpp>
#include <MueLu_CreateTpetraPreconditioner.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_CrsMatrix.hpp>

#include <array>

namespace bench {

LinearResult solve_by_muelu(LinearSystem const& s) {
  using Map = Tpetra::Map<>;
  using Matrix = Tpetra::CrsMatrix<double>;
  using Vectors = Tpetra::MultiVector<double>;
  using Operator = Tpetra::Operator<double>;
  using Teuchos::rcp, Teuchos::RCP;
  if (!Tpetra::isInitialized()) {
    int count = 0;
    char** arguments = nullptr;
    Tpetra::initialize(&count, &arguments);
  }
  LinearResult result;
  const auto n = std::size_t(s.unknowns);
  auto const map = rcp(new Map(n, 0, Tpetra::getDefaultComm()));
  std::vector<std::size_t> counts;
  for (std::size_t i = 0; i < n; ++i) counts.push_back(std::size_t(s.starts[i + 1] - s.starts[i]));
  auto const a = rcp(new Matrix(map, map, Teuchos::arrayViewFromVector(counts)));
  for (std::size_t i = 0; i < n; ++i) {
    const auto from = std::size_t(s.starts[i]);
    a->insertLocalValues(int(i), int(counts[i]), &s.values[from], &s.columns[from]);
  }
  a->fillComplete();
  auto const b = rcp(new Vectors(map, 1)), x = rcp(new Vectors(map, 1)), rigid = rcp(new Vectors(map, 6));
  std::array<double, 3> centre{};
  for (std::size_t i = 0; i < n; ++i) centre[i % 3] += 3 * s.places[i] / double(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t axis = i % 3, next = (axis + 1) % 3, last = (axis + 2) % 3, point = i - axis;
    b->replaceLocalValue(int(i), 0, s.rhs[i]);
    rigid->replaceLocalValue(int(i), axis, 1);
    // e_r x (p - centre), by components
    rigid->replaceLocalValue(int(i), 3 + next, s.places[point + last] - centre[last]);
    rigid->replaceLocalValue(int(i), 3 + last, -(s.places[point + next] - centre[next]));
  }

  // MueLu's User's Guide (SAND2023-12265), chapter on performance: to start from the settings of the type of
  // problem, here smoothed aggregation over three equations a point and Chebyshev, which takes less time than
  // symmetric Gauss-Seidel; implicit restriction where symmetric. Weak joints are dropped, as Sinew does: the
  // solution takes a third of the time where stiffness jumps, and a little less elsewhere
  Teuchos::ParameterList settings;
  settings.set("verbosity", "none");
  settings.set("problem: type", "Elasticity-3D");
  settings.set("aggregation: drop tol", 0.005);
  settings.set("transpose: use implicit", true);
  settings.sublist("user data").set("Nullspace", RCP<Vectors>(rigid));
  RCP<Operator> cycle;
  result.setUp =
      processor_seconds([&] { cycle = MueLu::CreateTpetraPreconditioner(RCP<Operator>(a), settings); });

  auto const problem = rcp(new Belos::LinearProblem<double, Vectors, Operator>(a, x, b));
  problem->setLeftPrec(cycle);
  problem->setProblem();
  auto const of = Teuchos::parameterList();
  of->set("Convergence Tolerance", linearTolerance);  // of |r| / |b|, since x = 0 at first
  of->set("Maximum Iterations", 2000);
  Belos::SolverFactory<double, Vectors, Operator> solvers;
  auto const solver = solvers.create("CG", of);
  solver->setProblem(problem);
  result.solve = processor_seconds([&] { solver->solve(); });
  result.iterations = solver->getNumIters();
  auto const from = x->getData(0);
  result.x.assign(from.begin(), from.end());
  return result;
}

}  // namespace bench
