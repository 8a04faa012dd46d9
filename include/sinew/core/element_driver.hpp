// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/assembly.hpp>
#include <sinew/core/data_types.hpp>
#include <sinew/core/late_sums.hpp>

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
  static constexpr int arity = Law::arity;
  static constexpr int pairs = arity * (arity + 1) / 2;
  template <class Value>
  using OfPoints = Value[std::size_t(arity)];
  template <class Value>
  using OfPairs = Value[std::size_t(pairs)];
  template <class Value>
  using OfLanes = Value[std::size_t(W)];
  using Indices = std::array<int, std::size_t(arity)>;
  // first point of the state that each end of an element lives on
  using Coords = std::array<Coord const*, std::size_t(arity)>;
  using ConstDerivs = std::array<Deriv const*, std::size_t(arity)>;
  using Derivs = std::array<Deriv*, std::size_t(arity)>;

  struct Pack {
    typename Law::Rest rest;
    typename Law::Tangent tangent;
    OfPoints<OfLanes<int>> index;
    int active;
    bool hasLast;  // one of the points may be the last of its state: nothing may be read behind it
  };
  // where the blocks of a pack stand in the matrix of the solver: slot of the one on or above the diagonal,
  // and, a bit for each lane, whether it is the transpose of the law's block(i, j)
  struct Slots {
    OfPairs<OfLanes<int>> slot;
    OfPairs<std::uint16_t> transposed;
    static_assert(W <= 16);
    void set(int pair, int lane, bool turned) {
      transposed[pair] = std::uint16_t((transposed[pair] & ~(1 << lane)) | turned << lane);
    }
  };
  std::vector<Pack> packs{};
  std::vector<Slots> slots{};
  // of parts that run at once
  int parts = 1;
  LateSums lateForces{}, lateBlocks{};
  mutable std::vector<Real> keptForces{}, keptBlocks{};

  /// The last pack is filled up with copies of its last element, which are computed and never scattered.
  void init(std::vector<Indices> const& elements, std::vector<Rest> const& rest) {
    static_assert(sizeof(typename Law::Rest) == W * sizeof(Rest),
                  "a law's Rest holds only scalars of its Real");
    constexpr std::size_t reals = sizeof(Rest) / sizeof(Real);
    packs = std::vector<Pack>((elements.size() + W - 1) / W);
    slots.clear();
    forget();
    int last = 0;
    for (auto const& element : elements)
      for (const int i : element) last = std::max(last, i);
    for (std::size_t p = 0; p < packs.size(); ++p) {
      Pack& pack = packs[p];
      pack.active = int(std::min<std::size_t>(W, elements.size() - p * W));
      Real interleaved[reals * W];
      for (int l = 0; l < W; ++l) {
        const std::size_t e = p * W + std::size_t(std::min(l, pack.active - 1));
        Real one[reals];
        std::memcpy(one, &rest[e], sizeof one);
        for (std::size_t r = 0; r < reals; ++r) interleaved[r * W + std::size_t(l)] = one[r];
        for (int k = 0; k < arity; ++k) {
          pack.index[k][l] = elements[e][std::size_t(k)];
          pack.hasLast |= pack.index[k][l] == last;
        }
      }
      std::memcpy(static_cast<void*>(&pack.rest), interleaved, sizeof interleaved);
      std::memset(static_cast<void*>(&pack.tangent), 0, sizeof pack.tangent);
    }
  }

  /// Prepares for so many parts at once, with at least so many elements each; where there are too few, there
  /// are fewer parts. Elements that are taken one by one are not split: there the compiler may make one
  /// operation of the last product and the sum, which has other bits.
  void split(int threads, std::size_t least = 256) {
    parts = int(std::min(std::size_t(threads), size() / least));
    if (W == 1 || parts < 2 || threads < 2) {
      forget();
      return;
    }
    int last = 0;
    for (Pack const& pack : packs)
      for (auto const& ends : pack.index) last = std::max(last, *std::max_element(ends, ends + W));
    lateForces.plan(parts, packs.size(), arity * W, std::size_t(last) + 1, [&](std::size_t p, auto&& f) {
      for (auto const& ends : packs[p].index)
        for (int l = 0; l < W; ++l) f(l < packs[p].active ? ends[l] : -1);
    });
    keptForces.resize(lateForces.roomCount() * realsOf<Deriv>);
    lateBlocks = {};
    if (!slots.empty()) {
      for (Slots const& s : slots)
        for (auto const& all : s.slot) last = std::max(last, *std::max_element(all, all + W));
      lateBlocks.plan(parts, packs.size(), pairs * W, std::size_t(last) + 1, [&](std::size_t p, auto&& f) {
        for (auto const& all : slots[p].slot)
          for (int l = 0; l < W; ++l) f(l < packs[p].active ? all[l] : -1);
      });
    }
    keptBlocks.resize(lateBlocks.roomCount() * D::size * D::size);
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
    for (std::size_t e = 0; e < n; ++e) {
      Indices points;
      for (int k = 0; k < arity; ++k) points[std::size_t(k)] = packs[e / W].index[k][e % W];
      if (!gone(points)) move(e, stay++);
    }
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
  void addForce(Law const& law, VecDeriv& f, VecCoord const& x, VecDeriv const& v, Part part = {}) {
    addForce(law, oneBody(f.data()), oneBody(x.data()), oneBody(v.data()), part);
  }
  template <class VecDeriv>
  void addDForce(Law const& law, VecDeriv& df, VecDeriv const& dx, Real k, Real b, Part part = {}) const {
    addDForce(law, oneBody(df.data()), oneBody(dx.data()), k, b, part);
  }
  double energy(Law const& law, std::vector<Coord> const& x) const { return energy(law, oneBody(x.data())); }

  /// Elements of one body may be taken in parts at once, as split() has prepared it, and then those parts
  /// once more as late ones. All parts, and the whole, run the same compiled loop: of two copies of a law the
  /// compiler may join other products and sums to one operation, and their last bits differ.
  [[gnu::flatten]] void addForce(Law const& law, Derivs f, Coords x, ConstDerivs v,
                                 [[maybe_unused]] Part part = {}) {
    if constexpr (W > 1) return forceInParts(law, f, x, v, part);
    for (Pack& pack : packs) {
      OfPoints<typename DL::Coord> xs;
      OfPoints<typename DL::Deriv> vs, fs;
      gather(pack, x, xs);
      if constexpr (Law::usesVelocity) gather(pack, v, vs);
      law.force(pack.rest, xs, vs, fs, pack.tangent);
      scatter(pack, fs, f);
    }
  }

  [[gnu::flatten]] void addDForce(Law const& law, Derivs df, ConstDerivs dx, Real k, Real b,
                                  [[maybe_unused]] Part part = {}) const {
    if constexpr (W > 1) return dforceInParts(law, df, dx, k, b, part);
    for (Pack const& pack : packs) {
      OfPoints<typename DL::Deriv> dxs, dfs;
      gather(pack, dx, dxs);
      law.dforce(pack.rest, pack.tangent, dxs, dfs, L(k), L(b));
      scatter(pack, dfs, df);
    }
  }

  double energy(Law const& law, Coords x) const {
    double sum = 0;
    for (Pack const& pack : packs) {
      OfPoints<typename DL::Coord> xs;
      gather(pack, x, xs);
      const L e = law.energy(pack.rest, xs);
      for (int l = 0; l < pack.active; ++l) sum += double(lane(e, l));
    }
    return sum;
  }

  /// Adds k K + b B to the matrix behind the sink. SideOf[i]: on which end of an interaction point i of an
  /// element is.
  template <int... SideOf, class Sink>
  void addToMatrix(Law const& law, Sink const& sink, Real k, Real b, Part part = {}) {
    using Matrix = typename Sink::MatrixType;
    constexpr bool within = ((SideOf == 0) && ...);
    if constexpr (Sink::direct && within && Matrix::blockSize == D::size &&
                  Sink::phase != AssemblyPhase::pattern) {
      if constexpr (Sink::phase == AssemblyPhase::bind) {
        bind(sink);
      } else {
        if constexpr (W > 1)
          blocksInParts(law, sink.matrix, k, b, part);
        else
          addToSlots(law, sink.matrix, k, b);
      }
    } else if constexpr (Sink::phase != AssemblyPhase::bind) {
      if (part.index > 0 || part.late) return;
      auto addPair = [&]<int SideI, int SideJ>(Pack const& pack, int i, int j) {
        Mat<L, D::size> block;
        if constexpr (Sink::phase == AssemblyPhase::add)
          block = law.block(pack.rest, pack.tangent, i, j, L(k), L(b));
        for (int l = 0; l < pack.active; ++l) {
          Mat<Real, D::size> one = Mat<Real, D::size>::Zero();
          if constexpr (Sink::phase == AssemblyPhase::add)
            for (int c = 0; c < D::size * D::size; ++c) one(c) = lane(block(c), l);
          sink.template add<SideI, SideJ>(pack.index[i][l], pack.index[j][l], one);
          if (i != j)
            sink.template add<SideJ, SideI>(pack.index[j][l], pack.index[i][l], one.transpose().eval());
        }
      };
      for (Pack const& pack : packs) {
        if constexpr (within) {
          for (int i = 0; i < arity; ++i)
            for (int j = i; j < arity; ++j) addPair.template operator()<0, 0>(pack, i, j);
        } else {
          constexpr std::array<int, std::size_t(arity)> side{SideOf...};
          forEachPair([&]<int I, int J>() { addPair.template operator()<side[I], side[J]>(pack, I, J); });
        }
      }
    }
  }

 private:
  void forget() {
    parts = 1;
    lateForces = lateBlocks = {};
  }

  [[gnu::noinline, gnu::flatten]] void forceInParts(Law const& law, Derivs f, Coords x, ConstDerivs v,
                                                    Part part) {
    forEachPack(
        *this, part, f, [&](Pack & pack, OfPoints<typename DL::Deriv> & fs) __attribute__((always_inline)) {
          OfPoints<typename DL::Coord> xs;
          OfPoints<typename DL::Deriv> vs;
          gather(pack, x, xs);
          if constexpr (Law::usesVelocity) gather(pack, v, vs);
          law.force(pack.rest, xs, vs, fs, pack.tangent);
        });
  }

  [[gnu::noinline, gnu::flatten]] void dforceInParts(Law const& law, Derivs df, ConstDerivs dx, Real k,
                                                     Real b, Part part) const {
    forEachPack(
        *this,
        part,
        df,
        [&](Pack const& pack, OfPoints<typename DL::Deriv>& dfs) __attribute__((always_inline)) {
          OfPoints<typename DL::Deriv> dxs;
          gather(pack, dx, dxs);
          law.dforce(pack.rest, pack.tangent, dxs, dfs, L(k), L(b));
        });
  }

  // law(pack, what its points receive) for the packs of a part, and adds that
  template <class Self, class OfPack>
  SINEW_INLINE static void forEachPack(Self& self, Part part, Derivs const& to, OfPack&& law) {
    if (part.count > 1) part.count = self.parts;
    if (part.index >= part.count) return;
    const bool whole = part.count == 1;
    constexpr int n = realsOf<Deriv>;
    if (part.late) {
      self.lateForces.addLate(part, [&](int place, std::size_t room) {
        Real const* const kept = self.keptForces.data() + room * n;
        for (int c = 0; c < n; ++c) reinterpret_cast<Real*>(to[0] + place)[c] += kept[c];
      });
      return;
    }
    const std::size_t end = part.end(self.packs.size());
    for (std::size_t p = part.begin(self.packs.size()); p < end; ++p) {
      auto& pack = self.packs[p];
      OfPoints<typename DL::Deriv> fs;
      law(pack, fs);
      if (!whole && self.lateForces.firstOf[p] >= 0) [[unlikely]] {
        // a copy, so that what others receive may stay in registers
        OfPoints<typename DL::Deriv> kept;
        for (int k = 0; k < arity; ++k) kept[k] = fs[k];
        self.keep(pack, self.lateForces.rooms.data() + self.lateForces.firstOf[p], kept, to[0]);
      } else {
        scatter(pack, fs, to);
      }
    }
  }
  // of what points receive, what belongs to a part before is kept
  [[gnu::noinline]] void keep(Pack const& pack, int const* rooms, OfPoints<typename DL::Deriv> const& from,
                              Deriv* to) const {
    constexpr int n = realsOf<Deriv>;
    for (int k = 0; k < arity; ++k)
      for (int l = 0; l < pack.active; ++l) {
        const int room = rooms[k * W + l];
        L const* const values = reinterpret_cast<L const*>(&from[k]);
        if (room >= 0)
          for (int c = 0; c < n; ++c) keptForces[std::size_t(room * n + c)] = lane(values[c], l);
        else
          for (int c = 0; c < n; ++c) reinterpret_cast<Real*>(to + pack.index[k][l])[c] += lane(values[c], l);
      }
  }
  // an element to the place of another
  void move(std::size_t from, std::size_t to) {
    if (from == to) return;
    Pack &a = packs[from / W], &b = packs[to / W];
    const std::size_t l = from % W, m = to % W;
    for (std::size_t r = 0; r < sizeof(Rest) / sizeof(Real); ++r)
      std::memcpy(reinterpret_cast<char*>(&b.rest) + (r * W + m) * sizeof(Real),
                  reinterpret_cast<char const*>(&a.rest) + (r * W + l) * sizeof(Real),
                  sizeof(Real));
    for (auto k = 0; k < arity; ++k) b.index[k][m] = a.index[k][l];
    if (slots.empty()) return;
    for (int p = 0; p < pairs; ++p) {
      slots[to / W].slot[p][m] = slots[from / W].slot[p][l];
      slots[to / W].set(p, int(m), slots[from / W].transposed[p] >> l & 1);
    }
  }

  template <class Value>
  static constexpr int realsOf = int(sizeof(Value) / sizeof(Real));

  template <class Value, class LaneValue>
  SINEW_INLINE static void gather(Pack const& pack, std::array<Value const*, std::size_t(arity)> const& from,
                                  OfPoints<LaneValue>& to) {
    constexpr int n = realsOf<Value>;
    if constexpr (n == 3 && W >= 4)
      if (!pack.hasLast) {
        for (int k = 0; k < arity; ++k)
          gather3(reinterpret_cast<Real const*>(from[std::size_t(k)]),
                  pack.index[k],
                  reinterpret_cast<L*>(&to[k]));
        return;
      }
    if constexpr (W == 1)
      for (int k = 0; k < arity; ++k) to[k] = from[std::size_t(k)][pack.index[k][0]];
    else
      for (int k = 0; k < arity; ++k) {
        OfLanes<Real const*> values;
        for (int l = 0; l < W; ++l)
          values[l] = reinterpret_cast<Real const*>(from[std::size_t(k)] + pack.index[k][l]);
        auto component = [&]<int... Lane>(int c, std::integer_sequence<int, Lane...>)
            __attribute__((always_inline)) {
          reinterpret_cast<L*>(&to[k])[c] = typename L::Vector{values[Lane][c]...};
        };
        [&]<int... C>(std::integer_sequence<int, C...>) __attribute__((always_inline)) {
          (component(C, std::make_integer_sequence<int, W>{}), ...);
        }
        (std::make_integer_sequence<int, n>{});
      }
  }

  SINEW_INLINE static void scatter(Pack const& pack, OfPoints<typename DL::Deriv>& from, Derivs const& to) {
    constexpr int n = realsOf<Deriv>;
    if constexpr (W == 1) {
      for (int k = 0; k < arity; ++k) {
        to[std::size_t(k)][pack.index[k][0]] += from[k];
      }
    } else if constexpr (n == 3 && W >= 4) {
      if (pack.active != W) [[unlikely]]
        for (int k = 0; k < arity; ++k)
          for (int c = 0; c < n; ++c)
            for (int l = pack.active; l < W; ++l) from[k][c].set(l, Real(0));
      [&]<int... K>(std::integer_sequence<int, K...>) __attribute__((always_inline)) {
        (add3(reinterpret_cast<L const*>(&from[K]), reinterpret_cast<Real*>(to[K]), pack.index[K]), ...);
      }
      (std::make_integer_sequence<int, arity>{});
    } else {
      alignas(64) OfPoints<OfLanes<Real[std::size_t(n + 3) / 4 * 4]>> ofLane;
      [&]<int... K>(std::integer_sequence<int, K...>) __attribute__((always_inline)) {
        (transpose<n>(reinterpret_cast<L const*>(&from[K]), ofLane[K]), ...);
      }
      (std::make_integer_sequence<int, arity>{});
      auto add = [&](int k, int l) __attribute__((always_inline)) {
        addTo<n>(reinterpret_cast<Real*>(to[std::size_t(k)] + pack.index[k][l]), ofLane[k][l]);
      };
      for (int k = 0; k < arity; ++k)
        if (pack.active == W)
          for (int l = 0; l < W; ++l) add(k, l);
        else
          for (int l = 0; l < pack.active; ++l) add(k, l);
    }
  }

  // f<I, J>() for each pair of points I <= J
  template <class F>
  static void forEachPair(F&& f) {
    [&]<int... P>(std::integer_sequence<int, P...>) {
      (
          [&] {
            constexpr int i = P / arity, j = P % arity;
            if constexpr (i <= j) f.template operator()<i, j>();
          }(),
          ...);
    }
    (std::make_integer_sequence<int, arity * arity>{});
  }
  static constexpr int pairNumber(int i, int j) { return i * arity - i * (i - 1) / 2 + j - i; }

  // to[0..N) += from[0..N), four at a time, then two
  template <int N, class Target>
  SINEW_INLINE static void addTo(Target* to, Real const* from) {
    int i = 0;
    if constexpr (std::is_same_v<Target, Real>) {
      for (; i + 4 <= N; i += 4) addSome<4>(to + i, from + i);
      if (i + 2 <= N) addSome<2>(to + i, from + i), i += 2;
    }
    for (; i < N; ++i) to[i] += Target(from[i]);
  }
  template <int N>
  SINEW_INLINE static void addSome(Real* to, Real const* from) {
    typedef Real Some __attribute__((vector_size(N * sizeof(Real))));
    Some sum, more;
    std::memcpy(&sum, to, sizeof sum);
    std::memcpy(&more, from, sizeof more);
    sum += more;
    std::memcpy(to, &sum, sizeof sum);
  }

  // to += block or its transpose, row-major; vectors are made of scalars in registers, since what is written
  // scalar by scalar cannot be read back at once as a vector
  template <int N, class Block>
  SINEW_INLINE static void addScalars(auto* to, Block const& block, bool turned) {
    auto entry = [&](int r, int c) { return turned ? block(c, r) : block(r, c); };
#if !defined(__CUDACC__)
    if constexpr (N == 3 && std::is_same_v<Real*, decltype(to)>) {
      typedef Real Four __attribute__((vector_size(4 * sizeof(Real))));
      const Four more[2] = {{entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 0)},
                            {entry(1, 1), entry(1, 2), entry(2, 0), entry(2, 1)}};
      for (int i = 0; i < 2; ++i) {
        Four sum;
        std::memcpy(&sum, to + 4 * i, sizeof sum);
        sum += more[i];
        std::memcpy(to + 4 * i, &sum, sizeof sum);
      }
      to[8] += entry(2, 2);
      return;
    }
#endif
    for (int r = 0; r < N; ++r)
      for (int c = 0; c < N; ++c) to[r * N + c] += entry(r, c);
  }

  // the block of each lane, or its transpose, row-major as the matrix has it
  template <bool Symmetric, class Block, std::size_t Size>
  SINEW_INLINE static void separate(Block const& block, std::uint16_t transposed,
                                    Real (&ofLane)[std::size_t(W)][Size]) {
    constexpr int n = D::size;
    const auto turned = lanes_of_bits<L>(transposed);
    L rows[std::size_t(n * n)];
    for (int r = 0; r < n; ++r)
      for (int c = 0; c < n; ++c)
        rows[r * n + c] = Symmetric || r == c ? block(r, c) : select(turned, L(block(c, r)), L(block(r, c)));
    transpose<n * n>(rows, ofLane);
  }

  template <class Sink>
  void bind(Sink const& sink) {
    slots.assign(packs.size(), Slots{});
    const int first = sink.first.offset / D::size;
    for (std::size_t p = 0; p < packs.size(); ++p)
      forEachPair([&]<int I, int J>() {
        for (int l = 0; l < W; ++l) {
          const int i = first + packs[p].index[I][l], j = first + packs[p].index[J][l];
          slots[p].slot[pairNumber(I, J)][l] = sink.matrix.slot(std::min(i, j), std::max(i, j));
          slots[p].set(pairNumber(I, J), l, i > j);
        }
      });
  }

  template <class Matrix>
  void addToSlots(Law const& law, Matrix& matrix, Real k, Real b) const {
    constexpr int n = D::size;
    for (std::size_t p = 0; p < packs.size(); ++p)
      forEachPair([&]<int I, int J>() {
        constexpr int pair = pairNumber(I, J);
        addScalars<n>(matrix.block(slots[p].slot[pair][0]),
                      law.block(packs[p].rest, packs[p].tangent, I, J, k, b),
                      I != J && slots[p].transposed[pair] != 0);
      });
  }

  template <class Matrix>
  [[gnu::noinline, gnu::flatten]] void blocksInParts(Law const& law, Matrix& matrix, Real k, Real b,
                                                     Part part) {
    constexpr int n = D::size;
    if (part.count > 1) part.count = parts;
    if (part.index >= part.count) return;
    if (part.late) {
      lateBlocks.addLate(part, [&](int slot, std::size_t room) {
        addTo<n * n>(matrix.block(slot), keptBlocks.data() + room * n * n);
      });
      return;
    }
    const std::size_t end = part.end(packs.size());
    auto* const values = matrix.block(0);
    for (std::size_t p = part.begin(packs.size()); p < end; ++p) {
      Pack const& pack = packs[p];
      int const* const rooms = part.count > 1 && lateBlocks.firstOf[p] >= 0
                                   ? lateBlocks.rooms.data() + lateBlocks.firstOf[p]
                                   : nullptr;
      forEachPair([&]<int I, int J>() {
        constexpr int pair = pairNumber(I, J);
        const Mat<L, n> block = law.block(pack.rest, pack.tangent, I, J, L(k), L(b));
        auto const& slot = slots[p].slot[pair];
        alignas(64) OfLanes<Real[std::size_t(n * n + 3) / 4 * 4]> ofLane;
        separate<I == J>(block, slots[p].transposed[pair], ofLane);
        auto add = [&](int l) __attribute__((always_inline)) {
          addTo<n * n>(values + std::ptrdiff_t(slot[l]) * (n * n), ofLane[l]);
        };
        if (!rooms) [[likely]] {
          for (int l = 0; l < pack.active; ++l) add(l);
          return;
        }
        for (int l = 0; l < std::min(W, pack.active); ++l)
          if (rooms[pair * W + l] >= 0)
            std::memcpy(keptBlocks.data() + std::ptrdiff_t(rooms[pair * W + l]) * n * n,
                        ofLane[l],
                        n * n * sizeof(Real));
          else
            add(l);
      });
    }
  }
};

}  // namespace sinew
