// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <type_traits>
#include <vector>

namespace sinew {

/// Velocities that deform nothing, as six numbers for each unknown of a system, in rows of eight: of points
/// and bodies in space the translations and rotations about the middle of all, as the positions are now,
///   v = a + w x (x - c),  of bodies with w as angular velocity,
/// of points in a plane two and one; of other points, constants for each of their coordinates. `Row`: eight
/// numbers, zero here where there is nothing to say.
template <class Operations, class Row>
void rigid_modes(Operations& operations, std::vector<Row>& modes) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0;
  auto eachPlace = [&](auto&& f) {
    operations.forEachIndependent([&](auto& s) {
      using D = typename std::decay_t<decltype(s)>::DataTypes;
      int dof = s.dofOffset;
      for (auto const& x : s.position) {
        Eigen::Vector3d place = Eigen::Vector3d::Zero();
        if constexpr (D::spatial > 1 && (D::rigid || D::size == D::spatial))
          place.template head<D::spatial>() = D::center(x).template cast<double>();
        f(s, place, std::size_t(dof));
        dof += D::size;
      }
    });
  };
  eachPlace([&](auto&, Eigen::Vector3d const& x, std::size_t) { sum += x, count += 1; });
  const Eigen::Vector3d middle = count > 0 ? Eigen::Vector3d(sum / count) : sum;
  for (Row& row : modes) row = Row{};
  eachPlace([&](auto& s, Eigen::Vector3d const& place, std::size_t dof) {
    using D = typename std::decay_t<decltype(s)>::DataTypes;
    const Eigen::Vector3d x = place - middle;
    Row* const m = &modes[dof];
    if constexpr (D::spatial == 3 && (D::rigid || D::size == 3)) {
      m[0][0] = m[1][1] = m[2][2] = 1;
      m[0][4] = x[2], m[0][5] = -x[1];
      m[1][3] = -x[2], m[1][5] = x[0];
      m[2][3] = x[1], m[2][4] = -x[0];
      if constexpr (D::rigid) m[3][3] = m[4][4] = m[5][5] = 1;
    } else if constexpr (D::spatial == 2 && (D::rigid || D::size == 2)) {
      m[0][0] = m[1][1] = 1;
      m[0][2] = -x[1], m[1][2] = x[0];
      if constexpr (D::rigid) m[2][2] = 1;
    } else {
      for (int c = 0; c < D::size; ++c) m[c][c] = 1;
    }
  });
}

}  // namespace sinew
