// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>
#include <sinew/gpu/element_kernels.hpp>
#include <sinew/gpu/fused/team.hpp>

#include <cstdint>
#include <tuple>
#include <utility>

namespace sinew::gpu {

/// The elements of one force field in a fused step. Elements of one point add to diagonal blocks. For those
/// of more points the diagonal follows from the others, since moving an element as a whole costs nothing:
/// block(i, i) = - sum_j block(i, j). Of elements of one or two points each row finds the force and the
/// tangent by itself, twice where there are two; of others they are found once, and blocks wait for them.
template <template <class> class LawOf, class D>
struct FusedElements {
  using Law = LawOf<D>;
  static constexpr int arity = Law::arity;
  static constexpr bool symmetricBlocks = requires { requires Law::symmetricBlocks; };
  static constexpr bool byRows = arity <= 2;

  Law law;
  int count;
  int const* index;                // point k of element e at k count + e
  typename Law::Rest const* rest;  // of all copies, one after the other
  typename Law::Tangent* tangent;
  typename D::Deriv* part;  // force on point k of element e at k count + e
  int nodes;                // that elements have, and the parts for each
  int const *partFirst, *partEntry;
  int const *entryFirst, *entryCode;  // for each entry of the matrix (BlockOfElement)
};

/// A body of points on the device that implicit Euler moves, with a matrix in the shared memory of a cluster.
template <class D, class... Elements>
struct FusedBody {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  static constexpr bool symmetric = (Elements::symmetricBlocks && ...);
  static constexpr bool byRows = (Elements::byRows && ...);
  /// Entries of a row that a thread keeps in registers, at most: it multiplies as many also where there are
  /// fewer. Of a mesh of tetrahedra a row has about 15, for four or eight threads.
  static constexpr int keptEntries = 5;
  static constexpr int components = symmetric ? 6 : 9;

  std::tuple<Elements...> fields;
  // the plan
  int rows, widest, entriesOfWidest, longestVector;  // entriesOfWidest: in shared memory
  int const *order, *rowBegin, *entryFirst, *sharedFirst, *sendFirst;
  unsigned const* sends;
  std::uint16_t const* column;  // place in the vectors of a rank
  int const* columnRow;         // row
  // of all copies, one after the other
  Coord* x;
  Deriv* v;
  Real const* mass;
  int const* held;  // bit c: component c of the node is held
  Deriv const* gravity;
  Real* vectors;  // two of all rows, for teams that exchange them in the memory of the GPU
  int* wrong;     // step at which a position was no longer finite, from 1; 0 when all are

  Real h, rayleighStiffness, rayleighMass, keptSpeed;  // keptSpeed = exp(-h vdamping)
  int iterations, steps;
  double tolerance2, threshold;

