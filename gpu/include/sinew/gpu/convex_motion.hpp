// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/convex_problem.hpp>
#include <sinew/lagrangian/constrained_motion.hpp>
#include <sinew/lagrangian/convex_updates.hpp>
#include <sinew/solver/multi_vec.hpp>

#include <algorithm>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew::gpu {

template <class Operations, class MultiVec>
void assemble_on_device(Operations&, MatrixFactors, MultiVec&, MultiVec&);

/// What ConvexStep does, for bodies of points that are all on the device, over D: the system is assembled
/// there, and each convex problem is solved there by one kernel, with all iterations of Newton's method and
/// of conjugate gradients. The host has the rows of the constraints, and between two problems moves their
/// potentials (ConvexUpdates): it looks at violations and multipliers alone.
///
/// One object serves a scene for all its steps; memory grows only where a step has more points or rows than
/// any before.
template <class D>
class ConvexMotion {
 public:
  ConvexMotion() = default;
  ConvexMotion(ConvexMotion&&) = default;
  ConvexMotion& operator=(ConvexMotion&&) = default;
  // a copy of a body makes its own
  ConvexMotion(ConvexMotion const&) {}
  ConvexMotion& operator=(ConvexMotion const&) { return *this = ConvexMotion(); }

  /// Begins the step of bodies with so many points in all.
  void begin(int points) {
    bodies_.clear();
    q_ = {};
    q_.points = points;
    held_.resize(std::size_t(points));
    q_.held = held_.data();
  }

  /// The matrix of a solver's states is assembled, S = scale A; the first of its points is number `begin` of
  /// all. Takes two auxiliary vectors.
  template <class Operations>
  void addSystem(Operations& operations, MatrixFactors factors, double scale, int begin) {
    using Deriv = typename D::Deriv;
    MultiVecDeriv<Operations> unit(operations), column(operations);
    assemble_on_device(operations, factors, unit, column);
    operations.forEachIndependent([&](auto& s) {
      if constexpr (std::is_same_v<typename std::decay_t<decltype(s)>::DataTypes, D>)
        for_each_index(s.size(), typename ConvexProblem<D>::SetOnes{s[unit.id].overwrite()});
    });
    operations.projectResponse(unit.id);
    operations.forEachIndependent([&](auto& s) {
      if constexpr (std::is_same_v<typename std::decay_t<decltype(s)>::DataTypes, D>) {
        BlockRows<D> const& rows = s.solverWorkspace.rows;
        const int first = begin + s.dofOffset / 3;
        bodies_.push_back(
            {{rows.sliceFirst.device(), rows.column.device(), rows.values.data(), nullptr, nullptr},
             rows.diagonal.device(),
             first,
             int(s.size()),
             scale});
        Deriv const* const projected = std::as_const(s[unit.id]).device();
        for_each_index(s.size(), typename ConvexProblem<D>::TakeHeld{q_, projected, first});
      }
    });
  }

  /// The largest number on the diagonal of S.
  double largestDiagonal() {
    double largest = 0;
    for (MotionBody<D> const& b : bodies_) {
      DeviceVector<double> all(std::size_t(b.points));
      for_each_index(all.size(), LargestOfRow{b, all.overwrite()});
      for (const double one : std::as_const(all).host()) largest = std::max(largest, one);
    }
    return largest;
  }

