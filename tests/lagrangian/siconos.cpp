// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "friction_problems.hpp"

#include <sinew/lagrangian/constraint_sweeps.hpp>

#include <FrictionContactProblem.h>
#include <Friction_cst.h>
#include <NonSmoothDrivers.h>
#include <NumericsMatrix.h>
#include <SolverOptions.h>
#include <SparseBlockMatrix.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

// Friction problems solved by Sinew and by Siconos (Acary et al.), whose nonsmooth Gauss-Seidel (NSGS) solves
// each contact by itself to the end, by Newton's method.
namespace test_siconos {

using namespace sinew;
using namespace friction_problems;

struct Solved {
  bool converged = false;
  int iterations = 0;
  double seconds = 0;
  Eigen::VectorXd multipliers{};
};
constexpr double tolerance = 1e-8;  // of the residual, per |d_free|

Eigen::VectorXd velocities(ConstraintProblem const& p, Eigen::VectorXd const& multipliers) {
  return p.compliance * multipliers + p.freeViolation;
}
double residual(ConstraintProblem p, Eigen::VectorXd const& multipliers) {
  p.multipliers = multipliers;
  return p.residual() / p.freeViolation.norm();
}

// the problem as Siconos has it, with W as a whole or by those of its blocks that are not zero
class Siconos {
 public:
  Siconos(ConstraintProblem const& p, bool sparse)
      : W_(p.compliance), q_(p.freeViolation), mu_(p.rows() / 3), r_(p.multipliers), v_(p.rows()) {
    const int n = p.rows(), contacts = n / 3;
    M_ = NM_create(sparse ? NM_SPARSE_BLOCK : NM_DENSE, n, n);
    if (!sparse) std::copy_n(W_.data(), n * n, M_->matrix0);
    starts_.push_back(0);
    for (int i = 0; i < contacts; ++i) {
      mu_[i] = p.blocks[std::size_t(i)].friction;
      for (int j = 0; sparse && j < contacts; ++j)
        if (const Eigen::Matrix3d block = W_.block<3, 3>(3 * i, 3 * j); !block.isZero(0)) {
          if (i == j) diagonal_.push_back(unsigned(values_.size()));
          values_.push_back(block);
          columns_.push_back(std::size_t(j));
        }
      starts_.push_back(values_.size());
      sizes_.push_back(unsigned(3 * i + 3));
    }
    for (Eigen::Matrix3d& value : values_) blocks_.push_back(value.data());
    if (sparse) {
      *M_->matrix1 = {};
      SparseBlockStructuredMatrix& m = *M_->matrix1;
      m.nbblocks = unsigned(values_.size());
      m.block = blocks_.data();
      m.blocknumber0 = m.blocknumber1 = unsigned(contacts);
      m.blocksize0 = m.blocksize1 = sizes_.data();
      m.filled1 = starts_.size();
      m.filled2 = columns_.size();
      m.index1_data = starts_.data();
      m.index2_data = columns_.data();
      m.diagonal_blocks = diagonal_.data();
    }
    problem_.dimension = 3;
    problem_.numberOfContacts = contacts;
    problem_.M = M_;
    problem_.q = q_.data();
    problem_.mu = mu_.data();
  }
  Siconos(Siconos const&) = delete;
  ~Siconos() {
    if (M_->matrix1) *M_->matrix1 = {};  // its arrays are ours
    NM_clear(M_);
    std::free(M_);
  }
  Solved solve() {
    SolverOptions* options = solver_options_create(SICONOS_FRICTION_3D_NSGS);
    options->dparam[SICONOS_DPARAM_TOL] = tolerance;
    options->iparam[SICONOS_IPARAM_MAX_ITER] = 100000;
    v_.setZero();
    const auto start = std::chrono::steady_clock::now();
    const int info = fc3d_driver(&problem_, r_.data(), v_.data(), options);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    const Solved solved{info == 0, options->iparam[SICONOS_IPARAM_ITER_DONE], took.count(), r_};
    solver_options_delete(options);
    return solved;
  }

