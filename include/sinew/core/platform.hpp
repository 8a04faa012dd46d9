// SPDX-License-Identifier: BSL-1.0
#pragma once

#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "Sinew: -ffast-math removes the checks for values that are not finite. Leave it away, speed does not need it; or add -fno-finite-math-only behind it, which keeps the checks."
#endif

/// SINEW_HD marks a function that a GPU kernel may call. It is the library's only macro besides SINEW_INLINE.
#if defined(__CUDACC__)
#define SINEW_HD __host__ __device__
#else
#define SINEW_HD
#endif

/// For the innermost functions, whose call would cost more than their body.
#define SINEW_INLINE SINEW_HD __attribute__((always_inline)) inline
