// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/linalg/block_copy.hpp>
#include <sinew/linalg/block_ldl.hpp>
#include <sinew/linalg/held_modes.hpp>
#include <sinew/linalg/multigrid_level.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace sinew {

struct MultigridSettings {
  int levels = 10;         // at most
  int coarsestSize = 200;  // unknowns up to which a level is solved by its factor
  double threshold = 0.05;
  int degree = 2;
  int cycles = 1;  // of a coarse level in one of the level above: 1 V, 2 W
};

/// z = M^-1 r by one cycle, V or W, of smoothed aggregation (Vanek, Mandel, Brezina 1996) for a symmetric
/// block matrix with a near null space of up to six modes: Chebyshev smoothing before and behind, Galerkin
/// products, the coarsest level by its factor. It is symmetric, and positive definite where the matrix is.
/// The first update finds aggregates and patterns, later ones fill them, without allocating unless points
/// have come to be held, or are held no more. Bits do not depend on the number of threads.
class Multigrid {
 public:
  using Row = Sixes<double>::Row;
  MultigridSettings settings{};
  /// Modes of the unknowns, each six numbers and two more, in the order of the matrix: what update() reads.
  std::vector<Row> modes{};

  MultigridLevel<3> fine{};
  std::vector<MultigridLevel<6>> coarse{};

  int levels() const { return int(coarse.size()) + 1; }

  /// The pattern of the matrix.
  template <class Matrix, class Run>
  void init(Matrix const& a, Run const& workers) {
    copy.init(a, fine.matrix);
    fine.init(workers);
    modes.assign(fine.modes.size(), Row{});
    alone.clear();
    looked = false;
    reset();
  }
  /// Finds aggregates and patterns anew at the next update.
  void reset() { known = built = false; }

  /// The values of the matrix, with the modes.
  template <class Matrix, class Run>
  void update(Run const& workers, Matrix const& a) {
    load(workers, a);
    std::copy(modes.begin(), modes.end(), fine.modes.begin());
    fine.update(workers);
    holdModes(workers);
    if (!finite) return;
    if (!built) {
      coarse.clear(), coarse.reserve(std::size_t(settings.levels));
      again = known && alone == firstAlone;
      finds = !known;
      if (finds) firstAlone = alone, first.clear();
      if (!std::exchange(looked, true)) embedded = find_lattice(places());
      if (!again && even()) lattice = embedded;
      known = true;
    }
    bool more = next(workers, fine, 0);
    for (std::size_t k = 0; more; ++k) more = next(workers, coarse[k], k + 1);
    const bool direct = coarse.empty() ? solvable(fine.matrix) : solvable(coarse.back().matrix);
    if (direct && coarse.empty())
      factorise(fineFactor, fine.matrix);
    else if (direct)
      factorise(coarseFactor, coarse.back().matrix);
    built = true;
    lattice = {};
  }

  /// Of vectors of as many numbers as the matrix has.
  template <class Run, class Vector>
  void apply(Run const& workers, Vector const& from, Vector& to) {
    const Eigen::Index n = dofs;
    double sum = 0;
    for (Eigen::Index i = 0; i < n; ++i) sum += double(from[i]) * double(from[i]);
    const double scale = size / std::sqrt(sum);  // numbers of about 1, whatever the units
    if (!finite || !(sum > 0) || !std::isfinite(scale)) {
      to = from;
      return;
    }
    const int rows = fine.matrix.rows();
    share_rows(workers, rows, [&](int i, int) {
      const Eigen::Vector3d r = scale * (fine.unit.inverse[std::size_t(i)] * threeOf(from, i));
      for (int c = 0; c < 3; ++c) fine.r[std::size_t(3 * i + c)] = float(r[c]);
    });
    cycle(workers, fine, 0);
    share_rows(workers, rows, [&](int i, int) {
      const Eigen::Vector3d x(double(fine.x[std::size_t(3 * i)]),
                              double(fine.x[std::size_t(3 * i + 1)]),
                              double(fine.x[std::size_t(3 * i + 2)]));
      const Eigen::Vector3d z = fine.unit.inverse[std::size_t(i)].transpose() * x / scale;
      for (int c = 0; c < 3 && 3 * i + c < dofs; ++c) to[3 * i + c] = typename Vector::Scalar(z[c]);
    });
  }

 private:
  BlockCopy copy{};
  std::vector<char> alone{}, nowAlone{};  // rows with nothing beside their diagonal block
  BlockLdl<CompressedRowSparseMatrix<double, 3>> fineFactor{};
  BlockLdl<CompressedRowSparseMatrix<double, 6>> coarseFactor{};
  Eigen::VectorXd load_{}, found_{};  // of the coarsest level
  int dofs = 0;
  double size = 1;  // root of the mean of the diagonal
  bool built = false, finite = true;
  // Of the first update: where the same points are held as then, they are taken again, so that a scene that
  // is reset has the same bits.
  std::vector<Aggregates> first{};
  std::vector<char> firstAlone{};
  bool known = false, again = false, finds = false;  // there are those; they are taken; they are looked for
  Lattice embedded{};                                // where the points were at the first update after init
  bool looked = false;
  Lattice lattice{};  // of the level that is looked at, then of the one below

