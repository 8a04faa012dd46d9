// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/topology/hinges.hpp>

#include <Eigen/Geometry>
#include <vector>

namespace sinew {

/// Linear bending of two triangles about the edge that they share (Volino and Magnenat-Thalmann, "Simple
/// Linear Bending Stiffness in Particle Systems", 2006). Points are those opposite the edge, then its ends:
///   E = lambda/2 |R|^2,   R = sum_i alpha_i x_i,   f_i = -lambda alpha_i R                     [J], [N]
/// The weights alpha sum to zero, and make R vanish wherever the four points lie as flat as at rest.
template <class D>
struct LinearBending {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  static constexpr int arity = 4;
  static constexpr bool usesVelocity = false, oneByOne = true;

  struct Rest {
    Real weight[4];  // alpha
    Real stiffness;  // lambda [N/m]
  };
  struct Tangent {};

  SINEW_HD Real energy(Rest const& rest, Coord const (&x)[4]) const {
    return Real(0.5) * rest.stiffness * bent(rest, x).squaredNorm();
  }
  SINEW_HD void force(Rest const& rest, Coord const (&x)[4], Deriv const (&)[4], Deriv (&f)[4],
                      Tangent&) const {
    const Deriv r = bent(rest, x) * -rest.stiffness;
    for (int i = 0; i < 4; ++i) f[i] = r * rest.weight[i];
  }
  SINEW_HD void dforce(Rest const& rest, Tangent const&, Deriv const (&dx)[4], Deriv (&df)[4], Real k,
                       Real /*b*/) const {
    const Deriv r = bent(rest, dx) * (-k * rest.stiffness);
    for (int i = 0; i < 4; ++i) df[i] = r * rest.weight[i];
  }
  SINEW_INLINE Mat<Real, D::size> block(Rest const& rest, Tangent const&, int i, int j, Real k,
                                        Real /*b*/) const {
    const Real diagonal = -k * rest.stiffness * rest.weight[i] * rest.weight[j];
    Mat<Real, D::size> block;
    for (int c = 0; c < D::size; ++c)
      for (int r = 0; r < D::size; ++r) block(r, c) = r == c ? diagonal : Real(0);
    return block;
  }

 private:
  // differences first, so that what is far from the origin loses no digits
  SINEW_INLINE static Deriv bent(Rest const& rest, Deriv const (&x)[4]) {
    Deriv r = (x[0] - x[3]) * rest.weight[0];
    for (int i = 1; i < 3; ++i) r += (x[i] - x[3]) * rest.weight[i];
    return r;
  }
};

/// Bending of a surface of triangles that is flat at rest; a surface that is not is bent there, and tends to
/// be flat. An edge of length l between triangles of height h above it, folded by the angle phi from flat,
/// has E = 2 mu l / (3 h) sin^2(phi/2): that of the curvature phi/h over a third of the two triangles, since
/// each triangle has three edges. A sheet of equilateral triangles rolled up one way therefore has the
/// rigidity mu/3. The stiffness matrix is constant. To stretching it opposes nothing.
template <class D>
struct FastTriangularBendingSprings {
  using Role = role::ForceField;
  static constexpr bool sharesWork = true;
  using DataTypes = D;
  using Real = typename D::Real;
  static constexpr std::string_view className = "FastTriangularBendingSprings";

  double bendingStiffness = 1, minDistValidity = 1e-6;

  static constexpr auto fields() {
    using F = FastTriangularBendingSprings;
    return field_list(field("bendingStiffness",
                            &F::bendingStiffness,
                            "N m",
                            "mu: moment per length of an edge and curvature across it",
                            range::nonNegative),
                      field("minDistValidity",
                            &F::minDistValidity,
                            "m",
                            "edges that are shorter than this do not bend, nor do triangles whose far points "
                            "are nearer than this",
                            range::nonNegative));
  }

  using Driver = ElementDriver<LinearBending, D>;
  Driver driver{};
  bool hadEdges = false;  // a surface of which elements have gone may have lost them all

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<FastTriangularBendingSprings>());
    detail::check_indices(where, "triangle", context.topology.triangles, context.rest.size());
    std::vector<typename Driver::Indices> points;
    std::vector<typename Driver::Rest> rest;
    for (Hinge const& hinge : find_hinges(context.topology.triangles)) {
      const std::array<Index, 4> p{hinge.next[0][0], hinge.next[1][0], hinge.a, hinge.b};
      Eigen::Vector3d x[4];
      for (std::size_t i = 0; i < 4; ++i)
        x[i] = D::center(context.rest[std::size_t(p[i])]).template cast<double>();
      if ((x[1] - x[0]).norm() <= minDistValidity || (x[3] - x[2]).norm() <= minDistValidity) continue;
      // twice the areas of the triangles on both sides of the edge, and of those on both sides of the line
      // across it
      auto twice = [&x](int i, int j, int k) { return (x[j] - x[i]).cross(x[k] - x[i]).norm(); };
      const double a = twice(0, 2, 3), b = twice(1, 3, 2), c = twice(2, 1, 0), d = twice(3, 0, 1);
      const double length = (x[3] - x[2]).norm(), ha = a / length, hb = b / length;
      if (!(a > 0) || !(b > 0))
        throw Error(where,
                    text("a triangle at the edge from point ",
                         hinge.a,
                         " to ",
                         hinge.b,
                         " has no area; move or merge its points"));
      points.push_back(p);
      rest.push_back({{Real(b / (a + b)), Real(a / (a + b)), Real(-d / (c + d)), Real(-c / (c + d))},
                      Real(2. / 3 * (ha + hb) / (ha * ha * hb * hb) * length * bendingStiffness)});
    }
    hadEdges = hadEdges || !points.empty();
    if (!hadEdges && !context.topology.grows)
      throw Error(where,
                  "no two triangles share an edge; give the node a topology with some that do, and that are "
                  "larger than minDistValidity");
    driver.init(points, rest);
  }
};

}  // namespace sinew
