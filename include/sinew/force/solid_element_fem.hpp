// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/core/lists.hpp>
#include <sinew/force/elasticity.hpp>
#include <sinew/force/rotations.hpp>
#include <sinew/topology/element_shapes.hpp>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>
#include <vector>

namespace sinew {

/// How the rotation of a corotational element is found.
///   polar    nearest to H = sum_i x_i (X_i - mean X)', with X_i the nodes at rest, as SOFA's "polar"
///   small    none: linear elasticity
///   nearest  nearest to H S^-1, S being H at rest: to the deformation gradient of an affine motion
enum class ElementRotation { polar, small, nearest };
inline constexpr std::array<std::string_view, 3> enum_names(ElementRotation) {
  return {"polar", "small", "nearest"};
}

/// An element of an isotropic material with the shape functions N_i of any Shape
/// (topology/element_shapes.hpp), corotational (Felippa & Haugen 2005). With the deformation gradient F =
/// sum_i x_i grad N_i' in a Gauss point and R the rotation of the element:
///   E = sum_g w_g (mu e:e + lambda/2 tr(e)^2),   e = sym(R'F) - I                                [J]
///   f_i = -R sum_g w_g s grad N_i,   s = 2 mu e + lambda tr(e) I                                 [N]
/// The tangent holds R fixed.
template <class D, class Shape>
struct SolidElementFEM {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  using Vec3 = Vec<Real, 3>;
  using Mat3 = Mat<Real, 3>;
  static constexpr std::size_t N = Shape::nodes, G = Shape::points;  // of arrays
  static constexpr int arity = int(N), points = int(G);
  static constexpr bool usesVelocity = false;

  struct Rest {
    Mat3 inverse[G];   // J^-1 in each Gauss point [1/m]
    Real weight[G];    // its weight times det J [m^3]
    Vec3 node[N];      // X_i - mean X over the sum of the squares of all [1/m]
    Mat3 inverseRest;  // S^-1 times that sum, for `nearest`
    IsotropicMaterial<Real> material;
  };
  struct Tangent {
    Mat3 rotation;
  };

  ElementRotation method = ElementRotation::polar;

  SINEW_HD Real energy(Rest const& rest, Coord const (&x)[N]) const {
    Vec3 y[N];
    rotate_back(rotation(rest, x), x, y);
    Real sum(0);
    for (int g = 0; g < points; ++g)
      sum += rest.weight[g] * rest.material.energy(strain(rest, y, g, Real(1)));
    return sum;
  }

  SINEW_HD void force(Rest const& rest, Coord const (&x)[N], Deriv const (&)[N], Deriv (&f)[N],
                      Tangent& tangent) const {
    tangent.rotation = rotation(rest, x);
    internalForce(rest, tangent.rotation, x, Real(1), Real(-1), f);
  }

  SINEW_HD void dforce(Rest const& rest, Tangent const& tangent, Deriv const (&dx)[N], Deriv (&df)[N], Real k,
                       Real /*b*/) const {
    internalForce(rest, tangent.rotation, dx, Real(0), -k, df);
  }

  /// -k R sum_g w (lambda h_i h_j' + mu h_j h_i' + mu h_i.h_j I) R',  h_i = grad N_i
  SINEW_HD Mat3 block(Rest const& rest, Tangent const& tangent, int i, int j, Real k, Real /*b*/) const {
    Mat3 m;  // sum_g w h_i h_j'
    for (int c = 0; c < 9; ++c) m(c) = Real(0);
    for (int g = 0; g < points; ++g) {
      const Vec3 hi = gradient(rest, g, i) * rest.weight[g], hj = gradient(rest, g, j);
      for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) m(r, c) += hi[r] * hj[c];
    }
    return rotated(tangent.rotation, rest.material.stiffness(m, -k));
  }

