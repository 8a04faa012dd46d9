// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/element_kernels.hpp>
#include <sinew/gpu/fused/body.hpp>
#include <sinew/gpu/fused/problem_team.hpp>

#include <cstddef>
#include <tuple>
#include <type_traits>

namespace sinew::gpu {

/// to += the block, or its transpose; six components are xx xy xz yy yz zz of a symmetric one.
template <int Components, class Real, class Block>
SINEW_INLINE void add(Real (&to)[Components], Block const& block, bool transposed) {
  if constexpr (Components == 6) {
    int k = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) to[k++] += block(i, j);
  } else {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) to[3 * i + j] += transposed ? block(j, i) : block(i, j);
  }
}

/// The matrix S = A / h^2 of a step and what the free motion has left of its equation, as a ConvexProblem
/// asks for them.
template <class Step>
struct FusedSystem {
  static constexpr bool alone = true;
  static constexpr std::size_t entryBytes = 0;
  Step* step;
  int all;
  double const* rest;  // three numbers a row

  SINEW_INLINE Eigen::Vector3d restOf(int i) const { return vector_at(rest, i); }
  template <class Team>
  struct Rows {
    Step* step;
    SINEW_INLINE Rows(Team&, FusedSystem const& system) : step(system.step) {}
    template <class P>
    SINEW_INLINE void add(int i, int lane, P&& p, double (&sum)[3]) const {
      step->addProduct(i, lane, p, sum);
    }
    SINEW_INLINE void hold(int i, double (&v)[3]) const { step->hold(i, v); }
    SINEW_INLINE Eigen::Matrix3d diagonal(int i) const { return step->diagonal(i); }
  };
};

/// Steps of one copy of a body by one team:
///   A dv = b,  A = (1 + h rM) M - h B - h (h + rK) K,  b = h (f - rM M v + (h + rK) K v)
/// as EulerImplicitSolver has them, solved by pipelined conjugate gradients (Ghysels, Vanroose 2014): the
/// sums of an iteration and the values of other blocks for its product are exchanged together, so that blocks
/// wait for each other once an iteration. All functions are inlined, so that rows stay in registers. Where
/// the body touches, dv is that of the free motion, and contacts add to it (ConvexProblem).
template <class Team, class Body>
class FusedStep {
  using Real = typename Body::Real;
  using Coord = typename Body::Coord;
  using Deriv = typename Body::Deriv;
  static constexpr int components = Body::components, lanes = Team::lanes, kept = Team::keptEntries;

  // what a thread has of a row; all but the blocks that it keeps is for the first of a row's threads
  struct Own {
    Real block[kept > 0 ? kept : 1][components];
    int place[kept > 0 ? kept : 1];
    Real p[3], s[3], z[3], w[3], n[3], dv[3], r[3];
    Real mass;
    int held, node;
    int used;              // of the blocks kept
    int from, to;          // entries in shared memory
    int sendFrom, sendTo;  // who else has the row in its border; the first of them:
    unsigned send[2];
  };

  Team const& team;
  Body const& body;
  const int copy = team.copy;

  // shared memory; a row's entries that its threads do not keep in registers are in `values`
  double* const buffer;
  Real* const values =
      reinterpret_cast<Real*>(buffer + Body::bufferSize);  // component c of entry e at c size + e
  const int size = body.entriesOfWidest;
  Real* const vectors = values + std::ptrdiff_t(size) * components;  // two of the rows and their border
  typename Team::Column* const column = reinterpret_cast<typename Team::Column*>(
      vectors + (Team::global ? 0 : 2 * 3 * std::ptrdiff_t(body.longestVector)));

  const int begin = body.rowBegin[team.rank], rows = rowsOf(team, body);
  const std::ptrdiff_t nodes = body.rows;
  Coord* const x = body.x + copy * nodes;
  Deriv* const v = body.v + copy * nodes;
  const Deriv gravity = body.gravity[copy];
  const Real h = body.h, kFactor = -h * (h + body.rayleighStiffness), bFactor = -h;

