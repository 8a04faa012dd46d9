// SPDX-License-Identifier: BSL-1.0
#pragma once

// What plays, records or pulls at a scene while it runs.
#include <sinew/control/read_state.hpp>
#include <sinew/control/write_state.hpp>
#include <sinew/scene/mouse_interactor.hpp>
