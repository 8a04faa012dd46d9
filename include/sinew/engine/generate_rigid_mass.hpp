// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/topology/inertia.hpp>

#include <vector>

namespace sinew {

/// Mass and inertia of the rigid body inside a closed surface, filled evenly: for the vertexMass of a
/// UniformMass. A rigid body has its centre in its centre of mass, from which `centerToOrigin` moves the
/// surface (the translation of its loader) to the body's axes.
template <class D>
struct GenerateRigidMass {
  static_assert(D::rigid && D::spatial == 3,
                "Sinew: GenerateRigidMass is for rigid bodies in space (Rigid3d).");
  using Role = role::Engine;
  using DataTypes = D;
  static constexpr std::string_view className = "GenerateRigidMass";

  double density = 1000;
  std::vector<Eigen::Vector3d> position{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};

  static constexpr auto fields() {
    using G = GenerateRigidMass;
    return field_list(
        field("density", &G::density, "kg/m^3", "mass of a volume of the body", range::positive),
        field("position", &G::position, "m", "points of the surface"),
        field("triangles", &G::triangles, "", "triangles of the surface", range::nonNegative),
        field("quads", &G::quads, "", "quads of the surface, two triangles each", range::nonNegative));
  }

  // after update
  typename D::MassType rigidMass{};
  double mass = 0, volume = 0;
  Mat<double, 3> inertiaMatrix = Mat<double, 3>::Zero();
  Eigen::Vector3d massCenter{0, 0, 0}, centerToOrigin{0, 0, 0};

  static constexpr auto outputs() {
    using G = GenerateRigidMass;
    return field_list(
        field("rigidMass", &G::rigidMass, "kg", "mass and inertia of the body"),
        field("mass", &G::mass, "kg", "mass of the body"),
        field("volume", &G::volume, "m^3", "volume inside the surface"),
        field("inertiaMatrix", &G::inertiaMatrix, "m^2", "inertia about the centre, divided by the mass"),
        field("massCenter", &G::massCenter, "m", "centre of mass"),
        field("centerToOrigin", &G::centerToOrigin, "m", "from there to the origin"));
  }

  /// Throws Error as mass_properties() does; the outputs then stay.
  void update(std::string_view where) {
    check_fields(*this, where);
    const MassProperties body =
        mass_properties(text(where, ": ", component_name<GenerateRigidMass>()), position, triangles, quads);
    volume = body.volume;
    mass = density * volume;
    inertiaMatrix = body.inertia / volume;
    massCenter = body.center;
    centerToOrigin = -body.center;
    using Real = typename D::Real;
    rigidMass = {Real(mass), (mass * inertiaMatrix).template cast<Real>()};
  }
};

}  // namespace sinew
