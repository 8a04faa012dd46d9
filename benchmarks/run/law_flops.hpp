// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "counted.hpp"

#include <sinew/core/data_types.hpp>

#include <cstddef>

namespace bench {

/// Operations of one element, as its law is written: force, product with the tangent, and blocks of the
/// matrix, one of each two that mirror each other; with their sums into the vectors and the matrix.
struct LawFlops {
  double force, dforce, blocks;
};

/// Of a law over VecTypes<3, Counted>, with the points of its element in a state that is not the one of rest.
template <class Law, std::size_t Points>
LawFlops law_flops(Law const& law, typename Law::Rest const& rest, typename Law::Coord const (&x)[Points]) {
  constexpr int points = int(Points), pairs = points * (points + 1) / 2;
  static_assert(points == Law::arity);
  typename Law::Deriv f[Points], v[Points];
  for (auto& one : v) one.setZero();
  typename Law::Tangent tangent;
  LawFlops n;
  n.force = operations_of([&] { law.force(rest, x, v, f, tangent); }) + 3 * points;
  n.dforce = operations_of([&] { law.dforce(rest, tangent, x, f, Counted(1), Counted(0)); }) + 3 * points;
  n.blocks = 9 * pairs + operations_of([&] {
               for (int i = 0; i < points; ++i)
                 for (int j = i; j < points; ++j) law.block(rest, tangent, i, j, Counted(1), Counted(0));
             });
  return n;
}

}  // namespace bench