  typename Team::template Rows<Own>& own;  // not a member: as a part of this it is not kept in registers
  int parity = 0;                  // which of the two vectors: nobody writes what another may still read
  double const* motion = nullptr;  // what contacts add to positions, three numbers a row; null for nothing

 public:
  using Rows = typename Team::template Rows<Own>;
  static SINEW_INLINE int rowsOf(Team const& team, Body const& body) {
    return body.rowBegin[team.rank + 1] - body.rowBegin[team.rank];
  }
  SINEW_INLINE FusedStep(Team const& team_, Body const& body_, unsigned char* shared, Rows& own_)
      : team(team_), body(body_), buffer(reinterpret_cast<double*>(shared)), own(own_) {}

  /// What stays the same in all steps: the rows of this block, where their entries are, who is sent them.
  SINEW_INLINE void takeRows() {
    auto const* const columns = columnsOfTeam();
    forRows([&](int row, int lane, Own& o) {
      o.node = body.order[begin + row];
      o.mass = body.mass[copy * nodes + o.node];
      o.held = body.held[o.node];
      const int first = body.entryFirst[begin + row], length = body.entryFirst[begin + row + 1] - first;
      for (int k = 0; k < kept; ++k)
        if (lane + k * lanes < length) {
          o.place[k] = columns[first + lane + k * lanes];
          o.used = k + 1;
        }
      o.from = body.sharedFirst[begin + row] + lane;
      o.to = o.from - lane + (length > kept * lanes ? length - kept * lanes : 0);
      for (int e = o.from, g = first + lane + kept * lanes; e < o.to; e += lanes, g += lanes)
        column[e] = columns[g];
      o.sendFrom = body.sendFirst[begin + row];
      o.sendTo = body.sendFirst[begin + row + 1];
      for (int k = 0; k < 2; ++k) o.send[k] = o.sendFrom + k < o.sendTo ? body.sends[o.sendFrom + k] : 0;
    });
  }

  /// The forces on the points of elements, and the tangents that blocks of the matrix are made of; those of
  /// one or two points are left to their rows.
  SINEW_INLINE void findForces() {
    std::apply([&](auto const&... field) { (findForces(field), ...); }, body.fields);
    if constexpr (!Body::byRows) team.sync();
  }

  /// The rows of A, and b, which is the residual that conjugate gradients begin with; w = A r.
  SINEW_INLINE void assemble() {
    forRows([&](int row, int lane, Own& o) {
      Real f[3] = {}, diagonal[components] = {};
      std::apply([&](auto const&... field) { (sumParts(field, o, lane, f), ...); }, body.fields);
      assembleRow(row, lane, o, f, diagonal);
      for (int c = 0; c < 3; ++c) f[c] = team.rowSum(f[c]);
      for (int c = 0; c < components; ++c) diagonal[c] = team.rowSum(diagonal[c]);
      if (lane != 0) return;
      addMass(o, diagonal);
      startFrom(begin + row, o, f);
      publish(row, o, o.r);
    });
    team.sync();
    forRows([&](int, int, Own& o) { multiply(o, o.w); });
  }

