// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "options.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

/// The values that one attribute takes in a sweep, as words of scene files.
///   1:10:2             1 3 5 7 9: from 1 to 10 by 2, in decimal numbers, so that 0:1:0.1 has 0.3 and 1
///   1:4                by 1
///   lin:0:1:5          5 values from 0 to 1, of the same distance
///   log:1e3:1e6:4      4 values of the same ratio, to 12 digits
///   5,1:3,soft         these, one after the other
/// Throws sinew::Error: what is wrong, and what to write instead.
std::vector<std::string> sweep_values(std::string_view words);

/// Values that attributes take together: one attribute and its values, or the columns and rows of a table.
struct SweepAxis {
  std::vector<std::string> paths;              // "liver/fem.youngModulus"
  std::vector<std::vector<std::string>> rows;  // a value for each path
};

/// Each row of one axis with each of the others; the last axis changes fastest.
class Combinations {
 public:
  static constexpr std::size_t most = 1'000'000;

  /// From words of --set, path and values, and the table in a file (CSV: a line of paths, then lines of
  /// values; empty: none), whose rows change slowest. Throws Failure.
  Combinations(Settings const& set, std::string const& table);

  std::size_t size() const { return size_; }
  std::vector<std::string> const& paths() const { return paths_; }
  /// The values of a run, in the order of the paths.
  std::vector<std::string> values(std::size_t run) const;
  /// All of it, in words that another sweep does not have.
  std::string words() const;

 private:
  std::vector<SweepAxis> axes_{};
  std::vector<std::string> paths_{};
  std::size_t size_ = 1;
};

}  // namespace cli
