// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <string>
#include <vector>

namespace sinew {

/// A member of a class, as C++ names it and its type: "restPosition", "std::vector<Vec<double, 3>>".
struct CppMember {
  std::string name, type;
};
/// The members of each class of a registry that are fields: classes in the order of make_class_table(),
/// members in that of ClassInfo::fields. The body is in bake.hpp; the library sinew::standard has that of
/// Standard.
template <class R>
std::vector<std::vector<CppMember>> cpp_members();

}  // namespace sinew
