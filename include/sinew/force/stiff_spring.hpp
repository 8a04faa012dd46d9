// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/core/ends.hpp>
#include <sinew/force/rigid_spring_law.hpp>
#include <sinew/force/spring_law.hpp>
#include <sinew/force/spring_lists.hpp>

#include <vector>

namespace sinew {

/// Springs inside one body (`E` = Within), or between the states at two paths (`E` = Between<"a", "b/c">, at
/// a common ancestor; `E` = Linked in a runtime tree); `first` then counts points of the first. Of rigid
/// bodies they join the centres. They are given one by one as `springs`, or as lists that have one entry for
/// each: springsIndices1 and springsIndices2, of which the springs have `stiffness`, `damping` and `lengths`.
template <class D, class E = Within>
struct StiffSpringForceField {
  using Ends = E;
  template <class Other>
  using WithEnds = StiffSpringForceField<D, Other>;
  static constexpr bool between = !std::is_same_v<E, Within>;
  using Role = std::conditional_t<between, role::InteractionForceField, role::ForceField>;
  static constexpr bool sharesWork = !between;
  using DataTypes = D;
  using Real = typename D::Real;
  static constexpr std::string_view className = "StiffSpringForceField";
  static constexpr std::string_view aliases = "SpringForceField";

  std::vector<Spring> springs{};
  [[no_unique_address]] E ends{};
  std::vector<int> springsIndices1{}, springsIndices2{};
  std::vector<double> stiffness{100}, damping{5}, lengths{};
  std::vector<bool> elongationOnly{false}, enabled{true};

  static constexpr auto fields() {
    using F = StiffSpringForceField;
    return spring_fields<F>(field("elongationOnly",
                                  &F::elongationOnly,
                                  "",
                                  "whether springs act only when they are longer than without force: one for "
                                  "all, or each")
                                .oneEach(Of::entries));
  }

  using Driver = std::conditional_t<D::rigid, ElementDriver<RigidSpringLaw, D>, ElementDriver<SpringLaw, D>>;
  Driver driver{};

  void init(InitContext<D> const& context) { init(context, context); }
  void init(InitContext<D> const& a, InitContext<D> const& b) {
    const std::string where = text(a.where, ": ", component_name<StiffSpringForceField>());
    std::vector<typename Driver::Indices> points;
    std::vector<typename Driver::Rest> rest;
    for_each_spring(where, *this, a, b, [&](std::size_t s, std::size_t n, Spring const& spring, Real length) {
      const bool string = of_spring(where, "elongationOnly", elongationOnly, s, n, false);
      points.push_back({spring.first, spring.second});
      rest.push_back({Real(spring.stiffness), Real(spring.damping), string ? -length : length});
    });
    driver.init(points, rest);
  }
};

}  // namespace sinew
