// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/lists.hpp>
#include <sinew/force/spring_ends.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// One spring between two points.
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

/// The fields of a force field of springs, which are given one by one or as lists with an entry for each.
template <class F, class... More>
constexpr auto spring_fields(More... more) {
  constexpr Range r = range::nonNegative;
  return field_list(
      field("springs", &F::springs, "", "the springs: two points, stiffness, damping, length").also("spring"),
      field("springsIndices1", &F::springsIndices1, "", "points at the first ends of further springs", r)
          .numbersOf(Of::points)
          .also("indices1"),
      field("springsIndices2", &F::springsIndices2, "", "points at their second ends", r)
          .numbersOf(Of::secondPoints)
          .also("indices2"),
      field("stiffness", &F::stiffness, "N/m", "force per extension of these: one for all, or each", r)
          .oneEach(Of::entries),
      field("damping", &F::damping, "N s/m", "force per rate of extension of these: one for all, or each", r)
          .oneEach(Of::entries),
      field("lengths", &F::lengths, "m", "length without force of these: one for all, or each; else 0", r)
          .oneEach(Of::entries)
          .also("length"),
      more...,
      field("enabled", &F::enabled, "", "whether springs are there: one for all, or each")
          .oneEach(Of::entries));
}

/// What a list says of one of n springs.
template <class T>
T of_spring(std::string const& where, std::string_view name, std::vector<T> const& list, std::size_t spring,
            std::size_t n, T fallback) {
  if (list.empty()) return fallback;
  check_one_or_each(where, name, list.size(), n, "springs", "one for all");
  return one_or_each(list, spring);
}

/// `springs`, and behind them those that the lists make.
template <class F>
std::vector<Spring> springs_of_lists(std::string const& where, F const& of) {
  std::vector<Spring> all = of.springs;
  const std::size_t n = of.springsIndices1.size();
  if (of.springsIndices2.size() != n)
    throw Error(where,
                text("springsIndices1 has ",
                     n,
                     " points and springsIndices2 ",
                     of.springsIndices2.size(),
                     "; give both ends of each spring"));
  for (std::size_t s = 0; s < n; ++s)
    all.push_back({of.springsIndices1[s],
                   of.springsIndices2[s],
                   of_spring(where, "stiffness", of.stiffness, s, n, 100.0),
                   of_spring(where, "damping", of.damping, s, n, 5.0),
                   of_spring(where, "lengths", of.lengths, s, n, 0.0)});
  return all;
}

/// take(number, how many there are, spring, its length without force) for each that is there. Throws Error
/// where an end is not there, or both are one.
template <class F, class D, class Take>
void for_each_spring(std::string const& where, F const& of, InitContext<D> const& a, InitContext<D> const& b,
                     Take&& take) {
  const std::vector<Spring> all = springs_of_lists(where, of);
  for (std::size_t s = 0; s < all.size(); ++s) {
    Spring const& spring = all[s];
    check_spring_ends<F>(where, s, spring, a, b);
    if (!of_spring(where, "enabled", of.enabled, s, all.size(), true)) continue;
    using Real = typename D::Real;
    const Real length =
        spring.length
            ? Real(*spring.length)
            : (D::center(b.rest[std::size_t(spring.second)]) - D::center(a.rest[std::size_t(spring.first)]))
                  .norm();
    take(s, all.size(), spring, length);
  }
}

}  // namespace sinew
