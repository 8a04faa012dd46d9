// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/core/lists.hpp>
#include <sinew/topology/element_checks.hpp>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace sinew {

/// Diffusion within a linear tetrahedron, of each coordinate u of its four values on its own.
///   E = V/2 grad u . K grad u = 1/2 sum_{i<j} s_ij (u_i - u_j)^2,   s_ij = -V g_i . K g_j
///   f_i = -dE/du_i = sum_j s_ij (u_j - u_i)
/// with g_i the gradient of the shape function of point i [1/m], K the conductivity and V the volume.
template <class D>
struct TetrahedronDiffusion {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  static constexpr int arity = 4;
  static constexpr bool usesVelocity = false, oneByOne = true, symmetricBlocks = true;

  struct Rest {
    Real exchange[6];  // s of 01, 02, 03, 12, 13, 23
  };
  struct Tangent {};

  SINEW_HD Real energy(Rest const& rest, Coord const (&x)[4]) const {
    Real sum(0);
    eachEdge([&](int e, int i, int j) { sum += rest.exchange[e] * (x[i] - x[j]).squaredNorm(); });
    return Real(0.5) * sum;
  }
  SINEW_HD void force(Rest const& rest, Coord const (&x)[4], Deriv const (&)[4], Deriv (&f)[4],
                      Tangent&) const {
    flow(rest, x, Real(1), f);
  }
  SINEW_HD void dforce(Rest const& rest, Tangent const&, Deriv const (&dx)[4], Deriv (&df)[4], Real k,
                       Real /*b*/) const {
    flow(rest, dx, k, df);
  }
  SINEW_INLINE Mat<Real, D::size> block(Rest const& rest, Tangent const&, int i, int j, Real k,
                                        Real /*b*/) const {
    Real sum(0);
    eachEdge([&](int e, int a, int b) {
      if (i != j && ((a == i && b == j) || (a == j && b == i))) sum += rest.exchange[e];
      if (i == j && (a == i || b == i)) sum -= rest.exchange[e];
    });
    Mat<Real, D::size> block = Mat<Real, D::size>::Zero();
    for (int c = 0; c < D::size; ++c) block(c, c) = k * sum;
    return block;
  }

  /// f(number, i, j) for the edges, points in rising order.
  template <class F>
  SINEW_INLINE static void eachEdge(F&& f) {
    for (int i = 0, e = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) f(e++, i, j);
  }

 private:
  SINEW_INLINE static void flow(Rest const& rest, Coord const (&x)[4], Real factor, Deriv (&f)[4]) {
    for (auto& to : f) to = Deriv::Zero();
    eachEdge([&](int e, int i, int j) {
      const Deriv q = (x[j] - x[i]) * (factor * rest.exchange[e]);
      f[i] += q;
      f[j] -= q;
    });
  }
};

/// Diffusion of what the state has one value of for each point of a body, temperatures or concentrations u:
///   c du/dt = div(K grad u),   K = k (I + (r - 1) d d')
/// over the linear tetrahedra of the undeformed body, with no flow through its surface. The state stands in
/// a child node of the body and has no topology of its own; the tetrahedra are those of the nearest topology
/// above, and their points those of its state. The force is the flow of heat into each point [W]; a
/// MeshMatrixMass or a DiagonalMass beside it has the capacity c as its massDensity, and an
/// EulerImplicitSolver with `firstOrder` makes the velocity the rate of the temperature.
///
/// d are unit vectors: SOFA takes transverseAnisotropyArray with the length that it has.
template <class D>
struct TetrahedronDiffusionFEMForceField {
  using Role = role::ForceField;
  static constexpr bool sharesWork = true, overBody = true;
  using DataTypes = D;
  using Real = typename D::Real;
  static constexpr std::string_view className = "TetrahedronDiffusionFEMForceField";

  double constantDiffusionCoefficient = 1;
  std::vector<double> tetraDiffusionCoefficient{};
  double anisotropyRatio = 1;
  std::vector<Eigen::Vector3d> transverseAnisotropyArray{};

