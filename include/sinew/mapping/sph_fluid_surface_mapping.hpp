// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/mapping/particle_surface.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// A visual model that is the surface of a fluid: its points and faces are those where the density of the
/// particles of the parent is the part isoValue of that inside (ParticleSurface), made anew whenever it is
/// looked at. Nothing goes back to the particles. The names are those of SOFA's plugin SofaSphFluid, where
/// the same function stands beside an SPHFluidForceField; without one SOFA's isoValue is that of the plain
/// sum of (1 - r^2/radius^2)^3.
template <class I, class O>
struct SPHFluidSurfaceMapping {
  using Role = role::Mapping;
  using In = I;
  using Out = O;
  static constexpr std::string_view className = "SPHFluidSurfaceMapping";

  double step = 0.5, radius = 2, isoValue = 0.5;

  static constexpr auto fields() {
    using M = SPHFluidSurfaceMapping;
    return field_list(
        field("step", &M::step, "m", "of the lattice; the faces are about that wide", range::positive),
        field("radius", &M::radius, "m", "how far a particle counts: that of the fluid", range::positive),
        field("isoValue", &M::isoValue, "", "part of the density inside", range::open(0, 1)));
  }

  std::string where{};
  ParticleSurface surface{};
  std::vector<Eigen::Vector3d> particles{};

  void init(InitContext<In> const&, InitContext<Out> const& child, typename Out::VecCoord& positions) {
    where = text(child.where, ": ", component_name<SPHFluidSurfaceMapping>());
    if (radius > ParticleSurface::mostSteps * step)
      throw Error(where,
                  text("the radius is ",
                       radius / step,
                       " steps, and at most ",
                       ParticleSurface::mostSteps,
                       "; take a longer step"));
    positions.clear();
  }
  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) {
    particles.clear();
    for (auto const& x : in) particles.push_back(x.template cast<double>());
    surface.find(particles, radius, step, isoValue, where);
    out.clear();
    for (auto const& x : surface.points) out.push_back(x.template cast<typename Out::Real>());
  }
  /// Of the last apply.
  std::vector<Quad> const& faces() const { return surface.quads; }

  // a visual model has no velocities and no forces
  void applyJ(typename Out::VecDeriv&, typename In::VecDeriv const&) const {}
  void applyJT(typename In::VecDeriv&, typename Out::VecDeriv const&) const {}
  template <class F>
  void forEachJacobianBlock(int, F&&) const {}
};

}  // namespace sinew
