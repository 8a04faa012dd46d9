// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/follow.hpp>
#include <sinew/mass/lumped_mass.hpp>
#include <sinew/topology/element_checks.hpp>
#include <sinew/topology/hexahedra.hpp>
#include <sinew/topology/quadratic_shapes.hpp>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace sinew {

/// A mass for each point: given one by one, or from a density (or the total) over the elements of the
/// topology, which share theirs out among their points, those of second order in proportion to the diagonal
/// of their consistent mass (Hinton, Rock, Zienkiewicz 1976). Elements are those in space; where there are
/// none, the triangles and quads (and the density is that of an area); else the edges (that of a length).
/// Over values with fewer coordinates than space, such as temperatures, that stand in a child node of the
/// body, they are those of the body, and the density is a heat capacity [J/(m^3 K)]. A point that no element
/// has has no mass: it has no weight, and no explicit solver can move it.
template <class D>
struct DiagonalMass {
  using Role = role::Mass;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  using MassType = typename D::MassType;
  static constexpr std::string_view className = "DiagonalMass";
  static constexpr bool overBody = !D::rigid && D::spatial < 3;

  std::optional<double> massDensity{};
  std::optional<double> totalMass{};
  std::vector<MassType> vertexMass{};

  static constexpr auto fields() {
    using M = DiagonalMass;
    return field_list(
        field("massDensity",
              &M::massDensity,
              "kg/m^3",
              "mass of a volume of the body, [kg/m^2] of a surface, [kg/m] of a wire",
              range::positive),
        field("totalMass", &M::totalMass, "kg", "mass of the body", range::positive).also("totalmass"),
        field("vertexMass", &M::vertexMass, "kg", "mass of each point; one value for all", range::positive)
            .oneEach(Of::points)
            .also("mass"));
  }

  LumpedMass<D> lumped{};
  double density = 0;
  bool expected = false;  // points that no element has, since elements may come; set by init

  std::string warning() const {
    auto const& loose = lumped.massless;
    if (loose.empty() || expected) return {};
    return text(
        "no element has point ",
        loose[0],
        loose.size() > 1 ? text(", nor ", loose.size() - 1, " others") : std::string(),
        ", so that they have no mass and stay where they are; leave them out, or give them an element or "
        "a mass");
  }