  /// Leaves the motion and the multipliers in the rows. Throws Error as ConvexStep does.
  ConvexStepResult solve(MotionRows& rows, ConvexStepSettings const& settings, std::string_view where) {
    none_.setZero(rows.dofs);
    check_convex_step(none_, rows.jacobian, rows.blocks, rows.start, rows.motion, rows.multipliers, where);
    check_convex_step(settings, where);
    updates_.terms.begin(rows.jacobian, rows.blocks, rows.start, rows.multipliers, settings.friction);
    takeRows(rows);
    for_each_index(std::size_t(q_.all), typename ConvexProblem<D>::TakeSystem{q_});
    for_each_index(rows.blocks.size(), typename ConvexProblem<D>::EstimateCompliance{q_});
    const int n = rows.jacobian.rows();
    ConstraintTerms::clear(n, updates_.compliance);
    copy_to_host(updates_.compliance.data(), q_.compliance, std::size_t(n));
    check_movable(updates_.compliance.head(n), where);
    updates_.begin(settings);
    updates_.terms.evaluate(rows.motion);
    copy_to_device(q_.violation, updates_.terms.violation.data(), std::size_t(n));

    ConvexStepResult result;
    while (true) {
      const ConvexProblemResult found = solveProblem(settings, result, n);
      if (found.finite == 0) refuse_unbounded_step(where);
      result.momentum = found.momentum;
      result.residual = found.residual;
      result.newtonIterations += int(found.newtonIterations);
      result.conjugateGradients += int(found.conjugateGradients);
      result.lineSearches += int(found.lineSearches);
      result.converged =
          result.residual <= settings.tolerance && result.momentum <= settings.momentumTolerance;
      if (result.converged || found.stuck != 0 || result.updates == settings.maxUpdates) break;
      ++result.updates;
      updates_.update(settings, result.residual);
    }
    copy_to_host(rows.motion.data(), q_.velocity, std::size_t(rows.dofs));
    rows.multipliers = updates_.terms.multipliers.head(n);
    return result;
  }

  // what threads do
  struct LargestOfRow {
    MotionBody<D> b;
    double* to;
    SINEW_HD void operator()(int i) const {
      double largest = 0;
      for (int c = 0; c < 3; ++c) {
        const double d = b.scale * double(BlockRows<D>::at(b.product.values, b.diagonal[i], 4 * c));
        largest = d > largest ? d : largest;
      }
      to[i] = largest;
    }
  };

 private:
  ConvexUpdates updates_{};
  std::vector<MotionBody<D>> bodies_{};
  ConvexProblem<D> q_{};
  Eigen::VectorXd none_{};
  // of the rows, as they go to the device
  std::vector<int> ints_{}, entryOf_{}, next_{};
  std::vector<double> rowValues_{}, sent_{}, received_{};
  DeviceArray<int> intsThere_{};
  DeviceArray<double> rowsThere_{}, sentThere_{}, vectors_{}, receivedThere_{}, slackThere_{};
  DeviceArray<MotionBody<D>> bodiesThere_{};
  DeviceArray<ConstraintBlock> blocksThere_{};
  DeviceArray<unsigned char> held_{};
  Arrival<double> arrival_{};
  TeamMemory team_{};

  template <class T>
  static T* upload(DeviceArray<T>& to, std::vector<T> const& from) {
    to.resize(from.size());
    copy_to_device(to.data(), from.data(), from.size());
    return to.data();
  }

