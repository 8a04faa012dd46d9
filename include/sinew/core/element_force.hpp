// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/point_loop.hpp>

namespace sinew {

template <class C>
using VecCoordOf = typename C::DataTypes::VecCoord;
template <class C>
using VecDerivOf = typename C::DataTypes::VecDeriv;

// What forces do, as solvers and tests ask for it. An element force has its driver do that; any force may
// have a function of its own instead, by the name that the concept ForceField gives, and then this is called.

/// The law of an element force with the settings that it has now.
template <ElementForce C>
typename C::Driver::Law law_of(C const& c) {
  using Law = typename C::Driver::Law;
  if constexpr (requires { c.template law<Law>(); })
    return c.template law<Law>();
  else if constexpr (requires { c.law(); })
    return c.law();
  else
    return Law{};
}

/// A force field whose driver does all of its loops, so that it can take some elements before others.
template <class C>
inline constexpr bool takes_elements =
    ElementForce<C> && !JoinsTwo<C> && !named::addForce<C> && !named::addDForce<C>;

/// f += forces at (x, v).
template <class C>
void add_force(C& c, MechanicalParams const& p, VecDerivOf<C>& f, VecCoordOf<C> const& x,
               VecDerivOf<C> const& v) {
  if constexpr (ElementForce<C> && !requires { c.addForce(p, f, x, v); })
    c.driver.addForce(law_of(c), f, x, v, p.share);
  else
    c.addForce(p, f, x, v);
}
/// df += (k K + b B) dx at the last add_force.
template <class C>
void add_dforce(C& c, MechanicalParams const& p, VecDerivOf<C>& df, VecDerivOf<C> const& dx) {
  using Real = typename C::DataTypes::Real;
  if constexpr (ElementForce<C> && !requires { c.addDForce(p, df, dx); })
    c.driver.addDForce(law_of(c), df, dx, Real(p.k), Real(p.b), p.share);
  else
    c.addDForce(p, df, dx);
}
/// [J]
template <class C>
double potential_energy(C& c, VecCoordOf<C> const& x) {
  if constexpr (ElementForce<C> && !requires { c.potentialEnergy(x); })
    return c.driver.energy(law_of(c), x);
  else
    return c.potentialEnergy(x);
}

// the same between two bodies, where the first point of an element is of the first body, and the second of
// the second

template <class C>
void add_force(C& c, MechanicalParams const& p, VecDerivOf<C>& f0, VecDerivOf<C>& f1, VecCoordOf<C> const& x0,
               VecCoordOf<C> const& x1, VecDerivOf<C> const& v0, VecDerivOf<C> const& v1) {
  if constexpr (ElementForce<C> && !requires { c.addForce(p, f0, f1, x0, x1, v0, v1); })
    c.driver.addForce(
        law_of(c), {entries(f0), entries(f1)}, {entries(x0), entries(x1)}, {entries(v0), entries(v1)});
  else
    c.addForce(p, f0, f1, x0, x1, v0, v1);
}
template <class C>
void add_dforce(C& c, MechanicalParams const& p, VecDerivOf<C>& df0, VecDerivOf<C>& df1,
                VecDerivOf<C> const& dx0, VecDerivOf<C> const& dx1) {
  using Real = typename C::DataTypes::Real;
  if constexpr (ElementForce<C> && !requires { c.addDForce(p, df0, df1, dx0, dx1); })
    c.driver.addDForce(
        law_of(c), {entries(df0), entries(df1)}, {entries(dx0), entries(dx1)}, Real(p.k), Real(p.b));
  else
    c.addDForce(p, df0, df1, dx0, dx1);
}
template <class C>
double potential_energy(C& c, VecCoordOf<C> const& x0, VecCoordOf<C> const& x1) {
  if constexpr (ElementForce<C> && !requires { c.potentialEnergy(x0, x1); })
    return c.driver.energy(law_of(c), typename C::Driver::Coords{entries(x0), entries(x1)});
  else
    return c.potentialEnergy(x0, x1);
}

/// Adds k K + b B at the last add_force to the matrix behind the sink.
template <class C, class Sink>
void add_to_matrix(C& c, MechanicalParams const& p, Sink const& sink) {
  using Real = typename C::DataTypes::Real;
  if constexpr (!ElementForce<C> || requires { c.addToMatrix(p, sink); })
    c.addToMatrix(p, sink);
  else if constexpr (JoinsTwo<C>)
    c.driver.template addToMatrix<0, 1>(law_of(c), sink, Real(p.k), Real(p.b));
  else
    c.driver.addToMatrix(law_of(c), sink, Real(p.k), Real(p.b), p.share);
}

}  // namespace sinew