  /// dv by conjugate gradients.
  SINEW_INLINE void solve() {
    double start = 0, byRho = 0, byAlpha = 0;
    for (int iteration = 0; iteration < body.iterations; ++iteration) {
      parity = 1 - parity;
      Real local[2] = {0, 0};
      forRows([&](int row, int lane, Own& o) {
        if (lane == 0) publish(row, o, o.w);
      });
      team.announce();
      forRows([&](int, int lane, Own& o) {
        if (lane != 0) return;
        for (int c = 0; c < 3; ++c) {
          local[0] += o.r[c] * o.r[c];
          local[1] += o.r[c] * o.w[c];
        }
      });
      team.give(local, buffer);
      team.awaitRows();
      team.fetchSums(buffer);
      forRows([&](int, int, Own& o) { multiply(o, o.n); });
      double total[2];
      team.takeSums(buffer, total);
      const double next = total[0], beta = next * byRho, curvature = total[1] - beta * next * byAlpha;
      if (iteration == 0) start = next;
      if (!(next > body.tolerance2 * start) || !(curvature > body.threshold || curvature < -body.threshold))
        break;
      const Real far = Real(next / curvature), keep = Real(beta);
      byRho = 1 / next;
      byAlpha = curvature * byRho;
      forRows([&](int, int lane, Own& o) {
        if (lane != 0) return;
        for (int c = 0; c < 3; ++c) {
          o.z[c] = iteration == 0 ? o.n[c] : o.n[c] + keep * o.z[c];
          o.s[c] = iteration == 0 ? o.w[c] : o.w[c] + keep * o.s[c];
          o.p[c] = iteration == 0 ? o.r[c] : o.r[c] + keep * o.p[c];
          o.dv[c] += far * o.p[c];
          o.r[c] -= far * o.s[c];
          o.w[c] -= far * o.z[c];
        }
      });
    }
    parity = 1 - parity;
  }

  /// Contacts: found where points are, then the convex problems of the step, whose motion comes to the free
  /// one.
  SINEW_INLINE void touch(int step) {
    auto const& contacts = body.contacts;
    typename Body::Contacts::Given given;
    double* const rest = contacts.restOf(copy);
    auto problem = contacts.problem(FusedSystem<FusedStep>{this, body.rows, rest}, copy, given);
    double* const free = problem.gradient;  // for now, dv of the free motion
    double count[1] = {0};
    forRows([&](int row, int lane, Own& o) {
      if (lane != 0) return;
      bool tooMany = false;
      count[0] += contacts.find(copy, begin + row, o.node, o.held, x, tooMany);
      if (tooMany && contacts.crowded[copy] == 0) contacts.crowded[copy] = step;
      const Coord end = x[o.node] + h * (v[o.node] + Deriv(o.dv[0], o.dv[1], o.dv[2]));
      for (int k = 0; k < contacts.room; ++k)
        contacts.describe(problem, given, copy, begin + row, k, o.held, x[o.node], end, v[o.node], double(h));
      for (int c = 0; c < 3; ++c) free[3 * (begin + row) + c] = double(o.dv[c]);
    });
    ProblemTeam<Team> all(team, begin, begin + rows, body.rows, buffer + sum_buffer_size);
    all.template reduce<1>(count);
    motion = count[0] > 0 ? problem.velocity : nullptr;
    if (!motion) return;
    // (b - A dv) / h, which iterations know but for rounding
    forRows([&](int row, int lane, Own& o) {
      double product[3] = {0, 0, 0};
      addProduct(
          begin + row, lane, [&](int i) { return vector_at(free, i); }, product);
      all.sumOfRow(product);
      double* const left = rest + 3 * (begin + row);
      for (int c = 0; c < 3 && lane == 0; ++c)
        left[c] = o.held >> c & 1 ? 0 : left[c] / double(h) - double(h) * product[c];
    });
    const ConvexProgress end = problem.solve(all);
    forRows([&](int row, int lane, Own&) {
      for (int k = lane; k < problem.entries.counts[begin + row]; k += lanes)
        contacts.takeForce(problem, copy, begin + row, k);
    });
    if (!all.first()) return;
    if (end.ends == ConvexProgress::Ends::unbounded && body.wrong[copy] == 0) body.wrong[copy] = step;
    if (!end.found.converged) contacts.unsolved[copy] += 1;
  }

