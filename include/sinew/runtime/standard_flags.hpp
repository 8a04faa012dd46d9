// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/same_flags.hpp>

namespace sinew {

struct sinew_standard;
enum with_hulls : int {};  ///< SINEW_CCD, which programs get by linking sinew::standard in CMake

/// What a program and the library sinew::standard have in common, or it does not link.
using StandardFlags = flags_of_this_file<sinew_standard,
#ifdef SINEW_CCD
                                         with_hulls(1)
#else
                                         with_hulls(0)
#endif
                                         >;

}  // namespace sinew
