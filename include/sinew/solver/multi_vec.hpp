// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/vec_id.hpp>

#include <cmath>

namespace sinew {

/// A vector of derivatives of all states below a solver, under one id. Solvers do mathematics with it and
/// never see an entry. `MultiVecDeriv acc(operations)` takes an auxiliary vector for as long as it lives,
/// without allocating.
template <class Operations>
struct MultiVecDeriv {
  Operations& operations;
  DerivId id;

  explicit MultiVecDeriv(Operations& o) : operations(o), id(o.takeDeriv()), taken(true) {}
  MultiVecDeriv(Operations& o, DerivId reserved) : operations(o), id(reserved), taken(false) {}
  MultiVecDeriv(MultiVecDeriv const&) = delete;
  ~MultiVecDeriv() {
    if (taken) operations.releaseDeriv();
  }

  MultiVecDeriv& operator=(MultiVecDeriv const& a) { return eq(a), *this; }
  void clear() { operations.clear(id); }
  void eq(MultiVecDeriv const& a) { operations.eq(id, a.id); }
  void eq(MultiVecDeriv const& a, double f) { operations.eq(id, a.id, f); }        // = f a
  void peq(MultiVecDeriv const& a, double f = 1) { operations.peq(id, a.id, f); }  // += f a
  void teq(double f) { operations.teq(id, f); }                                    // *= f
  double dot(MultiVecDeriv const& a) const { return operations.dot(id, a.id); }
  double norm() const { return std::sqrt(dot(*this)); }

 private:
  bool taken;
};

/// The same for positions, which move along derivatives; the two differ for rigid bodies.
template <class Operations>
struct MultiVecCoord {
  Operations& operations;
  CoordId id;

  explicit MultiVecCoord(Operations& o) : operations(o), id(o.takeCoord()), taken(true) {}
  MultiVecCoord(Operations& o, CoordId reserved) : operations(o), id(reserved), taken(false) {}
  MultiVecCoord(MultiVecCoord const&) = delete;
  ~MultiVecCoord() {
    if (taken) operations.releaseCoord();
  }

  MultiVecCoord& operator=(MultiVecCoord const& a) { return operations.eq(id, a.id), *this; }
  void peq(MultiVecDeriv<Operations> const& a, double f = 1) { operations.peq(id, a.id, f); }

 private:
  bool taken;
};

}  // namespace sinew
