// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/follow.hpp>
#include <sinew/core/lists.hpp>
#include <sinew/mass/consistent_mass.hpp>
#include <sinew/mass/lumped_mass.hpp>
#include <sinew/topology/element_checks.hpp>
#include <sinew/topology/hexahedra.hpp>
#include <sinew/topology/quadratic_shapes.hpp>

#include <array>
#include <optional>
#include <string_view>

namespace sinew {

/// Which elements of a topology have mass; `highest`: those of the highest dimension.
enum class MassElements {
  highest,
  edges,
  triangles,
  quads,
  tetrahedra,
  hexahedra,
  pyramids,
  prisms,
  quadraticTetrahedra,
  quadraticHexahedra,
  triquadraticHexahedra
};
inline constexpr std::array<std::string_view, 11> enum_names(MassElements) {
  return {"highest",
          "edges",
          "triangles",
          "quads",
          "tetrahedra",
          "hexahedra",
          "pyramids",
          "prisms",
          "quadraticTetrahedra",
          "quadraticHexahedra",
          "triquadraticHexahedra"};
}

/// The consistent mass of the elements of the topology (Archer 1963): with N_i the shape functions and rho
/// the density,
///   M_ij = integral of rho N_i N_j over the undeformed body         [kg], times the identity
/// for elements in space; where there are none, for triangles and quads (rho is that of an area); else for
/// edges (that of a length); or for those of one kind. `lumping` keeps its row sums only, on the
/// diagonal; of elements of second order, whose row sums are negative at corners, it keeps the diagonal, in
/// proportion (Hinton, Rock, Zienkiewicz 1976). Without a density the body has a total of 1 kg. The weight of
/// point i is that of its row sum, unless `lumping`.
///
/// Over values with fewer coordinates than space, such as temperatures, that stand in a child node of the
/// body, the elements are those of the body, undeformed, and the density is a heat capacity [J/(m^3 K)].
///
/// M^-1 f, which explicit solvers ask for, is taken with the row sums, lumped or not: the inverse of M is
/// full, and would carry the forces on fixed points to their neighbours. EulerExplicitSolver solves M a = f
/// where a linear solver stands by. (SOFA refuses without one.) Elements of second order need that, or
/// `lumping`.
template <class D>
struct MeshMatrixMass {
  using Role = role::Mass;
  using DataTypes = D;
  using Real = typename D::Real;
  using Deriv = typename D::Deriv;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  using MassType = typename D::MassType;
  static constexpr std::string_view className = "MeshMatrixMass";
  static constexpr bool overBody = D::spatial < 3;

  std::vector<double> massDensity{};
  std::optional<double> totalMass{};
  bool lumping = false;
  MassElements elements = MassElements::highest;
  bool fillWeighted = false;

  static constexpr auto fields() {
    using M = MeshMatrixMass;
    return field_list(
        field("massDensity",
              &M::massDensity,
              "kg/m^3",
              "density, [kg/m^2] of a surface, [kg/m] of a wire: one for all elements, or one for each, "
              "tetrahedra before hexahedra, pyramids, prisms and those of second order, and triangles before "
              "quads",
              range::positive)
            .oneEach(Of::elements),
        field("totalMass", &M::totalMass, "kg", "mass of the body", range::positive).also("totalmass"),
        field("lumping", &M::lumping, "", "keep a diagonal mass only"),
        field("elements", &M::elements, "", "which elements have mass"),
        field("fillWeighted",
              &M::fillWeighted,
              "",
              "whether hexahedra of a grid over a surface weigh as much as they are filled"));
  }

  double scale = 1;  // of the densities

  /// The density stays, not the total.
  void follow(Followed const&) {
    if (!massDensity.empty()) return;
    massDensity = {scale};
    totalMass.reset();
  }

  LumpedMass<D> lumped{};          // the row sums, or what stands for them
  std::vector<Real> weights{};     // [kg] the row sums, where these are others
  ConsistentMass<D> consistent{};  // empty when lumped

  /// M^-1 undoes M.
  bool exactInverse() const { return consistent.empty(); }

