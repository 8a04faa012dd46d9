// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/workers.hpp>
#include <sinew/linalg/block_inverse.hpp>
#include <sinew/linalg/block_ldl.hpp>
#include <sinew/linalg/block_matrix.hpp>
#include <sinew/linalg/multigrid.hpp>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace sinew {

/// What a preconditioner takes for the matrix A = L + D + L', D its diagonal blocks.
///   none                A ~ I
///   jacobi              its diagonal
///   blockJacobi         D
///   ssor                (D/w + L) (D/w)^-1 (D/w + L)' / (2 - w), one sweep there and back (Axelsson 1972)
///   incompleteCholesky  L D L' with the blocks of A and no more, IC(0) (Meijerink, van der Vorst 1977)
///   ldl                 A itself, factorised: of use for several steps, while A changes little
///   multigrid           a cycle of smoothed aggregation (Vanek, Mandel, Brezina 1996), of a matrix whose
///                       modes of least energy are known: `modes` of it, before update
enum class PreconditionerMethod { none, jacobi, blockJacobi, ssor, incompleteCholesky, ldl, multigrid };
inline constexpr std::array<std::string_view, 7> enum_names(PreconditionerMethod) {
  return {"none", "jacobi", "blockJacobi", "ssor", "incompleteCholesky", "ldl", "multigrid"};
}

/// z = M^-1 r, where M is near to a block matrix and easily solved. Positive definite whatever the matrix is
/// (with multigrid, where the matrix is), so that conjugate gradients may use it. update and apply do not
/// allocate, but for the first update of multigrid, which needs values (prepare_multigrid).
template <class Matrix>
struct Preconditioner {
  using Real = typename Matrix::Real;
  static constexpr int B = Matrix::blockSize;
  using Block = Eigen::Matrix<Real, B, B>;
  using Column = Eigen::Matrix<Real, B, 1>;

  PreconditionerMethod method = PreconditionerMethod::none;
  int dofs = 0;      // scalars of the system, without padding
  double omega = 1;  // w of SSOR
  double shift = 0;  // of the diagonal, relative, that a factorisation needed to be positive
  std::vector<int> first{}, column{},
      slot{};  // SSOR, IC: blocks left of the diagonal, and the slots of their transposes in the matrix
  std::vector<Block> lower{}, inverse{};  // L with ones on its diagonal, D^-1
  BlockLdl<Matrix> factor{};
  Multigrid multigrid{};

  void init(Matrix const& a, PreconditionerMethod which, int systemDofs, SomeWorkers workers = {}) {
    method = which;
    dofs = systemDofs;
    if (method == PreconditionerMethod::multigrid) return multigrid.init(a, workers);
    if (method == PreconditionerMethod::ldl) return factor.init(a, dofs);
    inverse.assign(std::size_t(a.rows()), Block::Identity());
    first.assign(1, 0);
    column.clear();
    slot.clear();
    if (triangular()) first = a.leftStart, column = a.leftColumns, slot = a.leftSlots;
    lower.assign(column.size(), Block::Zero());
    int longest = 0;
    for (std::size_t i = 0; i + 1 < first.size(); ++i) longest = std::max(longest, first[i + 1] - first[i]);
    scaled.assign(std::size_t(longest), Block::Zero());
  }

  /// IC(0) of a positive definite matrix may break down, and L D L' of an indefinite one has negative pivots;
  /// those of A + shift diag(A) are positive for a shift large enough (Manteuffel 1980): 0.001, doubled as
  /// long as it takes.
  void update(Matrix const& a, SomeWorkers workers = {}) {
    shift = 0;
    if (method == PreconditionerMethod::multigrid) return multigrid.update(workers, a);
    auto positive = [&] {
      if (method == PreconditionerMethod::incompleteCholesky) return incompleteFactor(a);
      return factor.factorise(a, shift) < 0 && factor.negativePivots == 0;
    };
    if (method == PreconditionerMethod::incompleteCholesky || method == PreconditionerMethod::ldl) {
      while (!positive() && shift < 1e3) shift = shift > 0 ? 2 * shift : 1e-3;
      return;
    }
    for (int i = 0; i < a.rows() && method != PreconditionerMethod::none; ++i) {
      const Block d = diagonal(a, i);
      Block& of = inverse[std::size_t(i)];
      if (method == PreconditionerMethod::jacobi || !invert_definite(d, of)) invert_diagonal(d, of);
    }
    if (method == PreconditionerMethod::ssor) scaleRows(a);
  }

