// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/workers.hpp>
#include <sinew/gpu/block_rows.hpp>
#include <sinew/gpu/multigrid_loops.hpp>
#include <sinew/gpu/multigrid_team.hpp>
#include <sinew/gpu/reduction.hpp>
#include <sinew/gpu/repeated_work.hpp>
#include <sinew/gpu/row_teams.hpp>
#include <sinew/linalg/multigrid.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace sinew::gpu {

namespace multigrid {

/// A list of the host, sent to the device.
template <class T>
void send(DeviceArray<T>& to, std::vector<T> const& from) {
  to.resize(from.size());
  copy_to_device(to.data(), from.data(), from.size());
}

/// What leads from a level to the one below: patterns, found by the processor, and values.
template <int R>
struct Down {
  using ProductTerm = typename ProductBlock<R>::Term;
  using GalerkinTerm = typename GalerkinBlock<R>::Term;
  int aggregates = 0, slots = 0, productBlocks = 0;
  DeviceArray<int> memberStart{}, members{}, aggregate{};
  DeviceArray<int> start{}, columns{}, rowOf{};                 // rows of P
  DeviceArray<int> turnedStart{}, turnedRows{}, turnedSlots{};  // columns of P
  DeviceArray<int> productFirst{}, galerkinFirst{};
  DeviceArray<ProductTerm> productTerms{};
  DeviceArray<GalerkinTerm> galerkinTerms{};
  DeviceArray<double> factor{}, product{};
  DeviceArray<float> p{};

  /// each(i, f): f(block, column) for the blocks of a row of the fine matrix, as Rows<R> numbers them.
  template <class Each>
  void init(Prolongation<R> const& from, CompressedRowSparseMatrix<double, 6> const& coarse, Each&& each) {
    const std::size_t n = from.start.size() - 1;
    aggregates = from.coarseRows();
    slots = int(from.columns.size());
    send(memberStart, from.memberStart);
    send(members, from.members);
    send(aggregate, from.aggregate);
    send(start, from.start);
    send(columns, from.columns);
    send(turnedStart, from.turnedStart);
    send(turnedRows, from.turnedRows);
    send(turnedSlots, from.turnedSlots);
    std::vector<int> rows(std::size_t(slots), 0);
    for (std::size_t i = 0; i < n; ++i)
      std::fill(rows.begin() + from.start[i], rows.begin() + from.start[i + 1], int(i));
    send(rowOf, rows);

    // the pattern of A P, and its terms block by block
    std::vector<int> first{0}, blockStart{0}, blockColumns, place(std::size_t(aggregates), -1), count;
    std::vector<ProductTerm> terms;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t begin = blockColumns.size(), termBegin = terms.size();
      count.clear();
      auto eachTerm = [&](auto&& f) {
        each(int(i), [&](int block, int j) {
          for (int s = from.start[std::size_t(j)]; s < from.start[std::size_t(j) + 1]; ++s)
            f(block, s, from.columns[std::size_t(s)]);
        });
      };
      eachTerm([&](int, int, int k) {
        if (place[std::size_t(k)] < int(begin)) {
          place[std::size_t(k)] = int(blockColumns.size());
          blockColumns.push_back(k);
          count.push_back(0);
        }
        ++count[std::size_t(place[std::size_t(k)]) - begin];
      });
      int all = int(termBegin);
      for (int& c : count) c = std::exchange(all, all + c);
      checkRange(std::size_t(all));
      terms.resize(std::size_t(all));
      for (std::size_t b = 1; b < count.size(); ++b) first.push_back(count[b]);
      if (!count.empty()) first.push_back(all);
      eachTerm([&](int block, int s, int k) {
        terms[std::size_t(count[std::size_t(place[std::size_t(k)]) - begin]++)] = {block, s};
      });
      blockStart.push_back(int(blockColumns.size()));
    }
    productBlocks = int(blockColumns.size());
    send(productFirst, first);
    send(productTerms, terms);
    terms = {};

