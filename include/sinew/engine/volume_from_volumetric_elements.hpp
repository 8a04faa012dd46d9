// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

#include <cmath>
#include <vector>

namespace sinew {

/// The volume of tetrahedra and hexahedra together. A hexahedron is that of five tetrahedra, four at the
/// corners 1, 3, 4 and 6, and the one between these.
template <class D>
struct VolumeFromVolumetricElements {
  using Role = role::Engine;
  using DataTypes = D;
  static_assert(D::spatial == 3, "VolumeFromVolumetricElements is of elements in space");
  static constexpr std::string_view className = "VolumeFromVolumetricElements",
                                    aliases = "VolumeFromTetrahedrons";
  static constexpr bool ofPositions = true;  // where the state is, and not where it rests

  typename D::VecCoord position{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<Hexahedron> hexahedra{};

  static constexpr auto fields() {
    using E = VolumeFromVolumetricElements;
    return field_list(
        field("position", &E::position, "m", "points of the elements").also("positions"),
        field("tetrahedra", &E::tetrahedra, "", "over the points", range::nonNegative).also("tetras"),
        field("hexahedra", &E::hexahedra, "", "over the points", range::nonNegative).also("hexas"));
  }

  double volume = 0;  // after update

  static constexpr auto outputs() {
    return field_list(field("volume", &VolumeFromVolumetricElements::volume, "m^3", "of all elements"));
  }

  /// Throws Error where there is no element, or one refers to a missing point; the output then stays.
  void update(std::string_view where) {
    check_fields(*this, where);
    const std::string at = text(where, ": ", component_name<VolumeFromVolumetricElements>());
    if (tetrahedra.empty() && hexahedra.empty())
      throw Error(at, "there is no element; give tetrahedra or hexahedra, or a topology that has some");
    detail::check_indices(at, "tetrahedron", tetrahedra, position.size());
    detail::check_indices(at, "hexahedron", hexahedra, position.size());
    double sum = 0;
    auto add = [&](Index i, Index j, Index k, Index l) {
      const Eigen::Vector3d a = x(i);
      sum += std::abs((x(j) - a).dot((x(k) - a).cross(x(l) - a))) / 6;
    };
    for (auto const& t : tetrahedra) add(t[0], t[1], t[2], t[3]);
    for (auto const& h : hexahedra) {
      add(h[0], h[1], h[3], h[4]), add(h[2], h[1], h[3], h[6]);
      add(h[5], h[1], h[4], h[6]), add(h[7], h[3], h[4], h[6]);
      add(h[1], h[3], h[4], h[6]);
    }
    volume = sum;
  }

 private:
  Eigen::Vector3d x(Index i) const { return D::center(position[std::size_t(i)]).template cast<double>(); }
};

}  // namespace sinew
