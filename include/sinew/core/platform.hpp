// SPDX-License-Identifier: BSL-1.0
#pragma once

// What a compiler must grant, asked before all else: each header of Sinew has this one first. The include
// that cannot be found ends the compilation, so that the sentence is not followed by hundreds of errors.
#if __cplusplus < 202002L
#error "Sinew: C++20 is needed. Compile with -std=c++20, by g++ 12, clang 14 or nvcc 13, or later ones."
#include <sinew/see_the_error_above>
#endif
#if !defined(__cpp_exceptions)
#error "Sinew: exceptions are needed, since errors in a scene are thrown. Remove -fno-exceptions."
#include <sinew/see_the_error_above>
#endif
#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error \
    "Sinew: -ffast-math removes the checks for values that are not finite. Remove it, since speed does not need it; or add -fno-finite-math-only behind it, which keeps the checks."
#include <sinew/see_the_error_above>
#endif

#if defined(__EMSCRIPTEN__)
#include <sinew/core/emscripten.hpp>
#endif

/// SINEW_HD marks a function that a GPU kernel may call; SINEW_ANY_SIDE before a template says that it calls
/// functions of its arguments, which need not be for a GPU where it is not called there. The library's other
/// macros are SINEW_INLINE, and those of compiled.hpp and version.hpp.
#if defined(__CUDACC__)
#define SINEW_HD __host__ __device__
#define SINEW_ANY_SIDE _Pragma("nv_exec_check_disable")
#else
#define SINEW_HD
#define SINEW_ANY_SIDE
#endif

/// For the innermost functions, whose call would cost more than their body.
#define SINEW_INLINE SINEW_HD __attribute__((always_inline)) inline
