// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/force/triangular_spring_law.hpp>

#include <vector>

namespace sinew {

template <class D>
using BiquadraticTriangle = TriangularSpringLaw<D, true>;

/// A membrane of the material of St Venant and Kirchhoff as springs on the sides of triangles, of the squares
/// of their lengths (Delingette 2008): stiffer where it is stretched, softer where it is compressed, which
/// the area opposes where `compressible`. It does not bend.
template <class D>
struct TriangularBiquadraticSpringsForceField {
  using Role = role::ForceField;
  static constexpr bool sharesWork = true;
  using DataTypes = D;
  static constexpr std::string_view className = "TriangularBiquadraticSpringsForceField",
                                    aliases = "TriangularBiquadraticSprings";
  static constexpr bool implicit = false;  // damping is that at the start of a step

  double youngModulus = 1000, poissonRatio = 0.3, dampingRatio = 0;
  bool useAngularSprings = true, compressible = true;

  static constexpr auto fields() {
    using F = TriangularBiquadraticSpringsForceField;
    return field_list(
        field("youngModulus", &F::youngModulus, "N/m", "stiffness times thickness", range::positive),
        field("poissonRatio", &F::poissonRatio, "", "lateral contraction over extension", range::open(-1, 1)),
        field("dampingRatio",
              &F::dampingRatio,
              "m s",
              "how much a rate of length, over the length, counts as square of length",
              range::nonNegative),
        field("useAngularSprings",
              &F::useAngularSprings,
              "",
              "whether the sides of a triangle act on one another; else they are springs alone"),
        field("compressible",
              &F::compressible,
              "",
              "whether a triangle whose area shrinks pushes back with the third power of what it lost; only "
              "with useAngularSprings"));
  }

  bool hadElements = false;  // a surface may have lost all its triangles

  using Driver = ElementDriver<BiquadraticTriangle, D>;
  using RestLaw = BiquadraticTriangle<D>;
  Driver driver{};

  void init(InitContext<D> const& context) { init_triangular_springs(*this, context, compressible); }
};

}  // namespace sinew
