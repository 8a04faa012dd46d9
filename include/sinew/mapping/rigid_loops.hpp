// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

#include <cstddef>
#include <vector>

namespace sinew {

/// What loops over the points of rigid bodies need of these: the bodies' vectors and the body of each point
/// (or of all) where the points are, and sums of loads. Here both are in the memory of the host; DataTypes
/// whose vectors are elsewhere bring their own.
template <class In, class Out>
struct RigidLoops {
  void init(std::size_t /*bodies*/, std::size_t /*points*/, std::vector<int> const& /*indices*/) {}

  template <class V>
  auto const* bodies(V const& in) const {
    return in.data();
  }
  int const* indices(std::vector<int> const& given) const { return given.data(); }

  /// load(in[b], r[i], f[i]), which adds to it, for each point i of each body b.
  template <class F, class R, class Load>
  void addLoads(typename In::VecDeriv& in, F const& f, R const& r, std::vector<int> const& indices,
                Load const& load) const {
    const bool one = indices.size() == 1;
    for (std::size_t i = 0; i < r.size(); ++i) load(in[std::size_t(indices[one ? 0 : i])], r[i], f[i]);
  }
};

}  // namespace sinew
