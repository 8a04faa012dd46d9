// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// Spheres from a file (.sph), for collision and to look at. Radii grow with the cube root of the volume that
/// the three sizes make: with equal ones spheres touch as they do in the file.
struct SphereLoader {
  using Role = role::Engine;
  static constexpr std::string_view className = "SphereLoader";

  DataFile filename{};
  Eigen::Vector3d scale{1, 1, 1}, rotation{0, 0, 0}, translation{0, 0, 0};

  static constexpr auto fields() {
    using L = SphereLoader;
    return field_list(
        field("filename", &L::filename, "", "the file to read"),
        field("scale", &L::scale, "", "sizes along the axes x, y and z, applied first").also("scale3d"),
        field("rotation",
              &L::rotation,
              "degrees",
              "rotates the centres about the axes x, y and z, in this order"),
        field("translation", &L::translation, "m", "moves the centres, last of all"));
  }

  // after update
  std::vector<Eigen::Vector3d> position{};
  std::vector<double> listRadius{};

  static constexpr auto outputs() {
    using L = SphereLoader;
    return field_list(field("position", &L::position, "m", "centres").also("sphere_centers"),
                      field("listRadius", &L::listRadius, "m", "radius of each sphere"));
  }

  /// Throws Error when the file cannot be read; what was loaded before then stays.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/placement.hpp>
#include <sinew/io/read_sph.hpp>

namespace sinew {

SINEW_ONCE void SphereLoader::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  if (filename.path.empty()) throw Error(at, "filename is empty; name the file to read");
  const double growth = std::cbrt(std::abs(scale.prod()));
  if (growth == 0) throw Error(at, "scale is 0, and spheres would vanish; give another size");
  io::Spheres spheres;
  try {
    spheres = io::read_sph(filename.path);
  } catch (Error const& error) {
    throw Error(at, error.what());
  }
  const Placement placed = placement(translation, rotation, scale);
  for (auto& c : spheres.centers) c = placed * c;
  for (auto& r : spheres.radii) r *= growth;
  position = std::move(spheres.centers);
  listRadius = std::move(spheres.radii);
}

}  // namespace sinew
#endif
