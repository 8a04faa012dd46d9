// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/same_flags.hpp>

struct the_library;
enum with_an_option : int {};
#ifndef OPTION
#define OPTION 0
#endif
using LibraryFlags = sinew::flags_of_this_file<the_library, with_an_option(OPTION)>;
