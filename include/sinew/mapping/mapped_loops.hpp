// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>

#include <vector>

namespace sinew {

/// The loops of a mapping whose child has the points of its parent, which says what becomes of one of them:
/// point(to, from), an object whose operator is SINEW_HD. Here both states are in the memory of the host;
/// DataTypes whose vectors are elsewhere bring their own loops, of which ask() begins what apply(), called
/// next with the same arguments, brings from there.
template <class In, class Out>
struct MappedLoops {
  void init(std::size_t /*parents*/, std::size_t /*children*/) {}

  template <class To, class From, class Point>
  void ask(To const&, From const&, Point const&) const {}
  template <class To, class From, class Point>
  void apply(To& out, From const& in, Point const& point) const {
    for (std::size_t i = 0; i < in.size(); ++i) point(out[i], in[i]);
  }
  /// `point` adds to what the parent has.
  template <class To, class From, class Point>
  void applyJT(To& in, From const& out, Point const& point) const {
    for (std::size_t i = 0; i < in.size(); ++i) point(in[i], out[i]);
  }
};

/// The same where point i of the child is point indices[i] of the parent.
template <class In, class Out>
struct SubsetLoops {
  void init(std::size_t /*parents*/, std::vector<int> const& /*indices*/) {}

  template <class To, class From>
  void ask(To const&, From const&) const {}
  template <class To, class From>
  void apply(To& out, From const& in, std::vector<int> const& indices) const {
    for (std::size_t i = 0; i < indices.size(); ++i)
      out[i] = in[std::size_t(indices[i])].template cast<typename Out::Real>();
  }
  template <class To, class From>
  void applyJT(To& in, From const& out, std::vector<int> const& indices) const {
    for (std::size_t i = 0; i < indices.size(); ++i)
      in[std::size_t(indices[i])] += out[i].template cast<typename In::Real>();
  }
};

}  // namespace sinew
