// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

/// Functions that are no templates are compiled with each program, or once into the library sinew::compiled,
/// for whose users SINEW_COMPILED is defined. A header declares them on top and defines them below, as
/// SINEW_ONCE, between `#if SINEW_DEFINES` and `#endif`, with what only they include. The sources of the
/// library set SINEW_DEFINES before the headers whose functions are theirs.
#if !defined(SINEW_COMPILED)

#define SINEW_DEFINES 1
#define SINEW_ONCE inline

#else

#define SINEW_DEFINES 0
#define SINEW_ONCE

#include <Eigen/Core>

namespace sinew::detail {

/// Linking fails where a program and the library see Eigen's types with different alignments, as with and
/// without -mavx.
template <int Alignment>
struct CompiledForAlignment {
  static char const mark;
};
template <>
char const CompiledForAlignment<EIGEN_MAX_ALIGN_BYTES>::mark;
__attribute__((used)) inline char const* const compiledForAlignment =
    &CompiledForAlignment<EIGEN_MAX_ALIGN_BYTES>::mark;

}  // namespace sinew::detail

#endif
