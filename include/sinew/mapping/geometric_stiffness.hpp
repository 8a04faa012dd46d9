// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <array>
#include <string_view>

namespace sinew {

/// What a mapping that is not linear adds to the stiffness of its parent, K_g = (dJ'/dx) f: nothing, all, or
/// what leaves a system of implicit Euler positive definite. SOFA's numbers stand for them too.
enum class GeometricStiffness { none, exact, stabilized };
inline constexpr std::array<std::string_view, 3> enum_names(GeometricStiffness) {
  return {"none", "exact", "stabilized"};
}
inline constexpr std::array<std::array<std::string_view, 2>, 6> enum_aliases(GeometricStiffness) {
  return {{{"0", "none"},
           {"1", "exact"},
           {"2", "stabilized"},
           {"None", "none"},
           {"Exact", "exact"},
           {"Stabilized", "stabilized"}}};
}

/// Whether that is added for what has the force f on it; what pushes has f > 0.
template <class Real>
constexpr bool adds_stiffness(GeometricStiffness which, Real f) {
  return which == GeometricStiffness::exact || (which == GeometricStiffness::stabilized && f < 0);
}

/// Of rigid bodies K_g is not symmetric, since rotations do not commute: nothing, or its symmetric part.
enum class RotationalStiffness { none, symmetrized };
inline constexpr std::array<std::string_view, 2> enum_names(RotationalStiffness) {
  return {"none", "symmetrized"};
}
inline constexpr std::array<std::array<std::string_view, 2>, 4> enum_aliases(RotationalStiffness) {
  return {{{"0", "none"}, {"2", "symmetrized"}, {"None", "none"}, {"Stabilized", "symmetrized"}}};
}

}  // namespace sinew
