// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "flags.hpp"

[[gnu::used]] static char const* const asked_of_the_library = &LibraryFlags::here;

int answer();
