// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "catch.hpp"

#include <sinew/runtime/from_typed.hpp>
#include <sinew/runtime/precompiled.hpp>

#include <algorithm>
#include <cstring>

namespace same_bits {

using namespace sinew;

/// The bytes of all positions and velocities of a scene, in the order of its nodes.
template <class Sim>
std::string bits_of(Sim& sim) {
  std::string bits;
  auto add = [&](auto const& vector) {
    if (!vector.empty())
      bits.append(reinterpret_cast<char const*>(vector.data()), vector.size() * sizeof(vector[0]));
  };
  sim.updateVisual();
  const NoScope above;
  traverse(typename Sim::RootScope{sim.root(), above},
           on<role::State, role::VisualModel>([&](auto& s, auto const&) {
             add(s.position);
             if constexpr (requires { s.velocity; }) add(s.velocity);
           }));
  return bits;
}

/// A typed scene and its runtime tree go through the same states, bit by bit.
template <class Sim>
void check(Sim typed, double dt, int steps = 1000) {
  StandardSimulation runtime(to_runtime<Standard>(typed.root()));
  typed.init();
  runtime.init();
  REQUIRE(bits_of(typed) == bits_of(runtime));
  const std::string start = bits_of(typed);
  const int few = std::min(steps, 20);
  std::string early;
  for (int i = 0; i < steps; ++i) {
    typed.animate(dt);
    runtime.animate(dt);
    if (i + 1 == few) early = bits_of(typed);
  }
  CHECK(bits_of(typed) == bits_of(runtime));
  CHECK(bits_of(typed) != start);
  CHECK(typed.kineticEnergy() == runtime.kineticEnergy());
  CHECK(typed.potentialEnergy() == runtime.potentialEnergy());
  typed.reset();
  runtime.reset();
  CHECK(bits_of(typed) == start);
  CHECK(bits_of(runtime) == start);
  for (int i = 0; i < few; ++i) typed.animate(dt), runtime.animate(dt);
  CHECK(bits_of(typed) == early);
  CHECK(bits_of(runtime) == early);
}

}  // namespace same_bits
