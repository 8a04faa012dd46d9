// SPDX-License-Identifier: BSL-1.0
#pragma once

// What plays, records or pulls at a scene while it runs.
#include <sinew/scene/mouse_interactor.hpp>

// All components of control:
#include <sinew/control/interventional_radiology_controller.hpp>
#include <sinew/control/multi_step_animation_loop.hpp>
#include <sinew/control/read_state.hpp>
#include <sinew/control/step_callback.hpp>
#include <sinew/control/threads.hpp>
#include <sinew/control/write_state.hpp>
