// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <cstddef>

namespace sinew {

/// Of a loop over elements: all of them, or those between points of this process alone, which can be taken
/// while ghost points are under way from others, or the rest.
enum class Elements { all, inner, outer };

/// The share of a loop that one of several threads does: number `index` of `count` shares of about the same
/// size. Work that needs what all shares have done is of a later `pass`, which begins when all are through
/// with the one before. Of loops over elements, what several shares add to one place is added in a second
/// pass, in the order of the whole loop: the bits of a result do not depend on the number of threads.
struct WorkShare {
  int index = 0, count = 1;
  int pass = 0;
  Elements elements = Elements::all;

  /// Of n things, those from begin(n) to end(n).
  std::size_t begin(std::size_t n) const { return n * std::size_t(index) / std::size_t(count); }
  std::size_t end(std::size_t n) const { return n * std::size_t(index + 1) / std::size_t(count); }
};

/// Runs the whole work in the thread of the caller, for scenes without threads of their own; Workers
/// (workers.hpp) share it out among threads.
struct OneThread {
  static constexpr int count() { return 1; }
  template <class F>
  static void run(F&& f) {
    f(WorkShare{});
  }
  static void reserveSums(std::size_t) {}
  static double* sums() { return nullptr; }
};

/// A component whose addForce, addDForce and addToMatrix do the share of the work that their parameters ask
/// for.
template <class C>
inline constexpr bool shares_work = requires { requires C::sharesWork; };
/// In how many passes; two, unless the component has `passes`.
template <class C>
constexpr int work_passes() {
  if constexpr (requires { C::passes; })
    return C::passes;
  else
    return 2;
}
/// Tells a component, or its driver, for how many shares at once it may be asked.
template <class C>
void split_work(C& c, int most) {
  if constexpr (requires { c.split(most); })
    c.split(most);
  else
    c.driver.split(most);
}
/// For how many it wants to be asked.
template <class C>
int work_shares(C const& c) {
  if constexpr (requires { c.shares; })
    return c.shares;
  else
    return c.driver.shares;
}

}  // namespace sinew
