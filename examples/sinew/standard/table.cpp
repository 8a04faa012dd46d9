// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/precompiled.hpp>

namespace sinew {
template std::vector<ClassInfo> make_class_table<Standard>();
}  // namespace sinew
