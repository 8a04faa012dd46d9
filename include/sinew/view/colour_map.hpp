// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace sinew::view {

/// The colours of viridis (Smith, van der Walt 2015) at equal steps: rising in lightness, evenly to the eye,
/// also to one that tells red from green badly.
inline constexpr std::array<std::array<int, 3>, 9> viridis{{{68, 1, 84},
                                                            {71, 45, 123},
                                                            {59, 82, 139},
                                                            {44, 114, 142},
                                                            {33, 145, 140},
                                                            {40, 174, 128},
                                                            {94, 201, 98},
                                                            {173, 220, 48},
                                                            {253, 231, 37}}};

/// The colour of a value from 0 to 1, red, green, blue; grey of what is no number.
inline Eigen::Vector3d colour_of_value(double value) {
  if (!std::isfinite(value)) return {0.6, 0.6, 0.6};
  const double at = std::clamp(value, 0., 1.) * double(viridis.size() - 1);
  const std::size_t k = std::min(std::size_t(at), viridis.size() - 2);
  Eigen::Vector3d colour;
  for (std::size_t c = 0; c < 3; ++c)
    colour[Eigen::Index(c)] = (viridis[k][c] + (at - double(k)) * (viridis[k + 1][c] - viridis[k][c])) / 255;
  return colour;
}

}  // namespace sinew::view