  /// The density stays, not the total; of one mass for all points, where elements are refined, the total.
  void follow(Followed const& change) {
    if constexpr (!D::rigid)
      if (change.refined && change.points.changes() && !vertexMass.empty())
        vertexMass[0] *= MassType(double(change.points.now.size()) / double(change.points.size()));
    if (!totalMass) return;
    massDensity = density;
    totalMass.reset();
  }

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<DiagonalMass>());
    const std::size_t n = context.rest.size();
    expected = context.topology.grows;
    if (int(massDensity.has_value()) + int(totalMass.has_value()) + int(!vertexMass.empty()) != 1)
      throw Error(where, "give exactly one of massDensity, totalMass and vertexMass");
    if (!vertexMass.empty()) {
      if (vertexMass.size() != n && vertexMass.size() != 1)
        throw Error(where,
                    text("vertexMass has ",
                         vertexMass.size(),
                         " entries for ",
                         n,
                         " points; give one for all, or one for each"));
      return lumped.init(where,
                         vertexMass.size() == n ? vertexMass : std::vector<MassType>(n, vertexMass.front()));
    }
    if constexpr (!D::rigid) {
      std::vector<bool> alone(n, true);
      std::vector<double> share = sizes(context, where, alone);
      double whole = 0;
      for (const double v : share) whole += v;
      if (!context.body.empty()) {
        fill_unused(share);
        alone.assign(n, false);
      }
      density = massDensity ? *massDensity : *totalMass / whole;
      std::vector<MassType> masses(n);
      for (std::size_t i = 0; i < n; ++i) masses[i] = MassType(density * share[i]);
      lumped.init(where, masses, alone);
    } else {
      throw Error(where, "a density is for points; give vertexMass");
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

 private:
  // the volume, area or length that each point stands for: the integral of its shape function; and which
  // points no element has
  std::vector<double> sizes(InitContext<D> const& context, std::string const& where,
                            std::vector<bool>& alone) const {
    check_values_of_body(where, context);
    std::vector<Eigen::Vector3d> x(context.rest.size());
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = context.place(Index(i));
    auto at = [&x](Index i) -> Eigen::Vector3d const& { return x[std::size_t(i)]; };
    std::vector<double> size(x.size(), 0.0);
    auto share = [&](auto const& element, double whole) {
      for (const Index i : element) {
        size[std::size_t(i)] += whole / double(element.size());
        alone[std::size_t(i)] = false;
      }
    };
    TopologyView const& t = context.topology;
    check_element_indices(where, t, x.size());
    if (dimension_of(t) == 3) {
      for (auto const& e : t.tetrahedra) {
        const Eigen::Vector3d a = at(e[1]) - at(e[0]), b = at(e[2]) - at(e[0]), c = at(e[3]) - at(e[0]);
        share(e, std::abs(a.dot(b.cross(c))) / 6);
      }
      auto addAll = [&](auto const& elements) {
        for (auto const& e : elements) {
          addHexahedron(as_hexahedron(e), x, size);
          for (const Index i : e) alone[std::size_t(i)] = false;
        }
      };
      addAll(t.hexahedra), addAll(t.pyramids), addAll(t.prisms);
      auto addQuadratic = [&]<std::size_t N>(std::span<std::array<Index, N> const> elements) {
        for (auto const& e : elements) {
          Eigen::Matrix<double, 3, int(N)> nodes;
          for (std::size_t k = 0; k < N; ++k) nodes.col(Eigen::Index(k)) = at(e[k]);
          const auto masses = lumped_mass<int(N)>(quadratic_mass(nodes));
          for (std::size_t k = 0; k < N; ++k) {
            size[std::size_t(e[k])] += masses[Eigen::Index(k)];
            alone[std::size_t(e[k])] = false;
          }
        }
      };
      addQuadratic(t.quadraticTetrahedra), addQuadratic(t.quadraticHexahedra);
      addQuadratic(t.triquadraticHexahedra);
    } else if (!t.triangles.empty() || !t.quads.empty()) {
      // the triangles of a grid are the halves of its quads
      if (t.grid[0] == 0 || t.quads.empty())
        for (auto const& e : t.triangles)
          share(e, (at(e[1]) - at(e[0])).cross(at(e[2]) - at(e[0])).norm() / 2);
      for (auto const& e : t.quads) share(e, (at(e[2]) - at(e[0])).cross(at(e[3]) - at(e[1])).norm() / 2);
    } else if (!t.edges.empty()) {
      for (auto const& e : t.edges) share(e, (at(e[1]) - at(e[0])).norm());
    } else if (!t.grows || !massDensity) {
      throw Error(
          where,
          "a density needs elements; give the node a topology with tetrahedra or others, or vertexMass");
    }
    return size;
  }

  // two Gauss points a direction integrate shape function times det J exactly: both are polynomials of degree
  // three at most in each coordinate
  static void addHexahedron(Hexahedron const& e, std::vector<Eigen::Vector3d> const& x,
                            std::vector<double>& size) {
    Eigen::Matrix<double, 3, 8> corners;
    for (int k = 0; k < 8; ++k) corners.col(k) = x[std::size_t(e[std::size_t(k)])];
    const double g[2] = {0.5 - std::sqrt(1.0 / 12), 0.5 + std::sqrt(1.0 / 12)};
    for (int q = 0; q < 8; ++q) {
      const MultilinearShape<3> shape({g[q & 1], g[q >> 1 & 1], g[q >> 2]});
      const double volume = std::abs((corners * shape.derivatives).determinant()) / 8;
      for (int k = 0; k < 8; ++k) size[std::size_t(e[std::size_t(k)])] += volume * shape.weights[k];
    }
  }
};

}  // namespace sinew
