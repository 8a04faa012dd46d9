// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/error.hpp>
#include <sinew/gpu/element_kernels.hpp>
#include <sinew/gpu/execution.hpp>

#include <thrust/copy.h>
#include <thrust/device_vector.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew::gpu {

/// Runs an element law over all elements of a body on Thrust's device, one thread an element, with the law's
/// code for plain scalars that the CPU driver uses too. In gather form: the elements first write the forces
/// on their points to a buffer; each node then sums its entries of it, elements in ascending order. No
/// atomics: the same input gives the same bits, in every run and with any number of threads.
template <template <class> class LawOf, class D>
class ThrustElementDriver {
 public:
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  using Law = LawOf<D>;
  using Rest = typename Law::Rest;
  using Tangent = typename Law::Tangent;
  static constexpr int arity = Law::arity;
  using Indices = std::array<int, arity>;
  using DeviceCoords = thrust::device_vector<Coord>;
  using DeviceDerivs = thrust::device_vector<Deriv>;

  /// Copies the elements, their rest data and the lists of elements around each node to the device. Throws
  /// Error on a point outside 0 .. nodeCount - 1, on another number of rest data than of elements, and on
  /// more than 2^31 - 1 ends of elements.
  void init(std::vector<Indices> const& elements, std::vector<Rest> const& rest, std::size_t nodeCount) {
    check(elements, rest, nodeCount);
    const std::size_t count = elements.size();
    constexpr std::size_t reals = sizeof(Rest) / sizeof(Real);

    // entry k * count + e of the buffer is the force on point k of element e
    std::vector<int> index(arity * count), first(nodeCount + 1, 0), entry(arity * count);
    for (std::size_t e = 0; e < count; ++e)
      for (std::size_t k = 0; k < arity; ++k) {
        index[k * count + e] = elements[e][k];
        ++first[std::size_t(elements[e][k]) + 1];
      }
    for (std::size_t n = 0; n < nodeCount; ++n) first[n + 1] += first[n];
    std::vector<int> next(first.begin(), first.end() - 1);
    for (std::size_t e = 0; e < count; ++e)
      for (std::size_t k = 0; k < arity; ++k)
        entry[std::size_t(next[std::size_t(elements[e][k])]++)] = int(k * count + e);

    std::vector<Real> scalars(reals * count);
    for (std::size_t e = 0; e < count; ++e)
      detail::store_strided(rest[e], scalars.data() + e, std::ptrdiff_t(count));

    ThrustElementDriver loaded;
    loaded.count_ = count;
    loaded.nodeCount_ = nodeCount;
    loaded.index_ = index;
    loaded.first_ = first;
    loaded.entry_ = entry;
    loaded.rest_ = scalars;
    loaded.tangent_.assign(sizeof(Tangent) / sizeof(Real) * count, Real(0));
    loaded.part_.assign(arity * count, Deriv::Zero());
    loaded.energy_.assign(std::min(count, energyThreads), 0.0);
    *this = std::move(loaded);  // all or, where memory runs out, nothing
  }

  /// f += the law's forces at (x, v); keeps what addDForce needs. Throws Error unless f, x and v have one
  /// entry a node.
  void addForce(Law const& law, DeviceDerivs& f, DeviceCoords const& x, DeviceDerivs const& v) {
    checkSize("addForce", "f", f.size());
    checkSize("addForce", "x", x.size());
    checkSize("addForce", "v", v.size());
    for_each_index(count_, detail::ElementForce<LawOf, D>{law, elements(), raw(x), raw(v)});
    sumAtNodes(f);
  }

  /// df += (k K + b B) dx with the tangents of the last addForce. Throws Error unless df and dx have one
  /// entry a node.
  void addDForce(Law const& law, DeviceDerivs& df, DeviceDerivs const& dx, Real k, Real b) {
    checkSize("addDForce", "df", df.size());
    checkSize("addDForce", "dx", dx.size());
    for_each_index(count_, detail::ElementDForce<LawOf, D>{law, elements(), raw(dx), k, b});
    sumAtNodes(df);
  }

  /// Energy of all elements at x [J]. The sum has one shape everywhere: thread t of 4096 adds up elements t,
  /// t + 4096, ..., the host their sums. Throws Error unless x has one entry a node.
  double energy(Law const& law, DeviceCoords const& x) {
    checkSize("energy", "x", x.size());
    for_each_index(
        energy_.size(),
        detail::ElementEnergy<LawOf, D>{law, elements(), raw(x), int(energyThreads), raw(energy_)});
    std::vector<double> sums(energy_.size());
    thrust::copy(energy_.begin(), energy_.end(), sums.begin());
    double sum = 0;
    for (const double s : sums) sum += s;
    return sum;
  }

  std::size_t size() const { return count_; }
  std::size_t nodeCount() const { return nodeCount_; }

 private:
  static constexpr std::size_t energyThreads = 4096;
  std::size_t count_ = 0, nodeCount_ = 0;
  thrust::device_vector<int> index_{}, first_{}, entry_{};
  thrust::device_vector<Real> rest_{}, tangent_{};
  DeviceDerivs part_{};
  thrust::device_vector<double> energy_{};

  template <class T>
  static T const* raw(thrust::device_vector<T> const& v) {
    return thrust::raw_pointer_cast(v.data());
  }
  template <class T>
  static T* raw(thrust::device_vector<T>& v) {
    return thrust::raw_pointer_cast(v.data());
  }
  detail::DeviceElements<LawOf, D> elements() {
    return {int(count_), raw(index_), raw(rest_), raw(tangent_), raw(part_)};
  }
  void sumAtNodes(DeviceDerivs& f) {
    for_each_index(nodeCount_, detail::NodeSum<Deriv>{raw(first_), raw(entry_), raw(part_), raw(f)});
  }

  static void check(std::vector<Indices> const& elements, std::vector<Rest> const& rest,
                    std::size_t nodeCount) {
    const char* const where = "ThrustElementDriver::init";
    constexpr std::size_t most = std::numeric_limits<int>::max();
    if (rest.size() != elements.size())
      throw Error(where,
                  text(rest.size(),
                       " rest data were given for ",
                       elements.size(),
                       " elements; give one for each element"));
    if (elements.size() > most / arity || nodeCount >= most)
      throw Error(where,
                  text(elements.size(),
                       " elements over ",
                       nodeCount,
                       " nodes exceed the 2^31 - 1 numbers of an int; split the body"));
    for (std::size_t e = 0; e < elements.size(); ++e)
      for (const int i : elements[e])
        if (i < 0 || std::size_t(i) >= nodeCount)
          throw Error(where,
                      text("element ",
                           e,
                           " refers to node ",
                           i,
                           ", but there are ",
                           nodeCount,
                           " nodes, numbered from 0; correct the index"));
  }
  void checkSize(std::string_view function, std::string_view name, std::size_t size) const {
    if (size != nodeCount_)
      throw Error(text("ThrustElementDriver::", function),
                  text(name,
                       " has ",
                       size,
                       " entries, but init was given ",
                       nodeCount_,
                       " nodes; pass vectors with one entry a node"));
  }
};

}  // namespace sinew::gpu
