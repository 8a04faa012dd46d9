// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/vec_id.hpp>
#include <sinew/scene/scope.hpp>
#include <sinew/state/vector_operations.hpp>

#include <algorithm>
#include <cstddef>
#include <type_traits>

namespace sinew {

/// The vectors of the states at and below a scope, `root`, as one: operations act on independent states;
/// mapped ones follow by propagation.
template <class Root>
struct StateVectors {
  Root const& root;

  // iteration over states

  template <class F>
  void forEachState(F&& f) const {
    traverse(root, on<role::State>([&](auto& c, auto const&) { f(c); }));
  }
  template <class F>
  void forEachIndependent(F&& f) const {
    traverse(root, on<role::State>([&](auto& c, auto const& scope) {
               if (!scope.mapped()) f(c);
             }));
  }
  template <class F>
  void forEachMapped(F&& f) const {
    traverse(root, on<role::State>([&](auto& c, auto const& scope) {
               if (scope.mapped()) f(c);
             }));
  }

  // room

  void reserve(Auxiliary needed) const {
    std::size_t scalars = 0;
    forEachState([&](auto& state) {
      state.reserve(needed);
      const std::size_t points = std::max(state.size(), state.capacity);
      scalars = std::max(scalars, points * std::size_t(DataTypesOf<decltype(state)>::size));
    });
    reserveSums(scalars);
  }
  /// Room for sums over vectors of so many scalars.
  void reserveSums(std::size_t scalars) const {
    workers().reserveSums(scalars / std::size_t(vec::piece) + 1);
  }
  /// The threads by which the solver of this scope works.
  auto workers() const { return root.workers(); }

  /// Of a distributed scene: these vectors are at ghost points what they are at those of their owners.
  template <class... Ids>
  void bringGhosts(Ids... ids) const {
    root.distribution().begin(*this, ids...);
    root.distribution().end(*this, ids...);
  }

  // vector mathematics

  void clear(DerivId r) const;
  template <class Id>
  void eq(Id r, Id a) const;
  void eq(DerivId r, DerivId a, double f) const;
  void peq(DerivId r, DerivId a, double f) const;
  void peq(CoordId r, DerivId a, double f) const;
  void teq(DerivId r, double f) const;
  double dot(DerivId a, DerivId b) const;
  /// r = a + f r
  void xpay(DerivId r, DerivId a, double f) const;
  /// x += f p, r -= f q; returns r.r.
  double advance(DerivId x, DerivId p, DerivId r, DerivId q, double f) const;
  /// rate = time derivative of theta, where a position moved by theta has velocity v; v itself but for rigid
  /// bodies.
  void chartRate(DerivId rate, DerivId theta, DerivId v) const;

  // one vector of all degrees of freedom

  /// Numbers the degrees of freedom of the independent states, each from a block of so many on, and returns
  /// how many there are with what fills the last blocks.
  int numberDofs(int block) const {
    int dofs = 0;
    forEachIndependent([&](auto& s) {
      s.dofOffset = dofs;
      dofs += int(s.size()) * DataTypesOf<decltype(s)>::size;
      dofs = (dofs + block - 1) / block * block;
    });
    return dofs;
  }
  /// Copies between state vectors and one vector of all independent degrees of freedom.
  template <class Vector>
  void gather(Vector& to, DerivId from) const {
    forEachIndependent([&](auto& s) {
      to.segment(s.dofOffset, vec::flat(s[from]).size()) =
          vec::flat(s[from]).template cast<typename Vector::Scalar>();
    });
  }
  template <class Vector>
  void scatter(DerivId to, Vector const& from) const {
    forEachIndependent([&](auto& s) {
      auto flat = vec::flat(s[to]);
      flat = from.segment(s.dofOffset, flat.size()).template cast<typename DataTypesOf<decltype(s)>::Real>();
    });
  }

 private:
  template <class State>
  using DataTypesOf = typename std::decay_t<State>::DataTypes;
  template <class State>
  using Vectors = VectorOperations<DataTypesOf<State>>;
  template <class State>
  static auto real(State const&, double f) {
    return typename State::DataTypes::Real(f);
  }
};

// Outside the class, so that a program may have them instantiated in one place: runtime/precompiled.hpp.

template <class Root>
void StateVectors<Root>::clear(DerivId r) const {
  forEachIndependent([&](auto& s) { Vectors<decltype(s)>::clear(workers(), s[r]); });
}

template <class Root>
template <class Id>
void StateVectors<Root>::eq(Id r, Id a) const {
  forEachIndependent([&](auto& s) { Vectors<decltype(s)>::eq(workers(), s[r], s[a]); });
}

template <class Root>
void StateVectors<Root>::eq(DerivId r, DerivId a, double f) const {
  forEachIndependent([&](auto& s) { Vectors<decltype(s)>::eq(s[r], s[a], real(s, f)); });
}

template <class Root>
void StateVectors<Root>::peq(DerivId r, DerivId a, double f) const {
  forEachIndependent([&](auto& s) { Vectors<decltype(s)>::peq(workers(), s[r], s[a], real(s, f)); });
}

template <class Root>
void StateVectors<Root>::peq(CoordId r, DerivId a, double f) const {
  forEachIndependent([&](auto& s) { Vectors<decltype(s)>::move(s[r], s[a], real(s, f)); });
}

template <class Root>
void StateVectors<Root>::teq(DerivId r, double f) const {
  forEachIndependent([&](auto& s) { Vectors<decltype(s)>::teq(s[r], real(s, f)); });
}

template <class Root>
double StateVectors<Root>::dot(DerivId a, DerivId b) const {
  double sum = 0;
  if constexpr (Root::distributed) {
    forEachIndependent([&](auto& s) {
      const auto u = vec::flat(s[a]), v = vec::flat(s[b]);
      const Eigen::Index own = Eigen::Index(s.owned()) * DataTypesOf<decltype(s)>::size;
      sum += vec::sum_pieces(OneThread{}, own, [&](Eigen::Index i, Eigen::Index n) {
        return vec::dot_piece(u.data() + i, v.data() + i, n);
      });
    });
    return root.distribution().sum(sum);
  } else {
    forEachIndependent([&](auto& s) { sum += Vectors<decltype(s)>::dot(workers(), s[a], s[b]); });
    return sum;
  }
}

template <class Root>
void StateVectors<Root>::xpay(DerivId r, DerivId a, double f) const {
  forEachIndependent([&](auto& s) { Vectors<decltype(s)>::xpay(workers(), s[r], s[a], real(s, f)); });
}

template <class Root>
double StateVectors<Root>::advance(DerivId x, DerivId p, DerivId r, DerivId q, double f) const {
  if constexpr (Root::distributed) {
    peq(x, p, f);
    peq(r, q, -f);
    return dot(r, r);
  } else {
    double sum = 0;
    forEachIndependent([&](auto& s) {
      sum += Vectors<decltype(s)>::advance(workers(), s[x], s[p], s[r], s[q], real(s, f));
    });
    return sum;
  }
}

template <class Root>
void StateVectors<Root>::chartRate(DerivId rate, DerivId theta, DerivId v) const {
  forEachIndependent([&](auto& s) { Vectors<decltype(s)>::chartRate(s[rate], s[theta], s[v]); });
}

}  // namespace sinew
