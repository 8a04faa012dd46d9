// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/mesh.hpp>

#include <vector>

namespace sinew {

/// The points that are where another one is, as beside a cut at rest, in rising order.
std::vector<Index> twins(std::vector<Eigen::Vector3d> const& x);

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>
#include <numeric>

namespace sinew {

SINEW_ONCE std::vector<Index> twins(std::vector<Eigen::Vector3d> const& x) {
  std::vector<Index> order(x.size());
  std::iota(order.begin(), order.end(), 0);
  auto less = [&](Index i, Index j) {
    auto const &a = x[std::size_t(i)], &b = x[std::size_t(j)];
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  };
  std::sort(order.begin(), order.end(), less);
  std::vector<Index> all;
  for (std::size_t k = 0; k < order.size(); ++k)
    if ((k > 0 && !less(order[k - 1], order[k])) || (k + 1 < order.size() && !less(order[k], order[k + 1])))
      all.push_back(order[k]);
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace sinew
#endif