  template <class Vector>
  void apply(Vector const& r, Vector& z, SomeWorkers workers = {}) {
    if (method == PreconditionerMethod::multigrid) return multigrid.apply(workers, r, z);
    if (method == PreconditionerMethod::ldl) return factor.solve(r, z);
    auto at = [&z](int i) { return z.template segment<B>(Eigen::Index(i) * B); };
    const int n = int(inverse.size());
    const bool triangular = this->triangular();
    for (int i = 0; i < n; ++i) {
      Column sum = r.template segment<B>(Eigen::Index(i) * B);
      if (triangular)
        for (int p = first[std::size_t(i)]; p < first[std::size_t(i) + 1]; ++p)
          sum.noalias() -= lower[std::size_t(p)] * at(column[std::size_t(p)]);
      at(i) = sum;
    }
    for (int i = 0; i < n; ++i) at(i) = (inverse[std::size_t(i)] * at(i)).eval();
    for (int i = triangular ? n : 0; i-- > 0;)
      for (int p = first[std::size_t(i)]; p < first[std::size_t(i) + 1]; ++p)
        at(column[std::size_t(p)]).noalias() -= lower[std::size_t(p)].transpose() * at(i);
  }

 private:
  std::vector<Block> scaled{};  // L D, of one row

  bool triangular() const {
    return method == PreconditionerMethod::ssor || method == PreconditionerMethod::incompleteCholesky;
  }
  // SSOR as L D L': L = I + w A_lower D^-1,  D^-1 <- w (2 - w) D^-1
  void scaleRows(Matrix const& a) {
    for (std::size_t p = 0; p < column.size(); ++p)
      lower[p].noalias() = Real(omega) *
                           Eigen::Map<typename Matrix::Block const>(a.block(slot[p])).transpose() *
                           inverse[std::size_t(column[p])];
    for (Block& d : inverse) d *= Real(omega * (2 - omega));
  }
  Block diagonal(Matrix const& a, int i) const {
    Block d = Eigen::Map<typename Matrix::Block const>(a.block(a.rowStart[std::size_t(i)]));
    for (int r = 0; r < B; ++r)
      if (i * B + r >= dofs) d(r, r) = 1;
    return d;
  }
  bool incompleteFactor(Matrix const& a) {
    for (int i = 0; i < a.rows(); ++i) {
      const int begin = first[std::size_t(i)], end = first[std::size_t(i) + 1];
      Block d = diagonal(a, i);
      d.diagonal() *= Real(1 + shift);
      for (int p = begin; p < end; ++p) {
        const std::size_t j = std::size_t(column[std::size_t(p)]);
        Block u = Eigen::Map<typename Matrix::Block const>(a.block(slot[std::size_t(p)])).transpose();
        // less the products of what rows i and j have in common
        for (int q = begin, s = first[j]; q < p && s < first[j + 1];) {
          const int cq = column[std::size_t(q)], cs = column[std::size_t(s)];
          if (cq == cs) u.noalias() -= scaled[std::size_t(q - begin)] * lower[std::size_t(s)].transpose();
          q += cq <= cs;
          s += cs <= cq;
        }
        scaled[std::size_t(p - begin)] = u;
        lower[std::size_t(p)].noalias() = u * inverse[j];
        d.noalias() -= u * lower[std::size_t(p)].transpose();
      }
      if (!invert_definite(d, inverse[std::size_t(i)])) return false;
    }
    return true;
  }
};

}  // namespace sinew