 private:
  Eigen::MatrixXd W_;
  Eigen::VectorXd q_, mu_, r_, v_;
  NumericsMatrix* M_ = nullptr;
  std::vector<Eigen::Matrix3d> values_{};
  std::vector<double*> blocks_{};
  std::vector<std::size_t> starts_{}, columns_{};
  std::vector<unsigned> sizes_{}, diagonal_{};
  FrictionContactProblem problem_{};
};
Solved by_siconos(ConstraintProblem const& p, bool sparse = false) { return Siconos(p, sparse).solve(); }

// sweeps until the residual is as small; the tolerance of the last change that this needs is found first
Solved by_sweeps(ConstraintProblem const& p, bool conjugate) {
  ConstraintSweeps sweeps;
  SweepSettings settings{
      .maxIterations = 100000, .tolerance = tolerance * p.freeViolation.norm(), .scaleTolerance = false};
  while (true) {
    ConstraintProblem q = p;
    const auto start = std::chrono::steady_clock::now();
    const SweepResult result = conjugate ? sweeps.nonsmoothConjugateGradients(q, settings, "sweeps")
                                         : sweeps.gaussSeidel(q, settings, "sweeps");
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    const bool converged = residual(p, q.multipliers) <= tolerance;
    if (converged || !result.converged) return {converged, result.iterations, took.count(), q.multipliers};
    settings.tolerance /= 10;
  }
}

// Whether the velocities are the same. Both residuals are below the tolerance, and velocities are further off
// by the condition of W at most; what is seen is a few times the residual.
bool same(ConstraintProblem const& p, Solved const& a, Solved const& b) {
  return (velocities(p, a.multipliers) - velocities(p, b.multipliers)).norm() <
         100 * tolerance * p.freeViolation.norm();
}

// Piles of balls have as many contacts as hold them, soft bodies a W that is definite, and boxes with a
// little compliance in their contacts too.
TEST_CASE("friction problems of rigid and soft bodies: the velocities of Siconos") {
  int problems = 0;
  for (int kind = 0; kind < 3; ++kind)
    for (unsigned seed = 1; seed <= 50; ++seed) {
      ConstraintProblem p = kind == 0   ? box_stack(1 + int(seed) % 7, seed).problem()
                            : kind == 1 ? ball_pile(3 + int(seed) % 25, seed).problem()
                                        : soft_grid(2 + int(seed) % 4, seed).problem();
      if (kind == 0) p.compliance.diagonal() *= 1.05;
      CAPTURE(kind, seed, p.rows());
      const Solved siconos = by_siconos(p), sweeps = by_sweeps(p, false), conjugate = by_sweeps(p, true);
      CHECK(siconos.converged);
      CHECK(sweeps.converged);
      CHECK(conjugate.converged);
      CHECK(same(p, siconos, sweeps));
      CHECK(same(p, siconos, conjugate));
      ++problems;
    }
  CHECK(problems == 150);
}

// A face of a box on four contacts, each with a friction of its own, slides and turns as they share the load,
// which nothing determines: there are several solutions. Each of the two takes the other's for one, whose
// residual it has nothing to do about.
TEST_CASE("rigid boxes on four contacts a face: a solution of one is one of the other") {
  int alike = 0;
  for (unsigned seed = 1; seed <= 50; ++seed) {
    const ConstraintProblem p = box_stack(1 + int(seed) % 7, seed).problem();
    CAPTURE(seed, p.rows());
    const Solved siconos = by_siconos(p), sweeps = by_sweeps(p, false), conjugate = by_sweeps(p, true);
    CHECK(siconos.converged);
    CHECK(residual(p, siconos.multipliers) < 10 * tolerance);
    for (Solved const* ours : {&sweeps, &conjugate}) {
      REQUIRE(ours->converged);
      ConstraintProblem begun = p;
      begun.multipliers = ours->multipliers;
      const Solved again = by_siconos(begun);
      CHECK(again.converged);
      CHECK(same(p, again, *ours));
      begun.multipliers = siconos.multipliers;
      CHECK(same(p, by_sweeps(begun, ours == &conjugate), siconos));
    }
    if (same(p, siconos, sweeps) && same(p, siconos, conjugate)) ++alike;
  }
  WARN("the same velocities from no force on: " << alike << " of 50");
}

// Until the residual is 1e-8 |d_free|: iterations and milliseconds of one solution, the least of three.
TEST_CASE("table of iterations and time", "[.table]") {
  std::printf("%-28s %8s | %-18s | %-18s | %-30s\n",
              "",
              "contacts",
              "Gauss-Seidel",
              "NNCG",
              "Siconos NSGS: dense, sparse W");
  auto row = [](std::string const& name, ConstraintProblem const& p) {
    auto best = [&](auto&& solve) {
      Solved least = solve();
      for (int k = 0; k < 2 && least.seconds < 10; ++k)
        if (Solved next = solve(); next.seconds < least.seconds) least = next;
      return least;
    };
    const Solved s = best([&] { return by_sweeps(p, false); }), c = best([&] { return by_sweeps(p, true); }),
                 d = best([&] { return by_siconos(p); }), e = best([&] { return by_siconos(p, true); });
    auto mark = [](Solved const& r) { return r.converged ? ' ' : '!'; };
    std::printf("%-28s %8d | %6d %9.2f%c | %6d %9.2f%c | %6d %9.2f%c %9.2f%c\n",
                name.c_str(),
                p.rows() / 3,
                s.iterations,
                1e3 * s.seconds,
                mark(s),
                c.iterations,
                1e3 * c.seconds,
                mark(c),
                d.iterations,
                1e3 * d.seconds,
                mark(d),
                1e3 * e.seconds,
                mark(e));
    std::fflush(stdout);
  };
  for (const int n : {2, 5, 10, 20}) {
    row("stack of " + std::to_string(n) + " rigid boxes", box_stack(n, 1).problem());
    ConstraintProblem p = box_stack(n, 1).problem();
    p.compliance.diagonal() *= 1.05;
    row("  with compliant contacts", p);
  }
  for (const int n : {10, 50, 200}) row("pile of " + std::to_string(n) + " balls", ball_pile(n, 1).problem());
  for (const int n : {3, 6, 10})
    row("soft block, " + std::to_string(n) + " x " + std::to_string(n), soft_grid(n, 1).problem());
}

}  // namespace test_siconos
