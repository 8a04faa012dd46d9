// SPDX-License-Identifier: BSL-1.0
#pragma once

// Scenes composed while the program runs: RuntimeNode<Standard>, run by Simulation.
#include <sinew/registry.hpp>
#include <sinew/runtime/checks.hpp>
#include <sinew/runtime/scope.hpp>
