// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

// The version of these headers, which the CMake project reads here.
#define SINEW_VERSION_MAJOR 0
#define SINEW_VERSION_MINOR 1
#define SINEW_VERSION_PATCH 0
/// All of it as text, "1.2.3".
#define SINEW_VERSION SINEW_VERSION_TEXT(SINEW_VERSION_MAJOR, SINEW_VERSION_MINOR, SINEW_VERSION_PATCH)
#define SINEW_VERSION_TEXT(major, minor, patch) SINEW_VERSION_TEXT_OF(major, minor, patch)
#define SINEW_VERSION_TEXT_OF(major, minor, patch) #major "." #minor "." #patch
