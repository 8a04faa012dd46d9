// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/core/lists.hpp>
#include <sinew/force/composite_cells.hpp>
#include <sinew/force/hexahedron_rotation.hpp>

#include <optional>
#include <string>
#include <vector>

namespace sinew {

/// Corotational hexahedron with a stiffness matrix K of its own, that turns as HexahedronFrame says. With y
/// the corners at rest in the frame of the element, from corner 0 on, and R the rotation of the element:
///   u_i = R'(x_i - x_0) - y_i,   E = u'K u/2 [J],   f_i = -R sum_j K_ij u_j [N]
/// The tangent holds R fixed. K is symmetric, and nothing that moves the element as a whole costs energy.
template <class D>
struct CompositeHexahedron {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  using Vec3 = Vec<Real, 3>;
  using Mat3 = Mat<Real, 3>;
  static constexpr int arity = 8;
  static constexpr bool usesVelocity = false;

  struct Rest {
    Real stiffness[300];  // on and above the diagonal, row by row [N/m]
    Vec3 corner[8];       // y [m]
    Vec3 slope[8];        // A = sum_m x_m slope_m', see HexahedronFrame
    Mat3 center;          // A_rest^-1, for `nearest`
  };
  struct Tangent {
    Mat3 rotation;
  };

  HexahedronMethod method = HexahedronMethod::large;

  static constexpr int place(int row, int column) {
    return row <= column ? row * 24 - row * (row - 1) / 2 + column - row : place(column, row);
  }

  SINEW_HD Real energy(Rest const& rest, Coord const (&x)[8]) const {
    Real u[24], ku[24];
    displacement(rest, rotation(rest, x), x, Real(1), u);
    multiply(rest, u, ku);
    Real sum(0);
    for (int a = 3; a < 24; ++a) sum += Real(0.5) * u[a] * ku[a];
    return sum;
  }

  SINEW_HD void force(Rest const& rest, Coord const (&x)[8], Deriv const (&)[8], Deriv (&f)[8],
                      Tangent& tangent) const {
    tangent.rotation = rotation(rest, x);
    internalForce(rest, tangent.rotation, x, Real(1), Real(-1), f);
  }

  SINEW_HD void dforce(Rest const& rest, Tangent const& tangent, Deriv const (&dx)[8], Deriv (&df)[8], Real k,
                       Real /*b*/) const {
    internalForce(rest, tangent.rotation, dx, Real(0), -k, df);
  }

  /// -k R K_ij R'
  SINEW_HD Mat3 block(Rest const& rest, Tangent const& tangent, int i, int j, Real k, Real /*b*/) const {
    Mat3 s;
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r) s(r, c) = rest.stiffness[place(3 * i + r, 3 * j + c)];
    Mat3 const& q = tangent.rotation;
    return q * (-k * (s * q.transpose()));
  }

 private:
  SINEW_INLINE Mat3 rotation(Rest const& rest, Coord const (&x)[8]) const {
    Mat3 a;
    for (int c = 0; c < 9; ++c) a(c) = Real(method == HexahedronMethod::small && c % 4 == 0 ? 1 : 0);
    if (method == HexahedronMethod::small) return a;
    for (int m = 1; m < 8; ++m) {
      const Vec3 d = x[m] - x[0];
      for (int k = 0; k < 3; ++k)
        for (int c = 0; c < 3; ++c) a(c, k) += d[c] * rest.slope[m][k];
    }
    return rotation_of_jacobian<Real>(method, rest.center, a);
  }
  // R'(x - x_0) - one y
  SINEW_INLINE static void displacement(Rest const& rest, Mat3 const& r, Coord const (&x)[8], Real one,
                                        Real (&u)[24]) {
    for (int i = 0; i < 8; ++i) {
      const Vec3 d = x[i] - x[0];
      for (int c = 0; c < 3; ++c)
        u[3 * i + c] = r(0, c) * d[0] + r(1, c) * d[1] + r(2, c) * d[2] - one * rest.corner[i][c];
    }
  }
  // K u on the corners 1 to 7; u of corner 0 is zero
  SINEW_INLINE static void multiply(Rest const& rest, Real const (&u)[24], Real (&ku)[24]) {
    for (int a = 3; a < 24; ++a) ku[a] = Real(0);
    for (int a = 3; a < 24; ++a) {
      Real const* const row = rest.stiffness + place(a, a);
      Real sum = row[0] * u[a];
      for (int b = a + 1; b < 24; ++b) {
        sum += row[b - a] * u[b];
        ku[b] += row[b - a] * u[a];
      }
      ku[a] += sum;
    }
  }
  // factor R K u; the forces sum to zero
  SINEW_HD void internalForce(Rest const& rest, Mat3 const& r, Coord const (&x)[8], Real one, Real factor,
                              Deriv (&f)[8]) const {
    Real u[24], ku[24];
    displacement(rest, r, x, one, u);
    multiply(rest, u, ku);
    for (int c = 0; c < 3; ++c) f[0][c] = Real(0);
    for (int i = 1; i < 8; ++i)
      for (int c = 0; c < 3; ++c) {
        f[i][c] = factor * (r(c, 0) * ku[3 * i] + r(c, 1) * ku[3 * i + 1] + r(c, 2) * ku[3 * i + 2]);
        f[0][c] -= f[i][c];
      }
  }
};

