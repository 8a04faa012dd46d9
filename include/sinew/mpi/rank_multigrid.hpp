// SPDX-License-Identifier: BSL-1.0
#pragma once

// Needs PETSc, for the numbers of what it solves. CMake's target sinew::mpi brings it.
#include <sinew/core/workers.hpp>
#include <sinew/linalg/multigrid.hpp>
#include <sinew/mpi/petsc.hpp>
#include <sinew/solver/rigid_modes.hpp>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew::mpi {

/// Where the unknowns of a rank are in those of all: its rows are some blocks of its matrix, from `begin` on.
struct PetscLayout {
  std::vector<PetscInt> rows{};  // blocks of the matrix here whose rows are this rank's, in the order of all
  std::vector<PetscInt> global{};  // of each block of the matrix here, its number among all
  PetscInt begin = 0;
  PetscInt blocks() const { return PetscInt(rows.size()); }
};

/// A preconditioner of two additive levels (Nicolaides 1987; Smith, Bjorstad, Gropp 1996, chapter 2),
///   z = sum_r R_r' V_r R_r x + P (P' A P)^-1 P' x
/// R_r takes what is of rank r, V_r is one V-cycle of Multigrid for its rows and columns of A, and the
/// columns of P are the rigid motions of each rank's part. Each rank has the factor of P' A P, of at most six
/// rows a rank. It is symmetric, and positive definite where A is.
template <class Matrix>
class RankMultigrid {
 public:
  MultigridSettings settings{};

  /// The pattern, of the rows of this rank in `local`.
  template <class Operations>
  void init(Operations& operations, Matrix const& local, PetscLayout const& layout) {
    ownOf_.assign(layout.global.size(), -1);
    for (PetscInt i = 0; i < layout.blocks(); ++i) ownOf_[std::size_t(layout.rows[std::size_t(i)])] = int(i);
    own_.startPattern(int(layout.blocks()) * B);
    forEachOwn(local, layout, [&](int i, int j, int, bool) { own_.preallocate(i * B, j * B, B, B); });
    own_.finishPattern();
    multigrid_.settings = settings;
    multigrid_.init(own_, some_workers(operations.workers()));
    x_.setZero(own_.dofs() + 1);
    z_.setZero(own_.dofs() + 1);
    // of the coarse level, so that no update allocates
    modes_.assign(std::size_t(local.dofs()) + 8, Row{});
    held_.assign(std::size_t(local.dofs()) + B, false);
    columns_.setZero(own_.dofs(), 6);
    here_.setZero(local.dofs(), 6);
    owner_.assign(layout.global.size(), 0);
    Eigen::Index size = 1;
    if constexpr (distributes<Operations>) {
      auto& ranks = operations.root.distribution().ranks();
      rank_ = ranks.rank(), size = ranks.size();
      kept_.setZero(local.dofs()), column_.setZero(local.dofs());
      std::vector<PetscInt> begins;
      ranks.gatherAlike(std::vector<PetscInt>{layout.begin}, begins, "the rows of all ranks");
      for (std::size_t b = 0; b < owner_.size(); ++b)
        owner_[b] =
            int(std::upper_bound(begins.begin(), begins.end(), layout.global[b]) - begins.begin()) - 1;
    }
    rows_.assign(std::size_t(36 * size), 0);
    coarse_.setZero(6 * size, 6 * size);
    solved_.setZero(6 * size);
  }

  /// The values. `work` is a vector of the states that is free for now.
  template <class Operations, class Id>
  void update(Operations& operations, Matrix const& local, PetscLayout const& layout, Id work) {
    own_.setZero();
    forEachOwn(local, layout, [&](int i, int j, int slot, bool transposed) {
      if (transposed) return;  // half of the matrix is kept, and rows are in the same order
      auto const* const from = local.block(slot);
      std::copy(from, from + B * B, own_.block(own_.slot(i, j)));
    });
    rigid_modes(operations, modes_);
    for (std::size_t i = 0; i < layout.rows.size(); ++i)
      for (std::size_t r = 0; r < B; ++r)
        multigrid_.modes[i * B + r] = modes_[std::size_t(layout.rows[i]) * B + r];
    multigrid_.update(some_workers(operations.workers()), own_);
    makeCoarse(operations, local, layout, work);
  }

