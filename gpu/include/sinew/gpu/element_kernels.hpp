// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>

#include <array>
#include <cstddef>

namespace sinew::gpu::detail {

/// A block of an element's tangent as a matrix knows it: a number for the element, the pair of its points,
/// and whether the block is transposed. Pairs are (0, 0), (0, 1), .. (1, 1), (1, 2), ...
template <int Arity>
struct BlockOfElement {
  static constexpr int pairs = Arity * (Arity + 1) / 2;
  int element, a = 0, b;
  bool transposed;

  SINEW_INLINE explicit BlockOfElement(unsigned code)
      : element(int(code / (2 * pairs))), b(int(code / 2 % pairs)), transposed(code & 1) {
    while (b >= Arity - a) b -= Arity - a++;
    b += a;
  }
};

/// The elements of a driver as its threads see them. Point k of element e, and the force on it, is entry
/// k * count + e of `index` and `part`.
template <template <class> class LawOf, class D>
struct DeviceElements {
  using Deriv = typename D::Deriv;
  using Rest = typename LawOf<D>::Rest;
  using Tangent = typename LawOf<D>::Tangent;
  static constexpr int arity = LawOf<D>::arity;
  int count;
  int const* index;
  Rest const* rest;
  Tangent* tangent;
  Deriv* part;

  template <class Value>
  SINEW_INLINE void gather(int e, std::array<Value const*, arity> const& from, Value (&to)[arity]) const {
    for (int k = 0; k < arity; ++k) to[k] = from[std::size_t(k)][index[k * count + e]];
  }
  SINEW_INLINE void put(int e, Deriv const (&forces)[arity]) const {
    for (int k = 0; k < arity; ++k) part[k * count + e] = forces[k];
  }
};

template <template <class> class LawOf, class D>
struct ElementForce {
  static constexpr int arity = LawOf<D>::arity;
  LawOf<D> law;
  DeviceElements<LawOf, D> elements;
  std::array<typename D::Coord const*, arity> x;
  std::array<typename D::Deriv const*, arity> v;

  SINEW_HD void operator()(int e) const {
    typename D::Coord xs[arity];
    typename D::Deriv vs[arity], fs[arity];
    typename LawOf<D>::Tangent tangent;
    elements.gather(e, x, xs);
    if constexpr (LawOf<D>::usesVelocity) elements.gather(e, v, vs);
    law.force(elements.rest[e], xs, vs, fs, tangent);
    elements.tangent[e] = tangent;
    elements.put(e, fs);
  }
};

template <template <class> class LawOf, class D>
struct ElementDForce {
  static constexpr int arity = LawOf<D>::arity;
  LawOf<D> law;
  DeviceElements<LawOf, D> elements;
  std::array<typename D::Deriv const*, arity> dx;
  typename D::Real k, b;

  SINEW_HD void operator()(int e) const {
    typename D::Deriv dxs[arity], dfs[arity];
    elements.gather(e, dx, dxs);
    law.dforce(elements.rest[e], elements.tangent[e], dxs, dfs, k, b);
    elements.put(e, dfs);
  }
};

template <template <class> class LawOf, class D>
struct ElementEnergy {
  static constexpr int arity = LawOf<D>::arity;
  LawOf<D> law;
  DeviceElements<LawOf, D> elements;
  std::array<typename D::Coord const*, arity> x;

  SINEW_HD double operator()(int e) const {
    typename D::Coord xs[arity];
    elements.gather(e, x, xs);
    return double(law.energy(elements.rest[e], xs));
  }
};

/// f[n] += the entries of node n, in the order of the list.
template <class Deriv>
struct NodeSum {
  int const* first;
  int const* entry;
  Deriv const* part;
  Deriv* f;

  SINEW_HD void operator()(int n) const {
    Deriv sum = f[n];
    for (int i = first[n]; i < first[n + 1]; ++i) sum += part[entry[i]];
    f[n] = sum;
  }
};

/// Adds the diagonal blocks of k K + b B of the node's elements, in the order of the list; component c of the
/// block of node n is entry c * nodes + n of `to`.
template <template <class> class LawOf, class D>
struct NodeBlock {
  using Real = typename D::Real;
  LawOf<D> law;
  DeviceElements<LawOf, D> elements;
  int const* first;
  int const* entry;
  Real* to;
  std::ptrdiff_t nodes;
  Real k, b;

  SINEW_HD void operator()(int n) const {
    constexpr int size = D::size;
    Mat<Real, size> sum = Mat<Real, size>::Zero();
    for (int i = first[n]; i < first[n + 1]; ++i) {
      const int e = entry[i] % elements.count, corner = entry[i] / elements.count;
      sum += law.block(elements.rest[e], elements.tangent[e], corner, corner, k, b);
    }
    for (int r = 0; r < size; ++r)
      for (int c = 0; c < size; ++c) to[(r * size + c) * nodes + n] += sum(r, c);
  }
};

}  // namespace sinew::gpu::detail
