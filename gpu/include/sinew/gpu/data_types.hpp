// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>
#include <sinew/core/point_loop.hpp>
#include <sinew/gpu/device_vector.hpp>

namespace sinew {

/// The DataTypes H with vectors on the device: what runs over them runs there, with the same laws.
template <class H>
struct CudaTypes : H {
  using Host = H;
  template <class T>
  using Array = gpu::DeviceVector<T>;
  using VecCoord = Array<typename H::Coord>;
  using VecDeriv = Array<typename H::Deriv>;

  template <class Body>
  static void eachPoint(std::size_t count, Body const& body) {
    gpu::for_each_index(count, body);
  }
};

/// DataTypes whose vectors live on a device.
template <class D>
concept OnDevice = requires { typename D::Host; };

using CudaVec2f = CudaTypes<Vec2f>;
using CudaVec2d = CudaTypes<Vec2d>;
using CudaVec3f = CudaTypes<Vec3f>;
using CudaVec3d = CudaTypes<Vec3d>;
using CudaRigid3f = CudaTypes<Rigid3f>;
using CudaRigid3d = CudaTypes<Rigid3d>;

template <class H>
struct data_types_name<CudaTypes<H>> {
  static constexpr auto base = data_types_name<H>::value;
  static constexpr auto all = [] {
    std::array<char, 16> letters{'C', 'u', 'd', 'a'};
    for (std::size_t i = 0; i < base.size(); ++i) letters[4 + i] = base[i];
    return letters;
  }();
  static constexpr std::string_view value{all.data(), 4 + base.size()};
};

}  // namespace sinew
