// SPDX-License-Identifier: BSL-1.0
// Of sinew::compiled: files, meshes and matrices.
#include <sinew/core/compiled.hpp>

#undef SINEW_DEFINES
#define SINEW_DEFINES 1
#include "base.hpp"

template <>
char const sinew::detail::CompiledForAlignment<EIGEN_MAX_ALIGN_BYTES>::mark = 0;
