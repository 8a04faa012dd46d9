// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <atomic>

/// Allocations so far by operator new or malloc, of all threads.
extern std::atomic<long> allocations;
