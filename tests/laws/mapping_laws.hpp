// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "catch.hpp"
#include "sample.hpp"

#include <sinew/core/assembly.hpp>
#include <sinew/linalg/block_matrix.hpp>

namespace laws {

using namespace sinew;
using sample::Random;

/// `Component`: what a sample is made of, M or a base of it.
template <class M, class Component = M>
struct MappingSuite {
  using In = typename M::In;
  using Out = typename M::Out;
  static constexpr bool isDouble = sizeof(typename In::Real) == 8 && sizeof(typename Out::Real) == 8;
  static constexpr double rounding = isDouble ? 1e-12 : 1e-5;

  Random random{20070102};
  sample::Body body{random};
  typename In::VecCoord parentRest = sample::positions<In>(body, random);

  void run() {
    INFO(component_name<M>());
    sample::for_each_variant<Component>(random, [&](Component const& sampled) {
      M mapping{sampled};
      typename Out::VecCoord child;
      for (std::size_t i = 0; i < sample::child_points(sampled); ++i)
        child.push_back(sample::coord<Out>(random, 1.5));
      const typename Out::VecCoord childRest = child;
      std::vector<double> masses;
      for (std::size_t i = 0; i < parentRest.size(); ++i) masses.push_back(random(0.5, 2));
      mapping.init(InitContext<In>{"parent", parentRest, body.topology(), masses},
                   InitContext<Out>{"child", childRest, {}},
                   child);
      typename In::VecCoord x = parentRest;
      vec::increment<In>(x, sample::derivs<In>(x.size(), random, 0.3), typename In::Real(1));
      mapping.apply(child, x);

      if constexpr (isDouble) jacobian(mapping, x, child);
      adjoint(mapping, x.size(), child.size());
      blocks(mapping, x.size(), child.size());
      if constexpr (HasGeometricStiffness<M>) geometricStiffness(mapping, x, child);
    });
  }

  // J v by differences of apply over 2e-5: truncation 1e-10, rounding 1e-11
  void jacobian(M& mapping, typename In::VecCoord const& x, typename Out::VecCoord const& at) {
    const double h = 1e-5;
    const auto v = sample::derivs<In>(x.size(), random);
    typename In::VecCoord forward = x, backward = x;
    vec::increment<In>(forward, v, h);
    vec::increment<In>(backward, v, -h);
    typename Out::VecCoord plus = at, minus = at, again = at;
    mapping.apply(plus, forward);
    mapping.apply(minus, backward);
    mapping.apply(again, x);
    typename Out::VecDeriv jv(at.size());
    mapping.applyJ(jv, v);
    for (std::size_t i = 0; i < at.size(); ++i)
      CHECK((Out::difference(minus[i], plus[i]) / (2 * h) - jv[i]).norm() <= 1e-7 * (1 + jv[i].norm()));
  }

  // virtual work: <J u, w> = <u, J' w>
  void adjoint(M& mapping, std::size_t parents, std::size_t children) {
    const auto u = sample::derivs<In>(parents, random);
    const auto w = sample::derivs<Out>(children, random);
    typename Out::VecDeriv ju(children);
    typename In::VecDeriv jtw(parents, In::Deriv::Zero());
    mapping.applyJ(ju, u);
    mapping.applyJT(jtw, w);
    CHECK(vec::dot(ju, w) ==
          Approx(vec::dot(u, jtw)).margin(rounding * double(vec::flat(ju).norm() * vec::flat(w).norm())));
  }

  // the blocks that go into assembled matrices are those of J
  void blocks(M& mapping, std::size_t parents, std::size_t children) {
    const auto u = sample::derivs<In>(parents, random);
    typename Out::VecDeriv ju(children);
    mapping.applyJ(ju, u);
    for (std::size_t i = 0; i < children; ++i) {
      typename Out::Deriv sum = Out::Deriv::Zero();
      mapping.forEachJacobianBlock(int(i), [&](int above, auto const& block) {
        sum += block * u[std::size_t(above)].template cast<typename Out::Real>();
      });
      CHECK(double((sum - ju[i]).norm()) <= rounding * (1 + double(ju[i].norm())));
    }
  }

  static typename In::VecDeriv product(M const& mapping, typename In::VecDeriv const& dx, double k) {
    typename In::VecDeriv df(dx.size(), In::Deriv::Zero());
    mapping.addKx(df, dx, k);
    return df;
  }

