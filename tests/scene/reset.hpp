// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "catch.hpp"

#include <sinew/scene/simulation.hpp>

#include <initializer_list>
#include <string>
#include <vector>

namespace sinew {

template <class V>
void add_bits(std::string& to, V const& vector) {
  if (!vector.empty())
    to.append(reinterpret_cast<char const*>(vector.data()), vector.size() * sizeof(vector[0]));
}
/// Positions, velocities and forces of all states.
template <class Sim>
std::string all_bits(Sim& sim) {
  std::string all;
  const NoScope above;
  traverse(typename Sim::RootScope{sim.root(), above}, on<role::State>([&](auto& s, auto const&) {
             for (auto const* v : {&s.velocity, &s.force}) add_bits(all, *v);
             add_bits(all, s.position);
           }));
  return all;
}

/// The scene equals a new one from init on, when it is reset after each of these numbers of steps.
template <class Sim>
void comes_back(Sim sim, std::initializer_list<int> before = {1, 2, 3, 17}, int steps = 20) {
  auto fresh = sim;
  fresh.init();
  std::vector<std::string> expected{all_bits(fresh)};
  for (int i = 0; i < steps; ++i) fresh.animate(0.01), expected.push_back(all_bits(fresh));
  REQUIRE(expected.front() != expected.back());
  sim.init();
  for (const int n : before) {
    for (int i = 0; i < n; ++i) sim.animate(0.01);
    sim.reset();
    CHECK(sim.time() == 0);
    CHECK(sim.step() == 0);
    int same = 0;
    for (int i = 0; i <= steps; ++i) {
      if (i > 0) sim.animate(0.01);
      same += all_bits(sim) == expected[std::size_t(i)];
    }
    INFO("reset after " << n << " steps");
    CHECK(same == steps + 1);
    sim.reset();
  }
}

}  // namespace sinew