  /// Bytes of shared memory that a block needs.
  template <class Team>
  std::size_t shared() const {
    const std::size_t vector = Team::global ? 0 : 2 * 3 * std::size_t(longestVector);
    return (std::size_t(entriesOfWidest) * components + vector) * sizeof(Real) +
           std::size_t(entriesOfWidest) * sizeof(typename Team::Column) + room_for_sums * sizeof(double) + 64;
  }
};

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

/// Steps of one copy of a body by one team:
///   A dv = b,  A = (1 + h rM) M - h B - h (h + rK) K,  b = h (f - rM M v + (h + rK) K v)
/// as EulerImplicitSolver has them, solved by pipelined conjugate gradients (Ghysels, Vanroose 2014): the
/// sums of an iteration and the values of other blocks for its product are exchanged together, so that blocks
/// wait for each other once an iteration.
template <class Team, class Body>
SINEW_HD void fused_steps(Team const& team, Body const& body, unsigned char* shared) {
  const int copy = team.copy;
  using Real = typename Body::Real;
  using Deriv = typename Body::Deriv;
  constexpr int components = Body::components, lanes = Team::lanes, kept = Team::keptEntries;
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

  // shared memory; a row's entries that its threads do not keep in registers are in `values`
  double* const room = reinterpret_cast<double*>(shared);
  Real* const values = reinterpret_cast<Real*>(room + room_for_sums);  // component c of entry e at c size + e
  const int size = body.entriesOfWidest;
  Real* const vectors = values + std::ptrdiff_t(size) * components;  // two of the rows and their border
  auto* const column = reinterpret_cast<typename Team::Column*>(
      vectors + (Team::global ? 0 : 2 * 3 * std::ptrdiff_t(body.longestVector)));

  const int begin = body.rowBegin[team.rank], rows = body.rowBegin[team.rank + 1] - begin;
  const std::ptrdiff_t nodes = body.rows;
  auto* const x = body.x + copy * nodes;
  Deriv* const v = body.v + copy * nodes;
  const Deriv gravity = body.gravity[copy];
  const Real h = body.h, kFactor = -h * (h + body.rayleighStiffness), bFactor = -h;

  auto const* const columns = [&] {
    if constexpr (Team::global)
      return body.columnRow;
    else
      return body.column;
  }();
  typename Team::template Rows<Own> own(rows);
  auto forRows = [&](auto&& f) {
    for (int t = team.thread; t < rows * lanes; t += team.threads) f(t / lanes, t % lanes, own[t / lanes]);
  };
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
  // two vectors are used in turn: nobody writes what another may still read
  int turn = 0;
  auto vector = [&] {
    if constexpr (Team::global)
      return body.vectors + turn * Team::stride * nodes;
    else
      return vectors + turn * 3 * body.longestVector;
  };
  // the values of a row go to all that have it
  auto publish = [&](int row, Own const& o, Real const(&value)[3]) {
    Real* const to = vector();
    const int own = Team::global ? begin + row : row;
    for (int c = 0; c < 3; ++c) to[Team::stride * own + c] = value[c];
    if constexpr (!Team::global) {
      auto send = [&](unsigned code) {
        const int place = int(code & 0xffff);
        for (int c = 0; c < 3; ++c) team.of(int(code >> 16), to[3 * place + c]) = value[c];
      };
      if (o.sendFrom < o.sendTo) send(o.send[0]);
      if (o.sendFrom + 1 < o.sendTo) send(o.send[1]);
      for (int k = o.sendFrom + 2; k < o.sendTo; ++k) send(body.sends[k]);
    }
  };
  // product = A times the vector that was published last; for the first of a row's threads
  auto multiply = [&](Own const& o, Real(&product)[3]) {
    Real const* const vec = vector();
    for (int c = 0; c < 3; ++c) product[c] = 0;
    auto addEntry = [&](auto const& a, Real const(&x)[3]) {
      if constexpr (components == 6) {
        const Real xy = a(1), xz = a(2), yz = a(4);
        product[0] += a(0) * x[0] + xy * x[1] + xz * x[2];
        product[1] += xy * x[0] + a(3) * x[1] + yz * x[2];
        product[2] += xz * x[0] + yz * x[1] + a(5) * x[2];
      } else {
        for (int i = 0; i < 3; ++i) product[i] += a(3 * i) * x[0] + a(3 * i + 1) * x[1] + a(3 * i + 2) * x[2];
      }
    };
    // all that a thread keeps are loaded before the first is used
    Real x[kept > 0 ? kept : 1][3] = {};
    for (int k = 0; k < kept; ++k)
      if (k < o.used) team.load(vec + Team::stride * o.place[k], x[k]);
    for (int k = 0; k < kept; ++k) addEntry([&](int c) { return o.block[k][c]; }, x[k]);
    for (int e = o.from; e < o.to; e += lanes) {
      Real y[3];
      team.load(vec + Team::stride * column[e], y);
      addEntry([&](int c) { return values[c * size + e]; }, y);
    }
    for (int c = 0; c < 3; ++c) {
      product[c] = team.rowSum(product[c]);
      if (o.held >> c & 1) product[c] = 0;
    }
  };

  for (int step = 1; step <= body.steps; ++step) {
    // force = f + (h + rK) K v of an element
    auto forceOf = [&](auto const& field, int e, auto& tangent, auto& force) {
      constexpr int arity = std::decay_t<decltype(field)>::arity;
      auto const& rest = field.rest[std::ptrdiff_t(copy) * field.count + e];
      std::decay_t<decltype(*x)> xs[arity];
      Deriv vs[arity], dfs[arity];
      for (int k = 0; k < arity; ++k) {
        const int node = field.index[k * field.count + e];
        xs[k] = x[node];
        vs[k] = v[node];
      }
      field.law.force(rest, xs, vs, force, tangent);
      field.law.dforce(rest, tangent, vs, dfs, h + body.rayleighStiffness, Real(0));
      for (int k = 0; k < arity; ++k) force[k] += dfs[k];
    };
    auto forces = [&](auto const& field) {
      using Field = std::decay_t<decltype(field)>;
      if constexpr (!Field::byRows) {
        auto* const tangents = field.tangent + std::ptrdiff_t(copy) * field.count;
        auto* const part = field.part + std::ptrdiff_t(copy) * field.count * Field::arity;
        for (int e = team.rank * team.threads + team.thread; e < field.count;
             e += team.ranks * team.threads) {
          Deriv force[Field::arity];
          typename Field::Law::Tangent tangent;
          forceOf(field, e, tangent, force);
          tangents[e] = tangent;
          for (int k = 0; k < Field::arity; ++k) part[k * field.count + e] = force[k];
        }
      }
    };
    std::apply([&](auto const&... field) { (forces(field), ...); }, body.fields);
    if constexpr (!Body::byRows) team.sync();

    // rows of the matrix, and the right-hand side
    forRows([&](int row, int lane, Own& o) {
      Real f[3] = {}, diagonal[components] = {};
      const int first = body.entryFirst[begin + row], end = body.entryFirst[begin + row + 1];
      auto sumParts = [&](auto const& field) {
        using Field = std::decay_t<decltype(field)>;
        if (Field::byRows || o.node >= field.nodes) return;
        auto const* const part = field.part + std::ptrdiff_t(copy) * field.count * Field::arity;
        for (int i = field.partFirst[o.node] + lane; i < field.partFirst[o.node + 1]; i += lanes) {
          auto const& one = part[field.partEntry[i]];
          for (int c = 0; c < 3; ++c) f[c] += one[c];
        }
      };
      std::apply([&](auto const&... field) { (sumParts(field), ...); }, body.fields);
      // block = the entry e of the matrix, without the mass; what the diagonal gets from it
      auto entry = [&](int e, Real(&block)[components]) {
        for (int c = 0; c < components; ++c) block[c] = 0;
        if (e >= end) return;
        auto sumBlocks = [&](auto const& field) {
          using Field = std::decay_t<decltype(field)>;
          auto const* const rest = field.rest + std::ptrdiff_t(copy) * field.count;
          const int to = field.entryFirst[e + 1];
          int i = field.entryFirst[e], next = i < to ? field.entryCode[i] : 0;
          while (i < to) {
            const detail::BlockOfElement<Field::arity> of{unsigned(next)};
            next = ++i < to ? field.entryCode[i] : 0;  // on its way while this one is computed
            auto addBlock = [&](auto const& tangent) {
              add<components>(
                  block, field.law.block(rest[of.element], tangent, of.a, of.b, kFactor, bFactor), of.turned);
            };
            if constexpr (Field::byRows) {
              Deriv force[Field::arity];
              typename Field::Law::Tangent tangent;
              forceOf(field, of.element, tangent, force);
              for (int c = 0; c < 3; ++c) f[c] += of.turned ? force[Field::arity - 1][c] : force[0][c];
              addBlock(tangent);
            } else {
              addBlock(field.tangent[std::ptrdiff_t(copy) * field.count + of.element]);
            }
          }
        };
        std::apply([&](auto const&... field) { (sumBlocks(field), ...); }, body.fields);
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
      for (int c = 0; c < 3; ++c) f[c] = team.rowSum(f[c]);
      for (int c = 0; c < components; ++c) diagonal[c] = team.rowSum(diagonal[c]);
      if (lane != 0) return;
      const Real m = (1 + h * body.rayleighMass) * o.mass;
      for (int c = 0; c < 3; ++c) diagonal[components == 6 ? c * (7 - c) / 2 : 4 * c] += m;
      for (int c = 0; c < components; ++c)
        (kept > 0 ? o.block[0][c] : values[c * size + o.from]) = diagonal[c];
      for (int c = 0; c < 3; ++c) {
        const Real b = h * (f[c] + o.mass * (gravity[c] - body.rayleighMass * v[o.node][c]));
        o.r[c] = o.held >> c & 1 ? Real(0) : b;
        o.dv[c] = 0;
      }
      publish(row, o, o.r);
    });
    team.sync();
    forRows([&](int, int, Own& o) { multiply(o, o.w); });

    // conjugate gradients
    double start = 0, byRho = 0, byAlpha = 0;
    for (int iteration = 0; iteration < body.iterations; ++iteration) {
      turn = 1 - turn;
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
      team.give(local, room);
      team.awaitRows();
      team.fetchSums(room);
      forRows([&](int, int, Own& o) { multiply(o, o.n); });
      double total[2];
      team.takeSums(room, total);
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
    turn = 1 - turn;

    // v += dv, x += h v
    forRows([&](int, int lane, Own& o) {
      if (lane != 0) return;
      bool finite = true;
      for (int c = 0; c < 3; ++c) {
        const Real speed = v[o.node][c] + o.dv[c], place = x[o.node][c] + h * speed;
        v[o.node][c] = body.keptSpeed * speed;
        x[o.node][c] = place;
        finite = finite && place - place == Real(0);
      }
      if (!finite && body.wrong[copy] == 0) body.wrong[copy] = step;
    });
    team.sync();
  }
}

}  // namespace sinew::gpu