  void init(InitContext<D> const& context) {
    static_assert(!D::rigid,
                  "Sinew: MeshMatrixMass is for points; rigid bodies have a UniformMass or DiagonalMass.");
    const std::string where = text(context.where, ": ", component_name<MeshMatrixMass>());
    const std::size_t n = context.rest.size();
    if (!massDensity.empty() && totalMass)
      throw Error(where, "massDensity and totalMass are both given; give one of them");
    check_values_of_body(where, context);
    check_element_indices(where, context.topology, n);

    consistent = {};
    const bool ofValues = !context.body.empty();
    consistent.matrix.startPattern(int(n));
    for (int i = 0; ofValues && i < int(n); ++i) consistent.matrix.preallocate(i, i, 1, 1);
    const std::size_t count = forEachElement(context, [&](auto const& e, std::size_t, auto const&) {
      for (const Index i : e)
        for (const Index j : e) consistent.matrix.preallocate(i, j, 1, 1);
    });
    consistent.matrix.finishPattern();
    if (count == 0)
      throw Error(
          where,
          text("the mass is that of ",
               elements == MassElements::highest ? "elements" : enum_names(elements)[std::size_t(elements)],
               "; give the node a topology with some, or take a UniformMass"));
    if (massDensity.size() > 1 && elements != MassElements::highest)
      throw Error(
          where,
          "massDensity has several values, but those of one kind of elements only have mass; give one "
          "density");
    if (!massDensity.empty())
      check_one_or_each(where, "massDensity", massDensity.size(), count, "elements", "one for all");

    std::vector<double> rows(n, 0.0), diagonal(n, 0.0), values(consistent.matrix.columns.size(), 0.0);
    double total = 0;
    bool differ = false;
    forEachElement(context, [&](auto const& e, std::size_t number, auto const& mass) {
      const double density = massDensity.empty() ? 1 : one_or_each(massDensity, number);
      if constexpr (constexpr int nodes = std::decay_t<decltype(mass)>::RowsAtCompileTime; nodes > 8) {
        const auto lumps = lumped_mass<nodes>(mass);
        for (std::size_t i = 0; i < e.size(); ++i)
          diagonal[std::size_t(e[i])] += density * lumps[Eigen::Index(i)];
        differ = true;
      }
      for (std::size_t i = 0; i < e.size(); ++i)
        for (std::size_t j = 0; j < e.size(); ++j) {
          const double m = density * mass(Eigen::Index(i), Eigen::Index(j));
          if (e[i] <= e[j]) values[std::size_t(consistent.matrix.slot(int(e[i]), int(e[j])))] += m;
          rows[std::size_t(e[i])] += m;
          if (mass.rows() <= 8) diagonal[std::size_t(e[i])] += m;
          total += m;
        }
    });
    if (ofValues)
      for (const std::size_t i : fill_unused(rows))
        diagonal[i] = rows[i], values[std::size_t(consistent.matrix.slot(int(i), int(i)))] = rows[i];
    scale = massDensity.empty() ? totalMass.value_or(1) / total : 1;
    for (std::size_t k = 0; k < values.size(); ++k) consistent.matrix.values[k] = Real(scale * values[k]);
    std::vector<MassType> sums(n);
    for (std::size_t i = 0; i < n; ++i) sums[i] = MassType(scale * diagonal[i]);
    lumped.init(where, sums);
    weights.clear();
    if (differ && !lumping)
      for (const double m : rows) weights.push_back(Real(scale * m));
    if (lumping) consistent = {};
  }

  void addForce(MechanicalParams const& p, VecDeriv& f, VecCoord const& x, VecDeriv const& v) const {
    if (weights.empty()) return lumped.addForce(p, f, x, v);
    for (std::size_t i = 0; i < f.size(); ++i)
      for (int c = 0; c < D::spatial; ++c) f[i][c] += weights[i] * Real(p.gravity[c]);
  }
  void addMDx(VecDeriv& f, VecCoord const& x, VecDeriv const& dx, double factor) const {
    if (lumping) return lumped.addMDx(f, x, dx, Real(factor));
    consistent.addMDx(f, dx, factor);
  }
  /// Throws Error for elements of second order, of which the weight is no multiple of the lumped mass.
  void accFromF(VecDeriv& a, VecCoord const& x, VecDeriv const& f) const {
    if (!weights.empty())
      throw Error(lumped.place,
                  "the consistent mass of elements of second order is not inverted point by point; set "
                  "lumping, or give the node a linear solver or an implicit one");
    lumped.accFromF(a, x, f);
  }
  double kineticEnergy(VecCoord const& x, VecDeriv const& v) const {
    return lumping ? lumped.kineticEnergy(x, v) : consistent.kineticEnergy(v);
  }

