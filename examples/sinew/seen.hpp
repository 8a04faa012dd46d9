// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scene.hpp"

#include <sinew/view/seen_scene.hpp>
#include <sinew/view/view_settings.hpp>

namespace cli {

/// What is to be seen of a scene: what its file says, and what the command line asks for besides. Throws
/// Failure where the command line is wrong.
sinew::view::ViewSettings seen_settings(SeenOptions const& options, Scene& scene);

}  // namespace cli

namespace sinew::view {

extern template SeenScene seen_scene(StandardSimulation&, SeenSettings const&, KnownBorders*);  // in seen.cpp

}  // namespace sinew::view