    // the terms of P' (A P), of the blocks on and above the diagonal
    std::vector<int> galerkin{0};
    std::vector<GalerkinTerm> pairs;
    std::fill(place.begin(), place.end(), -1);
    std::vector<int> next;
    for (int k = 0; k < aggregates; ++k) {
      const int from_ = coarse.rowStart[std::size_t(k)], to = coarse.rowStart[std::size_t(k) + 1];
      next.assign(std::size_t(to - from_), 0);
      for (int s = from_; s < to; ++s) place[std::size_t(coarse.columns[std::size_t(s)])] = s - from_;
      auto eachPair = [&](auto&& f) {
        for (int t = from.turnedStart[std::size_t(k)]; t < from.turnedStart[std::size_t(k) + 1]; ++t) {
          const std::size_t i = std::size_t(from.turnedRows[std::size_t(t)]);
          for (int b = blockStart[i]; b < blockStart[i + 1]; ++b)
            if (const int l = blockColumns[std::size_t(b)]; l >= k)
              f(from.turnedSlots[std::size_t(t)], b, std::size_t(place[std::size_t(l)]));
        }
      };
      eachPair([&](int, int, std::size_t s) { ++next[s]; });
      int all = int(pairs.size());
      for (int& c : next) {
        c = std::exchange(all, all + c);
        galerkin.push_back(all);
      }
      checkRange(std::size_t(all));
      pairs.resize(std::size_t(all));
      eachPair([&](int slot, int b, std::size_t s) { pairs[std::size_t(next[s]++)] = {slot, b}; });
    }
    send(galerkinFirst, galerkin);
    send(galerkinTerms, pairs);

    factor.resize(36 * std::size_t(aggregates));
    product.resize(std::size_t(productBlocks) * R * 6);
    p.resize(std::size_t(slots) * R * 6);
  }

 private:
  static void checkRange(std::size_t terms) {
    if (terms > std::size_t(std::numeric_limits<int>::max()) / 2)
      throw Error("MultigridLinearSolver on a device",
                  "a coarse matrix has more than 2^30 terms; split the body");
  }
};

/// One level: its matrix with unit diagonal blocks, its modes, vectors of the cycle, and the way down.
template <int R>
struct Level {
  int points = 0;
  Rows<R> rows{};
  DeviceArray<double> matrix{}, unit{}, modes{};
  DeviceArray<float> product{}, x{}, r{}, d[2]{};
  DeviceArray<double> numbers{};  // the bound; entries of Lanczos
  int current = 0;                // which of d is the last direction
  Down<R> down{};

  void init(int n) {
    points = n;
    const std::size_t scalars = this->scalars();
    unit.resize(std::size_t(n) * R * R);
    modes.resize(std::size_t(n) * R * 6);
    for (auto* v : {&x, &r, &d[0], &d[1]}) {
      v->resize(scalars);
      clear_on_device(v->data(), scalars);  // what fills up rows of eight stays 0
    }
    numbers.resize(2 * FindBound::steps + 2);
  }
  std::size_t scalars() const { return std::size_t(points) * stride<R>; }
  double const* bound() const { return numbers.data(); }
  LevelView<R> view() const {
    return {points,
            rows,
            product.data(),
            x.data(),
            r.data(),
            {d[0].data(), d[1].data()},
            bound(),
            down.start.data(),
            down.columns.data(),
            down.turnedStart.data(),
            down.turnedRows.data(),
            down.turnedSlots.data(),
            down.p.data()};
  }

  void findBound() {
    double *const diagonal = numbers.data() + 1, *const squares = diagonal + FindBound::steps;
    float *const from = d[0].data(), *const to = d[1].data();
    sum_indices(scalars(), StartVector<R>{from, x.data()}, squares);
    for (int k = 0; k < FindBound::steps; ++k) {
      eachRow(Multiply<R>{rows, product.data(), from, squares + k, to});
      sum_indices(scalars(), Dot{from, to, squares + k}, diagonal + k);
      sum_indices(
          scalars(), NextDirection{from, to, x.data(), diagonal + k, squares + k, k > 0}, squares + k + 1);
    }
    for_each_index(1, FindBound{diagonal, squares, numbers.data()});
  }

