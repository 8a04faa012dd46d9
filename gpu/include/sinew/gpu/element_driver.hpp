// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/assembly.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/core/error.hpp>
#include <sinew/gpu/block_rows.hpp>
#include <sinew/gpu/data_types.hpp>
#include <sinew/gpu/element_kernels.hpp>
#include <sinew/gpu/reduction.hpp>

#include <array>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

namespace sinew {

/// Runs an element law over all elements of a body on the device, one thread an element, with the law's code
/// for plain scalars that the processor's driver uses too. In gather form: the elements first write the
/// forces on their points to a buffer; each node then sums its entries of it, elements in ascending order. No
/// atomics: the same input gives the same bits, in every run and with any number of threads.
///
/// Products: the first one after the forces, at given factors, goes by elements. From the second on, as in a
/// solver's iterations, the blocks of laws with more than two points are summed up once into rows
/// (BlockRows), which a product reads with a third of the memory traffic.
template <template <class> class LawOf, class H, int W>
struct ElementDriver<LawOf, CudaTypes<H>, W> {
  using D = CudaTypes<H>;
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  using Law = LawOf<D>;
  using Rest = typename Law::Rest;
  using Tangent = typename Law::Tangent;
  static constexpr int arity = Law::arity;
  using Indices = std::array<int, arity>;
  // first point of the state that each end of an element lives on, on the device
  using Coords = std::array<Coord const*, arity>;
  using ConstDerivs = std::array<Deriv const*, arity>;
  using Derivs = std::array<Deriv*, arity>;

  std::vector<Indices> elements{};
  gpu::DeviceVector<Rest> rest{};
  int shares = 1;

  /// Takes the elements. Throws Error on more than 2^31 - 1 ends of elements.
  void init(std::vector<Indices> const& all, std::vector<Rest> const& restOf) {
    const std::size_t count = all.size();
    constexpr std::size_t maximum = std::numeric_limits<int>::max();
    if (count > maximum / arity)
      throw Error("elements on a device",
                  text(count, " elements exceed the range of an int, 2^31 - 1; split the body"));
    elements = all;
    rest = restOf;
    nodes = 0;
    for (auto const& e : elements)
      for (const int i : e) nodes = std::max(nodes, std::size_t(i) + 1);
    // entry k * count + e of the buffer is the force on point k of element e
    std::vector<int> ends(arity * count);
    for (std::size_t e = 0; e < count; ++e)
      for (std::size_t k = 0; k < arity; ++k) ends[k * count + e] = elements[e][k];
    index = std::move(ends);
    Tangent none;
    std::memset(static_cast<void*>(&none), 0, sizeof none);
    tangents.assign(count, none);
    received.assign(arity * count, Deriv(Deriv::Zero()));
    around = lists(0, arity);
    ofEnd.clear();
    product = {};
  }
  void split(int) {}
  std::size_t size() const { return elements.size(); }

  /// Takes away the elements for which gone(their points) holds, and returns how many those were.
  template <class Gone>
  std::size_t removeIf(Gone&& gone) {
    std::vector<Indices> stay;
    std::vector<Rest> restOfThose;
    auto const& all = std::as_const(rest).host();
    for (std::size_t e = 0; e < elements.size(); ++e)
      if (!gone(elements[e])) {
        stay.push_back(elements[e]);
        restOfThose.push_back(all[e]);
      }
    const std::size_t removed = elements.size() - stay.size();
    if (removed > 0) init(stay, restOfThose);
    return removed;
  }

  /// f += the law's forces at (x, v); keeps what addDForce needs.
  template <class VecDeriv, class VecCoord>
  void addForce(Law const& law, VecDeriv& f, VecCoord const& x, VecDeriv const& v, WorkShare = {}) {
    forces(law, same(entries(x)), same(entries(v)));
    sum(around, entries(f));
  }
  /// df += (k K + b B) dx with the tangents of the last addForce.
  template <class VecDeriv>
  void addDForce(Law const& law, VecDeriv& df, VecDeriv const& dx, Real k, Real b, WorkShare = {}) const {
    Product& p = product;
    if (p.k != k || p.b != b) p = {std::move(p.rows), k, b, 0, false};
    if constexpr (arity > 2)
      if (++p.times > 1) {
        if (!p.assembled || !p.rows.planned()) {  // a copy has no rows yet
          using Source = typename gpu::BlockRows<D>::Source;
          if (!p.rows.planned()) p.rows.plan({Source(elements)}, nodes);
          p.rows.add(0, law, view(), k, b);
          p.assembled = true;
        }
        p.rows.multiplyAdd(entries(df), entries(dx));
        return;
      }
    products(law, same(entries(dx)), k, b);
    sum(around, entries(df));
  }
  /// Adds the diagonal blocks of k K + b B, with the tangents of the last addForce, to those of all points of
  /// the body, of which there are `points`; their order is that of NodeBlock.
  void addDiagonal(Law const& law, Real* blocks, std::size_t points, Real k, Real b) const {
    if (around.first.empty()) return;
    gpu::for_each_index(
        nodes,
        gpu::detail::NodeBlock<LawOf, D>{
            law, view(), around.first.device(), around.entry.device(), blocks, std::ptrdiff_t(points), k, b});
  }

