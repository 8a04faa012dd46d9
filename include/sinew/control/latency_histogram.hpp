// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace sinew {

/// Counts of durations [ns] in buckets of which each octave has eight, so that a percentile is known to an
/// eighth. Of fixed size: nothing is allocated, up to 18 minutes.
class LatencyHistogram {
 public:
  static constexpr int buckets = 312;

  void add(std::int64_t nanoseconds) {
    const std::uint64_t ns = std::uint64_t(std::max<std::int64_t>(nanoseconds, 0));
    ++counts_[std::size_t(std::min(bucket(ns), buckets - 1))];
    ++count_;
    sum_ += double(ns);
    worst_ = std::max(worst_, ns);
  }

  std::int64_t count() const { return count_; }
  double worst() const { return double(worst_) * 1e-9; }  // s, exact
  double mean() const { return count_ > 0 ? sum_ / double(count_) * 1e-9 : 0; }
  /// The time [s] that a part p of all durations (0.999) did not exceed, at most an eighth too large.
  double percentile(double p) const {
    std::int64_t seen = 0;
    for (int i = 0; i < buckets; ++i) {
      seen += counts_[std::size_t(i)];
      if (seen > 0 && double(seen) >= p * double(count_)) return std::min(bound(i + 1) * 1e-9, worst());
    }
    return worst();
  }
  /// How many were at least `low` and less than `high` [s]; exact at bounds of buckets.
  std::int64_t between(double low, double high) const {
    std::int64_t n = 0;
    for (int i = 0; i < buckets; ++i)
      if (bound(i) * 1e-9 >= low && bound(i) * 1e-9 < high) n += counts_[std::size_t(i)];
    return n;
  }

  static int bucket(std::uint64_t ns) {
    if (ns < 8) return int(ns);
    const int octave = 63 - std::countl_zero(ns);
    return (octave - 2) * 8 + int((ns >> (octave - 3)) & 7);
  }
  /// Lower bound of a bucket [ns].
  static double bound(int i) { return i < 8 ? double(i) : double(std::uint64_t(8 + i % 8) << (i / 8 - 1)); }

 private:
  std::array<std::int64_t, buckets> counts_{};
  std::int64_t count_ = 0;
  double sum_ = 0;
  std::uint64_t worst_ = 0;
};

}  // namespace sinew
