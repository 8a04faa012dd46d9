// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <array>
#include <functional>
#include <vector>

// Piles of rigid boxes for Sinew and Bullet, without a type of either: Bullet is compiled apart, for the
// processor that its package is compiled for.
namespace bench {

/// Cubes of 1 m and 1 kg over the plane z = 0, with friction 0.5 and g = 9.81 m/s^2.
struct BoxAt {
  std::array<double, 3> center;
  std::array<double, 4> turn;  // x, y, z, w of a unit quaternion
};
constexpr double pileFriction = 0.5, pileStep = 0.01;  // [s]

/// A contact at the end of a step, along its normal and two tangents, by what the bodies have done: the
/// forces f [N], the gap d_n and the sliding d_t [m], and the mean w [m/N] of what f changes of d.
struct ContactOfStep {
  std::array<double, 3> f, d;
  double w;
};

struct BulletPile {
  std::function<void(int iterations)> step;
  std::function<std::vector<ContactOfStep>()> contacts;
  std::function<std::vector<BoxAt>()> boxes;
};
/// By sequential impulses, with defaults but for two directions of friction and bodies that never sleep.
BulletPile bullet_pile(std::vector<BoxAt> const& boxes);

}  // namespace bench
