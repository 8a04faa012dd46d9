// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <atomic>

/// Calls of operator new so far, all that the tests of collision allocate (no_allocation.cpp).
extern std::atomic<long> allocations;
