// SPDX-License-Identifier: BSL-1.0
// What nearly every test includes, compiled once.
#pragma once

#include "catch.hpp"

#include <sinew/sinew.hpp>
