// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/assembly.hpp>
#include <sinew/core/data_types.hpp>
#include <sinew/core/element_driver/assembly.hpp>
#include <sinew/core/element_driver/kept_sums.hpp>
#include <sinew/core/element_driver/pack.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <vector>

namespace sinew {

/// Runs an element law over all elements of a body on one core: packs W elements into lanes, gathers their
/// points, calls the law, scatters what it returns. `Law<D>` knows one element and offers
///   arity, usesVelocity              how many points it has; whether force reads v
///   oneByOne (optional)              it is too little work for lanes, see element_lanes
///   symmetricBlocks (optional)       each block is its own transpose
///   Rest, Tangent                    what force needs; what dforce and block need of the last force
///   energy, force, dforce, block     see StiffSpring and TetrahedronFEM for their arguments
/// The tangent is symmetric: block(j, i) = block(i, j)', and only i <= j is asked for.
/// `Rest` holds nothing but scalars (or Eigen objects of them), so that W of them interleave into one of
/// lanes.
template <template <class> class LawOf, class D, int W = element_lanes<LawOf, D>()>
struct ElementDriver {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  using L = lanes<Real, W>;
  using DL = typename D::template rebind<L>;
  using Law = LawOf<DL>;
  using Rest = typename LawOf<D>::Rest;
  using Pack = ElementPack<LawOf, D, W>;
  static constexpr int arity = Law::arity, pairs = arity * (arity + 1) / 2, blockSize = D::size * D::size;
  using Slots = ElementSlots<pairs, W>;
  template <class Value>
  using OfPoints = typename Pack::template OfPoints<Value>;
  using Indices = typename Pack::Indices;
  using Coords = typename Pack::template Ends<Coord const>;
  using ConstDerivs = typename Pack::template Ends<Deriv const>;
  using Derivs = typename Pack::template Ends<Deriv>;

  std::vector<Pack> packs{};
  std::vector<Slots> slots{};
  int shares = 1;         // that run at once
  std::size_t inner = 0;  // packs at the begin that need no ghost point; see Elements
  KeptSums<Real, Pack::template realsOf<Deriv>> keptForces{};
  KeptSums<Real, blockSize> keptBlocks{};

  void init(std::vector<Indices> const& elements, std::vector<Rest> const& rest) {
    packs = std::vector<Pack>((elements.size() + W - 1) / W);
    slots.clear();
    forget();
    int last = 0;
    for (auto const& element : elements)
      for (const int i : element) last = std::max(last, i);
    for (std::size_t p = 0; p < packs.size(); ++p) packs[p].fill(elements, rest, p * W, last);
  }

  /// One element of the same rest for each of the first n points. Allocates nothing where there were as many
  /// before.
  void initPoints(std::size_t n, Rest const& rest) {
    static_assert(arity == 1);
    struct Points {
      std::size_t n;
      std::size_t size() const { return n; }
      Indices operator[](std::size_t i) const { return {int(i)}; }
    };
    struct Same {
      Rest const& rest;
      Rest operator[](std::size_t) const { return rest; }
    };
    packs.clear();
    packs.resize((n + W - 1) / W);
    slots.clear();
    forget();
    for (std::size_t p = 0; p < packs.size(); ++p) packs[p].fill(Points{n}, Same{rest}, p * W, int(n) - 1);
  }

  /// Prepares for so many shares at once, with at least so many elements each; where there are too few, there
  /// are fewer shares. Elements that are taken one by one are not split: there the compiler may make one
  /// operation of the last product and the sum, which has other bits.
  void split(int threads, std::size_t minimum = arity == 1 ? 4096 : 256) {
    const int maximum = int(std::min(std::size_t(threads), size() / minimum));
    forget();
    if (W == 1 || maximum < 2 || threads < 2) return;
    shares = maximum;
    keptForces.plan(shares, packs.size(), arity * W, [&](std::size_t p, auto&& f) {
      for (auto const& ends : packs[p].index)
        for (int l = 0; l < W; ++l) f(l < packs[p].active ? ends[l] : -1);
    });
    keptBlocks.plan(shares, slots.size(), pairs * W, [&](std::size_t p, auto&& f) {
      for (auto const& all : slots[p].slot)
        for (int l = 0; l < W; ++l) f(l < packs[p].active ? all[l] : -1);
    });
  }

