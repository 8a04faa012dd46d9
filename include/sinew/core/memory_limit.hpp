// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/error.hpp>

#include <atomic>
#include <cstddef>
#include <string>
#include <string_view>

namespace sinew {

/// The most memory that a grid of a scene may take, with a body over it [bytes]. A number of points that was
/// mistyped is refused by it; who means it raises the limit. The program sinew has a lower one.
inline std::atomic<std::size_t> memory_limit{std::size_t(1) << (sizeof(std::size_t) > 4 ? 33 : 31)};

/// What a point of a grid takes, about: the vectors of its state, lists of the elements around it, and what a
/// force field keeps of a cell [bytes].
inline constexpr std::size_t bytesOfGridPoint = 2048;

/// "3.2 GB".
std::string memory_text(double bytes);

/// Throws Error where so many points of `what` would take more than memory_limit.
void check_memory(std::string_view where, std::string_view what, double points);

}  // namespace sinew

#if SINEW_DEFINES
namespace sinew {

SINEW_ONCE std::string memory_text(double bytes) {
  char number[40];
  std::string_view unit = "GB";
  double value = bytes / 1e9;
  if (value < 1) value *= 1000, unit = "MB";
  return std::string(number, std::size_t(__builtin_snprintf(number, sizeof number, "%.3g ", value)))
      .append(unit);
}

SINEW_ONCE void check_memory(std::string_view where, std::string_view what, double points) {
  const double bytes = points * double(bytesOfGridPoint);
  if (!(bytes > double(memory_limit.load()))) return;
  throw Error(
      where,
      text(what,
           " would take ",
           memory_text(bytes),
           ", and the limit is ",
           memory_text(double(memory_limit.load())),
           "; make it coarser, or raise the limit (sinew::memory_limit; --max-memory of the program)"));
}

}  // namespace sinew
#endif