  /// v += dv, x += h v, and what contacts add
  SINEW_INLINE void move(int step) {
    forRows([&](int row, int lane, Own& o) {
      if (lane != 0) return;
      bool finite = true;
      for (int c = 0; c < 3; ++c) {
        const Real speed = v[o.node][c] + o.dv[c];
        Real place = x[o.node][c] + h * speed, left = body.keptSpeed * speed;
        if (Body::touches && motion) {
          const double more = motion[3 * (begin + row) + c];
          place += Real(more);
          left += Real(more / double(h));
        }
        v[o.node][c] = left;
        x[o.node][c] = place;
        finite = finite && place - place == Real(0);
      }
      if (!finite && body.wrong[copy] == 0) body.wrong[copy] = step;
    });
    team.sync();
  }

  // for FusedSystem, of rows that are numbered over all blocks

  /// Adds the part of a lane of S p in a row.
  template <class P>
  SINEW_INLINE void addProduct(int row, int lane, P&& p, double (&sum)[3]) {
    Own const& o = own[row - begin];
    const int first = body.entryFirst[row] + lane;
    double product[3] = {0, 0, 0}, from[kept > 0 ? kept : 1][3] = {};
    auto load = [&](int k, double(&to)[3]) {
      const Eigen::Vector3d one = p(body.columnRow[first + k * lanes]);
      for (int c = 0; c < 3; ++c) to[c] = one[c];
    };
    for (int k = 0; k < kept; ++k)
      if (k < o.used) load(k, from[k]);
    for (int k = 0; k < kept; ++k) addEntry([&](int c) { return double(o.block[k][c]); }, from[k], product);
    for (int e = o.from, k = kept; e < o.to; e += lanes, ++k) {
      double one[3];
      load(k, one);
      addEntry([&](int c) { return double(values[c * size + e]); }, one, product);
    }
    for (int c = 0; c < 3; ++c) sum[c] += scale() * product[c];
  }
  SINEW_INLINE void hold(int row, double (&value)[3]) {
    for (int c = 0; c < 3; ++c)
      if (own[row - begin].held >> c & 1) value[c] = 0;
  }
  /// The diagonal block, with 1 in the place of what is held; in the first thread of a row.
  SINEW_INLINE Eigen::Matrix3d diagonal(int row) {
    Own const& o = own[row - begin];
    Eigen::Matrix3d d;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        const int a = r < c ? r : c, b = r < c ? c : r;
        const int k = components == 6 ? a * (5 - a) / 2 + b : 3 * r + c;
        const bool fixed = (o.held >> r & 1) || (o.held >> c & 1);
        d(r, c) = fixed ? (r == c ? 1. : 0.)
                        : scale() * double(kept > 0 ? o.block[0][k] : values[k * size + o.from]);
      }
    return d;
  }

 private:
  SINEW_INLINE double scale() const { return 1 / (double(h) * double(h)); }
  /// f(row, lane, what this thread has of it) for the rows in which this thread has a part.
  template <class F>
  SINEW_INLINE void forRows(F&& f) {
    for (int t = team.thread; t < rows * lanes; t += team.threads) f(t / lanes, t % lanes, own[t / lanes]);
  }
  SINEW_INLINE auto const* columnsOfTeam() const {
    if constexpr (Team::global)
      return body.columnRow;
    else
      return body.column;
  }
  SINEW_INLINE Real* vector() const {
    if constexpr (Team::global)
      return body.vectors + parity * Team::stride * nodes;
    else
      return vectors + parity * 3 * body.longestVector;
  }

  // the values of a row go to all that have it
  SINEW_INLINE void publish(int row, Own const& o, Real const (&value)[3]) const {
    Real* const to = vector();
    const int mine = Team::global ? begin + row : row;
    for (int c = 0; c < 3; ++c) to[Team::stride * mine + c] = value[c];
    if constexpr (!Team::global) {
      auto send = [&](unsigned code) {
        const int place = int(code & 0xffff);
        for (int c = 0; c < 3; ++c) team.of(int(code >> 16), to[3 * place + c]) = value[c];
      };
      if (o.sendFrom < o.sendTo) send(o.send[0]);
      if (o.sendFrom + 1 < o.sendTo) send(o.send[1]);
      for (int k = o.sendFrom + 2; k < o.sendTo; ++k) send(body.sends[k]);
    }
  }

  // product += the entry a(component) times x
  template <class Entry, class T>
  static SINEW_INLINE void addEntry(Entry const& a, T const (&x)[3], T (&product)[3]) {
    if constexpr (components == 6) {
      const T xy = a(1), xz = a(2), yz = a(4);
      product[0] += a(0) * x[0] + xy * x[1] + xz * x[2];
      product[1] += xy * x[0] + a(3) * x[1] + yz * x[2];
      product[2] += xz * x[0] + yz * x[1] + a(5) * x[2];
    } else {
      for (int i = 0; i < 3; ++i) product[i] += a(3 * i) * x[0] + a(3 * i + 1) * x[1] + a(3 * i + 2) * x[2];
    }
  }

  // product = A times the vector that was published last; for the first of a row's threads
  SINEW_INLINE void multiply(Own const& o, Real (&product)[3]) const {
    Real const* const vec = vector();
    for (int c = 0; c < 3; ++c) product[c] = 0;
    // all that a thread keeps are loaded before the first is used
    Real entries[kept > 0 ? kept : 1][3] = {};
    for (int k = 0; k < kept; ++k)
      if (k < o.used) team.load(vec + Team::stride * o.place[k], entries[k]);
    for (int k = 0; k < kept; ++k) addEntry([&](int c) { return o.block[k][c]; }, entries[k], product);
    for (int e = o.from; e < o.to; e += lanes) {
      Real y[3];
      team.load(vec + Team::stride * column[e], y);
      addEntry([&](int c) { return values[c * size + e]; }, y, product);
    }
    for (int c = 0; c < 3; ++c) {
      product[c] = team.rowSum(product[c]);
      if (o.held >> c & 1) product[c] = 0;
    }
  }

  // force = f + (h + rK) K v of an element
  template <class Field, class Tangent, class Force>
  SINEW_INLINE void forceOf(Field const& field, int e, Tangent& tangent, Force& force) const {
    constexpr int arity = Field::arity;
    auto const& rest = field.rest[std::ptrdiff_t(copy) * field.count + e];
    Coord xs[arity];
    Deriv vs[arity], dfs[arity];
    for (int k = 0; k < arity; ++k) {
      const int node = field.index[k * field.count + e];
      xs[k] = x[node];
      vs[k] = v[node];
    }
    field.law.force(rest, xs, vs, force, tangent);
    field.law.dforce(rest, tangent, vs, dfs, h + body.rayleighStiffness, Real(0));
    for (int k = 0; k < arity; ++k) force[k] += dfs[k];
  }
  template <class Field>
  SINEW_INLINE void findForces(Field const& field) const {
    if constexpr (!Field::byRows) {
      auto* const tangents = field.tangent + std::ptrdiff_t(copy) * field.count;
      auto* const part = field.part + std::ptrdiff_t(copy) * field.count * Field::arity;
      for (int e = team.rank * team.threads + team.thread; e < field.count; e += team.ranks * team.threads) {
        Deriv force[Field::arity];
        typename Field::Law::Tangent tangent;
        forceOf(field, e, tangent, force);
        tangents[e] = tangent;
        for (int k = 0; k < Field::arity; ++k) part[k * field.count + e] = force[k];
      }
    }
  }

  // f += the forces of elements on a node
  template <class Field>
  SINEW_INLINE void sumParts(Field const& field, Own const& o, int lane, Real (&f)[3]) const {
    if (Field::byRows || o.node >= field.nodes) return;
    auto const* const part = field.part + std::ptrdiff_t(copy) * field.count * Field::arity;
    for (int i = field.partFirst[o.node] + lane; i < field.partFirst[o.node + 1]; i += lanes) {
      auto const& one = part[field.partEntry[i]];
      for (int c = 0; c < 3; ++c) f[c] += one[c];
    }
  }

  // the entries of a row, without the mass: each thread has some, and adds to the diagonal what it gets from
  // them
  SINEW_INLINE void assembleRow(int row, int lane, Own& o, Real (&f)[3], Real (&diagonal)[components]) {
    const int first = body.entryFirst[begin + row], end = body.entryFirst[begin + row + 1];
    auto entry = [&](int e, Real(&block)[components]) {
      for (int c = 0; c < components; ++c) block[c] = 0;
      if (e >= end) return;
      std::apply([&](auto const&... field) { (sumBlocks(field, e, block, f), ...); }, body.fields);
      const Real sign = e == first ? Real(1) : Real(-1);
      for (int c = 0; c < components; ++c) diagonal[c] += sign * block[c];
    };
#if defined(__CUDA_ARCH__)
#pragma unroll
#endif
    for (int k = 0; k < kept; ++k) entry(first + lane + k * lanes, o.block[k]);
    for (int e = o.from, g = first + lane + kept * lanes; e < o.to; e += lanes, g += lanes) {
      Real block[components];
      entry(g, block);
      for (int c = 0; c < components; ++c) values[c * size + e] = block[c];
    }
  }
  // block += those of elements for the entry e of the matrix; of elements that rows compute, f += the force
  template <class Field>
  SINEW_INLINE void sumBlocks(Field const& field, int e, Real (&block)[components], Real (&f)[3]) const {
    auto const* const rest = field.rest + std::ptrdiff_t(copy) * field.count;
    const int to = field.entryFirst[e + 1];
    int i = field.entryFirst[e], next = i < to ? field.entryCode[i] : 0;
    while (i < to) {
      const detail::BlockOfElement<Field::arity> of{unsigned(next)};
      next = ++i < to ? field.entryCode[i] : 0;  // on its way while this one is computed
      auto addBlock = [&](auto const& tangent) {
        add<components>(
            block, field.law.block(rest[of.element], tangent, of.a, of.b, kFactor, bFactor), of.transposed);
      };
      if constexpr (Field::byRows) {
        Deriv force[Field::arity];
        typename Field::Law::Tangent tangent;
        forceOf(field, of.element, tangent, force);
        for (int c = 0; c < 3; ++c) f[c] += of.transposed ? force[Field::arity - 1][c] : force[0][c];
        addBlock(tangent);
      } else {
        addBlock(field.tangent[std::ptrdiff_t(copy) * field.count + of.element]);
      }
    }
  }

  // the diagonal block is complete with (1 + h rM) m
  SINEW_INLINE void addMass(Own& o, Real (&diagonal)[components]) {
    const Real m = (1 + h * body.rayleighMass) * o.mass;
    for (int c = 0; c < 3; ++c) diagonal[components == 6 ? c * (7 - c) / 2 : 4 * c] += m;
    for (int c = 0; c < components; ++c) (kept > 0 ? o.block[0][c] : values[c * size + o.from]) = diagonal[c];
  }
  // r = b where the components are free, dv = 0
  SINEW_INLINE void startFrom([[maybe_unused]] int row, Own& o, Real const (&f)[3]) const {
    for (int c = 0; c < 3; ++c) {
      const Real b = h * (f[c] + o.mass * (gravity[c] - body.rayleighMass * v[o.node][c]));
      o.r[c] = o.held >> c & 1 ? Real(0) : b;
      o.dv[c] = 0;
      if constexpr (Body::touches) body.contacts.restOf(copy)[3 * row + c] = double(b);
    }
  }
};

template <class Team, class Body>
SINEW_HD void fused_steps(Team const& team, Body const& body, unsigned char* shared) {
  using Steps = FusedStep<Team, Body>;
  typename Steps::Rows own(Steps::rowsOf(team, body));
  Steps all(team, body, shared, own);
  all.takeRows();
  for (int step = 1; step <= body.steps; ++step) {
    all.findForces();
    all.assemble();
    all.solve();
    if constexpr (Body::touches) all.touch(step);
    all.move(step);
  }
}

}  // namespace sinew::gpu