  /// Points from this one on are ghosts.
  void setGhosts(std::size_t first) {
    inner = 0;
    auto own = [first](Pack const& pack) {
      for (auto const& ends : pack.index)
        for (const int i : ends)
          if (std::size_t(i) >= first) return false;
      return true;
    };
    while (inner < packs.size() && own(packs[inner])) ++inner;
  }

  std::size_t size() const {
    return packs.empty() ? 0 : W * (packs.size() - 1) + std::size_t(packs.back().active);
  }

  /// Takes away the elements for which gone(their points) holds, and returns how many those were. The others
  /// keep their order and their places in the matrix; their tangents are those of the next forces. Allocates
  /// nothing.
  template <class Gone>
  std::size_t removeIf(Gone&& gone) {
    const std::size_t n = size();
    std::size_t stay = 0;
    forget();
    int last = 0;
    for (Pack const& pack : packs)
      for (auto const& ends : pack.index) last = std::max(last, *std::max_element(ends, ends + W));
    for (std::size_t e = 0; e < n; ++e)
      if (!gone(packs[e / W].pointsOf(e % W))) move(e, stay++);
    packs.erase(packs.begin() + std::ptrdiff_t((stay + W - 1) / W), packs.end());
    if (!slots.empty()) slots.erase(slots.begin() + std::ptrdiff_t(packs.size()), slots.end());
    for (std::size_t e = stay; e < W * packs.size(); ++e) move(stay - 1, e);
    for (Pack& pack : packs) {
      pack.active = W, pack.hasLast = false;
      for (auto const& ends : pack.index) pack.hasLast |= std::find(ends, ends + W, last) != ends + W;
    }
    if (!packs.empty()) packs.back().active = int(stay - W * (packs.size() - 1));
    return n - stay;
  }

  /// The same first point for all ends, where an element has one body.
  template <class T>
  static std::array<T*, std::size_t(arity)> oneBody(T* first) {
    std::array<T*, std::size_t(arity)> ends;
    ends.fill(first);
    return ends;
  }
  template <class VecDeriv, class VecCoord>
  void addForce(Law const& law, VecDeriv& f, VecCoord const& x, VecDeriv const& v, WorkShare share = {}) {
    addForce(law, oneBody(f.data()), oneBody(x.data()), oneBody(v.data()), share);
  }
  template <class VecDeriv>
  void addDForce(Law const& law, VecDeriv& df, VecDeriv const& dx, Real k, Real b,
                 WorkShare share = {}) const {
    addDForce(law, oneBody(df.data()), oneBody(dx.data()), k, b, share);
  }
  double energy(Law const& law, std::vector<Coord> const& x) const { return energy(law, oneBody(x.data())); }

  /// Elements of one body may be taken in shares at the same time, as split() has prepared it, and then those
  /// shares once more in a second pass. All shares, and the whole, run the same compiled loop: of two copies
  /// of a law the compiler may join other products and sums to one operation, and their last bits differ.
  [[gnu::flatten]] void addForce(Law const& law, Derivs f, Coords x, ConstDerivs v,
                                 [[maybe_unused]] WorkShare share = {}) {
    if constexpr (W > 1) return forceOfShare(law, f, x, v, share);
    Pack* const end = packs.data() + last(share);
    for (Pack* p = packs.data() + first(share); p != end; ++p) {
      Pack& pack = *p;
      OfPoints<typename DL::Coord> xs;
      OfPoints<typename DL::Deriv> vs, fs;
      pack.gather(x, xs);
      if constexpr (Law::usesVelocity) pack.gather(v, vs);
      law.force(pack.rest, xs, vs, fs, pack.tangent);
      pack.scatter(fs, f);
    }
  }

  [[gnu::flatten]] void addDForce(Law const& law, Derivs df, ConstDerivs dx, Real k, Real b,
                                  [[maybe_unused]] WorkShare share = {}) const {
    if constexpr (W > 1) return dforceOfShare(law, df, dx, k, b, share);
    Pack const* const end = packs.data() + last(share);
    for (Pack const* p = packs.data() + first(share); p != end; ++p) {
      Pack const& pack = *p;
      OfPoints<typename DL::Deriv> dxs, dfs;
      pack.gather(dx, dxs);
      law.dforce(pack.rest, pack.tangent, dxs, dfs, L(k), L(b));
      pack.scatter(dfs, df);
    }
  }

