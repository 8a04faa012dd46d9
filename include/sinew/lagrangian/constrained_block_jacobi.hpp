// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/lagrangian/constraint_terms.hpp>
#include <sinew/linalg/block_inverse.hpp>

#include <Eigen/Core>

#include <array>
#include <utility>
#include <vector>

namespace sinew {

/// Block Jacobi of A + J' G J: z = D^-1 r with the B x B diagonal blocks D of the sum, one of each point. It
/// has J in blocks of B columns, and so the products with J' G J, too.
template <int B>
class ConstrainedBlockJacobi {
 public:
  using Block = Eigen::Matrix<double, B, B>;

  /// Diagonal blocks of A, positive definite; set before each solution.
  std::vector<Block> system{};

  int dofs() const { return B * int(system.size()); }

  /// Takes rows for one solution. `compliance`: an estimate of the diagonal of W, that of J D_A^-1 J'.
  void begin(ConstraintTerms const& terms, Eigen::VectorXd& compliance) {
    gather(terms);
    sum_.resize(system.size());
    inverse_.resize(system.size());
    for (std::size_t i = 0; i < system.size(); ++i) invert(system[i], inverse_[i]);
    ConstraintTerms::clear(terms.rows().rows(), compliance);
    for (std::size_t k = 0; k < terms.blocks().size(); ++k) {
      ConstraintBlock const& b = terms.blocks()[k];
      for (std::size_t e = ends_[k]; e < ends_[k + 1]; ++e) {
        Block const& inverse = inverse_[std::size_t(point_[e])];
        for (int i = 0; i < b.rows; ++i) {
          const Eigen::Map<Eigen::Matrix<double, B, 1> const> row(rows_.data() + slot_[e] + B * i);
          compliance[b.first + i] += row.dot(inverse * row);
        }
      }
    }
  }

  /// Takes G as it is now.
  void update(ConstraintTerms const& terms) {
    for (const int i : touched_) sum_[std::size_t(i)] = system[std::size_t(i)];
    for (std::size_t k = 0; k < terms.blocks().size(); ++k) {
      ConstraintBlock const& b = terms.blocks()[k];
      double const* G = terms.curvature(b);
      acts_[k] = false;
      for (int i = 0; i < (b.kind == ConstraintBlock::Kind::friction ? 9 : b.rows); ++i)
        if (G[i] != 0) acts_[k] = true;
      for (std::size_t e = ends_[k]; e < ends_[k + 1] && acts_[k]; ++e) {
        Block& of = sum_[std::size_t(point_[e])];
        if (b.kind == ConstraintBlock::Kind::friction) {
          const Contact J(rows_.data() + slot_[e]);
          of.noalias() += (J * Eigen::Map<contact_potential::Curvature const>(G)).eval() * J.transpose();
        } else {
          const Rows rows(rows_.data() + slot_[e], B, b.rows);
          for (int i = 0; i < b.rows; ++i)
            if (G[i] != 0) of.noalias() += (rows.col(i) * G[i]) * rows.col(i).transpose();
        }
      }
    }
    for (const int i : touched_) invert(sum_[std::size_t(i)], inverse_[std::size_t(i)]);
  }

  /// q += J' G J p, with G as of the last update.
  void addProduct(ConstraintTerms const& terms, Eigen::VectorXd const& p, Eigen::VectorXd& q) const {
    for (std::size_t k = 0; k < terms.blocks().size(); ++k) {
      if (!acts_[k]) continue;
      ConstraintBlock const& b = terms.blocks()[k];
      if (b.kind == ConstraintBlock::Kind::friction) {
        Eigen::Vector3d w(0, 0, 0);
        for (std::size_t e = ends_[k]; e < ends_[k + 1]; ++e)
          w.noalias() += Contact(rows_.data() + slot_[e]).transpose() * p.template segment<B>(B * point_[e]);
        w = (Eigen::Map<contact_potential::Curvature const>(terms.curvature(b)) * w).eval();
        for (std::size_t e = ends_[k]; e < ends_[k + 1]; ++e)
          q.template segment<B>(B * point_[e]).noalias() += Contact(rows_.data() + slot_[e]) * w;
      } else {
        std::array<double, ConstraintBlock::maxRows> w{};
        for (std::size_t e = ends_[k]; e < ends_[k + 1]; ++e)
          for (int i = 0; i < b.rows; ++i)
            w[std::size_t(i)] +=
                Rows(rows_.data() + slot_[e], B, b.rows).col(i).dot(p.template segment<B>(B * point_[e]));
        contact_potential::multiply(b, terms.curvature(b), w.data());
        for (std::size_t e = ends_[k]; e < ends_[k + 1]; ++e)
          for (int i = 0; i < b.rows; ++i)
            q.template segment<B>(B * point_[e]) +=
                w[std::size_t(i)] * Rows(rows_.data() + slot_[e], B, b.rows).col(i);
      }
    }
  }

  void apply(Eigen::VectorXd const& r, Eigen::VectorXd& z) const {
    for (std::size_t i = 0; i < inverse_.size(); ++i) {
      const auto at = Eigen::Index(i) * B;
      z.template segment<B>(at).noalias() = inverse_[i] * r.template segment<B>(at);
    }
  }

 private:
  // rows of J over one point, transposed: those of a contact, and any
  using Contact = Eigen::Map<Eigen::Matrix<double, B, 3> const>;
  using Rows = Eigen::Map<Eigen::Matrix<double, B, Eigen::Dynamic> const>;

  std::vector<Block> sum_{}, inverse_{};
  // the rows of each block of constraints, as blocks of B columns of the points that they have
  std::vector<std::size_t> ends_{}, slot_{};
  std::vector<int> point_{};
  std::vector<double> rows_{};
  std::vector<int> entry_{};                // of each point in the block at hand
  std::vector<int> touched_{};              // points that have rows
  std::vector<char> isTouched_{}, acts_{};  // acts: G is not 0

  static void invert(Block const& a, Block& inverse) {
    if (!invert_definite(a, inverse)) invert_diagonal(a, inverse);
  }
  void gather(ConstraintTerms const& terms) {
    ends_.assign(1, 0);
    slot_.clear();
    point_.clear();
    rows_.clear();
    entry_.assign(system.size(), -1);
    touched_.clear();
    isTouched_.assign(system.size(), false);
    acts_.assign(terms.blocks().size(), false);
    for (ConstraintBlock const& b : terms.blocks()) {
      const std::size_t begin = point_.size();
      for (int i = 0; i < b.rows; ++i)
        terms.rows().forEachInRow(b.first + i, [&](int dof, double value) {
          int& entry = entry_[std::size_t(dof / B)];
          if (entry < 0) {
            entry = int(point_.size());
            point_.push_back(dof / B);
            slot_.push_back(rows_.size());
            rows_.resize(rows_.size() + std::size_t(B * b.rows), 0.);
          }
          rows_[slot_[std::size_t(entry)] + std::size_t(B * i + dof % B)] += value;
        });
      for (std::size_t e = begin; e < point_.size(); ++e) {
        entry_[std::size_t(point_[e])] = -1;
        if (!std::exchange(isTouched_[std::size_t(point_[e])], true)) touched_.push_back(point_[e]);
      }
      ends_.push_back(point_.size());
    }
  }
};

}  // namespace sinew
