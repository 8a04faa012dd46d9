// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "eye.hpp"

namespace examples {

/// The membranes at some time, as a panel of a picture.
struct Panel {
  std::string title{};
  std::vector<Eigen::Vector3d> position{};
  std::vector<sinew::Spring> uncut{};
};

/// Writes panels side by side as an SVG file: the eye from above, retina in green, scar in blue, springs that
/// can be cut in red, points that are held in black; displacements are drawn `exaggeration` times as large.
/// Throws sinew::Error.
void write_picture(Eye const& eye, std::vector<Panel> const& panels, double exaggeration,
                   std::string const& path);

}  // namespace examples
