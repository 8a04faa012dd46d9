// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/sent_list.hpp>
#include <sinew/gpu/system_rows.hpp>
#include <sinew/gpu/team_gradients.hpp>
#include <sinew/gpu/whole_team.hpp>

#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew::gpu {

/// Notes which coordinates projective constraints hold of the bodies of a solver, which are the last of a
/// list from one on; false where these do anything else to a motion. Needs an auxiliary vector, and room for
/// what is noted.
template <class D, class Operations, class MultiVec>
bool take_held(Operations&, MultiVec& room, DeviceArray<unsigned char>& held,
               std::vector<SystemBody<D>>& bodies, std::size_t first);

/// The assembled matrix of a state, whose first point has this number.
template <class D, class State>
SystemBody<D> body_of(State const& s, int begin, double scale) {
  BlockRows<D> const& rows = s.solverWorkspace.rows;
  return {{rows.sliceFirst.device(), rows.column.device(), rows.values.data(), nullptr, nullptr},
          rows.diagonal.device(),
          begin,
          int(s.size()),
          scale,
          nullptr,
          nullptr,
          0};
}

/// The bodies of one linear solver that are all points over D, their assembled system solved as one kernel.
/// What that leaves of the right-hand side is known until the next solution.
template <class D>
class TeamSolver {
 public:
  TeamSolver() = default;
  TeamSolver(TeamSolver&&) = default;
  TeamSolver& operator=(TeamSolver&&) = default;
  // a copy of a body makes its own
  TeamSolver(TeamSolver const&) {}
  TeamSolver& operator=(TeamSolver const&) { return *this = TeamSolver(); }

  /// x by conjugate gradients, behind the assembly; false where it is not for this: larger bodies are faster
  /// by a launch for each product. `room` is an auxiliary vector.
  template <class Operations, class Solver, class MultiVec>
  bool solve(Operations& operations, Solver const& solver, double threshold, MultiVec& x, MultiVec& b,
             MultiVec& room) {
    bodies_.clear();
    sides_.clear();
    int points = 0;
    bool can = true;
    operations.forEachIndependent([&](auto& s) {
      if constexpr (std::is_same_v<typename std::decay_t<decltype(s)>::DataTypes, D>) {
        bodies_.push_back(body_of<D>(s, points, 1));
        sides_.push_back({std::as_const(s[b.id]).device(), s[x.id].overwrite()});
        points += int(s.size());
      } else {
        can = false;
      }
    });
    if (!can || !has_row_for_each(std::size_t(points))) return false;
    if (!take_held<D>(operations, room, held_, bodies_, 0)) return false;
    memory_.resize(3 * GradientVectors::count * std::size_t(points));
    SystemGradients<D> system{};
    system.system = {bodiesThere_.send(bodies_), int(bodies_.size()), points, points, nullptr};
    system.sides = sidesThere_.send(sides_);
    system.vectors = GradientVectors::in(memory_.data(), std::size_t(points));
    system.tolerance2 = solver.tolerance * solver.tolerance;
    system.threshold = threshold;
    system.iterations = solver.iterations;
    run_whole_team(std::size_t(points), system, team_);
    residual_ = system.vectors.residual;
    known_ = assembled_ = true;
    return true;
  }

  /// The same is known of a solution that was found otherwise, with the residual r; `assembled`: by the rows
  /// of the bodies.
  template <class Operations, class MultiVec>
  void leave(Operations& operations, MultiVec const& r, bool assembled) {
    std::size_t points = 0;
    bool can = true;
    operations.forEachIndependent([&](auto& s) {
      can = can && std::is_same_v<typename std::decay_t<decltype(s)>::DataTypes, D>;
      points += s.size();
    });
    known_ = can;
    assembled_ = can && assembled;
    if (!can) return;
    memory_.resize(3 * points);
    double* to = memory_.data();
    residual_ = to;
    operations.forEachIndependent([&](auto& s) {
      if constexpr (std::is_same_v<typename std::decay_t<decltype(s)>::DataTypes, D>) {
        for_each_index(s.size(), TakeVector{std::as_const(s[r.id]).device(), to});
        to += 3 * s.size();
      }
    });
  }

  /// What the bodies of the solver hold, for who has found that there is something.
  DeviceArray<unsigned char>& held() { return held_; }

  /// b - A x of the last solution, three numbers a point; null where there has been none since this was asked
  /// for.
  double const* takeRest() { return std::exchange(known_, false) ? residual_ : nullptr; }
  /// Whether the rows of the bodies have been assembled for that.
  bool takeAssembled() { return std::exchange(assembled_, false); }

  // what threads do
  struct TakeVector {
    typename D::Deriv const* from;
    double* to;
    SINEW_HD void operator()(int i) const {
      for (int c = 0; c < 3; ++c) to[3 * i + c] = double(from[i][c]);
    }
  };

 private:
  std::vector<SystemBody<D>> bodies_{};
  std::vector<typename SystemGradients<D>::Sides> sides_{};
  SentList<SystemBody<D>> bodiesThere_{};
  SentList<typename SystemGradients<D>::Sides> sidesThere_{};
  DeviceArray<unsigned char> held_{};
  DeviceArray<double> memory_{};
  TeamMemory team_{};
  double const* residual_ = nullptr;
  bool known_ = false, assembled_ = false;
};

}  // namespace sinew::gpu
