// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/mass/lumped_mass.hpp>
#include <sinew/topology/beam_section.hpp>

namespace sinew {

/// Mass of the beams along the edges of the topology, of an even material, lumped at their frames: each has
/// half of the mass r A L and of the rotary inertia r L (I_y + I_z, I_y, I_z) of each of its beams. Waves of
/// a beam come out with errors of order (h / wavelength)^2.
template <class D>
struct BeamMass {
  static_assert(D::rigid && D::spatial == 3, "Sinew: BeamMass is for frames in space (Rigid3d).");
  using Role = role::Mass;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "BeamMass";

  double massDensity = 1;
  double radius = 0.1, radiusInner = 0;
  CrossSectionShape crossSectionShape = CrossSectionShape::circular;
  double lengthY = 1, lengthZ = 1;

  static constexpr auto fields() {
    using M = BeamMass;
    return field_list(
        field("massDensity", &M::massDensity, "kg/m^3", "mass of a volume of the beams", range::positive),
        field("radius", &M::radius, "m", "of a circular cross-section", range::positive),
        field("radiusInner",
              &M::radiusInner,
              "m",
              "of the hole in a circular cross-section",
              range::nonNegative),
        field("crossSectionShape",
              &M::crossSectionShape,
              "",
              "circular: with radius; rectangular: with lengths"),
        field("lengthY",
              &M::lengthY,
              "m",
              "side of a rectangular cross-section along y of the frames",
              range::positive),
        field("lengthZ",
              &M::lengthZ,
              "m",
              "side of a rectangular cross-section along z of the frames",
              range::positive));
  }

  LumpedMass<D> lumped{};

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<BeamMass>());
    const BeamSection section =
        beam_section(where, crossSectionShape, radius, radiusInner, lengthY, lengthZ, 0);
    detail::check_indices(where, "edge", context.topology.edges, context.rest.size());
    struct Share {
      double mass = 0;
      Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
    };
    std::vector<Share> shares(context.rest.size());
    for (Edge const& e : context.topology.edges) {
      auto const &x0 = context.rest[std::size_t(e[0])], &x1 = context.rest[std::size_t(e[1])];
      const Eigen::Vector3d chord = (x1.center - x0.center).template cast<double>();
      const Eigen::Quaterniond node[2]{x0.orientation.template cast<double>(),
                                       x1.orientation.template cast<double>()};
      const Eigen::Quaterniond axes = beam_axes(chord, node[0], node[1]);
      const double half = massDensity * chord.norm() / 2;
      const Eigen::Vector3d inertia(section.aboutY + section.aboutZ, section.aboutY, section.aboutZ);
      for (std::size_t k = 0; k < 2; ++k) {
        Share& share = shares[std::size_t(e[k])];
        const Eigen::Matrix3d rotation = (node[k].conjugate() * axes).toRotationMatrix();
        share.mass += half * section.area;
        share.inertia += half * rotation * inertia.asDiagonal() * rotation.transpose();
      }
    }
    std::vector<typename D::MassType> masses;
    for (std::size_t i = 0; i < shares.size(); ++i) {
      if (!(shares[i].mass > 0))
        throw Error(where,
                    text("frame ",
                         i,
                         " is the end of no beam and would have no mass; give the topology an edge to it, or "
                         "remove it"));
      masses.push_back({Real(shares[i].mass), shares[i].inertia.template cast<Real>()});
    }
    lumped.init(where, masses);
  }

  void addForce(MechanicalParams const& p, VecDeriv& f, VecCoord const& x, VecDeriv const& v) const {
    lumped.addForce(p, f, x, v);
  }
  void addMDx(VecDeriv& f, VecCoord const& x, VecDeriv const& dx, double factor) const {
    lumped.addMDx(f, x, dx, Real(factor));
  }
  void accFromF(VecDeriv& a, VecCoord const& x, VecDeriv const& f) const { lumped.accFromF(a, x, f); }
  double kineticEnergy(VecCoord const& x, VecDeriv const& v) const { return lumped.kineticEnergy(x, v); }
  template <class Sink>
  void addToMatrix(MechanicalParams const& p, VecCoord const& x, Sink const& sink) const {
    lumped.addToMatrix(x, Real(p.m), sink);
  }
};

}  // namespace sinew
