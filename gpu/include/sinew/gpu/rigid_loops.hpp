// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/mapped_loops.hpp>
#include <sinew/mapping/rigid_loops.hpp>

#include <vector>

namespace sinew {

/// Where bodies or points, or both, are on a device. Loops run where the points are, since bodies are fewer,
/// and the bodies' vectors cross: positions down, and sums of loads up. On a device these are sums of pieces
/// of at most 64 points, then of the pieces, in the order of the points.
template <class In, class Out>
requires(OnDevice<In> || OnDevice<Out>)
struct RigidLoops<In, Out> {
  using Coord = typename In::Coord;
  using Deriv = typename In::Deriv;
  using Device = std::conditional_t<OnDevice<In>, In, Out>;
  template <class T>
  using Array = typename Device::template Array<T>;
  static constexpr std::size_t piece = 64;

  Array<int> body{};                                     // of each point
  Array<int> firstPiece{}, firstPoint{}, point{};        // of a body; of a piece
  mutable Array<Coord> coords{};                         // of bodies on the host
  mutable Array<Deriv> derivs{}, loadOfPiece{}, sums{};  // ...; and on bodies of the other side

  /// `indices` is the body of each point, or that of all.
  void init(std::size_t bodies, std::size_t points, std::vector<int> const& indices) {
    body = indices;
    sums.assign(bodies, Deriv(Deriv::Zero()));
    if constexpr (OnDevice<Out>) {
      std::vector<std::vector<int>> of(bodies);
      for (std::size_t i = 0; i < points; ++i)
        of[std::size_t(indices[indices.size() == 1 ? 0 : i])].push_back(int(i));
      std::vector<int> pieces{0}, begins{0}, all;
      for (auto const& list : of) {
        for (std::size_t i = 0; i < list.size(); ++i) {
          all.push_back(list[i]);
          if ((i + 1) % piece == 0 || i + 1 == list.size()) begins.push_back(int(all.size()));
        }
        pieces.push_back(int(begins.size()) - 1);
      }
      loadOfPiece.assign(begins.size() - 1, Deriv(Deriv::Zero()));
      firstPiece = std::move(pieces);
      firstPoint = std::move(begins);
      point = std::move(all);
    }
  }

  /// Where loops over the points find a vector of the bodies.
  template <class V>
  auto const* bodies(V const& in) const {
    if constexpr (!OnDevice<Out>) {
      return in.data();
    } else if constexpr (OnDevice<In>) {
      return entries(in);
    } else if constexpr (std::is_same_v<typename V::value_type, Coord>) {
      coords.assign(in.begin(), in.end());
      return entries(std::as_const(coords));
    } else {
      derivs.assign(in.begin(), in.end());
      return entries(std::as_const(derivs));
    }
  }
  int const* indices(std::vector<int> const& given) const {
    if constexpr (OnDevice<Out>)
      return entries(body);
    else
      return given.data();
  }

  /// load(in[b], r[i], f[i]), which adds to it, for each point i of each body b.
  template <class F, class R, class Load>
  void addLoads(typename In::VecDeriv& in, F const& f, R const& r, std::vector<int> const& given,
                Load const& load) const {
    if constexpr (!OnDevice<Out>) {
      // on the host, from where sums cross
      Deriv* const own = gpu::overwritten_on_host(sums);
      for (std::size_t b = 0; b < sums.size(); ++b) own[b].setZero();
      const bool one = given.size() == 1;
      for (std::size_t i = 0; i < r.size(); ++i) load(own[std::size_t(given[one ? 0 : i])], r[i], f[i]);
      if (!std::all_of(own, own + sums.size(), [](Deriv const& sum) { return sum.isZero(0); }))
        each_point<In>(in.size(), gpu::Plus<Deriv>{entries(in), entries(std::as_const(sums))});
    } else {
      using Arm = typename R::value_type;
      using Force = typename F::value_type;
      each_point<Out>(
          loadOfPiece.size(),
          SumPiece<Load, Arm, Force>{
              load, entries(firstPoint), entries(point), entries(r), entries(f), overwritten(loadOfPiece)});
      if constexpr (OnDevice<In>) {
        addPieces(in.size(), entries(in), true);
      } else {
        addPieces(in.size(), overwritten(sums), false);
        for (std::size_t b = 0; b < in.size(); ++b) in[b] += std::as_const(sums).data()[b];
      }
    }
  }

  // what loops do

  template <class Load, class Arm, class Force>
  struct SumPiece {
    Load load;
    int const *first, *point;
    Arm const* r;
    Force const* f;
    Deriv* to;
    SINEW_HD void operator()(int p) const {
      Deriv sum = Deriv::Zero();
      for (int e = first[p]; e < first[p + 1]; ++e) load(sum, r[point[e]], f[point[e]]);
      to[p] = sum;
    }
  };
  struct SumBody {
    int const* first;
    Deriv const* part;
    Deriv* to;
    bool more;  // to what is there
    SINEW_HD void operator()(int b) const {
      Deriv sum = Deriv::Zero();
      if (more) sum = to[b];
      for (int p = first[b]; p < first[b + 1]; ++p) sum += part[p];
      to[b] = sum;
    }
  };

 private:
  void addPieces(std::size_t bodies, Deriv* to, bool more) const {
    each_point<Out>(bodies, SumBody{entries(firstPiece), entries(std::as_const(loadOfPiece)), to, more});
  }
};

}  // namespace sinew
