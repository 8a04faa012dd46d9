// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/force/triangular_spring_law.hpp>

#include <vector>

namespace sinew {

template <class D>
using QuadraticTriangle = TriangularSpringLaw<D, false>;

/// A membrane of triangles whose sides are springs, joined in each triangle: linear elasticity for small
/// strains and any rotation (Delingette 2008). It does not bend.
template <class D>
struct TriangularQuadraticSpringsForceField {
  using Role = role::ForceField;
  static constexpr bool sharesWork = true;
  using DataTypes = D;
  static constexpr std::string_view className = "TriangularQuadraticSpringsForceField",
                                    aliases = "TriangularQuadraticSprings";
  static constexpr bool implicit = false;  // damping is that at the start of a step

  double youngModulus = 1000, poissonRatio = 0.3, dampingRatio = 0;
  bool useAngularSprings = true;

  static constexpr auto fields() {
    using F = TriangularQuadraticSpringsForceField;
    return field_list(
        field("youngModulus", &F::youngModulus, "N/m", "stiffness times thickness", range::positive),
        field("poissonRatio", &F::poissonRatio, "", "lateral contraction over extension", range::open(-1, 1)),
        field("dampingRatio",
              &F::dampingRatio,
              "s",
              "how much a rate of length counts as length",
              range::nonNegative),
        field("useAngularSprings",
              &F::useAngularSprings,
              "",
              "whether the sides of a triangle act on one another; else they are springs alone"));
  }

  bool hadElements = false;  // a surface may have lost all its triangles

  using Driver = ElementDriver<QuadraticTriangle, D>;
  using RestLaw = QuadraticTriangle<D>;
  Driver driver{};

  void init(InitContext<D> const& context) { init_triangular_springs(*this, context, false); }
};

}  // namespace sinew
