// SPDX-License-Identifier: BSL-1.0
#pragma once

// Catch2 v3 where it is installed, else v2 (Debian 12).
#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
using Catch::Approx;
#else
#include <catch2/catch.hpp>
#endif

// Code without optimisation takes up to 10 times as long, and sanitized 25 times: tests that are no more than
// many of the same are shorter there, and those with the tag [long] left out.
#if !defined(__OPTIMIZE__) || defined(__SANITIZE_ADDRESS__)
inline constexpr bool brief = true;
#elif defined(__has_feature)
inline constexpr bool brief = __has_feature(address_sanitizer);
#else
inline constexpr bool brief = false;
#endif
