// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/execution.hpp>

#include <cstddef>

namespace sinew::gpu {

/// The team of a fused step as a ConvexProblem asks for one (WholeTeam): each thread has the points of its
/// rows, and the blocks of constraints of these.
template <class Team>
class ProblemTeam {
 public:
  static constexpr int lanes = Team::lanes;

  /// A team with rows from `begin` to `end` of `all`; `room`: shared memory for sums (joint_buffer_size).
  SINEW_INLINE ProblemTeam(Team const& team, int begin, int end, int all, double* room)
      : team_(team), begin_(begin), end_(end), all_(all), room_(room) {}

  /// f(i) for i = 0 .. n - 1, n a multiple of the number of rows: those of a row in its threads.
  template <class F>
  SINEW_INLINE void each(int n, F&& f) const {
    const int ofRow = n / all_;
    eachRow(all_, [&](int row, int lane) {
      for (int k = lane; k < ofRow; k += lanes) f(row * ofRow + k);
    });
  }
  /// f(row, lane) by the threads that share a row.
  template <class F>
  SINEW_INLINE void eachRow(int, F&& f) const {
    for (int t = team_.thread; t < (end_ - begin_) * lanes; t += team_.threads)
      f(begin_ + t / lanes, t % lanes);
  }
  SINEW_INLINE int firstRow() const {
    const int row = begin_ + team_.thread / lanes;
    return row < end_ ? row : -1;
  }
  template <int N>
  SINEW_INLINE void sumOfRow(double (&value)[N]) const {
    for (double& v : value) v = team_.rowSum(v);
  }
  SINEW_INLINE void syncRows() const { team_.syncRows(); }
  SINEW_INLINE void sync() const { team_.sync(); }
  /// The sums of the first numbers of all threads, and the largest of the others, in each of them; what was
  /// written before is seen by all.
  template <int Sums, int N>
  SINEW_INLINE void reduce(double (&value)[N]) const {
    team_.template join<Sums>(value, room_);
  }
  SINEW_INLINE bool first() const { return team_.rank == 0 && team_.thread == 0; }

 private:
  Team const& team_;
  int begin_, end_, all_;
  double* room_;
};

}  // namespace sinew::gpu
