// SPDX-License-Identifier: BSL-1.0
#pragma once

// For host_*.cpp, which instantiate on_host.

#include "answers.hpp"

#include <sinew/core/element_driver.hpp>

#include <cstring>

namespace gpu_test {

/// The same elements one by one, under the same law.
template <template <class> class LawOf, class D, int W>
ElementDriver<LawOf, D, 1> unpacked(ElementDriver<LawOf, D, W> const& packed) {
  using Real = typename D::Real;
  using Rest = typename LawOf<D>::Rest;
  constexpr std::size_t reals = sizeof(Rest) / sizeof(Real), width = std::size_t(W);
  std::vector<std::array<int, LawOf<D>::arity>> elements;
  std::vector<Rest> rest;
  for (auto const& pack : packed.packs)
    for (std::size_t l = 0; l < std::size_t(pack.active); ++l) {
      Real all[reals * width], one[reals];
      std::memcpy(all, static_cast<void const*>(&pack.rest), sizeof all);
      for (std::size_t r = 0; r < reals; ++r) one[r] = all[r * width + l];
      std::memcpy(static_cast<void*>(&rest.emplace_back()), one, sizeof one);
      auto& element = elements.emplace_back();
      for (std::size_t k = 0; k < element.size(); ++k) element[k] = pack.index[k][l];
    }
  ElementDriver<LawOf, D, 1> driver;
  driver.init(elements, rest);
  return driver;
}

template <class C>
struct OneByOne {
  using Real = typename C::DataTypes::Real;
  using Driver = decltype(unpacked(std::declval<C&>().driver));
  using Law = typename Driver::Law;
  Driver driver;
  Law law{};

  explicit OneByOne(C const& c) : driver(unpacked(c.driver)) {
    if constexpr (requires { c.template law<Law>(); })
      law = c.template law<Law>();
    else if constexpr (requires { Law{c.method}; })
      law = Law{c.method};
  }
  template <class F, class X, class V>
  void addForce(MechanicalParams const&, F& f, X const& x, V const& v) {
    driver.addForce(law, f, x, v);
  }
  template <class V>
  void addDForce(MechanicalParams const& p, V& df, V const& dx) const {
    driver.addDForce(law, df, dx, Real(p.k), Real(p.b));
  }
  template <class X>
  double potentialEnergy(X const& x) const {
    return driver.energy(law, x);
  }
  template <class Sink>
  void addToMatrix(MechanicalParams const& p, Sink const& sink) {
    driver.addToMatrix(law, sink, Real(p.k), Real(p.b));
  }
};

template <class Sample, class H>
HostAnswers<H> on_host(int v, bool fewer) {
  const auto motion = motion_of<Sample, H>();
  auto lanes = ready<Sample, H>(v, motion);
  OneByOne scalar(lanes);
  return {answer_of<H>(lanes, motion, fewer), answer_of<H>(scalar, motion, fewer)};
}

}  // namespace gpu_test
