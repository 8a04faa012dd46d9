// SPDX-License-Identifier: BSL-1.0
#pragma once

// All of Sinew that needs no other package than Eigen and Boost.Hana. A program compiles faster with the
// parts that it uses.
#include <sinew/contact.hpp>
#include <sinew/control.hpp>
#include <sinew/engines.hpp>
#include <sinew/lagrangian.hpp>
#include <sinew/mechanics.hpp>
