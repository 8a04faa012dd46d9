// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

namespace sinew::view {

/// An image on a surface (read_texture.hpp).
struct SeenTexture {
  std::string path{};
  int width = 0, height = 0;
  std::vector<unsigned char> rgba{};  // of 8 bits, from the upper left pixel on, row by row
  std::string file{};                 // the same as PNG or JPEG
};

/// What faces are made of, by its name in a library of materials.
struct SeenMaterial {
  std::string library{}, name{};
  Eigen::Vector3d colour{0.8, 0.8, 0.8};  // red, green, blue from 0 to 1
  Eigen::Vector3d specular{0, 0, 0};      // of what is mirrored
  double shininess = 1;                   // the exponent of Blinn's model
  double opacity = 1;
  std::shared_ptr<SeenTexture const> texture{};  // times the colour; or none
};

}  // namespace sinew::view
