// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/force/rotations.hpp>

#include <array>
#include <string_view>

namespace sinew {

/// How the rotation of a corotational hexahedron is found from A, its Jacobian in the centre, the mean edges.
///   large    frame on the first two columns of A (Nesme, Payan, Faure 2005), as SOFA's "large"
///   polar    rotation nearest to A, against the one nearest to A_rest, as SOFA's "polar"; that of `nearest`
///            where cells are cubes
///   small    none: linear elasticity
///   nearest  rotation nearest to A A_rest^-1
enum class HexahedronMethod { large, polar, small, nearest };
inline constexpr std::array<std::string_view, 4> enum_names(HexahedronMethod) {
  return {"large", "polar", "small", "nearest"};
}

namespace detail {
// Corners and Gauss points by three bits, of x, y and z; u and v are the other two directions than k.
constexpr int hexahedron_corner(int bits) {
  constexpr int vtk[8] = {0, 1, 3, 2, 4, 5, 7, 6};
  return vtk[bits];
}
constexpr int hexahedron_across(int k, int which) { return which == 0 ? (k == 0 ? 1 : 0) : (k == 2 ? 1 : 2); }
// end of the edge number uv of direction k
constexpr int hexahedron_end(int k, int uv, int high) {
  return hexahedron_corner((uv & 1) << hexahedron_across(k, 0) | (uv >> 1) << hexahedron_across(k, 1) |
                           high << k);
}
}  // namespace detail

/// A, the Jacobian in the centre by the coordinates of the reference cube from -1 to 1: halves of the mean
/// edges.
template <class Real>
SINEW_INLINE Mat<Real, 3> hexahedron_jacobian(Vec<Real, 3> const (&x)[8]) {
  using detail::hexahedron_end;
  Mat<Real, 3> a;
  for (int k = 0; k < 3; ++k) {
    Vec<Real, 3> sum = x[hexahedron_end(k, 0, 1)] - x[hexahedron_end(k, 0, 0)];
    for (int uv = 1; uv < 4; ++uv) sum += x[hexahedron_end(k, uv, 1)] - x[hexahedron_end(k, uv, 0)];
    a.col(k) = sum * Real(0.125);
  }
  return a;
}

/// From the rest frame of the method to the world, where it is not `small`. `center`: A_rest^-1, for
/// `nearest`.
template <class Real>
SINEW_INLINE Mat<Real, 3> rotation_of_jacobian(HexahedronMethod method, Mat<Real, 3> const& center,
                                               Mat<Real, 3> const& a) {
  using Vec3 = Vec<Real, 3>;
  if (method == HexahedronMethod::large) return frame_of(Vec3(a.col(0)), Vec3(a.col(1)));
  return nearest_rotation(method == HexahedronMethod::polar ? a : a * center);
}
template <class Real>
SINEW_INLINE Mat<Real, 3> hexahedron_rotation(HexahedronMethod method, Mat<Real, 3> const& center,
                                              Vec<Real, 3> const (&x)[8]) {
  if (method != HexahedronMethod::small) return rotation_of_jacobian(method, center, hexahedron_jacobian(x));
  Mat<Real, 3> r;
  for (int c = 0; c < 9; ++c) r(c) = Real(c % 4 == 0 ? 1 : 0);
  return r;
}

/// The frame of the method at rest, in which displacements are measured.
template <class Real>
Mat<Real, 3> hexahedron_rest_frame(HexahedronMethod method, Mat<Real, 3> const& jacobian) {
  if (method == HexahedronMethod::large)
    return frame_of(Vec<Real, 3>(jacobian.col(0)), Vec<Real, 3>(jacobian.col(1)));
  if (method == HexahedronMethod::polar) return nearest_rotation(jacobian);
  return Mat<Real, 3>::Identity();
}

}  // namespace sinew
