// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <vector>

namespace bench {

/// Time of some work by the clock [s], for what several threads do together.
template <class Work>
double seconds(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The same of the processor time of this thread: where other work runs on the machine, it counts less.
template <class Work>
double processor_seconds(Work&& work) {
  auto now = [] {
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
  };
  const double start = now();
  work();
  return now() - start;
}

inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

struct Pair {
  double first, second, ratio;  // median seconds of each, and the median of first/second round by round
};

/// Runs a and b in turn, so that a machine whose speed drifts slows both; one warm-up each.
template <class A, class B>
Pair paired(int rounds, A&& a, B&& b) {
  a();
  b();
  std::vector<double> first, second, ratio;
  for (int r = 0; r < rounds; ++r) {
    first.push_back(processor_seconds(a));
    second.push_back(processor_seconds(b));
    ratio.push_back(first.back() / second.back());
  }
  return {median(first), median(second), median(ratio)};
}

}  // namespace bench