  double energy(Law const& law, Coords x) const {
    double sum = 0;
    for (Pack const& pack : packs) {
      OfPoints<typename DL::Coord> xs;
      pack.gather(x, xs);
      const L e = law.energy(pack.rest, xs);
      for (int l = 0; l < pack.active; ++l) sum += double(lane(e, l));
    }
    return sum;
  }

  /// Adds k K + b B to the matrix behind the sink. SideOf[i]: on which end of an interaction point i of an
  /// element is.
  template <int... SideOf, class Sink>
  void addToMatrix(Law const& law, Sink const& sink, Real k, Real b, WorkShare share = {}) {
    using Matrix = typename Sink::MatrixType;
    constexpr bool within = ((SideOf == 0) && ...);
    if constexpr (Sink::direct && within && Matrix::blockSize == D::size &&
                  Sink::phase != AssemblyPhase::pattern) {
      if constexpr (Sink::phase == AssemblyPhase::bind) {
        bind(sink);
      } else {
        if constexpr (W > 1)
          blocksOfShare(law, sink.matrix, k, b, share);
        else
          addOneByOne(law, sink.matrix, k, b);
      }
    } else if constexpr (Sink::phase != AssemblyPhase::bind) {
      if (share.index > 0 || share.pass == 1) return;
      if constexpr (within) {
        for (Pack const& pack : packs)
          for (int i = 0; i < arity; ++i)
            for (int j = i; j < arity; ++j) detail::add_pair<0, 0, D::size>(law, sink, pack, i, j, k, b);
      } else {
        using Sides = std::integer_sequence<int, SideOf...>;
        for (Pack const& pack : packs) detail::add_between<Sides, D::size>(law, sink, pack, k, b);
      }
    }
  }

 private:
  // the packs of a share, of those that are asked for; elements that are taken one by one are in no shares
  std::size_t first(WorkShare share) const {
    if (share.elements == Elements::outer) return inner;
    return W == 1 ? 0 : share.begin(packs.size());
  }
  std::size_t last(WorkShare share) const {
    if (share.elements == Elements::inner) return inner;
    return W == 1 ? packs.size() : share.end(packs.size());
  }

  void forget() {
    shares = 1;
    inner = 0;
    keptForces = {};
    keptBlocks = {};
  }

  [[gnu::noinline, gnu::flatten]] void forceOfShare(Law const& law, Derivs f, Coords x, ConstDerivs v,
                                                    WorkShare share) {
    forEachPack(
        *this, share, f, [&](Pack & pack, OfPoints<typename DL::Deriv> & fs) __attribute__((always_inline)) {
          OfPoints<typename DL::Coord> xs;
          OfPoints<typename DL::Deriv> vs;
          pack.gather(x, xs);
          if constexpr (Law::usesVelocity) pack.gather(v, vs);
          law.force(pack.rest, xs, vs, fs, pack.tangent);
        });
  }

  [[gnu::noinline, gnu::flatten]] void dforceOfShare(Law const& law, Derivs df, ConstDerivs dx, Real k,
                                                     Real b, WorkShare share) const {
    forEachPack(
        *this,
        share,
        df,
        [&](Pack const& pack, OfPoints<typename DL::Deriv>& dfs) __attribute__((always_inline)) {
          OfPoints<typename DL::Deriv> dxs;
          pack.gather(dx, dxs);
          law.dforce(pack.rest, pack.tangent, dxs, dfs, L(k), L(b));
        });
  }

