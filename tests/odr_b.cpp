// SPDX-License-Identifier: BSL-1.0
#include <sinew/sinew.hpp>

#include <sinew/sinew.hpp>
