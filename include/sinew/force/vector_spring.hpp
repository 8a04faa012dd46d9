// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/core/ends.hpp>
#include <sinew/force/spring_ends.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace sinew {

/// One spring of a VectorSpringForceField.
struct VectorSpring {
  int first = 0, second = 0;
  double stiffness = 1, damping = 1;
  std::optional<Eigen::Vector3d> restVector{};

  static constexpr auto fields() {
    using S = VectorSpring;
    constexpr Range r = range::nonNegative;
    return field_list(
        field("first", &S::first, "", "point at the first end", r).numbersOf(Of::points),
        field("second", &S::second, "", "point at the second end", r).numbersOf(Of::secondPoints),
        field("stiffness", &S::stiffness, "N/m", "force per distance from where there is none", r),
        field("damping", &S::damping, "N s/m", "force per relative velocity", r),
        field("restVector",
              &S::restVector,
              "m",
              "from the first point to the second, without force; auto: that at rest"));
  }
};

/// Spring with a direction of its own between two points.
///   E = k/2 |d - L|^2,  d = x1 - x0       f0 = -f1 = k (d - L) + c d'
template <class D>
struct VectorSpringLaw {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  static constexpr int arity = 2;
  static constexpr bool usesVelocity = true, oneByOne = true;

  struct Rest {
    Real stiffness, damping;
    Deriv vector;  // L
  };
  struct Tangent {};

  SINEW_HD Real energy(Rest const& rest, Coord const (&x)[2]) const {
    const Deriv d = x[1] - x[0] - rest.vector;
    return Real(0.5) * rest.stiffness * d.squaredNorm();
  }
  SINEW_HD void force(Rest const& rest, Coord const (&x)[2], Deriv const (&v)[2], Deriv (&f)[2],
                      Tangent&) const {
    f[0] = (x[1] - x[0] - rest.vector) * rest.stiffness + (v[1] - v[0]) * rest.damping;
    f[1] = -f[0];
  }
  SINEW_HD void dforce(Rest const& rest, Tangent const&, Deriv const (&dx)[2], Deriv (&df)[2], Real k,
                       Real b) const {
    df[0] = (dx[1] - dx[0]) * (k * rest.stiffness + b * rest.damping);
    df[1] = -df[0];
  }
  SINEW_INLINE Mat<Real, D::size> block(Rest const& rest, Tangent const&, int i, int j, Real k,
                                        Real b) const {
    const Real factor = (k * rest.stiffness + b * rest.damping) * Real(i == j ? -1 : 1);
    Mat<Real, D::size> block;
    for (int c = 0; c < D::size; ++c)
      for (int r = 0; r < D::size; ++r) block(r, c) = r == c ? factor : Real(0);
    return block;
  }
};

/// Springs that hold the vector between two points, its direction in the world included: inside one body (`E`
/// = Within), or between the states at two paths (`E` = Between<"a", "b/c">, at a common ancestor; `E` =
/// Linked in a runtime tree). They are given one by one; or with `useTopology` they lie along the edges of
/// the topology, as these are at rest; or they join each point of the first state to the one of the same
/// number of the second, in one place. The tangent has the damping, which SOFA's leaves to the start of the
/// step.
template <class D, class E = Within>
struct VectorSpringForceField {
  using Ends = E;
  template <class Other>
  using WithEnds = VectorSpringForceField<D, Other>;
  static constexpr bool between = !std::is_same_v<E, Within>;
  using Role = std::conditional_t<between, role::InteractionForceField, role::ForceField>;
  using DataTypes = D;
  using Real = typename D::Real;
  static_assert(!D::rigid && D::size == 3, "Sinew: VectorSpringForceField is for points in space (Vec3d).");
  static constexpr std::string_view className = "VectorSpringForceField";

  std::vector<VectorSpring> springs{};
  [[no_unique_address]] E ends{};
  double stiffness = 1, viscosity = 1;
  bool useTopology = false;

  static constexpr auto fields() {
    using F = VectorSpringForceField;
    constexpr Range r = range::nonNegative;
    return field_list(
        field("springs", &F::springs, "", "the springs: two points, stiffness, damping, rest vector or auto"),
        field("stiffness", &F::stiffness, "N/m", "stiffness of each, where springs are not given", r),
        field("viscosity", &F::viscosity, "N s/m", "damping of each, likewise", r),
        field("useTopology",
              &F::useTopology,
              "",
              "springs are the edges of the topology, where none is given"));
  }

  // the direction of a spring stays, whatever the body does
  static constexpr ForceProperties properties() { return {.objective = false}; }

  using Driver = ElementDriver<VectorSpringLaw, D>;
  Driver driver{};

  void init(InitContext<D> const& context) { init(context, context); }
  void init(InitContext<D> const& a, InitContext<D> const& b) {
    const std::string where = text(a.where, ": ", component_name<VectorSpringForceField>());
    auto restOf = [&](std::size_t, VectorSpring const& spring) -> typename Driver::Rest {
      const typename D::Deriv vector =
          spring.restVector
              ? typename D::Deriv(spring.restVector->template cast<Real>())
              : typename D::Deriv(b.rest[std::size_t(spring.second)] - a.rest[std::size_t(spring.first)]);
      return {Real(spring.stiffness), Real(spring.damping), vector};
    };
    init_springs(*this, where, springs.empty() ? implied(where, a, b) : springs, a, b, {}, restOf);
  }

 private:
  std::vector<VectorSpring> implied(std::string const& where, InitContext<D> const& a,
                                    InitContext<D> const& b) const {
    std::vector<VectorSpring> all;
    if (useTopology) {
      if (a.topology.edges.empty())
        throw Error(where, "useTopology is on, and the topology has no edges; give it some, or give springs");
      for (Edge const& e : a.topology.edges) {
        VectorSpring one{.first = e[0], .second = e[1], .stiffness = stiffness, .damping = viscosity};
        if (e[0] >= 0 && e[1] >= 0 && std::size_t(std::max(e[0], e[1])) < a.rest.size())
          one.restVector = (a.rest[std::size_t(e[1])] - a.rest[std::size_t(e[0])]).template cast<double>();
        all.push_back(one);
      }
    } else if (!between) {
      throw Error(where, "there is no spring; give springs, or useTopology=\"1\" for one along each edge");
    } else {
      if (a.rest.size() != b.rest.size())
        throw Error(where,
                    text("each point of ",
                         a.where,
                         " is joined to that of the same number of ",
                         b.where,
                         ", but they have ",
                         a.rest.size(),
                         " and ",
                         b.rest.size(),
                         " points; give springs one by one"));
      for (int i = 0; i < int(a.rest.size()); ++i)
        all.push_back({i, i, stiffness, viscosity, Eigen::Vector3d(0, 0, 0)});
    }
    return all;
  }
};

}  // namespace sinew
