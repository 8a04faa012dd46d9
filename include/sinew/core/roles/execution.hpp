// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/role.hpp>

namespace sinew {

// By which threads the solvers of its node and below work: Threads is the one that there is.

template <class C>
concept Execution = HasRole<C, role::Execution> && requires(C c) {
  c.init();
  c.workers();
};

template <>
struct Promise<role::Execution> : NoPromise {
  template <class C>
  static constexpr bool kept = Execution<C>;
  template <class C>
  struct Broken {
    static_assert(
        Execution<C>,
        "Sinew: a component with role::Execution has no 'void init()', or no 'workers() const', which "
        "gives what core/workers.hpp has.");
  };
};

}  // namespace sinew