  // rows by blocks of constraints and points, and room for all else
  void takeRows(MotionRows const& rows) {
    const int slack = int(rows.slack.size());
    q_.bodies = int(bodies_.size());
    q_.body = upload(bodiesThere_, bodies_);
    q_.slack = upload(slackThere_, rows.slack);
    q_.all = q_.points + slack;
    q_.blocks = int(rows.blocks.size());
    q_.block = upload(blocksThere_, rows.blocks);

    // in ints_: ends, then point, slot and block of each entry, entries of each point, and which these are
    const auto all = std::size_t(q_.all), blocks = rows.blocks.size();
    entryOf_.assign(all, -1);
    rowValues_.clear();
    next_.clear();  // point, slot and block of each entry
    ints_.assign(1, 0);
    for (std::size_t k = 0; k < blocks; ++k) {
      ConstraintBlock const& b = rows.blocks[k];
      const std::size_t begin = next_.size();
      for (int i = 0; i < b.rows; ++i)
        rows.jacobian.forEachInRow(b.first + i, [&](int dof, double value) {
          int& slot = entryOf_[std::size_t(dof / 3)];
          if (slot < 0) {
            slot = int(rowValues_.size());
            next_.insert(next_.end(), {dof / 3, slot, int(k)});
            rowValues_.resize(rowValues_.size() + std::size_t(3 * b.rows), 0.);
          }
          rowValues_[std::size_t(slot + 3 * i + dof % 3)] += value;
        });
      for (std::size_t e = begin; e < next_.size(); e += 3) entryOf_[std::size_t(next_[e])] = -1;
      ints_.push_back(int(next_.size() / 3));
    }
    const std::size_t entries = next_.size() / 3;
    for (std::size_t part = 0; part < 3; ++part)
      for (std::size_t e = 0; e < entries; ++e) ints_.push_back(next_[3 * e + part]);
    const std::size_t ofPoint = ints_.size();
    ints_.resize(ofPoint + all + 1 + entries, 0);
    int* const first = ints_.data() + ofPoint;
    int* const entry = first + all + 1;
    for (std::size_t e = 0; e < entries; ++e) ++first[next_[3 * e] + 1];
    for (std::size_t i = 0; i < all; ++i) first[i + 1] += first[i];
    std::copy_n(first, all, entryOf_.begin());
    for (std::size_t e = 0; e < entries; ++e) entry[entryOf_[std::size_t(next_[3 * e])]++] = int(e);

    int const* at = upload(intsThere_, ints_);
    auto take = [&at](std::size_t n) { return std::exchange(at, at + n); };
    q_.ends = take(blocks + 1);
    q_.point = take(entries);
    q_.slot = take(entries);
    q_.blockOf = take(entries);
    q_.ofPoint = take(all + 1);
    q_.entry = take(entries);
    q_.rows = upload(rowsThere_, rowValues_);

    const auto n = std::size_t(rows.jacobian.rows());
    vectors_.resize((9 * 3 + 2 * 9) * all + 5 * n);
    double* v = vectors_.data();
    auto room = [&v](std::size_t count) { return std::exchange(v, v + count); };
    for (double** of : {&q_.velocity,
                        &q_.momentum,
                        &q_.gradient,
                        &q_.step,
                        &q_.residual,
                        &q_.scaled,
                        &q_.direction[0],
                        &q_.direction[1],
                        &q_.product})
      *of = room(3 * all);
    q_.system = room(9 * all);
    q_.inverse = room(9 * all);
    q_.compliance = room(n);
    q_.rate = room(n);
    q_.curvature = room(3 * n);
    // what goes to the host behind each problem
    constexpr std::size_t head = ConvexProblemResult::size + 1;
    receivedThere_.resize(head + 2 * n);
    q_.result = reinterpret_cast<ConvexProblemResult*>(receivedThere_.data());
    q_.violation = receivedThere_.data() + head;
    q_.multipliers = q_.violation + n;
  }

  ConvexProblemResult solveProblem(ConvexStepSettings const& s, ConvexStepResult const& so, int rows) {
    ConstraintTerms& terms = updates_.terms;
    const auto n = std::size_t(rows);
    sent_.clear();
    for (Eigen::VectorXd const* of :
         {&std::as_const(terms.regularisation), &std::as_const(terms.before), &terms.lagged()})
      sent_.insert(sent_.end(), of->data(), of->data() + rows);
    double* const there = upload(sentThere_, sent_);
    q_.regularisation = there;
    q_.before = there + n;
    q_.lagged = there + 2 * n;
    q_.lag = terms.lag();
    q_.momentumTolerance = s.momentumTolerance;
    q_.tolerance = s.tolerance;
    q_.reduction = s.reduction;
    q_.forcing = s.forcing;
    q_.maxNewtonIterations = s.maxNewtonIterations;
    q_.maxConjugateGradients = s.maxConjugateGradients - so.conjugateGradients;
    run_whole_team(std::size_t(q_.all), q_, team_);
    constexpr std::size_t head = ConvexProblemResult::size + 1;
    received_.resize(head + 2 * n);
    arrival_.begin(receivedThere_.data(), received_.size());
    arrival_.take(received_.data(), received_.size());
    std::copy_n(received_.data() + head, n, terms.violation.data());
    std::copy_n(received_.data() + head + n, n, terms.multipliers.data());
    double const* const f = received_.data();
    return {f[0], f[1], f[2], f[3], f[4], f[5], f[6]};
  }
};

}  // namespace sinew::gpu
