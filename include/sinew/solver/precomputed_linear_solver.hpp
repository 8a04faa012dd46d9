// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/phase.hpp>
#include <sinew/linalg/block_ldl.hpp>
#include <sinew/solver/linear_system.hpp>

#include <string_view>
#include <vector>

namespace sinew {

/// The first system of a scene, factorised once as L D L', answers all later ones too: a step costs a
/// substitution, and no assembly. That is exact where the matrix m M + b B + k K stays what it is: masses,
/// linear springs along fixed directions, FEM with method="small" and linear dampers, in steps of one length.
/// Where elements turn or stiffen, contacts come, or geometric stiffness acts, the matrix is that of the
/// start: forces are exact all the same, so that what is in balance is right, and a step is one of Newton's
/// method with an old derivative. Turned by much more than a few degrees, or stiffened, a body then moves too
/// slowly, or the simulation diverges. A step of another length, or another solver in time, has a system with
/// other factors, which is assembled and factorised anew. SOFA has the inverse as a dense matrix, n^2
/// numbers, which has the same solutions, and goes on with it where dt changes.
template <class Matrix = CompressedRowSparseMatrixMat3x3d>
struct PrecomputedLinearSolver {
  using Role = role::LinearSolver;
  static constexpr std::string_view className = "PrecomputedLinearSolver";
  static constexpr std::string_view templateName = Matrix::name;
  static constexpr Auxiliary auxiliary{};

  static constexpr auto fields() { return field_list(); }
  static constexpr auto state() {
    using S = PrecomputedLinearSolver;
    return field_list(field("massFactor", &S::massFactor, "", "m of the system that was factorised"),
                      field("dampingFactor", &S::dampingFactor, "s", "its b"),
                      field("stiffnessFactor", &S::stiffnessFactor, "s^2", "its k"),
                      field("system", &S::system, "", "the entries of its matrix; none: there was none yet"));
  }

  using Vector = Eigen::Matrix<typename Matrix::Real, Eigen::Dynamic, 1>;
  Matrix matrix{};
  BlockLdl<Matrix> factor{};
  Vector x{}, b{};
  double massFactor = 0, dampingFactor = 0, stiffnessFactor = 0;
  std::vector<double> system{}, factorised{};  // entries of the matrix, and those that `factor` is of

  template <class Operations>
  void init(Operations& operations) {
    operations.initMatrix(matrix);
    factor.init(matrix, matrix.dofs());
    x.setZero(matrix.dofs());
    b.setZero(matrix.dofs());
    system.reserve(matrix.values.size());
    factorised.reserve(matrix.values.size());
    reset();
  }
  void reset() {
    system.clear();
    factorised.clear();
  }

  template <class Operations>
  void solve(Operations& operations, MatrixFactors factors, MultiVecDeriv<Operations>& solution,
             MultiVecDeriv<Operations>& rhs) {
    const bool same = massFactor == factors.m && dampingFactor == factors.b && stiffnessFactor == factors.k;
    if (system.size() != matrix.values.size() || !same) {
      operations.assemble(matrix, factors);
      system.assign(matrix.values.begin(), matrix.values.end());
      massFactor = factors.m, dampingFactor = factors.b, stiffnessFactor = factors.k;
    }
    if (factorised != system) factorise(operations);
    solveAgain(operations, solution, rhs);
  }
  template <class Operations>
  void solveAgain(Operations& operations, MultiVecDeriv<Operations>& solution,
                  MultiVecDeriv<Operations>& rhs) {
    [[maybe_unused]] const auto span = operations.root.span(Phase::substitution);
    operations.gather(b, rhs.id);
    factor.solve(b, x);
    operations.scatter(solution.id, x);
  }
  BlockLdl<Matrix> const* blockFactor() const { return &factor; }

 private:
  template <class Operations>
  void factorise(Operations& operations) {
    [[maybe_unused]] const auto span = operations.root.span(Phase::factorisation);
    for (std::size_t i = 0; i < system.size(); ++i) matrix.values[i] = typename Matrix::Real(system[i]);
    const int dof = factor.factorise(matrix);
    if (dof >= 0)
      throw Error(
          text(operations.root.path(), ": ", className),
          text(
              "the matrix is singular at ",
              dof_text(operations, dof),
              ": nothing holds it there; fix points of the body, or give it mass or stiffness (if a value is "
              "not finite, the simulation diverged before: take a smaller dt)"));
    factorised = system;
  }
};

}  // namespace sinew
