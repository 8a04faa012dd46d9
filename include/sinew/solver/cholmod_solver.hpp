// SPDX-License-Identifier: BSL-1.0
#pragma once

// Needs CHOLMOD of SuiteSparse (Debian: libsuitesparse-dev), which has licences of its own: LGPL, and GPL for
// its supernodal part. Not in sinew.hpp; CMake's target sinew::cholmod, there where CHOLMOD is installed,
// brings it.
#include <sinew/solver/linear_system.hpp>

#if __has_include(<cholmod.h>)
#include <cholmod.h>
#else
#include <suitesparse/cholmod.h>
#endif

#include <memory>
#include <string_view>
#include <vector>

namespace sinew {

/// What CHOLMOD holds for one matrix. Copies are empty: init fills them.
class CholmodFactor {
 public:
  CholmodFactor() = default;
  CholmodFactor(CholmodFactor&&) = default;
  CholmodFactor(CholmodFactor const&) {}
  CholmodFactor& operator=(CholmodFactor&&) = default;
  CholmodFactor& operator=(CholmodFactor const& o) {
    if (this != &o) held_.reset();
    return *this;
  }

  /// Order and pattern of L of a symmetric matrix, of which the columns on and below the diagonal are given.
  void analyse(std::string_view where, std::vector<int>& starts, std::vector<int>& rows,
               std::vector<double>& values) {
    held_ = std::make_unique<Held>();
    const std::size_t n = starts.size() - 1;
    auto& a = held_->matrix;
    a.nrow = a.ncol = n;
    a.nzmax = rows.size();
    a.p = starts.data();
    a.i = rows.data();
    a.x = values.data();
    a.stype = -1;
    a.itype = CHOLMOD_INT;
    a.xtype = CHOLMOD_REAL;
    a.dtype = CHOLMOD_DOUBLE;
    a.sorted = a.packed = 1;
    held_->factor = cholmod_analyze(&a, &held_->common);
    if (!held_->factor) throw Error(where, "CHOLMOD found no order of the matrix; it may be out of memory");
  }
  /// -1, or the column whose pivot is not positive.
  int factorise() {
    cholmod_factorize(&held_->matrix, held_->factor, &held_->common);
    auto const& l = *held_->factor;
    if (held_->common.status == CHOLMOD_OK && l.minor == l.n) return -1;
    return static_cast<int const*>(l.Perm)[std::min(l.minor, l.n - 1)];
  }
  void solve(std::vector<double>& b, std::vector<double>& x) {
    cholmod_dense from{};
    from.nrow = from.nzmax = from.d = b.size();
    from.ncol = 1;
    from.x = b.data();
    from.xtype = CHOLMOD_REAL;
    from.dtype = CHOLMOD_DOUBLE;
    cholmod_solve2(CHOLMOD_A,
                   held_->factor,
                   &from,
                   nullptr,
                   &held_->solution,
                   nullptr,
                   &held_->work[0],
                   &held_->work[1],
                   &held_->common);
    double const* const found = static_cast<double const*>(held_->solution->x);
    x.assign(found, found + x.size());
  }

 private:
  struct Held {
    cholmod_common common{};
    cholmod_sparse matrix{};
    cholmod_factor* factor = nullptr;
    cholmod_dense *solution = nullptr, *work[2] = {};

    Held() {
      cholmod_start(&common);
      common.print = 0;
      common.supernodal = CHOLMOD_SUPERNODAL;
    }
    Held(Held const&) = delete;
    ~Held() {
      for (cholmod_dense** d : {&solution, &work[0], &work[1]}) cholmod_free_dense(d, &common);
      cholmod_free_factor(&factor, &common);
      cholmod_finish(&common);
    }
  };
  std::unique_ptr<Held> held_{};
};

/// The assembled system, which must be positive definite, solved to rounding by the supernodal L L' of
/// CHOLMOD (Chen, Davis, Hager, Rajamanickam 2008): dense blocks of columns, by the BLAS that is installed.
/// With an optimised one (OpenBLAS) it overtakes SparseLDLSolver at about 1,000 points of a solid body and
/// takes half of its time at 3,000; with the reference BLAS it is slower. The order and the pattern of L are
/// found at init; the values take heap memory in each solve. Throws Error where a pivot is not positive.
template <class Matrix = CompressedRowSparseMatrixMat3x3d>
struct CholmodSolver {
  using Role = role::LinearSolver;
  static constexpr std::string_view className = "CholmodSolver";
  static constexpr std::string_view header = "sinew/solver/cholmod_solver.hpp";
  static constexpr std::string_view templateName = Matrix::name;
  static constexpr Auxiliary auxiliary{};

  static constexpr auto fields() { return field_list(); }

  using Vector = Eigen::Matrix<typename Matrix::Real, Eigen::Dynamic, 1>;
  Matrix matrix{};
  std::vector<int> starts{}, rows{};  // columns of scalars, on and below the diagonal
  std::vector<double> values{}, rhs{}, solution{};
  CholmodFactor factor{};
  Vector x{}, b{};

  template <class Operations>
  void init(Operations& operations) {
    operations.initMatrix(matrix);
    const std::size_t n = std::size_t(matrix.dofs());
    starts.assign(1, 0);
    rows.clear();
    forEachScalar([&](int, int row, double) { rows.push_back(row); },
                  [&] { starts.push_back(int(rows.size())); });
    values.assign(rows.size(), 0.0);
    rhs.assign(n, 0.0);
    solution.assign(n, 0.0);
    x.setZero(matrix.dofs());
    b.setZero(matrix.dofs());
    factor.analyse(text(operations.root.path(), ": ", className), starts, rows, values);
  }

  template <class Operations>
  void solve(Operations& operations, MatrixFactors factors, MultiVecDeriv<Operations>& to,
             MultiVecDeriv<Operations>& from) {
    operations.assemble(matrix, factors);
    std::size_t next = 0;
    forEachScalar([&](int, int, double value) { values[next++] = value; }, [] {});
    if (const int dof = factor.factorise(); dof >= 0)
      throw Error(
          text(operations.root.path(), ": ", className),
          text("the matrix is not positive definite at ",
               dof_text(operations, dof),
               "; fix points of the body, take a smaller dt, or use SparseLDLSolver or MinResLinearSolver, "
               "which solve indefinite systems"));
    solveAgain(operations, to, from);
  }
  template <class Operations>
  void solveAgain(Operations& operations, MultiVecDeriv<Operations>& to, MultiVecDeriv<Operations>& from) {
    operations.gather(b, from.id);
    for (std::size_t i = 0; i < rhs.size(); ++i) rhs[i] = double(b[Eigen::Index(i)]);
    factor.solve(rhs, solution);
    for (std::size_t i = 0; i < rhs.size(); ++i) x[Eigen::Index(i)] = typename Matrix::Real(solution[i]);
    operations.scatter(to.id, x);
  }

 private:
  // f(column, row, value) on and below the diagonal, column by column: rows of the upper half, transposed;
  // end() after each
  template <class F, class End>
  void forEachScalar(F&& f, End&& end) const {
    constexpr int B = Matrix::blockSize;
    for (int i = 0; i < matrix.dofs(); ++i) {
      const std::size_t r = std::size_t(i / B);
      for (int k = matrix.rowStart[r]; k < matrix.rowStart[r + 1]; ++k)
        for (int c = 0; c < B; ++c)
          if (const int j = matrix.columns[std::size_t(k)] * B + c; j >= i)
            f(i, j, double(matrix.block(k)[i % B * B + c]));
      end();
    }
  }
};

}  // namespace sinew
