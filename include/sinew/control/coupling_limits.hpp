// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew {

/// A handle of mass m [kg] and damping b [N s/m], held by nobody, or of inertia [kg m^2] and [N m s/rad].
struct DeviceDynamics {
  double mass, damping;
};

/// Largest stiffness [N/m] of a virtual coupling to a tool that is held fast for which the device gives off
/// no energy, whatever the hand does: b > K T/2 + |B| (Colgate and Schenkel 1997, Passivity of a class of
/// sampled-data systems), where B is the coupling's damping from the difference of two positions and T the
/// period of the loop. 0 where no stiffness is passive.
inline double passive_stiffness(double deviceDamping, double damping, double period) {
  return std::max(0.0, 2 * (deviceDamping - std::abs(damping)) / period);
}

/// Largest stiffness [N/m] for which the device alone, coupled to a tool that is held fast, comes to rest.
/// With f[n] = -K x[n] - B (x[n] - x[n-1]) / T held over a period, and the exact motion of the handle
/// between,
///   x[n+1] = x[n] + p v[n] + q f[n],  v[n+1] = e v[n] + r f[n],  e = exp(-b T / m),
/// the poles are the roots of z^3 + (q (K+d) - 1 - e) z^2 + (e - q d + s (K+d)) z - s d, d = B/T, s = p r - q
/// e, inside the unit circle by Jury's criterion. Without damping of the device, with beta = B T / 2m < 1,
///   K < (2 B / T) (1 - beta) / (1 + beta).
/// 0 where no stiffness is stable.
inline double stable_stiffness(DeviceDynamics const& device, double damping, double period) {
  const double a = device.damping * period / device.mass, e = std::exp(-a);
  // (1 - e) / a and (a - 1 + e) / a^2, by their series near 0
  const double one = a < 1e-2 ? 1 - a / 2 * (1 - a / 3 * (1 - a / 4 * (1 - a / 5))) : (1 - e) / a;
  const double two = a < 1e-2 ? 0.5 - a / 6 * (1 - a / 4 * (1 - a / 5 * (1 - a / 6))) : (a - 1 + e) / (a * a);
  const double unit = period * period / device.mass;
  const double q = unit * two, s = unit * (one * one - two * e), d = damping / period;
  if (!(s * d < 1)) return 0;
  const double circle = (1 - s * s * d * d - e + q * d + s * d * (1 + e)) / (s * (1 + d * q)) - d;
  const double flip =
      q - s > 1e-14 * q ? 2 * (1 + e) / (q - s) - 2 * d : std::numeric_limits<double>::infinity();
  return std::max(0.0, std::min(circle, flip));
}

}  // namespace sinew
