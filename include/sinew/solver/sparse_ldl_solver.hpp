// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/phase.hpp>
#include <sinew/linalg/block_ldl.hpp>
#include <sinew/solver/linear_system.hpp>

#include <string_view>

namespace sinew {

/// The assembled system solved to rounding by L D L': the order and the pattern of L are found at init, the
/// values in each solve, which allocates nothing. (Eigen's SimplicialLDLT orders and works as BlockLdl does,
/// on scalars, and takes heap memory in factorize: a permuted copy of the matrix, and work space above 128
/// KiB.) Indefinite systems are solved where the factorisation exists; `negativePivots` of the factor counts
/// their negative eigenvalues. Throws Error where a pivot vanishes. SOFA's BTDLinearSolver, for matrices of
/// blocks of which only neighbours in a row are joined, and blind to others, is this one: a chain of beams
/// has no more blocks in L than in its matrix.
template <class Matrix = CompressedRowSparseMatrixMat3x3d>
struct SparseLDLSolver {
  using Role = role::LinearSolver;
  static constexpr std::string_view className = "SparseLDLSolver";
  static constexpr std::string_view templateName = Matrix::name;
  // matrices of Sinew are symmetric, so that what is solved by L L' or L U elsewhere is solved by L D L' here
  static constexpr std::string_view aliases =
      "EigenSimplicialLDLT EigenSimplicialLLT AsyncSparseLDLSolver SparseCholeskySolver SparseLUSolver "
      "EigenSparseLU EigenSparseQR EigenCholmodSupernodalLLT SparsePARDISOSolver SparseTAUCSSolver "
      "SparseXXTSolver BTDLinearSolver SVDLinearSolver";
  static constexpr Auxiliary auxiliary{};

  static constexpr auto fields() { return field_list(); }

  using Vector = Eigen::Matrix<typename Matrix::Real, Eigen::Dynamic, 1>;
  Matrix matrix{};
  BlockLdl<Matrix> factor{};
  Vector x{}, b{};

  template <class Operations>
  void init(Operations& operations) {
    operations.initMatrix(matrix);
    factor.init(matrix, matrix.dofs());
    x.setZero(matrix.dofs());
    b.setZero(matrix.dofs());
  }

  template <class Operations>
  void solve(Operations& operations, MatrixFactors factors, MultiVecDeriv<Operations>& solution,
             MultiVecDeriv<Operations>& rhs) {
    operations.assemble(matrix, factors);
    const int dof = [&] {
      [[maybe_unused]] const auto span = operations.root.span(Phase::factorisation);
      return factor.factorise(matrix);
    }();
    if (dof >= 0)
      throw Error(
          text(operations.root.path(), ": ", className),
          text(
              "the matrix is singular at ",
              dof_text(operations, dof),
              ": nothing holds it there; fix points of the body, or give it mass or stiffness (if a value is "
              "not finite, the simulation diverged before: take a smaller dt)"));
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
};

}  // namespace sinew
