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
  using DataTypes = typename C::DataTypes;
  using Driver = decltype(unpacked(std::declval<C&>().driver));
  using Law = typename Driver::Law;
  Driver driver;
  Law settings{};

  explicit OneByOne(C const& c) : driver(unpacked(c.driver)) {
    if constexpr (requires { c.template law<Law>(); })
      settings = c.template law<Law>();
    else if constexpr (requires { Law{c.method}; })
      settings = Law{c.method};
  }
  Law law() const { return settings; }
};

template <class Sample, class H>
HostAnswers<H> on_host(int v, bool fewer) {
  const auto motion = motion_of<Sample, H>();
  auto lanes = ready<Sample, H>(v, motion);
  OneByOne scalar(lanes);
  return {answer_of<H>(lanes, motion, fewer), answer_of<H>(scalar, motion, fewer)};
}

}  // namespace gpu_test