  /// Steps k = from .. degree of the smoother, each with the product of the direction before; after them the
  /// residual, where it is wanted.
  void smooth(int from, int degree, bool wanted) {
    for (int k = from; k <= degree + int(wanted); ++k) {
      const bool last = k > degree;
      eachRow(Smooth<R>{rows,
                        product.data(),
                        d[current].data(),
                        d[1 - current].data(),
                        x.data(),
                        r.data(),
                        bound(),
                        k == 1 || last ? 0.f : ChebyshevSmoother::turn(k),
                        last ? 0.f : ChebyshevSmoother::gain(k),
                        last});
      if (!last) current = 1 - current;
    }
  }

  template <class Body>
  void eachRow(Body const& body) {
    if constexpr (R == 6)
      for_each_row(std::size_t(points), body);
    else
      for_each_row<1>(std::size_t(points), body);
  }
};

/// A level of aggregates.
struct CoarseLevel : Level<6> {
  DeviceArray<int> start{}, columns{}, slots{}, diagonal{}, rowOf{}, columnOf{};
  DeviceArray<double> raw{};  // before it has unit blocks
  int stored = 0, entries = 0;

  void init(CompressedRowSparseMatrix<double, 6> const& a) {
    std::vector<int> first{0}, column, code, ownRow(a.columns.size());
    for (int i = 0; i < a.rows(); ++i) {
      a.forEachInRow(i, [&](int j, int slot, bool transposed) {
        column.push_back(j);
        code.push_back(2 * slot + int(transposed));
      });
      first.push_back(int(column.size()));
      for (int k = a.rowStart[std::size_t(i)]; k < a.rowStart[std::size_t(i) + 1]; ++k)
        ownRow[std::size_t(k)] = i;
    }
    send(start, first);
    send(columns, column);
    send(slots, code);
    send(diagonal, std::vector<int>(a.rowStart.begin(), a.rowStart.end() - 1));
    send(rowOf, ownRow);
    send(columnOf, a.columns);
    stored = int(a.columns.size());
    entries = int(column.size());
    raw.resize(36 * std::size_t(stored));
    matrix.resize(36 * std::size_t(stored));
    product.resize(36 * std::size_t(entries));
    Level<6>::init(a.rows());
    rows = {start.data(), columns.data(), slots.data()};
  }
};

}  // namespace multigrid

/// z = M^-1 r by one V-cycle of smoothed aggregation, as Multigrid makes it, for the assembled matrix of a
/// body of points on the device. The processor finds aggregates and patterns, from the matrix as it is then;
/// updates fill them on the device, without allocating. Sums have an order of their own that is always the
/// same.
template <class D>
class MultigridCycle {
 public:
  using Real = typename D::Real;
  using Deriv = typename D::Deriv;
  using Coord = typename D::Coord;

  MultigridCycle() = default;
  MultigridCycle(MultigridCycle&&) = default;
  MultigridCycle& operator=(MultigridCycle&&) = default;
  // a copy of a body makes its own
  MultigridCycle(MultigridCycle const&) {}
  MultigridCycle& operator=(MultigridCycle const&) { return *this = MultigridCycle(); }

  MultigridSettings settings{};
  bool built = false;  // false: the next update finds aggregates and patterns

  int levels() const { return int(coarse_.size()) + 1; }
  /// Rows of each level, the finest first.
  std::vector<int> sizes() const {
    std::vector<int> n{fine_.points};
    for (auto const& level : coarse_) n.push_back(level.points);
    return n;
  }

  /// The values of the matrix, of which projective constraints hold the directions `held` (bits of each
  /// point; null: none), and modes of the places x.
  template <class Run>
  void update(Run const& workers, BlockRows<D> const& rows, unsigned char const* held, Coord const* x) {
    if (built && held && sum_on_host(rows.rows, HeldChanged{held, held_.data()}) != 0) built = false;
    if (!built) build(workers, rows, held, x);
    const Filled now{rows.values.data(), rows.diagonal.device(), held, x};
    if (!(now == std::exchange(filled_, now))) fillWork_.forget();
    sum_buffer();
    fillWork_.run("the set-up of multigrid on the GPU", [&] { fill(rows, held, x); });
  }

