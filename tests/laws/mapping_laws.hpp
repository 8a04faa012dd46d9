// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "catch.hpp"
#include "sample.hpp"

namespace laws {

using namespace sinew;
using sample::Random;

template <class M>
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
    sample::for_each_variant<M>(random, [&](M mapping) {
      // as many points in the child as the mapping has indices
      std::size_t points = 7;
      if constexpr (requires { mapping.carriers; }) points = 40;
      if constexpr (std::is_same_v<M, IdentityMapping<In, Out>>) points = 0;
      typename Out::VecCoord child;
      for (std::size_t i = 0; i < points; ++i) child.push_back(sample::coord<Out>(random, 1.5));
      const typename Out::VecCoord childRest = child;
      mapping.init(InitContext<In>{"parent", parentRest, body.topology()},
                   InitContext<Out>{"child", childRest, {}},
                   child);
      typename In::VecCoord x = parentRest;
      vec::increment<In>(x, sample::derivs<In>(x.size(), random, 0.3), typename In::Real(1));
      mapping.apply(child, x);

      if constexpr (isDouble) jacobian(mapping, x, child);
      adjoint(mapping, x.size(), child.size());
      blocks(mapping, x.size(), child.size());
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
};

}  // namespace laws
