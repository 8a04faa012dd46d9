// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "options.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace cli {

/// "1 run", "2 runs"
std::string amount(std::size_t n, std::string_view one, std::string_view many);

/// What a sweep comes to, and how the program says it.
class SweepSummary {
 public:
  std::size_t before = 0, done = 0;  // runs of this part: in the table already, and simulated now
  double seconds = 0;
  bool interrupted = false;
  int ranks = 1;

  SweepSummary(SweepOptions const& options, std::string output, std::size_t runs, std::size_t part)
      : options_(options), output_(std::move(output)), runs_(runs), part_(part) {}

  std::size_t part() const { return part_; }
  /// A run, counted from 0, has ended with this line of the table.
  void count(std::size_t run, std::string_view line);

  void printStart() const;
  void printEnd() const;
  /// The result of a sweep that ends by an error.
  void printFailure(std::vector<std::string> const& errors) const;

 private:
  SweepOptions const& options_;
  std::string output_;
  std::size_t runs_, part_, failed_ = 0, firstFailed_ = 0;
  std::string firstError_{};

  std::string json(std::vector<std::string> const& errors) const;
};

}  // namespace cli
