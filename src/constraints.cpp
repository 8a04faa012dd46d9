// SPDX-License-Identifier: BSL-1.0
// Of sinew::compiled: what solves problems of constraints.
#include <sinew/core/compiled.hpp>
#include <sinew/core/error.hpp>

#undef SINEW_DEFINES
#define SINEW_DEFINES 1
#include "constraints.hpp"
