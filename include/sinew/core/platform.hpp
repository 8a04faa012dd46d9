// SPDX-License-Identifier: BSL-1.0
#pragma once

/// SINEW_HD marks a function that a GPU kernel may call. It is the library's only macro besides SINEW_INLINE.
#if defined(__CUDACC__)
#define SINEW_HD __host__ __device__
#else
#define SINEW_HD
#endif

/// For the innermost functions, whose call would cost more than their body.
#define SINEW_INLINE SINEW_HD __attribute__((always_inline)) inline