  /// z = M x, of the scalars of this rank. All ranks have to call it.
  template <class Operations>
  void apply(Operations& operations, PetscScalar const* x, PetscScalar* z) {
    const Eigen::Index n = own_.dofs();
    for (Eigen::Index i = 0; i < n; ++i) x_[i] = typename Matrix::Real(x[i]);
    multigrid_.apply(some_workers(operations.workers()), x_, z_);
    for (Eigen::Index i = 0; i < n; ++i) z[i] = PetscScalar(z_[i]);
    if (!hasCoarse_) return;
    for (Eigen::Index k = 0; k < 6; ++k) {
      double sum = 0;
      for (Eigen::Index i = 0; i < n; ++i) sum += columns_(i, k) * double(x[i]);
      sums_[std::size_t(k)] = sum;
    }
    gather(operations, sums_, "the coarse level");
    for (Eigen::Index k = 0; k < solved_.size(); ++k) solved_[k] = all_[std::size_t(k)];
    factor_.solveInPlace(solved_);
    const Eigen::Matrix<double, 6, 1> mine = solved_.template segment<6>(6 * rank_);
    for (Eigen::Index i = 0; i < n; ++i) z[i] += PetscScalar(columns_.row(i).dot(mine));
  }

 private:
  static constexpr int B = Matrix::blockSize;
  using Row = Multigrid::Row;
  using Vector = Eigen::Matrix<typename Matrix::Real, Eigen::Dynamic, 1>;
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, 6>;
  template <class Operations>
  static constexpr bool distributes = std::decay_t<decltype(std::declval<Operations&>().root)>::distributed;

  std::vector<int> ownOf_{};  // of each block here, its row among those of this rank; -1: of another one
  Matrix own_{};
  Multigrid multigrid_{};
  Vector x_{}, z_{};
  int rank_ = 0;
  std::vector<int> owner_{};  // rank of each block here
  std::vector<Row> modes_{};
  std::vector<bool> held_{};
  Columns columns_{};  // of P that are of this rank, orthonormal, or zero
  Columns here_{};     // P at all points here, those of other ranks, too: columns of the rank that has them
  Vector kept_{}, column_{};
  Eigen::MatrixXd coarse_{};
  Eigen::LLT<Eigen::MatrixXd> factor_{};
  bool hasCoarse_ = false;
  Eigen::VectorXd solved_{};
  std::vector<double> sums_ = std::vector<double>(6, 0.0), rows_{}, all_{};

  // into all_, of each rank as many
  template <class Operations>
  void gather(Operations& operations, std::vector<double> const& own,
              [[maybe_unused]] std::string_view what) {
    if constexpr (distributes<Operations>)
      operations.root.distribution().ranks().gatherAlike(own, all_, what);
    else
      all_ = own;
  }

  // f(row, column, slot, transposed) for blocks between what is of this rank
  template <class F>
  void forEachOwn(Matrix const& local, PetscLayout const& layout, F&& f) const {
    for (std::size_t i = 0; i < layout.rows.size(); ++i)
      local.forEachInRow(int(layout.rows[i]), [&](int column, int slot, bool transposed) {
        if (const int j = ownOf_[std::size_t(column)]; j >= 0) f(int(i), j, slot, transposed);
      });
  }
  // rows of the matrix with nothing beside the diagonal: what is held does not move rigidly
  void findHeld(Matrix const& local, PetscLayout const& layout) {
    for (const PetscInt row : layout.rows) {
      bool others[std::size_t(B)] = {};
      local.forEachInRow(int(row), [&](int column, int slot, bool transposed) {
        auto const* const block = local.block(slot);
        for (std::size_t r = 0; r < B; ++r)
          for (std::size_t c = 0; c < B; ++c)
            if ((column != int(row) || r != c) && block[transposed ? c * B + r : r * B + c] != 0)
              others[r] = true;
      });
      for (std::size_t r = 0; r < B; ++r) held_[std::size_t(row) * B + r] = !others[r];
    }
  }