  template <class Sink>
  void addToMatrix(MechanicalParams const& p, VecCoord const& x, Sink const& sink) {
    if (lumping) return lumped.addToMatrix(x, Real(p.m), sink);
    consistent.addToMatrix(p, sink);
  }

 private:
  // f(points, number, integral of N_i N_j) for each element; returns how many there are
  template <class F>
  std::size_t forEachElement(InitContext<D> const& context, F&& f) const {
    auto at = [&context](Index i) { return context.place(i); };
    auto cornersOf = [&at]<std::size_t N>(std::array<Index, N> const& e) {
      Eigen::Matrix<double, 3, int(N)> x;
      for (std::size_t k = 0; k < N; ++k) x.col(Eigen::Index(k)) = at(e[k]);
      return x;
    };
    std::size_t number = 0;
    // of k + 1 corners and size V: V (1 + delta_ij) / ((k + 1) (k + 2))
    auto simplices = [&](auto const& all, auto const& sizeOf) {
      for (auto const& e : all) {
        constexpr int corners = int(std::tuple_size_v<std::decay_t<decltype(e)>>);
        Eigen::Matrix<double, corners, corners> mass;
        mass.setOnes();
        mass.diagonal() *= 2;
        mass *= sizeOf(e) / (corners * (corners + 1));
        f(e, number++, mass);
      }
    };
    TopologyView const& t = context.topology;
    const bool highest = elements == MassElements::highest;
    const bool volumes = dimension_of(t) == 3, surfaces = dimension_of(t) == 2;
    auto have = [&](MassElements kind, bool ofHighest) { return highest ? ofHighest : elements == kind; };
    if (have(MassElements::tetrahedra, volumes))
      simplices(t.tetrahedra, [&](Tetrahedron const& e) {
        return std::abs((at(e[1]) - at(e[0])).dot((at(e[2]) - at(e[0])).cross(at(e[3]) - at(e[0])))) / 6;
      });
    if (have(MassElements::hexahedra, volumes))
      for (std::size_t h = 0; h < t.hexahedra.size(); ++h) {
        const bool weighted = fillWeighted && t.massFill.size() == t.hexahedra.size();
        f(t.hexahedra[h],
          number++,
          ((weighted ? t.massFill[h] : 1) * multilinear_mass<3>(cornersOf(t.hexahedra[h]))).eval());
      }
    auto collapsed = [&](auto const& all) {
      for (auto const& e : all) {
        const Hexahedron h = as_hexahedron(e);
        f(h, number++, multilinear_mass<3>(cornersOf(h)).eval());
      }
    };
    if (have(MassElements::pyramids, volumes)) collapsed(t.pyramids);
    if (have(MassElements::prisms, volumes)) collapsed(t.prisms);
    auto quadratic = [&]<std::size_t N>(std::span<std::array<Index, N> const> all) {
      for (auto const& e : all) f(e, number++, quadratic_mass(cornersOf(e)));
    };
    if (have(MassElements::quadraticTetrahedra, volumes)) quadratic(t.quadraticTetrahedra);
    if (have(MassElements::quadraticHexahedra, volumes)) quadratic(t.quadraticHexahedra);
    if (have(MassElements::triquadraticHexahedra, volumes)) quadratic(t.triquadraticHexahedra);
    // the triangles of a grid are the halves of its quads
    if (have(MassElements::triangles, surfaces && (t.grid[0] == 0 || t.quads.empty())))
      simplices(t.triangles, [&](Triangle const& e) {
        return (at(e[1]) - at(e[0])).cross(at(e[2]) - at(e[0])).norm() / 2;
      });
    if (have(MassElements::quads, surfaces))
      for (auto const& e : t.quads) f(e, number++, multilinear_mass<2>(cornersOf(e)));
    if (have(MassElements::edges, !volumes && !surfaces))
      simplices(t.edges, [&](Edge const& e) { return (at(e[1]) - at(e[0])).norm(); });
    return number;
  }
};

}  // namespace sinew
