// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

#include <cmath>
#include <vector>

namespace sinew {

/// The volume inside a closed surface, by the theorem of Gauss: a triangle a b c adds the part of
///   V = sum (a_x + b_x + c_x)/6 ((b - a) x (c - a))_x                                      [m^3]
/// and a quad that of two triangles. What is open has no volume that means anything.
template <class D>
struct VolumeFromTriangles {
  using Role = role::Engine;
  using DataTypes = D;
  static_assert(D::spatial == 3, "VolumeFromTriangles is of a surface in space");
  static constexpr std::string_view className = "VolumeFromTriangles";
  static constexpr bool ofPositions = true;  // where the state is, and not where it rests

  typename D::VecCoord position{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};

  static constexpr auto fields() {
    using E = VolumeFromTriangles;
    return field_list(field("position", &E::position, "m", "points of the surface").also("positions"),
                      field("triangles", &E::triangles, "", "of the surface", range::nonNegative),
                      field("quads", &E::quads, "", "of the surface", range::nonNegative));
  }

  double volume = 0;  // after update

  static constexpr auto outputs() {
    return field_list(field("volume", &VolumeFromTriangles::volume, "m^3", "inside the surface"));
  }

  /// Throws Error where there is no element, or one refers to a missing point; the output then stays.
  void update(std::string_view where) {
    check_fields(*this, where);
    const std::string at = text(where, ": ", component_name<VolumeFromTriangles>());
    if (triangles.empty() && quads.empty())
      throw Error(at, "there is no surface; give triangles or quads, or a topology that has some");
    detail::check_indices(at, "triangle", triangles, position.size());
    detail::check_indices(at, "quad", quads, position.size());
    double sum = 0;
    auto add = [&](Index i, Index j, Index k) {
      const Eigen::Vector3d a = x(i), b = x(j), c = x(k);
      sum += ((b[1] - a[1]) * (c[2] - a[2]) - (c[1] - a[1]) * (b[2] - a[2])) * (a[0] + b[0] + c[0]) / 6;
    };
    for (auto const& t : triangles) add(t[0], t[1], t[2]);
    for (auto const& q : quads) add(q[0], q[1], q[2]), add(q[0], q[2], q[3]);
    volume = std::abs(sum);
  }

 private:
  Eigen::Vector3d x(Index i) const { return D::center(position[std::size_t(i)]).template cast<double>(); }
};

}  // namespace sinew
