// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "bodies.hpp"

#include <string>
#include <vector>

namespace examples {

/// What the scene looks like at some time, as a panel of a picture.
struct LaparoscopyPanel {
  std::string title{};
  std::vector<Eigen::Vector3d> liver{}, intestines{};  // points of the skins
  std::vector<Eigen::Vector3d> shaft{};                // of the tool
};

/// Writes panels side by side as an SVG file, seen from the front, the feet and the left: liver in red,
/// intestines in yellow, both whiter the farther they are from where they were made, ribs in grey, the tool
/// in blue. The wall is left out. Throws sinew::Error.
void write_picture(LaparoscopyBodies const& bodies, std::vector<LaparoscopyPanel> const& panels,
                   std::string const& path);

}  // namespace examples