  /// z = M^-1 r, *along = r.z; *square = r.r is on the device.
  void apply(Deriv const* r, Deriv* z, double const* square, double* along) {
    const int n = fine_.points;
    for_each_index(std::size_t(n),
                   multigrid::Enter<D>{fine_.unit.data(),
                                       r,
                                       numbers_.data() + 3,
                                       square,
                                       fine_.bound(),
                                       n,
                                       ChebyshevSmoother::gain(1),
                                       fine_.r.data(),
                                       fine_.d[0].data(),
                                       fine_.x.data()});
    cycleWork_.run("a cycle on the GPU", [&] { cycle(fine_, 0); });
    sum_indices(std::size_t(n),
                multigrid::Leave<D>{fine_.unit.data(), fine_.x.data(), numbers_.data() + 3, square, n, r, z},
                along);
  }

  /// Whether solves are one kernel (team()).
  bool isWhole() const {
    return coarse_.size() <= std::size_t(MultigridTeam<D>::mostLevels) &&
           std::size_t(fine_.points) <= most_points_of_whole_multigrid();
  }
  /// The cycle as the threads of a team see it, without what iterates.
  MultigridTeam<D> team() const {
    MultigridTeam<D> t{};
    t.fine = fine_.view();
    for (std::size_t k = 0; k < coarse_.size(); ++k) t.coarse[k] = coarse_[k].view();
    t.levels = int(coarse_.size());
    t.dense = dense_.data();
    t.unknowns = unknowns_;
    t.degree = settings.degree;
    t.unit = fine_.unit.data();
    t.diagonalSize = numbers_.data() + 3;
    return t;
  }

  // what threads do
  struct HeldChanged {
    unsigned char const *now, *then;
    SINEW_HD double operator()(int i) const { return (now[i] == 7) != (then[i] == 7) ? 1 : 0; }
  };

 private:
  /// Unknowns of the largest dense factor: where a level has more, it is the next one's turn.
  static constexpr int mostUnknowns = 600;

  multigrid::Level<3> fine_{};
  std::vector<multigrid::CoarseLevel> coarse_{};
  DeviceArray<double> dense_{};
  DeviceArray<double> numbers_{};  // sums of places, and of the diagonal
  DeviceArray<unsigned char> held_{};
  int unknowns_ = 0;  // of the dense factor; 0: the last level is smoothed
  RepeatedWork cycleWork_{}, fillWork_{};
  struct Filled {  // what the recorded filling is of
    Real const* values = nullptr;
    int const* diagonal = nullptr;
    unsigned char const* held = nullptr;
    Coord const* x = nullptr;
    bool operator==(Filled const&) const = default;
  };
  Filled filled_{};

  int solvable() const { return std::min(std::max(settings.coarsestSize, 6), mostUnknowns); }

