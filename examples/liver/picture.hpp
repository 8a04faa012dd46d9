// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "options.hpp"

namespace examples {

/// Writes an SVG file with the skin at rest and the skin as it is at `time`, brighter the farther it has
/// moved. Throws sinew::Error.
void write_picture(sinew::Mesh const& atRest, sinew::Mesh const& now, double time, std::string const& path);

}  // namespace examples
