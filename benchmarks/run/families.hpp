// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace bench {

/// A thing to be timed: `run` goes once over `count` elements (springs, tetrahedra, points...).
struct Work {
  std::string family, operation;
  std::size_t count;
  std::function<void()> run;
};

/// What each translation unit instantiates for its DataTypes.
std::vector<Work> in_double();
std::vector<Work> in_double_one_by_one();
std::vector<Work> in_float();
std::vector<Work> in_float_one_by_one();

}  // namespace bench