  // aggregates and patterns, by the processor's Multigrid over the same matrix
  template <class Run>
  void build(Run const& workers, BlockRows<D> const& rows, unsigned char const* held, Coord const* x) {
    cycleWork_.forget();
    fillWork_.forget();
    const std::size_t n = rows.rows;
    auto const& sliceFirst = std::as_const(rows.sliceFirst).host();
    auto const& columns = std::as_const(rows.column).host();
    std::vector<unsigned char> bits(n, 0);
    if (held) {
      copy_to_host(bits.data(), held, n);
      held_.resize(n);
      copy_on_device(held_.data(), held, n);
    }
    Multigrid host;
    host.settings = settings;
    host.settings.coarsestSize = solvable();
    bool finite = true;
    {
      std::vector<Real> values(rows.places * 9);
      copy_to_host(values.data(), rows.values.data(), values.size());
      CompressedRowSparseMatrix<double, 3> a;
      a.slicedFrom = std::size_t(-1);
      a.startPattern(int(3 * n));
      auto each = [&](std::size_t i, auto&& f) { eachBlock(sliceFirst, columns, int(i), f); };
      for (std::size_t i = 0; i < n; ++i) {
        a.pattern[i].clear();
        each(i, [&](int, int j) { a.pattern[i].push_back(j); });
      }
      a.finishPattern();
      for (std::size_t i = 0; i < n; ++i) {
        int slot = a.rowStart[i];
        each(i, [&](int k, int j) {
          if (j < int(i)) return;
          double* const to = a.block(slot++);
          for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c) {
              const bool no = (bits[i] >> r & 1) || (bits[std::size_t(j)] >> c & 1);
              to[3 * r + c] = no ? double(int(i) == j && r == c)
                                 : double(values[std::size_t(multigrid::Rows<3>::at(k, 3 * r + c))]);
              finite = finite && std::isfinite(to[3 * r + c]);
            }
        });
      }
      host.init(a, workers);
      placeModes(x, host.modes);
      host.update(workers, a);
    }
    fine_.init(int(n));
    fine_.rows = {rows.sliceFirst.device(), rows.column.device()};
    fine_.matrix.resize(rows.places * 9);
    fine_.product.resize(rows.places * 9);
    coarse_.clear();
    coarse_.resize(host.coarse.size());
    for (std::size_t k = 0; k < coarse_.size(); ++k) coarse_[k].init(host.coarse[k].matrix);
    if (!coarse_.empty()) {
      fine_.down.init(host.fine.down, host.coarse[0].matrix, [&](int i, auto&& f) {
        eachBlock(sliceFirst, columns, i, f);
      });
      for (std::size_t k = 0; k + 1 < coarse_.size(); ++k) {
        auto const& level = host.coarse[k];
        coarse_[k].down.init(level.down, host.coarse[k + 1].matrix, [&](int i, auto&& f) {
          for (int n = level.product.start[std::size_t(i)]; n < level.product.start[std::size_t(i) + 1]; ++n)
            f(n, level.product.columns[std::size_t(n)]);
        });
      }
    }
    const int last = coarse_.empty() ? 3 * int(n) : 6 * coarse_.back().points;
    unknowns_ = last <= solvable() ? last : 0;
    dense_.resize(std::size_t(unknowns_) * std::size_t(unknowns_ + 2));
    numbers_.resize(4);
    built = finite;  // else the processor has found nothing
  }
  // the blocks of a row, without those that fill it up, which come last and are on the diagonal
  template <class F>
  static void eachBlock(std::vector<int> const& sliceFirst, std::vector<int> const& columns, int i, F&& f) {
    const std::size_t s = std::size_t(i / 32);
    for (int k = sliceFirst[s] + i % 32, last = -1; k < sliceFirst[s + 1]; k += 32) {
      const int j = columns[std::size_t(k)];
      if (j <= last) break;
      f(k, j);
      last = j;
    }
  }
  void placeModes(Coord const* x, std::vector<Multigrid::Row>& modes) const {
    const std::size_t n = modes.size() / 3;
    std::vector<Coord> places(n);
    copy_to_host(places.data(), x, n);
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (auto const& p : places) middle += p.template cast<double>();
    middle /= double(n);
    for (std::size_t i = 0; i < n; ++i) {
      const Eigen::Vector3d p = places[i].template cast<double>() - middle;
      Multigrid::Row* const m = &modes[3 * i];
      m[0][0] = m[1][1] = m[2][2] = 1;
      m[0][4] = p[2], m[0][5] = -p[1];
      m[1][3] = -p[2], m[1][5] = p[0];
      m[2][3] = p[1], m[2][4] = -p[0];
    }
  }

  void fill(BlockRows<D> const& rows, unsigned char const* held, Coord const* x) {
    using namespace multigrid;
    const std::size_t n = rows.rows;
    Real const* const values = rows.values.data();
    int const* const diagonal = rows.diagonal.device();
    for (int c = 0; c < 3; ++c) sum_indices(n, PlaceOf<D>{x, c}, numbers_.data() + c);
    sum_indices(n, DiagonalSize<D>{values, diagonal}, numbers_.data() + 3);
    for_each_index(n,
                   UnitPoint<D>{fine_.rows,
                                values,
                                diagonal,
                                held,
                                x,
                                numbers_.data(),
                                int(n),
                                fine_.unit.data(),
                                fine_.modes.data()});
    for_each_index(n,
                   ScalePoint<D>{fine_.rows,
                                 values,
                                 diagonal,
                                 held,
                                 fine_.unit.data(),
                                 fine_.matrix.data(),
                                 fine_.product.data(),
                                 fine_.modes.data()});
    fine_.findBound();
    if (!coarse_.empty()) fillBelow(fine_, coarse_[0]);
    for (std::size_t k = 0; k + 1 < coarse_.size(); ++k) fillBelow(coarse_[k], coarse_[k + 1]);
    if (unknowns_ > 0) {
      if (coarse_.empty())
        factorise(fine_);
      else
        factorise(coarse_.back());
    }
  }
  template <int R>
  static void fillBelow(multigrid::Level<R>& level, multigrid::CoarseLevel& below) {
    using namespace multigrid;
    Down<R>& down = level.down;
    const auto aggregates = std::size_t(down.aggregates), blocks = std::size_t(down.slots) * R;
    for (const bool first : {true, false}) {
      for_each_row(aggregates,
                   Gram<R>{down.memberStart.data(),
                           down.members.data(),
                           level.modes.data(),
                           down.factor.data(),
                           below.modes.data(),
                           first});
      for_each_index(std::size_t(level.points) * R,
                     Orthogonal<R>{down.aggregate.data(), down.factor.data(), level.modes.data()});
    }
    for_each_index(blocks,
                   SmoothBlock<R>{level.rows,
                                  level.matrix.data(),
                                  down.aggregate.data(),
                                  down.rowOf.data(),
                                  down.columns.data(),
                                  level.modes.data(),
                                  level.bound(),
                                  down.p.data()});
    for_each_index(std::size_t(down.productBlocks) * R,
                   ProductBlock<R>{level.rows,
                                   level.matrix.data(),
                                   down.productFirst.data(),
                                   down.productTerms.data(),
                                   down.p.data(),
                                   down.product.data()});
    for_each_row(std::size_t(below.stored) * 6,
                 GalerkinBlock<R>{down.galerkinFirst.data(),
                                  down.galerkinTerms.data(),
                                  down.p.data(),
                                  down.product.data(),
                                  below.raw.data()});
    for_each_index(
        aggregates,
        UnitAggregate{below.diagonal.data(), below.raw.data(), below.unit.data(), below.modes.data()});
    for_each_index(std::size_t(below.stored) * 6,
                   ScaleBlock{below.rowOf.data(),
                              below.columnOf.data(),
                              below.raw.data(),
                              below.unit.data(),
                              below.matrix.data()});
    for_each_index(std::size_t(below.entries) * 6,
                   FloatRow{below.rows, below.matrix.data(), below.product.data()});
    for_each_index(blocks, ScaleProlongation{R, down.columns.data(), below.unit.data(), down.p.data()});
    below.findBound();
  }
  template <int R>
  void factorise(multigrid::Level<R>& level) {
    double* const row = dense_.data() + std::ptrdiff_t(unknowns_) * unknowns_;
    for_each_index(std::size_t(unknowns_),
                   multigrid::DenseRow<R>{level.rows, level.matrix.data(), unknowns_, dense_.data()});
    multigrid::invert(dense_.data(), unknowns_, row);
  }

  // x from r of a level, whose first step has been made
  template <int R>
  void cycle(multigrid::Level<R>& level, std::size_t index) {
    using namespace multigrid;
    level.current = 0;
    if (index == coarse_.size()) {
      if (unknowns_ > 0)
        for_each_row<32>(std::size_t(unknowns_),
                         Solve<R>{dense_.data(), unknowns_, level.r.data(), level.x.data()});
      else
        level.smooth(2, 2 * settings.degree, false);
      return;
    }
    Down<R>& down = level.down;
    CoarseLevel& below = coarse_[index];
    level.smooth(2, settings.degree, true);
    for_each_row(std::size_t(below.points),
                 Restrict<R>{down.turnedStart.data(),
                             down.turnedRows.data(),
                             down.turnedSlots.data(),
                             down.p.data(),
                             level.r.data(),
                             below.bound(),
                             ChebyshevSmoother::gain(1),
                             below.r.data(),
                             below.d[0].data(),
                             below.x.data()});
    cycle(below, index + 1);
    for_each_index(std::size_t(level.points) * R,
                   Prolong<R>{down.start.data(),
                              down.columns.data(),
                              down.p.data(),
                              below.x.data(),
                              level.d[level.current].data(),
                              level.x.data()});
    level.smooth(1, settings.degree, false);
  }
};

}  // namespace sinew::gpu
