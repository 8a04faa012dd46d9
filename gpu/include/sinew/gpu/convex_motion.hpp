// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/convex_problem.hpp>
#include <sinew/gpu/sent_list.hpp>
#include <sinew/gpu/team_solver.hpp>
#include <sinew/lagrangian/constrained_motion.hpp>
#include <sinew/lagrangian/convex_updates.hpp>
#include <sinew/solver/multi_vec.hpp>

#include <algorithm>
#include <cstring>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew::gpu {

template <class Operations, class MultiVec>
void assemble_on_device(Operations&, MatrixFactors, MultiVec&, MultiVec&);

/// What ConvexStep does, for bodies of points that are all on the device, over D: the convex problems are
/// solved there by one kernel, with all iterations of Newton's method and of conjugate gradients, and the
/// updates of the potentials between two problems. Where these are to be accelerated, or another part of
/// Coulomb's law is lagged, the host makes the update (ConvexUpdates), and the kernel goes on. What the free
/// motion has left of its equation, where its assembled system was solved there, is a part of the problem:
/// the linear solver may stop early. The host has the rows of the constraints.
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
    q_.system.points = points;
  }

  /// The matrix of a solver's states, assembled where its linear solver has not done so, S = scale A; the
  /// first of its points is number `begin` of all. Takes two auxiliary vectors.
  template <class Operations>
  void addSystem(Operations& operations, ConstraintFactors const& factors, double scale, int begin) {
    MultiVecDeriv<Operations> unit(operations), column(operations);
    const std::size_t first = bodies_.size();
    TeamSolver<D>* team = nullptr;
    auto eachState = [&](auto&& f) {
      operations.forEachIndependent([&](auto& s) {
        if constexpr (std::is_same_v<typename std::decay_t<decltype(s)>::DataTypes, D>) f(s);
      });
    };
    eachState([&](auto& s) {
      if (!team) team = &s.solverWorkspace.team;
    });
    if (!team->takeAssembled()) assemble_on_device(operations, factors.matrix, unit, column);
    int points = begin;
    eachState([&](auto& s) {
      bodies_.push_back(body_of<D>(s, std::exchange(points, points + int(s.size())), scale));
    });
    double const* const rest = team->takeRest();
    for (std::size_t k = first; rest && k < bodies_.size(); ++k) {
      bodies_[k].rest = rest + 3 * (bodies_[k].begin - begin);
      bodies_[k].restScale = 1 / factors.impulse;
    }
    take_held<D>(operations, unit, team->held(), bodies_, first);
  }

  /// The largest number on the diagonal of S.
  double largestDiagonal() {
    double largest = 0;
    for (SystemBody<D> const& b : bodies_) {
      DeviceVector<double> all(std::size_t(b.points));
      for_each_index(all.size(), LargestOfRow{b, all.overwrite()});
      for (const double one : std::as_const(all).host()) largest = std::max(largest, one);
    }
    return largest;
  }

  /// From `motion`, that of the step before, scaled. Leaves the multipliers in the rows, and the motion there
  /// and for give(). `byStates`: some violations at the start are not in the rows; put(to) has the device
  /// write them there, and rows get them where something is to be said of them. Throws Error as ConvexStep
  /// does.
  template <class Put>
  ConvexStepResult solve(MotionRows& rows, ConvexStepSettings const& settings, std::vector<double>& motion,
                         std::string_view where, bool byStates, Put&& put) {
    check_convex_step(settings, where);
    check_convex_guess(rows.start, rows.multipliers, where);
    const auto n = std::size_t(rows.jacobian.rows());
    takeRows(rows, where);
    takeMotion(rows.dofs, motion);
    q_.settings = settings;
    q_.progress = {};
    askedBefore_ = false;
    q_.progress.lag = settings.friction;
    sent_.assign(rows.start.data(), rows.start.data() + n);
    sent_.insert(sent_.end(), rows.multipliers.data(), rows.multipliers.data() + n);
    copy_to_device(exchanged_.data() + head, sent_.data(), sent_.size());
    if (byStates) put(exchanged_.data() + head);
    while (true) {
      run_whole_team(std::size_t(q_.system.all), q_, team_);
      arrival_.begin(exchanged_.data(), head + 2 * n);
      brought_.begin(q_.velocity, motion.size());
      receive(head + 2 * n);
      std::memcpy(static_cast<void*>(&q_.progress), received_.data(), sizeof(ConvexProgress));
      using Ends = ConvexProgress::Ends;
      const bool done = q_.progress.ends == Ends::done;
      if (byStates && (done ? !q_.progress.found.converged : q_.progress.ends != Ends::asks))
        rows.start = Eigen::Map<Eigen::VectorXd const>(received_.data() + head, Eigen::Index(n));
      if (done) break;
      askHost(rows, settings, where);
    }
    brought_.take(motion.data(), motion.size());
    broughtMotion_ = motion.size();
    rows.multipliers = Eigen::Map<Eigen::VectorXd const>(received_.data() + head + n, Eigen::Index(n));
    return q_.progress.found;
  }

  /// The motion of points from number `begin` on, times a factor; points over other DataTypes than D have
  /// none.
  template <class VecDeriv>
  void give(VecDeriv& to, int begin, double factor) const {
    if constexpr (std::is_same_v<VecDeriv, typename D::VecDeriv>)
      for_each_index(to.size(), Give{q_.velocity + 3 * begin, to.overwrite(), factor});
  }
  // what threads do
  struct Give {
    double const* from;
    typename D::Deriv* to;
    double by;
    SINEW_HD void operator()(int i) const {
      for (int c = 0; c < 3; ++c) to[i][c] = typename D::Real(by * from[3 * i + c]);
    }
  };
  struct LargestOfRow {
    SystemBody<D> b;
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
  // what goes to the host behind the problems: the progress, then a number each row of the vectors that the
  // host may ask for
  static constexpr std::size_t head = (sizeof(ConvexProgress) + sizeof(double) - 1) / sizeof(double);
  static constexpr std::size_t mayBeAsked = 7;

  ConvexUpdates updates_{};
  std::vector<SystemBody<D>> bodies_{};
  ConvexProblem<SystemOfBodies<D>> q_{};
  // of the rows, as they go to the device
  MotionRows last_{};
  std::vector<int> ints_{}, entryOf_{}, next_{};
  std::vector<double> rowValues_{}, sent_{}, received_{};
  SentList<SystemBody<D>> bodiesThere_{};
  SentList<int> intsThere_{};
  SentList<double> rowsThere_{}, slackThere_{};
  SentList<ConstraintBlock> blocksThere_{};
  DeviceArray<double> velocity_{}, vectors_{}, exchanged_{};
  Arrival<double> arrival_{}, brought_{};
  std::size_t broughtMotion_ =
      0;  // how many numbers of the motion are the same in brought_ and on the device
  TeamMemory team_{};
  std::size_t pairs_ = 0;
  bool askedBefore_ = false;  // in this step

  // the first so many numbers of what is exchanged, which are on their way
  void receive(std::size_t count) {
    received_.resize(std::max(received_.size(), count));
    arrival_.take(received_.data(), count);
  }
  // the motion to begin with, if it is not that which the device has left there; 0 where degrees of freedom
  // came or went
  void takeMotion(int dofs, std::vector<double>& motion) {
    const auto n = std::size_t(dofs);
    if (motion.size() != n) motion.assign(n, 0);
    if (broughtMotion_ == n && std::memcmp(motion.data(), brought_.data(), n * sizeof(double)) == 0) return;
    velocity_.resize(n);
    q_.velocity = velocity_.data();
    copy_to_device(q_.velocity, motion.data(), n);
    broughtMotion_ = 0;
  }

  // an update that the kernel leaves to the host, or an error
  void askHost(MotionRows const& rows, ConvexStepSettings const& settings, std::string_view where) {
    using Ends = ConvexProgress::Ends;
    ConvexProgress& now = q_.progress;
    if (now.ends == Ends::unbounded) refuse_unbounded_step(where);
    const Eigen::Index n = rows.jacobian.rows();
    arrival_.begin(exchanged_.data(), head + mayBeAsked * std::size_t(n));
    receive(head + mayBeAsked * std::size_t(n));
    double const* from = received_.data() + head + n;  // behind the violation at rest
    auto next = [&] { return Eigen::Map<Eigen::VectorXd const>(std::exchange(from, from + n), n); };
    ConstraintTerms& terms = updates_.terms;
    terms.begin(rows.jacobian, rows.blocks, rows.start, rows.multipliers, now.lag);
    ConstraintTerms::clear(n, updates_.compliance);
    terms.multipliers.head(n) = next();
    terms.violation.head(n) = next();
    terms.before.head(n) = next();
    terms.setLagged(next());
    terms.regularisation.head(n) = next();
    updates_.compliance.head(n) = next();
    if (now.ends == Ends::immovable) check_movable(updates_.compliance.head(n), where);
    if (!std::exchange(askedBefore_, true)) updates_.forget();
    updates_.schedule = now.schedule;
    updates_.update(settings, now.found.residual);
    ++now.found.updates;
    now.schedule = updates_.schedule;
    now.lag = terms.lag();
    now.ends = Ends::done;
    sent_.clear();
    for (Eigen::VectorXd const* of :
         {&std::as_const(terms.before), &terms.lagged(), &std::as_const(terms.regularisation)})
      sent_.insert(sent_.end(), of->data(), of->data() + n);
    copy_to_device(q_.before, sent_.data(), sent_.size());
  }

  bool isLast(MotionRows const& rows) const {
    auto same = [](auto const& a, auto const& b) {
      return a.size() == b.size() &&
             (a.empty() ||
              std::memcmp(static_cast<void const*>(a.data()), b.data(), a.size() * sizeof(a[0])) == 0);
    };
    return last_.dofs == rows.dofs && same(last_.jacobian.first, rows.jacobian.first) &&
           same(last_.jacobian.dofs, rows.jacobian.dofs) &&
           same(last_.jacobian.values, rows.jacobian.values) && same(last_.blocks, rows.blocks) &&
           same(last_.slack, rows.slack);
  }
  // rows by blocks of constraints and points, and room for all else; where they are as in the last step, so
  // is what the device has of them
  void takeRows(MotionRows const& rows, std::string_view where) {
    q_.system.bodies = int(bodies_.size());
    q_.system.body = bodiesThere_.send(bodies_);
    if (isLast(rows)) return;
    check_convex_rows(rows.dofs, rows.jacobian, rows.blocks, rows.start, rows.multipliers, where);
    last_.jacobian = rows.jacobian;
    last_.blocks = rows.blocks;
    last_.slack = rows.slack;
    last_.dofs = rows.dofs;
    q_.system.slack = slackThere_.send(rows.slack);
    q_.system.all = q_.system.points + int(rows.slack.size());
    q_.blocks = int(rows.blocks.size());
    q_.block = blocksThere_.send(rows.blocks);
    sendEntries(rows);
    makeRoom(std::size_t(rows.jacobian.rows()), pairs_);
  }

  // in ints_: ends; point, slot and block of each entry; entries of each point, and which these are; the same
  // of the pairs
  void sendEntries(MotionRows const& rows) {
    const auto all = std::size_t(q_.system.all), blocks = rows.blocks.size();
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
    const std::size_t ofPoint = ints_.size(), entry = ofPoint + all + 1, ofPairs = entry + entries;
    ints_.resize(ofPairs + all + 1, 0);
    for (std::size_t e = 0; e < entries; ++e) ++ints_[ofPoint + std::size_t(next_[3 * e]) + 1];
    for (std::size_t i = 0; i < all; ++i) ints_[ofPoint + i + 1] += ints_[ofPoint + i];
    std::copy_n(ints_.begin() + std::ptrdiff_t(ofPoint), all, entryOf_.begin());
    for (std::size_t e = 0; e < entries; ++e)
      ints_[entry + std::size_t(entryOf_[std::size_t(next_[3 * e])]++)] = int(e);
    pairs_ = 0;
    for (std::size_t i = 0; i < all; ++i) {
      for (int k = ints_[ofPoint + i]; k < ints_[ofPoint + i + 1]; ++k) {
        const int own = ints_[entry + std::size_t(k)], block = next_[std::size_t(3 * own + 2)];
        for (int other = ints_[std::size_t(block)]; other < ints_[std::size_t(block) + 1]; ++other, ++pairs_)
          ints_.insert(ints_.end(), {own, other});
      }
      ints_[ofPairs + i + 1] = int(pairs_);
    }
    const std::size_t pairs = ofPairs + all + 1;
    for (std::size_t k = 0; k < pairs_; ++k)
      ints_.push_back(next_[std::size_t(3 * ints_[pairs + 2 * k + 1])]);
    int const* at = intsThere_.send(ints_);
    auto take = [&at](std::size_t n) { return std::exchange(at, at + n); };
    q_.entries.ends = take(blocks + 1);
    q_.entries.point = take(entries);
    q_.entries.slot = take(entries);
    q_.entries.blockOf = take(entries);
    q_.entries.ofPoint = take(all + 1);
    q_.entries.entry = take(entries);
    q_.entries.pairsOfPoint = take(all + 1);
    q_.entries.pair = take(2 * pairs_);
    q_.entries.pointOfPairs = take(pairs_);
    q_.rows = rowsThere_.send(rowValues_);
  }
  void makeRoom(std::size_t rows, std::size_t pairs) {
    const auto all = std::size_t(q_.system.all);
    exchanged_.resize(head + mayBeAsked * rows);
    double* v = exchanged_.data() + head;
    auto room = [&v](std::size_t count) { return std::exchange(v, v + count); };
    q_.progressThere = reinterpret_cast<ConvexProgress*>(exchanged_.data());
    q_.start = room(rows);
    for (double** of :
         {&q_.multipliers, &q_.violation, &q_.before, &q_.lagged, &q_.regularisation, &q_.compliance})
      *of = room(rows);
    vectors_.resize((3 * 3 + 3 * GradientVectors::count + 2 * 9) * all + 5 * rows + 9 * pairs);
    v = vectors_.data();
    for (double** of : {&q_.momentum, &q_.gradient, &q_.goodVelocity}) *of = room(3 * all);
    q_.newton = GradientVectors::in(room(3 * GradientVectors::count * all), all);
    q_.diagonal = room(9 * all);
    q_.inverse = room(9 * all);
    q_.rate = room(rows);
    q_.goodMultipliers = room(rows);
    q_.curvature = room(3 * rows);
    q_.coupling = room(9 * pairs);
  }
};

}  // namespace sinew::gpu
