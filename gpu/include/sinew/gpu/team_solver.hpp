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

/// Notes, a bit for each direction, which coordinates of the points below a solver projective constraints
/// hold; false where these do anything else to a motion. Needs an auxiliary vector.
template <class D, class Operations, class MultiVec>
bool take_held(Operations&, MultiVec& room, unsigned char* held);

/// The assembled matrix of a state, whose first point has this number.
template <class D, class State>
SystemBody<D> body_of(State const& s, int begin, double scale) {
  BlockRows<D> const& rows = s.solverWorkspace.rows;
  return {{rows.sliceFirst.device(), rows.column.device(), rows.values.data(), nullptr, nullptr},
          rows.diagonal.device(),
          begin,
          int(s.size()),
          scale};
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

  /// x by conjugate gradients, behind the assembly; false where it is not for this. `room` is an auxiliary
  /// vector.
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
    if (!can) return false;
    held_.resize(std::size_t(points));
    if (!take_held<D>(operations, room, held_.data())) return false;
    memory_.resize(3 * GradientVectors::count * std::size_t(points));
    SystemGradients<D> system{};
    system.system = {bodiesThere_.send(bodies_), int(bodies_.size()), points, points, nullptr, held_.data()};
    system.sides = sidesThere_.send(sides_);
    system.vectors = GradientVectors::in(memory_.data(), std::size_t(points));
    system.tolerance2 = solver.tolerance * solver.tolerance;
    system.threshold = threshold;
    system.iterations = solver.iterations;
    run_whole_team(std::size_t(points), system, team_);
    residual_ = system.vectors.residual;
    fresh_ = true;
    return true;
  }

  /// b - A x of the last solution, three numbers a point, with the matrix as it is in the rows of the bodies;
  /// null where there has been none since this was asked for.
  double const* takeRest() { return std::exchange(fresh_, false) ? residual_ : nullptr; }

 private:
  std::vector<SystemBody<D>> bodies_{};
  std::vector<typename SystemGradients<D>::Sides> sides_{};
  SentList<SystemBody<D>> bodiesThere_{};
  SentList<typename SystemGradients<D>::Sides> sidesThere_{};
  DeviceArray<unsigned char> held_{};
  DeviceArray<double> memory_{};
  TeamMemory team_{};
  double const* residual_ = nullptr;
  bool fresh_ = false;
};

}  // namespace sinew::gpu
