// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/core/ends.hpp>
#include <sinew/force/repulsive_spring_law.hpp>
#include <sinew/force/spring_lists.hpp>

#include <string>
#include <type_traits>
#include <vector>

namespace sinew {

/// Springs that keep points apart: each acts while it is shorter than without force. They are inside one body
/// (`E` = Within), or between the states at two paths (`E` = Between<"a", "b/c">, at a common ancestor; `E` =
/// Linked in a runtime tree), and given as those of StiffSpringForceField. A spring that is damped may pull
/// while its points part fast, as in SOFA.
template <class D, class E = Within>
struct RepulsiveSpringForceField {
  using Ends = E;
  template <class Other>
  using WithEnds = RepulsiveSpringForceField<D, Other>;
  static constexpr bool between = !std::is_same_v<E, Within>;
  using Role = std::conditional_t<between, role::InteractionForceField, role::ForceField>;
  using DataTypes = D;
  using Real = typename D::Real;
  static_assert(!D::rigid, "Sinew: RepulsiveSpringForceField is for points (Vec3d).");
  static constexpr std::string_view className = "RepulsiveSpringForceField";

  std::vector<Spring> springs{};
  [[no_unique_address]] E ends{};
  std::vector<int> springsIndices1{}, springsIndices2{};
  std::vector<double> stiffness{100}, damping{5}, lengths{};
  std::vector<bool> enabled{true};

  static constexpr auto fields() { return spring_fields<RepulsiveSpringForceField>(); }

  using Driver = ElementDriver<RepulsiveSpringLaw, D>;
  Driver driver{};

  void init(InitContext<D> const& context) { init(context, context); }
  void init(InitContext<D> const& a, InitContext<D> const& b) {
    const std::string where = text(a.where, ": ", component_name<RepulsiveSpringForceField>());
    std::vector<typename Driver::Indices> points;
    std::vector<typename Driver::Rest> rest;
    for_each_spring(where, *this, a, b, [&](std::size_t, std::size_t, Spring const& spring, Real length) {
      points.push_back({spring.first, spring.second});
      rest.push_back({Real(spring.stiffness), Real(spring.damping), length});
    });
    driver.init(points, rest);
  }
};

}  // namespace sinew
