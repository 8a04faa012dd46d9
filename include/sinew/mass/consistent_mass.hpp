// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/assembly.hpp>
#include <sinew/core/component.hpp>
#include <sinew/linalg/block_matrix.hpp>

#include <cstddef>
#include <vector>

namespace sinew {

/// A mass for each pair of points, times the identity: the loops behind MeshMatrixMass and
/// HexahedronCompositeFEMMass.
template <class D>
struct ConsistentMass {
  using Real = typename D::Real;
  using VecDeriv = typename D::VecDeriv;

  CompressedRowSparseMatrix<Real, 1> matrix{};  // [kg], on and above the diagonal; empty where it is lumped
  std::vector<int> slots{};                     // of its blocks, in the matrix of the solver

  bool empty() const { return matrix.columns.empty(); }

  /// f += factor M dx
  void addMDx(VecDeriv& f, VecDeriv const& dx, double factor) const {
    forEachPair([&](std::size_t i, std::size_t j, Real m) {
      f[i] += Real(factor) * m * dx[j];
      if (i != j) f[j] += Real(factor) * m * dx[i];
    });
  }
  double kineticEnergy(VecDeriv const& v) const {
    double sum = 0;
    forEachPair([&](std::size_t i, std::size_t j, Real m) {
      sum += (i == j ? 0.5 : 1) * double(m * v[i].dot(v[j]));
    });
    return sum;
  }

  template <class Sink>
  void addToMatrix(MechanicalParams const& p, Sink const& sink) {
    if constexpr (Sink::direct && Sink::MatrixType::blockSize == D::size &&
                  Sink::phase != AssemblyPhase::pattern) {
      const int offset = sink.template side<0>().offset, first = offset / D::size;
      if constexpr (Sink::phase == AssemblyPhase::bind) slots.clear();
      if (offset % D::size == 0 && (Sink::phase == AssemblyPhase::bind || !slots.empty())) {
        std::size_t next = 0;
        for (int i = 0; i < matrix.rows(); ++i)
          for (int k = matrix.rowStart[std::size_t(i)]; k < matrix.rowStart[std::size_t(i) + 1]; ++k)
            if constexpr (Sink::phase == AssemblyPhase::bind) {
              slots.push_back(sink.matrix.slot(first + i, first + matrix.columns[std::size_t(k)]));
            } else {
              auto* const block = sink.matrix.block(slots[next++]);
              const auto m = typename Sink::MatrixType::Real(p.m * double(matrix.values[std::size_t(k)]));
              for (int c = 0; c < D::size; ++c) block[c * (D::size + 1)] += m;
            }
        return;
      }
    }
    if constexpr (Sink::phase != AssemblyPhase::bind)
      forEachPair([&](std::size_t i, std::size_t j, Real m) {
        const Mat<Real, D::size> block = Mat<Real, D::size>::Identity() * Real(p.m * double(m));
        sink.add(int(i), int(j), block);
        if (i != j) sink.add(int(j), int(i), block);
      });
  }

 private:
  // f(i, j, mass) for each pair of points i <= j
  template <class F>
  void forEachPair(F&& f) const {
    for (std::size_t i = 0; i < std::size_t(matrix.rows()); ++i)
      for (std::size_t k = std::size_t(matrix.rowStart[i]); k < std::size_t(matrix.rowStart[i + 1]); ++k)
        f(i, std::size_t(matrix.columns[k]), matrix.values[k]);
  }
};

}  // namespace sinew
