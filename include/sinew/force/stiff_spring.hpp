// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/core/ends.hpp>
#include <sinew/core/lists.hpp>
#include <sinew/force/rigid_spring_law.hpp>
#include <sinew/force/spring_ends.hpp>
#include <sinew/force/spring_law.hpp>

#include <optional>
#include <vector>

namespace sinew {

/// One spring of a StiffSpringForceField.
struct Spring {
  int first = 0, second = 0;
  double stiffness = 100, damping = 0;
  std::optional<double> length{};

  static constexpr auto fields() {
    return field_list(
        field("first", &Spring::first, "", "point at the first end", range::nonNegative)
            .numbersOf(Of::points),
        field("second", &Spring::second, "", "point at the second end", range::nonNegative)
            .numbersOf(Of::secondPoints),
        field("stiffness", &Spring::stiffness, "N/m", "force per extension", range::nonNegative),
        field("damping", &Spring::damping, "N s/m", "force per rate of extension", range::nonNegative),
        field("length",
              &Spring::length,
              "m",
              "length without force; that of the rest positions when not given",
              range::nonNegative));
  }
};

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
    constexpr Range r = range::nonNegative;
    return field_list(
        field("springs", &F::springs, "", "the springs: two points, stiffness, damping, length")
            .also("spring"),
        field("springsIndices1", &F::springsIndices1, "", "points at the first ends of further springs", r)
            .numbersOf(Of::points)
            .also("indices1"),
        field("springsIndices2", &F::springsIndices2, "", "points at their second ends", r)
            .numbersOf(Of::secondPoints)
            .also("indices2"),
        field("stiffness", &F::stiffness, "N/m", "force per extension of these: one for all, or each", r)
            .oneEach(Of::entries),
        field(
            "damping", &F::damping, "N s/m", "force per rate of extension of these: one for all, or each", r)
            .oneEach(Of::entries),
        field("lengths", &F::lengths, "m", "length without force of these: one for all, or each; else 0", r)
            .oneEach(Of::entries)
            .also("length"),
        field("elongationOnly",
              &F::elongationOnly,
              "",
              "whether springs act only when they are longer than without force: one for all, or each")
            .oneEach(Of::entries),
        field("enabled", &F::enabled, "", "whether springs are there: one for all, or each")
            .oneEach(Of::entries));
  }

  using Driver = std::conditional_t<D::rigid, ElementDriver<RigidSpringLaw, D>, ElementDriver<SpringLaw, D>>;
  Driver driver{};

  void init(InitContext<D> const& context) { init(context, context); }
  void init(InitContext<D> const& a, InitContext<D> const& b) {
    const std::string where = text(a.where, ": ", component_name<StiffSpringForceField>());
    const std::vector<Spring> all = springsOfLists(where);
    std::vector<typename Driver::Indices> points;
    std::vector<typename Driver::Rest> rest;
    for (std::size_t s = 0; s < all.size(); ++s) {
      Spring const& spring = all[s];
      check_spring_end(where, s, a, spring.first);
      check_spring_end(where, s, b, spring.second);
      if (!between && spring.first == spring.second)
        throw Error(where,
                    text("springs[", s, "] joins point ", spring.first, " to itself; give two points"));
      if (!of(where, "enabled", enabled, s, all.size(), true)) continue;
      const Real length =
          spring.length
              ? Real(*spring.length)
              : (D::center(b.rest[std::size_t(spring.second)]) - D::center(a.rest[std::size_t(spring.first)]))
                    .norm();
      const bool string = of(where, "elongationOnly", elongationOnly, s, all.size(), false);
      points.push_back({spring.first, spring.second});
      rest.push_back({Real(spring.stiffness), Real(spring.damping), string ? -length : length});
    }
    driver.init(points, rest);
  }

 private:
  // what a list says of one of n springs
  template <class T>
  static T of(std::string const& where, std::string_view name, std::vector<T> const& list, std::size_t spring,
              std::size_t n, T fallback) {
    if (list.empty()) return fallback;
    check_one_or_each(where, name, list.size(), n, "springs", "one for all");
    return one_or_each(list, spring);
  }

  // `springs`, and behind them those that the lists make
  std::vector<Spring> springsOfLists(std::string const& where) const {
    std::vector<Spring> all = springs;
    const std::size_t n = springsIndices1.size();
    if (springsIndices2.size() != n)
      throw Error(where,
                  text("springsIndices1 has ",
                       n,
                       " points and springsIndices2 ",
                       springsIndices2.size(),
                       "; give both ends of each spring"));
    for (std::size_t s = 0; s < n; ++s)
      all.push_back({springsIndices1[s],
                     springsIndices2[s],
                     of(where, "stiffness", stiffness, s, n, 100.0),
                     of(where, "damping", damping, s, n, 5.0),
                     of(where, "lengths", lengths, s, n, 0.0)});
    return all;
  }
};

}  // namespace sinew
