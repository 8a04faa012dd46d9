// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <atomic>

/// Calls of operator new so far, by which the tests of collision have all their memory.
extern std::atomic<long> allocations;