  /// Rest data of the element with rest positions x, whichever way round its nodes go; a weight that is not
  /// positive tells of a bad shape.
  static Rest restOf(Coord const (&x)[N], Real mu, Real lambda) {
    Rest rest;
    for (int g = 0; g < points; ++g) {
      Mat3 j = Mat3::Zero();
      for (int i = 0; i < arity; ++i)
        for (int k = 0; k < 3; ++k) j.col(k) += Vec3(x[i] - x[0]) * slopes(g, i, k);
      rest.inverse[g] = j.inverse();
      rest.weight[g] = Real(Shape::weight(std::size_t(g))) * j.determinant();
    }
    Real volume(0);
    for (Real const& w : rest.weight) volume += w;
    if (volume < Real(0))
      for (Real& w : rest.weight) w = -w;
    Vec3 mean = Vec3::Zero();
    for (int i = 0; i < arity; ++i) mean += Vec3(x[i] - x[0]) / Real(arity);
    Real squares(0);
    for (int i = 0; i < arity; ++i) {
      rest.node[i] = Vec3(x[i] - x[0]) - mean;
      squares += rest.node[i].squaredNorm();
    }
    Mat3 atRest = Mat3::Zero();
    for (int i = 0; i < arity; ++i) {
      atRest += rest.node[i] * rest.node[i].transpose() / squares;
      rest.node[i] /= squares;
    }
    rest.inverseRest = atRest.inverse();
    rest.material = {mu, lambda};
    return rest;
  }

 private:
  SINEW_INLINE static Real slopes(int g, int i, int k) {
    return Real(static_cast<lane_scalar<Real>>(shape_slopes<Shape>.at[g][i][k]));
  }

  SINEW_INLINE Mat3 rotation(Rest const& rest, Coord const (&x)[N]) const {
    Mat3 r;
    if (method == ElementRotation::small) {
      for (int c = 0; c < 9; ++c) r(c) = Real(c % 4 == 0 ? 1 : 0);
      return r;
    }
    for (int c = 0; c < 9; ++c) r(c) = Real(0);
    for (int i = 1; i < arity; ++i) {
      const Vec3 d = x[i] - x[0];
      for (int c = 0; c < 3; ++c)
        for (int k = 0; k < 3; ++k) r(k, c) += d[k] * rest.node[i][c];
    }
    return nearest_rotation(method == ElementRotation::polar ? r : r * rest.inverseRest);
  }
  // sym(sum_i y_i grad N_i') - one I; y_0 = 0
  SINEW_INLINE static Mat3 strain(Rest const& rest, Vec3 const (&y)[N], int g, Real one) {
    Mat3 column;
    for (int c = 0; c < 9; ++c) column(c) = Real(0);
    for (int i = 1; i < arity; ++i)
      for (int k = 0; k < 3; ++k) {
        const Real slope = slopes(g, i, k);
        for (int c = 0; c < 3; ++c) column(c, k) += y[i][c] * slope;
      }
    return small_strain(column * rest.inverse[g], one);
  }
  // f = factor R sum_g w s grad N at the strain of positions (one = 1) or displacements (one = 0)
  SINEW_HD void internalForce(Rest const& rest, Mat3 const& r, Coord const (&x)[N], Real one, Real factor,
                              Deriv (&f)[N]) const {
    Vec3 y[N], sum[N];
    rotate_back(r, x, y);
    for (int i = 0; i < arity; ++i)
      for (int c = 0; c < 3; ++c) sum[i][c] = Real(0);
    for (int g = 0; g < points; ++g) {
      const Mat3 e = strain(rest, y, g, one);
      const Real weight = factor * rest.weight[g], mu2 = Real(2) * rest.material.mu * weight,
                 pressure = rest.material.lambda * weight * (e(0, 0) + e(1, 1) + e(2, 2));
      const Mat3 inverse = rest.inverse[g].transpose();
      const Mat3 pull = mu2 * (e * inverse) + pressure * inverse;  // s J^-T
      for (int i = 0; i < arity; ++i)
        for (int k = 0; k < 3; ++k) {
          const Real slope = slopes(g, i, k);
          for (int c = 0; c < 3; ++c) sum[i][c] += pull(c, k) * slope;
        }
    }
    for (int i = 0; i < arity; ++i) f[i] = r * sum[i];
  }
  // of shape function i in Gauss point g
  SINEW_INLINE static Vec3 gradient(Rest const& rest, int g, int i) {
    return rest.inverse[g].transpose() * Vec3(slopes(g, i, 0), slopes(g, i, 1), slopes(g, i, 2));
  }
};