  template <class Vector>
  Eigen::Vector3d threeOf(Vector const& v, int i) const {
    Eigen::Vector3d three = Eigen::Vector3d::Zero();
    for (int c = 0; c < 3 && 3 * i + c < dofs; ++c) three[c] = double(v[3 * i + c]);
    return three;
  }
  // where the points are, by their rotations, v = w x x; of unknowns that are no points in space, not numbers
  std::vector<Eigen::Vector3d> places() const {
    std::vector<Eigen::Vector3d> all;
    for (std::size_t i = 0; i + 2 < modes.size(); i += 3) {
      Row const* const m = &modes[i];
      const Eigen::Vector3d x(m[1][5], m[2][3], m[0][4]);
      const Row expected[3] = {
          {1, 0, 0, 0, x[2], -x[1]}, {0, 1, 0, -x[2], 0, x[0]}, {0, 0, 1, x[1], -x[0], 0}};
      bool point = true;
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 6; ++c) point = point && m[r][c] == expected[r][c];
      all.push_back(point ? x : Eigen::Vector3d(Eigen::Vector3d::Constant(NAN)));
    }
    return all;
  }
  // Whether cells may be aggregates: not where stiffness jumps, since they do not keep to its borders. A
  // corner of a body has a hundredth of the stiffness of its middle at least.
  bool even() const {
    double softest = 0, stiffest = std::numeric_limits<double>::max();  // |W|^2, of 1 / stiffness
    for (std::size_t i = 0; i < alone.size(); ++i) {
      if (alone[i]) continue;
      softest = std::max(softest, fine.unit.inverse[i].squaredNorm());
      stiffest = std::min(stiffest, fine.unit.inverse[i].squaredNorm());
    }
    return softest <= 100 * stiffest;
  }
  template <class Matrix>
  bool solvable(Matrix const& a) const {
    return a.dofs() <= std::max(settings.coarsestSize, Matrix::blockSize);
  }

  template <class Run, class Matrix>
  void load(Run const& workers, Matrix const& a) {
    dofs = a.dofs();
    copy.load(workers, a, fine.matrix);
    auto const& m = fine.matrix;
    double sum = 0, all = 0;
    for (int i = 0; i < m.rows(); ++i)
      for (int c = 0; c < 3; ++c)
        sum += std::abs(m.values[std::size_t(9 * m.rowStart[std::size_t(i)] + 4 * c)]);
    for (const double value : m.values) all += value;
    size = std::sqrt(sum / (3.0 * m.rows()));
    finite = std::isfinite(all) && std::isfinite(size) && size > 0;
  }

  template <class Run>
  void holdModes(Run const& workers) {
    nowAlone.resize(std::size_t(fine.matrix.rows()));
    hold_modes(workers, fine.matrix, fine.modes, nowAlone);
    if (nowAlone != alone) {
      alone = nowAlone;
      built = false;
    }
  }

  // the level below; false where there is none
  template <class Run, int R>
  bool next(Run const& workers, MultigridLevel<R>& level, std::size_t index) {
    if (!built) {
      if (solvable(level.matrix) || int(index) + 1 >= settings.levels) return false;
      auto& below = coarse.emplace_back();
      if (again && index >= first.size()) return coarse.pop_back(), false;
      if (!level.down.init(level.matrix,
                           R == 3 ? alone : std::vector<char>{},
                           settings.threshold,
                           workers.count(),
                           below.matrix,
                           lattice,
                           again ? &first[index] : nullptr))
        return coarse.pop_back(), false;
      if (finds) first.push_back({level.down.aggregate, level.down.coarseRows()});
      below.init(workers);
    } else if (index >= coarse.size()) {
      return false;
    }
    auto& below = coarse[index];
    level.down.orthogonalise(workers, level.modes, below.modes);
    level.down.smooth(workers, level.matrix, 4 / (3 * level.bound));
    level.down.galerkin.update(workers, level.matrix, level.down, below.matrix);
    below.update(workers);
    level.down.scale(workers, below.unit.inverse);
    return true;
  }

  template <class Factor, class Matrix>
  void factorise(Factor& factor, Matrix const& a) {
    if (!built) {
      factor.init(a, a.dofs());
      load_.setZero(a.dofs());
      found_.setZero(a.dofs());
    }
    // as for other preconditioners (Manteuffel 1980)
    for (double shift = 0; shift<1e3; shift = shift> 0 ? 2 * shift : 1e-3)
      if (factor.factorise(a, shift) < 0 && factor.negativePivots == 0) return;
  }

  // One cycle: x from 0 where it is `fresh`, else on from what it is, of which r is the residual.
  template <class Run, int R>
  void cycle(Run const& workers, MultigridLevel<R>& level, std::size_t index, bool fresh = true) {
    if (index == coarse.size()) {
      if (!solvable(level.matrix)) return level.smooth(workers, 2 * settings.degree, fresh, false, false);
      constexpr int stride = MultigridLevel<R>::stride;
      for (int i = 0; i < level.matrix.rows(); ++i)
        for (int c = 0; c < R; ++c) load_[R * i + c] = double(level.r[std::size_t(stride * i + c)]);
      if constexpr (R == 3)
        fineFactor.solve(load_, found_);
      else
        coarseFactor.solve(load_, found_);
      for (int i = 0; i < level.matrix.rows(); ++i)
        for (int c = 0; c < R; ++c) level.x[std::size_t(stride * i + c)] = float(found_[R * i + c]);
      return;
    }
    auto& below = coarse[index];
    level.smooth(workers, settings.degree, fresh, false, true);
    level.down.restrictTo(workers, level.r.data(), MultigridLevel<R>::stride, below.r.data());
    const bool exact = index + 1 == coarse.size() && solvable(below.matrix);
    const int cycles = exact ? 1 : settings.cycles;
    if (cycles > 1) below.b = below.r;
    for (int k = 0; k < cycles; ++k) {
      if (k > 0) below.residual(workers);
      cycle(workers, below, index + 1, k == 0);
    }
    level.down.prolong(workers, below.x.data(), level.d.data(), MultigridLevel<R>::stride);
    level.add(workers);
    level.multiply(workers);
    level.smooth(workers, settings.degree, false, true, false);
  }
};

}  // namespace sinew
