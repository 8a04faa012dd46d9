// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/phase.hpp>
#include <sinew/core/workers.hpp>
#include <sinew/solver/linear_system.hpp>
#include <sinew/solver/multigrid_fields.hpp>
#include <sinew/solver/point_rotations.hpp>
#include <sinew/solver/rigid_modes.hpp>

#include <cmath>
#include <string_view>
#include <vector>

namespace sinew {

/// Conjugate gradients from x = 0, preconditioned by one cycle of multigrid with smoothed aggregation
/// (Vanek, Mandel, Brezina 1996): the iterations hardly grow with the number of points. Points are aggregated
/// by what joins them in the matrix, and the coarse unknowns of an aggregate are the six motions in which it
/// stays rigid (constants, where the points are no places in space). The cycle works in float, what iterates
/// in double. Aggregates and patterns are those of the stiffness at init, and anew where points come to be
/// held or are no longer; solves fill them, without allocating. Where all states are points in space on a
/// device, so are matrix, cycle and what iterates, of the states' precision, but with `warp`.
template <class Matrix = CompressedRowSparseMatrixMat3x3d>
struct MultigridLinearSolver {
  using Role = role::LinearSolver;
  static constexpr std::string_view className = "MultigridLinearSolver";
  static constexpr std::string_view templateName = Matrix::name;
  static constexpr Auxiliary auxiliary{};

  int iterations = 100;     // at most
  double tolerance = 1e-6;  // ends at |b - A x| <= tolerance |b|
  int refresh = 1;          // the cycle is made anew in every so many solves; 0: in the first only
  bool warp = false;
  bool updateModes = true;
  int levels = 10, coarsestSize = 200;
  double strengthThreshold = 0.05;
  int smootherDegree = 2, coarseCycles = 1;

  static constexpr auto fields() {
    using S = MultigridLinearSolver;
    return multigrid_fields<S>(
        field("iterations", &S::iterations, "", "largest number of iterations", range::atLeast(1)),
        field("tolerance",
              &S::tolerance,
              "",
              "relative residual at which to stop; 0 does all iterations",
              range::nonNegative),
        field("refresh",
              &S::refresh,
              "",
              "solves from one update of the coarse matrices to the next; 0: the first only",
              range::nonNegative)
            .also("update_step"),
        field("warp", &S::warp, "", "a cycle that is kept rotates with each point's neighbourhood"),
        field("updateModes",
              &S::updateModes,
              "",
              "rigid motions are those of the positions at each update; else those at the start"));
  }

  std::vector<double>
      residuals{};  // |b - A x| / |b| of the last solve: at the start, then after each iteration

  using Vector = Eigen::Matrix<typename Matrix::Real, Eigen::Dynamic, 1>;
  Matrix matrix{};
  Multigrid multigrid{};
  PointRotations rotations{};
  Vector x{}, b{}, r{}, p{}, q{}, z{}, turned{};
  MatrixFactors last{};   // of the last solve
  int age = -1;           // solves since the cycle was made
  bool onStates = false;  // the states solve

  template <class Operations>
  void init(Operations& operations) {
    reserve_residuals(residuals, iterations);
    age = -1;
    multigrid.settings = multigrid_settings(*this);
    onStates = !warp && states_solve(operations, true, true);
    if (!onStates) initMatrix(operations);
  }

  /// The cycle is made anew.
  void reset() { age = -1; }

  template <class Operations>
  void solve(Operations& operations, MatrixFactors factors, MultiVecDeriv<Operations>& solution,
             MultiVecDeriv<Operations>& rhs) {
    last = factors;
    const bool update = age < 0 || (refresh > 0 && age + 1 >= refresh);
    if (onStates) {
      if (let_states_solve_by_multigrid(*this, operations, factors, solution, rhs, update, false)) {
        age = update ? 0 : age + 1;
        return;
      }
      onStates = false;
      initMatrix(operations);
    }
    operations.assemble(matrix, factors);
    if (update) {
      [[maybe_unused]] const auto span = operations.root.span(Phase::factorisation);
      if (updateModes) rigid_modes(operations, multigrid.modes);
      multigrid.update(some_workers(operations.workers()), matrix);
    }
    age = update ? 0 : age + 1;
    if (warp && update) rotations.reset(operations);
    if (warp && age > 0) rotations.update(operations);
    solveAgain(operations, solution, rhs);
  }
  /// With the matrix and the cycle of the last solve.
  template <class Operations>
  void solveAgain(Operations& operations, MultiVecDeriv<Operations>& solution,
                  MultiVecDeriv<Operations>& rhs) {
    if (onStates) {
      let_states_solve_by_multigrid(*this, operations, last, solution, rhs, false, true);
      return;
    }
    operations.gather(b, rhs.id);
    solveSystem(some_workers(operations.workers()));
    operations.scatter(solution.id, x);
  }

  /// A x = b. The weight of the last direction is in the form of Polak and Ribiere, (r - r_before).z / rho
  /// with r - r_before = -alpha A p: a cycle in float is not quite the same matrix each time (Golub, Ye
  /// 1999).
  void solveSystem(SomeWorkers const& workers) {
    using Real = typename Matrix::Real;
    residuals.clear();
    keep_residual(residuals, 1);
    x.setZero();
    r = b;
    const double whole = dot(workers, r, r);
    if (!std::isfinite(whole)) x = Real(notSolved) * b;
    if (!(whole > 0) || !std::isfinite(whole) || 1 <= tolerance) return;
    precondition(workers);
    p = z;
    double rho = dot(workers, r, z);
    for (int i = 0; i < iterations; ++i) {
      const double curvature = matrix.multiply(workers, p.data(), q.data());
      if (curvature == 0) return;
      const double alpha = std::isfinite(curvature) ? rho / curvature : notSolved;
      const double size = vec::advance(workers, x, p, r, q, Real(alpha));
      keep_residual(residuals, std::sqrt(size / whole));
      if (!(size > tolerance * tolerance * whole)) return;
      precondition(workers);
      const double along = -alpha * dot(workers, q, z);
      vec::xpay(workers, p, z, Real(along / rho));
      rho = dot(workers, r, z);
    }
  }

 private:
  template <class Operations>
  void initMatrix(Operations& operations) {
    operations.initMatrix(matrix);
    multigrid.init(matrix, some_workers(operations.workers()));
    prepare_multigrid(operations, matrix, multigrid);
    if (warp) rotations.init(operations, matrix);
    for (Vector* v : {&x, &b, &r, &p, &q, &z, &turned})
      v->setZero(matrix.dofs() + 1);  // the last stays 0: multiply reads it
  }
  void precondition(SomeWorkers const& workers) {
    if (!warp || age == 0) return multigrid.apply(workers, r, z);
    turned = r;
    rotations.apply(turned, true);
    multigrid.apply(workers, turned, z);
    rotations.apply(z, false);
  }
  static double dot(SomeWorkers const& workers, Vector const& u, Vector const& v) {
    return vec::sum_pieces(workers, u.size(), [&](Eigen::Index i, Eigen::Index n) {
      return vec::dot_piece(u.data() + i, v.data() + i, n);
    });
  }
};

}  // namespace sinew