/// What the force fields of a kind of elements have in common; the Kind says which elements, their Shape, and
/// what scene files call them.
template <class D, class Kind>
struct SolidElementFEMForceField {
  using Role = role::ForceField;
  static constexpr bool sharesWork = true;
  using DataTypes = D;
  using Real = typename D::Real;
  static constexpr std::string_view className = Kind::className, aliases = Kind::aliases;

  std::vector<double> youngModulus{5000};  // one for all elements, or one for each
  double poissonRatio = 0.45;
  ElementRotation method = ElementRotation::polar;

  static constexpr auto fields() {
    using F = SolidElementFEMForceField;
    return field_list(
        field("youngModulus",
              &F::youngModulus,
              "Pa",
              "stiffness of the material: one value, or one an element",
              range::positive)
            .oneEach(Kind::entries),
        field("poissonRatio",
              &F::poissonRatio,
              "",
              "lateral contraction over extension; 0.5 is incompressible",
              range::open(-1, 0.5)),
        field(
            "method",
            &F::method,
            "",
            "rotation of an element: polar: as in SOFA, the nearest to the places of its nodes; small: none, "
            "linear elasticity; nearest: the nearest to its deformation"));
  }

  ForceProperties properties() const {
    const bool small = method == ElementRotation::small;
    return {.objective = !small, .conservative = small, .exactTangent = small};
  }

  template <class T>
  using LawOf = SolidElementFEM<T, typename Kind::Shape>;
  using Driver = ElementDriver<LawOf, D>;
  using Law = typename Driver::Law;
  Driver driver{};

  Law law() const { return Law{method}; }

  /// Throws Error where there is no element, an index leads nowhere, or an element is flat or twisted.
  void init(InitContext<D> const& context) {
    auto const& elements = Kind::of(context.topology);
    const std::string where = text(context.where, ": ", component_name<SolidElementFEMForceField>());
    if (elements.empty() && !context.topology.grows)
      throw Error(where,
                  text("the topology has no ", Kind::noun, "; give the node a topology with ", Kind::plural));
    detail::check_indices(where, Kind::noun, elements, context.rest.size());
    if constexpr (Kind::Shape::nodes > 8)
      for (std::size_t e = 0; e < elements.size(); ++e)
        detail::check_distinct(where, Kind::noun, elements[e], e);
    check_one_or_each(where, "youngModulus", youngModulus.size(), elements.size(), Kind::plural);
    std::vector<typename Driver::Rest> rest;
    rest.reserve(elements.size());
    for (std::size_t e = 0; e < elements.size(); ++e) {
      typename D::Coord x[Kind::Shape::nodes];
      Real longest(0);
      for (std::size_t k = 0; k < Kind::Shape::nodes; ++k) {
        x[k] = context.rest[std::size_t(elements[e][k])];
        longest = std::max(longest, (x[k] - x[0]).norm());
      }
      const LameModuli moduli = lame_moduli(one_or_each(youngModulus, e), poissonRatio);
      rest.push_back(LawOf<D>::restOf(x, Real(moduli.mu), Real(moduli.lambda)));
      auto const& weights = rest.back().weight;
      const auto folded = std::count_if(std::begin(weights), std::end(weights), [&](Real w) {
        return !(w > Real(1e-12) * longest * longest * longest);
      });
      if (folded > 0)
        throw Error(where,
                    text(Kind::noun,
                         ' ',
                         e,
                         " is flat or twisted: the determinant of its Jacobian is not positive in ",
                         folded,
                         " of ",
                         std::size(weights),
                         " Gauss points; ",
                         Kind::order));
    }
    driver.init({elements.begin(), elements.end()}, rest);
  }
};

}  // namespace sinew