/// An elastic body of corotational hexahedra over a grid, each of which is as stiff as the finer cells that
/// it is made of (Nesme, Kry, Jerabkova, Faure 2009, Preserving topology and elasticity for embedded
/// deformable models). A SparseGridTopology, SparseGridRamificationTopology or SparseGridMultipleTopology
/// with nbVirtualFinerLevels has these cells, each as stiff as it is filled, and of its material. So a few
/// hexahedra bend and stretch as a body whose stiffness varies inside them. With K_c the stiffness of a
/// finest cell and W_c how its corners follow those of the hexahedron, K = sum_c W_c' K_c W_c.
///
/// With interpolation="trilinear" finer cells follow along straight lines, which is SOFA's
/// NonUniformHexahedronFEMForceFieldAndMass (Nesme, Payan, Faure 2006): stiffer, and exact where the material
/// is one. A HexahedronCompositeFEMMass has the mass of these cells, and a HexahedronCompositeFEMMapping
/// shows how they move.
template <class D>
struct HexahedronCompositeFEMForceField {
  using Role = role::ForceField;
  static constexpr bool sharesWork = true;
  using DataTypes = D;
  using Real = typename D::Real;
  static constexpr std::string_view className = "HexahedronCompositeFEMForceField";

  std::optional<int> nbVirtualFinerLevels{};
  double poissonRatio = 0.45;
  CellInterpolation interpolation = CellInterpolation::condensed;
  bool finestToCoarse = false;
  HexahedronMethod method = HexahedronMethod::large;
  std::vector<double> youngModulus{5000};  // one for all hexahedra, or one for each

  static constexpr auto fields() {
    using F = HexahedronCompositeFEMForceField;
    return composite_cell_fields<F>(hexahedron_method_field<F>(),
                                    field("youngModulus",
                                          &F::youngModulus,
                                          "Pa",
                                          "stiffness of the material: one value, or one a hexahedron",
                                          range::positive)
                                        .oneEach(Of::hexahedra));
  }

  ForceProperties properties() const {
    const bool small = method == HexahedronMethod::small;
    return {.objective = !small, .conservative = small, .exactTangent = small};
  }

  using Driver = ElementDriver<CompositeHexahedron, D>;
  using Law = typename Driver::Law;
  Driver driver{};

  Law law() const { return Law{method}; }

  void init(InitContext<D> const& context) {
    auto const& hexahedra = context.topology.hexahedra;
    const std::string where = text(context.where, ": ", component_name<HexahedronCompositeFEMForceField>());
    const CompositeCells cells(where, context.topology, cell_composition(*this));
    detail::check_indices(where, "hexahedron", hexahedra, context.rest.size());
    check_one_or_each(where, "youngModulus", youngModulus.size(), hexahedra.size(), "hexahedra");
    std::vector<typename Driver::Rest> rest(hexahedra.size());
    for (std::size_t e = 0; e < hexahedra.size(); ++e) {
      Eigen::Vector3d x[8];
      for (std::size_t k = 0; k < 8; ++k)
        x[k] = context.rest[std::size_t(hexahedra[e][k])].template cast<double>();
      const auto cell = cells.cell(e, x, false);
      for (int a = 0; a < 24; ++a)
        for (int b = a; b < 24; ++b)
          rest[e].stiffness[CompositeHexahedron<D>::place(a, b)] =
              Real(one_or_each(youngModulus, e) * (cell.stiffness(a, b) + cell.stiffness(b, a)) / 2);
      for (int k = 0; k < 8; ++k) {
        rest[e].corner[k] = (cell.frame.rest.transpose() * (x[k] - x[0])).template cast<Real>();
        rest[e].slope[k] = cell.frame.slopes.row(k).transpose().template cast<Real>();
      }
      rest[e].center = cell.frame.center.template cast<Real>();
    }
    driver.init({hexahedra.begin(), hexahedra.end()}, rest);
  }
};

}  // namespace sinew
