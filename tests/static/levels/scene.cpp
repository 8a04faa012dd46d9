// SPDX-License-Identifier: BSL-1.0
// A library that is there once for each level of x86-64, as docs/performance.md has it.
#include <sinew/core/lanes.hpp>

extern "C" int lanes_of_doubles() { return sinew::native_width<double>; }
