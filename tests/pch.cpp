// SPDX-License-Identifier: BSL-1.0
// A target that compiles pch.hpp needs a file of its own.
#include "pch.hpp"
