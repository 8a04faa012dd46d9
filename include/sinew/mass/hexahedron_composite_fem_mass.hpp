// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/force/composite_cells.hpp>
#include <sinew/mass/consistent_mass.hpp>
#include <sinew/mass/lumped_mass.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace sinew {

/// The mass of the hexahedra of a HexahedronCompositeFEMForceField: that of the finer cells of the grid, each
/// as heavy as it is filled, and of its material. With M_c the consistent mass of a finest cell and W_c how
/// its corners follow those of the hexahedron, it is sum_c W_c' M_c W_c, of which the mean over the axes
/// counts, times the identity. Together it is the mass of the cells. `lumping` keeps its row sums only.
template <class D>
struct HexahedronCompositeFEMMass {
  using Role = role::Mass;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "HexahedronCompositeFEMMass";

  std::optional<int> nbVirtualFinerLevels{};
  double poissonRatio = 0.45;
  CellInterpolation interpolation = CellInterpolation::condensed;
  bool finestToCoarse = false;
  double massDensity = 1;
  bool lumping = false;

  static constexpr auto fields() {
    using M = HexahedronCompositeFEMMass;
    return composite_cell_fields<M>(
        field("massDensity", &M::massDensity, "kg/m^3", "density of what is filled", range::positive)
            .also("density"),
        field("lumping", &M::lumping, "", "keep the row sums only").also("lumpedMass"));
  }

  LumpedMass<D> lumped{};          // the row sums
  ConsistentMass<D> consistent{};  // empty when lumped

  /// M^-1 undoes M.
  bool exactInverse() const { return consistent.empty(); }

  /// Throws Error as HexahedronCompositeFEMForceField does, and where a point has no mass.
  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<HexahedronCompositeFEMMass>());
    const CompositeCells cells(where, context.topology, cell_composition(*this));
    auto const& hexahedra = context.topology.hexahedra;
    const std::size_t n = context.rest.size();
    detail::check_indices(where, "hexahedron", hexahedra, n);
    consistent = {};
    auto& matrix = consistent.matrix;
    matrix.startPattern(int(n));
    for (auto const& h : hexahedra)
      for (const Index i : h)
        for (const Index j : h) matrix.preallocate(i, j, 1, 1);
    matrix.finishPattern();
    std::vector<double> rows(n, 0.0), values(matrix.columns.size(), 0.0);
    for (std::size_t e = 0; e < hexahedra.size(); ++e) {
      auto const& h = hexahedra[e];
      Eigen::Vector3d x[8];
      for (std::size_t k = 0; k < 8; ++k) x[k] = context.place(h[k]);
      const auto mass = cells.cell(e, x, false).mass;
      for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t j = 0; j < 8; ++j) {
          const double m = massDensity * mass(Eigen::Index(i), Eigen::Index(j));
          if (h[i] <= h[j]) values[std::size_t(matrix.slot(int(h[i]), int(h[j])))] += m;
          rows[std::size_t(h[i])] += m;
        }
    }
    for (std::size_t k = 0; k < values.size(); ++k) matrix.values[k] = Real(values[k]);
    std::vector<typename D::MassType> sums(n);
    for (std::size_t i = 0; i < n; ++i) sums[i] = Real(rows[i]);
    lumped.init(where, sums);
    if (lumping) consistent = {};
  }

  void addForce(MechanicalParams const& p, VecDeriv& f, VecCoord const& x, VecDeriv const& v) const {
    lumped.addForce(p, f, x, v);
  }
  void addMDx(VecDeriv& f, VecCoord const& x, VecDeriv const& dx, double factor) const {
    if (lumping) return lumped.addMDx(f, x, dx, Real(factor));
    consistent.addMDx(f, dx, factor);
  }
  void accFromF(VecDeriv& a, VecCoord const& x, VecDeriv const& f) const { lumped.accFromF(a, x, f); }
  double kineticEnergy(VecCoord const& x, VecDeriv const& v) const {
    return lumping ? lumped.kineticEnergy(x, v) : consistent.kineticEnergy(v);
  }
  template <class Sink>
  void addToMatrix(MechanicalParams const& p, VecCoord const& x, Sink const& sink) {
    if (lumping) return lumped.addToMatrix(x, Real(p.m), sink);
    consistent.addToMatrix(p, sink);
  }
};

}  // namespace sinew
