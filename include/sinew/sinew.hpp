// SPDX-License-Identifier: BSL-1.0
#pragma once

// Bodies, contacts by penalties, engines and control. A program compiles faster with the parts that it uses.
// Beside it: <sinew/lagrangian.hpp>, constraints by multipliers; a GPU, haptics and what needs another
// package.
#include <sinew/contact.hpp>
#include <sinew/control.hpp>
#include <sinew/engines.hpp>
#include <sinew/mechanics.hpp>
