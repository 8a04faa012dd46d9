// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/standard_flags.hpp>

namespace sinew {
template <>
char const StandardFlags::here = 0;
}  // namespace sinew
