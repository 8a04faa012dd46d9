// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// Throws Error where a spring, by its number in the list, ends at a point that the state does not have.
template <class D>
void check_spring_end(std::string const& where, std::size_t spring, InitContext<D> const& end, int point) {
  if (std::size_t(point) >= end.rest.size())
    throw Error(where,
                text("springs[",
                     spring,
                     "] refers to point ",
                     point,
                     " of ",
                     end.where,
                     ", which has ",
                     end.rest.size(),
                     " points, numbered from 0; correct the index"));
}

/// What a spring has at its ends, in messages.
struct SpringEnds {
  std::string_view one = "point", many = "points";
};

/// Throws Error where a spring inside one state has the same point at both ends.
inline void check_two_ends(std::string const& where, std::size_t spring, int first, int second,
                           SpringEnds const& ends = {}) {
  if (first == second)
    throw Error(
        where,
        text("springs[", spring, "] joins ", ends.one, ' ', first, " to itself; give two ", ends.many));
}

/// The same for a spring of a force field between two states, or inside one; and where it ends at a point
/// that its state does not have.
template <class F, class D, class S>
void check_spring_ends(std::string const& where, std::size_t number, S const& spring, InitContext<D> const& a,
                       InitContext<D> const& b, SpringEnds const& ends = {}) {
  check_spring_end(where, number, a, spring.first);
  check_spring_end(where, number, b, spring.second);
  if (!F::between) check_two_ends(where, number, spring.first, spring.second, ends);
}

/// Springs as elements of a force field: restOf(number, spring) is what its law keeps of each.
template <class F, class D, class S, class RestOf>
void init_springs(F& of, std::string const& where, std::vector<S> const& springs, InitContext<D> const& a,
                  InitContext<D> const& b, SpringEnds const& ends, RestOf const& restOf) {
  std::vector<typename F::Driver::Indices> points;
  std::vector<typename F::Driver::Rest> rest;
  for (std::size_t s = 0; s < springs.size(); ++s) {
    check_spring_ends<F>(where, s, springs[s], a, b, ends);
    points.push_back({springs[s].first, springs[s].second});
    rest.push_back(restOf(s, springs[s]));
  }
  of.driver.init(points, rest);
}

}  // namespace sinew
