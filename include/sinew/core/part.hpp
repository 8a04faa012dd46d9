// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <cstddef>

namespace sinew {

/// The part of a work that one of several threads does: the `index`th of `count` of about the same size. What
/// several parts add to one place is added in a second pass, `late`, in the order of the work as a whole: the
/// bits of a result do not depend on how many parts there are.
struct Part {
  int index = 0, count = 1;
  bool late = false;

  /// Of n things, those from begin(n) to end(n).
  std::size_t begin(std::size_t n) const { return n * std::size_t(index) / std::size_t(count); }
  std::size_t end(std::size_t n) const { return n * std::size_t(index + 1) / std::size_t(count); }
};

/// What runs parts where a scene has no threads but that of its caller; Workers, which it has otherwise, are
/// in workers.hpp.
struct OneThread {
  static constexpr int count() { return 1; }
  template <class F>
  static void run(F&& f) {
    f(Part{});
  }
  static void reserveSums(std::size_t) {}
  static double* sums() { return nullptr; }
};

/// A component whose addForce, addDForce and addToMatrix do the part that their parameters ask for.
template <class C>
inline constexpr bool takes_parts = requires {
  requires C::takesParts;
};

}  // namespace sinew