  // K_g is symmetric, the same assembled, and the derivative of J' f; where it is not all of that, what its
  // option says
  void geometricStiffness(M& mapping, typename In::VecCoord const& x, typename Out::VecCoord const& at) {
    const auto f = sample::derivs<Out>(at.size(), random);
    mapping.updateK(f);
    const auto u = sample::derivs<In>(x.size(), random), w = sample::derivs<In>(x.size(), random);
    const auto ku = product(mapping, u, 1), kw = product(mapping, w, 1);
    const double size = double(vec::flat(ku).norm() * vec::flat(w).norm());
    CHECK(vec::dot(ku, w) == Approx(vec::dot(u, kw)).margin(rounding * (1 + size)));
    using Option = decltype(mapping.geometricStiffness);
    if (mapping.geometricStiffness == Option::none) {
      CHECK(size == 0);
      return;
    }
    CHECK(size > 0.1);
    assembled(mapping, u);

    if constexpr (std::is_same_v<Option, GeometricStiffness>)
      if (sample::stabilizes(mapping) && mapping.geometricStiffness == GeometricStiffness::stabilized)
        CHECK(vec::dot(ku, u) < 0);  // of what pulls alone
    if constexpr (isDouble) {
      typename In::VecDeriv du = derivative(mapping, x, at, f, u), dw = derivative(mapping, x, at, f, w);
      // differences over 2e-5: truncation 1e-10, rounding 1e-11
      if constexpr (std::is_same_v<Option, GeometricStiffness>) {
        if (mapping.geometricStiffness != Option::exact) return;
        CHECK(double((vec::flat(du) - vec::flat(ku)).norm()) <= 1e-7 * (1 + double(vec::flat(ku).norm())));
      }
      CHECK((vec::dot(du, w) + vec::dot(u, dw)) / 2 == Approx(vec::dot(ku, w)).margin(1e-7 * (1 + size)));
    }
  }
  // d/dh J(x + h u)' f
  static typename In::VecDeriv derivative(M mapping, typename In::VecCoord const& x,
                                          typename Out::VecCoord at, typename Out::VecDeriv const& f,
                                          typename In::VecDeriv const& u) {
    const double h = 1e-5;
    typename In::VecDeriv sum(x.size(), In::Deriv::Zero());
    for (const double sign : {1.0, -1.0}) {
      typename In::VecCoord moved = x;
      vec::increment<In>(moved, u, sign * h);
      mapping.apply(at, moved);
      typename In::VecDeriv force(x.size(), In::Deriv::Zero());
      mapping.applyJT(force, f);
      vec::peq(sum, force, sign / (2 * h));
    }
    return sum;
  }
  void assembled(M& mapping, typename In::VecDeriv const& u) {
    using Real = typename In::Real;
    using Matrix = CompressedRowSparseMatrix<Real, In::size>;
    const DirectDofs<In::size> dofs{0};
    MechanicalParams p;
    p.k = -2.5;
    Matrix a;
    a.startPattern(int(u.size()) * In::size);
    mapping.addToMatrix(p, MatrixSink<AssemblyPhase::pattern, Matrix, DirectDofs<In::size>>{a, dofs, dofs});
    a.finishPattern();
    mapping.addToMatrix(p, MatrixSink<AssemblyPhase::add, Matrix, DirectDofs<In::size>>{a, dofs, dofs});
    typename In::VecDeriv in = u, out(u.size() + 1, In::Deriv::Zero());
    in.push_back(In::Deriv::Zero());  // multiply reads behind it
    a.multiply(in[0].data(), out[0].data());
    out.pop_back();
    const auto expected = product(mapping, u, p.k);
    CHECK(double((vec::flat(out) - vec::flat(expected)).norm()) <=
          10 * rounding * (1 + double(vec::flat(expected).norm())));
  }
};

/// A mapping with several parents, three of them, looked at as one from all of them one behind the other.
template <class M>
struct Joined : M {
  std::size_t each = 0;

  void init(InitContext<typename M::In> const& parent, InitContext<typename M::Out> const& child,
            typename M::Out::VecCoord& positions) {
    each = parent.rest.size() / 3;
    std::vector<typename M::In::VecCoord> rest(3);
    std::vector<InitContext<typename M::In>> parents;
    for (std::size_t k = 0; k < 3; ++k) rest[k] = part(parent.rest, k);
    for (std::size_t k = 0; k < 3; ++k) parents.push_back({"parent", rest[k], {}});
    M::init(parents, child, positions);
  }
  void apply(typename M::Out::VecCoord& out, typename M::In::VecCoord const& in) {
    for (std::size_t k = 0; k < 3; ++k) this->parts[k].apply(out, part(in, k));
  }
  void applyJ(typename M::Out::VecDeriv& out, typename M::In::VecDeriv const& in) {
    for (std::size_t k = 0; k < 3; ++k) this->parts[k].applyJ(out, part(in, k));
  }
  void applyJT(typename M::In::VecDeriv& in, typename M::Out::VecDeriv const& out) {
    for (std::size_t k = 0; k < 3; ++k) {
      auto own = part(in, k);
      this->parts[k].applyJT(own, out);
      std::copy(own.begin(), own.end(), in.begin() + std::ptrdiff_t(k * each));
    }
  }
  template <class F>
  void forEachJacobianBlock(int point, F&& f) const {
    for (std::size_t k = 0; k < 3; ++k)
      this->parts[k].forEachJacobianBlock(point,
                                          [&](int above, auto const& j) { f(int(k * each) + above, j); });
  }

 private:
  template <class V>
  V part(V const& all, std::size_t k) const {
    return V(all.begin() + std::ptrdiff_t(k * each), all.begin() + std::ptrdiff_t((k + 1) * each));
  }
};

/// Runs the suite on every mapping in a registry from points, or from rigid bodies.
template <class R, bool Rigid>
void check_mappings() {
  int found = 0;
  for_each_registered<R>([&]<class C>() {
    if constexpr (HasRole<C, role::Mapping> && !MakesFaces<C>)  // a surface has no velocities
      if constexpr (C::In::rigid == Rigid) {
        ++found;
        if constexpr (HasParents<C>)
          MappingSuite<Joined<C>, C>{}.run();
        else
          MappingSuite<C>{}.run();
      }
  });
  CHECK(found > 0);
}

}  // namespace laws
