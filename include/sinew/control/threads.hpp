// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/workers.hpp>

#include <memory>
#include <utility>

namespace sinew {

/// How many threads of the processor do the steps of the solvers in this node and below: the product with an
/// assembled matrix of 3 x 3 blocks, vectors of solvers, and forces, tangents and matrices of elements of
/// one body that are taken in lanes. A step has the same bits with any number of threads. Bodies of less than
/// about a thousand points or elements are left to one thread, since they would wait longer than they work.
struct Threads {
  using Role = role::Execution;
  static constexpr std::string_view className = "Threads";

  int count = 1;

  static constexpr auto fields() {
    return field_list(
        field("count", &Threads::count, "", "threads, that of the caller included", range::closed(1, 256)));
  }

  /// What runs them, started at init; each copy of a scene has its own.
  struct Pool {
    std::unique_ptr<Workers> workers{};

    Pool() = default;
    Pool(Pool&&) = default;
    Pool& operator=(Pool&&) = default;
    Pool(Pool const& other) : workers(other.workers ? new Workers(other.workers->count()) : nullptr) {
      if (workers) workers->reserveSums(other.workers->sumCount());
    }
    Pool& operator=(Pool const& other) { return *this = Pool(other); }
  };
  Pool pool{};

  void init() {
    if (pool.workers && pool.workers->count() == count) return;
    pool.workers.reset(count > 1 ? new Workers(count) : nullptr);
  }
  SomeWorkers workers() const { return {pool.workers.get()}; }
};

}  // namespace sinew
