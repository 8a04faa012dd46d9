// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/solver/multi_vec.hpp>

#include <cmath>

namespace sinew {

/// Slows all that moves below its node, in each step of length h: v *= exp(-rate h). Then the velocities of
/// points that are below `threshold` become zero; of a rigid body, the linear and the angular one together.
/// It stands behind the ODE solver of its node, after which it acts; alone, it leaves positions where they
/// are.
struct DampVelocitySolver {
  using Role = role::OdeSolver;
  static constexpr std::string_view className = "DampVelocitySolver";
  static constexpr std::string_view aliases = "DampVelocity DampVelocityIntegrationScheme";
  static constexpr bool implicit = false, beside = true;
  static constexpr int convergenceOrder = 0;
  static constexpr Auxiliary auxiliary{};

  double rate = 0.99, threshold = 0;

  static constexpr auto fields() {
    using S = DampVelocitySolver;
    return field_list(field("rate", &S::rate, "1/s", "of the decay of velocities", range::nonNegative),
                      field("threshold",
                            &S::threshold,
                            "m/s",
                            "speed below which a point stands still; 0 for none",
                            range::nonNegative));
  }

  template <class Operations>
  void solve(Operations& operations, double h) const {
    MultiVecDeriv vel(operations, vec_id::velocity);
    vel.teq(std::exp(-rate * h));
    if (threshold > 0)
      operations.forEachIndependent([&](auto& s) {
        for (auto& v : s.velocity)
          if (double(v.squaredNorm()) < threshold * threshold) v.setZero();
      });
  }
};

}  // namespace sinew