  // Calls law(pack, forces) for the packs of a share, and adds the forces
  template <class Self, class OfPack>
  SINEW_INLINE static void forEachPack(Self& self, WorkShare share, Derivs const& to, OfPack&& law) {
    if (share.count > 1) share.count = self.shares;
    if (share.index >= share.count) return;
    const bool whole = share.count == 1;
    if (share.pass == 1) {
      constexpr int n = Pack::template realsOf<Deriv>;
      self.keptForces.addDeferred(share, [&](int place, Real const* kept) {
        for (int c = 0; c < n; ++c) reinterpret_cast<Real*>(to[0] + place)[c] += kept[c];
      });
      return;
    }
    const std::size_t end = self.last(share);
    for (std::size_t p = self.first(share); p < end; ++p) {
      auto& pack = self.packs[p];
      OfPoints<typename DL::Deriv> fs;
      law(pack, fs);
      int const* const entries = whole ? nullptr : self.keptForces.entriesOf(p);
      if (entries) [[unlikely]] {
        // a copy, so that what others receive may stay in registers
        OfPoints<typename DL::Deriv> kept;
        for (int k = 0; k < arity; ++k) kept[k] = fs[k];
        self.keep(pack, entries, kept, to[0]);
      } else {
        pack.scatter(fs, to);
      }
    }
  }
  // stores the forces on points that an earlier share touches
  [[gnu::noinline]] void keep(Pack const& pack, int const* entries, OfPoints<typename DL::Deriv> const& from,
                              Deriv* to) const {
    constexpr int n = Pack::template realsOf<Deriv>;
    for (int k = 0; k < arity; ++k)
      for (int l = 0; l < pack.active; ++l) {
        const int entry = entries[k * W + l];
        L const* const values = reinterpret_cast<L const*>(&from[k]);
        if (entry >= 0)
          for (int c = 0; c < n; ++c) keptForces.entry(entry)[c] = lane(values[c], l);
        else
          for (int c = 0; c < n; ++c) reinterpret_cast<Real*>(to + pack.index[k][l])[c] += lane(values[c], l);
      }
  }
  // an element to the place of another
  void move(std::size_t from, std::size_t to) {
    if (from == to) return;
    packs[to / W].take(to % W, packs[from / W], from % W);
    if (!slots.empty()) slots[to / W].take(int(to % W), slots[from / W], int(from % W));
  }

  template <class Sink>
  void bind(Sink const& sink) {
    slots.assign(packs.size(), Slots{});
    for (std::size_t p = 0; p < packs.size(); ++p)
      slots[p].bind(packs[p], sink.first.offset / D::size, sink.matrix);
  }

  template <class Matrix>
  void addOneByOne(Law const& law, Matrix& matrix, Real k, Real b) const {
    for (std::size_t p = 0; p < packs.size(); ++p)
      detail::add_blocks_of_one<D::size>(law, packs[p], slots[p], matrix, k, b);
  }

  template <class Matrix>
  [[gnu::noinline, gnu::flatten]] void blocksOfShare(Law const& law, Matrix& matrix, Real k, Real b,
                                                     WorkShare share) {
    constexpr int n = D::size;
    if (share.count > 1) share.count = shares;
    if (share.index >= share.count) return;
    if (share.pass == 1) {
      keptBlocks.addDeferred(
          share, [&](int slot, Real const* kept) { detail::add_to<n * n>(matrix.block(slot), kept); });
      return;
    }
    const std::size_t end = share.end(packs.size());
    auto* const values = matrix.block(0);
    for (std::size_t p = share.begin(packs.size()); p < end; ++p) {
      Pack const& pack = packs[p];
      int const* const entries = share.count > 1 ? keptBlocks.entriesOf(p) : nullptr;
      detail::for_each_pair<arity>([&]<class I, class J>(I i, J j) {
        const int pair = detail::pair_number<arity>(i, j);
        const Mat<L, n> block = law.block(pack.rest, pack.tangent, i, j, L(k), L(b));
        auto const& slot = slots[p].slot[pair];
        alignas(64) Real ofLane[std::size_t(W)][std::size_t(n * n + 3) / 4 * 4];
        detail::separate<detail::same_point<I, J>, n>(block, slots[p].transposed[pair], ofLane);
        auto add = [&](int l) __attribute__((always_inline)) {
          detail::add_to<n * n>(values + std::ptrdiff_t(slot[l]) * (n * n), ofLane[l]);
        };
        if (!entries) [[likely]] {
          for (int l = 0; l < pack.active; ++l) add(l);
          return;
        }
        for (int l = 0; l < std::min(W, pack.active); ++l)
          if (entries[pair * W + l] >= 0)
            std::memcpy(keptBlocks.entry(entries[pair * W + l]), ofLane[l], n * n * sizeof(Real));
          else
            add(l);
      });
    }
  }
};

/// Whether a driver can have as many elements as there are points from step to step.
template <class Driver>
inline constexpr bool counts_points =
    requires(Driver d, typename Driver::Rest const rest) { d.initPoints(std::size_t(), rest); };

}  // namespace sinew