  static constexpr auto fields() {
    using F = TetrahedronDiffusionFEMForceField;
    return field_list(
        field("constantDiffusionCoefficient",
              &F::constantDiffusionCoefficient,
              "W/(m K)",
              "k, in [m^2/s] where the massDensity is 1",
              range::nonNegative),
        field("tetraDiffusionCoefficient",
              &F::tetraDiffusionCoefficient,
              "W/(m K)",
              "k of each tetrahedron, in the place of the constant one; or one value for all",
              range::nonNegative)
            .oneEach(Of::volumes),
        field("anisotropyRatio",
              &F::anisotropyRatio,
              "",
              "r: conductivity along the directions over that across them",
              range::positive),
        field("transverseAnisotropyArray",
              &F::transverseAnisotropyArray,
              "",
              "d: direction of each tetrahedron, or one for all, where anisotropyRatio is not 1")
            .oneEach(Of::volumes));
  }

  using Driver = ElementDriver<TetrahedronDiffusion, D>;
  Driver driver{};

  void init(InitContext<D> const& context) {
    static_assert(!D::rigid, "Sinew: TetrahedronDiffusionFEMForceField is over values, not over frames.");
    const std::string where = text(context.where, ": ", component_name<TetrahedronDiffusionFEMForceField>());
    auto const& tetrahedra = context.topology.tetrahedra;
    if (context.body.empty())
      throw Error(where,
                  "its values lie on no body; put their node, without a topology, below a node with a "
                  "MechanicalObject over Vec3d and a topology with tetrahedra");
    if (tetrahedra.empty())
      throw Error(where,
                  "the topology of the body has no tetrahedron; give it some (a Hexa2TetraTopologicalMapping "
                  "makes them of hexahedra)");
    check_values_of_body(where, context);
    detail::check_indices(where, "tetrahedron", tetrahedra, context.rest.size());
    const std::size_t n = tetrahedra.size();
    if (!tetraDiffusionCoefficient.empty())
      check_one_or_each(
          where, "tetraDiffusionCoefficient", tetraDiffusionCoefficient.size(), n, "tetrahedra");
    if (anisotropyRatio != 1)
      check_one_or_each(where,
                        "anisotropyRatio is not 1, and transverseAnisotropyArray",
                        transverseAnisotropyArray.size(),
                        n,
                        "tetrahedra",
                        "one direction");
    std::vector<typename Driver::Rest> rest;
    rest.reserve(n);
    for (std::size_t e = 0; e < n; ++e) rest.push_back(restOf(where, context, e));
    driver.init({tetrahedra.begin(), tetrahedra.end()}, rest);
  }

 private:
  Eigen::Matrix3d conductivity(std::string const& where, std::size_t e) const {
    const double k = tetraDiffusionCoefficient.empty() ? constantDiffusionCoefficient
                                                       : one_or_each(tetraDiffusionCoefficient, e);
    Eigen::Matrix3d all = k * Eigen::Matrix3d::Identity();
    if (anisotropyRatio == 1) return all;
    Eigen::Vector3d const& d = one_or_each(transverseAnisotropyArray, e);
    if (!(d.norm() > 0))
      throw Error(where,
                  text("direction ",
                       transverseAnisotropyArray.size() == 1 ? 0 : e,
                       " of transverseAnisotropyArray has no length; give a vector along the fibres"));
    return all + k * (anisotropyRatio - 1) / d.squaredNorm() * d * d.transpose();
  }

  typename Driver::Rest restOf(std::string const& where, InitContext<D> const& context, std::size_t e) const {
    Tetrahedron const& t = context.topology.tetrahedra[e];
    Eigen::Matrix3d sides;
    for (int c = 0; c < 3; ++c) sides.col(c) = context.place(t[std::size_t(c) + 1]) - context.place(t[0]);
    const double volume = std::abs(sides.determinant()) / 6, longest = sides.colwise().norm().maxCoeff();
    if (!(volume > 1e-14 * longest * longest * longest))
      throw Error(where, text("tetrahedron ", e, " has no volume; move or merge its points"));
    Eigen::Matrix<double, 3, 4> gradients;
    gradients.rightCols<3>() = sides.inverse().transpose();
    gradients.col(0) = -gradients.rightCols<3>().rowwise().sum();
    const Eigen::Matrix4d flow = volume * gradients.transpose() * conductivity(where, e) * gradients;
    typename Driver::Rest rest;
    TetrahedronDiffusion<D>::eachEdge(
        [&](int edge, int i, int j) { rest.exchange[edge] = Real(-flow(i, j)); });
    return rest;
  }
};

}  // namespace sinew