  template <class Operations, class Id>
  void makeCoarse(Operations& operations, Matrix const& local, PetscLayout const& layout,
                  [[maybe_unused]] Id work) {
    findHeld(local, layout);
    columns_.setZero();
    for (std::size_t i = 0; i < layout.rows.size(); ++i)
      for (std::size_t r = 0; r < B; ++r) {
        const std::size_t dof = std::size_t(layout.rows[i]) * B + r;
        for (std::size_t k = 0; k < 6 && !held_[dof]; ++k)
          columns_(Eigen::Index(i * B + r), Eigen::Index(k)) = double(modes_[dof][k]);
      }
    // Gram and Schmidt, twice; what depends on others is left out
    for (Eigen::Index k = 0; k < 6; ++k) {
      const double before = columns_.col(k).norm();
      for (int turn = 0; turn < 2; ++turn)
        for (Eigen::Index j = 0; j < k; ++j)
          columns_.col(k) -= columns_.col(j).dot(columns_.col(k)) * columns_.col(j);
      const double left = columns_.col(k).norm();
      if (left > 1e-8 * before)
        columns_.col(k) /= left;
      else
        columns_.col(k).setZero();
    }
    here_.setZero();
    for (std::size_t i = 0; i < layout.rows.size(); ++i)
      here_.template middleRows<B>(Eigen::Index(layout.rows[i]) * B) =
          columns_.template middleRows<B>(Eigen::Index(i) * B);
    if constexpr (distributes<Operations>) {
      operations.gather(kept_, work);
      for (Eigen::Index k = 0; k < 6; ++k) {
        column_ = here_.col(k).template cast<typename Matrix::Real>();
        operations.scatter(work, column_);
        operations.bringGhosts(work);
        operations.gather(column_, work);
        here_.col(k) = column_.template cast<double>();
      }
      operations.scatter(work, kept_);
    }
    // six rows of P' A P
    Eigen::Map<Eigen::Matrix<double, 6, Eigen::Dynamic>> rows(rows_.data(), 6, coarse_.cols());
    rows.setZero();
    for (std::size_t i = 0; i < layout.rows.size(); ++i)
      local.forEachInRow(int(layout.rows[i]), [&](int column, int slot, bool transposed) {
        auto const* const block = local.block(slot);
        Eigen::Matrix<double, B, B> a;
        for (int r = 0; r < B; ++r)
          for (int c = 0; c < B; ++c) a(r, c) = double(block[transposed ? c * B + r : r * B + c]);
        const Eigen::Matrix<double, B, 6> force = a * here_.template middleRows<B>(Eigen::Index(column) * B);
        rows.template middleCols<6>(6 * owner_[std::size_t(column)]).noalias() +=
            columns_.template middleRows<B>(Eigen::Index(i) * B).transpose() * force;
      });
    gather(operations, rows_, "the coarse matrix");
    // entry (i, j) of those of all ranks, six rows each
    auto entry = [&](Eigen::Index i, Eigen::Index j) {
      return all_[std::size_t(i / 6 * rows.size() + 6 * j + i % 6)];
    };
    for (Eigen::Index i = 0; i < coarse_.rows(); ++i)
      for (Eigen::Index j = 0; j < coarse_.cols(); ++j) coarse_(i, j) = 0.5 * (entry(i, j) + entry(j, i));
    for (Eigen::Index k = 0; k < coarse_.rows(); ++k)
      if (coarse_(k, k) == 0) coarse_(k, k) = 1;  // a motion that is left out
    factor_.compute(coarse_);
    hasCoarse_ = factor_.info() == Eigen::Success;
  }
};

}  // namespace sinew::mpi