  // between two bodies

  void addForce(Law const& law, Derivs f, Coords x, ConstDerivs v, WorkShare = {}) {
    forces(law, x, v);
    sumAtEnds(f);
  }
  void addDForce(Law const& law, Derivs df, ConstDerivs dx, Real k, Real b, WorkShare = {}) const {
    products(law, dx, k, b);
    sumAtEnds(df);
  }

  /// Energy of all elements [J].
  template <class VecCoord>
  double energy(Law const& law, VecCoord const& x) const {
    return energy(law, same(entries(x)));
  }
  double energy(Law const& law, Coords x) const {
    return gpu::sum_on_host(elements.size(), gpu::detail::ElementEnergy<LawOf, D>{law, view(), x});
  }

  /// Adds k K + b B to a matrix on the host.
  template <int... SideOf, class Sink>
  void addToMatrix(Law const& law, Sink const& sink, Real k, Real b, WorkShare = {}) {
    if constexpr (Sink::phase != AssemblyPhase::bind) {
      constexpr std::array<int, arity> side = [] {
        if constexpr (sizeof...(SideOf) == 0)
          return std::array<int, arity>{};
        else
          return std::array<int, arity>{SideOf...};
      }();
      for (std::size_t e = 0; e < elements.size(); ++e) {
        [&]<int... P>(std::integer_sequence<int, P...>) {
          auto one = [&]<int I, int J>() {
            if constexpr (I <= J) {
              Mat<Real, D::size> block = Mat<Real, D::size>::Zero();
              if constexpr (Sink::phase == AssemblyPhase::add)
                block = law.block(std::as_const(rest)[e], std::as_const(tangents)[e], I, J, k, b);
              sink.template add<side[I], side[J]>(elements[e][I], elements[e][J], block);
              if constexpr (I != J)
                sink.template add<side[J], side[I]>(elements[e][J], elements[e][I], block.transpose().eval());
            }
          };
          (one.template operator()<P / arity, P % arity>(), ...);
        }(std::make_integer_sequence<int, arity * arity>{});
      }
    }
  }

  // on the device
  template <class T>
  using Array = gpu::DeviceVector<T>;
  struct Lists {
    Array<int> first{}, entry{};
  };
  struct Product {
    gpu::BlockRows<D> rows{};
    Real k{0}, b{0};
    int times = 0;
    bool assembled = false;
  };
  std::size_t nodes = 0;
  Array<int> index{};
  mutable Array<Tangent> tangents{};
  mutable Array<Deriv> received{};
  Lists around{};
  mutable std::vector<Lists> ofEnd{};
  mutable Product product{};

  gpu::detail::DeviceElements<LawOf, D> view() const {
    return {int(elements.size()), index.device(), rest.device(), tangents.device(), received.device()};
  }

 private:
  template <class T>
  static std::array<T*, arity> same(T* first) {
    std::array<T*, arity> ends;
    ends.fill(first);
    return ends;
  }
  void forces(Law const& law, Coords x, ConstDerivs v) {
    product.times = 0;
    product.assembled = false;
    gpu::for_each_index(elements.size(), gpu::detail::ElementForce<LawOf, D>{law, view(), x, v});
  }
  void products(Law const& law, ConstDerivs dx, Real k, Real b) const {
    gpu::for_each_index(elements.size(), gpu::detail::ElementDForce<LawOf, D>{law, view(), dx, k, b});
  }
  void sum(Lists const& of, Deriv* to) const {
    gpu::for_each_index(of.first.empty() ? 0 : of.first.size() - 1,
                        gpu::detail::NodeSum<Deriv>{
                            of.first.device(), of.entry.device(), std::as_const(received).device(), to});
  }
  void sumAtEnds(Derivs to) const {
    if (ofEnd.empty())
      for (int k = 0; k < arity; ++k) ofEnd.push_back(lists(k, k + 1));
    for (std::size_t k = 0; k < arity; ++k) sum(ofEnd[k], to[k]);
  }
  // which entries of the buffer are for which node, of the points from `begin` to `end` of the elements
  Lists lists(int begin, int end) const {
    const std::size_t count = elements.size();
    std::vector<int> first(nodes + 1, 0), entry(std::size_t(end - begin) * count);
    for (auto const& e : elements)
      for (int k = begin; k < end; ++k) ++first[std::size_t(e[std::size_t(k)]) + 1];
    for (std::size_t n = 0; n < nodes; ++n) first[n + 1] += first[n];
    std::vector<int> next(first.begin(), first.end() - 1);
    for (std::size_t e = 0; e < count; ++e)
      for (int k = begin; k < end; ++k)
        entry[std::size_t(next[std::size_t(elements[e][std::size_t(k)])]++)] =
            int(std::size_t(k) * count + e);
    return {std::move(first), std::move(entry)};
  }
};

}  // namespace sinew
