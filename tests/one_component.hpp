// SPDX-License-Identifier: BSL-1.0
#pragma once

// One component alone, over points and elements given in the test.

#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/core/element_force.hpp>

#include <limits>
#include <string>

namespace one {

using namespace sinew;

inline const double notANumber = std::numeric_limits<double>::quiet_NaN();

/// The component as it stands in a node "body" with these points and elements, its fields checked.
template <class C>
C ready(C c, typename C::DataTypes::VecCoord const& rest, TopologyView topology = {}) {
  check_fields(c, "body");
  c.init(InitContext<typename C::DataTypes>{"body", rest, topology});
  return c;
}

/// What a force field adds to f = 0.
template <class C>
typename C::DataTypes::VecDeriv force(C& c, typename C::DataTypes::VecCoord const& x,
                                      typename C::DataTypes::VecDeriv v = {}, double time = 0) {
  using Deriv = typename C::DataTypes::Deriv;
  typename C::DataTypes::VecDeriv f(x.size(), Deriv::Zero());
  v.resize(x.size(), Deriv::Zero());
  MechanicalParams p;
  p.time = time;
  add_force(c, p, f, x, v);
  return f;
}

/// (k K + b B) dx at the last force.
template <class C>
typename C::DataTypes::VecDeriv product(C const& c, typename C::DataTypes::VecDeriv const& dx, double k,
                                        double b) {
  typename C::DataTypes::VecDeriv df(dx.size(), C::DataTypes::Deriv::Zero());
  MechanicalParams p;
  p.k = k, p.b = b;
  add_dforce(c, p, df, dx);
  return df;
}

/// That the message of an Error has these words.
template <class F>
void says(F&& f, std::initializer_list<std::string_view> words) {
  const std::string said = error_of(f);
  for (std::string_view word : words) {
    INFO(said << "\n  should say: " << word);
    CHECK(said.find(word) != std::string::npos);
  }
}
/// The same for a component that does not get ready.
template <class C>
void refuses(C c, typename C::DataTypes::VecCoord const& rest, TopologyView topology,
             std::initializer_list<std::string_view> words) {
  says([&] { ready(c, rest, topology); }, words);
}

}  // namespace one
