// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/mass/lumped_mass.hpp>

#include <optional>

namespace sinew {

/// A mass for each point: given one by one, or from a density (or the total) over the tetrahedra of the
/// topology, each of which gives a quarter of its mass to its points.
template <class D>
struct DiagonalMass {
  using Role = role::Mass;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  using MassType = typename D::MassType;
  static constexpr std::string_view className = "DiagonalMass";

  std::optional<double> massDensity{};
  std::optional<double> totalMass{};
  std::vector<MassType> vertexMass{};

  static constexpr auto fields() {
    using M = DiagonalMass;
    return field_list(
        field("massDensity", &M::massDensity, "kg/m^3", "mass of a volume of the body", range::positive),
        field("totalMass", &M::totalMass, "kg", "mass of the body", range::positive),
        field("vertexMass", &M::vertexMass, "kg", "mass of each point", range::positive));
  }

  LumpedMass<D> lumped{};

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<DiagonalMass>());
    const std::size_t n = context.rest.size();
    if (int(massDensity.has_value()) + int(totalMass.has_value()) + int(!vertexMass.empty()) != 1)
      throw Error(where, "give exactly one of massDensity, totalMass and vertexMass");
    if (!vertexMass.empty()) {
      if (vertexMass.size() != n)
        throw Error(
            where,
            text("vertexMass has ", vertexMass.size(), " entries for ", n, " points; give one for each"));
      return lumped.init(where, vertexMass);
    }
    if constexpr (!D::rigid && D::spatial == 3) {
      if (context.topology.tetrahedra.empty())
        throw Error(where,
                    "a density needs the volume of tetrahedra; give the node a topology with tetrahedra, or "
                    "vertexMass");
      std::vector<double> volume(n, 0.0);
      double whole = 0;
      for (auto const& t : context.topology.tetrahedra) {
        Mat<double, 3> edges;
        for (int c = 0; c < 3; ++c)
          edges.col(c) = (D::center(context.rest[std::size_t(t[std::size_t(c) + 1])]) -
                          D::center(context.rest[std::size_t(t[0])]))
                             .template cast<double>();
        const double v = std::abs(edges.determinant()) / 6;
        whole += v;
        for (const Index i : t) volume[std::size_t(i)] += v / 4;
      }
      const double density = massDensity ? *massDensity : *totalMass / whole;
      std::vector<MassType> masses(n);
      for (std::size_t i = 0; i < n; ++i) masses[i] = MassType(density * volume[i]);
      lumped.init(where, masses);
    } else {
      throw Error(where, "a density is for points in space; give vertexMass");
    }
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
