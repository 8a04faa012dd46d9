// SPDX-License-Identifier: BSL-1.0
#include "flags.hpp"

int answer();
int answer() { return 42; }

namespace sinew {
template <>
char const LibraryFlags::here = 0;
}  // namespace sinew
