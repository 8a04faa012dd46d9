// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/bake/classes.hpp>
#include <sinew/runtime/precompiled.hpp>

namespace sinew {
template std::vector<std::vector<CppMember>> cpp_members<Standard>();
}  // namespace sinew
